// SPDX-License-Identifier: MIT
// The two readings of the paper. `literal` is the paper as printed, with what it leaves open filled in. `corrected` is
// literal with the corrections listed in corrections.cpp. The members with a default are the rules as printed; letters
// and numbers are rows of docs/paper.md.
#pragma once

#include "banyan/controller/paper/rooms.hpp"

namespace banyan::paper {

// The rules as printed, where they are corrected.
[[nodiscard]] bool is_stretched(const Robot& robot) noexcept;            // spares.cpp
[[nodiscard]] Vec2 orbit(const Robot& robot) noexcept;                   // motion.cpp
[[nodiscard]] Vec2 f(const Robot& robot, Vec2 u, Vec2 parent) noexcept;  // motion.cpp
[[nodiscard]] int edges_to(const Robot& robot, int k) noexcept;          // motion.cpp
[[nodiscard]] float parent_range(const Params& params) noexcept;         // select_parent.cpp
[[nodiscard]] float no_handicap(const Robot& robot, int k) noexcept;     // select_parent.cpp
void keep_up_with_tree(Robot& robot) noexcept;                           // select_parent.cpp
inline void nothing(Robot& /*robot*/) noexcept {}
inline void no_limit(const Robot& /*robot*/, Guard& /*guard*/) noexcept {}
inline Vec2 no_obstacles(const Robot& /*robot*/, Vec2 u) noexcept { return u; }

struct Reading {
  bool (*is_stretched)(const Robot&) noexcept = paper::is_stretched;    // row 2
  Vec2 (*f)(const Robot&, Vec2 u, Vec2 parent) noexcept = paper::f;     // row 3
  float (*parent_range)(const Params&) noexcept = paper::parent_range;  // row 4
  void (*guard_edges)(const Robot&, Guard&) noexcept = no_limit;        // row 4
  int (*barrier_patience)(Robot&) noexcept = paper::barrier_patience;   // row 7
  Vec2 (*adjust_position)(const Robot&) noexcept = orbit;               // row a
  void (*call_spares)(Robot&) noexcept = nothing;                       // row b
  float (*handicap)(const Robot&, int k) noexcept = no_handicap;        // row k
  int (*edges_to)(const Robot&, int k) noexcept = paper::edges_to;      // row q
  void (*keep_up)(Robot&) noexcept = keep_up_with_tree;                 // row t
  void (*guard_links)(const Robot&, Guard&) noexcept = no_limit;        // row t
  bool keeps_links = false;                                             // row t
  bool renews_labels = false;                                           // row u
  Vec2 (*u_obstacles)(const Robot&, Vec2 u) noexcept = no_obstacles;    // row v
  void (*guard_obstacles)(const Robot&, Guard&) noexcept = no_limit;    // row v
  bool filters_positions = false;                                       // row w
};
inline constexpr Reading literal{};
extern const Reading corrected;

}  // namespace banyan::paper
