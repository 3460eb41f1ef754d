// SPDX-License-Identifier: MIT
// A second path (docs/lasting.md): beside each robot that the tree depends on stands a spare, its companion, which
// hears the same tree neighbours. If either dies, what was below it is still joined to what was above, by physical
// links that are there already; the tree takes the companion as the new parent within two ticks (link repair,
// docs/convoy.md). A companion stays a spare: it answers edges in need as others do. With
// mission.link_redundancy = k each such robot has k - 1 companions, so any k - 1 robots may die at once. Messages do
// not grow: a spare says beside whom it stands in the field `below`, which means nothing of spares otherwise, calls for
// companions share `call_hops`, and a robot of the tree that lacks a companion says its own id in `request`, which
// means nothing of such robots otherwise.
#pragma once

#include "convoy/robot.hpp"

namespace banyan {

// Otherwise, with k = 1 or companion_distance 0, none of these rules does anything.
[[nodiscard]] inline bool has_companions(const ConvoyParams& params) noexcept {
  return params.link_redundancy > 1 && params.companion_distance > 0.0F;
}

// Workers drive a little slower than they could, so that companions keep up with the chains.
[[nodiscard]] inline float worker_pace(const ConvoyParams& params) noexcept {
  constexpr float with_companions = 0.85F;  // of its speed
  return has_companions(params) ? with_companions : 1.0F;
}

// Neighbour k is a robot of the tree whose death would cut some of its tree neighbours off from others.
[[nodiscard]] bool needs_companion(const ConvoyRobot& robot, int k) noexcept;
// The robot that neighbour j, a spare, stands beside; nobody: none, or it is no spare.
[[nodiscard]] inline RobotId companion_of(const ConvoyRobot& robot, int j) noexcept {
  const TreeStanding& m = robot.table().message(j);
  return m.role == Role::spare && m.parent == nobody ? robot.convoy_of(j).below : nobody;
}
// Spares that I hear which say that they stand beside that robot.
[[nodiscard]] int count_companions(const ConvoyRobot& robot, RobotId of) noexcept;

// Once a tick, before the spares. With line of sight only calls heard in this tick or the last count. Robots that are
// hidden now and then would keep one that is over alive for half a minute, in which no call for a companion is heard.
void heed_live_calls(ConvoyRobot& robot) noexcept;

// Once a tick, after the spares: a spare decides beside whom it stands; a robot of the tree that has stood alone for
// long calls.
void keep_company(ConvoyRobot& robot) noexcept;

// Without line of sight: neighbour k is the robot that I accompany, and has not been silent for much longer than makes
// it count as dead. I stay, since others are about to take me as their parent.
[[nodiscard]] bool stands_in_for(const ConvoyRobot& robot, int k) noexcept;

// My only child could do without me, but I stand in its line of sight to my parent: which way I step aside. With a
// second path the child then needs no companion, with thrift it releases me.
[[nodiscard]] bool steps_aside(const ConvoyRobot& robot, Vec2& way) noexcept;

// How near a companion comes to the edges of others, C.
[[nodiscard]] float companion_width(const ConvoyRobot& robot, int of) noexcept;

// How a companion moves, in units of speed_gain: to the place beside its robot from which it hears that robot's tree
// neighbours best and is in nobody's line of sight. The robot must be in the table.
[[nodiscard]] Vec2 companion_motion(const ConvoyRobot& robot, int of) noexcept;

}  // namespace banyan
