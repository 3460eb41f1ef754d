# SPDX-License-Identifier: MIT
# A run in Python and its curves: how far the workers have to go and how well the network is connected, in one figure.
import sys

import matplotlib

matplotlib.use("Agg")  # no window
from matplotlib import pyplot

import banyan

folder = sys.argv[1] if len(sys.argv) > 1 else "."
result = banyan.run("scenarios/paper-medium.toml", algorithm="convoy", seed=3, series=True, trajectories=2)
series, tracks = result.series, result.trajectories

figure, (above, below, ways) = pyplot.subplots(1, 3, figsize=(12, 4), layout="constrained")
above.plot(series["time_s"], series["worst_target_distance_m"])
above.set(xlabel="time (s)", ylabel="farthest worker from its target (m)")
computed = series["fiedler"] >= 0  # once a second
below.semilogy(series["time_s"][computed], series["fiedler"][computed])
below.set(xlabel="time (s)", ylabel="algebraic connectivity $\\lambda_2$")
for robot in range(tracks["positions"].shape[1]):
    colour = ["tab:gray", "tab:green", "tab:blue", "tab:red"][tracks["roles"][-1, robot]]
    ways.plot(*tracks["positions"][:, robot].T, color=colour, linewidth=0.8)
ways.set(xlabel="x (m)", ylabel="y (m)", aspect="equal")
figure.savefig(f"{folder}/paper-medium.png")
with open(f"{folder}/paper-medium.svg", "w", encoding="utf-8") as file:
    file.write(result.frame.svg(width=800))  # in a notebook, `result` alone shows it

print(f"{result}: {len(series)} ticks, hash {result['hash']}")
