# SPDX-License-Identifier: MIT
"""install.py BUILD ENVIRONMENT: a wheel of the build that is there, by the way that pyproject.toml names, installed in
an environment that sees the system's numpy and pytest. What builds wheels comes from PyPI, once."""

import shutil
import subprocess
import sys
from pathlib import Path

HOUSE = Path(__file__).resolve().parents[3]


def call(*command):
    subprocess.run([str(word) for word in command], check=True)


def main(build, environment):
    python, wheels = environment / "bin" / "python", environment / "wheels"
    pip = [python, "-m", "pip", "--disable-pip-version-check", "--quiet"]
    if not (environment / "ready").exists():
        call(sys.executable, "-m", "venv", "--clear", "--system-site-packages", environment)
        call(*pip, "install", "scikit-build-core>=0.12")
        (environment / "ready").touch()
    shutil.rmtree(wheels, ignore_errors=True)
    settings = ("cmake.source-dir=hosts/python/ready", f"cmake.define.BANYAN_READY={build}", f"build-dir={build}/ready")
    settings = [f"--config-settings={setting}" for setting in settings]
    call(*pip, "wheel", "--no-build-isolation", "--no-deps", "--no-index", *settings, "-w", wheels, HOUSE)
    call(*pip, "install", "--no-index", "--no-deps", "--force-reinstall", *wheels.glob("*.whl"))


if __name__ == "__main__":
    main(*(Path(word).resolve() for word in sys.argv[1:]))
