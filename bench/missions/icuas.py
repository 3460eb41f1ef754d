# SPDX-License-Identifier: MIT
"""A scenario like the course of the ICUAS '26 UAV competition: a vehicle drives between a base and 24 pillars, five
drones keep base and vehicle joined and look at eight markers. Pillars, starts and way points are the competition's
(larics/icuas26_competition); buildings that hide, and the markers, are drawn from the seed."""
import math
import random

PILLARS = [
    (-4.122, 6.942), (5.949, 6.171), (-5.808, -3.101), (0.616, -4.084), (3.398, 1.748), (5.087, 1.528),
    (-7.651, -8.806), (6.595, -1.938), (-2.413, 7.209), (-5.667, -1.390), (-3.033, 0.051), (-2.248, 1.683),
    (1.250, -6.332), (-4.861, 8.805), (7.498, -5.066), (8.419, 8.711), (-1.480, -4.922), (-2.345, 4.485),
    (7.169, -8.284), (7.347, 2.808), (-1.766, -1.983), (-7.129, 1.787), (-8.578, 4.515), (5.151, -4.352)]
PILLAR_RADIUS = 0.249
COURSE = [
    (-1.125, -0.489), (-0.104, 8.440), (-7.643, 6.919), (-4.514, 3.117), (-8.229, -1.858), (-2.972, -2.684),
    (-4.492, -3.442), (-5.492, -7.442), (1.786, -8.311), (4.737, -7.575), (2.503, -1.858), (7.262, 0.923),
    (5.784, 3.009), (7.924, 7.224), (3.389, 8.082), (1.461, -1.945), (-1.125, -0.489)]
STARTS = [(0.0, 0.0), (0.0, -0.5), (-0.35, 0.0), (-0.35, -0.5), (0.35, 0.0)]
BASE = (0.0, -0.25)
SPEED, LEAVES = 0.5, 20.0
# The course is 18 m wide and the radio reaches 70 m there: sight is what counts. Distances of the algorithms are shares
# of C, so they are told less; what is joined over 9 m is joined over 70.
RANGE, BODY, TOLERANCE = 9.0, 0.07, 0.5  # a Crazyflie with its propellers is 0.14 m across
CLEAR = 0.4  # of the course and of pillars, m


def way(a, b):
    return math.hypot(b[0] - a[0], b[1] - a[1])


def to_box(p, box):
    """The distance of a point to a box without turn, 0 inside."""
    (cx, cy), (w, h) = box
    return math.hypot(max(abs(p[0] - cx) - w / 2, 0.0), max(abs(p[1] - cy) - h / 2, 0.0))


def along(a, b, step=0.05):
    n = max(1, int(way(a, b) / step))
    return [(a[0] + (b[0] - a[0]) * k / n, a[1] + (b[1] - a[1]) * k / n) for k in range(n + 1)]


TRACK = [p for a, b in zip(COURSE, COURSE[1:]) for p in along(a, b)]


def draw_buildings(rng, count):
    boxes = []
    while len(boxes) < count:
        box = ((rng.uniform(-8, 8), rng.uniform(-8, 8)), (rng.uniform(0.8, 3.5), rng.uniform(0.8, 3.5)))
        clear = (min(to_box(p, box) for p in TRACK) > CLEAR and min(to_box(p, box) for p in STARTS + [BASE]) > 1.0
                 and min(to_box(p, box) for p in PILLARS) > PILLAR_RADIUS + CLEAR
                 and all(abs(box[0][i] - b[0][i]) > (box[1][i] + b[1][i]) / 2 + 0.6 for b in boxes for i in (0, 1)
                         if abs(box[0][1 - i] - b[0][1 - i]) < (box[1][1 - i] + b[1][1 - i]) / 2 + 0.6))
        if clear:
            boxes.append(box)
    return boxes


def draw_markers(rng, boxes, count):
    """On pillars and buildings' sides, as in the competition: a little off them, where a drone can be."""
    markers = []
    while len(markers) < count:
        p = (rng.uniform(-9, 9), rng.uniform(-9, 9))
        near = min([way(p, q) - PILLAR_RADIUS for q in PILLARS] + [to_box(p, b) for b in boxes])
        if 0.2 < near < 0.5 and all(way(p, q) > 2.0 for q in markers):
            markers.append(p)
    return markers


def points(list_of):
    return "[" + ", ".join(f"[{x:.3f}, {y:.3f}]" for x, y in list_of) + "]"


def duration():
    return LEAVES + sum(way(a, b) for a, b in zip(COURSE, COURSE[1:])) / SPEED


def world(seed, buildings=8, markers=8):
    rng = random.Random(seed)
    boxes = draw_buildings(rng, buildings)
    return boxes, draw_markers(rng, boxes, markers)


def scenario(seed, robots=5, buildings=8, markers=8, battery=True):
    """The mission as TOML."""
    boxes, places = world(seed, buildings, markers)
    seconds = math.ceil(duration())
    text = f'''# Made by bench/missions/play icuas: a course like that of the ICUAS '26 UAV competition.
name = "icuas-{robots}-{seed}"
description = "{robots} drones keep a base and a vehicle on its course joined by line of sight, and look at {markers} markers."
tick_s = 0.04
seed = {seed}

[mission]
algorithm = "convoy"
time_limit_s = {seconds}.0
stop_when_complete = false
target_tolerance_m = {TOLERANCE}
connect = [["base", "vehicle"]]

[swarm.start]
layout = "list"
positions_m = {points(STARTS[:robots])}

[robot]
body = "linear"
radius_m = {BODY}
wheel_limit_m_s = 1.0
max_acceleration_m_s2 = 1.0
proximity_m = 3.0

[radio]
range_m = {RANGE}
line_of_sight = true
'''
    if battery:
        text += f'''
[battery]  # the charge lasts for two thirds of the course
model = "time"
capacity_j = 1000.0
charge_per_s = {1.5 / seconds:.6f}
places_m = {points([BASE])}
slots = {robots}
charge_w = 50.0
'''
    if markers:
        text += f'''
[visits]
positions_m = {points(places)}
'''
    text += f'''
[[stations]]
name = "base"
position_m = {points([BASE])[1:-1]}

[[stations]]
name = "vehicle"
position_m = {points(COURSE[:1])[1:-1]}
course_m = {points(COURSE[1:])}
speed_m_s = {SPEED}
start_s = {LEAVES}
'''
    for x, y in PILLARS:
        text += f'\n[[obstacles]]\nkind = "disc"\ncenter_m = [{x:.3f}, {y:.3f}]\nradius_m = {PILLAR_RADIUS}\n'
    for (x, y), (w, h) in boxes:
        text += f'\n[[obstacles]]\nkind = "box"\ncenter_m = [{x:.3f}, {y:.3f}]\nsize_m = [{w:.3f}, {h:.3f}]\n'
    return text
