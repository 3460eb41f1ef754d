# SPDX-License-Identifier: MIT
"""Recordings and bags in Rerun: it finds nothing wrong with them, and shows transforms and the log as what they are.
SAMPLES has what sample_files.cpp writes; `rerun` is on PATH."""

import collections
import os
import pathlib
import re
import shutil
import subprocess

import pytest

SAMPLES = pathlib.Path(os.environ["SAMPLES"])
WHOLE = sorted(file.name for file in SAMPLES.glob("*.mcap"))
CUT = sorted(file.name for file in SAMPLES.glob("*.mcap.part"))
ROBOTS = {"sample": 30, "world": 12, "cut": 9}


def rerun(home, *words):
    """In a home of its own: it is anybody's first session, in which nothing is told to anybody."""
    environment = os.environ | {"HOME": str(home), "XDG_CONFIG_HOME": str(home), "XDG_DATA_HOME": str(home)}
    done = subprocess.run(["rerun", *map(str, words)], env=environment, capture_output=True, text=True)
    assert done.returncode == 0 and "ERROR" not in done.stderr, done.stderr
    return done.stdout


def shown(home, file, *more):
    """{entity: {component: rows}} of what Rerun makes of a file"""
    rerun(home, "mcap", "convert", file, "-o", home / "it.rrd", *more)
    found = collections.defaultdict(collections.Counter)
    for rows, entity, columns in re.findall(r"with (\d+) rows \(.*?\) - (\S+) - data columns: \[(.*?)\]",
                                            rerun(home, "rrd", "print", home / "it.rrd")):
        for column in columns.split():
            found[entity][column] += int(rows)
    return found


def checked(home, file, *more):
    """{topic: status}"""
    rows = re.findall(r"^(\S+) +\d+ +\d+ +(/\S+)", rerun(home, "mcap", "check", "--full", file, *more), re.MULTILINE)
    return {topic: status for status, topic in rows}


@pytest.mark.parametrize("name", WHOLE)
def test_nothing_is_wrong_with_it(tmp_path, name):
    topics = checked(tmp_path, SAMPLES / name)
    assert set(topics.values()) <= {"ok"}
    assert ("/tf" in topics) == (not name.startswith(("early", "empty")))


@pytest.mark.parametrize("name", [f"{name}{bag}.mcap" for name in ["sample", "world"] for bag in ["", "-bag"]])
def test_it_shows_transforms_log_and_markers(tmp_path, name):
    found = shown(tmp_path, SAMPLES / name)
    robots = ROBOTS[name.removesuffix(".mcap").removesuffix("-bag")]
    markers = found["/markers"]["visualization_msgs.msg.MarkerArray:message"]
    assert markers > 10
    for component in ["Transform3D:translation", "Transform3D:quaternion", "Transform3D:child_frame"]:
        assert found["/tf"][component] == robots * markers
    assert found["/rosout"]["TextLog:text"] > 3
    assert found["/rosout"]["TextLog:text"] == found["/rosout"]["TextLog:level"]


@pytest.mark.parametrize("name", CUT)
def test_it_recovers_what_was_cut_short(tmp_path, name):
    file = tmp_path / name.removesuffix(".part")
    shutil.copy(SAMPLES / name, file)
    assert set(checked(tmp_path, file, "--recover").values()) <= {"ok"}
    found = shown(tmp_path, file, "--recover")
    assert (found["/tf"]["Transform3D:translation"] > 0) == (name != "early.mcap.part")
    assert (found["/banyan/frame"]["McapMessage:data"] > 0) == (name != "early.mcap.part")
