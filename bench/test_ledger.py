# SPDX-License-Identifier: MIT
"""The ledger's arithmetic against tables and hand-made rows, and a whole ledger with the real program."""
import importlib.util
import json
import math
import os
import subprocess
import sys
from importlib.machinery import SourceFileLoader
from pathlib import Path

import pytest

BENCH = Path(__file__).resolve().parent
sys.path.insert(0, str(BENCH))
import ledger_baseline as baselines  # noqa: E402
import ledger_cost as cost  # noqa: E402
import ledger_missions as missions  # noqa: E402
import ledger_page as page  # noqa: E402
import ledger_verdict as verdict  # noqa: E402

PROGRAM = os.environ['BANYAN_PROGRAM']
LEDGER = missions.load(BENCH / 'ledger.toml')
ROW = dict.fromkeys(missions.KEPT, '') | {
    'git': 'abc', 'ticks': '100', 'complete': 'true', 'time_limit_s': '80', 'time_bound_s': '10', 'completion_time_s': '12', 'held_time_ratio': '1',
    'oracle_ratio': '1.2', 'split_ticks': '0', 'broken_ticks_by_distance': '0', 'broken_ticks_by_occlusion': '0', 'severed_ticks': '0',
    'replacements': '0', 'bytes_per_robot_s': '960', 'deaths': '0', 'recovered': 'false', 'held_targets': '3', 'oracle_targets': '3'}


def rows(name, count=20, **changes):
    """So many missions of a class, whose cells are functions of the mission's number."""
    return {('work', name, f'mission {n}', n): ROW | {key: str(value(n)) for key, value in changes.items()} for n in range(count)}


def judged(name, now, base):
    return verdict.judge(next(one for one in LEDGER.classes if one.name == name), now, base)


@pytest.mark.parametrize(('degrees', 'value'), [(1, 12.706), (2, 4.303), (3, 3.182), (5, 2.571), (10, 2.228), (30, 2.042), (120, 1.980)])
def test_the_quantile_is_that_of_tables(degrees, value):
    assert verdict.t_quantile(degrees) == pytest.approx(value, rel=3e-3)


def test_differences_are_those_of_a_paired_t_test():
    now = rows('worlds', 4, completion_time_s=lambda n: [11, 22, 33, 44][n])
    base = rows('worlds', 4, completion_time_s=lambda n: [10, 20, 30, 20][n])
    d = judged('worlds', now, base).columns['time']
    logs = [math.log(1.1)] * 3 + [math.log(2.2)]
    mean = sum(logs) / 4
    error = math.sqrt(sum((x - mean) ** 2 for x in logs) / 3 / 4)
    assert (d.mean, d.error) == (pytest.approx(mean), pytest.approx(error))
    assert d.high - d.mean == pytest.approx(3.182 * error, rel=3e-3)
    assert (d.now, d.base, d.pairs) == (pytest.approx(2.75), pytest.approx(2.0), 4)


def test_a_mission_that_never_completes_counts_with_its_limit():
    late = rows('worlds', 1, complete=lambda n: 'false', completion_time_s=lambda n: '')
    assert judged('worlds', late, {}).columns['time'].now == pytest.approx(8.0)


def test_verdicts_follow_the_interval_and_the_tolerance():
    base = rows('worlds', completion_time_s=lambda n: 12)
    slower = lambda share: rows('worlds', completion_time_s=lambda n: 12 * (1 + share + 0.001 * (n % 3)))  # noqa: E731
    assert judged('worlds', base, base).verdict == 'not worse'
    assert judged('worlds', slower(0.01), base).verdict == 'not worse'
    assert judged('worlds', slower(0.05), base).verdict == 'worse'
    assert judged('worlds', slower(-0.05), base).verdict == 'better'
    scattered = rows('worlds', completion_time_s=lambda n: 12 * (1.5 if n % 2 else 0.7))
    assert judged('worlds', scattered, base).verdict == 'undecided'
    assert judged('worlds', base, {}).verdict == 'new'


def test_more_is_better_where_it_is():
    every, none = rows('deaths', deaths=lambda n: 3, recovered=lambda n: 'true'), rows('deaths', deaths=lambda n: 3, recovered=lambda n: 'false')
    assert judged('deaths', none, every).verdict == 'worse'
    assert judged('deaths', every, none).verdict == 'better'


def test_missions_that_lose_what_is_judged_count_against():
    base = rows('deaths', deaths=lambda n: 3, recovered=lambda n: 'true')
    half = rows('deaths', deaths=lambda n: 3 * (n % 2), recovered=lambda n: 'true' if n % 2 else 'false', complete=lambda n: 'true' if n % 2 else 'false')
    assert judged('deaths', half, base).columns['recovered'].now == 0.5
    assert judged('deaths', half, base).verdict == 'worse'
    assert judged('robots', rows('robots', complete=lambda n: 'true' if n % 2 else 'false'), rows('robots')).verdict == 'worse'
    assert judged('robots', rows('robots', complete=lambda n: 'false'), rows('robots')).verdict == 'worse'


def test_false_replacements_are_those_without_deaths():
    one = judged('deaths', rows('deaths', 2, deaths=lambda n: n, replacements=lambda n: 4 - n), {})
    assert one.columns['false'].now == 4.0


