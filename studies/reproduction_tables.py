#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The tables of docs/reproduction.md, from the statistics of studies/paper.toml.

   python3 studies/reproduction_tables.py results/paper docs/reproduction.md

Rewrites what stands between <!-- table: NAME --> and <!-- end --> in the page; without a page it
prints all tables. Needs nothing but Python's standard library.
"""
import os
import sys

from tables import rows_of, table, write_page

READINGS = ["literal", "corrected"]
SIGHT = ["off", "on"]
RADII = ["3", "6", "9"]
ALGORITHMS = ["outwards", "inwards"]


def shown(reading):
    """Convoy has nothing printed that could be read in two ways: its rows stand with `corrected`."""
    return ALGORITHMS + (["convoy"] if reading == "corrected" else [])


class Statistics:
    """Rows of statistics.csv and comparisons.csv by part, metric and the labels of axes."""

    def __init__(self, folder):
        self.folder = folder
        statistics = rows_of(f"{folder}/statistics.csv")
        self.rows = self._by_metric(statistics)
        self.comparisons = self._by_metric(rows_of(f"{folder}/comparisons.csv"))
        columns = list(statistics[0])
        self.axes = columns[1:columns.index("metric")]

    @staticmethod
    def _by_metric(rows):
        index = {}
        for row in rows:
            index.setdefault((row["part"], row["metric"]), []).append(row)
        return index

    def runs(self, part):
        """The rows of runs.csv of this part."""
        return [row for row in rows_of(f"{self.folder}/runs.csv") if row["part"] == part]

    def _find(self, rows, labels):
        # Axes that are not named are pooled, or do not exist in this part.
        wanted = {axis: labels.get(axis, "*") for axis in self.axes}
        found = [r for r in rows if all(r[a] == w or (w == "*" and r[a] == "") for a, w in wanted.items())]
        if len(found) != 1:
            sys.exit(f"{len(found)} rows instead of one for {labels}")
        return found[0]

    def of(self, part, metric, **labels):
        return self._find(self.rows[(part, metric)], labels)

    def compare(self, part, metric, pair=tuple(ALGORITHMS), **labels):
        of_pair = [r for r in self.comparisons[(part, metric)] if (r["first"], r["second"]) == pair]
        return self._find(of_pair, labels)


def percent(row, field="positive"):
    value = 100 * float(row[field])
    return f"{value:.0f}" if value in (0, 100) or value >= 10 else f"{value:.1f}"


def share(value):
    """Per cent with one decimal, or with one digit where that would be nothing."""
    return f"{100 * value:.1f}" if value == 0 or value >= 0.001 else f"{100 * value:.1g}"


def interval(row):
    return f"{percent(row)} ({percent(row, 'positive_low')}–{percent(row, 'positive_high')})"


def number(text, digits=3):
    return f"{float(text):.{digits}f}"


def p_value(text):
    value = float(text)
    if value >= 0.001:
        return f"{value:.3f}"
    return "< 0.001" if value > 1e-300 else "0"


def signed(row, field, low, high):
    if row[low] == "-inf":
        return f"{float(row[field]):+.3f} ({row['ranked']} pairs: no interval)"
    return f"{float(row[field]):+.3f} ({float(row[low]):+.3f} to {float(row[high]):+.3f})"


def missed(row):
    return int(row["first_missed"]) + int(row["second_missed"]) > 0


def difference(row):
    """The shift where both complete, with its interval at the level of p after Holm's correction; p; and the verdict."""
    verdict = row["verdict"] + (f"; misses: {row['misses']}" if missed(row) else "")
    return [signed(row, "shift", "holm_low", "holm_high"), p_value(row["p_holm"]), verdict]


def time_row(s, part, **labels):
    """Medians of all runs, who missed, shift where both complete, who was sooner there, verdict. Restricted means stand
    where somebody missed: elsewhere they would be a second answer to the question of the shift."""
    row = s.compare(part, "normalized_time", **labels)
    shift, p, verdict = difference(row)
    return ([number(s.of(part, "normalized_time", algorithm=a, **labels)["median"]) for a in ALGORITHMS]
            + [f"{row['first_missed']} / {row['second_missed']} of {row['pairs']}", shift, p,
               f"{100 * int(row['second_larger']) / int(row['ranked']):.0f}",
               signed(row, "mean_difference", "mean_low", "mean_high") if missed(row) else "", verdict])


TIME_HEADER = ["outwards", "inwards", "missed", "outwards − inwards where both complete", "p (Holm)",
               "outwards sooner there, %", "means up to the limit, outwards − inwards", "outwards is"]


def time(s):
    rows = [[reading, los, f"{r} m"] + time_row(s, "worlds", reading=reading, los=los, r=r)
            for reading in READINGS for los in SIGHT for r in RADII]
    return table(["reading", "line of sight", "r"] + TIME_HEADER, rows)


