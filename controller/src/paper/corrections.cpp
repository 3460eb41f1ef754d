// SPDX-License-Identifier: MIT
// What `corrected` does in place of what is printed, row by row of docs/paper.md.
#include "banyan/controller/paper/corrections.hpp"
#include "banyan/controller/core/search.hpp"

namespace banyan::paper {
namespace {

// ---- Row 2: an edge asks for a spare only while a worker below still has to travel ----

bool row_2_stretched_and_wanted(const Robot& robot) noexcept {
  return paper::is_stretched(robot) && robot.self.way_left > 0.0F;
}

// ---- Row 3: beyond S only the motion away from the parent is dropped ----

Vec2 row_3_directional_f(const Robot& robot, Vec2 u, Vec2 parent) noexcept {
  const float d = norm(parent);
  if (d <= robot.params.safe_range) return u;
  const Vec2 away = -parent / d;
  return u - away * std::max(0.0F, dot(u, away));
}

// ---- Row 4: edges are chosen below delta, and both ends keep them below ----

float row_4_parent_range(const Params& params) noexcept { return params.ideal_distance - params.parent_margin; }

void row_4_guard_edges(const Robot& robot, Guard& guard) noexcept {
  const float longest = robot.params.ideal_distance - robot.table().spread();
  for_each_edge(robot, [&](int k) {
    // The way back to a robot that went out of sight leads round the obstacle, not straight to it.
    if (robot.alive(k) || robot.obstacles.empty()) guard.add(robot.position(k), longest, robot.params.guard_rate);
  });
}

// ---- Row 7: the root waits while the flood still finds robots, and for the choice of parents at least as long ----

int row_7_barrier_patience(Robot& robot) noexcept {
  State& self = robot.self;
  const int least = paper::barrier_patience(robot);
  if (self.phase == Phase::select_parent) return std::max<int>(least, self.flood_ticks);
  if (self.phase != Phase::start_tree) return least;
  if (self.phase_ticks <= robot.elapsed_ticks) self.flood_counted = 0;
  if (self.flood_robots > self.flood_counted) {
    self.flood_counted = self.flood_robots;
    self.flood_ticks = self.phase_ticks;
  }
  return self.flood_ticks + least;
}

// ---- Row a: idle spares stand still, since orbiting ones block lines of sight ----

Vec2 row_a_stand_still(const Robot& robot) noexcept {
  const Params& p = robot.params;
  const Vec2 u = u_avoid(robot);
  const int k = reference_of(robot);
  if (k < 0) return u;
  // A spare next to the tree stays within reach of its edges; a crowd far from the tree stays spread out.
  const bool called = robot.caller >= 0 && robot.self.spare_state == SpareState::adjust_position;
  const float reach = called                              ? p.avoidance_range
                      : robot.said(k).role != Role::spare ? 0.5F * p.recruitment_distance
                                                          : p.safe_range;
  return norm(robot.position(k)) > reach ? unit(robot.position(k)) + u : u;
}

// ---- Row b: needs that no spare answers spread hop by hop, and spares without an edge in sight follow ----

void row_b_call_spares(Robot& robot) noexcept {
  constexpr int unanswered_ticks = 20;
  constexpr int reach_hops = 250;
  State& self = robot.self;
  int hops = unreachable;
  for (int k = 0; k < robot.neighbors(); ++k)
    if (robot.alive(k)) hops = std::min<int>(hops, robot.said(k).call_hops);
  // Once a call is over, the hops that robots tell each other count up, which is no gradient to follow.
  const bool live = hops < self.call_hops && hops < reach_hops && self.phase == Phase::grow_tree;
  if (self.role == Role::spare || self.need != Need::need || self.phase != Phase::grow_tree) self.unserved_ticks = 0;
  else robot.add_elapsed(self.unserved_ticks);
  self.call_hops = self.unserved_ticks > unanswered_ticks ? std::uint8_t{0}
                   : hops < reach_hops                    ? static_cast<std::uint8_t>(hops + 1)
                                                          : unreachable;
  if (!live) return;
  robot.caller = least_of(robot.neighbors(), not_counted, [&](int k) {
    return robot.alive(k) && robot.said(k).call_hops == hops ? robot.range(k) : not_counted;
  });
}

// ---- Row k: inwards, candidates within S come before those beyond ----

float row_k_handicap(const Robot& robot, int k) noexcept {
  return robot.range(k) <= robot.params.safe_range ? 0.0F : static_cast<float>(unknown_label);
}

// ---- Row q: an edge of both trees exerts one force ----

int row_q_one_force(const Robot& /*robot*/, int /*k*/) noexcept { return 1; }

// ---- Row t: what ties a robot without a parent to the others, its hold ----
//
// Parents, old parents and holds obey the order of the tree and lead from each robot towards the root; both ends guard
// every such link. A robot without one stays in range of all that it hears. So the network stays in one piece.

constexpr float longest_link = 0.95F;  // C: the next step might break a longer one

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
  const int hops = hops_to_tree(robot.said(k));
  const float range = robot.range(k);
  const bool another = hops >= 0 && robot.table().id(k) != robot.self.hold;
  if (range > longest_link)
    return 8192.0F + 1024.0F * range + (another ? 10.0F : 0.0F) + static_cast<float>(hops) / unreachable;
  return (hops == unreachable ? 4096.0F : 0.0F) + (range > strained ? 2048.0F : 0.0F) +
         4.0F * static_cast<float>(hops) + (another ? 2.0F : 0.0F) + range;
}

// In place of keep_up_with_tree(): a spare keeps up with the hold that it would like best, which is ahead of it then.
void row_t_find_hold(Robot& robot) noexcept {
  State& self = robot.self;
  int wish = -1;  // the best neighbour, whether or not it is ahead of me
  int hold = -1;  // the best that is
  if (!robot.is_root() && robot.up() < 0) {
    float wish_cost = not_counted;
    float hold_cost = not_counted;
    for (int k = 0; k < robot.neighbors(); ++k) {
      if (!robot.alive(k) || robot.said(k).epoch != self.epoch || is_untied(robot.said(k))) continue;
      const bool ahead = is_ahead(robot, k);
      const float cost = cost_of_hold(robot, k);
      // A robot farther from the tree than I am may depend on me: it would never get ahead.
      if (cost < wish_cost && (ahead || hops_to_tree(robot.said(k)) < self.tree_hops)) wish = k, wish_cost = cost;
      if (cost < hold_cost && ahead) hold = k, hold_cost = cost;
    }
    // Until the flood of a new epoch has arrived, the last epoch's hold will do. A robot with children keeps it until
    // that epoch's tree is dropped: by the new labels a robot that depends on me through them may be ahead.
    const int last = robot.table().find(self.hold);
    const bool relied_on = self.phase < Phase::grow_tree && robot.children.size + robot.old_children.size > 0;
    if ((self.label == unknown_label || relied_on) && robot.alive(last)) hold = last;
    else if (self.label == unknown_label) hold = -1;
    if (wish >= 0 && self.role == Role::spare && self.phase >= Phase::grow_tree && self.request == nobody)
      keep_up(robot, wish);
  }
  robot.hold = hold;
  self.hold = hold < 0 ? nobody : robot.table().id(hold);
}

void row_t_guard_links(const Robot& robot, Guard& guard) noexcept {
  const State& self = robot.self;
  const float rate = robot.params.guard_rate;
  const float limited = longest_link - 2.0F * robot.params.speed_gain / rate;  // below it full speed is allowed
  const bool untied = robot.hold < 0 && robot.up() < 0 && !robot.is_root();
  for (int k = 0; k < robot.neighbors(); ++k) {
    const Message& m = robot.said(k);
    if (!robot.alive(k) || robot.is_tree_neighbor(k) || robot.range(k) <= limited) continue;
    // In a grown tree only robots of its epoch wait for a hold, and those that have not heard of any.
    const bool waits =
        is_untied(m) && (m.epoch == self.epoch || m.phase == Phase::init || self.phase < Phase::grow_tree);
    if (k == robot.hold || m.hold == self.id || untied || waits)
      guard.add(robot.position(k), longest_link - robot.table().spread(), rate);
  }
}

// ---- Row v: points of obstacles repel, and no robot pushes against them, since odometry is wrong when wheels slip
// ----

Vec2 row_v_repulsion(const Robot& robot, Vec2 u) noexcept {
  for (const Vec2 point : robot.obstacles) u += repulsion(robot.params, norm(point), point);
  return u;
}

void row_v_keep_off(const Robot& robot, Guard& guard) noexcept {
  constexpr float kept = 0.01F;  // C, between body and obstacle
  for (const Vec2 point : robot.obstacles) {
    const float d = norm(point);
    if (d > 0.0F) guard.add_limit(point / d, (d - robot.params.body_radius - kept) * robot.params.guard_rate);
  }
}

}  // namespace

constexpr Reading corrected{
    .is_stretched = row_2_stretched_and_wanted,
    .f = row_3_directional_f,
    .parent_range = row_4_parent_range,
    .guard_edges = row_4_guard_edges,
    .barrier_patience = row_7_barrier_patience,
    .adjust_position = row_a_stand_still,
    .call_spares = row_b_call_spares,
    .handicap = row_k_handicap,
    .edges_to = row_q_one_force,
    .keep_up = row_t_find_hold,
    .guard_links = row_t_guard_links,
    .keeps_links = true,
    .renews_labels = true,
    .u_obstacles = row_v_repulsion,
    .guard_obstacles = row_v_keep_off,
    .filters_positions = true,
};

}  // namespace banyan::paper
