# SPDX-License-Identifier: MIT
# The wheel: CMake builds the extension module and the program (which makes films), and its install rules say what is in
# the package. With BANYAN_BUILD=FOLDER a build that is there already is used.
import os
import re
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

here = Path(__file__).resolve().parent
version = re.search(r"project\(banyan VERSION ([0-9.]+)", (here / "CMakeLists.txt").read_text(encoding="utf-8"))[1]


class Build(build_ext):
    def run(self):
        build = os.environ.get("BANYAN_BUILD")
        if not build:
            build = str(here / "build" / "pip")
            generator = ["-G", "Ninja"] if self.has_ninja() else []
            subprocess.run(
                [
                    "cmake",
                    "-S",
                    here,
                    "-B",
                    build,
                    *generator,
                    "-DCMAKE_BUILD_TYPE=Release",
                    "-DBANYAN_BUILD_TESTS=OFF",
                    "-DBANYAN_BUILD_EXAMPLES=OFF",
                    "-DBANYAN_JOIN=ON",
                    "-DBANYAN_BUILD_PYTHON=ON",
                    f"-DPython_EXECUTABLE={sys.executable}",
                ],
                check=True,
            )
            subprocess.run(
                [
                    "cmake",
                    "--build",
                    build,
                    "--parallel",
                    str(os.cpu_count() or 1),
                    "--target",
                    "banyan_python",
                    "banyan_cli",
                ],
                check=True,
            )
        target = Path(self.build_lib).resolve() if not self.inplace else here / "hosts" / "python"
        subprocess.run(["cmake", "--install", build, "--component", "wheel", "--prefix", target, "--strip"], check=True)

    @staticmethod
    def has_ninja():
        return any(
            os.access(Path(folder) / "ninja", os.X_OK) for folder in os.environ.get("PATH", "").split(os.pathsep)
        )


setup(version=version, ext_modules=[Extension("banyan._core", [])], cmdclass={"build_ext": Build})
