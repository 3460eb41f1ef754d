#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The table of a study in pandas: medians, and a paired comparison of two algorithms.

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
print(runs.groupby(axes)["normalized_time"].describe()[["count", "25%", "50%", "75%"]].to_string(), "\n")

# The same seed is the same start: compare run by run.
others = [a for a in axes if a != "algorithm"] + ["seed"]
pairs = runs.pivot_table(index=others, columns="algorithm", values="normalized_time")
if pairs.shape[1] == 2:
    first, second = pairs.columns
    difference = pairs[first] - pairs[second]
    print(f"{first} - {second}: median {difference.median():+.4f} of the limit, "
          f"{first} sooner in {(difference < 0).mean():.0%} of {len(difference)} pairs")
