# SPDX-License-Identifier: MIT
"""Controllers written in Python. The world hosts them like any algorithm: same radio, measures and recordings."""

from __future__ import annotations

import copy
import re
from dataclasses import dataclass
from typing import Any, Callable, Mapping

import numpy as np

from . import _core
from .arrays import LARGEST_MESSAGE, ActionError, Actions, Observations, Role, Writer, drive
from .fingerprints import fingerprint

_name = re.compile(r"[A-Za-z0-9_-]{1,100}")


@dataclass(frozen=True)
class Swarm:
    """What a policy is told before the first tick. No positions: robots do not know where they are."""

    robots: int
    workers: np.ndarray  # ids of the robots that are sent to targets at the start
    root: int  # id of the root at the start
    range_m: float  # of the radio
    tick_s: float
    speed_limit_m_s: float  # of a wheel
    wheel_distance_m: float
    holonomic: bool  # drives in any direction without turning
    line_of_sight: bool  # the radio needs it
    arrival_distance_m: float  # nearer than this a target is held

    def drive(self, velocity: Any) -> np.ndarray:
        """`banyan.drive` with the wheels of these robots."""
        return drive(velocity, self.speed_limit_m_s, self.wheel_distance_m, self.holonomic)


class Policy:
    """Decides for all robots of a world at once, with arrays: what learning needs. Override step(), and reset() if
    you need to know the swarm. An instance serves one world; what it remembers must be deep-copyable, since worlds
    can be copied."""

    name: str | None = None  # as in mission.algorithm; the class's in small letters if there is none
    max_neighbours: int = 32  # K: of more, the nearest are heard
    message_floats: int = 0  # numbers in a message, at most 23
    message_bytes: int = 0  # or bytes, at most 94: with the sender's id a message has at most 96
    base: str | None = None  # one of Banyan's algorithms that runs beneath: step() gets its velocities, may change
    #                          them, and leaves messages and tree to it

    def reset(self, swarm: Swarm) -> None:
        """Called once, before the first tick."""

    def step(self, seen: Observations) -> Actions | np.ndarray | Mapping[str, Any] | None:
        """One tick. None: with `base`, what it suggests; else an error."""
        raise NotImplementedError


@dataclass(frozen=True)
class Robot:
    """What the controller of one robot is told before the first tick."""

    id: int
    worker: bool  # it is sent to a target
    root: bool  # it is the root
    swarm: Swarm

    def drive(self, velocity: Any) -> np.ndarray:
        """`banyan.drive` with the wheels of this robot."""
        return self.swarm.drive(velocity)


class Observation:
    """What one robot senses in a tick: the row of Observations that is its own, without padding.

    target    (2,) m, or None if it has none or does not sense it
    ids       (n,) of the n neighbours heard; positions (n, 2) m; messages (n, M); ages (n,) ticks
    odometry  (3,) m, m, rad; obstacles (n, 2) m
    """

    __slots__ = ("_all", "id")

    def __init__(self, all_: Observations, robot: int) -> None:
        self._all = all_
        self.id = robot

    @property
    def target(self) -> np.ndarray | None:
        return self._all.target[self.id] if self._all.has_target[self.id] else None

    @property
    def sent(self) -> bool:
        return bool(self._all.sent[self.id])

    @property
    def given_up(self) -> int:
        return int(self._all.given_up[self.id])

    @property
    def odometry(self) -> np.ndarray:
        return self._all.odometry[self.id]

    @property
    def obstacles(self) -> np.ndarray:
        return self._all.obstacle_position[self.id, : self._all.obstacles[self.id]]

    @property
    def heard(self) -> int:
        return int(self._all.heard[self.id])

    @property
    def ids(self) -> np.ndarray:
        return self._all.sender[self.id, : self.heard]

    @property
    def positions(self) -> np.ndarray:
        return self._all.position[self.id, : self.heard]

    @property
    def ages(self) -> np.ndarray:
        return self._all.age[self.id, : self.heard]

    @property
    def messages(self) -> np.ndarray:
        return self._all.message[self.id, : self.heard]

    @property
    def suggested(self) -> np.ndarray:
        return self._all.suggested[self.id]


