# SPDX-License-Identifier: MIT
"""Baselines: the rows of a program of some commit, committed as bench/baselines/NAME.csv.gz with NAME.json beside it.

NAME.json says of which commit they are, by which compiler and libc, what a step costs, and which losses were accepted why.
"""
import csv
import gzip
import io
import json
import os
import platform
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from ledger_missions import KEPT

FOLDER = Path(__file__).resolve().parent / 'baselines'
CURRENT = 'current'
KEY = ['set', 'class', 'mission', 'seed']


@dataclass
class Baseline:
    commit: str = ''
    compiler: str = ''
    libc: str = ''
    cost: dict = field(default_factory=dict)
    accepted: list = field(default_factory=list)
    rows: dict = field(default_factory=dict)

    @property
    def title(self):
        return self.commit or 'the baseline'


def names():
    return sorted(path.stem for path in FOLDER.glob('*.json'))


def here():
    """What instruction counts depend on besides the program."""
    compiler = subprocess.run([os.environ.get('CXX', 'c++'), '--version'], capture_output=True, text=True, check=True).stdout.splitlines()[0]
    return {'compiler': compiler, 'libc': ' '.join(platform.libc_ver()) + ', ' + platform.machine()}


def read(name):
    """None if there is no such baseline."""
    about = FOLDER / f'{name}.json'
    if not about.exists():
        return None
    baseline = Baseline(**json.loads(about.read_text()))
    with gzip.open(FOLDER / f'{name}.csv.gz', 'rt', newline='') as file:
        for row in csv.DictReader(file):
            baseline.rows[row['set'], row['class'], row['mission'], int(row['seed'])] = row
    return baseline


def write(name, rows, cost, accepted):
    """The same rows give the same bytes."""
    FOLDER.mkdir(exist_ok=True)
    text = io.StringIO()
    table = csv.writer(text, lineterminator='\n')
    table.writerow(KEY + KEPT)
    for key in sorted(rows):
        table.writerow([*key, *(rows[key][column] for column in KEPT)])
    with open(FOLDER / f'{name}.csv.gz', 'wb') as file, gzip.GzipFile('', 'wb', 9, file, 0) as packed:
        packed.write(text.getvalue().encode())
    about = {'commit': next(iter(rows.values()))['git'], **here(), 'cost': cost, 'accepted': accepted}
    (FOLDER / f'{name}.json').write_text(json.dumps(about, indent=2) + '\n')
    return FOLDER / f'{name}.csv.gz'
