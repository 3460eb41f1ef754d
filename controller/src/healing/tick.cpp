// SPDX-License-Identifier: MIT
#include "healing/tick.hpp"

#include "healing/healing.hpp"
#include "healing/tie.hpp"
#include "obstacles/bypass.hpp"

namespace banyan {
namespace {

constexpr float target_moved = 0.15F;  // in one step: progress counts from the start again
constexpr float straying = 0.2F;       // of v

}  // namespace

void begin_as(HealingState& self, RobotId id, bool worker, bool root) noexcept {
  begin_as(static_cast<TreeState&>(self), id, worker, root);
  self.was_sent = worker;
  if (worker) self.serves = id;
}

HealingState initial_healing_state(RobotId id, bool worker, bool root) noexcept {
  return begun<HealingState>(id, worker, root);
}

void follow_orders(HealingRobot& robot, const Orders& orders) noexcept {
  HealingState& self = robot.self;
  const bool called_back = self.was_sent && (!orders.sent || orders.given_up == self.id);
  if (self.is_worker &&
      ((called_back && self.serves == self.id) || (orders.given_up != nobody && self.serves == orders.given_up))) {
    self.is_worker = false;
    self.serves = nobody;
  }
  robot.is_station = orders.station;
  if (orders.sent && (!self.was_sent || called_back)) {
    self.is_worker = true;
    self.serves = self.id;
  }
  self.was_sent = orders.sent;
  for (const RobotId ended : {called_back ? self.id : nobody, orders.given_up}) {  // no longer given up in vain
    Task* task = ended == nobody ? nullptr : find_task(self, ended);
    if (task == nullptr) continue;
    task->gave_up = false;
    if (task->times_put_off == 0) continue;
    announce(*task, nobody);  // not to be tried again
    task->silent = false;
  }
  if (!orders.sent) self.target_known = false;
  if (orders.target) {
    const float off = self.target_known ? distance(*orders.target, self.target) : 0.0F;
    if (off > target_moved) self.progress = {};
    robot.target_strays = off > straying * robot.params.way_in_a_round() * static_cast<float>(robot.elapsed_ticks);
    self.target = *orders.target;
    self.target_known = true;
  }
  robot.target = self.is_worker && self.serves == self.id && self.target_known ? &self.target : nullptr;
}

void carry_memory(HealingState& self, const Carry& carry) noexcept {
  carry_memory(static_cast<TreeState&>(self), carry);
  self.root_at = carry.point(self.root_at);
  self.lost_child = carry.point(self.lost_child);
  for (Task& task : self.known_tasks()) task.target = carry.point(task.target);
  if (++self.turn == 0) self.turn = 1U << 15;  // what belongs to the first rounds does not come again
  carry_detour(self.detour, carry);
}

void begin_tick(HealingRobot& robot, const Inputs<Heard>& inputs) noexcept {
  carry_memory(robot.self, robot.carry);
  auto& kept = robot.self.healing_standings;
  file_heard(robot);
  const KnownOfHealing known(robot.self, robot.elapsed_ticks);
  for (Heard& h : robot.heard) {
    push_news(robot, known, h);
    if (h.place >= 0) {
      kept[static_cast<std::size_t>(h.place)] = static_cast<const HealingStanding&>(said(h));
      if (!names_another(robot, h)) note_hears(robot, h);
    }
  }
  forget_silent(
      robot, [&](int k) { return may_be_tied(robot, k); }, [&](int k, int size) { close_gap(kept, k, size); });
  follow_orders(robot, inputs.orders());
}

int write_healing(const HealingRobot& robot, HealingMessage& m) noexcept {
  write_tree(robot, m);
  m.serves = robot.self.serves;
  m.root_size = robot.self.root_size;
  m.count = name_next(robot);
  set_burst(m, robot.self.burst_ticks);
  return gossip(robot, m);
}

Report healing_report(const HealingState& s) noexcept {
  Report report = tree_report(s);
  report.serves = s.is_worker ? s.serves : nobody;
  return report;
}

void add_to(Digest& digest, const HealingState& state) noexcept {
  add_to(digest, static_cast<const TreeState&>(state));
  const auto add = [&](const auto& field) { digest.add(field); };
  visit_healing_state(add, state);
}

void add_to(Digest& digest, const HealingMessage& message) noexcept {
  FieldDigest visit{digest};
  visit_fields(visit, message);
}

}  // namespace banyan
