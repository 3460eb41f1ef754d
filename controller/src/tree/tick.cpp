// SPDX-License-Identifier: MIT
#include "tree/tick.hpp"

#include <algorithm>

#include "banyan/controller/core/edge_frame.hpp"

namespace banyan {

void begin_as(TreeState& self, RobotId id, bool worker, bool root) noexcept {
  self.id = id;
  self.is_worker = worker;
  self.role = root ? Role::root : worker ? Role::worker : Role::spare;
  if (root) self.root = {1, id};
}

TreeState initial_tree_state(RobotId id, bool worker, bool root) noexcept { return begun<TreeState>(id, worker, root); }

void follow_orders(TreeRobot& robot, const Orders& orders) noexcept {
  TreeState& self = robot.self;
  robot.is_station = orders.station;
  self.is_worker = orders.sent;
  if (!orders.sent) self.target_known = false;
  if (orders.target) {
    self.target = *orders.target;
    self.target_known = true;
  }
  robot.target = self.is_worker && self.target_known ? &self.target : nullptr;
}

void carry_memory(TreeState& self, const Carry& carry) noexcept {
  if (self.target_known) self.target = carry.point(self.target);
  if (self.centroid_known) self.centroid = carry.point(self.centroid);
}

void file_heard(TreeRobot& robot) noexcept {
  const TreeState& self = robot.self;
  const RobotId me = self.id;
  TreeTable& table = robot.self.neighbors;
  const auto ties = [&](RobotId id, const TreeStanding& m) {
    return id == self.parent || id == self.old_parent || m.parent == self.id || m.old_parent == self.id ||
           hold_of(m) == self.id;
  };
  table.begin(robot.elapsed_ticks, robot.params.way_in_a_round());
  const bool noisy = table.filter().has_seen_noise();
  for (Heard& h : robot.heard) {
    const TreeMessage& m = *h.message;
    h.place = -1;
    if (m.id == me || m.id == nobody) continue;
    h.before = {};
    int k = table.file(m.id, h.position, h.before, robot.carry);
    const bool is_new = k < 0;
    if (is_new) {
      k = table.enter(m.id, h.position, ties(m.id, m), [&](int j) { return ties(table.id(j), table.message(j)); });
      if (k < 0) continue;
      table.set_deaf(k, never_heard_ticks);
    }
    h.place = static_cast<std::int16_t>(k);
    if (noisy) h.position = table.position(k);
    h.named_before = table.message(k).count;
    table.keep(k, m, me, is_new);
  }
}

void forget_silent(TreeRobot& robot, FunctionRef<bool(int)> is_tied, FunctionRef<void(int, int)> close) noexcept {
  TreeTable& table = robot.self.neighbors;
  const auto keeps = [&](int k) {
    return table.id(k) == robot.self.parent || table.id(k) == robot.self.old_parent || is_tied(k);
  };
  const int liveness_ticks = robot.liveness_ticks();
  for (int k = 0; (k = table.remove_next(k, robot.carry, robot.forget_ticks, keeps, liveness_ticks)) >= 0;) {
    table.forget(k);
    close(k, table.size() + 1);
  }
}

void write_tree(const TreeRobot& robot, TreeMessage& m) noexcept {
  const TreeState& self = robot.self;
  m.id = self.id;
  m.role = self.role;
  m.phase = self.phase;
  m.need = self.need;
  m.flood_done = self.flood_done;
  m.committed = self.committed;
  m.parent_silent = self.parent != nobody && !robot.parent_alive();
  m.epoch = self.epoch;
  m.root = self.root;
  m.label = self.label;
  m.seqno = self.seqno;
  m.depth = self.depth;
  m.tree_hops = self.tree_hops;
  m.call_hops = self.call_hops;
  m.parent = self.parent;
  m.old_parent = self.old_parent;
  m.flood_parent = self.flood_parent;
  m.flood_robots = self.flood_robots;
  m.flood_workers = self.flood_workers;
  m.subtree = self.subtree;
  m.subtree_workers = self.subtree_workers;
  m.count = self.count;
  m.grant = robot.hold >= 0 && robot.up() < 0 ? robot.table().id(robot.hold) : self.grant;
  m.request = self.request;
  m.inserted_child = self.inserted_child;
  m.want = to_fixed<std::uint16_t>(self.want, per_range);
  if (const int up = robot.up(); up >= 0) {
    const Vec2 addressee = robot.table().position(up);
    const Vec2 q = to_edge_frame(self.q, addressee);
    m.q_x = q.x, m.q_y = q.y;
    write_in_edge_frame(self.pull, addressee, pull_unit, m.pull_x, m.pull_y);
  }
  const int heir = robot.table().find(self.new_root);
  if (heir < 0) return;
  const Vec2 addressee = robot.table().position(heir);
  m.new_root = self.new_root;
  write_in_edge_frame(self.centroid - addressee, addressee, m.centroid_x, m.centroid_y);
}

Report tree_report(const TreeState& s) noexcept {
  // clang-format off
  return {.role = s.role, .parent = s.parent, .old_parent = s.old_parent, .serves = s.is_worker ? s.id : nobody,
          .root = s.root.id, .root_sequence = s.root.sequence, .epoch = s.epoch, .phase = s.phase, .need = s.need,
          .spare_state = s.spare_state, .label = s.label == unknown_label ? -1.0F : from_fixed(s.label), .depth = s.depth,
          .grant = s.grant, .request = s.request, .want = s.want, .out_of_scale = s.label == largest_label,
          .tally = s.tally};
  // clang-format on
}

void add_to(Digest& digest, const TreeMessage& message) noexcept {
  FieldDigest visit{digest};
  visit_fields(visit, message);
}

void add_to(Digest& digest, const TreeState& state) noexcept {
  const auto add = [&](const auto& field) { digest.add(field); };
  visit_tree_state(add, state);
  const TreeTable& table = state.neighbors;
  digest.add(table.size());
  for (int k = 0; k < table.size(); ++k) {
    digest.add(table.id(k));
    digest.add(table.age(k));
    digest.add(table.position(k));
    digest.add(table.measurements(k));
    TreeMessage said;
    static_cast<TreeStanding&>(said) = table.message(k);
    said.id = table.id(k);
    add_to(digest, said);
  }
  table.filter().visit(add);
}

}  // namespace banyan
