# SPDX-License-Identifier: MIT
"""What robots sense and what they do, as arrays. `...` in a shape is (robots,) in one world, (num_envs, robots) in many
worlds."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import Any, Mapping

import numpy as np

from . import _core

MOST_KEPT: int = _core.most_kept_links
LARGEST_MESSAGE: int = _core.largest_payload  # bytes


class Role(IntEnum):
    """What a robot is in the network, as observers count it. UNSAID: worker if it was sent to a target, root if it
    was the root at the start, else connector."""

    UNSAID = -1
    SPARE = 0
    CONNECTOR = 1
    WORKER = 2
    ROOT = 3


class ActionError(ValueError):
    """An action of a wrong shape or type, or with values that cannot be."""


class Observations:
    """What all robots sense in a tick, each in its own body frame: x forward, y to the left, metres. Never truth: nobody
    knows a position, a map or a compass. The arrays are written anew at every tick: copy() what you keep.

    worker, root         (...)        bool   what it was at the start
    steps                (...)        bool   it lives, and steps now; what the others sense is old
    sent, has_target     (...)        bool   it has been sent to a target; the target is sensed now
    target               (..., 2)     m      where its target is
    given_up             (...)        int    a target given up, named by the robot first sent there; -1: none
    odometry             (..., 3)     m, m, rad   own motion since the last step: forward, left, turn
    obstacles            (...)        int    how many are within reach (0.3 m)
    obstacle_position    (..., 8, 2)  m      their nearest points, the nearest first
    heard                (...)        int    how many neighbours are heard
    sender               (..., K)     int    their ids, -1 behind the last; ascending. Of more than K, the nearest
    position             (..., K, 2)  m      where they were when they spoke, carried along by own odometry
    age                  (..., K)     ticks  since they composed the message
    message              (..., K, M)  float32 or uint8, as the policy's messages are
    own_role, own_parent (...)        int    what it reported last
    suggested            (..., 3)     velocity of the algorithm beneath (Policy.base)
    """

    worker: np.ndarray
    root: np.ndarray
    steps: np.ndarray
    sent: np.ndarray
    has_target: np.ndarray
    target: np.ndarray
    given_up: np.ndarray
    odometry: np.ndarray
    obstacles: np.ndarray
    obstacle_position: np.ndarray
    heard: np.ndarray
    sender: np.ndarray
    position: np.ndarray
    age: np.ndarray
    message: np.ndarray
    own_role: np.ndarray
    own_parent: np.ndarray
    suggested: np.ndarray
    fields: tuple[str, ...] = tuple(name for name, _, decided in _core.field_table() if not decided)

    def __init__(self, arrays: Mapping[str, np.ndarray], floats: bool) -> None:
        for name in self.fields:
            setattr(self, name, arrays[name])
        self.floats = floats
        if floats and self.message.dtype == np.uint8:
            self.message = _as_floats(arrays["message"])

    @property
    def mask(self) -> np.ndarray:
        """(..., K) bool: the places of neighbours that are heard."""
        return self.sender >= 0

    def copy(self) -> "Observations":
        """The same in memory of its own."""
        return Observations({name: getattr(self, name).copy() for name in self.fields}, self.floats)

    def ragged(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Without padding: (offsets, sender, position, message). Of all robots counted through, robot r hears
        offsets[r] to offsets[r + 1]."""
        mask = self.mask
        offsets = np.concatenate([[0], np.cumsum(self.heard.ravel())])
        return offsets, self.sender[mask], self.position[mask], self.message[mask]

    def flat(self) -> np.ndarray:
        """(..., D) float32: one vector for each robot, D = 9 + 24 + K (3 + M): sent, has_target, target, worker, root,
        odometry; of each obstacle 1, x, y; of each neighbour 1, x, y, message. Zeros where there is none."""
        lead = self.sent.shape
        own = np.stack([self.sent, self.has_target, self.worker, self.root], axis=-1)
        there = np.arange(self.obstacle_position.shape[-2]) < self.obstacles[..., None]
        around = np.concatenate([there[..., None], self.obstacle_position], axis=-1)
        message = self.message if self.floats else self.message / np.float32(255)
        heard = np.concatenate([self.mask[..., None], self.position, message], axis=-1)
        parts = (own, self.target, self.odometry, around.reshape(*lead, -1), heard.reshape(*lead, -1))
        return np.concatenate(parts, axis=-1).astype(np.float32)

    def __repr__(self) -> str:
        neighbours, message = self.sender.shape[-1], self.message.shape[-1]
        return f"<banyan.Observations: {self.sent.shape}, {neighbours} neighbours at most, message {message}>"


