# SPDX-License-Identifier: MIT
"""Why the compiled module cannot be loaded: most often it is for other versions of Python."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable
from pathlib import Path


def another(error: ImportError, folders: Iterable[str]) -> ImportError:
    """What to tell instead of `error`, or `error` itself if there is a module for this Python."""
    modules = [path.name for folder in folders for path in Path(folder).glob("_core.*.so")]
    tag = sys.implementation.cache_tag  # cpython-311
    if any(f".{tag}-" in name for name in modules):
        return error
    built = sorted(re.findall(r"\.cpython-3(\d+)-(\w+)", " ".join(modules)), key=lambda found: int(found[0]))
    of = ", ".join(f"3.{minor}" for minor, _ in built)
    this = f"{sys.implementation.name} {sys.version_info.major}.{sys.version_info.minor}"
    if not built:
        return ImportError("banyan's compiled module is not here; install banyan-swarm again")
    return ImportError(
        f"this banyan was built for CPython {of}; this is {this}. Take one of those, or build it here (docs/python.md)"
    )
