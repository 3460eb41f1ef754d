// SPDX-License-Identifier: MIT
// All that a robot of cohesive control remembers between two steps: nearly all follows from what it hears.
#pragma once

#include "banyan/baselines/cohesion/message.hpp"
#include "banyan/baselines/common/motion.hpp"
#include "banyan/baselines/common/root.hpp"
#include "banyan/baselines/common/table.hpp"

namespace banyan::baselines::cohesion {

struct State : KnownRoot {
  RobotId id = nobody;
  OwnTarget assignment;
  float lasting_thickness = 0.0F;  // the thickness of the swarm here, over a second or so
  Tally tally;                     // never read
  Table<Message> neighbors;

  // About `entries` entries of the table are needed soon, and all the rest.
  void prefetch(std::size_t entries) const noexcept { neighbors.prefetch(entries); }
};

}  // namespace banyan::baselines::cohesion