def by_redundancy(s, part, metric, ks):
    """A share of runs, per radius and redundancy."""
    rows = []
    for reading in READINGS:
        for los in SIGHT:
            for algorithm in shown(reading):
                cells = [" / ".join(percent(s.of(part, metric, reading=reading, los=los, algorithm=algorithm, r=r, k=k))
                                    for k in ks) for r in RADII]
                rows.append([reading, los, algorithm] + cells)
    ks_text = "/".join(ks)
    return table(["reading", "line of sight", "algorithm"] + [f"r = {r} m, k = {ks_text}" for r in RADII], rows)


def complete(s):
    return by_redundancy(s, "worlds", "complete", ["2", "3", "4"])


def split(s):
    return by_redundancy(s, "worlds", "split_ticks", ["2", "3", "4"])


def fiedler(s):
    return by_redundancy(s, "worlds", "fiedler_time_ratio", ["2", "3", "4"])


def broken(s):
    rows = []
    for reading in READINGS:
        for los in SIGHT:
            for algorithm in shown(reading):
                cells = []
                for r in RADII:
                    labels = dict(reading=reading, los=los, algorithm=algorithm, r=r)
                    cells.append(" / ".join(
                        [percent(s.of("worlds", f"disconnected_time_ratio_by_{why}", **labels)) for why in ("distance", "occlusion")]
                        + [f"{100 * float(s.of('worlds', 'disconnected_time_ratio', **labels)['mean']):.1f}"]))
                rows.append([reading, los, algorithm] + cells)
    return table(["reading", "line of sight", "algorithm"] + [f"r = {r} m" for r in RADII], rows)


def broken_by_redundancy(s):
    return by_redundancy(s, "worlds", "disconnected_time_ratio_by_distance", ["2", "3", "4"])


def redundancy(s):
    ks = ["2", "4", "6", "8"]
    rows = []
    for reading in READINGS:
        for los in SIGHT:
            for algorithm in shown(reading):
                for r in RADII:
                    labels = [dict(reading=reading, los=los, algorithm=algorithm, r=r, k=k) for k in ks]

                    def shares(metric, labels=labels):
                        return " / ".join(percent(s.of("redundancy", metric, **one)) for one in labels)

                    rows.append([reading, los, algorithm, f"{r} m",
                                 " / ".join(number(s.of("redundancy", "normalized_time", **one)["median"]) for one in labels),
                                 shares("complete"), shares("disconnected_time_ratio_by_distance"), shares("split_ticks")])
    return table(["reading", "line of sight", "algorithm", "r", "median time, k = 2/4/6/8", "complete, %",
                  "edge broken by distance, % of runs", "network split, % of runs"], rows)


def sweep(s, part, axis, values):
    rows = []
    for reading in READINGS:
        for algorithm in shown(reading):
            for value in values:
                labels = [dict(reading=reading, algorithm=algorithm, r=r) | {axis: value} for r in RADII]
                rows.append([reading, algorithm, value,
                             " / ".join(percent(s.of(part, "complete", **one)) for one in labels),
                             " / ".join(number(s.of(part, "normalized_time", **one)["median"]) for one in labels),
                             " / ".join(percent(s.of(part, "disconnected_time_ratio_by_distance", **one)) for one in labels),
                             " / ".join(percent(s.of(part, "split_ticks", **one)) for one in labels)])
    return table(["reading", "algorithm", axis, "complete, %, r = 3/6/9 m", "median time", "edge broken by distance, % of runs",
                  "network split, % of runs"], rows)


def gain(s):
    return sweep(s, "gain", "K", ["0.1", "0.2", "0.4", "0.8"])


def pull(s):
    rows = [[reading, tau, f"{r} m"] + time_row(s, "pull", reading=reading, tau=tau, r=r)
            for reading in READINGS for tau in ("0.2539", "0.49", "1") for r in RADII]
    return table(["reading", "τ of both", "r"] + TIME_HEADER, rows)


def real(s):
    rows = []
    for part, text in (("real-two", "2 targets, same start, 15 runs"), ("real-three", "3 targets, same start, 10 runs"),
                       ("random-two", "2 targets, random starts, 50 runs"), ("random-three", "3 targets, random starts, 50 runs")):
        for reading in READINGS:
            for body in ("disks", "box2d"):
                labels = dict(reading=reading, los="off", body=body)
                done = [percent(s.of(part, "complete", algorithm=a, **labels)) for a in shown(reading)]
                rows.append([text, reading, body, " / ".join(done)]
                            + time_row(s, part, **labels))
    return table(["set-up", "reading", "bodies", "complete, %, outwards / inwards (/ convoy)"] + TIME_HEADER, rows)


