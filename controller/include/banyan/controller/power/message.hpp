// SPDX-License-Identifier: MIT
// What robots with batteries broadcast in addition (docs/lasting.md). Robots without have no such block.
#pragma once

#include <cstdint>

#include "banyan/controller/core/inputs.hpp"

namespace banyan {

inline constexpr std::uint8_t no_place = 0xFF;

struct PowerStanding {
  bool leaving = false;                // I have to be relieved
  bool in_place = false;               // I stand where I can take the place of the robot that I relieve
  std::uint8_t level = 0xFF;           // my charge, 254 is full; 255: not known
  std::uint8_t place_hops = no_place;  // to a robot that stands at a charging place, 0: I do
  RobotId relieves = nobody;           // the child whose place in the tree I take
  RobotId heir = nobody;               // the robot that is to serve my target from now on

  friend bool operator==(const PowerStanding&, const PowerStanding&) = default;
};

template <class Visitor, class M> constexpr void visit_power_block(Visitor& visit, M& m) noexcept {
  visit.flag("leaving", "1: has to be relieved", m.leaving);
  visit.flag("in_place", "1: stands beside the child that it relieves", m.in_place);
  visit.known("level", "charge, 254 is full, -1: not known", m.level);
  visit.known("place_hops", "hops to a robot at a charging place, 0: is there, -1: no way known", m.place_hops);
  visit.robot("relieves", "the child whose place in the tree the sender takes, -1: none", m.relieves);
  visit.robot("heir", "the robot that is to serve the sender's target from now on, -1: none", m.heir);
}

}  // namespace banyan
