// SPDX-License-Identifier: MIT
// Batteries (docs/lasting.md): a robot of the tree that runs low is relieved before it leaves, and spares take turns at
// the charging places. Nothing is planned and nobody is in charge: a robot knows its own charge and what its neighbours
// say.
#pragma once

#include "banyan/controller/core/function_ref.hpp"
#include "banyan/controller/core/guard.hpp"
#include "banyan/controller/power/params.hpp"
#include "banyan/controller/power/state.hpp"
#include "healing/robot.hpp"

namespace banyan {

// A robot, what it remembers of batteries, and what it may set of them.
struct PowerRobot {
  HealingRobot& robot;
  PowerState& power;
  const PowerParams& params;
  FunctionRef<int(int k)> child_count;  // that neighbour k has, as it says

  [[nodiscard]] const PowerStanding& standing(int k) const noexcept {
    return power.standings[static_cast<std::size_t>(k)];
  }
  [[nodiscard]] bool is_spare(int k) const noexcept { return robot.table().message(k).role == Role::spare; }
};

// Before the targets are looked after: a worker hands its target over to the robot beside it, which takes it.
void hand_over_target(PowerRobot& me) noexcept;

// Once parent and children are known: my charge, the way to a charging place, whether I have to leave;
void watch_charge(PowerRobot& me, const std::optional<Charge>& charge, const Orders& orders) noexcept;

// then whom I relieve, and who is to serve my target.
void watch_relief(PowerRobot& me) noexcept;

// My parent takes my place, and I hear it.
[[nodiscard]] bool is_relieved(const PowerRobot& me) noexcept;

// The robot above neighbour k takes its place.
[[nodiscard]] bool has_reliever(const PowerRobot& me, int k) noexcept;

// The edge to my parent wants a spare that takes my place.
[[nodiscard]] bool wants_relief(const PowerRobot& me) noexcept;

// A spare beside a robot that leaves may take its place above it, from where it is: it reaches the parent and all
// children.
[[nodiscard]] bool may_relieve(const PowerRobot& me, int leaver, int parent,
                               FunctionRef<bool(int k)> in_sight) noexcept;

// My parent leaves: the robot that takes its place, once that stands beside it and `may_be_parent`; -1: not yet.
[[nodiscard]] int successor_of_parent(const PowerRobot& me, FunctionRef<bool(int k)> may_be_parent) noexcept;

// A relief that I am part of does not come to an end: my edge is too long, and a robot in it would give it slack.
[[nodiscard]] bool is_stuck(const PowerRobot& me) noexcept;

// I take part in a relief, and move for it: where to, own frame, C.
[[nodiscard]] bool find_relief_spot(const PowerRobot& me, Vec2& spot) noexcept;

// Calls for reliefs are farther off than those of edges that hold workers back, by so many hops and more: the less
// charge is left, the nearer they seem.
inline constexpr int relief_call = 16;
void call_for_relief(PowerRobot& me) noexcept;

// After spares have looked for edges: one with too little charge joins none, one that nobody needs goes to be charged.
void tend_battery(PowerRobot& me) noexcept;

// It is charged, and too near to a charging place: which way it goes.
[[nodiscard]] bool leaves_place(const PowerRobot& me, Vec2& away) noexcept;

// Neighbour k has said that it has charge enough to join the tree.
[[nodiscard]] bool is_charged(const PowerRobot& me, int k) noexcept;

// Neighbour k may become root. If I am root and have to leave, and little charge is left, whoever has more will do: as
// a connector I can be relieved, a root calls nobody.
[[nodiscard]] bool may_inherit_root(const PowerRobot& me, int k) noexcept;

// While robots change places, spares do not drive into their lines of sight, nor does the robot that takes the place;
// and it does not go where the one that leaves would hide its tree neighbours from it. Returns how fast a spare moves
// that nobody waits for, as a share of its speed: it only makes room for others.
[[nodiscard]] float give_way(const PowerRobot& me, float clearance, Guard& guard) noexcept;

// Near enough to a charging place: it stays there.
[[nodiscard]] bool is_at_place(const PowerRobot& me) noexcept;

}  // namespace banyan
