#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Vehicles with autopilots, as far as MAVLink shows them: for the tests of `--base mavlink:...`. Speaks by pymavlink.

    autopilots.py --frames    prints test/mavlink_frames.txt

A vehicle has inertia and delay, begins at a place that its own local frame calls otherwise, and takes set-points only
while it is in a mode for them, as PX4's OFFBOARD is: its operator switches when set-points have come for a second, and
it leaves the mode when they stop.
"""
import collections
import math
import socket
import sys
import threading
import time

from pymavlink.dialects.v20 import ardupilotmega as mavlink

LAG_S, DELAY_S, PERIOD_S = 0.25, 0.1, 0.05
OFFBOARD_AFTER_S, OFFBOARD_LOSS_S = 1.0, 0.5
GOOD_ESTIMATE = (mavlink.ESTIMATOR_ATTITUDE | mavlink.ESTIMATOR_VELOCITY_HORIZ | mavlink.ESTIMATOR_VELOCITY_VERT |
                 mavlink.ESTIMATOR_POS_HORIZ_REL | mavlink.ESTIMATOR_POS_HORIZ_ABS)
EARTH_M = 6371000.0
ORIGIN = (47.397742, 8.545594)  # of the scenario, degrees


class Vehicle:
    """Stands at (east, north) of the scenario; its local frame begins at `home`, also (east, north)."""

    def __init__(self, system, to, east, north, home, version=2, odometry=False):
        self.system, self.to, self.home, self.odometry = system, to, home, odometry
        self.north, self.east, self.down, self.yaw = north - home[1], east - home[0], -0.1, 0.7 * system
        self.vn = self.ve = self.vd = self.yaw_rate = 0.0
        self.wire = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.wire.setblocking(False)
        self.codec = mavlink.MAVLink(None, srcSystem=system, srcComponent=1)
        self.reader = mavlink.MAVLink(None)
        self.version = version
        self.silent = self.blind = self.unsure = False
        self.orders = collections.deque()  # (when it takes effect, set-point)
        self.order, self.order_s, self.first_s, self.offboard = None, -1e9, None, False
        self.received = collections.Counter()
        self.order_times = []

    def place(self):
        return self.home[0] + self.east, self.home[1] + self.north

    def say(self, message):
        try:
            self.wire.sendto(message.pack(self.codec, force_mavlink1=self.version == 1), self.to)
        except BlockingIOError:
            pass

    def hear(self, now):
        while True:
            try:
                datagram, _ = self.wire.recvfrom(2048)
            except OSError:
                return
            for message in self.reader.parse_buffer(datagram) or []:  # it raises an error where a CRC is wrong
                self.received[message.get_type()] += 1
                if message.get_type() != "SET_POSITION_TARGET_LOCAL_NED":
                    continue
                assert message.type_mask == 0b010111000111 and message.coordinate_frame == mavlink.MAV_FRAME_LOCAL_NED
                assert message.target_system == self.system and message.target_component == 1
                self.order_times.append(now)
                self.orders.append((now + DELAY_S, message))

    def move(self, now, seconds):
        while self.orders and self.orders[0][0] <= now:
            self.order, self.order_s = self.orders.popleft()[1], now
            self.first_s = now if self.first_s is None else self.first_s
        self.offboard = self.order is not None and now - self.order_s < OFFBOARD_LOSS_S and now - self.first_s > OFFBOARD_AFTER_S
        wanted = (self.order.vx, self.order.vy, self.order.vz, self.order.yaw_rate) if self.offboard else (0.0,) * 4
        share = min(1.0, seconds / LAG_S)
        self.vn += share * (wanted[0] - self.vn)
        self.ve += share * (wanted[1] - self.ve)
        self.vd += share * (wanted[2] - self.vd)
        self.yaw_rate += share * (wanted[3] - self.yaw_rate)
        self.north += seconds * self.vn
        self.east += seconds * self.ve
        self.down += seconds * self.vd
        self.yaw = math.remainder(self.yaw + seconds * self.yaw_rate, 2.0 * math.pi)

    def beat(self):
        if self.silent:
            return
        self.say(mavlink.MAVLink_heartbeat_message(mavlink.MAV_TYPE_QUADROTOR, mavlink.MAV_AUTOPILOT_PX4, 0, 0, mavlink.MAV_STATE_ACTIVE, 3))
        flags = mavlink.ESTIMATOR_CONST_POS_MODE | mavlink.ESTIMATOR_ATTITUDE if self.unsure else GOOD_ESTIMATE
        self.say(mavlink.MAVLink_estimator_status_message(0, flags, *(0.1,) * 8))
        latitude = ORIGIN[0] + math.degrees((self.home[1] + 3.0) / EARTH_M)
        longitude = ORIGIN[1] + math.degrees((self.home[0] - 4.0) / EARTH_M / math.cos(math.radians(ORIGIN[0])))
        # A home that is not where the local frame begins.
        self.say(mavlink.MAVLink_home_position_message(
            round(latitude * 1e7), round(longitude * 1e7), 488000, 3.0, -4.0, 0.0, [1.0, 0.0, 0.0, 0.0], 0.0, 0.0, 0.0))

    def tell_pose(self, now):
        if self.silent or self.blind:
            return
        boot_ms = int(now * 1000)
        if self.odometry:
            half = self.yaw / 2
            self.say(mavlink.MAVLink_odometry_message(
                boot_ms * 1000, mavlink.MAV_FRAME_LOCAL_NED, mavlink.MAV_FRAME_BODY_FRD, self.north, self.east, self.down,
                [math.cos(half), 0.0, 0.0, math.sin(half)], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, [0.0] * 21, [0.0] * 21, 1, 1, 50))
            return
        self.say(mavlink.MAVLink_attitude_message(boot_ms, 0.01, 0.02, self.yaw, 0.0, 0.0, self.yaw_rate))
        self.say(mavlink.MAVLink_local_position_ned_message(
            boot_ms, self.north, self.east, self.down, self.vn, self.ve, self.vd))


class Airfield:
    """All vehicles, in a thread, with a clock that is `speed` times as fast as the wall's."""

    def __init__(self, vehicles, speed=1.0):
        self.vehicles, self.speed, self.begin = vehicles, speed, time.monotonic()
        self.over, self.error, self.thread = threading.Event(), None, threading.Thread(target=self.run, daemon=True)

    def now(self):
        return self.speed * (time.monotonic() - self.begin)

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.over.set()
        self.thread.join()
        if self.error:
            raise self.error

    def run(self):
        try:
            then, beaten = self.now(), -1e9
            while not self.over.wait(PERIOD_S / self.speed):
                now = self.now()
                for vehicle in list(self.vehicles):
                    vehicle.hear(now)
                    vehicle.move(now, now - then)
                    if now - beaten >= 0.95:
                        vehicle.beat()
                    vehicle.tell_pose(now)
                beaten = now if now - beaten >= 0.95 else beaten
                then = now
        except Exception as error:  # said by __exit__
            self.error = error


