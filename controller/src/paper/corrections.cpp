// SPDX-License-Identifier: MIT
// What `corrected` does in place of what is printed, by the rows of docs/paper.md.
#include "banyan/controller/paper/rules.hpp"

namespace banyan::paper {
namespace {

// ---- Row 3: beyond S only the motion away from the parent is dropped ----

Vec2 row_3_directional_f(const Robot& robot, Vec2 p_parent, Vec2 u) noexcept {
  const float d = norm(p_parent);
  if (d <= robot.params.safe_range) return u;
  const Vec2 away = -p_parent / d;
  return u - away * std::max(0.0F, dot(u, away));
}

// ---- Row 4: both ends of an edge keep it below delta ----

void row_4_guard_edges(const Robot& robot, Guard& guard) noexcept {
  const float longest = robot.params.ideal_distance - robot.self.neighbors.spread();
  for_each_edge(robot, [&](int k) {
    // The way back to a robot that went out of sight leads round the obstacle, not straight to it.
    if (robot.alive(k) || robot.obstacles.empty()) guard.add(robot.position(k), longest, robot.params.guard_rate);
  });
}

// ---- Row a: idle spares stand still, since orbiting ones block lines of sight ----

Vec2 row_a_stand_still(const Robot& robot, int reference) noexcept {
  const Params& p = robot.params;
  const Vec2 to = robot.position(reference);
  // A spare next to the tree stays within reach of its edges; a crowd far from the tree stays spread out.
  const bool called = robot.caller >= 0 && robot.self.spare_state == SpareState::adjust_position;
  const bool in_tree = robot.said(reference).role != Role::spare;
  const float reach = called ? p.avoidance_range : in_tree ? 0.5F * p.recruitment_distance : p.safe_range;
  return norm(to) > reach ? unit(to) + u_avoid(robot) : u_avoid(robot);
}

// ---- Row b: needs that no spare answers spread hop by hop, and spares without an edge in sight follow ----

void row_b_call_spares(Robot& robot) noexcept {
  constexpr int unanswered_ticks = 20;
  constexpr int reach_hops = 250;
  State& self = robot.self;
  int hops = unreachable;
  for (int k = 0; k < robot.size(); ++k)
    if (robot.alive(k)) hops = std::min<int>(hops, robot.said(k).call_hops);
  // Once a call is over, the hops that robots tell each other count up, which is no gradient to follow.
  const bool live = hops < self.call_hops && hops < reach_hops && self.phase == Phase::grow_tree;
  const bool in_need = self.role != Role::spare && self.need == Need::need && self.phase == Phase::grow_tree;
  if (in_need) robot.add_elapsed(self.unserved_ticks);
  else self.unserved_ticks = 0;
  self.call_hops = static_cast<std::uint8_t>(self.unserved_ticks > unanswered_ticks ? 0
                                             : hops < reach_hops                    ? hops + 1
                                                                                    : unreachable);
  if (!live) return;
  robot.caller = robot.least(
      [&](int k) { return robot.alive(k) && robot.said(k).call_hops == hops ? robot.range(k) : not_counted; });
}

// ---- Row q: an edge of both trees exerts one force ----

int row_q_one_force(const Robot& /*robot*/, int /*k*/) noexcept { return 1; }

// ---- Row t: what ties a robot without a parent to the others, its hold ----
//
// Parents, old parents and holds obey the order of the tree and lead from each robot towards the root; both ends guard
// every such link. A robot without one stays in range of all that it hears. So the network stays in one piece.

constexpr float longest_kept = 0.95F;  // C: the next step might break a longer link

bool is_untied(const Message& m) noexcept { return m.role != Role::root && up_of(m) == nobody && m.hold == nobody; }

// A spare's hops to the tree, -1 in the tree itself; a branch that has lost its root comes last.
int hops_to_tree(const Message& m) noexcept {
  if (m.role == Role::spare) return m.tree_hops;
  return m.depth != invalid_depth ? -1 : unreachable;
}

// How bad neighbour k would be as hold: each term outweighs all that follow. The present hold is kept while it is as
// good as another. Of links that are too long the shortest is drawn in.
float cost_of_hold(const Robot& robot, int k) noexcept {
  constexpr float strained = 0.85F;  // C: beyond, the guard slows both ends down
  const auto hops = static_cast<float>(hops_to_tree(robot.said(k)));
  const float range = robot.range(k);
  const bool another = hops >= 0.0F && robot.said(k).id != robot.self.hold;
  if (range > longest_kept) return 8192.0F + 1024.0F * range + (another ? 10.0F : 0.0F) + hops / unreachable;
  return (hops == unreachable ? 4096.0F : 0.0F) + (range > strained ? 2048.0F : 0.0F) + 4.0F * hops +
         (another ? 2.0F : 0.0F) + range;
}

// In place of keep_up_with_tree(): a spare keeps up with the hold that it would like best, which is ahead of it then.
void row_t_find_hold(Robot& robot) noexcept {
  State& self = robot.self;
  const auto best = [&](auto may) {
    return robot.least([&](int k) {
      const bool tied = robot.alive(k) && robot.said(k).epoch == self.epoch && !is_untied(robot.said(k));
      return tied && may(k) ? cost_of_hold(robot, k) : not_counted;
    });
  };
  if (!robot.is_root() && robot.up() < 0) {
    // A robot farther from the tree than I am may depend on me: it would never get ahead.
    const auto gets_ahead = [&](int k) { return is_ahead(robot, k) || hops_to_tree(robot.said(k)) < self.tree_hops; };
    robot.hold = best([&](int k) { return is_ahead(robot, k); });
    const int wish = best(gets_ahead);
    // Until the flood of a new epoch has arrived, the last epoch's hold will do. A robot with children keeps it until
    // that epoch's tree is dropped: by the new labels a robot that depends on me through them may be ahead.
    const int last = robot.find(self.hold);
    const bool relied_on = self.phase < Phase::grow_tree && robot.any([&](int k) { return robot.is_below(k); });
    if ((self.label == unknown_label || relied_on) && robot.alive(last)) robot.hold = last;
    else if (self.label == unknown_label) robot.hold = -1;
    if (wish >= 0 && self.role == Role::spare && self.phase >= Phase::grow_tree && self.request == nobody)
      keep_up(robot, wish);
  }
  self.hold = robot.id(robot.hold);
}

void row_t_guard_links(const Robot& robot, Guard& guard) noexcept {
  const float rate = robot.params.guard_rate;
  const float limited = longest_kept - 2.0F * robot.params.speed_gain / rate;  // below it full speed is allowed
  const bool untied = robot.hold < 0 && robot.up() < 0 && !robot.is_root();
  for (int k = 0; k < robot.size(); ++k) {
    const Message& m = robot.said(k);
    if (!robot.alive(k) || robot.is_tree_neighbor(k) || robot.range(k) <= limited) continue;
    // In a grown tree only robots of its epoch wait for a hold, and those that have not heard of any.
    const bool may_wait = m.epoch == robot.self.epoch || m.phase == Phase::init || robot.self.phase < Phase::grow_tree;
    if (k == robot.hold || m.hold == robot.self.id || untied || (may_wait && is_untied(m)))
      guard.add(robot.position(k), longest_kept - robot.self.neighbors.spread(), rate);
  }
}

// ---- Row 13: no robot pushes against an obstacle, since odometry is wrong when wheels slip ----

void row_13_keep_off(const Robot& robot, Guard& guard) noexcept {
  constexpr float kept = 0.01F;  // C, between body and obstacle
  for (const Vec2 point : robot.obstacles) {
    const float d = norm(point);
    if (d > 0.0F) guard.add_limit(point / d, (d - robot.params.body_radius - kept) * robot.params.guard_rate);
  }
}

}  // namespace

constexpr Reading literal{};
constexpr Reading corrected{
    .asks_while_wanted = true,
    .f = row_3_directional_f,
    .keeps_margin = true,
    .guard_edges = row_4_guard_edges,
    .adjust_position = row_a_stand_still,
    .call_spares = row_b_call_spares,
    .prefers_safe_parent = true,
    .edges_to = row_q_one_force,
    .find_hold = row_t_find_hold,
    .guard_links = row_t_guard_links,
    .keeps_links = true,
    .renews_labels = true,
    .avoids_obstacles = true,
    .guard_obstacles = row_13_keep_off,
    .filters_positions = true,
};

}  // namespace banyan::paper
