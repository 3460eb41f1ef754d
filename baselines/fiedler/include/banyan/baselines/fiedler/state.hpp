// SPDX-License-Identifier: MIT
// All that a robot of Fiedler control remembers between two steps.
#pragma once

#include <cstdint>

#include "banyan/baselines/common/motion.hpp"
#include "banyan/baselines/common/root.hpp"
#include "banyan/baselines/common/table.hpp"
#include "banyan/baselines/fiedler/message.hpp"

namespace banyan::baselines::fiedler {

struct State : KnownRoot {
  RobotId id = nobody;
  OwnTarget assignment;

  std::uint16_t ticks = 0;  // since the start, up to 65535

  // What spreads over the network (flood.cpp)
  std::uint8_t links = 0;
  std::uint16_t largest_degree = 0;
  std::uint8_t degree_age = 0;

  // The estimate (estimate.cpp)
  float component = 0.0F;
  Average mean;
  Average square;
  Average product;
  float lambda = 0.0F;
  std::uint32_t draws = 0;  // numbers drawn so far to begin anew with

  Tally tally;  // never read
  Table<Message> neighbors;

  // About `entries` entries of the table are needed soon, and all the rest.
  void prefetch(std::size_t entries) const noexcept { neighbors.prefetch(entries); }
};

}  // namespace banyan::baselines::fiedler
