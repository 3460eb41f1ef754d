# SPDX-License-Identifier: MIT
"""What Python costs, measured in pairs on one core: the two ways of a pair take turns, and the figure is the median of
their ratios, in processor time. docs/python.md has the results.

    PYTHONPATH=build/check/python /usr/bin/python3 bench/python/measure.py
"""

import statistics
import sys
import time

import numpy as np

import banyan

FIELDS = ("positions", "headings", "roles", "parents", "old_parents", "serves", "roots", "alive", "links", "targets")


def loop(world, ticks):
    for _ in range(ticks):
        world.step()


def loop_reading(world, ticks):
    total = 0.0
    for _ in range(ticks):
        world.step()
        for name in FIELDS:
            total += getattr(world, name).shape[0]
    return total


def timed(call, *arguments):
    begun = time.process_time()
    call(*arguments)
    return time.process_time() - begun


def overheads(pairs, ticks=200):
    """Of Python's loop, and of one that reads all arrays, over the same ticks in C++: 94 robots under way."""
    start = banyan.World("scenarios/paper-large.toml", algorithm="convoy")
    start.step(50)
    ratios = {"without reading": [], "reading all arrays": []}
    hashes = set()
    for pair in range(pairs):
        ways = [
            ("C++", lambda w: w.step(ticks)),
            ("without reading", lambda w: loop(w, ticks)),
            ("reading all arrays", lambda w: loop_reading(w, ticks)),
        ]
        seconds = {}
        for k in range(len(ways)):
            name, way = ways[(pair + k) % len(ways)]
            world = start.copy()
            world.step(5)
            seconds[name] = timed(way, world)
            hashes.add(world.hash)
        for name in ratios:
            ratios[name].append(seconds[name] / seconds["C++"] - 1)
    assert len(hashes) == 1
    for name, values in ratios.items():
        quarters = statistics.quantiles(values, n=4)
        print(
            f"stepping {len(start)} robots from Python, {name}: {statistics.median(values):+.1%} "
            f"(quartiles {quarters[0]:+.1%} to {quarters[2]:+.1%}, {pairs} pairs of {ticks} ticks)"
        )


def lockstep(windows, worlds=1000, robots=20, ticks=10):
    """1,000 worlds of 20 robots with a trivial policy in numpy: everybody drives on, workers towards their targets."""
    env = banyan.BatchEnv(
        "scenarios/three-targets.toml", worlds, set={"swarm.robots": robots}, message_floats=2, copy=False
    )
    begun = time.process_time()
    seen = env.reset(seed=1)
    print(f"{worlds} worlds of {robots} robots: reset in {time.process_time() - begun:.2f} s")
    velocity = np.zeros((worlds, robots, 2), np.float32)
    message = np.zeros((worlds, robots, 2), np.float32)
    rates = []
    for _ in range(windows):
        begun = time.process_time()
        for _ in range(ticks):
            velocity[..., 0] = 0.1
            velocity[..., 1] = np.clip(seen.target[..., 1], -1, 1)
            message[..., 0] = seen.heard
            seen, *_ = env.step(banyan.Actions(velocity, message))
        rates.append(worlds * robots * ticks / (time.process_time() - begun))
    print(
        f"lockstep: {statistics.median(rates):,.0f} robot-steps per second of one core "
        f"(lowest {min(rates):,.0f}, highest {max(rates):,.0f}, {windows} windows of {ticks} ticks)"
    )


if __name__ == "__main__":
    pairs = int(sys.argv[1]) if len(sys.argv) > 1 else 31
    overheads(pairs)
    lockstep(max(3, pairs // 3))
