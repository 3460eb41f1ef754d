# SPDX-License-Identifier: MIT
"""Banyan deploys a swarm of robots to several distant targets and keeps its radio network in one piece.

    import banyan
    result = banyan.run("scenarios/paper-medium.toml", algorithm="convoy", seed=3)
    world = banyan.World("scenarios/three-targets.toml"); world.step(100); world.positions
    table = banyan.study("studies/first.toml")
    recording = banyan.read("out/three-targets-convoy-1/run.mcap")
    banyan.run("scenarios/paper-small.toml", controller=MyController)
    env = banyan.BatchEnv("scenarios/three-targets.toml", num_envs=1000)

docs/python.md tells the rest.
"""

from __future__ import annotations

from typing import Any

try:
    from . import _core
except ImportError as error:
    from .interpreters import another

    raise another(error, __path__) from error
from ._core import FileError, Frame, ScenarioError
from .arrays import ActionError, Actions, Observations, Role, drive
from .controllers import Action, Controller, Observation, Policy, Robot, Swarm
from .environments import BatchEnv, ParallelEnv, Reward
from .recordings import Recording
from .runs import Result, Scenario, run
from .spaces import Box
from .studies import read, study
from .tables import Table
from .worlds import World

__version__: str = _core.version
git_id: str = _core.git_id

#: The algorithms that come with Banyan: name -> {"summary": text, "parameters": [{"key", "default", "minimum", ...}]}
algorithms: dict[str, dict[str, Any]] = _core.algorithm_table()


def parameters(algorithm: str) -> dict[str, float]:
    """The parameters of an algorithm with their defaults, to change and hand to run(parameters=...)."""
    if algorithm not in algorithms:
        raise ValueError(f"there is no algorithm {algorithm!r}; there are {', '.join(algorithms)}")
    return {row["key"]: row["default"] for row in algorithms[algorithm]["parameters"]}


__all__ = [
    "Action",
    "ActionError",
    "Actions",
    "BatchEnv",
    "Box",
    "Controller",
    "FileError",
    "Frame",
    "Observation",
    "Observations",
    "ParallelEnv",
    "Policy",
    "Recording",
    "Result",
    "Reward",
    "Robot",
    "Role",
    "Scenario",
    "ScenarioError",
    "Swarm",
    "Table",
    "World",
    "algorithms",
    "drive",
    "parameters",
    "read",
    "run",
    "study",
]