@dataclass
class Actions:
    """What all robots do. A bare array stands for the velocities alone.

    velocity  (..., 2) forward m/s, turn rad/s, or (..., 3) with the speed to the left between them (holonomic robots
              alone). Beyond what the wheels can do it is shortened in its proportions.
    message   (..., M) float32 or uint8: what neighbours hear in the next tick; None: the last one again
    role      (...) Role; None: Role.UNSAID
    parent    (...) the robot whose link it promises to keep, -1: none. Measures call these the tree's edges
    serves    (...) a worker's target, by the robot first sent there; -1: none; None: the one it was sent to
    kept      (..., up to 12) further links that it promises to keep, -1: none
    """

    velocity: Any
    message: Any = None
    role: Any = None
    parent: Any = None
    serves: Any = None
    kept: Any = None


_unsaid = {"role": -1, "parent": -1, "serves": -2, "kept": -1}


class Writer:
    """Puts Actions into the arrays from which robots take them, or says what is wrong with them."""

    def __init__(self, arrays: Mapping[str, np.ndarray], floats: bool, holonomic: bool) -> None:
        self.velocity = arrays["velocity"]
        self.lead = self.velocity.shape[:-1]
        self.robots = self.lead[-1]
        self.holonomic = holonomic
        self.floats = floats
        self.message = _as_floats(arrays["broadcast"]) if floats else arrays["broadcast"]
        self.said = {name: arrays[name] for name in _unsaid}
        self.told: set[str] = set()  # fields that are not as they were unsaid

    def write(self, actions: Any) -> None:
        if isinstance(actions, Mapping):
            unknown = set(actions) - set(Actions.__dataclass_fields__)
            if unknown:
                raise ActionError(
                    f"an action has no {sorted(unknown)[0]!r}; it has {', '.join(Actions.__dataclass_fields__)}"
                )
            actions = Actions(**{"velocity": None, **actions})
        elif not isinstance(actions, Actions):
            actions = Actions(actions)
        if actions.velocity is None:
            raise ActionError("velocity: is missing; zeros stand still")
        # All is looked at before anything is written.
        velocity = self._velocity(actions.velocity)
        message = None if actions.message is None else self._message(actions.message)
        said = {
            name: self._whole(name, getattr(actions, name)) for name in _unsaid if getattr(actions, name) is not None
        }
        if velocity.shape[-1] == 3:
            self.velocity[...] = velocity
        else:
            self.velocity[..., 0::2] = velocity
            self.velocity[..., 1] = 0
        if message is not None:
            self.message[...] = message
        for name, values in said.items():
            array = self.said[name]
            if name == "kept":
                array[..., values.shape[-1] :] = -1
                array[..., : values.shape[-1]] = values
            else:
                array[...] = values
        for name in self.told - said.keys():
            self.said[name][...] = _unsaid[name]
        self.told = set(said)

    def _real(self, name: str, values: Any, lasts: tuple[int, ...]) -> np.ndarray:
        try:
            array = np.asarray(values)
        except ValueError:
            raise ActionError(f"{name}: is ragged; an array of shape {self._shapes(lasts)} is needed") from None
        if array.dtype.kind not in "fiu":
            raise ActionError(f"{name}: is of type {array.dtype}; real numbers are needed")
        if array.shape not in {(*self.lead, last) for last in lasts}:
            raise ActionError(f"{name}: has shape {array.shape}; needed is {self._shapes(lasts)}")
        with np.errstate(over="ignore"):
            array = array.astype(np.float32, copy=False)
        if not np.isfinite(array).all():
            place = tuple(int(k) for k in np.argwhere(~np.isfinite(array))[0])
            raise ActionError(f"{name}: at {place} is {array[place]}; finite numbers are needed")
        return array

    def _shapes(self, lasts: tuple[int, ...]) -> str:
        return " or ".join(str((*self.lead, last)) for last in lasts)

    def _velocity(self, values: Any) -> np.ndarray:
        velocity = self._real("velocity", values, (2, 3))
        if velocity.shape[-1] == 3 and not self.holonomic and (velocity[..., 1] != 0).any():
            raise ActionError(
                "velocity: these robots have two wheels and cannot drive to the left; give (forward, turn), see drive()"
            )
        return velocity

    def _message(self, values: Any) -> np.ndarray:
        size = self.message.shape[-1]
        if size == 0:
            raise ActionError("message: there are none; set message_floats or message_bytes")
        if self.floats:
            return self._real("message", values, (size,))
        array = np.asarray(values)
        if array.dtype != np.uint8:
            raise ActionError(f"message: is of type {array.dtype}; bytes are needed, uint8")
        if array.shape != (*self.lead, size):
            raise ActionError(f"message: has shape {array.shape}; needed is {(*self.lead, size)}")
        return array

    def _whole(self, name: str, values: Any) -> np.ndarray:
        try:
            array = np.asarray(values)
        except ValueError:
            raise ActionError(f"{name}: is ragged") from None
        if array.dtype.kind not in "iu":
            raise ActionError(f"{name}: is of type {array.dtype}; whole numbers are needed")
        if name == "kept":
            if array.ndim != len(self.lead) + 1 or array.shape[:-1] != self.lead or array.shape[-1] > MOST_KEPT:
                raise ActionError(f"kept: has shape {array.shape}; needed is {self.lead} and up to {MOST_KEPT} behind")
        elif array.shape != self.lead:
            raise ActionError(f"{name}: has shape {array.shape}; needed is {self.lead}")
        low, high = _unsaid[name], int(max(Role)) if name == "role" else self.robots - 1
        if array.size and (array.min() < low or array.max() > high):
            bad = array[(array < low) | (array > high)].flat[0]
            raise ActionError(f"{name}: {bad} is not from {low} to {high}")
        return array


