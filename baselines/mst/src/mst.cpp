// SPDX-License-Identifier: MIT
#include "banyan/baselines/mst/mst.hpp"

#include <algorithm>

#include "rooms.hpp"

namespace banyan::baselines::mst {
namespace {

constexpr std::uint8_t first_tree_ticks = 10;

// (1)  u = tau pull to the target                                   robots that are sent, once there is a tree
// (2)  u = gain (mean of x_j over the tree neighbours j - x)        all others
// and in both cases + avoidance.
Vec2 desired_motion(const Robot& robot, std::span<const Vec2> obstacles) noexcept {
  const Table<Message>& table = robot.table();
  const Vec2 u = avoidance(table, obstacles, robot.params);
  if (robot.self.assignment.sent) return robot.self.has_tree ? u + target_pull(robot.self.assignment, robot.params) : u;
  Vec2 sum;
  float count = 0.0F;
  for (const RobotId end : robot.self.tree) {
    const int k = table.find(end);
    if (k < 0) continue;
    sum += table.position(k);
    count += 1.0F;
  }
  return count > 0.0F ? u + clamped(sum * (robot.params.consensus_gain / count), 1.0F) : u;
}

// Guards the tree, the earlier edges and, while the next tree is built, its edges and those that may become such.
void guard_tree(const Robot& robot, Guard& guard) noexcept {
  const State& self = robot.self;
  const auto add = [&](RobotId end) {
    if (const int k = robot.table().find(end); k >= 0)
      guard.add(robot.table().position(k), robot.params.longest_link - robot.table().spread(), robot.params.guard_rate);
  };
  for (const RobotId end : self.tree) add(end);
  for (const RobotId end : self.old) add(end);
  if (self.done) return;
  for (const RobotId end : self.branches) add(end);
  for (int c = 0; c < self.candidate_count; ++c)
    if (const Candidate& candidate = self.candidates[static_cast<std::size_t>(c)]; candidate.narrow) add(candidate.to);
}

Message composed(const State& s) noexcept {
  return {.id = s.id,
          .epoch = s.epoch,
          .next = s.next,
          .countdown = s.countdown,
          .level = s.level,
          .fragment = s.fragment,
          .up = s.up,
          .ready = s.ready,
          .decided = s.decided,
          .done = s.done,
          .full = s.is_full(),
          .best = s.best,
          .choice = s.choice,
          .root = s.least,
          .branches = s.branches.all()};
}

}  // namespace

State initial_state(RobotId id, bool worker, bool root) noexcept {
  State state = state_at_start<State>(id, worker, root);
  state.next = 1;  // the first tree is wanted at once, after time enough to hear all neighbours
  state.countdown = first_tree_ticks;
  return state;
}

Output<Message> step(const Params& params, State& state, const Inputs<Heard>& inputs) noexcept {
  begin_step(params, state, inputs, [&](RobotId id) { return state.holds(id); });

  Robot robot{params, state, inputs.elapsed_ticks()};
  follow_epoch(robot);
  construct(robot);
  drop_old_edges(robot);
  Guard guard;
  guard_tree(robot, guard);
  return {composed(state), move(desired_motion(robot, inputs.obstacles()), guard, params)};
}

Report report(const State& s) noexcept {
  Report r = report_without_links(s);
  r.parent = r.role == Role::root ? nobody : s.parent;
  r.kept = s.held().all();
  r.root_sequence = s.tree_epoch;
  r.epoch = s.epoch;
  return r;
}

void add_to(Digest& digest, const State& s) noexcept {
  const auto add = [&](const auto&... fields) { (digest.add(fields), ...); };
  const auto add_ends = [&](const Ends& ends) {
    for (const RobotId end : ends.all()) add(end);
  };
  add(s.id, s.assignment.sent, s.assignment.known, s.assignment.target);
  add_ends(s.tree);
  add_ends(s.old);
  add(s.has_tree, s.parent, s.root, s.tree_epoch, s.epoch, s.next, s.countdown, s.epoch_ticks);
  add(s.level, s.fragment, s.up, s.ready, s.decided, s.done, s.failed, s.least, s.least_by, s.unanswered_ticks,
      s.decided_ticks);
  for (const Edge& e : {s.best, s.choice}) add(e.from, e.to, e.length);
  add_ends(s.branches);
  add_ends(s.refused);
  add(s.candidate_count);
  for (int c = 0; c < s.candidate_count; ++c) {
    const Candidate& candidate = s.candidates[static_cast<std::size_t>(c)];
    add(candidate.to, candidate.length, candidate.narrow);
  }
  add(s.tally.rejected);
  s.neighbors.add_to(digest);
}

}  // namespace banyan::baselines::mst
