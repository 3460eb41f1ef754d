// SPDX-License-Identifier: MIT
// The mission with every algorithm of the list: a line each of its hash, and one of what a robot-step costs.
#pragma once

#include "banyan/algorithms/algorithms.hpp"
#include "mission.hpp"

namespace banyan::chip {

struct Result {
  std::string_view algorithm;
  std::size_t robots = 0;
  std::uint64_t digest = 0;
  Cost cost;
};

inline void run(std::size_t robots, Clock clock, void (*report)(const Result&)) {
  for (const Algorithm* const algorithm : algorithms()) {
    ChipMission mission(*algorithm, robots);
    Cost cost;
    for (int tick = 0; tick < ticks; ++tick) mission.tick(clock, cost);
    Digest digest;
    mission.add_to(digest);
    report({algorithm->name(), robots, digest.value(), cost});
  }
}

}  // namespace banyan::chip