def _as_floats(bytes_: np.ndarray) -> np.ndarray:
    if bytes_.shape[-1] == 0:
        return np.zeros(bytes_.shape, np.float32)
    return bytes_.view(np.float32)


def drive(
    velocity: Any, speed_limit_m_s: float = 0.2, wheel_distance_m: float = 0.1054, holonomic: bool = False
) -> np.ndarray:
    """What two wheels do to move along vectors in the robot's own frame, as Banyan's own algorithms do it: turn towards
    it, and drive as far as it lies ahead.

    velocity: (..., 2) m/s, x forward, y to the left. Returns (..., 2): forward m/s, turn rad/s; of holonomic robots
    (..., 3): forward, left, turn. Vectors longer than the limit are shortened.
    """
    v = np.asarray(velocity, np.float32)
    speed = np.hypot(v[..., 0], v[..., 1])[..., None]
    v = v * np.minimum(1, speed_limit_m_s / np.maximum(speed, 1e-9))
    if holonomic:
        return np.concatenate([v, np.zeros_like(speed)], axis=-1)
    limit = 2 * speed_limit_m_s / wheel_distance_m
    turn = np.clip(4 * np.arctan2(v[..., 1], v[..., 0]), -limit, limit)
    turn = np.where(speed[..., 0] < 1e-4, 0, turn)
    forward = np.clip(v[..., 0], 0, np.maximum(0, speed_limit_m_s - np.abs(turn) * wheel_distance_m / 2))
    return np.stack([forward, turn], axis=-1)
