# SPDX-License-Identifier: MIT
"""`pip install --no-build-isolation .` in a virtual environment that sees Debian's packages; the build is the one that
is there (BANYAN_BUILD), since another would take minutes."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

HOUSE = Path(__file__).resolve().parents[3]


@pytest.mark.skipif("BANYAN_BUILD" not in os.environ, reason="no BANYAN_BUILD names a build")
def test_a_wheel_in_an_environment(tmp_path):
    environment = {
        name: value
        for name, value in os.environ.items()
        if name not in ("PYTHONPATH", "BANYAN_PROGRAM", "PYTHONDONTWRITEBYTECODE")
    }

    def call(*command, folder=HOUSE):
        done = subprocess.run(
            [str(word) for word in command], cwd=folder, env=environment, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout

    # What setuptools leaves behind stays out of the clone.
    source = tmp_path / "clone"
    source.mkdir()
    for name in ("pyproject.toml", "setup.py", "README.md", "CMakeLists.txt", "hosts"):
        (source / name).symlink_to(HOUSE / name)
    call(sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv")
    python = tmp_path / "venv" / "bin" / "python"
    call(python, "-m", "pip", "install", "--no-build-isolation", "--no-index", "--disable-pip-version-check", source)
    told = call(
        python,
        "-c",
        "import banyan; print(banyan.__file__); r = banyan.run('scenarios/three-targets.toml'); print(r.complete); "
        "print(banyan.places.program()); print(r.film('x.gif', width=240, height=160, fps=5))",
        folder=tmp_path,
    ).split()
    assert (
        told[0].startswith(str(tmp_path / "venv")) and told[1] == "True" and told[2].startswith(str(tmp_path / "venv"))
    )
    assert (tmp_path / "x.gif").read_bytes()[:4] == b"GIF8"
