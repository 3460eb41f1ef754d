# SPDX-License-Identifier: MIT
# Tuning with an optimiser in Python: the cross-entropy method looks for parameters of outwards that make it faster.
# scipy.optimize, nevergrad or Optuna fit in the same place.
import sys

import numpy as np

import banyan

KEYS = ("target_gain", "interaction_gain", "ideal_distance")
scenario = banyan.Scenario("scenarios/three-targets.toml", algorithm="outwards", set={"swarm.redundancy": 4})
rows = {row["key"]: row for row in banyan.algorithms["outwards"]["parameters"]}
low, high = (np.array([rows[key][bound] for key in KEYS]) for bound in ("minimum", "maximum"))


def cost(values, seeds):
    """Share of the time limit that the mission takes, 1 if it is not completed; and the share of time in pieces."""
    try:
        runs = [banyan.run(scenario, seed=seed, parameters=dict(zip(KEYS, values))) for seed in seeds]
    except banyan.ScenarioError:  # lengths in the wrong order
        return 2.0
    return np.mean([run["normalized_time"] + run["disconnected_time_ratio"] for run in runs])


generations, population = (int(word) for word in sys.argv[1:3]) if len(sys.argv) > 2 else (8, 16)
random = np.random.default_rng(1)
mean = np.array([banyan.parameters("outwards")[key] for key in KEYS])
first, spread = mean, 0.15 * mean
for generation in range(generations):
    candidates = np.clip(random.normal(mean, spread, (population, len(KEYS))), low, high)
    costs = np.array([cost(candidate, seeds=(1, 2)) for candidate in candidates])
    best = candidates[np.argsort(costs)[: population // 4]]
    mean, spread = best.mean(axis=0), best.std(axis=0) + 0.02 * mean
    print(f"generation {generation + 1}: best {costs.min():.3f}")
print("parameters:", {key: round(float(value), 3) for key, value in zip(KEYS, mean)})
print(f"on seeds not seen: {cost(first, range(11, 19)):.3f} as it was, {cost(mean, range(11, 19)):.3f} now")