def frames():
    """Packets with their names, as test/mavlink_test.cpp reads them."""
    def packed(message, system=7, component=1, sequence=42, **how):
        codec = mavlink.MAVLink(None, srcSystem=system, srcComponent=component)
        codec.seq = sequence
        if how.pop("signed", False):
            codec.signing.secret_key, codec.signing.timestamp, codec.signing.link_id = bytes(range(32)), 1, 3
            codec.signing.sign_outgoing = True
        return message.pack(codec, **how)

    heartbeat = mavlink.MAVLink_heartbeat_message(2, 12, 81, 0, 4, 3)
    attitude = mavlink.MAVLink_attitude_message(123456, 0.1, -0.2, 1.25, 0.0, 0.0, 0.0)
    position = mavlink.MAVLink_local_position_ned_message(123456, 12.5, -3.25, -10.0, 0.5, 0.25, 0.0)
    zeros = mavlink.MAVLink_local_position_ned_message(0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    broken = mavlink.MAVLink_local_position_ned_message(1, math.nan, 0.0, 0.0, 0.0, 0.0, 0.0)
    rotation = [math.cos(0.6), 0.0, 0.0, math.sin(0.6)]  # yaw 1.2

    def odometry(frame):
        return mavlink.MAVLink_odometry_message(
            99, frame, mavlink.MAV_FRAME_BODY_FRD, 1.5, 2.5, -3.5, rotation, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0,
            [0.5] * 21, [0.25] * 21, 3, 2, 90)

    def set_point(*velocities):
        north, east, down, yaw_rate = velocities
        return mavlink.MAVLink_set_position_target_local_ned_message(
            98765, 7, 1, mavlink.MAV_FRAME_LOCAL_NED, 0b010111000111, 0.0, 0.0, 0.0, north, east, down, 0.0, 0.0, 0.0, 0.0, yaw_rate)

    computer = mavlink.MAVLink_heartbeat_message(
        mavlink.MAV_TYPE_ONBOARD_CONTROLLER, mavlink.MAV_AUTOPILOT_INVALID, 0, 0, mavlink.MAV_STATE_ACTIVE, 3)
    yield "heartbeat", packed(heartbeat)
    yield "heartbeat_v1", packed(heartbeat, force_mavlink1=True)
    yield "attitude", packed(attitude)
    yield "attitude_v1", packed(attitude, force_mavlink1=True)
    yield "position", packed(position)
    yield "position_v1", packed(position, force_mavlink1=True)
    yield "position_signed", packed(position, signed=True)
    yield "position_truncated", packed(zeros)
    yield "position_nan", packed(broken)
    yield "odometry", packed(odometry(mavlink.MAV_FRAME_LOCAL_NED))
    yield "odometry_of_no_north", packed(odometry(mavlink.MAV_FRAME_LOCAL_FRD))
    yield "estimator", packed(mavlink.MAVLink_estimator_status_message(5, 0x033F, *(0.5,) * 8))
    yield "ekf", packed(mavlink.MAVLink_ekf_status_report_message(0x00BF, *(0.5,) * 5, 0.25))
    yield "home", packed(mavlink.MAVLink_home_position_message(
        473977420, 85455940, 488000, 3.0, -4.0, 0.5, [1.0, 0.0, 0.0, 0.0], 0.0, 0.0, 0.0, 77))
    yield "origin", packed(mavlink.MAVLink_gps_global_origin_message(-337000000, 1512000000, 50000, 77))
    yield "unknown", packed(mavlink.MAVLink_vfr_hud_message(1.0, 2.0, 3, 4, 5.0, 6.0))
    yield "sent_set_point", packed(set_point(0.5, -0.25, 0.125, -1.5), component=191)
    yield "sent_stop", packed(set_point(0.0, 0.0, 0.0, 0.0), component=191)
    yield "sent_heartbeat", packed(computer, component=191)


def frames_text():
    lines = ["# Packets of MAVLink by pymavlink: hosts/udp/test/autopilots.py --frames"]
    return "\n".join(lines + [f"{name} {packet.hex()}" for name, packet in frames()]) + "\n"


if __name__ == "__main__":
    if sys.argv[1:] != ["--frames"]:
        sys.exit(__doc__)
    sys.stdout.write(frames_text())
