# SPDX-License-Identifier: MIT
"""The ledger's missions: bench/ledger.toml made into a study, played by a program that is built here, read back as rows.

A row is keyed by (set, class, mission, seed), where set is work or report and a mission's name lists its axes' labels.
"""
import csv
import itertools
import json
import shutil
import subprocess
import tomllib
from dataclasses import dataclass
from pathlib import Path

# Columns of the table of runs that the ledger's own are made of (docs/file-formats.md).
KEPT = ['git', 'robots', 'ticks', 'time_s', 'complete', 'time_limit_s', 'time_bound_s', 'completion_time_s', 'held_time_ratio', 'held_targets',
        'oracle_targets', 'oracle_ratio', 'committed_ratio', 'redundant_time_ratio', 'severed_ticks', 'broken_ticks_by_distance',
        'broken_ticks_by_occlusion', 'split_ticks', 'replacements', 'bytes_per_robot_s', 'deaths', 'recovered', 'recovery_time_s']


class Failed(Exception):
    """The program or its results cannot be used; the text says why."""


def build(source, folder, log):
    """Builds the program of a checkout in `folder`; its path."""
    with open(log, 'w') as out:
        for command in (['cmake', '-S', source, '-B', folder, '-G', 'Ninja', '-DCMAKE_BUILD_TYPE=Release', '-DBANYAN_BUILD_TESTS=OFF',
                         '-DBANYAN_BUILD_EXAMPLES=OFF', '-DBANYAN_JOIN=ON'], ['ninja', '-C', folder, 'banyan_cli']):
            if subprocess.run(list(map(str, command)), stdout=out, stderr=out).returncode:
                raise Failed(f'the build of {source} failed; see {log}')
    return folder / 'bin' / 'banyan'


@dataclass
class Class:
    name: str
    about: str
    kind: str     # core or edge, for readers
    primary: str
    tolerance: float
    quick: int
    parts: list
    first_seed: dict
    house: Path
    algorithms: str = ''  # 'their own': missions that name their algorithm


@dataclass
class Ledger:
    classes: list
    cost: list
    house: Path

    def chosen(self, names, own_algorithms):
        """The classes of these names, or all; without own_algorithms those only in which the algorithm can be chosen."""
        known = {one.name: one for one in self.classes}
        for name in names:
            if name not in known:
                raise Failed(f'there is no class "{name}"; the classes are {", ".join(known)}')
        return [one for one in self.classes if (not names or one.name in names) and (own_algorithms or not one.algorithms)]


def load(path, house=None):
    path = Path(path)
    house = Path(house or path.resolve().parent.parent)
    with open(path, 'rb') as file:
        text = tomllib.load(file)
    classes = [Class(first_seed=text['first_seed'], house=house, **one) for one in text['classes']]
    return Ledger(classes, text.get('cost', []), house)


def label(value):
    if isinstance(value, bool):
        return 'on' if value else 'off'
    if isinstance(value, list):
        return ' '.join(map(label, value))
    return Path(value).stem if isinstance(value, str) and value.endswith('.toml') else str(value)


def axis_values(axis, house):
    """(name of the axis, label, {key: value}) of each value of an axis."""
    keys = axis.get('keys') or [axis['key']]
    name = axis.get('name') or keys[0].split('.')[-1]
    for n, value in enumerate(axis['values']):
        values = dict(zip(keys, value if 'keys' in axis else [value], strict=True))
        text = axis['labels'][n] if 'labels' in axis else label(value)
        if 'scenario' in values:
            values['scenario'] = str(house / values['scenario'])
        yield name, text, values


def of_part(one, part):
    """All missions of a part: (name, {key: value})."""
    for combination in itertools.product(*(list(axis_values(axis, one.house)) for axis in part['axes'])):
        settings = {}
        for _, _, values in combination:
            settings |= values
        yield ', '.join(f'{name} {text}' for name, text, _ in combination), settings


def spread(items, count):
    """`count` of the items, evenly, but not in step with the last axis: its values take turns."""
    count = min(count, len(items))
    stride = len(items) // count if count else 0
    return [items[n * stride + n % stride] for n in range(count)]


def study_of(classes, sets, quick=False, seeds=1, algorithm=None):
    """A study for `banyan study`: a part for each part of a class and set, whose one axis lists its missions."""
    parts = []
    for one, which in itertools.product(classes, sets):
        for n, part in enumerate(one.parts):
            listed = list(of_part(one, part))
            count = part['seeds'] * seeds
            if quick:
                wanted = -(-one.quick // len(one.parts))
                count = min(count, -(-wanted // len(listed)))
                listed = spread(listed, wanted)
            if not listed:
                continue
            keys = sorted({key for _, settings in listed for key in settings})
            first = one.first_seed[which]
            changes = dict(part.get('set', {}))
            if not one.algorithms:
                changes['mission.algorithm'] = algorithm or 'convoy'
            parts.append({
                'name': f'{one.name}-{n}-{which}', 'scenario': str(one.house / part['scenario']), 'set': changes,
                'seeds': f'{first}-{first + count - 1}',
                'axes': [{'name': 'mission', 'keys': keys, 'labels': [name for name, _ in listed],
                          'values': [[settings[key] for key in keys] for _, settings in listed]},
                         {'name': 'ledger', 'key': 'description', 'values': ['one']}]})
    # One value to compare: this study makes no comparisons of its own.
    return {'name': 'ledger', 'figures': [], 'statistics': {'metrics': ['complete'], 'compare': 'ledger', 'resamples': 100}, 'parts': parts}


def play(classes, program, out, sets, quick=False, seeds=1, algorithm=None):
    """Plays the missions with a program in the folder `out`; the rows."""
    study = study_of(classes, sets, quick, seeds, algorithm)
    if not study['parts']:
        raise Failed('no class that was asked for has missions here: --quick leaves the large ones out, and some name their own algorithms')
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    file = out / 'ledger.json'
    file.write_text(json.dumps(study))
    done = subprocess.run([str(program), 'study', str(file), '--out', str(out / 'study'), '--quiet', '--yes'], capture_output=True, text=True)
    table = out / 'study' / 'runs.csv'
    if done.returncode or not table.exists():
        raise Failed(f'{program}: {(done.stderr or done.stdout).strip()[-2000:] or "no result"}')
    return read(table)


def read(table):
    rows = {}
    with open(table, newline='') as file:
        for row in csv.DictReader(file):
            if lacking := [column for column in KEPT if column not in row]:
                raise Failed(f'{table} has no column "{lacking[0]}": the program is too old for this ledger')
            if row['error']:
                raise Failed(f'{table}: {row["mission"]}, seed {row["seed"]}: {row["error"]}')
            name, _, which = row['part'].rsplit('-', 2)
            rows[which, name, row['mission'], int(row['seed'])] = {key: row[key] for key in KEPT}
    return rows
