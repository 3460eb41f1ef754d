# SPDX-License-Identifier: MIT
"""The ledger shown: a page for the terminal, Markdown, and a figure with a line for each class."""
import math
import statistics
import subprocess
import sys

from ledger_verdict import COLUMNS, percent, signed

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
    shown = [one for one in reversed(judged) if one.words]
    ends = [[-one.primary.more * percent(one.primary, value) for value in (d.mean, d.low, d.high)]
            for one in shown for d in [one.columns[one.primary.name]]]
    reach = min(40.0, max(5.0, *(1.15 * abs(value) for line in ends for value in line)))
    clip = lambda value: max(-reach, min(reach, value))  # noqa: E731
    objects, data = [], []
    for n, (one, (mean, low, high)) in enumerate(zip(shown, ends, strict=True)):
        objects.append(f'set object rect from graph 0, first {n - 0.4} to first {clip(100 * one.tolerance)}, first {n + 0.4} '
                       'fillcolor rgb "#dddddd" fillstyle solid noborder behind')
        if abs(mean) > reach:
            objects.append(f'set label "{mean:+.0f} " at {0.97 * clip(mean)}, {n} {"right" if mean > 0 else "left"} offset 0, 0.55 font ",9"')
        data.append(f'{clip(mean)} {n} {clip(min(low, high))} {clip(max(low, high))} { {"worse": 1, "better": 2}.get(one.verdict, 3)}')
    names = [one.name if one.name == one.primary.name else f'{one.name}: {one.primary.name.replace("_", " ")}' for one in shown]
    tics = ', '.join(f'"{name}" {n}' for n, name in enumerate(names))
    script = f'''set terminal svg size 700,{90 + 20 * len(shown)} font "sans-serif,11" background "white"
set output "{file}"
set title "{words}" font ",12"
set xrange [{-reach}:{reach}]; set yrange [-0.7:{len(shown) - 0.3}]
set ytics ({tics}) nomirror scale 0; set xtics nomirror; set border 1; unset key
set xlabel "better   <   difference: shares in points, time and robots in %   >   worse"
set arrow from 0, graph 0 to 0, graph 1 nohead lc rgb "#888888"
set linetype 1 lc rgb "#c0392b"; set linetype 2 lc rgb "#1e8449"; set linetype 3 lc rgb "#222222"
{chr(10).join(objects)}
plot "-" using 1:2:3:4:5 with xerrorbars pt 7 ps 0.5 lw 1.5 lc variable
{chr(10).join(data)}
e
'''
    subprocess.run(['gnuplot'], input=script, text=True, check=True)
