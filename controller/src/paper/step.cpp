// SPDX-License-Identifier: MIT
// "a high-level state machine that encodes the behavior of every robot" (paper Sec. III-B, Fig. 1): one tick of one
// robot.
#include "banyan/controller/core/edge_frame.hpp"
#include "banyan/controller/paper/rules.hpp"

namespace banyan::paper {

Output<Message> step(const Growth& growth, const Reading& reading, const Params& params, State& state,
                     const Inputs<Heard>& inputs) noexcept {
  Robot robot{growth, reading, params, state, inputs.obstacles(), inputs.elapsed_ticks()};
  begin_tick(robot, inputs);
  listen(robot);        // "go"
  accept_offer(robot);  // Select Root, the new root's side
  robot.epoch = state.epoch;
  robot.parent = robot.find(state.parent);
  robot.old_parent = robot.find(state.old_parent);
  update_role(robot);
  advance(robot);        // the root's barriers
  start_tree(robot);     // Start Tree
  select_parent(robot);  // Select Parent
  take_census(robot);
  algorithm_1(robot);
  algorithm_2(robot);
  reading.find_hold(robot);
  reading.call_spares(robot);
  manage_spares(robot);                                                     // Grow Tree
  select_root(robot);                                                       // Select Root
  const Vec2 wish = state.role == Role::spare ? u_spare(robot) : u(robot);  // Robot Motion
  Guard guard;
  for (const Reading::Limit limit : {reading.guard_edges, reading.guard_links, reading.guard_obstacles})
    limit(robot, guard);
  const Vec2 v = clamped(guard.apply(clamped(wish, 1.0F) * params.speed_gain), 1.0F);
  return {written(robot), drive(v, guard, params)};
}

// What is remembered is carried into the robot's present frame, and the neighbour table is brought up to date.
void begin_tick(Robot& robot, const Inputs<Heard>& inputs) noexcept {
  State& self = robot.self;
  Neighborhood& table = self.neighbors;
  const Carry carry = inputs.carry();
  if (self.target_known) self.target = carry.point(self.target);
  if (self.centroid_known) self.centroid = carry.point(self.centroid);
  self.tally.rejected += inputs.rejected();

  const auto is_parent = [&](RobotId id) { return id == self.parent || id == self.old_parent; };
  const auto matters = [&](const Message& m) {
    return is_parent(m.id) || m.parent == self.id || m.old_parent == self.id || m.hold == self.id;
  };
  table.begin(robot.elapsed_ticks, robot.reading.filters_positions ? robot.params.way_in_a_round() : 0.0F);
  for (const Heard& h : inputs.heard()) {
    const Message& m = *h.message;
    Vec2 before;
    if (m.id == self.id || m.id == nobody) continue;
    int k = table.file(m.id, h.position, before, carry);
    if (k < 0) k = table.enter(m.id, h.position, matters(m), [&](int j) { return matters(robot.said(j)); });
    if (k >= 0) table.messages[static_cast<std::size_t>(k)] = m;
  }
  const int liveness_ticks = whole(robot.params.liveness_rounds);
  const auto keeps = [&](int k) { return is_parent(robot.said(k).id); };
  for (int k = 0; (k = table.remove_next(k, carry, liveness_ticks, keeps)) >= 0;)
    close_gap(table.messages, k, table.size() + 1);

  const Orders& orders = inputs.orders();
  robot.is_station = orders.station;
  self.is_worker = orders.sent;
  self.target_known = orders.target.has_value() || (orders.sent && self.target_known);
  if (orders.target) self.target = *orders.target;
}

// "the robots can have four possible roles: root, worker, connector, or spare" (Sec. III-A). A connector waits for a
// child that may only have been silent.
void update_role(Robot& robot) noexcept {
  constexpr int patience_ticks = 30;
  State& self = robot.self;
  const bool was_spare = self.role == Role::spare;
  const bool has_joined = !was_spare && self.request != nobody;
  const bool useful =
      has_joined || robot.any([&](int k) { return robot.is_below(k) && robot.said(k).role != Role::spare; });
  self.role = robot.is_root()        ? Role::root
              : self.is_worker       ? Role::worker
              : useful || !was_spare ? Role::connector
                                     : Role::spare;
  if (was_spare && self.role != Role::spare) self.request = nobody;
  if (self.role == Role::connector && !useful) robot.add_elapsed(self.childless_ticks);
  else self.childless_ticks = 0;
  if (self.childless_ticks <= patience_ticks) return;
  self.role = Role::spare;
  self.childless_ticks = 0;
  if (!robot.has_child()) leave_tree(robot);
}

void leave_tree(Robot& robot) noexcept {
  State& self = robot.self;
  robot.set_parent(nobody);
  robot.set_old_parent(nobody);
  self.committed = false;
  self.need = Need::no_need;
  self.grant = self.request = nobody;
  self.spare_state = SpareState::wait;
}

// What it says of itself, with vectors in the frame of the edge to their addressee.
Message written(const Robot& robot) noexcept {
  const State& self = robot.self;
  Message m = static_cast<const Message&>(self);
  m.q = {};
  if (const int up = robot.up(); up >= 0) {
    constexpr float most = 0.5F * largest_q;  // turned, a component grows by up to sqrt 2
    const Vec2 q{std::clamp(self.q.x, -most, most), std::clamp(self.q.y, -most, most)};
    m.q = to_edge_frame(q, robot.position(up));
    write_in_edge_frame(self.pull, robot.position(up), pull_unit, m.pull_x, m.pull_y);
  }
  const int heir = robot.find(self.new_root);
  if (heir < 0) m.new_root = nobody;  // it could not be told where the centroid is
  else write_in_edge_frame(self.centroid - robot.position(heir), robot.position(heir), m.centroid_x, m.centroid_y);
  return m;
}

State initial(RobotId id, bool worker, bool root) noexcept {
  State self;
  self.id = id;
  self.is_worker = worker;
  self.role = root ? Role::root : worker ? Role::worker : Role::spare;
  if (root) self.root = {1, id};
  return self;
}

Report report(const State& s) noexcept {
  // clang-format off
  return {.role = s.role, .parent = s.parent, .old_parent = s.old_parent, .serves = s.is_worker ? s.id : nobody,
          .root = s.root.id, .root_sequence = s.root.sequence, .epoch = s.epoch, .phase = s.phase, .need = s.need,
          .spare_state = s.spare_state, .label = s.label == unknown_label ? -1.0F : from_fixed(s.label),
          .depth = s.depth, .grant = s.grant, .request = s.role == Role::spare ? s.request : nobody,
          .want = from_fixed(s.want), .out_of_scale = s.label == largest_label, .tally = s.tally};
  // clang-format on
}

void add_to(Digest& digest, const State& s) noexcept {
  FieldDigest visit{digest};
  const auto add = [&](const auto&... fields) { (digest.add(fields), ...); };
  visit_fields(visit, s);
  add(s.is_worker, s.target_known, s.centroid_known, s.spare_state, s.reference, s.target, s.pull, s.centroid,
      s.phase_ticks, s.done_ticks, s.label_wait_ticks, s.search_ticks, s.orphan_ticks, s.childless_ticks, s.offer_ticks,
      s.unserved_ticks, s.grant_ticks, s.request_ticks, s.ungranted_ticks);
  add(s.tally.insertions, s.tally.handovers, s.tally.repairs, s.tally.rejected, s.neighbors.size());
  for (int k = 0; k < s.neighbors.size(); ++k) {
    add(s.neighbors.age(k), s.neighbors.position(k), s.neighbors.measurements(k));
    visit_fields(visit, s.neighbors.messages[static_cast<std::size_t>(k)]);
  }
  s.neighbors.filter().visit(add);
}

}  // namespace banyan::paper
