# SPDX-License-Identifier: MIT
"""Recordings as arrays, tables, pictures and films."""

from __future__ import annotations

import json
import os
import subprocess
import warnings
from typing import Any

import numpy as np

from . import _core
from .places import program
from .tables import Table, column


_look = ("fps", "speed", "from_s", "to_s", "width", "height", "trail_s", "links", "blocked", "ids", "legend", "dark")


def film(recording: str, path: str | os.PathLike[str], *, replace: bool = False, **look: Any) -> str:
    """Has the program `banyan film` make it. Options are those of the command: speed=4, dark=True, from_s=10."""
    command = [program(), "film", recording, "-o", os.fspath(path), "--quiet", *(["--force"] if replace else [])]
    for name, value in look.items():
        if name not in _look:
            raise TypeError(f"a film has no option {name!r}; it has {', '.join(_look)}")
        name = name.removesuffix("_s").replace("_", "-")  # from_s: `from` is a word of Python
        if isinstance(value, bool):
            command += [f"--{name}"] if value else [f"--no-{name}"] if name in ("links", "legend") else []
        elif value is not None:
            command += [f"--{name}", str(value)]
    done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(done.stderr.strip().removeprefix("banyan: ") or f"banyan film ended with {done.returncode}")
    return os.fspath(path)


class Recording(_core.Recording):
    """A recording, `run.mcap`. In its arrays F is the number of frames, N that of robots:

    time_s, ticks     (F,)
    positions         (F, N, 2)  m;  headings_rad (F, N)
    roles             (F, N)     spare 0, connector 1, worker 2, root 3
    parents, old_parents, serves (F, N)  robots, and for serves the target's index; -1: nobody
    alive             (F, N)     bool

    A robot that joins later is not alive before, and its position is NaN.
    """

    _arrays: dict[str, np.ndarray] | None = None

    def __init__(self, path: str | os.PathLike[str]) -> None:
        super().__init__(os.fspath(path))
        for warning in self.warnings:
            warnings.warn(f"{path}: {warning}", stacklevel=2)

    def __getattr__(self, name: str) -> Any:
        names = {"time_s", "ticks", "positions", "headings_rad", "roles", "parents", "old_parents", "serves", "alive"}
        if name not in names:
            raise AttributeError(f"a recording has no {name!r}")
        if self._arrays is None:
            self._arrays = self.arrays()
        return self._arrays["tick" if name == "ticks" else name]

    @property
    def series(self) -> Table:
        """A row of metrics per tick."""
        return Table(super().series())

    @property
    def events(self) -> Table:
        """What happened: time_s, tick, kind, robot, target (-1: none), text."""
        return Table.from_rows(super().events(), ("time_s", "tick", "kind", "robot", "target", "text"))

    @property
    def result(self) -> dict[str, Any]:
        """The row of the run; empty if the recording was cut short."""
        return {name: column(name, [text]).tolist()[0] for name, text in self.result_text.items()}

    @property
    def config(self) -> dict[str, Any]:
        """The complete configuration of the run."""
        return json.loads(self.config_json)

    def at(self, time_s: float, trail_s: float = 10.0) -> Any:
        """The frame at that time, with trails; shows itself as a picture."""
        return self.frame_at(float(time_s), float(trail_s))

    def film(self, path: str | os.PathLike[str], *, replace: bool = False, **look: Any) -> str:
        """A film (.mp4, .webm, .gif). Options are those of `banyan film`: speed=4, fps=30, width=640, dark=True."""
        return film(self.path, path, replace=replace, **look)

    def __repr__(self) -> str:
        return f"<banyan.Recording {self.path}: {len(self)} frames, {self.start_s:g} to {self.end_s:g} s>"

    def _repr_svg_(self) -> str:
        return self.at(self.end_s)._repr_svg_()
