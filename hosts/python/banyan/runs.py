# SPDX-License-Identifier: MIT
"""Scenarios, and runs of them from the start to the end of the mission."""

from __future__ import annotations

import json
import os
import sys
import tempfile
import warnings
from pathlib import Path
from typing import Any, Callable, Iterator, Mapping

import numpy as np

from . import _core
from .controllers import described
from .places import find
from .recordings import Recording, film
from .tables import Table


def _toml(value: Any) -> str:
    """A value as TOML has it."""
    if isinstance(value, (np.generic, np.ndarray)):
        value = value.tolist()
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{json.dumps(str(key))} = {_toml(item)}" for key, item in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(_toml, value)) + "]"
    if isinstance(value, float):
        return repr(value)  # inf and nan, too: the reader says what is wrong with them
    if isinstance(value, (bool, int)):
        return json.dumps(value)
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(str(value))
    raise TypeError(f"a key of a scenario cannot be {value!r}: numbers, texts, True and False, lists and dicts can")


def changes_of(set: Mapping[str, Any] | None, with_files: Any = ()) -> list[tuple[str, str]]:
    files = [with_files] if isinstance(with_files, (str, os.PathLike)) else list(with_files or ())
    return [("", find(file)) for file in files] + [(key, _toml(value)) for key, value in (set or {}).items()]


class Scenario:
    """A world as a user describes it, read as strictly as by `banyan run`.

    source      a TOML or JSON file (also the run.json of an earlier run), a dict of its keys, or another Scenario
    algorithm   one of banyan.algorithms, instead of the file's
    seed        instead of the file's
    parameters  of the algorithm, as a dict: {"target_gain": 0.4}
    set         any other keys: {"radio.loss": 0.3, "targets.count": 4}
    with_files  files of keys that are laid over, such as tuned parameters
    controller  a controller of your own instead of an algorithm
    controllers several by name: {"mine": Mine}; `algorithm` then chooses

    Raises ScenarioError with everything that is wrong, each with its place, what is allowed and the nearest name.
    """

    def __init__(
        self,
        source: str | os.PathLike[str] | Mapping[str, Any] | "Scenario",
        *,
        algorithm: str | None = None,
        seed: int | None = None,
        parameters: Mapping[str, float] | None = None,
        set: Mapping[str, Any] | None = None,
        with_files: Any = (),
        controller: Any = None,
        controllers: Mapping[str, Any] | None = None,
    ) -> None:
        changes = changes_of(None, with_files)
        own = [described(each, name) for name, each in (controllers or {}).items()]
        if controller is not None:
            if algorithm is not None:
                raise ValueError("algorithm and controller: give one of them")
            own.append(described(controller))
            algorithm = own[-1][0]
        if algorithm is not None:
            changes.append(("mission.algorithm", _toml(algorithm)))
        if seed is not None:
            changes.append(("seed", _toml(int(seed))))
        for key, value in (parameters or {}).items():
            changes.append((f"mission.parameters.{key}", _toml(value)))
        changes += changes_of(set)
        if isinstance(source, Scenario):
            path, text = source.name + ".json", source._core.json()
            own = source._own + own
        elif isinstance(source, Mapping):
            path, text = "scenario.json", json.dumps(source, default=lambda value: value.tolist())
        else:
            path, text = find(source), None
        self._own = own
        self._core = _core.Scenario(path, text, changes, own)
        for warning in self._core.warnings:
            warnings.warn(warning, stacklevel=2)

    @classmethod
    def _of(cls, core: Any, own: list[Any]) -> "Scenario":
        scenario = cls.__new__(cls)
        scenario._core, scenario._own = core, own
        return scenario

    @property
    def name(self) -> str:
        return self._core.name

    @property
    def algorithm(self) -> str:
        return self._core.algorithm

    @property
    def seed(self) -> int:
        return self._core.seed

    @property
    def robots(self) -> int:
        return self._core.robots

    @property
    def tick_s(self) -> float:
        return self._core.tick_s

    @property
    def time_limit_s(self) -> float:
        return self._core.time_limit_s

    def to_dict(self) -> dict[str, Any]:
        """The complete configuration."""
        return json.loads(self._core.json())

    def to_toml(self) -> str:
        return self._core.toml()

    def __repr__(self) -> str:
        return f"<banyan.Scenario {self.name}: {self.robots} robots, {self.algorithm}, seed {self.seed}>"


def scenario_of(source: Any, keys: Mapping[str, Any]) -> Scenario:
    return (
        source
        if isinstance(source, Scenario) and not any(value is not None and value != () for value in keys.values())
        else Scenario(source, **keys)
    )


