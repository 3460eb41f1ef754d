// SPDX-License-Identifier: MIT
#include "banyan/baselines/link_consensus/link_consensus.hpp"

#include <algorithm>

#include "rooms.hpp"

namespace banyan::baselines::link_consensus {
namespace {

// (1)  phi(s) = 1 / s^2 + 1 / (1 - s^2),  s = d / R: the potential of a link of length d, infinite at 0 and at R.
// (2)  its force on either end, towards the other: phi'(s) / 2 = s / (1 - s^2)^2 - 1 / s^3, zero at s = 1 / sqrt 2.
float tension(float d, float longest) noexcept {
  constexpr float least = 0.05F, most = 0.99F;  // beyond these the clamp holds anyway
  const float s = std::clamp(d / longest, least, most);
  const float rest = 1.0F - s * s;
  return s / (rest * rest) - 1.0F / (s * s * s);
}

// (3)  u = tau pull to the target + gain * sum over kept links of (2), each term within [-1, 1], + avoidance.
Vec2 desired_motion(const Robot& robot, std::span<const Vec2> obstacles) noexcept {
  const Params& p = robot.params;
  const Table<Message>& table = robot.table();
  Vec2 u = target_pull(robot.self.assignment, p) + avoidance(table, obstacles, p);
  for (int l = 0; l < robot.self.links.size(); ++l) {
    const int k = table.find(robot.self.links[l].to);
    if (k < 0 || !robot.self.links[l].kept) continue;
    u += unit(table.position(k)) * std::clamp(p.link_gain * tension(table.range(k), p.longest_link), -1.0F, 1.0F);
  }
  return u;
}

void guard_links(const Robot& robot, Guard& guard) noexcept {
  for (int l = 0; l < robot.self.links.size(); ++l)
    if (const int k = robot.table().find(robot.self.links[l].to); k >= 0)
      guard.add(robot.table().position(k), robot.params.longest_link - robot.table().spread(), robot.params.guard_rate);
}

Message composed(const State& self) noexcept {
  Message m{.id = self.id,
            .root = self.root,
            .beat = self.beat,
            .way = self.way,
            .parent = self.parent,
            .links = no_links(),
            .bid = self.bid,
            .agrees = self.agrees};
  for (int l = 0; l < self.links.size(); ++l) m.links[static_cast<std::size_t>(l)] = self.links[l].to;
  return m;
}

}  // namespace

State initial_state(RobotId id, bool worker, bool root) noexcept {
  State state = state_at_start<State>(id, worker, root);
  if (root) state.way = 0;
  return state;
}

Output<Message> step(const Params& params, State& state, const Inputs<Heard>& inputs) noexcept {
  begin_step(params, state, inputs, [&](RobotId id) { return state.links.find(id) >= 0; });

  Robot robot{params, state, state.ticks.advance(inputs.elapsed()), inputs.elapsed_ticks()};
  follow_root(robot);
  renew_links(robot);
  agree(robot);
  Guard guard;
  guard_links(robot, guard);
  return {composed(state), move(desired_motion(robot, inputs.obstacles()), guard, params)};
}

Report report(const State& s) noexcept {
  Report r = report_without_links(s);
  r.parent = s.parent;
  std::size_t kept = 0;
  for (int l = 0; l < s.links.size(); ++l)
    if (s.links[l].kept) r.kept[kept++] = s.links[l].to;
  return r;
}

void add_to(Digest& digest, const State& s) noexcept {
  const auto add = [&](const auto&... fields) { (digest.add(fields), ...); };
  const auto add_bid = [&](const Bid& b) { add(b.owner, b.other, b.length, b.serial, b.reach, b.lease_ticks); };
  add(s.id, s.assignment.sent, s.assignment.known, s.assignment.target, s.ticks.left());
  add(s.root, s.beat, s.way, s.parent, s.silent_ticks, s.lost_root, s.lost_beat, s.lost_ticks);
  add(s.links.size(), s.given_up);
  for (int l = 0; l < s.links.size(); ++l)
    add(s.links[l].to, s.links[l].kept, s.links[l].repairs, s.links[l].offered_steps);
  add_bid(s.bid);
  add_bid(s.last_bid);
  add(s.agrees, s.serial, s.own_lease_ticks, s.insists, s.tried, s.rest_ticks);
  add(s.tally.repairs, s.tally.elections, s.tally.rejected);
  s.neighbors.add_to(digest);
}

}  // namespace banyan::baselines::link_consensus
