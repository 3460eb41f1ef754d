# SPDX-License-Identifier: MIT
"""The program `banyan` on the path of a Python environment. It stands beside the package, which loads numpy first and
is for some versions of Python only."""

from __future__ import annotations

import importlib.util
import os
import sys
from pathlib import Path
from typing import NoReturn


def become(program: str) -> NoReturn:
    """Goes on as the program, with our arguments."""
    # Figures are drawn by the `python3` on the path: this environment's has what was installed beside us.
    here = os.path.dirname(sys.executable)
    os.environ["PATH"] = os.pathsep.join([here, os.environ.get("PATH", os.defpath)])
    os.execv(program, [program, *sys.argv[1:]])


def main() -> NoReturn:
    """The console script."""
    package = importlib.util.find_spec("banyan")
    # What an editable installation has built is not where its Python is.
    folders = [*(package.submodule_search_locations or [] if package else []), *(f"{path}/banyan" for path in sys.path)]
    for folder in folders:
        program = Path(folder, "bin", "banyan")
        if program.is_file() and os.access(program, os.X_OK):
            become(str(program))
    sys.exit("banyan: there is no program in the package; install banyan-swarm again")
