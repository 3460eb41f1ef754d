# SPDX-License-Identifier: MIT
"""Where the files are that come with Banyan: scenarios, studies, and the program that makes films."""

from __future__ import annotations

import os
import shutil
import sys
from pathlib import Path

from . import _core

_here = Path(__file__).parent  # of the package, installed or in a build
_built = Path(_core.__file__).parent  # the same, but in an editable installation
_prefix = [*_here.parents][3:4]  # of PREFIX/lib/python3/dist-packages/banyan
_source = Path(__file__).resolve().parent  # in a clone, its hosts/python/banyan


def _roots() -> list[Path]:
    """Folders that have scenarios/ and studies/: of a wheel, of a clone, of an installation."""
    prefixes = [*_prefix, Path(sys.prefix), Path("/usr/local"), Path("/usr")]
    return [
        _built / "share" / "banyan",
        *[*_source.parents][2:3],
        *(prefix / "share" / "banyan" for prefix in prefixes),
    ]


def find(path: str | os.PathLike[str]) -> str:
    """The file itself if it is there, else the one of that name that came with Banyan."""
    path = Path(path)
    if not path.is_absolute() and not path.exists():
        for root in _roots():
            if (root / path).is_file():
                return str(root / path)
    return str(path)


def program() -> str:
    """The `banyan` program: BANYAN_PROGRAM, that of the package, of the build, on PATH."""
    named = os.environ.get("BANYAN_PROGRAM")
    folders = [_built, _built.parents[1], *_prefix]
    candidates = [named] if named else [*(folder / "bin" / "banyan" for folder in folders), shutil.which("banyan")]
    for candidate in candidates:
        if candidate and os.access(candidate, os.X_OK) and os.path.isfile(candidate):
            return str(candidate)
    raise FileNotFoundError(
        f"BANYAN_PROGRAM names {named}, which is no program"
        if named
        else "the program `banyan`, which makes films, is not there; build it, or set BANYAN_PROGRAM to its path"
    )
