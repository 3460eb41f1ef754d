# SPDX-License-Identifier: MIT
"""Worlds as environments for learning: many in lockstep as in VMAS, or one with PettingZoo's parallel calls. Needs
neither."""

from __future__ import annotations

import difflib
import os
from typing import Any, Callable, Mapping

import numpy as np

from . import _core
from .arrays import Actions, Observations, Writer
from .controllers import payload_of
from .runs import Scenario, scenario_of
from .spaces import Box

Metrics = Mapping[str, np.ndarray]


class Reward:
    """A reward from the metrics: a weighted sum, the same for all robots of a world, since the mission is theirs
    together. Names: every column of a series (docs/file-formats.md), and

    progress_m  by how much the mean distance of the targets to the robots sent there has shrunk in this tick, m
    split       1 while the radio network is in several parts
    done        1 in the tick in which the mission is complete for the first time
    """

    default = {"progress_m": 1.0, "split": -0.1, "done": 10.0}
    own = ("progress_m", "split", "done")

    def __init__(self, weights: Mapping[str, float] | None = None) -> None:
        self.weights = dict(self.default if weights is None else weights)

    def check(self, metrics: Metrics) -> None:
        names = [*self.own, *metrics]
        for name in self.weights:
            if name not in names:
                near = difflib.get_close_matches(name, names, 1)
                raise ValueError(
                    f"reward: there is no metric {name!r}"
                    + (f"; did you mean {near[0]!r}?" if near else f"; there are {', '.join(names)}")
                )

    def __call__(self, now: Metrics, before: Metrics) -> np.ndarray:
        total = np.zeros(len(now["complete"]))
        for name, weight in self.weights.items():
            total += weight * self._value(name, now, before)
        return total

    def _value(self, name: str, now: Metrics, before: Metrics) -> np.ndarray:
        if name == "progress_m":
            return before["mean_target_distance_m"] - now["mean_target_distance_m"]
        if name == "split":
            return now["components"] > 1
        if name == "done":
            return now["complete"] & ~before["complete"]
        return now[name]


