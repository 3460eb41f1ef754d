# SPDX-License-Identifier: MIT
"""What a step costs: instructions per robot and tick (callgrind counts them, so they repeat), and robot-steps per second."""
import re
import shutil
import subprocess
import tempfile
import time
from pathlib import Path

from ledger_missions import Failed


def command(program, house, one, ticks, out, algorithm):
    settings = dict(one.get('set', {})) | {'mission.time_limit_s': ticks / 10}
    if algorithm:
        settings['mission.algorithm'] = algorithm
    words = [str(program), 'run', str(house / one['scenario']), '--out', out, '--force', '--quiet', '--set', 'output.record=false']
    for key, value in settings.items():
        words += ['--set', f'{key}={str(value).lower()}']
    return words


def instructions(words):
    """Of a whole process and its threads."""
    counted = subprocess.run(['valgrind', '--tool=callgrind', '--callgrind-out-file=/dev/null', *words], capture_output=True, text=True)
    found = re.search(r'Collected *: *(\d+)', counted.stderr)
    if not found or counted.returncode != 0:
        raise Failed(f'valgrind: {counted.stderr.strip()[-1000:]}')
    return int(found[1])


def seconds(words):
    begun = time.monotonic()
    subprocess.run(words, check=True, capture_output=True)
    return time.monotonic() - begun


def robots_in(out):
    return int(re.search(r'"robots": *(\d+)', (Path(out) / 'run.json').read_text().split('"result"')[1])[1])


def measure(ledger, program, work, algorithm):
    """{name: {"instructions": per robot-step, "steps_per_s": ...}}; without valgrind nothing is counted."""
    counts = {}
    with tempfile.TemporaryDirectory(dir=work) as out:
        for one in ledger.cost:
            first, last = one['ticks']
            short, long = (command(program, ledger.house, one, ticks, out, algorithm) for ticks in (first, last))
            times = [seconds(long) - seconds(short) for _ in range(5)]
            steps = robots_in(out) * (last - first)
            counts[one['name']] = {'steps_per_s': round(steps / max(sorted(times)[2], 1e-3), -3)}
            if shutil.which('valgrind'):
                counts[one['name']]['instructions'] = round((instructions(long) - instructions(short)) / steps)
    return counts


def compare(now, base, here, against):
    """Lines about each: instructions are compared only where the baseline was counted under the same compiler and libc."""
    same = against is not None and (against.compiler, against.libc) == (here['compiler'], here['libc'])
    lines = []
    for name, counts in now.items():
        words = f'{name}: '
        if 'instructions' in counts:
            words += f'{counts["instructions"]:,} instructions a robot-step'
            before = base.get(name, {}).get('instructions')
            if before and same:
                words += f' ({100 * (counts["instructions"] / before - 1):+.1f}%)'
            elif before:
                words += f' (not compared: the baseline is of {against.compiler}, {against.libc})'
            words += ', '
        lines.append(words + f'{counts["steps_per_s"]:,.0f} robot-steps/s of one core')
    return lines
