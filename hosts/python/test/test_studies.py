# SPDX-License-Identifier: MIT
"""Studies from Python: the folders of the program, resumable; recordings and tables."""

import signal
import subprocess
import threading
import time

import numpy as np
import pytest

import banyan
from banyan.places import program

STUDY = {
    "name": "small",
    "scenario": "scenarios/three-targets.toml",
    "seeds": "1-4",
    "axes": [{"key": "mission.algorithm", "values": ["convoy", "inwards"], "name": "algorithm"}],
}


def text_of(study, folder):
    path = folder / "small.toml"
    path.write_text(
        f"""name = "small"
scenario = "{banyan.places.Path.cwd()}/scenarios/three-targets.toml"
seeds = "1-4"
[[axes]]
name = "algorithm"
key = "mission.algorithm"
values = ["convoy", "inwards"]
"""
    )
    return path


def test_the_folder_is_that_of_the_program(tmp_path):
    path = text_of(STUDY, tmp_path)
    table = banyan.study(path, out=tmp_path / "python", progress=False, pandas=False)
    subprocess.run([program(), "study", path, "--out", tmp_path / "program", "--quiet"], check=True)
    for name in ("runs.csv", "statistics.csv", "comparisons.csv"):
        assert (tmp_path / "python" / name).read_bytes() == (tmp_path / "program" / name).read_bytes(), name
    assert len(table) == 8 and table["complete"].all() and set(table["algorithm"]) == {"convoy", "inwards"}
    # What the program has begun, Python knows to be done; and the other way round.
    told = []
    banyan.study(path, out=tmp_path / "program", progress=lambda *now: told.append(now))
    assert not told
    again = banyan.read(tmp_path / "program", pandas=False)
    assert np.array_equal(again["hash"], table["hash"])
    row = next(row for row in table.rows() if row["algorithm"] == "inwards" and row["seed"] == 2)
    assert row["hash"] == banyan.run("scenarios/three-targets.toml", algorithm="inwards", seed=2)["hash"]


def test_pandas(tmp_path):
    pandas = pytest.importorskip("pandas")
    frame = banyan.study(STUDY, out=tmp_path / "s", progress=False)
    assert isinstance(frame, pandas.DataFrame)
    medians = frame.groupby("algorithm")["completion_time_s"].median()
    assert medians["convoy"] < medians["inwards"]
    assert isinstance(banyan.read(tmp_path / "s"), pandas.DataFrame)
    assert isinstance(banyan.run("scenarios/three-targets.toml", series=True).series.to_pandas(), pandas.DataFrame)


def test_a_controller_beside_the_others(tmp_path):
    class Straight(banyan.Policy):
        """workers drive straight on"""

        def reset(self, swarm):
            self.swarm = swarm

        def step(self, seen):
            return self.swarm.drive(np.where(seen.has_target[:, None], seen.target, 0))

    study = {**STUDY, "axes": [{"key": "mission.algorithm", "values": ["convoy", "straight"], "name": "algorithm"}]}
    table = banyan.study(
        study, out=tmp_path / "s", controllers={"straight": Straight}, threads=2, progress=False, pandas=False
    )
    mine = table["algorithm"] == "straight"
    assert mine.sum() == 4 and not table["complete"][mine].any() and table["complete"][~mine].all()
    assert (table["split_ticks"][mine] > 0).all()
    assert table["hash"][mine][0] == banyan.run("scenarios/three-targets.toml", controller=Straight, seed=1)["hash"]
    with pytest.raises(banyan.ScenarioError, match="straight"):
        banyan.study(study, out=tmp_path / "t", progress=False)

    class Fails(banyan.Policy):
        def step(self, seen):
            raise ArithmeticError("no idea")

    table = banyan.study(study, out=tmp_path / "u", controllers={"straight": Fails}, progress=False, pandas=False)
    assert sum("no idea" in error for error in table["error"]) == 4


CONTEST = {
    "name": "told-apart",
    "scenario": "scenarios/three-targets.toml",
    "seeds": "1-3",
    "set": {"mission.time_limit_s": 2},
    "axes": [{"key": "mission.algorithm", "values": ["convoy", "mine"], "name": "algorithm"}],
}


def hashes(table, algorithm="mine"):
    return table["hash"][table["algorithm"] == algorithm].tolist()


class Turns(banyan.Policy):
    speed = 0.1

    def step(self, seen):
        return np.full((18, 2), self.speed)


@pytest.mark.parametrize("finished", [True, False])
def test_rows_of_another_version_are_refused(tmp_path, monkeypatch, finished):
    def study(**keys):
        told = []
        keys = {"controllers": {"mine": Turns}, "out": tmp_path / "s", "pandas": False, **keys}
        table = banyan.study(CONTEST, progress=lambda *now: told.append(now), **keys)
        return table, told[-1][1] if told else 0  # runs done

    if finished:
        first, done = study()
        assert done == 6
    else:
        first, _ = study(shard=(1, 2))
    monkeypatch.setattr(Turns, "speed", 0.2)
    before = sorted((tmp_path / "s").rglob("*"))
    with pytest.raises(ValueError, match='"mine".*another version') as refusal:
        study()
    for way in ("retry=True", "replace=True", "another folder by out="):
        assert way in str(refusal.value)
    assert sorted((tmp_path / "s").rglob("*")) == before
    other, done = study(out=tmp_path / "other")
    assert done == 6 and not set(hashes(other)) & set(hashes(first))
    again, done = study(retry=True)  # only its own runs
    assert done == (3 if finished else 4)
    assert hashes(again) == hashes(other) and hashes(again, "convoy") == hashes(other, "convoy")
    assert study()[1] == 0 and hashes(study()[0]) == hashes(other)
    if finished:  # the first version's rows are still known to be its own
        monkeypatch.setattr(Turns, "speed", 0.1)
        back, done = study()
        assert done == 0 and hashes(back) == hashes(first)
        monkeypatch.setattr(Turns, "speed", 0.3)
    fresh, done = study(replace=True)
    assert done == 6 and len(fresh) == 6
    with pytest.raises(ValueError, match="replace"):
        study(replace=True, shard=(1, 2))


