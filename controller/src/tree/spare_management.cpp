// SPDX-License-Identifier: MIT
#include "tree/spare_management.hpp"

#include <algorithm>
#include <limits>

#include "banyan/controller/core/search.hpp"
#include "tree/label.hpp"
#include "tree/parent_selection.hpp"

namespace banyan {
namespace {

constexpr int answer_ticks = 14;  // enough for a question and an answer at five ticks of latency

// Longer where packets are lost.
int ungranted_limit_ticks(const TreeRobot& robot) noexcept { return std::max(answer_ticks, robot.loss_ticks); }

constexpr std::uint8_t call_reach_hops = 250;  // so far a call is passed on

// ---- The owner of an edge: NO NEED -> NEED -> AWAIT ----

void end_grant(TreeState& self) noexcept {
  self.grant = nobody;
  self.need = Need::no_need;
}

// Ends the grant when the spare has arrived, has given up, or has fallen silent.
void follow_grant(TreeRobot& robot) noexcept {
  TreeState& self = robot.self;
  const int k = robot.table().find(self.grant);
  robot.add_elapsed(self.grant_ticks);
  if (k < 0 || !robot.table().alive(k)) return end_grant(self);
  const TreeStanding& m = robot.table().message(k);
  if (m.inserted_child == self.id && m.parent != nobody && m.parent != self.id && is_ahead(robot, k)) {
    take_parent(robot, k);
    return end_grant(self);
  }
  const bool gone =
      self.grant_ticks > ungranted_limit_ticks(robot) && m.request != self.id && m.inserted_child != self.id;
  const bool timeout =
      self.grant_ticks > robot.params.rounds(robot.params.insertion_drives) + ungranted_limit_ticks(robot);
  if (gone || timeout) end_grant(self);
}

// Of the spares that ask for my edge, the one nearest to its midpoint.
RobotId best_request(const TreeRobot& robot) noexcept {
  const TreeTable& table = robot.table();
  const Vec2 midpoint = table.position(robot.parent) * 0.5F;
  const int best = least_of(table.size(), not_counted, [&](int k) {
    const TreeStanding& m = table.message(k);
    const bool asks = m.request == robot.self.id && table.alive(k) && m.role == Role::spare;
    return asks ? distance(table.position(k), midpoint) : not_counted;
  });
  return best < 0 ? nobody : table.id(best);
}

void own_edge(TreeRobot& robot, const EdgeRule& rule) noexcept {
  TreeState& self = robot.self;
  if (self.grant != nobody) follow_grant(robot);
  if (!robot.parent_alive()) return end_grant(self);
  switch (self.need) {
    case Need::no_need:
      if (rule.needs_spare()) self.need = Need::need;
      break;
    case Need::need:
      if (!rule.needs_spare()) self.need = Need::no_need;
      else if (self.phase == Phase::grow_tree) {
        self.grant = best_request(robot);
        self.grant_ticks = 0;
        if (self.grant != nobody) self.need = Need::await;
      }
      break;
    case Need::await:
      if (self.grant == nobody) self.need = Need::no_need;
      break;
  }
}

// ---- The spare: WAIT -> EXTEND EDGE -> connector, or ADJUST POSITION ----

bool in_need(const TreeStanding& m, const TreeState& self) noexcept {
  return m.need == Need::need && m.role != Role::spare && m.grant == nobody && m.parent != nobody &&
         m.parent != self.id && m.epoch == self.epoch;
}

// The middle of the edge between entry k and its parent; false if that one is not heard.
bool midpoint_above(const TreeTable& table, int k, Vec2& midpoint) noexcept {
  const int parent = table.find(table.message(k).parent);
  if (parent < 0 || !table.alive(parent)) return false;
  midpoint = (table.position(k) + table.position(parent)) * 0.5F;
  return true;
}

// The owner in need whose midpoint is nearest; both ends must be heard.
RobotId nearest_edge_in_need(const TreeRobot& robot) noexcept {
  const TreeTable& table = robot.table();
  const int best = least_of(table.members, not_counted, [&](int k) {
    Vec2 midpoint;
    const bool open = in_need(table.message(k), robot.self) && table.alive(k) && midpoint_above(table, k, midpoint);
    return open ? norm(midpoint) : not_counted;
  });
  return best < 0 ? nobody : table.id(best);
}

// The neighbour through which an unanswered need is nearest.
RobotId nearest_caller(const TreeRobot& robot) noexcept {
  const TreeTable& table = robot.table();
  const int best = least_of(table.size(), not_counted, [&](int k) {
    return table.alive(k) && table.message(k).call_hops == robot.call_hops ? table.range(k) : not_counted;
  });
  return best < 0 ? nobody : table.id(best);
}

// A spare that stands still may be far from where it is needed. Needs that no spare answers spread hop by hop, and
// spares without an edge in sight follow the gradient. True while a call is live: once it is over, the hops that robots
// tell each other count up, which is no gradient to follow.
bool spread_call(TreeRobot& robot, const EdgeRule& rule) noexcept {
  TreeState& self = robot.self;
  const bool steady = robot.call_hops < self.call_hops;
  const bool unserved = self.role != Role::spare && self.need == Need::need && self.phase == Phase::grow_tree;
  rule.count_waiting(unserved);
  const auto in_vain = [&] {
    return self.unserved_ticks > 0 && self.unserved_ticks > whole(robot.params.call_after_rounds);
  };
  if (in_vain() && rule.may_call()) self.call_hops = 0;
  else
    self.call_hops = robot.call_hops < call_reach_hops ? static_cast<std::uint8_t>(robot.call_hops + 1) : nobody_calls;
  return steady;
}

void give_up(TreeState& self) noexcept {
  self.request = nobody;
  self.spare_state = SpareState::wait;
}

void join_edge(TreeRobot& robot, int owner) noexcept {
  TreeState& self = robot.self;
  const TreeTable& table = robot.table();
  const int parent = table.find(table.message(owner).parent);
  if (!is_ahead(robot, parent)) return;  // its sequence number will overtake mine
  const TreeStanding& above = table.message(parent);
  auto label = static_cast<std::uint16_t>((std::uint32_t{table.message(owner).label} + above.label) / 2);
  if (label <= above.label) label = label_below(above.label, 0.0F);
  self.label = is_newer(above.seqno, self.seqno) ? label : std::min(label, self.label);  // never fall back (is_ahead)
  self.seqno = above.seqno;
  self.seqno_ticks = 0;
  take_parent(robot, parent);
  self.inserted_child = self.request;
  self.inserted_ticks = 0;
  self.role = Role::connector;
  self.childless_ticks = 0;
  give_up(self);
  ++self.tally.insertions;
}

// EXTEND EDGE once granted; before that the request waits for an answer.
void follow_request(TreeRobot& robot, const EdgeRule& rule) noexcept {
  TreeState& self = robot.self;
  const TreeTable& table = robot.table();
  const int owner = table.find(self.request);
  Vec2 midpoint;
  if (owner < 0 || !table.alive(owner) || !edge_midpoint(robot, self.request, midpoint)) return give_up(self);
  robot.add_elapsed(self.request_ticks);
  if (self.request_ticks > robot.params.rounds(robot.params.insertion_drives)) return give_up(self);
  const TreeStanding& m = table.message(owner);
  const bool granted = m.grant == self.id;
  self.ungranted_ticks = granted ? std::uint16_t{0} : static_cast<std::uint16_t>(self.ungranted_ticks + 1);
  if (self.ungranted_ticks > ungranted_limit_ticks(robot) || (m.grant != nobody && !granted)) return give_up(self);
  if (granted) self.spare_state = SpareState::extend_edge;
  if (granted && rule.may_insert(owner, table.find(m.parent))) join_edge(robot, owner);
}

void look_for_edge(TreeRobot& robot, bool call) noexcept {
  TreeState& self = robot.self;
  self.reference = robot.hold < 0 ? nobody : nearest_reference(robot);
  self.request = self.phase == Phase::grow_tree ? nearest_edge_in_need(robot) : nobody;
  self.called = call && self.request == nobody && self.phase == Phase::grow_tree && robot.call_hops < call_reach_hops;
  if (self.called) self.reference = nearest_caller(robot);
  self.request_ticks = self.ungranted_ticks = 0;
  self.spare_state = self.request != nobody ? SpareState::wait : SpareState::adjust_position;
}

void watch_inserted_child(TreeRobot& robot) noexcept {
  TreeState& self = robot.self;
  const int k = robot.table().find(self.inserted_child);
  const bool done = k >= 0 && robot.table().message(k).parent == self.id;
  if (!done) robot.add_elapsed(self.inserted_ticks);
  if (done || self.inserted_ticks > robot.patience_ticks()) self.inserted_child = nobody;
}

}  // namespace

RobotId nearest_reference(const TreeRobot& robot) noexcept {
  const TreeTable& table = robot.table();
  int best = -1;
  // In half hops: among free spares, any but the present reference counts half a hop more.
  int best_hops = std::numeric_limits<int>::max();
  float best_length = 0.0F;
  for (const Rows* const rows : {&table.members, &table.nearest, &table.all()}) {
    if (best >= 0) break;
    rows->for_each([&](int k) {
      const TreeStanding& m = table.message(k);
      const int hops = m.role != Role::spare ? -1 : 2 * m.tree_hops + (table.id(k) != robot.self.reference ? 1 : 0);
      if (hops > best_hops || (hops == best_hops && table.range(k) >= best_length) || !table.alive(k)) return;
      best = k;
      best_hops = hops;
      best_length = table.range(k);
    });
  }
  return best < 0 ? nobody : table.id(best);
}

bool is_stretched(const TreeRobot& robot) noexcept {
  const TreeState& self = robot.self;
  return robot.parent >= 0 && robot.table().range(robot.parent) > robot.params.recruitment_distance && self.want > 0.0F;
}

bool child_in_need(const TreeRobot& robot) noexcept {
  return banyan::any_of(robot.children, [&](int k) {
    const TreeStanding& m = robot.table().message(k);
    return m.role != Role::spare && m.need == Need::need;
  });
}

bool edge_midpoint(const TreeRobot& robot, RobotId owner, Vec2& midpoint) noexcept {
  const int k = robot.table().find(owner);
  return k >= 0 && midpoint_above(robot.table(), k, midpoint);
}

void count_unserved(TreeRobot& robot, bool unserved) noexcept {
  if (!unserved) robot.self.unserved_ticks = 0;
  else robot.add_elapsed(robot.self.unserved_ticks);
}

void manage_spares(TreeRobot& robot, const EdgeRule& rule) noexcept {
  TreeState& self = robot.self;
  const bool call = spread_call(robot, rule);
  self.called = false;  // look_for_edge() decides again
  if (self.inserted_child != nobody) watch_inserted_child(robot);
  if (self.role != Role::spare) {
    self.request = nobody;
    if (self.parent != nobody) own_edge(robot, rule);
    else end_grant(self);
    return;
  }
  end_grant(self);
  if (self.parent != nobody || robot.children.size > 0) give_up(self);  // still part of a branch
  else if (self.request != nobody) follow_request(robot, rule);
  else look_for_edge(robot, call);
}

}  // namespace banyan
