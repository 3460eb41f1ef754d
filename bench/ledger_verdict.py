# SPDX-License-Identifier: MIT
"""The ledger's columns and verdicts: each mission is paired with the same of the baseline.

Shares are compared by their difference, time and the like by the mean of the logarithms' differences, so as a ratio.
"""
import math
import statistics
from dataclasses import dataclass, field


def number(text, otherwise=math.nan):
    return float(text) if text not in ('', 'true', 'false') else {'true': 1.0, 'false': 0.0}.get(text, otherwise)


def time_over_bound(row):
    """A mission that never completes counts with its limit."""
    time = number(row['completion_time_s']) if row['complete'] == 'true' else number(row['time_limit_s'])
    return time / max(number(row['time_bound_s']), 0.1)


def share_of_ticks(column):
    return lambda row: number(row[column]) / max(number(row['ticks']), 1.0)


def happened(column):
    return lambda row: float(number(row[column]) > 0)


def has_deaths(row):
    return number(row['deaths']) > 0


def robots_over_oracle(row):
    ratio = row['oracle_ratio'] or row['committed_ratio']
    return number(ratio) if row['complete'] == 'true' else math.nan


@dataclass(frozen=True)
class Column:
    name: str
    title: str        # at the head of a table
    meaning: str
    value: object     # of a row; NaN: it has none
    scale: str        # 'share', 'ratio' or 'number': how it is compared and written
    more: int = -1    # -1: less is better, +1: more is
    on_page: bool = True


COLUMNS = {column.name: column for column in [
    Column('complete', 'compl', 'missions completed', lambda r: number(r['complete']), 'share', +1),
    Column('recovered', 'recov', 'missions with deaths that recovered', lambda r: number(r['recovered']) if has_deaths(r) else math.nan, 'share', +1),
    Column('split', 'split', 'missions in which the network fell apart, occlusion included', happened('split_ticks'), 'share'),
    Column('far', 'far', 'missions with an edge broken by distance', happened('broken_ticks_by_distance'), 'share'),
    Column('hidden', 'hid', 'missions with an occluded edge', happened('broken_ticks_by_occlusion'), 'share'),
    Column('hidden_time', 'hid t', 'ticks with an occluded edge', share_of_ticks('broken_ticks_by_occlusion'), 'share'),
    Column('time', 'time', 'time / lower bound; missions that never complete count with the limit', time_over_bound, 'ratio'),
    Column('robots', 'robots', "robots in the tree / the oracle's, of completed missions", robots_over_oracle, 'ratio'),
    Column('held', 'held', 'targets held from completion on', lambda r: number(r['held_time_ratio'], 0.0), 'share', +1),
    Column('false', 'false', 'false replacements per mission: of workers, where no robot dies',
           lambda r: math.nan if has_deaths(r) else number(r['replacements']), 'number'),
    Column('bytes', 'bytes', 'bytes per robot and second', lambda r: number(r['bytes_per_robot_s']), 'ratio'),
    Column('recovery', 'rec s', 'time of recovery in seconds; without, 200 s',
           lambda r: max(number(r['recovery_time_s'], 200.0), 0.1) if has_deaths(r) else math.nan, 'ratio', -1, False),
    Column('split_time', 'split t', 'ticks out of one piece', share_of_ticks('split_ticks'), 'share', -1, False),
    Column('redundant', '2 paths', 'time with two disjoint paths', lambda r: number(r['redundant_time_ratio'], 0.0), 'share', +1, False),
    Column('severed', 'severed', 'missions in which workers or root were cut off', happened('severed_ticks'), 'share', -1, False),
    Column('enough', 'enough', 'missions that hold all but one of the targets that the oracle holds',
           lambda r: float(number(r['held_targets']) >= number(r['oracle_targets']) - 1), 'share', +1, False),
]}


@dataclass
class Difference:
    """Of one column, now minus baseline; positive is more, whether that is better or not."""
    now: float
    base: float
    pairs: int
    mean: float = math.nan   # shares and numbers: a difference; ratios: of the logarithms
    error: float = math.nan  # its standard error
    low: float = math.nan    # 95 % interval
    high: float = math.nan
    lost: int = 0            # missions that have a value in the baseline only


