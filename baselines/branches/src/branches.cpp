// SPDX-License-Identifier: MIT
#include "banyan/baselines/branches/branches.hpp"

#include "rooms.hpp"

namespace banyan::baselines::branches {
namespace {

bool is_tied_to(const State& self, RobotId id) noexcept {
  return self.links.has(id) || id == self.held_by || id == self.change.joins || id == self.calls || id == self.team;
}

Ids ids_of(const Links& links) noexcept {
  Ids ids = no_ids();
  for (std::size_t i = 0; i < links.size(); ++i) ids[i] = links[i].to;
  return ids;
}

Message composed(const State& s) noexcept {
  return {.id = s.id,
          .leader = s.is_leader(),
          .connector = s.connector,
          .links = ids_of(s.links),
          .parent = s.parent,
          .joined_age = s.joined_age,
          .stage = s.change.stage,
          .leaves = s.change.leaves,
          .joins = s.change.joins,
          .held_by = s.held_by,
          .calls = s.calls,
          .team = s.team,
          .team_age = s.team_age,
          .needy = s.needy,
          .needed = s.needed,
          .needy_age = s.needy_age,
          .sends = s.sends,
          .root = s.root,
          .root_age = s.root_age};
}

}  // namespace

State initial_state(RobotId id, bool worker, bool root) noexcept {
  State state = state_at_start<State>(id, worker, root);
  state.connector = root && !worker;
  return state;
}

Output<Message> step(const Params& params, State& state, const Inputs<Heard>& inputs) noexcept {
  begin_step(params, state, inputs, [&](RobotId id) { return is_tied_to(state, id); });
  state.follow_root(state.id, state.assignment.sent, state.neighbors, inputs.elapsed_ticks(), state.tally);

  Robot robot{params, state, inputs.elapsed_ticks()};
  take_part(robot);
  watch_links(robot, inputs.carry());
  change_links(robot);
  join(robot);
  follow_team(robot);

  Guard guard;
  guard_links(robot, guard);
  const Vec2 u = spacing_motion(robot) + avoidance(state.neighbors, inputs.obstacles(), params);
  return {composed(state), move(u, guard, params)};
}

Report report(const State& s) noexcept {
  Report r = report_without_links(s);
  if (r.role == Role::connector && s.is_follower()) r.role = Role::spare;
  r.parent = s.parent;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < s.links.size(); ++i)
    if (s.links[i].to != r.parent) r.kept[kept++] = s.links[i].to;
  return r;
}

void add_to(Digest& digest, const State& s) noexcept {
  const auto add = [&](const auto&... fields) { (digest.add(fields), ...); };
  add(s.id, s.assignment.sent, s.assignment.known, s.assignment.target, s.root, s.root_age, s.rootless_ticks);
  add(s.connector, s.root_ticks, s.parent, s.joined_age, s.cut_ticks, s.lost, s.lost_root, s.lost_at, s.lost_ticks,
      s.leaf_ticks);
  for (std::size_t i = 0; i < s.links.size(); ++i) {
    const Link& link = s.links[i];
    add(link.to, link.unanswered_ticks, link.loop_ticks, link.connector, link.at);
  }
  add(static_cast<std::uint8_t>(s.change.stage), s.change.leaves, s.change.joins, s.change.recruits, s.change.ticks);
  add(s.held_by, s.held_other, s.leaves, s.calls, s.calls_ticks, s.ignored, s.ignored_ticks);
  add(s.team, s.team_age, s.travels, s.needy, s.needed, s.needy_age, s.sends, s.sends_ticks);
  add(s.tally.insertions, s.tally.repairs, s.tally.elections, s.tally.replacements, s.tally.rejected);
  s.neighbors.add_to(digest);
}

}  // namespace banyan::baselines::branches