@dataclass
class Action:
    """What one robot does; as in Actions, without the axis of robots. A message may be of type bytes."""

    velocity: Any
    message: Any = None
    role: int = Role.UNSAID
    parent: int = -1
    serves: int = -2
    kept: Any = ()


class Controller:
    """Decides for one robot: an instance for each. Override step(), and reset() if you need to know the robot. What
    has a step() but is no Policy counts as one, too."""

    name: str | None = None
    max_neighbours: int = 128
    message_floats: int = 0
    message_bytes: int = 0
    base: str | None = None

    def reset(self, robot: Robot) -> None:
        """Called once, before the first tick."""

    def step(self, seen: Observation) -> Action | np.ndarray | None:
        raise NotImplementedError


class _Crowd(Policy):
    """One controller for each robot, as a policy."""

    def __init__(self, make: Callable[[], Any], like: Any) -> None:
        self.make = make
        self.message_bytes, self.message_floats = _size(like, "message_bytes"), _size(like, "message_floats")
        self.base = getattr(like, "base", None)
        self.robots: list[Any] = []

    def reset(self, swarm: Swarm) -> None:
        self.robots = [self.make() for _ in range(swarm.robots)]
        workers = set(swarm.workers.tolist())
        for i, robot in enumerate(self.robots):
            if hasattr(robot, "reset"):
                robot.reset(Robot(i, i in workers, i == swarm.root, swarm))
        n = swarm.robots
        message = (
            np.zeros((n, self.message_floats), np.float32)
            if self.message_floats
            else np.zeros((n, self.message_bytes), np.uint8)
        )
        self.actions = Actions(
            np.zeros((n, 3 if swarm.holonomic else 2), np.float32),
            message if message.size else None,
            np.full(n, -1),
            np.full(n, -1),
            np.full(n, -2),
            np.full((n, 12), -1),
        )

    def __deepcopy__(self, memo: dict[int, Any]) -> "_Crowd":
        twin = copy.copy(self)
        twin.robots = copy.deepcopy(self.robots, memo)
        twin.actions = copy.deepcopy(self.actions, memo)
        return twin

    def step(self, seen: Observations) -> Actions:
        for i in np.flatnonzero(seen.steps).tolist():
            action = self.robots[i].step(Observation(seen, i))
            try:
                self._take(i, action, seen)
            except (ActionError, ValueError, TypeError) as error:
                raise ActionError(f"robot {i}: {error}") from error
        return self.actions

    def _take(self, i: int, action: Any, seen: Observations) -> None:
        to = self.actions
        if action is None and self.base:
            to.velocity[i] = seen.suggested[i, 0::2] if to.velocity.shape[-1] == 2 else seen.suggested[i]
            return
        if not isinstance(action, Action):
            action = Action(action)
        velocity = np.asarray(action.velocity, np.float32)
        if velocity.shape != to.velocity.shape[1:]:
            raise ActionError(f"velocity: has shape {velocity.shape}; needed is {to.velocity.shape[1:]}")
        to.velocity[i] = velocity
        if action.message is not None:
            if to.message is None:
                raise ActionError("message: there are none; set message_floats or message_bytes")
            message = (
                np.frombuffer(action.message, np.uint8)
                if isinstance(action.message, (bytes, bytearray))
                else np.asarray(action.message)
            )
            if message.shape != to.message.shape[1:]:
                raise ActionError(f"message: has shape {message.shape}; needed is {to.message.shape[1:]}")
            to.message[i] = message
        to.role[i], to.parent[i], to.serves[i] = action.role, action.parent, action.serves
        kept = np.asarray(action.kept, int).ravel()
        to.kept[i] = -1
        to.kept[i, : len(kept)] = kept