class BatchEnv:
    """`num_envs` worlds of one scenario, stepped together, their robots decided for by arrays.

        env = banyan.BatchEnv("scenarios/three-targets.toml", num_envs=1000, message_floats=2)
        seen = env.reset(seed=1)
        seen, rewards, terminated, truncated, info = env.step(actions)

    num_envs         E; after reset(seed=s) world e has the seed s + e, and every world that begins anew has the next one
    max_neighbours   K, heard by a robot at once; default: all, at most 32
    message_floats   M, or message_bytes: what a robot's message has
    base             an algorithm of Banyan's that runs beneath; actions are velocities instead of those it suggests
    reward           weights of metrics (see Reward), or a function of (metrics now, metrics before), dicts of arrays
                     (E,), that returns (E,) or (E, N)
    threads          worlds are shared among so many
    auto_reset       a world whose mission has ended begins anew; what is returned then is its first observation
    copy             False: observations are written into the same memory at every step
    and the keywords of Scenario but for controllers
    """

    def __init__(
        self,
        scenario: str | os.PathLike[str] | Mapping[str, Any] | Scenario,
        num_envs: int = 1,
        *,
        max_neighbours: int | None = None,
        message_floats: int = 0,
        message_bytes: int = 0,
        base: str | None = None,
        reward: Mapping[str, float] | Callable[[Metrics, Metrics], np.ndarray] | None = None,
        threads: int = 1,
        auto_reset: bool = False,
        copy: bool = True,
        seed: int | None = None,
        parameters: Mapping[str, float] | None = None,
        set: Mapping[str, Any] | None = None,
        with_files: Any = (),
    ) -> None:
        if base is not None and base not in _core.algorithm_table():
            raise ValueError(f"base: there is no algorithm {base!r}; there are {', '.join(_core.algorithm_table())}")
        keys = dict(seed=seed, algorithm=base, parameters=parameters, set=set, with_files=with_files)
        self.scenario = scenario_of(scenario, keys)
        core = self.scenario._core
        if core.asynchronous:
            raise ValueError(
                "clocks.asynchronous: robots with clocks of their own do not step together; run them with a Policy"
            )
        if num_envs < 1:
            raise ValueError(f"num_envs: is {num_envs}; at least 1")
        if threads < 1:
            raise ValueError(f"threads: is {threads}; at least 1")
        payload = payload_of(message_floats, message_bytes)
        self.num_envs, self.num_robots = num_envs, core.robots
        neighbours = min(self.num_robots - 1, 32) if max_neighbours is None else max_neighbours
        if not 1 <= neighbours <= 4096:
            raise ValueError(f"max_neighbours: is {neighbours}; allowed: 1 to 4096")
        self._floats = not message_bytes
        self._core = _core.Lockstep(core, num_envs, neighbours, payload, self._floats, base, threads)
        arrays = self._core.arrays()
        self._seen = Observations(arrays, self._floats)
        self._writer = Writer(arrays, self._floats, core.holonomic)
        self.metrics: dict[str, np.ndarray] = self._core.outcomes()
        self._reward: Any = reward if callable(reward) else Reward(reward)
        if isinstance(self._reward, Reward):
            self._reward.check(self.metrics)
        self._auto_reset, self._copy, self._base = auto_reset, copy, base
        self.seeds = np.zeros(num_envs, np.int64)
        self._next_seed = core.seed
        self._ready = False

    def reset(self, seed: int | None = None) -> Observations:
        """All worlds anew, with the seeds seed, seed + 1, ...; without a seed, with those that come next, so that no
        episode is like another and the last reset(seed) brings all of them back. The first time, that is the
        scenario's seed. In the first tick robots sense, and hear nobody yet."""
        self._begin(np.ones(self.num_envs, bool), seed)
        if seed is not None:
            self._next_seed = int(seed) + self.num_envs
        self._ready = True
        return self._observations()

    def reset_at(self, index: int, seed: int | None = None) -> Observations:
        """One world anew, with that seed or the one that comes next."""
        if not self._ready:
            raise RuntimeError("reset() comes first")
        if not 0 <= index < self.num_envs:
            raise IndexError(f"there is no world {index} of {self.num_envs}")
        which = np.zeros(self.num_envs, bool)
        which[index] = True
        self._begin(which, seed)
        return self._observations()

    def step(
        self, actions: Actions | Mapping[str, Any] | np.ndarray
    ) -> tuple[Observations, np.ndarray, np.ndarray, np.ndarray, dict[str, Any]]:
        """One tick of all worlds. Actions have shapes (E, N, ...). Returns observations; rewards (E, N) float32;
        terminated (E,): the mission has ended complete; truncated (E,): its time is over; info: the metrics, and with
        auto_reset `ended`, the worlds that have begun anew."""
        if not self._ready:
            raise RuntimeError("reset() comes before step()")
        self._writer.write(actions)
        before = {name: values.copy() for name, values in self.metrics.items()}
        self._core.step()
        now = {name: values.copy() for name, values in self.metrics.items()}
        rewards = np.asarray(self._reward(now, before), np.float32)
        if rewards.shape == (self.num_envs,):
            rewards = np.repeat(rewards[:, None], self.num_robots, axis=1)
        if rewards.shape != (self.num_envs, self.num_robots):
            raise ValueError(
                f"reward: has shape {rewards.shape}; needed is {(self.num_envs,)} or {(self.num_envs, self.num_robots)}"
            )
        terminated = now["finished"] & now["complete"]
        truncated = now["finished"] & ~now["complete"]
        info: dict[str, Any] = {"metrics": now}
        if self._auto_reset:
            info["ended"] = terminated | truncated
            if info["ended"].any():
                self._begin(info["ended"])
        return self._observations(), rewards, terminated, truncated, info

    def drive(self, velocity: Any) -> np.ndarray:
        """`banyan.drive` with the wheels of these robots."""
        from .arrays import drive

        core = self.scenario._core
        return drive(velocity, core.wheel_limit_m_s, core.wheel_distance_m, core.holonomic)

    def positions(self, index: int = 0) -> np.ndarray:
        """The truth about one world, (N, 2) m: to look at, or for a critic; robots do not know it."""
        return self._core.positions(index)

    def hash(self, index: int = 0) -> int:
        return self._core.hash(index)

    def result(self, index: int = 0) -> dict[str, Any]:
        """The row of the run so far of one world."""
        return self._core.result(index)

    def frame(self, index: int = 0) -> Any:
        """One world now; shows itself as a picture."""
        return self._core.frame(index)

    def _begin(self, which: np.ndarray, seed: int | None = None) -> None:
        count, seeds = int(which.sum()), self.seeds.copy()
        if seed is not None and not 0 <= int(seed) <= 2**53 - count:
            raise ValueError(f"seed: is {seed}; allowed: 0 to 2^53 - {count}")
        first = self._next_seed if seed is None else int(seed)
        seeds[which] = (first + np.arange(count)) % 2**53
        self._core.reset(seeds.tolist(), which.tolist())
        self.seeds = seeds
        if seed is None:
            self._next_seed = (first + count) % 2**53

    def _observations(self) -> Observations:
        return self._seen.copy() if self._copy else self._seen

    def _repr_svg_(self) -> str:
        return self.frame(0)._repr_svg_()

    def __repr__(self) -> str:
        return f"<banyan.BatchEnv {self.scenario.name}: {self.num_envs} worlds of {self.num_robots} robots>"


