# SPDX-License-Identifier: MIT
"""Robots whose bases are autopilots: hub and robots are Banyan's, vehicles those of autopilots.py, by pymavlink.
BANYAN_PROGRAM is the program; clocks are five times as fast as the wall's."""
import contextlib
import math
import os
import pathlib
import random
import signal
import socket
import subprocess
import time

import pytest

import autopilots
from autopilots import Airfield, Vehicle

PROGRAM = os.environ["BANYAN_PROGRAM"]
HOUSE = pathlib.Path(__file__).resolve().parents[3]
SCENARIO = HOUSE / "scenarios" / "khepera-three-targets.toml"
SPEED, COUNT, HEIGHT_M = 5.0, 9, 2.0
GRID = [(0.32 * (i % 3 - 1), 0.32 * (i // 3 - 1)) for i in range(COUNT)]


def free_ports(count):
    sockets = [socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Robots:
    """Nine robot processes, each with its vehicle, and where their hub is."""

    def __init__(self, folder, home="file", algorithm="outwards", **of_vehicles):
        self.folder, self.processes = folder, []
        self.hub_port, self.poses_port, *self.ports = free_ports(2 + COUNT)
        subprocess.run([PROGRAM, "hub", "--new-key", "fleet.key"], cwd=folder, check=True)
        dice = random.Random(1)
        self.vehicles = [
            Vehicle(1 + i, ("127.0.0.1", self.ports[i]), *GRID[i], home=(dice.uniform(-50, 50), dice.uniform(-50, 50)),
                    **of_vehicles) for i in range(COUNT)]
        (folder / "homes.txt").write_text(
            "# robot east north\n" + "".join(f"{i} {v.home[0]} {v.home[1]}\n" for i, v in enumerate(self.vehicles)))
        self.home = {"file": "homes.txt", "globe": "%f,%f" % autopilots.ORIGIN}.get(home, home)
        for i in range(COUNT):
            self.start(i, algorithm)

    def start(self, i, algorithm):
        command = [PROGRAM, "robot", "--id", i, "--hub", f"127.0.0.1:{self.hub_port}", "--key", "fleet.key",
                   "--algorithm", algorithm, "--speed", SPEED, "--base", f"mavlink:udp:127.0.0.1:{self.ports[i]}",
                   "--height", HEIGHT_M, "--home", self.home]
        if self.home != "tracker":
            command += ["--poses", f"127.0.0.1:{self.poses_port}"]
        with open(self.folder / f"robot-{i}.txt", "w") as errors:
            self.processes.append(subprocess.Popen([str(word) for word in command], cwd=self.folder, stderr=errors))

    def said(self, i):
        return (self.folder / f"robot-{i}.txt").read_text()

    def hub(self, *more, algorithm="outwards"):
        return [PROGRAM, "hub", str(SCENARIO), "--key", "fleet.key", "--listen", f"127.0.0.1:{self.hub_port}", "--poses",
                f"127.0.0.1:{self.poses_port}", "--speed", str(SPEED), "--out", "result", "--force", "--set",
                f"mission.algorithm={algorithm}", *more]

    def end(self):
        for process in self.processes:
            process.kill()
            process.wait()


@contextlib.contextmanager
def airfield(folder, **options):
    robots = Robots(folder, **options)
    try:
        with Airfield(robots.vehicles, SPEED) as field:
            yield robots, field
    finally:
        robots.end()


def run_hub(robots, *more, **how):
    return subprocess.run(robots.hub(*more, **how), cwd=robots.folder, capture_output=True, text=True, timeout=60)


def becomes(so, seconds=20.0):
    end = time.monotonic() + seconds
    while not so():
        if time.monotonic() > end:
            return False
        time.sleep(0.02)
    return True


def expect_complete(robots, outcome):
    assert outcome.returncode == 0, outcome.stderr + "".join(map(robots.said, range(COUNT)))
    assert "COMPLETE after" in outcome.stdout, outcome.stdout
    assert "in one piece at every tick" in outcome.stdout, outcome.stdout
    for process in robots.processes:
        assert process.wait(timeout=10) == 0  # the hub has stopped it


def test_committed_packets_are_those_of_pymavlink():
    committed = (HOUSE / "hosts/udp/test/mavlink_frames.txt").read_text()
    assert committed == autopilots.frames_text()


@pytest.mark.parametrize("home, version, odometry", [("file", 2, False), ("globe", 1, False), ("file", 2, True)])
def test_nine_vehicles_complete_a_mission(tmp_path, home, version, odometry):
    with airfield(tmp_path, home=home, version=version, odometry=odometry) as (robots, field):
        expect_complete(robots, run_hub(robots))
        vehicles = robots.vehicles
        for vehicle in vehicles:
            assert set(vehicle.received) == {"HEARTBEAT", "SET_POSITION_TARGET_LOCAL_NED"}, "no arming, no modes"
            assert -vehicle.down == pytest.approx(HEIGHT_M, abs=0.1)
            flown_s = vehicle.order_times[-1] - vehicle.order_times[0]
            assert len(vehicle.order_times) > 4 * flown_s > 10, "at least four set-points a second"
        assert max(math.dist(v.place(), GRID[i]) for i, v in enumerate(vehicles)) > 1.0, "they have flown"
        # Set-points end with the robots' programs, and so does the mode.
        assert becomes(lambda: not any(vehicle.offboard for vehicle in vehicles))