def test_shards_and_resumption_go_on_with_the_same_version(tmp_path):
    for number in (1, 2):
        banyan.study(CONTEST, controllers={"mine": Turns}, out=tmp_path / "s", shard=(number, 2), progress=False)
    told = []
    again = {"controllers": {"mine": Turns}, "out": tmp_path / "s", "progress": lambda *now: told.append(now)}
    assert len(banyan.study(CONTEST, **again)) == 6 and not told
    assert len(banyan.study({**CONTEST, "seeds": "1-4"}, extend=True, **again)) == 8
    assert told[-1][:2] == (2, 2)  # done, wanted


def test_replace_leaves_what_is_no_study_alone(tmp_path):
    (tmp_path / "runs.csv").write_text("mine")
    with pytest.raises(ValueError, match="not of a study"):
        banyan.study(CONTEST, controllers={"mine": Turns}, out=tmp_path, progress=False, replace=True)
    assert (tmp_path / "runs.csv").read_text() == "mine"


def test_ctrl_c_stops_and_the_same_call_resumes(tmp_path):
    study = {**STUDY, "scenario": "scenarios/paper-medium.toml", "seeds": "1-5"}
    timer = threading.Timer(0.2, signal.raise_signal, [signal.SIGINT])
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        banyan.study(study, out=tmp_path / "s", progress=False)
    timer.join()
    told = []
    table = banyan.study(study, out=tmp_path / "s", progress=lambda *now: told.append(now), pandas=False)
    assert len(table) == 10 and told[-1][1] < 10  # some were done already


def test_what_is_wrong_is_said(tmp_path):
    for change, words in (
        ({"seeds": "4-1"}, "seeds"),
        ({"axis": []}, "axes"),
        ({"scenario": "scenarios/none.toml"}, "none.toml"),
    ):
        with pytest.raises(banyan.ScenarioError, match=words):
            banyan.study({**STUDY, **change}, out=tmp_path / "s", progress=False)
    banyan.study({**STUDY, "seeds": [1]}, out=tmp_path / "s", progress=False)
    with pytest.raises(ValueError, match="another plan"):
        banyan.study({**STUDY, "seeds": [1, 2]}, out=tmp_path / "s", progress=False)
    assert (
        len(banyan.study({**STUDY, "seeds": [1, 2]}, out=tmp_path / "s", progress=False, extend=True, pandas=False))
        == 4
    )
    with pytest.raises(ValueError, match="shard"):
        banyan.study(STUDY, shard=(3, 2))
    with pytest.raises(OSError):
        banyan.read(tmp_path / "nothing.mcap")
    with pytest.raises(FileNotFoundError, match="holds no runs.csv"):
        banyan.read(tmp_path)


def test_shards_are_parts(tmp_path):
    for number in (1, 2):
        part = banyan.study(STUDY, out=tmp_path / "s", shard=(number, 2), progress=False, pandas=False)
    assert len(part) == 8
    whole = banyan.study(STUDY, out=tmp_path / "s", progress=False, pandas=False)
    assert len(whole) == 8 and (tmp_path / "s" / "statistics.csv").exists()


def test_a_recording_as_arrays(tmp_path):
    result = banyan.run("scenarios/three-targets.toml", out=tmp_path / "run", trajectories=1, series=True)
    recording = result.recording
    tracks = result.trajectories
    assert len(recording) == len(tracks["time_s"]) and recording.positions.shape == tracks["positions"].shape
    assert np.allclose(recording.positions, tracks["positions"], atol=1e-3)
    assert np.array_equal(recording.roles, tracks["roles"]) and np.array_equal(recording.parents, tracks["parents"])
    assert np.allclose(np.cos(recording.headings_rad), tracks["headings"][..., 0], atol=1e-3)
    assert np.array_equal(recording.series["targets_reached"][-10:], result.series["targets_reached"][-10:])
    assert "target_reached" in set(recording.events["kind"]) or len(recording.events) > 3
    assert (
        recording.result["hash"] == result["hash"]
        and recording.config["name"] == "three-targets"
        and recording.seed == 1
    )
    frame = recording.at(9.0)
    assert frame.time_s == pytest.approx(9.0) and frame.columns()["x_m"].shape == (18,)
    assert frame._repr_svg_().startswith("<svg") and recording._repr_svg_().startswith("<svg")
    with pytest.raises(AttributeError, match="no 'postions'"):
        recording.postions


@pytest.mark.usefixtures("pixels")
def test_films(tmp_path):
    world = banyan.World("scenarios/three-targets.toml")
    world.step(20)
    before = world.hash
    path = world.film(tmp_path / "world.gif", until_s=4.0, width=240, height=160, fps=5, speed=4)
    assert open(path, "rb").read(4) == b"GIF8" and world.hash == before
    result = banyan.run("scenarios/three-targets.toml", set={"mission.time_limit_s": 2})
    assert open(result.film(tmp_path / "run.gif", width=240, height=160, fps=5, links=False), "rb").read(4) == b"GIF8"
    with pytest.raises(RuntimeError, match="exists"):
        result.film(tmp_path / "run.gif")
    with pytest.raises(TypeError, match="no option 'fpz'"):
        result.film(tmp_path / "other.gif", fpz=5)
