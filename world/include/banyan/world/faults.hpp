// SPDX-License-Identifier: MIT
// What is wrong with a scenario, in a user's words and under the keys of the files (schema.hpp).
// Knows no file: config/ adds file and line.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "banyan/world/scenario.hpp"

namespace banyan::world {

// One thing that is wrong or doubtful. `key` is what it is about as users write it, elements of
// lists counted from 0: "radio.loss", "swarm.start.positions_m[3]", "mission.parameters.target_gain",
// "obstacles[0].size_m", "events[2].loss"; or a whole section, "targets".
struct Fault {
  std::string key;
  std::string text;
  bool warning = false;  // a run is still possible
  // Other keys that have a part in it: a user may have written one of them rather than `key`.
  std::vector<std::string> with{};
};

// Everything that makes `scenario` impossible or doubtful, none if it is fine: ranges, NaN, counts,
// targets in obstacles, robots that do not fit, targets out of reach of the swarm. Safe for any content.
[[nodiscard]] std::vector<Fault> faults(const Scenario& scenario);

// The present state that an event of a running world is checked against.
struct Present {
  std::size_t targets = 0;          // that have been there, given up or not
  std::vector<Obstacle> obstacles;  // where they are
  std::size_t robots = 0;           // that have been there
  std::size_t places = 0;           // for robots
};
// The part of faults() that is about events and how many robots they need, for a scenario whose other
// parts are without faults. With `now` its last event is also checked against that.
[[nodiscard]] std::vector<Fault> event_faults(const Scenario& scenario, const Present* now = nullptr);

}  // namespace banyan::world
