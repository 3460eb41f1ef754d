// SPDX-License-Identifier: MIT
// The paper's two algorithms, each as printed and as corrected. Begin with step.cpp. The rooms of a step stand here in
// the order of the paper; each source begins with the sentence that it implements. A rule of one's own over the paper's
// tree is another Growth, another Reading, or a step of its own made of these functions.
#pragma once

#include "banyan/controller/core/guard.hpp"
#include "banyan/controller/paper/paper.hpp"
#include "banyan/controller/paper/robot.hpp"

namespace banyan::paper {

// ---- step.cpp ----

void begin_tick(Robot& robot, const Inputs<Heard>& inputs) noexcept;
void update_role(Robot& robot) noexcept;  // Sec. III-A
void leave_tree(Robot& robot) noexcept;
[[nodiscard]] Message written(const Robot& robot) noexcept;

// ---- epoch.cpp: Sec. III-B, Fig. 1 ----

void listen(Robot& robot) noexcept;
void advance(Robot& robot) noexcept;
void enter(Robot& robot, Serial epoch, Phase phase) noexcept;

// ---- start_tree.cpp: START TREE ----

void start_tree(Robot& robot) noexcept;
// label + length of the edge, at least 1, so that labels grow along every edge; at most largest_label.
[[nodiscard]] std::uint16_t label_below(std::uint16_t label, float range) noexcept;

// ---- select_parent.cpp: SELECT PARENT, Sec. III-D and III-E ----

struct Growth {
  bool (*may_join)(const Robot&) noexcept;      // now, if it has no parent
  float (*cost)(const Robot&, int k) noexcept;  // of neighbour k as parent; not_counted: it is no candidate
  bool (*is_complete)(const Robot&) noexcept;   // the root: "once every robot has selected a new parent"
};

void select_parent(Robot& robot) noexcept;
void take_parent(Robot& robot, int k) noexcept;
// Neighbour k's (seqno, label) is ahead of mine: no robot takes a parent that is not, and none falls back behind a pair
// that it has sent. So no chain of parents can close (the feasibility condition of EIGRP and Babel, RFC 8966 sec. 2.4).
[[nodiscard]] bool is_ahead(const Robot& robot, int k) noexcept;
void keep_up(Robot& robot, int k) noexcept;  // the pair flows down the tree
void keep_up_with_tree(Robot& robot) noexcept;
[[nodiscard]] bool is_orphan(const Robot& robot) noexcept;

// ---- census.cpp: u_target, Alg. 1, Alg. 2 ----

void take_census(Robot& robot) noexcept;
void algorithm_1(Robot& robot) noexcept;
void algorithm_2(Robot& robot) noexcept;

// ---- select_root.cpp: SELECT ROOT, Sec. III-C ----

void accept_offer(Robot& robot) noexcept;
void select_root(Robot& robot) noexcept;
void end_offer(Robot& robot, Serial held) noexcept;  // of a former root, whose token had that number

// ---- spares.cpp: GROW TREE, Sec. III-F, Fig. 5 ----

void manage_spares(Robot& robot) noexcept;
// Where a spare in EXTEND EDGE is heading, own frame. False if it does not hear both ends.
[[nodiscard]] bool edge_midpoint(const Robot& robot, int owner, Vec2& midpoint) noexcept;

// ---- motion.cpp: Sec. III-G ----

[[nodiscard]] Vec2 u(const Robot& robot) noexcept;
[[nodiscard]] Vec2 u_spare(const Robot& robot) noexcept;
[[nodiscard]] Vec2 u_avoid(const Robot& robot) noexcept;
[[nodiscard]] float interaction(float d, const Params& params) noexcept;  // u_tree: positive towards the other robot
[[nodiscard]] Vec2 f(const Robot& robot, Vec2 p_parent, Vec2 u) noexcept;
[[nodiscard]] int edges_to(const Robot& robot, int k) noexcept;  // in both trees
[[nodiscard]] Vec2 orbit(const Robot& robot, int reference) noexcept;
// Calls visit(k) for every neighbour at the other end of an edge of mine, in either tree, once.
template <class Visit> void for_each_edge(const Robot& robot, Visit visit) noexcept {
  if (robot.parent >= 0) visit(robot.parent);
  if (robot.old_parent >= 0 && robot.old_parent != robot.parent) visit(robot.old_parent);
  robot.for_each_below([&](int k, bool /*old*/) {
    if (k != robot.parent && k != robot.old_parent) visit(k);
  });
}

// ---- corrections.cpp: the two readings ----
//
// literal: the paper as printed, with what it leaves open filled in. corrected: literal with other functions in place
// of those here. Letters and numbers are rows of docs/paper.md.

struct Reading {
  using Limit = void (*)(const Robot&, Guard&) noexcept;
  static void none(const Robot& /*robot*/, Guard& /*guard*/) noexcept {}
  static void nothing(Robot& /*robot*/) noexcept {}

  bool asks_while_wanted = false;                                         // row 2
  Vec2 (*f)(const Robot&, Vec2 p_parent, Vec2 u) noexcept = paper::f;     // row 3
  bool keeps_margin = false;                                              // row 4: of a parent to the ideal distance
  Limit guard_edges = none;                                               // row 4
  Vec2 (*adjust_position)(const Robot&, int reference) noexcept = orbit;  // row a
  void (*call_spares)(Robot&) noexcept = nothing;                         // row b
  bool prefers_safe_parent = false;                                       // row k
  int (*edges_to)(const Robot&, int k) noexcept = paper::edges_to;        // row q
  void (*find_hold)(Robot&) noexcept = keep_up_with_tree;                 // row t
  Limit guard_links = none;                                               // row t
  bool keeps_links = false;                                               // row t
  bool renews_labels = false;                                             // row u
  bool avoids_obstacles = false;                                          // row 13
  Limit guard_obstacles = none;                                           // row 13
  bool filters_positions = false;                                         // row 14
};

}  // namespace banyan::paper
