// SPDX-License-Identifier: MIT
// The rooms of a step, in the order in which the paper describes them. Each source begins with the sentence of the
// paper that it implements. A rule of one's own over the paper's tree is another Growth, another Reading, or a step of
// its own made of these functions.
#pragma once

#include "banyan/controller/core/guard.hpp"
#include "banyan/controller/paper/robot.hpp"

namespace banyan::paper {

// ---- step.cpp ----

void begin_tick(Robot& robot, const Inputs<Heard>& inputs) noexcept;
void index_neighbors(Robot& robot) noexcept;  // parent and children
void update_role(Robot& robot) noexcept;      // Sec. III-A
void leave_tree(Robot& robot) noexcept;
[[nodiscard]] Message written(const Robot& robot) noexcept;

// ---- epoch.cpp: Fig. 1 ----

void listen(Robot& robot) noexcept;
void advance(Robot& robot) noexcept;
void enter(Robot& robot, Serial epoch, Phase phase) noexcept;
[[nodiscard]] int barrier_patience(Robot& robot) noexcept;

// ---- start_tree.cpp: START TREE ----

void estimate_distance_to_root(Robot& robot) noexcept;
void echo(Robot& robot) noexcept;
// label + length of the edge, at least 1, so that labels grow along every edge; at most largest_label.
[[nodiscard]] std::uint16_t label_below(std::uint16_t label, float range) noexcept;

// ---- select_parent.cpp: SELECT PARENT ----

// From which end the tree grows: Sec. III-D, III-E.
struct Growth {
  bool (*may_join)(const Robot&) noexcept;          // now, if it has no parent
  float (*cost)(const Robot&, int k) noexcept;      // of neighbour k as parent; not_counted: it is no candidate
  bool (*is_complete)(const Robot& root) noexcept;  // "once every robot has selected a new parent"
};
extern const Growth outwards;
extern const Growth inwards;

void select_parent(Robot& robot) noexcept;
void take_parent(Robot& robot, int k) noexcept;
// Neighbour k's (seqno, label) is ahead of mine: no robot takes a parent that is not, and none falls back behind a pair
// that it has sent. So no chain of parents can close (the feasibility condition of EIGRP and Babel, RFC 8966 sec. 2.4).
[[nodiscard]] bool is_ahead(const Robot& robot, int k) noexcept;
void keep_up(Robot& robot, int k) noexcept;  // the pair flows down the tree
[[nodiscard]] bool is_orphan(const Robot& robot) noexcept;
[[nodiscard]] int nearest_to_tree(const Robot& robot) noexcept;

// ---- census.cpp: Alg. 1, Alg. 2, u_target ----

void algorithm_1(Robot& robot) noexcept;
void algorithm_2(Robot& robot) noexcept;
void count_subtree(Robot& robot) noexcept;
void pass_on_targets(Robot& robot) noexcept;

// ---- select_root.cpp: SELECT ROOT, Sec. III-C ----

void accept_offer(Robot& robot) noexcept;
void select_root(Robot& robot) noexcept;
void end_offer(Robot& robot, Serial held) noexcept;  // of a root that had a token with that number and is none now

// ---- spares.cpp: Sec. III-F, Fig. 5 ----

void manage_spares(Robot& robot) noexcept;
// Where a spare in EXTEND EDGE is heading, own frame. False if it does not hear both ends.
[[nodiscard]] bool edge_midpoint(const Robot& robot, RobotId owner, Vec2& midpoint) noexcept;

// ---- motion.cpp: Sec. III-G ----

// A robot nearer than this is where I am: it has no direction, and powers of 1 / d would overflow.
inline constexpr float same_spot = 1e-6F;

[[nodiscard]] Vec2 u(const Robot& robot) noexcept;
[[nodiscard]] Vec2 u_spare(const Robot& robot) noexcept;
[[nodiscard]] Vec2 u_avoid(const Robot& robot) noexcept;
[[nodiscard]] Vec2 repulsion(const Params& params, float d, Vec2 from) noexcept;
[[nodiscard]] int reference_of(const Robot& robot) noexcept;              // of a spare
[[nodiscard]] float interaction(float d, const Params& params) noexcept;  // u_tree: positive towards the other robot
template <class Visit> void for_each_edge(const Robot& robot, Visit visit) noexcept {  // of both trees, once
  if (robot.parent >= 0) visit(robot.parent);
  if (robot.old_parent >= 0 && robot.old_parent != robot.parent) visit(robot.old_parent);
  for (const Indices* below : {&robot.children, &robot.old_children})
    for (const int k : *below)
      if (k != robot.parent && k != robot.old_parent) visit(k);
}

}  // namespace banyan::paper
