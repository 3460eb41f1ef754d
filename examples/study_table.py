#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The tables of a study in pandas: quartiles, misses, and the paired comparisons of the algorithms.

   ./banyan study studies/first.toml
   python3 examples/study_table.py out/first        (Debian: python3-pandas)
"""
import sys

import pandas as pd

folder = sys.argv[1] if len(sys.argv) > 1 else "out/first"
runs = pd.read_csv(f"{folder}/runs.csv")
runs = runs[runs["error"].isna()]

# Columns that say what was run and differ within this study; of two that say the same, the first.
axes = []
for c in runs.columns[: runs.columns.get_loc("robots")]:
    if c in ("study", "run", "error", "name", "seed", "version", "git") or runs[c].nunique() < 2:
        continue
    if all(runs.groupby([a, c]).ngroups > runs[a].nunique() for a in axes):
        axes.append(c)
groups = runs.groupby(axes)
table = groups["normalized_time"].describe()[["count", "25%", "50%", "75%"]]
table["missed"] = groups["complete"].agg(lambda complete: (~complete).sum())
print(table.to_string(), "\n")

# Runs of the same seed in the same world are pairs. The shift is that of Hodges and Lehmann, first - second, in the
# pairs that both complete (ranked), with the interval of its test after Holm's correction (docs/studies.md).
comparisons = pd.read_csv(f"{folder}/comparisons.csv")
times = comparisons[comparisons["metric"] == "normalized_time"]
shown = [a for a in axes if a in times and (times[a] != "*").any()]
print(times[shown + ["first", "second", "verdict", "shift", "holm_low", "holm_high", "ranked", "first_missed",
                     "second_missed"]].to_string(index=False))
