# SPDX-License-Identifier: MIT
"""Runs from Python are those of the program, bit for bit, and say as exactly what is wrong."""

import signal
import threading
import time

import numpy as np
import pytest

import banyan

CASES = [
    ("scenarios/three-targets.toml", "convoy", 1, {}),
    ("scenarios/paper-small.toml", "inwards", 3, {"radio.loss": 0.2}),
    ("scenarios/deaths.toml", "convoy", 2, {}),
    ("scenarios/wall-with-gap.toml", "cohesion", 1, {"mission.time_limit_s": 20, "radio.latency_ticks": 3}),
]


@pytest.mark.parametrize("file,algorithm,seed,keys", CASES)
def test_same_bits_as_the_program(file, algorithm, seed, keys, command, tmp_path):
    sets = [word for key, value in keys.items() for word in ("--set", f"{key}={value}")]
    program = command(
        "run",
        file,
        "--set",
        f"mission.algorithm={algorithm}",
        "--seed",
        seed,
        *sets,
        "--json",
        "--out",
        tmp_path / "run",
    )["result"]
    result = banyan.run(file, algorithm=algorithm, seed=seed, set=keys)
    assert f"{result.hash:016x}" == program["hash"]
    for column, value in program.items():
        assert result[column] == (pytest.approx(value, abs=1e-3) if isinstance(value, float) else value), column


def test_a_seed_more_is_another_run():
    hashes = {
        banyan.run("scenarios/three-targets.toml", seed=seed, set={"mission.time_limit_s": 1}).hash
        for seed in (1, 2, 3)
    }
    assert len(hashes) == 3


def test_a_live_recording_is_read_while_a_controller_in_python_runs(tmp_path):
    seen = {}

    class Slow(banyan.Policy):
        """stands still, and pauses once"""

        def reset(self, swarm):
            self.robots, self.steps = swarm.robots, 0

        def step(self, _):
            self.steps += 1
            if self.steps == 10:
                time.sleep(1.1)
            if self.steps == 12:
                with pytest.warns(UserWarning, match="cut short"):
                    watched = banyan.read(tmp_path / "run.mcap.part")
                seen.update(frames=len(watched), robots=watched.positions.shape[1], config=watched.config_json)
            return banyan.Actions(np.zeros((self.robots, 2)))

    keys = {"mission.time_limit_s": 2, "output.live": True}
    banyan.run("scenarios/three-targets.toml", controller=Slow, set=keys, out=tmp_path, replace=True)
    assert 10 <= seen["frames"] <= 12
    assert seen["robots"] == 18
    assert '"live":true' in seen["config"].replace(" ", "")
    assert len(banyan.read(tmp_path / "run.mcap")) == 21


def test_files_are_those_of_the_program(command, tmp_path):
    command("run", "scenarios/three-targets.toml", "--set", "output.series=true", "--out", tmp_path / "program")
    result = banyan.run("scenarios/three-targets.toml", set={"output.series": True}, out=tmp_path / "python")
    for name in ("run.mcap", "run.csv", "run.json", "series.csv"):
        assert (tmp_path / "python" / name).read_bytes() == (tmp_path / "program" / name).read_bytes(), name
    assert banyan.read(tmp_path / "python", pandas=False)["hash"][0] == f"{result.hash:016x}"
    with pytest.raises(OSError, match="exists"):
        banyan.run("scenarios/three-targets.toml", out=tmp_path / "python")
    banyan.run("scenarios/three-targets.toml", out=tmp_path / "python", replace=True)


def test_series_and_trajectories():
    result = banyan.run("scenarios/three-targets.toml", series=True, trajectories=5)
    ticks = result["ticks"]
    assert len(result.series) == ticks
    assert result.series["targets_reached"][-1] == 3
    tracks = result.trajectories
    frames = 1 + ticks // 5
    assert tracks["positions"].shape == (frames, 18, 2) and tracks["roles"].shape == (frames, 18)
    assert np.allclose(np.hypot(*tracks["headings"].T), 1)
    assert tracks["time_s"][0] == 0 and tracks["time_s"][1] == pytest.approx(0.5)
    world = banyan.World("scenarios/three-targets.toml")
    world.step(5)
    assert np.array_equal(tracks["positions"][1], world.positions)


def test_scenarios_from_dicts_and_back():
    keys = {"name": "mine", "targets": {"layout": "list", "positions_m": [[3, 0], [0, 2.5]]}, "swarm": {"robots": 12}}
    scenario = banyan.Scenario(keys, algorithm="inwards", seed=5, parameters={"target_gain": 0.9})
    assert (scenario.name, scenario.robots, scenario.algorithm, scenario.seed) == ("mine", 12, "inwards", 5)
    assert scenario.to_dict()["mission"]["parameters"]["target_gain"] == pytest.approx(0.9)
    again = banyan.Scenario(scenario.to_dict())
    assert banyan.run(again).hash == banyan.run(scenario).hash
    assert banyan.run(scenario, seed=6).hash != banyan.run(scenario).hash


def test_everything_wrong_is_said_at_once():
    with pytest.raises(banyan.ScenarioError) as told:
        banyan.run("scenarios/three-targets.toml", set={"radio.los": 0.3, "radio.range_m": -1}, algorithm="convey")
    text = str(told.value)
    assert "radio.los" in text and "loss" in text and "radio.range_m" in text and "convoy" in text
    with pytest.raises(ValueError, match="no such file|No such file"):
        banyan.run("scenarios/no-such-file.toml")
    with pytest.raises(banyan.ScenarioError, match="nan"):
        banyan.run("scenarios/three-targets.toml", set={"radio.loss": float("nan")})
    with pytest.raises(TypeError, match="cannot be"):
        banyan.run("scenarios/three-targets.toml", set={"radio.loss": object()})
    with pytest.raises(banyan.ScenarioError, match="target_gian"):
        banyan.run("scenarios/three-targets.toml", parameters={"target_gian": 1})


def test_parameters_change_what_happens():
    defaults = banyan.parameters("convoy")
    name = next(iter(defaults))
    row = banyan.algorithms["convoy"]["parameters"][0]
    assert row["key"] == name and row["minimum"] <= defaults[name] <= row["maximum"]
    same = banyan.run("scenarios/three-targets.toml", parameters={"target_gain": defaults["target_gain"]})
    other = banyan.run("scenarios/three-targets.toml", parameters={"target_gain": defaults["target_gain"] / 2})
    assert same.hash == banyan.run("scenarios/three-targets.toml").hash != other.hash
    with pytest.raises(ValueError, match="no algorithm"):
        banyan.parameters("convey")


def test_ctrl_c_ends_a_run_and_a_world():
    for call in (
        lambda: banyan.run(
            "scenarios/swarm-1000.toml", set={"mission.time_limit_s": 1e6, "mission.stop_when_complete": False}
        ),
        lambda: banyan.World("scenarios/paper-large.toml").step(10**9),
    ):
        timer = threading.Timer(0.3, signal.raise_signal, [signal.SIGINT])
        timer.start()
        begun = time.monotonic()
        with pytest.raises(KeyboardInterrupt):
            call()
        assert time.monotonic() - begun < 20
        timer.join()


def test_progress_is_told_and_may_raise():
    told = []
    scenario = banyan.Scenario(
        "scenarios/paper-large.toml", set={"mission.stop_when_complete": False, "mission.time_limit_s": 100000}
    )

    def stop(share, time_s):
        told.append((share, time_s))
        raise InterruptedError("enough")

    with pytest.raises(InterruptedError, match="enough"):
        banyan.run(scenario, progress=stop)
    assert told and 0 < told[0][0] < 1
