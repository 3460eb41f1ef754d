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
import threading
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
    """Below those that the system hands out, to robots that begin meanwhile, too."""
    ports = []
    while len(ports) < count:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one:
            port = random.randrange(10000, 30000)
            with contextlib.suppress(OSError):
                one.bind(("127.0.0.1", port))
                ports += [port] * (port not in ports)
    return ports


class Robots:
    """Nine robot processes, each with its vehicle, and where their hub is."""

    def __init__(self, folder, home="file", holonomic=False, **of_vehicles):
        self.folder, self.processes, self.holonomic = folder, [], holonomic
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
            self.start(i)

    def start(self, i):
        command = [PROGRAM, "robot", "--id", i, "--hub", f"127.0.0.1:{self.hub_port}", "--key", "fleet.key",
                   "--algorithm", "outwards", "--speed", SPEED, "--base", f"mavlink:udp:127.0.0.1:{self.ports[i]}",
                   "--height", HEIGHT_M, "--home", self.home] + ["--holonomic"] * self.holonomic
        if self.home != "tracker":
            command += ["--poses", f"127.0.0.1:{self.poses_port}"]
        with open(self.folder / f"robot-{i}.txt", "w") as errors:
            self.processes.append(subprocess.Popen([str(word) for word in command], cwd=self.folder, stderr=errors))

    def said(self, i):
        return (self.folder / f"robot-{i}.txt").read_text()

    def hub(self):
        return [PROGRAM, "hub", str(SCENARIO), "--key", "fleet.key", "--listen", f"127.0.0.1:{self.hub_port}", "--poses",
                f"127.0.0.1:{self.poses_port}", "--speed", str(SPEED), "--out", "result", "--force",
                *["--set", "robot.body=linear"] * self.holonomic]

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


def run_hub(robots):
    return subprocess.run(robots.hub(), cwd=robots.folder, capture_output=True, text=True, timeout=60)


def becomes(so, seconds=20.0):
    end = time.monotonic() + seconds
    while not so():
        if time.monotonic() > end:
            return False
        time.sleep(0.02)
    return True


def what_was_said(hub, robots):
    hub.kill()
    return hub.communicate()[1] + "".join(map(robots.said, range(COUNT)))


def expect_complete(robots, outcome):
    assert outcome.returncode == 0, outcome.stderr + "".join(map(robots.said, range(COUNT)))
    assert "COMPLETE after" in outcome.stdout, outcome.stdout
    assert "in one piece at every tick" in outcome.stdout, outcome.stdout
    for process in robots.processes:
        assert process.wait(timeout=10) == 0  # the hub has stopped it


def test_committed_packets_are_those_of_pymavlink():
    committed = (HOUSE / "hosts/udp/test/mavlink_frames.txt").read_text()
    assert committed == autopilots.frames_text()


@pytest.mark.parametrize("home, holonomic, version, odometry", [
    ("file", False, 2, False), ("globe", True, 1, False), ("file", True, 2, True)])
def test_nine_vehicles_complete_a_mission(tmp_path, home, holonomic, version, odometry):
    with airfield(tmp_path, home=home, holonomic=holonomic, version=version, odometry=odometry) as (robots, _):
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


def is_stopped(vehicle):
    order = vehicle.orders[-1][1] if vehicle.orders else vehicle.order
    return order is not None and (order.vx, order.vy, order.vz, order.yaw_rate) == (0.0,) * 4


def speed(vehicle):
    return math.hypot(vehicle.vn, vehicle.ve)


@contextlib.contextmanager
def doubled(robots, vehicle):
    """Somebody else with its id, who sends to the same address."""
    other = Vehicle(vehicle.system, vehicle.to, 40.0, 40.0, (0.0, 0.0))
    robots.vehicles.append(other)
    assert becomes(lambda: is_stopped(other)), "both are told to stand"
    yield
    robots.vehicles.remove(other)


@contextlib.contextmanager
def impaired(_, vehicle, how):
    setattr(vehicle, how, True)
    yield
    setattr(vehicle, how, False)


