# SPDX-License-Identifier: MIT
"""Many runs: the studies of `banyan study`, from Python."""

from __future__ import annotations

import json
import os
import sys
import time
import warnings
from pathlib import Path
from typing import Any, Callable, Mapping

from . import _core
from .controllers import described
from .places import find
from .recordings import Recording
from .runs import changes_of
from .tables import Table, frame_or_table


class _Progress:
    """A line on a terminal, rewritten twice a second."""

    def __init__(self) -> None:
        self.begun = self.shown = time.monotonic()

    def __call__(self, done: int, wanted: int, failed: int, share: float) -> None:
        now = time.monotonic()
        if now - self.shown < 0.5 or not sys.stderr.isatty():
            return
        self.shown = now
        left = f", {(now - self.begun) * (1 - share) / share:.0f} s left" if share > 0.02 else ""
        sys.stderr.write(f"\r\033[K{done} of {wanted} runs, {failed} failed{left}")
        sys.stderr.flush()

    def end(self) -> None:
        if sys.stderr.isatty():
            sys.stderr.write("\r\033[K")


def study(
    source: str | os.PathLike[str] | Mapping[str, Any],
    *,
    relative_to: str | os.PathLike[str] = ".",
    out: str | os.PathLike[str] | None = None,
    set: Mapping[str, Any] | None = None,
    with_files: Any = (),
    controllers: Mapping[str, Any] | None = None,
    threads: int = 0,
    shard: tuple[int, int] = (1, 1),
    replace: bool = False,
    retry: bool = False,
    extend: bool = False,
    mix_versions: bool = False,
    progress: bool | Callable[[int, int, int, float], None] = True,
    pandas: bool | None = None,
) -> Any:
    """A study (docs/studies.md), in the same folder and with the same files as by `banyan study`.

    source       a TOML file, or a dict of its keys, whose paths are relative to the folder `relative_to`
    out          its folder, out/NAME if not given. What is there already is not done again, so a study that was
                 stopped, by Ctrl-C too, resumes with the same call
    set          keys of all its scenarios, {"radio.loss": 0.3}; with_files: files laid over
    controllers  of your own by name, for mission.algorithm: a row beside the others. They share one core, since Python
                 has one lock; start several processes with shard=(i, n) for more. Results that were made by another
                 version of a controller are refused (docs/python.md says what tells versions apart)
    threads      0: all cores
    replace      throws away what is in the folder and starts over, as the command's --force
    retry        does anew the runs that have failed, and those of controllers that have changed since
    extend, mix_versions          as the command's options
    progress     True: a line on a terminal; or a function of (done, wanted, failed, share)

    Returns the table of runs, a row for each: a pandas.DataFrame where pandas is installed (pandas=False: never, True:
    always), else a banyan.Table. Runs that failed have a text in the column `error`.
    """
    if isinstance(source, Mapping):
        path, text = str(Path(relative_to) / "study.json"), json.dumps(source, default=lambda value: value.tolist())
    else:
        path, text = find(source), None
    number, count = shard
    if not 1 <= number <= count:
        raise ValueError(f"shard: is ({number}, {count}); the first counts from 1 to the second")
    if replace and count > 1:
        raise ValueError("replace: would throw away the other shards, too; remove the folder first, or choose another")
    if threads < 0:
        raise ValueError(f"threads: is {threads}; 0 means all cores")
    own = [described(each, name, told_apart=True) for name, each in (controllers or {}).items()]
    told = _Progress() if progress is True else progress or None
    try:
        done = _core.study(
            path,
            text,
            changes_of(set, with_files),
            own,
            "" if out is None else str(Path(out)),
            threads,
            number,
            count,
            replace,
            retry,
            extend,
            mix_versions,
            (sys.executable or "python3", str(Path(__file__).with_name("figures.py"))),
            told,
        )
    finally:
        if isinstance(told, _Progress):
            told.end()
    if done["complaint"]:
        warnings.warn(done["complaint"], stacklevel=2)
    return frame_or_table(Table.from_csv(done["csv"]), pandas)


def read(path: str | os.PathLike[str], *, pandas: bool | None = None) -> Any:
    """What Banyan has written: a recording (run.mcap) as a Recording; a table (.csv), or the folder of a study or of a
    run, as study() returns it."""
    path = Path(path)
    if path.is_dir():
        for name in ("runs.csv", "run.csv"):
            if (path / name).is_file():
                path = path / name
                break
        else:
            raise FileNotFoundError(f"{path} holds no runs.csv of a study and no run.csv of a run")
    if path.suffix == ".csv":
        return frame_or_table(Table.from_csv(path.read_text(encoding="utf-8")), pandas)
    return Recording(path)
