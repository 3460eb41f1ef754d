# SPDX-License-Identifier: MIT
"""hosts/udp/examples/optitrack.py between a server that speaks NatNet 3.1 and the hub's pose stream. The library that reads
the packets is somebody else's; they are written here, by the layout of OptiTrack's own client."""

import math
import socket
import struct
import subprocess
import sys
import threading
from pathlib import Path

import pytest

ADAPTER = Path(__file__).resolve().parents[1] / "examples" / "optitrack.py"
HALF = math.sqrt(0.5)


def packet(kind, payload):
    return struct.pack("<HH", kind, len(payload)) + payload


def server_info():
    return packet(1, b"Motive".ljust(256, b"\0") + bytes((3, 0, 0, 0)) + bytes((3, 1, 0, 0)))


def descriptions(names):
    bodies = b"".join(
        struct.pack("<i", 1) + name.encode() + b"\0" + struct.pack("<ii3fi", number, -1, 0, 0, 0, 0)
        for number, name in names.items()
    )
    return packet(5, struct.pack("<i", len(names)) + bodies)


def frame(bodies):
    said = b"".join(struct.pack("<i3f4ffh", number, *place, *turn, 0.001, seen) for number, place, turn, seen in bodies)
    after = struct.pack("<4i", 0, 0, 0, 0) + struct.pack("<IId3QH", 0, 0, 1.0, 0, 0, 0, 0)
    return packet(7, struct.pack("<3i", 1, 0, 0) + struct.pack("<i", len(bodies)) + said + after)


class Motive(threading.Thread):
    """Answers, and sends the frame with each answer and keep-alive."""

    def __init__(self, names, bodies):
        super().__init__(daemon=True)
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 1510))
        self.socket.settimeout(0.1)
        self.ends = False
        self.names, self.bodies = names, bodies
        self.start()

    def run(self):
        while not self.ends:
            try:
                asked, whom = self.socket.recvfrom(1000)
            except TimeoutError:
                continue
            kind = struct.unpack_from("<H", asked)[0]
            if kind == 0:
                self.socket.sendto(server_info(), whom)
            elif kind == 4:
                self.socket.sendto(descriptions(self.names), whom)
            else:
                self.socket.sendto(frame(self.bodies), whom)


@pytest.mark.parametrize("up", ["z", "y"])
def test_bodies_arrive_by_name_on_the_floor(up):
    # (place on the floor, heading), and the same in Motive's frame.
    turns = {0.0: (0, 0, 0, 1), math.pi / 2: (0, 0, HALF, HALF), -math.pi / 2: (0, 0, -HALF, HALF)}
    truth = {"cf_1": (1.0, 2.0, math.pi / 2), "cf231": (-0.5, 0.25, -math.pi / 2), "7": (0.0, 0.0, 0.0)}
    names = {11: "cf_1", 12: "cf231", 13: "7", 14: "wand"}
    bodies = []
    for number, name in names.items():
        x, y, heading = truth.get(name, (9.0, 9.0, 0.0))
        a, b, c, w = turns[heading]
        place, turn = ((x, y, 0.3), (a, b, c, w)) if up == "z" else ((x, 0.3, -y), (a, c, -b, w))
        bodies.append((number, place, turn, name != "wand"))
    hub = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    hub.bind(("127.0.0.1", 0))
    hub.settimeout(20)
    motive = Motive(names, bodies)
    adapter = subprocess.Popen(
        [sys.executable, ADAPTER, "127.0.0.1", "127.0.0.1", f"127.0.0.1:{hub.getsockname()[1]}", "--up", up]
    )
    try:
        said = hub.recv(2000).decode()
    finally:
        adapter.kill()
        adapter.wait()
        motive.ends = True
        motive.join()
        motive.socket.close()
        hub.close()
    got = {name: tuple(map(float, numbers)) for name, *numbers in (line.split(" ") for line in said.splitlines())}
    assert got.keys() == truth.keys()  # the wand is not tracked
    for name, pose in truth.items():
        assert got[name] == pytest.approx(pose, abs=1e-4)
