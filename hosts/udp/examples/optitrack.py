#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Hands the poses of an OptiTrack system (Motive, NatNet) to `banyan hub --poses ADDRESS:PORT`. Needs `pip install natnet`.

    optitrack.py MOTIVE_ADDRESS OWN_ADDRESS ADDRESS:PORT [--multicast] [--up y]

Each rigid body goes by its name in Motive, which is the robot's in `banyan hub --names`, or its id. Motive's "Up Axis"
is z; with --up y it is y, and the scenario's (x, y) are then Motive's (x, -z). A body's x axis must point to where it
drives. A body that is not tracked is not sent.
"""
import argparse
import math
import socket
import time

import natnet


def line(name, body, up):
    x, y, z = body.pos
    a, b, c, w = body.rot
    if up == "y":  # the same turns, seen with z upwards
        x, y, z, a, b, c = x, -z, y, a, -c, b
    heading = math.atan2(2 * (w * c + a * b), 1 - 2 * (b * b + c * c))
    return b"%s %.4f %.4f %.4f\n" % (name.encode(), x, y, heading)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("motive")
    parser.add_argument("own")
    parser.add_argument("hub")
    parser.add_argument("--multicast", action="store_true")
    parser.add_argument("--up", choices=("z", "y"), default="z")
    options = parser.parse_args()
    out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    address, port = options.hub.rsplit(":", 1)
    names = {}

    def described(descriptions):
        names.update({body.id_num: body.name for body in descriptions.rigid_bodies})

    def seen(frame):
        bodies = [body for body in frame.rigid_bodies if body.tracking_valid and body.id_num in names]
        if bodies:
            out.sendto(b"".join(line(names[body.id_num], body, options.up) for body in bodies), (address, int(port)))

    with natnet.NatNetClient(options.motive, options.own, use_multicast=options.multicast) as client:
        client.on_data_description_received_event.handlers.append(described)
        client.on_data_frame_received_event.handlers.append(seen)
        client.request_modeldef()
        while True:
            client.update_sync()
            time.sleep(0.005)


if __name__ == "__main__":
    main()
