# SPDX-License-Identifier: MIT
"""The ledger shown: a page for the terminal, Markdown, and a figure with a line for each class."""
import importlib.util
import math
import statistics
import sys
from pathlib import Path

from ledger_verdict import COLUMNS, percent, signed

FIGURES = Path(__file__).resolve().parents[1] / 'hosts' / 'python' / 'banyan' / 'figures.py'
COLOURS = {'worse': '31;1', 'better': '32', 'undecided': '33', 'new': '2', 'not worse': '0'}


def written(column, value):
    """A column's own value."""
    if value is None or math.isnan(value):
        return ''
    return {'share': f'{100 * value:.1f}' if value < 0.9995 or value == 0 else '100', 'ratio': f'{value:.2f}' if value < 99 else f'{value:.0f}',
            'number': f'{value:.2f}'}[column.scale]


def quantile(values, share):
    return values[min(len(values) - 1, math.ceil(share * len(values)) - 1)] if values else math.nan


def cells(judged):
    """The row of a class: its columns in the order of the page."""
    row = [judged.name, str(len(judged.rows))]
    for name, column in COLUMNS.items():
        if not column.on_page:
            continue
        d = judged.columns.get(name)
        row.append(written(column, d.now if d else None))
        if name == 'time':
            row += [f'{quantile(judged.times, 0.95):.2f}', f'{quantile(judged.times, 1.0):.1f}'] if judged.times else ['', '']
    allowed = f'{100 * judged.tolerance:.3g}'
    return [*row, judged.words, allowed, judged.verdict]


def heads():
    titles = []
    for column in COLUMNS.values():
        if column.on_page:
            titles += [column.title, '95%', 'worst'] if column.name == 'time' else [column.title]
    return ['class', 'n', *titles, 'difference [95 %]', 'tol', 'verdict']


def aligned(rows, left):
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    return [' '.join(cell.ljust(width) if k in left else cell.rjust(width) for k, (cell, width) in enumerate(zip(row, widths, strict=True))).rstrip()
            for row in rows]


def accepted_lines(against):
    for one in against.accepted if against else []:
        yield f'accepted: {one["class"]}, {one["difference"]}, at {one["commit"]}: {one["reason"]}'


def verdicts(judged):
    count = {}
    for one in judged:
        count[one.verdict] = count.get(one.verdict, 0) + 1
    return ', '.join(f'{n} {verdict}' for verdict, n in count.items())


def differences(one):
    """Every column of a class with its standard error."""
    yield [one.name, 'now', 'baseline', 'difference', 'std. error', 'pairs', 'what it is']
    for name, column in COLUMNS.items():
        d = one.columns.get(name)
        if d is None or not (column.on_page or name == one.primary.name or d.now or d.base):
            continue
        compared = not math.isnan(d.mean)
        yield [name, written(column, d.now), written(column, d.base), signed(column, d.mean) if compared else '',
               '' if math.isnan(d.error) else signed(column, d.error).lstrip('+'), str(d.pairs or len(one.rows)), column.meaning]


def by_axis(one, axes):
    """A class apart: a row for each value of these axes of its missions, with what they come to now."""
    groups = {}
    for mission, row in one.missions:
        labels = dict(text.split(' ', 1) for text in mission.split(', ') if ' ' in text)
        groups.setdefault(tuple(labels.get(axis, '') for axis in axes), []).append(row)
    columns = [column for column in COLUMNS.values() if column.on_page or column.name in (one.primary.name, 'recovery')]
    values = {group: [[value for value in map(column.value, rows) if not math.isnan(value)] for column in columns] for group, rows in groups.items()}
    shown = [n for n in range(len(columns)) if any(each[n] for each in values.values())]
    yield [*axes, 'n', *(columns[n].title for n in shown)]
    for group, each in values.items():
        yield [*group, str(len(groups[group])), *(written(columns[n], statistics.fmean(each[n]) if each[n] else None) for n in shown)]


def terminal(judged, cost, against, words, detail=False, by=()):
    colour = sys.stdout.isatty()
    lines = [f'\n{words}; shares and their differences in %, time and robots as ratios', '']
    table = aligned([heads(), *map(cells, judged)], left={0, len(heads()) - 3, len(heads()) - 1})
    lines.append(table[0])
    lines += [f'\033[{COLOURS.get(one.verdict, "0")}m{line}\033[0m' if colour else line for one, line in zip(judged, table[1:], strict=True)]
    if detail:
        for one in judged:
            lines += ['', one.about, *aligned(list(differences(one)), left={0, 6})]
            lines += ['', *aligned(list(by_axis(one, by)), left=set(range(len(by))))] if by else []
    return '\n'.join([*lines, '', *cost, *accepted_lines(against), verdicts(judged)])


def markdown(judged, cost, against, words, detail=False, by=()):
    def table(rows):
        rows = list(rows)
        return ['| ' + ' | '.join(row) + ' |' for row in [rows[0], ['---'] * len(rows[0]), *rows[1:]]]

    lines = [f'{words[0].upper()}{words[1:]}. Shares and their differences in %, time and robots as ratios.', '', *table([heads(), *map(cells, judged)])]
    for one in judged if detail else []:
        lines += ['', f'**{one.name}**: {one.about}', '', *table(by_axis(one, by) if by else differences(one))]
    notes = [*cost, *accepted_lines(against), verdicts(judged)]
    return '\n'.join([*lines, '', *(f'- {note}' for note in notes)])


def figure(judged, words, file):
    """One line a class: the difference of its primary column with the 95 % interval; grey: what the tolerance allows.
    What lies beyond the axis stands at its end, with its number."""
    spec = importlib.util.spec_from_file_location('figures', FIGURES)  # the look of all figures
    figures = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(figures)
    shown = [one for one in reversed(judged) if one.words]
    ends = [[-one.primary.more * percent(one.primary, value) for value in (d.mean, d.low, d.high)]
            for one in shown for d in [one.columns[one.primary.name]]]
    reach = min(40.0, max(5.0, *(1.15 * abs(value) for line in ends for value in line)))
    clip = lambda value: max(-reach, min(reach, value))  # noqa: E731
    colours = {'worse': figures.SERIES[1][0], 'better': figures.SERIES[2][0]}
    with figures.styled():
        picture = figures.Figure(figsize=(figures.PAGE_IN, 0.7 + 0.16 * len(shown)), layout='constrained')
        axes = picture.subplots()
        for n, (one, (mean, low, high)) in enumerate(zip(shown, ends, strict=True)):
            axes.barh(n, clip(100 * one.tolerance), height=0.8, color=figures.GRID)
            style = {'color': colours.get(one.verdict, 'black'), 'linewidth': 1.2}
            axes.plot([clip(low), clip(high)], [n, n], **style)
            axes.plot([clip(mean)], [n], marker='o', markersize=3.5, clip_on=False, **style)
            if abs(mean) > reach:
                axes.text(0.97 * clip(mean), n + 0.1, f'{mean:+.0f}', ha='right' if mean > 0 else 'left', va='bottom', size=6)
        axes.axvline(0, color=figures.FRAME, linewidth=0.5)
        axes.set(xlim=(-reach, reach), ylim=(-0.7, len(shown) - 0.3), title=words)
        axes.set_xlabel('better   <   difference: shares in points, time and robots in %   >   worse')
        axes.set_yticks(range(len(shown)), [one.name if one.name == one.primary.name else f'{one.name}: {one.primary.name.replace("_", " ")}'
                                            for one in shown])
        axes.tick_params(axis='y', length=0)
        axes.spines['left'].set_visible(False)
        figures.save(picture, Path(file).with_suffix(''), ['svg'])