class ParallelEnv:
    """One world with the calls of PettingZoo's parallel environments: reset(seed), step(actions), agents, spaces.

    Agents are "robot_0", "robot_1", ...; an observation is the vector of Observations.flat(), an action (2 + M,):
    forward m/s, turn rad/s and, in [-1, 1], the numbers of the message (holonomic robots (3 + M,): forward, left,
    turn). Keywords are those of BatchEnv.
    """

    metadata = {"name": "banyan_v0", "render_modes": ["svg"], "is_parallelizable": True}
    render_mode = "svg"

    def __init__(
        self, scenario: str | os.PathLike[str] | Mapping[str, Any] | Scenario, *, message_floats: int = 0, **keys: Any
    ) -> None:
        self._batch = BatchEnv(scenario, 1, message_floats=message_floats, **keys)
        if keys.get("message_bytes") or keys.get("auto_reset"):
            raise ValueError("message_bytes and auto_reset are for BatchEnv")
        core = self._batch.scenario._core
        self.possible_agents = [f"robot_{i}" for i in range(self._batch.num_robots)]
        self.agents: list[str] = []
        turn = 2 * core.wheel_limit_m_s / core.wheel_distance_m
        limits = [core.wheel_limit_m_s] * (2 if core.holonomic else 1) + [turn] + [1.0] * message_floats
        self._velocity = 3 if core.holonomic else 2
        self._messages = message_floats
        self._action = [Box(-np.array(limits), np.array(limits)) for _ in self.possible_agents]
        size = 9 + 24 + self._batch._seen.sender.shape[-1] * (3 + message_floats)
        self._observation = [Box(-np.inf, np.inf, (size,)) for _ in self.possible_agents]

    num_agents = property(lambda self: len(self.agents))
    max_num_agents = property(lambda self: len(self.possible_agents))

    @property
    def unwrapped(self) -> "ParallelEnv":
        return self

    def observation_space(self, agent: str) -> Box:
        return self._observation[self._index(agent)]

    def action_space(self, agent: str) -> Box:
        return self._action[self._index(agent)]

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, np.ndarray], dict[str, dict[str, Any]]]:
        """(observations, infos) by agent. Without a seed, the world of the next one: see BatchEnv.reset."""
        seen = self._batch.reset(seed)
        self.agents = list(self.possible_agents)
        return self._of_agents(seen), {agent: {} for agent in self.agents}

    def step(self, actions: Mapping[str, Any]) -> tuple[dict[str, Any], ...]:
        """(observations, rewards, terminations, truncations, infos) by agent. Dead robots are agents no longer; all
        are gone when the mission has ended."""
        if not self.agents:
            raise RuntimeError("reset() comes before step(), and after the end")
        missing = [agent for agent in self.agents if agent not in actions]
        if missing:
            raise ValueError(f"actions: {missing[0]!r} is missing")
        all_ = np.zeros((1, self._batch.num_robots, self._velocity + self._messages), np.float32)
        for agent in self.agents:
            action = np.asarray(actions[agent])
            if action.shape != all_.shape[2:] or action.dtype.kind not in "fiu":
                found = f"shape {action.shape} and type {action.dtype}"
                raise ValueError(f"actions[{agent!r}]: has {found}; needed are {all_.shape[2:]} real numbers")
            all_[0, self._index(agent)] = action
        message = all_[..., self._velocity :] if self._messages else None
        seen, rewards, terminated, truncated, info = self._batch.step(Actions(all_[..., : self._velocity], message))
        acted, over = self.agents, bool(terminated[0] or truncated[0])
        gone = {agent: not seen.steps[0, self._index(agent)] for agent in acted}
        observations = self._of_agents(seen)
        metrics = {name: values[0].item() for name, values in info["metrics"].items()}
        self.agents = [] if over else [agent for agent in acted if not gone[agent]]
        return (
            observations,
            {agent: float(rewards[0, self._index(agent)]) for agent in acted},
            {agent: bool(terminated[0]) or gone[agent] for agent in acted},
            {agent: bool(truncated[0]) for agent in acted},
            {agent: metrics for agent in acted},
        )

    def state(self) -> np.ndarray:
        """(N, 4): true positions and headings, for a critic."""
        return np.concatenate([self._batch._core.positions(0), self._batch._core.headings(0)], axis=-1)

    def render(self) -> str:
        """The world as an SVG picture."""
        return self._batch._repr_svg_()

    _repr_svg_ = render

    def close(self) -> None:
        pass

    def result(self) -> dict[str, Any]:
        """The row of the run so far."""
        return self._batch.result(0)

    def _of_agents(self, seen: Observations) -> dict[str, np.ndarray]:
        flat = seen.flat()[0]
        return {agent: flat[self._index(agent)] for agent in self.agents}

    def _index(self, agent: str) -> int:
        try:
            return self.possible_agents.index(agent) if not agent.startswith("robot_") else int(agent[6:])
        except (ValueError, AttributeError):
            raise KeyError(f"there is no agent {agent!r}") from None

    def __repr__(self) -> str:
        return f"<banyan.ParallelEnv {self._batch.scenario.name}: {self.max_num_agents} robots>"
