// SPDX-License-Identifier: MIT
// The rooms of a step of caravan, in its order. Begin with step.cpp.
#pragma once

#include "banyan/controller/caravan/caravan.hpp"
#include "banyan/controller/core/guard.hpp"
#include "caravan/robot.hpp"
#include "obstacles/way_round.hpp"

namespace banyan::caravan {

// ---- links.cpp: principle 1 ----

void measure_silence(Robot& robot) noexcept;
// How far neighbour k may have driven since it was heard, C; 0 where silence is no loss.
[[nodiscard]] float strayed(const Robot& robot, int k) noexcept;
// The link to it is to hold: I obey its half-plane, and remember it however silent it is.
[[nodiscard]] bool is_promised(const Robot& robot, int k) noexcept;

// ---- order.cpp: foundation 1 ----

// Neighbour k is ahead of me: (root, beat) is newer. No robot takes a parent that is not ahead of it, and no pair ever
// falls back; so no chain of parents can close (RFC 8966, 2.4).
[[nodiscard]] bool is_ahead(const State& self, const Statement& m) noexcept;
void keep_up(Robot& robot) noexcept;

// ---- sight.cpp: what hides an edge ----

void remember_corners(Robot& robot) noexcept;
void tell_corner(Robot& robot) noexcept;  // the nearest to the edge to my parent
// What the line to neighbour k may cost soon, C: robots and corners near it.
[[nodiscard]] float hazard(const Robot& robot, int k) noexcept;
// Keeps corners out of the lines along my edges.
void keep_sight(const Robot& robot, Guard& guard) noexcept;

// ---- parent.cpp: principle 2 ----

void choose_parent(Robot& robot) noexcept;
void take_parent(Robot& robot, int k) noexcept;  // the one function that changes a parent

// ---- power.cpp: batteries ----

void watch_charge(Robot& robot, const Inputs<Heard>& inputs) noexcept;
// The place where I am to be charged; null: not now, or none is known.
[[nodiscard]] const Token* charging_place(const Robot& robot) noexcept;
// A robot that may take over what I hold: at my target, or beside me as root; -1: none.
[[nodiscard]] int heir(const Robot& robot) noexcept;

// ---- posts.cpp: principle 3 ----

void call_spares(Robot& robot) noexcept;

// ---- tokens.cpp: principle 5 ----

void follow_orders(Robot& robot, const Orders& orders) noexcept;
void keep_tokens(Robot& robot, const Orders& orders) noexcept;
// A worker that comes no nearer, with the velocity v that is left to it, lets another one try, or none.
void watch_progress(Robot& robot, Vec2 v) noexcept;
[[nodiscard]] TokenNews told_in_turn(Robot& robot) noexcept;
// No root has been heard of for long.
[[nodiscard]] bool is_cut_off(const Robot& robot) noexcept;

// ---- motion.cpp: principle 4 ----

[[nodiscard]] Vec2 goal(Robot& robot) noexcept;
void limit_motion(const Robot& robot, Guard& guard) noexcept;

}  // namespace banyan::caravan