def t_quantile(degrees):
    """97.5 % of Student's t: Abramowitz and Stegun 26.7.5, within 0.3 % from 5 degrees on; below, from a table."""
    if degrees < 5:
        return {1: 12.706, 2: 4.303, 3: 3.182, 4: 2.776}.get(degrees, math.inf)
    z = 1.959964
    v = degrees
    return (z + (z**3 + z) / (4 * v) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * v**2)
            + (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / (384 * v**3))


def differ(column, pairs):
    """The difference over pairs (now, baseline) of rows; None where no row has a value. A mission that has one on one side
    only, as when it is never complete and so has no deaths, counts as the worst there in a share; else it is `lost`."""
    worst = (0.0 if column.more > 0 else 1.0) if column.scale == 'share' else math.nan
    both = [(column.value(now), column.value(base)) for now, base in pairs]
    both = [tuple(worst if math.isnan(value) else value for value in pair) for pair in both if not all(map(math.isnan, pair))]
    lost = sum(math.isnan(a) for a, _ in both)
    both = [pair for pair in both if not any(map(math.isnan, pair))]
    if not both:
        return Difference(math.nan, math.nan, 0, lost=lost) if lost else None
    now, base = (statistics.fmean(side) for side in zip(*both, strict=True))
    result = Difference(now, base, len(both), lost=lost)
    each = [math.log(max(a, 1e-9) / max(b, 1e-9)) if column.scale == 'ratio' else a - b for a, b in both]
    result.mean = statistics.fmean(each)
    if len(each) > 1:
        result.error = statistics.stdev(each) / math.sqrt(len(each))
    elif each[0] == 0.0:
        result.error = 0.0
    reach = t_quantile(len(each) - 1) * result.error if result.error else 0.0
    result.low, result.high = result.mean - reach, result.mean + reach
    return result


@dataclass
class Judged:
    name: str
    about: str
    primary: Column
    tolerance: float
    missions: list  # (name, row)
    columns: dict = field(default_factory=dict)  # name -> Difference, or None where no mission has a value
    verdict: str = ''
    times: list = field(default_factory=list)

    @property
    def rows(self):
        return [row for _, row in self.missions]

    @property
    def words(self):
        """The primary column's difference and its interval."""
        d = self.columns.get(self.primary.name)
        return '' if d is None or math.isnan(d.mean) else f'{self.primary.name} {signed(self.primary, d.mean)} [{signed(self.primary, d.low)}, {signed(self.primary, d.high)}]'


def percent(column, difference):
    return 100 * (math.expm1(difference) if column.scale == 'ratio' else difference)


def signed(column, difference):
    """With its unit: % of what it was, or points."""
    if column.scale == 'number':
        return f'{difference:+.2f}'
    return f'{percent(column, difference) + 0.0:+.1f}{"%" if column.scale == "ratio" else ""}'


def judge(one, rows, base):
    """A class judged by its primary column: better, not worse, undecided, worse; or new, without a baseline."""
    keys = [key for key in rows if key[1] == one.name]
    judged = Judged(one.name, one.about, COLUMNS[one.primary], one.tolerance, [(key[2], rows[key]) for key in keys])
    pairs = [(rows[key], base[key]) for key in keys if key in base]
    for name, column in COLUMNS.items():
        judged.columns[name] = differ(column, pairs) if pairs else alone(column, judged.rows)
    judged.times = sorted(time_over_bound(row) for row in judged.rows)
    judged.verdict = verdict_of(judged) if pairs else 'new' if judged.rows else 'not played'
    return judged


def alone(column, rows):
    values = [value for value in map(column.value, rows) if not math.isnan(value)]
    return Difference(statistics.fmean(values), math.nan, 0) if values else None


def verdict_of(judged):
    d = judged.columns[judged.primary.name]
    if d is not None and d.lost > judged.tolerance * (d.pairs + d.lost):
        return 'worse'
    if d is None or math.isnan(d.error):
        return 'undecided'
    # As "how much worse": the interval's ends, and the tolerance on the same scale.
    worse = sorted((-judged.primary.more * d.low, -judged.primary.more * d.high))
    allowed = math.log1p(judged.tolerance) if judged.primary.scale == 'ratio' else judged.tolerance
    tiny = 1e-12
    if worse[1] < -tiny:
        return 'better'
    if worse[1] <= allowed + tiny:
        return 'not worse'
    return 'worse' if worse[0] > allowed + tiny else 'undecided'
