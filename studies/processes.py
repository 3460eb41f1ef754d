#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The paper's two set-ups with real robots: robots as processes beside the same missions in our world (docs/robots.md).

    studies/processes.py run                          15 seeds with two targets, 10 with three; adds rows to
                                                      out/processes/rows.csv; may be stopped and called again
    studies/processes.py run --seeds 40 --algorithm outwards     more of a kind
    studies/processes.py tables out/processes/rows.csv

Processes have 20 ± 10 ms from robot to robot, and the hub hands packets on once a tick. The world's robots either step together, so
that a packet is heard exactly a tick after it was sent, or at their own moments, and then a packet arrives within 20 to 40 ms.
"""
import argparse
import itertools
import os
import random
import statistics

from missions import BANYAN, HOUSE, play_all, result
from tables import rows_of, table

KEY = ['scenario', 'algorithm', 'loss', 'seed', 'where']
RESULTS = ['git', 'complete', 'completion_time_s', 'split_ticks', 'broken_ticks', 'committed', 'robots', 'ticks', 'deaths']
REPETITIONS = {'khepera-two-targets': 15, 'khepera-three-targets': 10}  # as in the paper, Sec. IV-D
WORLDS = {'together': 'false', 'world': 'true'}  # `where`: clocks.asynchronous
WORLD_SEEDS = 100  # a mission takes milliseconds there, and its median is the one that both are compared with
ALGORITHMS = ('outwards', 'inwards', 'convoy')
LOSSES = ('0', '0.1', '0.3')


def plan(args):
    algorithms = [args.algorithm] if args.algorithm else ALGORITHMS
    scenarios = [args.scenario] if args.scenario else REPETITIONS
    for scenario, algorithm, loss in itertools.product(scenarios, algorithms, LOSSES):
        for where, seeds in (('processes', args.seeds or REPETITIONS[scenario]), *((world, WORLD_SEEDS) for world in WORLDS)):
            for seed in range(1, seeds + 1):
                yield dict(zip(KEY, (scenario, algorithm, loss, str(seed), where)))


def play(m, args, folder):
    out = os.path.join(folder, 'out')
    scenario = os.path.join(HOUSE, 'scenarios', m['scenario'] + '.toml')
    common = ['--set', f'mission.algorithm={m["algorithm"]}', '--seed', m['seed'], '--no-record', '-q', '--out', out]
    if m['where'] == 'processes':
        command = [args.banyan, 'fleet', scenario, *common, '--speed', args.speed, '--loss', m['loss'], '--delay-ms', '20', '--jitter-ms', '10']
    else:
        command = [args.banyan, 'run', scenario, *common, '--threads', '1', '--set', f'radio.loss={m["loss"]}', '--set', f'clocks.asynchronous={WORLDS[m["where"]]}']
    return result(command, out, RESULTS)


def ratio(processes, world):
    """Of the medians, with the 95 % interval of 10,000 resamplings."""
    draw = random.Random(1)
    ratios = sorted(statistics.median(draw.choices(processes, k=len(processes))) / statistics.median(draw.choices(world, k=len(world)))
                    for _ in range(10000))
    return statistics.median(processes) / statistics.median(world), ratios[250], ratios[-251]


def completion_times(rows):
    return [float(row['completion_time_s']) for row in rows if row['complete'] in ('1', 'true')]


def tables(args):
    groups = {}
    for row in itertools.chain.from_iterable(map(rows_of, args.files)):
        groups.setdefault((row['scenario'], row['algorithm'], row['loss']), {}).setdefault(row['where'], []).append(row)
    lines = []
    for (scenario, algorithm, loss), by_place in sorted(groups.items(), key=lambda item: (item[0][0] != 'khepera-two-targets', item[0][1:])):
        rows = by_place['processes']
        times = completion_times(rows)
        cells = [scenario.removeprefix('khepera-').replace('-', ' '), algorithm, f'{100 * float(loss):.0f} %', f'{len(times)} of {len(rows)}',
                 str(sum(int(row['split_ticks']) > 0 for row in rows)), f'{statistics.median(times):.1f}']
        for world in WORLDS:
            there = completion_times(by_place[world])
            middle, low, high = ratio(times, there)
            cells += [f'{statistics.median(there):.1f}', f'{middle:.2f} ({low:.2f}–{high:.2f})']
        lines.append(cells)
    print(table(['set-up', 'algorithm', 'loss', 'complete', 'split', 'median, s', 'together, s', 'ratio (95 %)', 'own moments, s', 'ratio (95 %)'],
                lines), end='')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    command = commands.add_parser('run')
    command.add_argument('--seeds', type=int, help='1 to this, instead of 15 and 10')
    command.add_argument('--algorithm', choices=ALGORITHMS, help='this one only')
    command.add_argument('--scenario', choices=REPETITIONS, help='this one only')
    command.add_argument('--speed', default='1', help='of all clocks; a busy machine then delays packets by more')
    command.add_argument('--rows', default='out/processes/rows.csv')
    command.add_argument('--banyan', default=BANYAN)
    command.set_defaults(call=lambda args: play_all(args.rows, list(plan(args)), KEY, RESULTS, lambda m, folder: play(m, args, folder)))
    command = commands.add_parser('tables')
    command.add_argument('files', nargs='+')
    command.set_defaults(call=tables)
    args = parser.parse_args()
    args.call(args)


if __name__ == '__main__':
    main()