@pytest.mark.parametrize("trouble, words", [
    ("silent", "no heartbeat of MAVLink system {} for 2 s"),
    ("blind", "MAVLink system {} has not said where it is for 0.5 s: LOCAL_POSITION_NED"),
    ("unsure", "MAVLink system {} is not sure where it is: its estimator's flags are 0x0081"),
    ("doubled", "two vehicles are MAVLink system {}: at 127.0.0.1:"),
])
def test_a_vehicle_in_trouble_stands_and_is_named_and_the_others_go_on(tmp_path, trouble, words):
    with airfield(tmp_path) as (robots, _):
        hub = subprocess.Popen(robots.hub(), cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        try:
            assert becomes(lambda: any(speed(v) > 0.1 for v in robots.vehicles)), what_was_said(hub, robots)
            vehicle = max(robots.vehicles, key=speed)  # a worker: without it, there is no end
            number = robots.vehicles.index(vehicle)
            others = [v for v in robots.vehicles if v is not vehicle]
            with doubled(robots, vehicle) if trouble == "doubled" else impaired(robots, vehicle, trouble):
                assert becomes(lambda: words.format(number + 1) in robots.said(number)), robots.said(number)
                assert f"banyan-robot {number}: " in robots.said(number)
                assert becomes(lambda: is_stopped(vehicle) and speed(vehicle) < 0.01)
                assert all(v.offboard for v in others)
                there = vehicle.place()
                time.sleep(0.5)
                assert math.dist(vehicle.place(), there) < 0.02
                assert hub.poll() is None
            assert not any(words.format(i + 1) in robots.said(i) for i in range(COUNT) if i != number)
            outcome = subprocess.CompletedProcess(hub.args, 0, *hub.communicate(timeout=60))
            outcome.returncode = hub.returncode
            expect_complete(robots, outcome)
            assert "its base is all right again" in robots.said(number)
        finally:
            hub.kill()
            hub.wait()


def test_a_tracker_knows_where_vehicles_are_and_they_do_not(tmp_path):
    over = threading.Event()

    def track(vehicles, port):
        wire = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        turn = 0.4  # of the laboratory's frame against north
        c, s = math.cos(turn), math.sin(turn)
        while not over.wait(0.01):
            for i, vehicle in enumerate(vehicles):
                x, y = vehicle.place()
                heading = math.pi / 2 - vehicle.yaw + turn
                line = f"{i} {c * x - s * y:.4f} {s * x + c * y:.4f} {heading:.4f}\n"
                wire.sendto(line.encode(), ("127.0.0.1", port))

    with airfield(tmp_path, home="tracker") as (robots, _):
        thread = threading.Thread(target=track, args=(robots.vehicles, robots.poses_port), daemon=True)
        thread.start()
        try:
            expect_complete(robots, run_hub(robots))
        finally:
            over.set()
            thread.join()


def test_a_killed_controller_leaves_its_vehicle_to_the_autopilot(tmp_path):
    with airfield(tmp_path) as (robots, _):
        hub = subprocess.Popen(robots.hub(), cwd=tmp_path, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            assert becomes(lambda: any(speed(v) > 0.1 for v in robots.vehicles)), what_was_said(hub, robots)
            vehicle = max(robots.vehicles, key=speed)
            robots.processes[robots.vehicles.index(vehicle)].send_signal(signal.SIGKILL)
            assert becomes(lambda: not vehicle.offboard and speed(vehicle) < 0.01)
            # A stopped one has said so before it went.
            other = max((v for v in robots.vehicles if v is not vehicle), key=speed)
            robots.processes[robots.vehicles.index(other)].send_signal(signal.SIGTERM)
            assert robots.processes[robots.vehicles.index(other)].wait(timeout=10) == 128 + signal.SIGTERM
            assert becomes(lambda: not other.orders)
            assert other.order.vx == other.order.vy == other.order.yaw_rate == 0.0
        finally:
            hub.kill()
            hub.wait()
