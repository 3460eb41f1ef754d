// SPDX-License-Identifier: MIT
// What a robot with a battery remembers in addition.
#pragma once

#include <array>

#include "banyan/controller/core/neighbors.hpp"
#include "banyan/controller/power/message.hpp"

namespace banyan {

struct PowerState {
  PowerStanding said;   // what I broadcast: my part in all of it
  float level = -1.0F;  // my charge, smoothed; negative: never measured
  bool charging = false;
  bool keeps_place = false;          // I stand at a charging place and keep it in the network
  bool was_charged = false;          // at least once
  bool seeks = false;                // a spare that is to be charged
  bool ready = false;                // enough charge to join an edge
  bool travels = false;              // and on its way
  Vec2 way;                          // C, own frame: where the robot was that is to lead me to a charging place
  RobotId way_id = nobody;           // that robot, nobody: none
  std::uint8_t way_hops = no_place;  // in half hops
  std::uint16_t way_ticks = 0;       // since I chose it
  std::uint16_t stuck_ticks = 0;     // since a relief that I am part of has begun
  Vec2 unseen;  // C, own frame: a child that the robot I relieve hides from me is in this direction from it
  std::uint16_t unseen_ticks = 0;  // since I have assumed it there; 0: I hear all of its children
  std::array<PowerStanding, neighbor_capacity> standings{};  // beside the neighbour table
};

template <class Visitor, class State>
constexpr void visit_power_state(Visitor& visit, State& s, int neighbors) noexcept {
  const auto visit_standing = [&](auto& p) {
    visit(p.leaving), visit(p.in_place), visit(p.level), visit(p.place_hops), visit(p.relieves), visit(p.heir);
  };
  visit(s.level), visit(s.charging), visit(s.was_charged), visit(s.keeps_place), visit(s.seeks), visit(s.ready),
      visit(s.travels), visit(s.way), visit(s.way_id), visit(s.way_hops), visit(s.way_ticks), visit(s.stuck_ticks),
      visit(s.unseen), visit(s.unseen_ticks);
  visit_standing(s.said);
  for (int k = 0; k < neighbors; ++k) visit_standing(s.standings[static_cast<std::size_t>(k)]);
}

}  // namespace banyan
