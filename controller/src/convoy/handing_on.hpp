// SPDX-License-Identifier: MIT
// Rule 16 (docs/convoy.md): in a large swarm the spares are minutes away from an edge that calls them, but the chain
// below a junction has slack. The junction is handed on: its parent comes up beside it and takes over one of its
// branches, so that it can follow the other. A small swarm has its spares at hand and goes without this rule, unless it
// has so many targets that its branches use them up, or has started as a line, ring or cross and its spares are spread
// along it.
#pragma once

#include "convoy/robot.hpp"

namespace banyan {

// As far as I have heard what the root has counted.
[[nodiscard]] inline bool is_counted_large(const ConvoyRobot& robot) noexcept {
  constexpr std::uint16_t large_swarm = 450;  // robots
  return robot.self.root_size > large_swarm;
}

// It has counted fewer, but there are more targets than a robot remembers: the tree is large for its swarm.
[[nodiscard]] bool has_many_targets(const ConvoyRobot& robot) noexcept;

// Either of the two, or my start was thin. The root itself stays with the spares.
[[nodiscard]] bool has_far_spares(const ConvoyRobot& robot) noexcept;

// An edge above child k calls in vain, and k cannot follow it: it is a junction, or a worker with a branch of its own.
[[nodiscard]] bool is_held_by_branches(const ConvoyRobot& robot, int k) noexcept;
// Where I come up beside it: towards the branch that I am to take over, own frame, C.
[[nodiscard]] Vec2 place_beside(const ConvoyRobot& robot, int k) noexcept;

// My parent is such a junction: its own parent, which has come up, becomes mine, unless an edge of mine calls and goes
// farther than the others; then these make room. True if it did.
[[nodiscard]] bool leave_junction(ConvoyRobot& robot) noexcept;

}  // namespace banyan
