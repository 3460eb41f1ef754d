// SPDX-License-Identifier: MIT
// What a robot of convoy remembers in addition.
#pragma once

#include <array>
#include <cstdint>

#include "banyan/controller/convoy/message.hpp"
#include "banyan/controller/healing/state.hpp"
#include "banyan/controller/power/state.hpp"

namespace banyan {

// Stands before the others' part, as HealingMemory does.
struct ConvoyMemory {
  std::uint16_t pending_ticks = 0;  // how long I have been waiting for pending_parent to get ahead of me
  RobotId warned = nobody;          // the child that I am about to lose sight of

  // Chains from target to target (plan.cpp)
  RobotId above = nobody;             // the next worker above me in the tree, by its target
  RobotId below = nobody;             // the only worker below me, by its target
  RobotId lead_to = nobody;           // I lead my branch to that target
  RobotId led_from = nobody;          // the parent it had then
  std::uint16_t lead_ticks = 0;       // since its parent changed
  std::uint16_t settled_ticks = 0;    // the root: since all workers arrived
  std::uint16_t unsettled_ticks = 0;  // or since one no longer has
  std::uint16_t plan_ticks = 0;       // of the plan that is being carried out
  std::uint8_t plan_targets = 0;      // thrift, the root: for so many targets it has planned
  std::uint8_t plan_levels = 0;       // of its plan; 0: there is none
  std::uint8_t plan_steps = 0;        // begun so far
  std::array<std::uint8_t, task_capacity> plan_level{};
  std::array<RobotId, task_capacity> planned = none();  // hosts of all levels
  RobotId shed = nobody;           // the root: the target that it is giving up, since robots are too few
  std::uint16_t short_ticks = 0;   // spares have been missed for so long without progress:
  std::uint16_t short_want = 0;    // the least distance that was left since
  std::uint8_t short_reached = 0;  // so many targets were reached
  RobotCount tried_with = 0;       // the most spares with which a target was tried again
  std::array<RobotId, task_capacity> hosts = none();  // the plan: at which target the branch of tasks[k] is to begin

  // A second path (convoy/companions.hpp)
  RobotId accompanies = nobody;   // a spare: the robot of the tree that it stands beside
  std::uint16_t alone_ticks = 0;  // for so long a companion has been missed here, or more urgently elsewhere

  bool too_few_to_fold = false;  // with so few robots no branch folds (plan.cpp)

  Corners corners;                                                   // obstacles: lines of sight past them
  std::array<ConvoyStanding, neighbor_capacity> convoy_standings{};  // beside the neighbour table

 private:
  static constexpr std::array<RobotId, task_capacity> none() noexcept {
    std::array<RobotId, task_capacity> hosts{};
    hosts.fill(nobody);
    return hosts;
  }
};

struct ConvoyState : ConvoyMemory, HealingState {
  void prefetch(std::size_t entries) const noexcept {
    HealingState::prefetch(entries = std::min<std::size_t>(entries, neighbor_capacity));
    prefetch_lines(&pending_ticks,
                   static_cast<std::size_t>(reinterpret_cast<const char*>(corners.standings.data() + entries) -
                                            reinterpret_cast<const char*>(&pending_ticks)));
    prefetch_lines(convoy_standings.data(), entries * sizeof(ConvoyStanding));
  }
};

// Of robots with batteries.
struct PoweredConvoyState : ConvoyState {
  PowerState power;
};

template <class Visitor, class State> constexpr void visit_convoy_state(Visitor& visit, State& s) noexcept {
  visit(s.pending_ticks), visit(s.warned), visit(s.above), visit(s.below), visit(s.lead_to), visit(s.led_from),
      visit(s.lead_ticks);
  visit(s.settled_ticks), visit(s.unsettled_ticks), visit(s.plan_ticks);
  for (int k = 0; k < s.task_count; ++k) {
    const auto n = static_cast<std::size_t>(k);
    visit(s.hosts[n]), visit(s.planned[n]), visit(s.plan_level[n]);
  }
  visit(s.plan_targets), visit(s.plan_levels), visit(s.plan_steps);
  visit(s.shed), visit(s.short_ticks), visit(s.short_want), visit(s.short_reached), visit(s.tried_with);
  visit(s.accompanies), visit(s.alone_ticks), visit(s.too_few_to_fold);
  visit(s.corners.pinned), visit(s.corners.seen_from), visit(s.corners.landmarks.size);
  for (int k = 0; k < s.corners.landmarks.size; ++k) visit(s.corners.landmarks.points[static_cast<std::size_t>(k)]);
  for (std::size_t k = 0; k < s.corners.bodies.size; ++k)
    visit(s.corners.bodies.centers[k]), visit(s.corners.bodies.ids[k]);
  for (int k = 0; k < s.neighbors.size(); ++k) {
    const auto n = static_cast<std::size_t>(k);
    visit(s.corners.standings[n].hinge_x.bits), visit(s.corners.standings[n].hinge_y.bits),
        visit(s.corners.standings[n].pinned);
    visit(s.convoy_standings[n].child_count), visit(s.convoy_standings[n].below);
  }
}

}  // namespace banyan
