# SPDX-License-Identifier: MIT
"""What the scripts share that play missions one by one, elsewhere than in our world.

Not a program. A mission is a dict of strings; `key` names those that say which mission it is.
"""
import csv
import os
import shutil
import subprocess
import sys
import tempfile

HOUSE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
BANYAN = os.path.join(HOUSE, 'build/release/bin/banyan')


def result(command, out, columns):
    """These columns of the row that a command leaves in the folder `out`; a mission that is not complete is one, too."""
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    path = os.path.join(out, 'run.csv')
    if not os.path.exists(path):
        sys.exit(f'{" ".join(command)}: no result\n{done.stdout[-2000:]}')
    with open(path, newline='') as file:
        row = next(csv.DictReader(file))
    return {name: row[name] for name in columns}


def play_all(rows, wanted, key, columns, play):
    """Adds a row to the table `rows` for each wanted mission that it does not have: play(mission, folder) returns the columns."""
    os.makedirs(os.path.dirname(rows) or '.', exist_ok=True)
    done = set()
    if os.path.exists(rows):
        with open(rows, newline='') as file:
            done = {tuple(row[name] for name in key) for row in csv.DictReader(file)}
    else:
        with open(rows, 'w') as file:
            file.write(','.join(key + columns) + '\n')
    for n, mission in enumerate(wanted):
        if tuple(mission[name] for name in key) in done:
            continue
        folder = tempfile.mkdtemp(prefix='banyan-mission-')
        try:
            row = mission | play(mission, folder)
        finally:
            shutil.rmtree(folder)
        with open(rows, 'a', newline='') as file:  # a line at a time: an interruption costs one mission
            csv.DictWriter(file, key + columns).writerow(row)
        print(f'{n + 1} of {len(wanted)}: {" ".join(mission[name] for name in key)}: {row["completion_time_s"]} s', flush=True)