def tuned(s):
    """From results/tuned: each set of parameters, where it was tuned and where it was not."""
    rows = []
    for algorithm in ALGORITHMS:
        for parameters in ("Table I", "small", "large"):
            def cells(metric, show, parameters=parameters, algorithm=algorithm):
                rings = [[show(s.of(f"{algorithm}-rings", metric, parameters=parameters, los=los, r=r)) for r in RADII]
                         for los in SIGHT]
                return ([show(s.of(f"{algorithm}-nine", metric, parameters=parameters))]
                        + [" / ".join(one) for one in rings]
                        + [" / ".join(show(s.of(f"{algorithm}-random", metric, parameters=parameters, los=los)) for los in SIGHT)])

            rows.append([algorithm, parameters, "time"] + cells("normalized_time", lambda row: number(row["median"])))
            rows.append(["", "", "edge broken, %"] + cells("disconnected_time_ratio_by_distance", percent))
    return table(["algorithm", "parameters", "", "nine robots", "rings 3/6/9 m, sight off", "rings 3/6/9 m, sight on",
                  "random targets, sight off/on"], rows)


# The conditions of studies/claims.toml: words, part, labels of the axis that is its factor.
CONDITIONS = ([("the paper's settings", "start", {"start": "compact"})]
              + [(f"K = {K}", "gain", {"K": K}) for K in ("0.1", "0.4", "0.8")]
              + [(f"τ = {tau} for both", "pull", {"tau": tau}) for tau in ("0.2539", "0.49", "1")]
              + [("limit of 5 straight drives", "limit", {}),
                 ("sight on, exact", "sight", {"sight": "exact"}), ("sight on, leaky", "sight", {"sight": "leaky"}),
                 ("bodies of Box2D", "body", {"body": "box2d"}), ("random start", "start", {"start": "random"})])


def duel(row):
    """Shift where both complete and verdict, and who missed the limit how often: outwards / inwards."""
    shift = f"{float(row['shift']):+.3f} " if row["ranked"] != "0" else ""
    misses = f"; {row['first_missed']} / {row['second_missed']}, {row['misses']}" if missed(row) else ""
    return f"{shift}{row['verdict'] or 'no pairs'}{misses}"


def claims(s, reading):
    """By radius, k = 2 and 4 together, for (a) and (b); misses by k, all radii together, for (c)."""
    rows = []
    for words, part, labels in CONDITIONS:
        def of(labels=labels, part=part, **more):
            return s.compare(part, "normalized_time", reading=reading, **labels, **more)

        late = [of(k=k) for k in ("2", "4")]
        rows.append([words] + [duel(of(r=r)) for r in RADII]
                    + [f"{row['first_missed']} / {row['second_missed']}, {row['misses'] or 'undecided'}" for row in late])
    header = [f"({claim}) r = {r} m" for claim, r in zip("abb", RADII)]
    return table(["condition"] + header + [f"(c) missed, k = {k}, of {late[0]['pairs']}" for k in ("2", "4")], rows)


def claims_literal(s):
    return claims(s, "literal")


def claims_corrected(s):
    return claims(s, "corrected")


def claims_redundancy(s):
    """Larger and larger swarms, each radius by itself."""
    rows = [[reading, k] + [duel(s.compare("redundancy", "normalized_time", reading=reading, r=r, k=k)) for r in RADII]
            for reading in READINGS for k in ("2", "3", "4", "6", "8")]
    return table(["reading", "k"] + [f"r = {r} m" for r in RADII], rows)


def claims_large(s):
    """The same factors as far as studies/paper.toml has them, with more runs: (a) and (b), and for (c) who missed at which k."""
    levels = [("K", "gain", ("0.1", "0.4", "0.8")), ("tau", "pull", ("0.2539", "0.49", "1"))]
    rows = []
    for axis, part, values in levels:
        late = misses(s, part, ("reading", axis, "k"))
        for reading in READINGS:
            for value in values:
                name = f"τ = {value} for both" if axis == "tau" else f"{axis} = {value}"
                rows.append([reading, name]
                            + [duel(s.compare(part, "normalized_time", reading=reading, r=r, **{axis: value})) for r in RADII]
                            + [", ".join(" / ".join(str(n) for n in late[(reading, value, k)]) for k in ("2", "3", "4"))])
    rows.sort(key=lambda row: READINGS.index(row[0]))
    return table(["reading", "condition"] + [f"({claim}) r = {r} m" for claim, r in zip("abb", RADII)]
                 + ["(c) missed at k = 2, 3, 4, of 90"], rows)


def misses(s, part, axes):
    """How many runs of outwards and of inwards are not complete, by labels of these axes."""
    late = {}
    for row in s.runs(part):
        if row["algorithm"] in ALGORITHMS:
            count = late.setdefault(tuple(row[axis] for axis in axes), [0, 0])
            count[ALGORITHMS.index(row["algorithm"])] += row["complete"] != "true"
    return late