def test_missions_have_names_of_their_own_and_quick_ones_are_among_them():
    for one in LEDGER.classes:
        names = [name for part in one.parts for name, _ in missions.of_part(one, part)]
        assert len(set(names)) == len(names), one.name
        axes = [len(part['axes']) for part in one.parts]
        assert {name.count(', ') + 1 for name in names} == set(axes), f'{one.name}: a label has a comma'
        assert one.primary in verdict.COLUMNS
        whole, quick = ({(part['name'], label) for part in missions.study_of([one], ['work'], quick=q)['parts'] for label in part['axes'][0]['labels']}
                        for q in (False, True))
        assert quick <= whole
        assert min(one.quick, 1) <= len(quick) <= one.quick + len(one.parts), one.name


def test_quick_missions_are_spread_over_the_axes():
    deaths = next(one for one in LEDGER.classes if one.name == 'deaths')
    labels = ' '.join(missions.study_of([deaths], ['work'], quick=True)['parts'][0]['axes'][0]['labels'])
    worlds = next(axis for axis in deaths.parts[0]['axes'] if axis.get('name') == 'world')
    for _, label, _ in missions.axis_values(worlds, BENCH.parent):
        assert f'world {label}' in labels


def test_report_seeds_are_other_seeds():
    def seeds(which):
        return {part['seeds'] for part in missions.study_of(LEDGER.classes, [which])['parts']}
    first = {int(text.split('-')[0]) for text in seeds('work')}, {int(text.split('-')[1]) for text in seeds('work')}
    assert max(first[1]) < min(int(text.split('-')[0]) for text in seeds('report'))


def test_a_baseline_comes_back_as_it_was_written(tmp_path, monkeypatch):
    monkeypatch.setattr(baselines, 'FOLDER', tmp_path)
    written = rows('worlds', 3)
    file = baselines.write('one', written, {'94 robots': {'instructions': 5}}, [{'class': 'a', 'commit': 'b', 'difference': 'c', 'reason': 'd'}])
    first = file.read_bytes()
    baselines.write('one', dict(reversed(written.items())), {}, [])
    assert file.read_bytes() == first
    back = baselines.read('one')
    assert {key: {name: row[name] for name in missions.KEPT} for key, row in back.rows.items()} == written
    assert back.commit == 'abc'
    assert baselines.read('two') is None


def test_instructions_are_compared_only_under_the_same_compiler():
    here = {'compiler': 'gcc 1', 'libc': 'glibc 2'}
    now, base = {'a': {'instructions': 110, 'steps_per_s': 1}}, {'a': {'instructions': 100, 'steps_per_s': 1}}
    assert '+10.0%' in cost.compare(now, base, here, baselines.Baseline(**here))[0]
    assert 'not compared' in cost.compare(now, base, here, baselines.Baseline(compiler='gcc 2', libc='glibc 2'))[0]


def test_the_page_shows_differences_and_accepted_losses():
    base = rows('worlds')
    against = baselines.Baseline(accepted=[{'class': 'worlds', 'commit': 'abc', 'difference': 'time +5 %', 'reason': 'half the code'}])
    one = judged('worlds', rows('worlds', completion_time_s=lambda n: 15), base)
    for shown in (page.terminal, page.markdown):
        text = shown([one], ['94 robots: 5'], against, 'now', detail=True, by=['mission'])
        assert 'half the code' in text and 'worse' in text and '+25.0%' in text
    assert all(len(line) <= 150 for line in page.terminal([one], [], None, 'now').splitlines())


@pytest.fixture
def ledger(tmp_path):
    def call(*words):
        return subprocess.run([sys.executable, BENCH / 'ledger', '--program', PROGRAM, '--folder', tmp_path / 'ledger', *words], capture_output=True, text=True)
    return call


def test_two_algorithms_of_the_program_are_compared(ledger, tmp_path):
    picture = tmp_path / 'ledger.svg'
    done = ledger('--algorithm', 'outwards', '--baseline', 'convoy', '--quick', '--figure', str(picture), 'moving', 'too-few')
    assert done.returncode == 1, done.stderr
    assert 'outwards against convoy' in done.stdout and 'worse' in done.stdout
    assert 'moving: held' in picture.read_text()


def test_what_cannot_be_is_said(ledger):
    assert 'the classes are worlds, compact' in ledger('world').stderr
    assert '"no-such-thing" is neither a commit nor a baseline' in ledger('--against', 'no-such-thing', '--quick', 'batteries').stderr
    assert 'the classes are worlds' in ledger('--renew', '--accept', 'world', 'because').stderr
    assert '--by needs the names of classes' in ledger('--by', 'who').stderr
    assert ledger('--accept', 'worlds', 'because').returncode == 2


def test_renewing_is_refused_while_a_class_is_worse(tmp_path, monkeypatch, capsys):
    loader = SourceFileLoader('ledger', str(BENCH / 'ledger'))
    program = importlib.util.module_from_spec(importlib.util.spec_from_loader('ledger', loader))
    loader.exec_module(program)
    monkeypatch.setattr(baselines, 'FOLDER', tmp_path)
    now, before = rows('worlds', completion_time_s=lambda n: 15), baselines.Baseline(accepted=[])
    one = judged('worlds', now, rows('worlds'))
    with pytest.raises(SystemExit):
        program.renew(now, {}, [one], ['worlds'], {}, before)
    assert 'worse: worlds' in capsys.readouterr().err
    assert baselines.read(baselines.CURRENT) is None
    program.renew(now, {}, [one], ['worlds'], {'worlds': 'half the code'}, before)
    assert json.loads((tmp_path / 'current.json').read_text())['accepted'][0]['reason'] == 'half the code'
    with pytest.raises(SystemExit):
        program.renew(now, {}, [one], [], {'worlds': 'for nothing'}, before)
