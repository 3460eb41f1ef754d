# SPDX-License-Identifier: MIT
"""Where the tests find the program, and worlds that are used again and again."""

import json
import os
import subprocess
from pathlib import Path

import pytest

import banyan
from banyan.places import program

HOUSE = Path(__file__).resolve().parents[3]


@pytest.fixture(autouse=True)
def in_the_house(monkeypatch):
    monkeypatch.chdir(HOUSE)


@pytest.fixture
def command():
    """Calls the program: command("run", ...) -> what it printed, as JSON if it is JSON."""

    def call(*arguments):
        done = subprocess.run([program(), *map(str, arguments)], capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout) if done.stdout.startswith("{") else done.stdout

    return call


@pytest.fixture
def pixels(command):
    """For tests that make films: nothing without the library that draws them."""
    if "pixels" in command("--version").partition("without:")[2]:
        pytest.skip("this banyan was built without pixels")


@pytest.fixture
def small():
    """18 robots, three targets 3 m away, no line of sight needed."""
    return banyan.Scenario("scenarios/three-targets.toml")
