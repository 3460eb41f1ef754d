// SPDX-License-Identifier: MIT
#include "banyan/baselines/chains/chains.hpp"

#include "banyan/controller/core/fixed_point.hpp"
#include "rooms.hpp"

namespace banyan::baselines::chains {
namespace {

bool is_tied_to(const State& self, RobotId id) noexcept {
  if (id == self.child || id == self.root) return true;
  return std::any_of(self.chains.begin(), self.chains.end(),
                     [&](const Chain& c) { return id == c.parent || id == c.asked; });
}

void remember(State& self, const Carry& carry) noexcept {
  for (KnownPlace* place : {&self.base, &self.child_place, &self.gap})
    if (place->known) place->at = carry.point(place->at);
  self.outwards = carry.vector(self.outwards);
  const int k = self.neighbors.find(self.root);
  if (k >= 0 && self.neighbors.age(k) == 0) self.base.put(self.neighbors.position(k));
}

std::uint16_t to_steps(float length) noexcept { return to_fixed<std::uint16_t>(length, per_range); }

Message composed(const State& s) noexcept {
  Message m{.id = s.id,
            .worker = s.worker,
            .chain = s.number,
            .whole = s.whole,
            .above = s.chains[0].above,
            .below = s.below,
            .links = s.links,
            .beyond = to_steps(s.beyond),
            .path = to_steps(s.path),
            .root = s.root,
            .root_age = s.root_age};
  if (s.chains[0].parent == nobody) m.above = no_ids();
  for (std::size_t i = 0; i < most_chains; ++i) {
    if (s.is_worker()) m.above[i] = s.chains[i].parent;
    if (s.chains[i].asked != nobody) m.asks = s.chains[i].asked;
  }
  return m;
}

}  // namespace

State initial_state(RobotId id, bool worker, bool root) noexcept { return state_at_start<State>(id, worker, root); }

Output<Message> step(const Params& params, State& state, const Inputs<Heard>& inputs) noexcept {
  begin_step(params, state, inputs, [&](RobotId id) { return is_tied_to(state, id); });
  state.follow_root(state.id, state.assignment.sent, state.neighbors, inputs.elapsed_ticks(), state.tally);
  remember(state, inputs.carry());

  Robot robot{params, state, inputs.elapsed_ticks()};
  follow_chain(robot, inputs.orders().given_up);
  recruit(robot);
  if (state.is_base()) return {composed(state), {}};
  Guard guard;
  guard_chain(robot, guard);
  const Vec2 u = spacing_motion(robot) + avoidance(state.neighbors, inputs.obstacles(), params);
  return {composed(state), move(u, guard, params)};
}

Report report(const State& s) noexcept {
  Report r = report_without_links(s);
  if (r.role == Role::connector && s.is_free()) r.role = Role::spare;
  if (r.role == Role::root) return r;
  if (s.stands_in()) {
    r.role = Role::worker;
    r.serves = s.worker;
  }
  std::size_t kept = 0;
  for (const Chain& chain : s.chains) {
    if (chain.parent == nobody || chain.parent == r.parent || keeps(r, chain.parent)) continue;
    if (r.parent == nobody) r.parent = chain.parent;
    else r.kept[kept++] = chain.parent;
  }
  r.want = s.beyond;
  return r;
}

void add_to(Digest& digest, const State& s) noexcept {
  const auto add = [&](const auto&... fields) { (digest.add(fields), ...); };
  const auto add_ids = [&](const Ids& ids) {
    for (const RobotId id : ids) add(id);
  };
  add(s.id, s.assignment.sent, s.assignment.known, s.assignment.target, s.root, s.root_age, s.rootless_ticks);
  add(s.worker, s.number, s.child, s.links, s.beyond, s.path, s.whole, s.linked);
  add(s.gap_ticks, s.astray_ticks, s.ignored, s.ignored_ticks);
  for (const KnownPlace& place : {s.base, s.child_place, s.gap}) add(place.known, place.at);
  add(s.outwards);
  for (const Chain& chain : s.chains) {
    add(chain.parent, chain.asked, chain.asked_ticks);
    add_ids(chain.above);
  }
  add_ids(s.below);
  add(s.tally.insertions, s.tally.repairs, s.tally.elections, s.tally.replacements, s.tally.rejected);
  s.neighbors.add_to(digest);
}

}  // namespace banyan::baselines::chains
