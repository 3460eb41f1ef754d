#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The paper's evaluation inside ARGoS 3, and the same missions in our world (docs/argos.md).

    studies/argos.py run --seeds 1-2                adds rows to out/argos/rows.csv; may be stopped and called again
    studies/argos.py run --part deaths --seeds 1-3
    studies/argos.py tables results/argos/worlds.csv.gz       and where ARGoS and our world agree
    studies/argos.py claims results/argos/worlds.csv.gz       outwards against inwards

Needs argos3 on PATH (or --argos FILE), with the plugin of the Khepera IV, and a banyan that was built with it.
"""
import argparse
import itertools
import os
import statistics
import subprocess
import time

from missions import BANYAN, HOUSE, play_all, result
from tables import rows_of

RESULTS = ['git', 'complete', 'completion_time_s', 'normalized_time', 'broken_ticks', 'broken_ticks_by_distance',
           'broken_ticks_by_occlusion', 'disconnected_time_ratio_by_occlusion', 'split_ticks', 'committed', 'robots', 'ticks', 'deaths', 'recovered']
KEY = ['part', 'scenario', 'T', 'r', 'k', 'algorithm', 'reading', 'sight', 'loss', 'obstacles', 'seed', 'where']
ALGORITHMS = [('convoy', 'corrected'), ('outwards', 'corrected'), ('inwards', 'corrected'), ('outwards', 'literal'),
              ('inwards', 'literal')]


def mission(part, algorithm, sight, seed, where, scenario='paper-medium', world=('', '', ''), loss=0.0, obstacles=''):
    values = [part, scenario, *world, *algorithm, sight, loss, obstacles, seed, where]
    return dict(zip(KEY, map(str, values)))


PLACES = ('argos', 'banyan')


def plan(part, seeds):
    if part == 'worlds':
        for seed, r, k, T in itertools.product(seeds, (3, 6, 9), (2, 3, 4), (2, 3, 4)):
            for sight, algorithm in itertools.product(('off', 'stock', 'exact'), ALGORITHMS):
                for where in PLACES:
                    yield mission(part, algorithm, sight, seed, where, world=(T, r, k))
    elif part == 'loss':
        for seed, r, k in itertools.product(seeds, (3, 6, 9), (2, 4)):
            for algorithm, where in itertools.product(ALGORITHMS, PLACES):
                yield mission(part, algorithm, 'exact', seed, where, world=(3, r, k), loss=0.3)
    elif part == 'deaths':
        for seed, sight, algorithm in itertools.product(seeds, ('stock', 'exact'), ALGORITHMS[:3]):
            for where in PLACES:
                yield mission(part, algorithm, sight, seed, where, scenario='deaths')
    elif part == 'obstacles':
        for seed, scenario, algorithm in itertools.product(
                seeds, ('wall-with-gap', 'corridor', 'rooms', 'scattered-discs'), ALGORITHMS[:3]):
            for where, eyes in (('argos', 'sensors'), ('argos', 'world'), ('banyan', 'world')):
                yield mission(part, algorithm, 'exact', seed, where, scenario=scenario, obstacles=eyes)


def options(m):
    sets = {'mission.algorithm': m['algorithm'], 'mission.reading': m['reading'], 'radio.loss': m['loss'],
            'radio.line_of_sight': 'false' if m['sight'] == 'off' else 'true', 'output.record': 'false', 'seed': m['seed']}
    if m['sight'] == 'stock' and m['where'] == 'banyan':
        sets['radio.sight_leak'] = '0.18'  # our model of ARGoS' stock sight
    if m['T']:
        sets |= {'targets.count': m['T'], 'targets.radius_m': m['r'], 'swarm.redundancy': m['k']}
    return [word for key, value in sets.items() for word in ('--set', f'{key}={value}')]


def play(m, args, folder):
    scenario = os.path.join(HOUSE, 'scenarios', m['scenario'] + '.toml')
    out = os.path.join(folder, 'out')
    begun = time.time()
    if m['where'] == 'argos':
        experiment = os.path.join(folder, 'mission.argos')
        subprocess.run([args.banyan, 'argos', scenario, '-o', experiment, '--out', out, '--sight', 'exact' if m['sight'] == 'exact' else 'stock',
                        '--obstacles', m['obstacles'] or 'sensors', *options(m)], check=True, stdout=subprocess.DEVNULL)
        command = [args.argos, '-z', '-c', experiment]
    else:
        command = [args.banyan, 'run', scenario, '--out', out, '-q', '--threads', '1', *options(m)]
    return result(command, out, RESULTS) | {'wall_s': f'{time.time() - begun:.2f}'}


def run(args):
    first, _, last = args.seeds.partition('-')
    wanted = list(plan(args.part, range(int(first), int(last or first) + 1)))
    play_all(args.rows, wanted, KEY, RESULTS + ['wall_s'], lambda m, folder: play(m, args, folder))


def true(text):
    return text in ('1', 'true')


def interval(ratios):
    """Median and a 95 % interval of it, from the order statistics of the binomial distribution."""
    ratios = sorted(ratios)
    low = max(0, int(len(ratios) / 2 - 0.98 * len(ratios) ** 0.5))
    return f'{statistics.median(ratios):.3f} ({ratios[low]:.3f}–{ratios[-1 - low]:.3f})'


def column(rows):
    """What a cell of the table says of one place."""
    return {
        'complete': f'{sum(true(r["complete"]) for r in rows)} of {len(rows)}',
        'time': f'{statistics.median(float(r["normalized_time"]) for r in rows):.3f}',
        'far': f'{sum(int(r["broken_ticks_by_distance"]) > 0 for r in rows)}',
        'hidden': f'{statistics.mean(float(r["disconnected_time_ratio_by_occlusion"]) for r in rows):.2f}',
        'split': f'{sum(int(r["split_ticks"]) > 0 for r in rows)}',
    }


def tables(args):
    """ARGoS / our world, side by side. Where robots use their own sensors, our world is that whose robots see by the model."""
    groups = {}
    for row in itertools.chain.from_iterable(map(rows_of, args.files)):
        title = (row['part'], row['scenario'], 'r = ' + row['r'] if args.by_radius else '', 'loss ' + row['loss'])
        groups.setdefault(title, {}).setdefault((row['algorithm'], row['reading'], row['sight']), []).append(row)
    for title, by_algorithm in sorted(groups.items()):
        print(f'\n{", ".join(word for word in title if word)}: ARGoS / ours\n\n| algorithm | sight | complete | median normalised time | ratio of times'
              ' | runs with an edge ≥ C | time with an occluded edge | runs with a split |\n|---|---|---|---|---|---|---|---|')
        for (algorithm, reading, sight), rows in sorted(by_algorithm.items()):
            ours = {(r['T'], r['r'], r['k'], r['seed']): r for r in rows if r['where'] == 'banyan'}
            for eyes in sorted({r['obstacles'] for r in rows if r['where'] == 'argos'}):
                pairs = [(r, ours.get((r['T'], r['r'], r['k'], r['seed']))) for r in rows if r['where'] == 'argos' and r['obstacles'] == eyes]
                pairs = [pair for pair in pairs if pair[1]]
                if not pairs:
                    continue
                sides = [column([pair[n] for pair in pairs]) for n in (0, 1)]
                ratios = [float(a['completion_time_s']) / float(b['completion_time_s']) for a, b in pairs if true(a['complete']) and true(b['complete'])]
                cells = [' / '.join(side[name] for side in sides) for name in ('time', 'far', 'hidden', 'split')]
                whole = ' / '.join(side['complete'].split()[0] for side in sides) + f' of {len(pairs)}'
                print(f'| {algorithm}, {reading} | {" ".join(word for word in (sight, eyes) if word)} | {whole} | {cells[0]} | {interval(ratios) if ratios else ""}'
                      f' | {" | ".join(cells[1:])} |')


def claims(args):
    """The paper's two algorithms against each other, world by world."""
    runs = {}
    for row in itertools.chain.from_iterable(map(rows_of, args.files)):
        if row['part'] == 'worlds':
            runs[tuple(row[name] for name in ('reading', 'sight', 'r', 'where', 'algorithm', 'T', 'k', 'seed'))] = row
    print('| reading, sight | r | where | complete, outwards / inwards | median normalised time | pairs in which outwards is sooner | runs with an edge ≥ C'
          ' | runs with a split |\n|---|---|---|---|---|---|---|---|')
    cells = sorted({key[:4] for key in runs})
    for cell in cells:
        pairs = [(row, runs.get((*cell, 'inwards', *key[5:]))) for key, row in sorted(runs.items()) if key[:5] == (*cell, 'outwards')]
        pairs = [pair for pair in pairs if pair[1]]
        if not pairs:
            continue
        sides = [column([pair[n] for pair in pairs]) for n in (0, 1)]
        sooner = sum(float(a['normalized_time']) < float(b['normalized_time']) for a, b in pairs)
        reading, sight, r, where = cell
        text = {name: ' / '.join(side[name] for side in sides) for name in ('time', 'far', 'split')}
        whole = ' / '.join(side['complete'].split()[0] for side in sides)
        print(f'| {reading}, {sight} | {r} | {where} | {whole} of {len(pairs)} | {text["time"]} | {sooner} of {len(pairs)} | {text["far"]} | {text["split"]} |')


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    command = commands.add_parser('run')
    command.add_argument('--part', choices=('worlds', 'loss', 'deaths', 'obstacles'), default='worlds')
    command.add_argument('--seeds', default='1', help='1 or 1-10')
    command.add_argument('--rows', default='out/argos/rows.csv')
    command.add_argument('--banyan', default=BANYAN)
    command.add_argument('--argos', default='argos3')
    command.set_defaults(call=run)
    command = commands.add_parser('tables')
    command.add_argument('files', nargs='+')
    command.add_argument('--by-radius', action='store_true')
    command.set_defaults(call=tables)
    command = commands.add_parser('claims')
    command.add_argument('files', nargs='+')
    command.set_defaults(call=claims)
    args = parser.parse_args()
    args.call(args)


if __name__ == '__main__':
    main()