class _Mind:
    """A policy in one world, as the C++ side calls it."""

    def __init__(self, policy: Any, floats: bool, holonomic: bool) -> None:
        self.policy, self.floats, self.holonomic = policy, floats, holonomic
        self.arrays: Any = None

    def decide(self, arrays: Mapping[str, np.ndarray]) -> None:
        if arrays is not self.arrays:
            self.arrays = arrays
            self.seen = Observations(arrays, self.floats)
            self.writer = Writer(arrays, self.floats, self.holonomic)
        actions = self.policy.step(self.seen)
        if actions is None:
            if not self.policy.base:
                raise ActionError("step() returned nothing; it returns Actions, or an array of velocities")
            actions = self.seen.suggested
        self.writer.write(actions)

    def clone(self) -> "_Mind":
        return _Mind(copy.deepcopy(self.policy), self.floats, self.holonomic)


def _size(like: Any, name: str) -> int:
    size = getattr(like, name, 0)
    if not isinstance(size, (int, np.integer)) or isinstance(size, bool) or size < 0:
        raise ValueError(f"{name}: is {size!r}; a whole number is needed, 0 for none")
    return int(size)


def payload_of(floats: int, bytes_: int) -> int:
    """Bytes of a message besides its sender's id."""
    if floats and bytes_:
        raise ValueError("a message has floats or bytes, not both: message_floats or message_bytes must be 0")
    size = 4 * floats + bytes_
    if size > LARGEST_MESSAGE:
        most = (
            f"message_floats: {floats} are too many; at most {LARGEST_MESSAGE // 4}"
            if floats
            else f"message_bytes: {bytes_} are too many; at most {LARGEST_MESSAGE}"
        )
        raise ValueError(f"{most}, since a message has 96 bytes and 2 of them are its sender's id")
    return size


def described(controller: Any, name: str | None = None, *, told_apart: bool = False) -> tuple[Any, ...]:
    """What the C++ side needs to know of a controller: a class, an object that is copied for each world, or a function
    without arguments that makes one. `told_apart`: with its fingerprint."""
    if isinstance(controller, type):
        make, like = controller, controller
    elif hasattr(controller, "step"):
        make, like = (lambda: copy.deepcopy(controller)), controller
    elif callable(controller):
        make, like = controller, controller()
    else:
        raise TypeError(
            f"a controller is a class with step(), an object of one or a function that makes one, not {controller!r}"
        )
    if not callable(getattr(like, "step", None)):
        raise TypeError(f"{like!r} has no step(): a controller is a banyan.Policy or a banyan.Controller")
    kind = like if isinstance(like, type) else type(like)
    name = (
        name or getattr(like, "name", None) or re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "-", kind.__name__).lower().lstrip("_")
    )
    if not _name.fullmatch(name):
        raise ValueError(f"a controller cannot be called {name!r}: 1 to 100 letters, digits, '-' and '_'")
    base = getattr(like, "base", None)
    if base is not None and base not in _core.algorithm_table():
        raise ValueError(f"base: there is no algorithm {base!r}; there are {', '.join(_core.algorithm_table())}")
    batched = issubclass(kind, Policy)
    neighbours = getattr(like, "max_neighbours", Controller.max_neighbours)
    if not isinstance(neighbours, (int, np.integer)) or not 1 <= neighbours <= 4096:
        raise ValueError(f"max_neighbours: is {neighbours!r}; allowed: 1 to 4096")
    bytes_ = _size(like, "message_bytes")
    payload = payload_of(_size(like, "message_floats"), bytes_)

    def begin(facts: dict[str, Any]) -> _Mind:
        policy = make() if batched else _Crowd(make, like)
        holonomic = facts["holonomic"]
        policy.reset(Swarm(**{**facts, "workers": np.array(facts["workers"], int)}))
        return _Mind(policy, not bytes_, holonomic)

    summary = ((kind.__doc__ or "").strip().splitlines() or ["a controller in Python"])[0]
    mark = fingerprint(controller, like) if told_apart else ""
    return (name, summary, int(neighbours), payload, not bytes_, base, begin, mark)
