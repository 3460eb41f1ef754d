#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The tables of docs/arena.md, from the results of studies/arena.toml.

   python3 studies/arena_tables.py results/arena docs/arena.md

Rewrites what stands between <!-- table: NAME --> and <!-- end --> in the page; without a page it
prints all tables. Needs nothing but Python's standard library.
"""
import csv
import gzip
import os
import re
import statistics
import sys


def rows_of(path):
    if os.path.exists(path):
        file = open(path, newline="", encoding="utf-8")
    else:
        file = gzip.open(path + ".gz", "rt", newline="", encoding="utf-8")
    with file:
        return list(csv.DictReader(file))


class Arena:
    """Runs by part, radio and contender, and what the comparisons with convoy say."""

    def __init__(self, folder):
        self.runs, self.contenders = {}, []
        for row in rows_of(f"{folder}/runs.csv"):
            if row["error"] or not row["ticks"]:
                continue
            if row["contender"] not in self.contenders:
                self.contenders.append(row["contender"])
            self.runs.setdefault((row["part"], row["radio"], row["contender"]), []).append(row)
        self.comparisons = {}
        for row in rows_of(f"{folder}/comparisons.csv"):
            pooled = all(row.get(axis, "") in ("*", "") for axis in ("k", "r", "T")) and row["contender"] == "*"
            if pooled and row["radio"] != "*":
                self.comparisons[(row["part"], row["radio"], row["metric"], row["first"])] = row

    def of(self, part, radio, contender):
        return self.runs.get((part, radio, contender), [])


def table(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def missed(runs):
    return f"{sum(r['complete'] != 'true' for r in runs)}/{len(runs)}"


def time(runs):
    ratios = [float(r["time_ratio"]) for r in runs if r["time_ratio"]]
    return f"{statistics.median(ratios):.2f} ({max(ratios):.2f})" if ratios else "–"


def robots(runs):
    ratios = [float(r["committed_ratio"]) for r in runs if r["complete"] == "true"]
    return f"{statistics.mean(ratios):.2f}" if ratios else "–"


def percent(share):
    return f"{100 * share:.1f} %" if share > 0 else "0"


def broken(runs):
    return percent(statistics.mean(float(r["disconnected_time_ratio"]) for r in runs)) if runs else "–"


def split(runs):
    return percent(statistics.mean(float(r["split_ticks"]) / float(r["ticks"]) for r in runs)) if runs else "–"


def results(arena, part, radios):
    header = ["contender"]
    for radio in radios:
        header += [f"{radio}: missed", "time", "robots", "broken", "split"]
    rows = []
    for contender in arena.contenders:
        row = [contender]
        for radio in radios:
            runs = arena.of(part, radio, contender)
            row += [missed(runs), time(runs), robots(runs), broken(runs), split(runs)]
        rows.append(row)
    return table(header, rows)


def deaths(arena):
    header = ["contender"]
    for radio in ("clear", "sight"):
        header += [f"{radio}: missed", "time", "recovered", "broken", "split"]
    rows = []
    for contender in arena.contenders:
        row = [contender]
        for radio in ("clear", "sight"):
            runs = arena.of("deaths", radio, contender)
            row += [missed(runs), time(runs), f"{sum(r['recovered'] == 'true' for r in runs)}/{len(runs)}", broken(runs),
                    split(runs)]
        rows.append(row)
    return table(header, rows)


def signed(text):
    value = float(text)
    return f"{value:+.2f}" if abs(value) < 100 else f"{value:+.0f}"


def verdict(arena, part, radio, metric, contender):
    row = arena.comparisons.get((part, radio, metric, contender))
    if not row or not row["verdict"]:
        return "–"
    words = f"{row['verdict']} {signed(row['shift'])} ({signed(row['holm_low'])} to {signed(row['holm_high'])})"
    return words + (f"; misses: {row['misses']}" if metric == "time_ratio" and row["misses"] else "")


def verdicts(arena, part):
    header = ["contender", "clear: time", "robots", "sight: time", "robots", "broken"]
    rows = []
    for contender in arena.contenders:
        if contender == "convoy":
            continue
        rows.append([contender] + [verdict(arena, part, radio, metric, contender) for radio, metric in (
            ("clear", "time_ratio"), ("clear", "committed_ratio"), ("sight", "time_ratio"), ("sight", "committed_ratio"),
            ("sight", "disconnected_time_ratio"))])
    return table(header, rows)


TABLES = {
    "rings": lambda a: results(a, "rings", ("clear", "sight")),
    "random": lambda a: results(a, "random", ("clear", "sight")),
    "rings-loss": lambda a: results(a, "rings", ("loss", "sight+loss")),
    "random-loss": lambda a: results(a, "random", ("loss", "sight+loss")),
    "deaths": deaths,
    "rings-verdicts": lambda a: verdicts(a, "rings"),
    "random-verdicts": lambda a: verdicts(a, "random"),
}


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    arena = Arena(sys.argv[1])
    if len(sys.argv) == 2:
        for name, make in TABLES.items():
            print(f"{name}\n\n{make(arena)}")
        return
    with open(sys.argv[2], encoding="utf-8") as file:
        page = file.read()
    for name in re.findall(r"<!-- table: ([\w-]+) -->", page):
        if name not in TABLES:
            sys.exit(f"{sys.argv[2]}: there is no table {name}")
        made = TABLES[name](arena)
        page = re.sub(rf"(<!-- table: {name} -->\n).*?(<!-- end -->)", lambda m, t=made: m[1] + t + m[2], page, flags=re.S)
    with open(sys.argv[2], "w", encoding="utf-8") as file:
        file.write(page)


if __name__ == "__main__":
    main()
