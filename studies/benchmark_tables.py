#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The tables of docs/benchmark.md, from the results of studies/benchmark.toml and of the tunings in results/tune.

   python3 studies/benchmark_tables.py results/benchmark docs/benchmark.md

Rewrites what stands between <!-- table: NAME --> and <!-- end --> in the page; without a page it
prints all tables. Those of studies/growth.toml and studies/oracle.toml are made of the folders growth and
oracle beside that of the benchmark; without these the page keeps the ones it has. Needs nothing but Python's
standard library.
"""
import glob
import json
import os
import statistics
import sys

from tables import rows_of, table, write_page

NO_EDGES = ("fiedler", "cohesion")  # they promise to keep no link


def has_edges(contender):
    return contender.split()[0] not in NO_EDGES


class Benchmark:
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


def numbers(runs, column):
    """Its values, without those that do not exist."""
    return [float(r[column]) for r in runs if r.get(column)]


def median_and_worst(ratios):
    return f"{statistics.median(ratios):.2f} ({max(ratios):.2f})" if ratios else "–"


def missed(runs):
    return f"{sum(r['complete'] != 'true' for r in runs)}/{len(runs)}" if runs else "–"


def time(runs):
    return median_and_worst(numbers(runs, "time_ratio"))


def robots(runs):
    ratios = [float(r["committed_ratio"]) for r in runs if r["complete"] == "true"]
    return f"{statistics.mean(ratios):.2f}" if ratios else "–"


def percent(share):
    return f"{100 * share:.1f} %" if share > 0 else "0"


def broken(runs, contender):
    if not has_edges(contender):
        return "no edges"
    return percent(statistics.mean(float(r["disconnected_time_ratio"]) for r in runs)) if runs else "–"


def silent(runs, contender):
    if not has_edges(contender):
        return "no edges"
    ratios = [float(r["disconnected_time_ratio_after_silence"]) for r in runs]
    return percent(statistics.mean(ratios)) if ratios else "–"


def split(runs):
    return percent(statistics.mean(float(r["split_ticks"]) / float(r["ticks"]) for r in runs)) if runs else "–"


def results(benchmark, part, radios):
    header = ["contender"]
    for radio in radios:
        header += [f"{radio}: missed", "time", "robots", "broken", "split"]
    rows = []
    for contender in benchmark.contenders:
        row = [contender]
        for radio in radios:
            runs = benchmark.of(part, radio, contender)
            row += [missed(runs), time(runs), robots(runs), broken(runs, contender), split(runs)]
        rows.append(row)
    return table(header, rows)


def leaky(benchmark, part):
    """Sight that leaks, beside what is broken where it does not."""
    header = ["contender", "sight: broken", "silent", "leaky: missed", "time", "robots", "broken", "silent"]
    rows = []
    for contender in benchmark.contenders:
        exact, leaks = benchmark.of(part, "sight", contender), benchmark.of(part, "leaky", contender)
        rows.append([contender, broken(exact, contender), silent(exact, contender),
                     missed(leaks), time(leaks), robots(leaks), broken(leaks, contender), silent(leaks, contender)])
    return table(header, rows)


def deaths(benchmark):
    header = ["contender"]
    for radio in ("clear", "sight"):
        header += [f"{radio}: missed", "time", "recovered", "broken", "split"]
    rows = []
    for contender in benchmark.contenders:
        row = [contender]
        for radio in ("clear", "sight"):
            runs = benchmark.of("deaths", radio, contender)
            row += [missed(runs), time(runs), f"{sum(r['recovered'] == 'true' for r in runs)}/{len(runs)}",
                    broken(runs, contender), split(runs)]
        rows.append(row)
    return table(header, rows)


def mean(runs, column, decimals):
    values = numbers(runs, column)
    return f"{statistics.mean(values):,.{decimals}f}" if values else "–"


def messages_per_decision(runs, contender):
    if not has_edges(contender):
        return "no edges"
    decisions = sum(numbers(runs, "decisions"))
    return f"{sum(numbers(runs, 'messages')) / decisions:,.0f}" if decisions else "–"


def costs(benchmark):
    kinds = [(part, radio) for part in ("rings", "random") for radio in ("clear", "sight")]
    header = ["contender", "bytes"]
    for part, radio in kinds:
        header += [f"{part}, {radio}: driven", "messages"]
    rows = []
    for contender in benchmark.contenders:
        row = [contender, mean([run for kind in kinds for run in benchmark.of(*kind, contender)], "bytes_per_robot_s", 0)]
        for part, radio in kinds:
            runs = benchmark.of(part, radio, contender)
            row += [mean(runs, "driven_m", 1), messages_per_decision(runs, contender)]
        rows.append(row)
    return table(header, rows)


def by_size(rows, make):
    """A value for each number of robots, the smallest first."""
    sizes = sorted({int(row["N"]) for row in rows})
    return " · ".join(make([row for row in rows if int(row["N"]) == size]) for size in sizes)


def share_committed(runs):
    shares = [float(r["committed"]) / float(r["robots"]) for r in runs if r["complete"] == "true"]
    return f"{100 * statistics.mean(shares):.0f} %" if shares else "–"


def share_bound(runs):
    return f"{100 * statistics.mean(float(r['robots_bound']) / float(r['robots']) for r in runs):.0f} %"


def median_time(runs):
    ratios = numbers(runs, "time_ratio")
    return f"{statistics.median(ratios):.2f}" if ratios else "–"


def growth(runs):
    """A row per contender, whose cells have a value for each number of robots."""
    header = ["contender", "missed", "time", "robots", "broken", "bytes", "messages", "driven (m)"]
    rows = [["bound", "", "", by_size(runs, share_bound), "", "", "", ""]]
    for contender in dict.fromkeys(row["contender"] for row in runs):
        own = [row for row in runs if row["contender"] == contender]
        edges = has_edges(contender)
        rows.append([contender, by_size(own, missed), by_size(own, median_time), by_size(own, share_committed),
                     by_size(own, lambda r, c=contender: broken(r, c)) if edges else "no edges",
                     by_size(own, lambda r: mean(r, "bytes_per_robot_s", 0)),
                     by_size(own, lambda r, c=contender: messages_per_decision(r, c)) if edges else "no edges",
                     by_size(own, lambda r: mean(r, "driven_m", 1))])
    return table(header, rows)


def oracle(runs):
    """Against an oracle that knows all positions."""
    groups = {}
    for row in runs:
        groups.setdefault((row["contender"], row["radio"], row["k"]), []).append(row)
    kinds = list(dict.fromkeys((radio, k) for _, radio, k in groups))
    header = ["contender"]
    for radio, k in kinds:
        header += [f"{radio}, k = {k}: missed", "time", "robots"]
    rows = []
    for contender in dict.fromkeys(contender for contender, _, _ in groups):
        row = [contender]
        for kind in kinds:
            group = groups.get((contender, *kind), [])
            done = [run for run in group if run["complete"] == "true"]
            times = [float(r["completion_time_s"]) / float(r["oracle_time_s"]) for r in done if r["oracle_time_s"]]
            row += [missed(group), median_and_worst(times), median_and_worst(numbers(done, "oracle_ratio"))]
        rows.append(row)
    return table(header, rows)


def oracle_extent(runs):
    """Targets are drawn by seed and number, whatever k and radio."""
    drawn = {(row["T"], row["seed"]): row for row in runs}.values()
    exact = sum(row["oracle_exact"] == "true" for row in drawn)
    later = sum(float(row["oracle_time_s"]) > float(row["time_bound_s"]) for row in runs if row["oracle_time_s"])
    builds = ", ".join(sorted({row["git"] for row in runs}))
    return (f"{len(runs):,} runs by commit {builds}. The oracle's number of robots is known to be the least for "
            f"{exact} of the {len(drawn)} sets of targets. Its time is longer than the lower bound in "
            f"{later or 'none'} of the runs.\n")


def signed(text):
    return f"{float(text):+.2f}".replace("-", "−").replace("+0.00", "0.00").replace("−0.00", "0.00")


def misses(row):
    return "" if row["misses"] in ("", "undecided") else f"; misses: {row['misses']}"


def verdict(benchmark, part, radio, metric, contender):
    row = benchmark.comparisons.get((part, radio, metric, contender))
    if not row or not row["verdict"]:
        return "–"
    if metric == "disconnected_time_ratio" and not has_edges(contender):
        return "no edges"
    if "inf" in row["holm_low"] + row["holm_high"]:
        return f"{row['verdict']} {signed(row['shift'])}" + misses(row)
    words = f"{row['verdict']} {signed(row['shift'])} ({signed(row['holm_low'])} to {signed(row['holm_high'])})"
    return words + misses(row)


def verdicts(benchmark, part):
    header = ["contender", "clear: time", "robots", "sight: time", "robots", "broken"]
    rows = []
    for contender in benchmark.contenders:
        if contender == "convoy":
            continue
        rows.append([contender] + [verdict(benchmark, part, radio, metric, contender) for radio, metric in (
            ("clear", "time_ratio"), ("clear", "committed_ratio"),
            ("sight", "time_ratio"), ("sight", "committed_ratio"), ("sight", "disconnected_time_ratio"))])
    return table(header, rows)


def extent(benchmark):
    """How much of the study there is."""
    runs = [row for rows in benchmark.runs.values() for row in rows]
    seeds = sorted({int(row["seed"]) for row in runs})
    builds = ", ".join(sorted({row["git"] for row in runs}))
    complete = all(sum(int(row["seed"]) == seed for row in runs) * len(seeds) == len(runs) for seed in seeds)
    text = f"The tables are of {len(runs):,} of the runs of `studies/benchmark.toml`, with the seed{'s' if len(seeds) > 1 else ''} "
    text += ", ".join(map(str, seeds)) + f", by commit {builds}."
    return text + ("" if complete else " Not every cell has all of these seeds.") + "\n"


def kept_tunings(pattern):
    """By folder: what a tuning has left in its tune.json, and its candidates by name."""
    here = os.path.dirname(os.path.abspath(__file__))
    for path in sorted(glob.glob(os.path.join(here, "../results/tune", pattern, "tune.json"))):
        with open(path, encoding="utf-8") as file:
            done = json.load(file)
        yield os.path.dirname(path), done, {c["name"]: c for c in done["candidates"]}


def tunings(_):
    """A row per tuning: the fitness of the defaults and of the best, and parameters that ended at a bound."""
    rows = []
    for folder, done, candidates in kept_tunings("benchmark-*"):
        best, untuned = candidates["best"], candidates["default"]
        bounds = done["tuning"]["bounds"]
        edge = []
        for key, value in best["parameters"].items():
            low, high = bounds[key]
            if min(value - low, high - value) < 0.01 * (high - low):
                edge.append(f"`{key}` {value:.4g}")
        row = [os.path.basename(folder).removeprefix("benchmark-").replace("-literal", " printed"), str(len(bounds))]
        for seeds in ("training", "test"):
            row.append(f"{untuned[seeds]['fitness']:.3f} → {best[seeds]['fitness']:.3f}")
        complete = [f"{100 * c['test']['complete_share']:.0f} %" for c in (untuned, best)]
        rows.append(row + [" → ".join(complete), ", ".join(edge)])
    header = ["algorithm", "parameters", "fitness, training seeds", "test seeds", "complete, test seeds", "at a bound"]
    return table(header, rows)


def fronts(_):
    """A row per front: its two ends, and its fittest point beside that of the tuning for fitness alone."""
    rows = []
    for folder, _, candidates in kept_tunings("front-benchmark-*"):
        points = rows_of(os.path.join(folder, "front.csv"))
        name = os.path.basename(folder).removeprefix("front-benchmark-")
        row = [name, str(len(points))]
        for goal in ("normalized_time", "cost"):
            end = min(points, key=lambda point, goal=goal: float(point[goal]))
            row += [f"{float(end['normalized_time']):.3f}", f"{100 * float(end['committed']):.0f} %",
                    percent(float(end["disconnected"]))]
        row.append(f"{candidates['best']['test']['fitness']:.3f}")
        row += [f"{tuned['best']['test']['fitness']:.3f}" for _, _, tuned in kept_tunings(f"benchmark-{name}")]
        rows.append(row)
    header = ["algorithm", "points", "fastest: time", "robots", "disconnected", "cheapest: time", "robots",
              "disconnected", "fitness, test seeds: NSGA-II", "CMA-ES"]
    return table(header, rows) if rows else None


TABLES = {
    "tunings": tunings,
    "fronts": fronts,
    "extent": extent,
    "rings": lambda a: results(a, "rings", ("clear", "sight")),
    "random": lambda a: results(a, "random", ("clear", "sight")),
    "rings-loss": lambda a: results(a, "rings", ("loss", "sight+loss")),
    "random-loss": lambda a: results(a, "random", ("loss", "sight+loss")),
    "rings-leaky": lambda a: leaky(a, "rings"),
    "random-leaky": lambda a: leaky(a, "random"),
    "deaths": deaths,
    "costs": costs,
    "rings-verdicts": lambda a: verdicts(a, "rings"),
    "random-verdicts": lambda a: verdicts(a, "random"),
}

# Tables of other studies, whose results lie beside those of the benchmark.
BESIDE = {
    "growth": ("growth", growth),
    "oracle-extent": ("oracle", oracle_extent),
    "oracle": ("oracle", oracle),
}


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    benchmark = Benchmark(sys.argv[1])
    made = {name: make(benchmark) for name, make in TABLES.items()}
    beside = os.path.dirname(os.path.abspath(sys.argv[1]))
    for name, (study, make) in BESIDE.items():
        folder = os.path.join(beside, study)
        made[name] = None
        if os.path.isdir(folder):
            made[name] = make([row for row in rows_of(os.path.join(folder, "runs.csv")) if row["ticks"]])
    if len(sys.argv) == 3:
        write_page(sys.argv[2], made)
        return
    for name, text in made.items():
        if text is not None:
            print(f"{name}\n\n{text}")


if __name__ == "__main__":
    main()
