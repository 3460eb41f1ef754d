// SPDX-License-Identifier: MIT
// One round of one robot.
#include "caravan/rules.hpp"

namespace banyan::caravan {
namespace {

void file_heard(Robot& robot, const Inputs<Heard>& inputs) noexcept {
  State& self = robot.self;
  Table& table = self.neighbors;
  const Carry& carry = robot.carry;
  for (Token& t : self.known()) t.place = carry.point(t.place);
  carry_detour(self.detour, carry);
  self.tally.rejected += inputs.rejected();
  const auto is_up = [&](RobotId id) { return id == self.parent || id == self.other; };
  const auto matters = [&](RobotId id, const Statement& m) {
    return is_up(id) || m.parent == self.id || m.other == self.id;
  };
  table.begin(robot.elapsed_rounds, robot.params.way_in_a_round());
  for (Heard& h : robot.heard) {
    const Message& m = *h.message;
    h.before = {};
    if (m.id == self.id || m.id == nobody) continue;
    int k = table.file(m.id, h.position, h.before, carry);
    if (k < 0)
      k = table.enter(m.id, h.position, matters(m.id, m),
                      [&](int j) { return matters(table.id(j), table.statements[static_cast<std::size_t>(j)]); });
    if (k < 0) continue;
    table.statements[static_cast<std::size_t>(k)] = static_cast<const Statement&>(m);
  }
  const auto keeps = [&](int k) { return is_promised(robot, k); };
  for (int k = 0; (k = table.remove_next(k, carry, robot.liveness(), keeps)) >= 0;)
    close_gap(table.statements, k, table.size() + 1);
}

void index_neighbors(Robot& robot) noexcept {
  State& self = robot.self;
  const Table& table = robot.table();
  robot.parent = table.find(self.parent);
  if (robot.parent < 0) self.parent = nobody;
  robot.other = table.find(self.other);
  robot.add_elapsed(self.other_rounds);
  // The old promise ends by agreement: that robot is heard, has had time to hear me, and is joined to my root by
  // others; or with its lease.
  const bool agreed = robot.other >= 0 && table.age(robot.other) == 0 && robot.said(robot.other).root == self.root &&
                      self.other_rounds > robot.hidden_after();
  if (agreed || robot.other < 0 || table.age(robot.other) > robot.lease()) self.other = nobody, robot.other = -1;
  for (int k = 0; k < table.size(); ++k) {
    const Statement& m = robot.said(k);
    if (m.parent == self.id && m.role != Role::spare) robot.children.set(k, true), ++robot.child_count;
  }
}

// A connector waits a little for a child that may only have been silent.
void update_role(Robot& robot) noexcept {
  constexpr int patience = 10;
  State& self = robot.self;
  if (robot.child_count > 0) self.childless_rounds = 0;
  else robot.add_elapsed(self.childless_rounds);
  const bool needed = robot.child_count > 0 || (self.role == Role::connector && self.childless_rounds <= patience);
  self.role = robot.is_root()         ? Role::root
              : self.serves != nobody ? Role::worker
              : needed                ? Role::connector
                                      : Role::spare;
  self.children = static_cast<std::uint8_t>(robot.child_count);
  float want = 0.0F;
  const float rests_within = 0.6F * robot.params.arrival_distance;
  if (const Vec2* target = self.target(); target != nullptr && norm(*target) > rests_within) want = norm(*target);
  self.want = to_fixed<std::uint16_t>(want, per_range);
  robot.children.for_each([&](int k) { self.want = std::max(self.want, robot.said(k).want); });
  self.hops = 0;
  if (self.role == Role::spare)
    self.hops = robot.parent < 0 ? UINT8_MAX
                : robot.is_tree(robot.parent)
                    ? std::uint8_t{1}
                    : static_cast<std::uint8_t>(std::min(robot.said(robot.parent).hops + 1, 254));
}

}  // namespace

State initial(RobotId id, bool worker, bool root) noexcept {
  constexpr Serial first_root = 2;  // newer than any that is chosen where it has not been heard of
  State self;
  self.id = id;
  self.was_sent = worker;
  if (worker) self.serves = id;
  if (root) self.root = self.newest = {first_root, id};
  return self;
}

Output<Message> step(const Params& params, State& state, const Inputs<Heard>& inputs) noexcept {
  Robot robot{params,         state,          inputs.obstacles(),     inputs.elapsed_ticks(),
              inputs.carry(), inputs.heard(), inputs.orders().station};
  file_heard(robot, inputs);
  measure_silence(robot);
  follow_orders(robot, inputs.orders());
  keep_tokens(robot, inputs.orders());
  index_neighbors(robot);
  update_role(robot);
  remember_corners(robot);
  watch_charge(robot, inputs);
  choose_parent(robot);
  tell_corner(robot);
  keep_up(robot);
  call_spares(robot);
  const Vec2 wish = clamped(goal(robot), 1.0F);
  Guard guard;
  limit_motion(robot, guard);
  const Vec2 v = clamped(guard.apply(wish * params.speed_gain), 1.0F);
  watch_progress(robot, v);
  Output<Message> output{static_cast<const Message&>(state), drive(v, guard, params)};
  output.message.token = told_in_turn(robot);
  return output;
}

Report report(const State& s) noexcept {
  Report r{.role = s.role,
           .serves = s.serves,
           .root = s.newest.id,
           .root_sequence = s.newest.sequence,
           .phase = Phase::grow_tree,
           .label = from_fixed(s.label),
           .want = from_fixed(s.want),
           .tally = s.tally};
  if (s.role == Role::spare) r.kept[0] = s.parent;
  else r.parent = s.parent, r.old_parent = s.other;
  r.leaves = s.leaving && s.role != Role::spare;
  r.seeks_charge = s.seeks_charge;
  return r;
}

void add_to(Digest& digest, const State& s) noexcept {
  FieldDigest visit{digest};
  const auto add = [&](const auto&... fields) { (digest.add(fields), ...); };
  visit_fields(visit, static_cast<const Message&>(s));
  add(s.level, s.was_charged, s.seeks_charge, s.newest.sequence, s.newest.id, s.serves, s.was_sent, s.unfit, s.nearest,
      s.effort, s.stuck_rounds, s.token_count, s.turn, s.urgent_turn, s.since_start, s.rests, s.other_rounds,
      s.rest_rounds, s.childless_rounds, s.left, s.ended.source, s.ended.count, s.ended_rounds, s.post_count,
      s.call_silence, s.unserved_rounds, s.expected_packets, s.missed_packets, s.loss_rounds, s.assumed_silence,
      s.round, s.neighbors.size());
  for (int k = 0; k < s.neighbors.size(); ++k) {
    add(s.neighbors.id(k), s.neighbors.age(k), s.neighbors.position(k), s.neighbors.measurements(k));
    Message said;
    static_cast<Statement&>(said) = s.neighbors.statements[static_cast<std::size_t>(k)];
    visit_fields(visit, said);
  }
  for (const Token& t : s.known())
    add(t.name, t.holder, t.beat, t.age, t.place, t.located, t.reached, t.charging, t.urgent);
  add(s.detour.side, s.detour.contact, s.detour.origin, s.detour.goal, s.detour.leave, s.detour.span,
      s.detour.last_side, s.detour.again);
  for (std::size_t k = 0; k < s.corner_count; ++k) add(s.corners[k]);
  s.neighbors.filter().visit(add);
}

}  // namespace banyan::caravan
