#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Hands the poses of a tracker to `banyan hub --poses ADDRESS:PORT`.

    YOUR_TRACKER | tracker.py ADDRESS:PORT

Reads lines "ID,X,Y,HEADING" (m, rad) from standard input. Replace poses() by the library of your tracker: whatever
yields an id and a pose in the laboratory's frame will do. Send each robot at least ten times a second.
"""
import socket
import sys


def poses():
    for line in sys.stdin:
        robot, x, y, heading = line.split(",")
        yield int(robot), float(x), float(y), float(heading)


address, port = sys.argv[1].rsplit(":", 1)
out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
for robot, x, y, heading in poses():
    out.sendto(b"%d %.4f %.4f %.4f\n" % (robot, x, y, heading), (address, int(port)))
