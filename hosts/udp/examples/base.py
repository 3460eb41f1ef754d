#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Bases that speak banyan-robot's line protocol over TCP, here with simulated wheels.

    base.py COUNT FIRST_PORT [SPEED [RANGE [X,Y ...]]]

With a RANGE they measure each other up to there, in m, for robots without a hub, and base 1 + k has the k-th target X,Y.
Base i listens on port FIRST_PORT + i and stands at the i-th point of a square grid. Replace move() by your motors and
encoders, and you have a driver for your robot. On standard output, for tracker.py, is what a camera would see.
"""
import contextlib
import math
import selectors
import socket
import sys
import time

count, first_port = int(sys.argv[1]), int(sys.argv[2])
speed = float(sys.argv[3]) if len(sys.argv) > 3 else 1.0
reach = float(sys.argv[4]) if len(sys.argv) > 4 else 0.0
targets = {1 + k: tuple(map(float, text.split(","))) for k, text in enumerate(sys.argv[5:])}
PERIOD_S, DEADMAN_S = 0.02, 0.5


class Base:
    def __init__(self, number):
        side = math.ceil(math.sqrt(count))
        self.number, self.buffer, self.wire = number, b"", None
        self.x, self.y, self.turn = 0.32 * (number % side - side // 2), 0.32 * (number // side - side // 2), 7.0 * number
        self.start = (self.x, self.y, self.turn)
        self.command, self.heard = (0.0, 0.0, 0.0), 0.0

    def listen(self):
        try:
            data = self.wire.recv(4096)
        except OSError:  # the robot was killed, with words of ours that it had not read
            return False
        *lines, self.buffer = (self.buffer + data).split(b"\n")
        for words in (line.split() for line in lines):
            if words[:1] == [b"drive"] and len(words) == 4:
                self.command, self.heard = tuple(map(float, words[1:])), time.monotonic()
        return bool(data)

    def move(self, seconds):
        if time.monotonic() - self.heard > DEADMAN_S:
            self.command = (0.0, 0.0, 0.0)  # the wire may be broken
        forward, sideways, turn = (value * seconds for value in self.command)
        c, s = math.cos(self.turn), math.sin(self.turn)
        self.x, self.y, self.turn = self.x + c * forward - s * sideways, self.y + s * forward + c * sideways, self.turn + turn

    def odometry(self):
        """Since the start, in the frame of the start: what encoders know."""
        x, y, turn = self.start
        dx, dy, c, s = self.x - x, self.y - y, math.cos(turn), math.sin(turn)
        return b"pose %.5f %.5f %.5f\n" % (c * dx + s * dy, c * dy - s * dx, self.turn - turn)

    def seen_from_here(self, x, y):
        dx, dy, c, s = x - self.x, y - self.y, math.cos(self.turn), math.sin(self.turn)
        return c * dx + s * dy, c * dy - s * dx

    def measurements(self):
        """What sensors of range and bearing, and of the target, say."""
        lines = b""
        for other in bases:
            x, y = self.seen_from_here(other.x, other.y)
            if other is not self and math.hypot(x, y) <= reach:
                lines += b"near %d %.4f %.4f\n" % (other.number, math.hypot(x, y), math.atan2(y, x))
        if self.number in targets:
            lines += b"target %.4f %.4f\n" % self.seen_from_here(*targets[self.number])
        return lines


bases, ready = [Base(number) for number in range(count)], selectors.DefaultSelector()
for base in bases:
    ready.register(socket.create_server(("127.0.0.1", first_port + base.number)), selectors.EVENT_READ, (base, True))
then = time.monotonic()
while True:
    for key, _ in ready.select(max(0.0, then + PERIOD_S - time.monotonic())):
        base, is_server = key.data
        if is_server:
            if base.wire:  # the next robot may come before the end of the last one is noticed
                ready.unregister(base.wire)
            base.wire, _ = key.fileobj.accept()
            ready.register(base.wire, selectors.EVENT_READ, (base, False))
        elif key.fileobj is base.wire and not base.listen():
            ready.unregister(base.wire)
            base.wire = None
    now = time.monotonic()
    if now - then < PERIOD_S:
        continue
    for base in bases:
        base.move(speed * (now - then))
        if base.wire:
            with contextlib.suppress(OSError):  # as above; recv() will say so
                base.wire.sendall(base.odometry() + base.measurements())
        print(base.number, base.x, base.y, base.turn, sep=",")
    sys.stdout.flush()
    then = now
