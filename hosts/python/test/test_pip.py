# SPDX-License-Identifier: MIT
"""What pip installs, away from the clone: the module, the program and what comes with both."""

import importlib.metadata
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import banyan
from banyan import interpreters, places

HOUSE = Path(__file__).resolve().parents[3]
SCRIPT = Path(sys.prefix, "bin", "banyan")


@pytest.fixture
def call(tmp_path):
    """Calls a program in another folder, without what the tests set."""

    def call(*command, folder=tmp_path, status=0):
        environment = {n: v for n, v in os.environ.items() if n not in ("PYTHONPATH", "BANYAN_PROGRAM", "BANYAN_PAGE")}
        done = subprocess.run(
            [str(word) for word in command], cwd=folder, env=environment, capture_output=True, text=True, check=False
        )
        assert done.returncode == status, done.stdout + done.stderr
        return done.stdout

    return call


def test_the_package_is_the_installed_one():
    assert Path(banyan.__file__).is_relative_to(sys.prefix)
    assert Path(places.program()).is_relative_to(sys.prefix)
    assert importlib.metadata.version("banyan-swarm") == banyan.__version__


def test_the_program_knows_its_scenarios_and_studies(call):
    by_name = call(SCRIPT, "run", "three-targets", "--json", "--out", "a")
    by_file = call(
        sys.executable, "-m", "banyan", "run", HOUSE / "scenarios/three-targets.toml", "--json", "--out", "b"
    )
    assert '"hash"' in by_name
    assert by_name.replace("out/a", "").split('"hash"')[1][:30] == by_file.split('"hash"')[1][:30]
    call(SCRIPT, "run", "scenarios/three-targets.toml", "--quiet")
    call(SCRIPT, "study", "first", "--set", "mission.time_limit_s=5", "--out", "study", "--quiet")
    call(SCRIPT, "run", "four-targets", status=2)


def test_the_commands_that_are_programs_of_their_own(call):
    if "fleets" in call(SCRIPT, "--version").partition("without:")[2]:
        pytest.skip("this banyan was built without fleets")
    assert "banyan-robot" in call(SCRIPT, "robot", "--help")


@pytest.mark.usefixtures("pixels")
def test_a_film_in_another_folder(call, tmp_path):
    told = call(
        sys.executable,
        "-c",
        "import banyan; r = banyan.run('scenarios/three-targets.toml'); print(r.complete); "
        "r.film('x.gif', width=240, height=160, fps=5)",
    )
    assert told.split()[0] == "True"
    assert (tmp_path / "x.gif").read_bytes()[:4] == b"GIF8"


def test_another_python_is_told_which_there_are(tmp_path):
    for tag in ("39", "310"):
        (tmp_path / f"_core.cpython-{tag}-x86_64-linux-gnu.so").touch()
    told = str(interpreters.another(ImportError("no _core"), [str(tmp_path)]))
    assert "built for CPython 3.9, 3.10; this is cpython 3." in told
    here = ImportError("libm.so.6 is not there")
    (tmp_path / f"_core.{sys.implementation.cache_tag}-x86_64-linux-gnu.so").touch()
    assert interpreters.another(here, [str(tmp_path)]) is here


def test_an_editable_installation_leaves_nothing_in_the_clone(call, tmp_path):
    if not (HOUSE / ".git").exists() or shutil.which("git") is None:
        pytest.skip("no clone")
    build = os.environ["BANYAN_READY"]
    before = call("git", "-C", HOUSE, "status", "--porcelain")
    call(sys.executable, "-m", "venv", "--system-site-packages", tmp_path / "venv")
    # scikit-build-core is in the environment of this test.
    path = next(p for p in sys.path if Path(p, "scikit_build_core").is_dir())
    python = tmp_path / "venv" / "bin" / "python"
    packages = next((tmp_path / "venv" / "lib").glob("python*/site-packages"))
    (packages / "tools.pth").write_text(path + "\n", encoding="utf-8")
    settings = (
        "cmake.source-dir=hosts/python/ready",
        f"cmake.define.BANYAN_READY={build}",
        f"build-dir={tmp_path}/build",
    )
    pip = (python, "-m", "pip", "install", "--no-build-isolation", "--no-index", "--no-deps", "--ignore-installed")
    call(*pip, *(f"--config-settings={setting}" for setting in settings), "-e", HOUSE)
    told = call(python, "-c", "import banyan; print(banyan.__file__); print(banyan.places.program())").split()
    assert told[0] == str(HOUSE / "hosts/python/banyan/__init__.py") and told[1].startswith(str(tmp_path / "venv"))
    assert '"hash"' in call(tmp_path / "venv/bin/banyan", "run", "three-targets", "--json")
    assert call("git", "-C", HOUSE, "status", "--porcelain") == before