class Result(Mapping[str, Any]):
    """What a run came to: its row by column, as in run.csv (docs/file-formats.md). `result["completion_time_s"]`.

    series         Table, a row of metrics per tick (series=True)
    trajectories   dict of arrays over the frames kept (trajectories=n: every nth tick): time_s (F,), positions and
                   headings (F, N, 2), roles, parents and alive (F, N)
    frame          the last instant; shows itself as a picture
    folder         where the files are (out=)
    """

    def __init__(self, told: Mapping[str, Any], scenario: Scenario, folder: str | None) -> None:
        self.row: dict[str, Any] = told["row"]
        self.frame = told["frame"]
        self.series = Table(told["series"]) if told["series"] is not None else None
        self.trajectories: dict[str, np.ndarray] | None = told["trajectories"]
        self.scenario = scenario
        self.folder = folder

    @property
    def complete(self) -> bool:
        return self.row["complete"]

    @property
    def hash(self) -> int:
        """The state of the world at the end, bit for bit: the same as that of `banyan run`."""
        return int(self.row["hash"], 16) if isinstance(self.row["hash"], str) else self.row["hash"]

    @property
    def recording(self) -> Recording:
        """The recording, if out= has kept one."""
        if self.folder is None or not os.path.exists(os.path.join(self.folder, "run.mcap")):
            raise ValueError("nothing was recorded: run(..., out=FOLDER) keeps a recording")
        return Recording(os.path.join(self.folder, "run.mcap"))

    def film(self, path: str | os.PathLike[str], **look: Any) -> str:
        """The run as a film; see banyan.Recording.film. If it was not recorded, it is done once more, to the same bits."""
        if self.folder is not None and os.path.exists(os.path.join(self.folder, "run.mcap")):
            return self.recording.film(path, **look)
        with tempfile.TemporaryDirectory() as folder:
            run(Scenario(self.scenario, set={"output.record": True}), out=folder, replace=True)
            return film(os.path.join(folder, "run.mcap"), path, **look)

    def __getitem__(self, name: str) -> Any:
        if name not in self.row:
            raise KeyError(f"{name!r}; the columns are {', '.join(self.row)}")
        return self.row[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.row)

    def __len__(self) -> int:
        return len(self.row)

    def __repr__(self) -> str:
        end = (
            f"complete after {self.row['completion_time_s']:.1f} s"
            if self.complete
            else f"not complete after {self.row['time_s']:.1f} s"
        )
        return f"<banyan.Result {self.scenario.name}, {self.row['algorithm']}, seed {self.row['seed']}: {end}>"

    def _repr_svg_(self) -> str:
        return self.frame._repr_svg_()


def _shown(share: float, time_s: float) -> None:
    if sys.stderr.isatty():
        sys.stderr.write(f"\r\033[K{time_s:.1f} s of the run, {min(share, 1):.0%} of its limit")
        sys.stderr.flush()


def run(
    scenario: str | os.PathLike[str] | Mapping[str, Any] | Scenario,
    *,
    algorithm: str | None = None,
    seed: int | None = None,
    parameters: Mapping[str, float] | None = None,
    set: Mapping[str, Any] | None = None,
    with_files: Any = (),
    controller: Any = None,
    controllers: Mapping[str, Any] | None = None,
    out: str | os.PathLike[str] | None = None,
    replace: bool = False,
    series: bool = False,
    trajectories: bool | int = False,
    threads: int = 1,
    progress: bool | Callable[[float, float], None] = False,
) -> Result:
    """A run from the start to the end of the mission, bit for bit that of `banyan run`.

    The first keywords are those of Scenario. `out`: a folder for the files of `banyan run`; existing ones stay unless
    `replace`. `series`: keep the metrics of every tick. `trajectories`: keep poses, roles and parents, of every nth
    tick. `progress`: True, or a function of (share of the time limit, time in s). Ctrl-C ends it. Other threads run
    meanwhile.
    """
    keys = dict(
        algorithm=algorithm,
        seed=seed,
        parameters=parameters,
        set=set,
        with_files=with_files,
        controller=controller,
        controllers=controllers,
    )
    scenario = scenario_of(scenario, keys)
    if threads < 1:
        raise ValueError(f"threads: is {threads}; at least 1")
    folder = None if out is None else str(Path(out))
    told = _core.run(
        scenario._core,
        folder or "",
        replace,
        series,
        int(trajectories),
        threads,
        (_shown if progress is True else progress) or None,
    )
    if progress is True and sys.stderr.isatty():
        sys.stderr.write("\r\033[K")
    return Result(told, scenario, folder)