def claims_limit(s):
    """Runs that are not complete by the limit, and by half of it: the same runs, cut."""
    late = {}
    for row in s.runs("redundancy"):
        if row["algorithm"] not in ALGORITHMS:
            continue
        count = late.setdefault(tuple(row[axis] for axis in ("reading", "los", "k", "algorithm")), [0, 0, 0])
        done = row["complete"] == "true"
        for k, is_late in enumerate((True, not done, not done or float(row["normalized_time"]) > 0.5)):
            count[k] += is_late
    rows = []
    for reading in READINGS:
        for los in SIGHT:
            for k in ("2", "4", "6", "8"):
                both = [late[(reading, los, k, algorithm)] for algorithm in ALGORITHMS]
                rows.append([reading, los, k, str(both[0][0])] + [" / ".join(str(one[limit]) for one in both) for limit in (1, 2)])
    return table(["reading", "line of sight", "k", "runs each", "missed within 10 straight drives, outwards / inwards",
                  "within 5"], rows)


def silences(s):
    """Share of time with a broken tree edge: at least one tick, and after a silence longer than I."""
    rows = []
    for reading in READINGS:
        for sight in ("off", "exact", "leaky"):
            for algorithm in ALGORITHMS:
                cells = []
                for r in RADII:
                    labels = dict(reading=reading, algorithm=algorithm, r=r, sight=sight)
                    cells.append(" / ".join(share(float(s.of("sight", metric, **labels)["mean"])) for metric in (
                        "disconnected_time_ratio", "disconnected_time_ratio_after_silence")))
                rows.append([reading, sight, algorithm] + cells)
    return table(["reading", "line of sight", "algorithm"] + [f"r = {r} m" for r in RADII], rows)


def convoy(s):
    """Convoy beside the paper's two in their corrected reading."""
    rows = []
    for los in SIGHT:
        for r in RADII:
            def of(metric, field, los=los, r=r):
                return [float(s.of("worlds", metric, reading="corrected", los=los, algorithm=a, r=r)[field]) for a in shown("corrected")]
            rows.append([los, f"{r} m", " / ".join(f"{v:.3f}" for v in of("normalized_time", "median")),
                         " / ".join(percent({"positive": v}) for v in of("disconnected_time_ratio", "positive")),
                         " / ".join(share(v) for v in of("disconnected_time_ratio", "mean")),
                         " / ".join(f"{v:.1f}" for v in of("committed", "mean"))])
    return table(["line of sight", "r", "median time, outwards / inwards / convoy", "runs with a broken edge, %",
                  "share of time with one, %", "robots in the tree at the end, mean"], rows)


def equal_pull(s):
    """All three with the same target gain, the paper's two as corrected."""
    rows = []
    for tau in ("0.2539", "0.49", "1"):
        for r in RADII:
            labels = dict(reading="corrected", tau=tau, r=r)

            def all_three(metric, field, digits, labels=labels):
                return " / ".join(number(s.of("pull", metric, algorithm=a, **labels)[field], digits) for a in shown("corrected"))

            row = [tau, f"{r} m", all_three("normalized_time", "median", 3)]
            for algorithm in ALGORITHMS:
                test = s.compare("pull", "normalized_time", pair=(algorithm, "convoy"), **labels)
                row += difference(test)
            rows.append(row + [all_three("committed", "mean", 1)])
    return table(["τ of all", "r", "median time, outwards / inwards / convoy", "outwards − convoy", "p (Holm)", "outwards is",
                  "inwards − convoy", "p (Holm)", "inwards is", "robots in the tree at the end, mean"], rows)


TABLES = {"convoy": convoy, "equal-pull": equal_pull, "time": time, "complete": complete, "broken": broken,
          "broken-by-redundancy": broken_by_redundancy, "split": split, "fiedler": fiedler, "redundancy": redundancy, "gain": gain, "pull": pull, "real": real,
          "claims-large": claims_large, "claims-limit": claims_limit}
# Tables of another study, whose results lie beside those of the first.
OTHERS = {"tuned": ("tuned", tuned), "claims-literal": ("claims", claims_literal),
          "claims-corrected": ("claims", claims_corrected), "claims-redundancy": ("claims", claims_redundancy),
          "silences": ("claims", silences)}


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else "results/paper"
    beside = os.path.dirname(os.path.abspath(folder))
    s = Statistics(folder)
    made = {name: make(s) for name, make in TABLES.items()}
    for name, (other, make) in OTHERS.items():
        if os.path.isdir(os.path.join(beside, other)):
            made[name] = make(Statistics(os.path.join(beside, other)))
    if len(sys.argv) < 3:
        for name, text in made.items():
            print(f"## {name}\n\n{text}")
        return
    write_page(sys.argv[2], made)


if __name__ == "__main__":
    main()
