// SPDX-License-Identifier: MIT
// "The state machine diagram in Fig. 5 describes the part of the GROW TREE state that concerns the interaction between
// spare robots and non-spare robots" (paper Sec. III-F)
//
// An edge belongs to its child end, its owner, which lets in one spare at a time (row y).
#include "banyan/controller/core/search.hpp"
#include "banyan/controller/paper/corrections.hpp"

namespace banyan::paper {
namespace {

constexpr float insertion_drives = 2.5F;  // EXTEND EDGE gives up after this
constexpr int answer_ticks = 14;          // enough for a question and an answer at five ticks of latency

// ---- Non-spare robots: NO NEED -> NEED -> AWAIT ----

bool child_in_need(const Robot& robot) noexcept {
  return banyan::any_of(robot.children,
                        [&](int k) { return robot.said(k).role != Role::spare && robot.said(k).need == Need::need; });
}

void end_grant(State& self) noexcept {
  self.grant = nobody;
  self.need = Need::no_need;
}

// Ends the grant when the spare has arrived, has given up, or has fallen silent.
void follow_grant(Robot& robot) noexcept {
  State& self = robot.self;
  const int k = robot.table().find(self.grant);
  robot.add_elapsed(self.grant_ticks);
  if (!robot.alive(k)) return end_grant(self);
  const Message& m = robot.said(k);
  if (m.inserted_child == self.id && m.parent != nobody && m.parent != self.id && is_ahead(robot, k)) {
    take_parent(robot, k);
    return end_grant(self);
  }
  const bool gone = self.grant_ticks > answer_ticks && m.request != self.id && m.inserted_child != self.id;
  if (gone || self.grant_ticks > robot.params.rounds(insertion_drives) + answer_ticks) end_grant(self);
}

// Of the spares that ask for my edge the one nearest to its midpoint.
RobotId best_request(const Robot& robot) noexcept {
  const Vec2 midpoint = robot.position(robot.parent) * 0.5F;
  const int best = least_of(robot.neighbors(), not_counted, [&](int k) {
    const bool asks = robot.said(k).request == robot.self.id && robot.alive(k) && robot.said(k).role == Role::spare;
    return asks ? distance(robot.position(k), midpoint) : not_counted;
  });
  return best < 0 ? nobody : robot.table().id(best);
}

void own_edge(Robot& robot) noexcept {
  State& self = robot.self;
  if (self.grant != nobody) follow_grant(robot);
  if (!robot.alive(robot.parent)) return end_grant(self);
  const Message& parent = robot.said(robot.parent);
  // Of its own edge: else all branches would wait for each other at the root (row c).
  const bool parent_awaits = parent.need == Need::await && parent.grant != nobody;
  const bool needs_spare = robot.reading.is_stretched(robot) || child_in_need(robot);
  switch (self.need) {
    case Need::no_need:
      if (needs_spare) self.need = Need::need;
      break;
    case Need::need:
      if (parent_awaits) self.need = Need::await;
      else if (!needs_spare) self.need = Need::no_need;
      else if (self.phase == Phase::grow_tree) {
        self.grant = best_request(robot);
        self.grant_ticks = 0;
        if (self.grant != nobody) self.need = Need::await;
      }
      break;
    case Need::await:
      if (self.grant == nobody && !parent_awaits) self.need = Need::no_need;
      break;
  }
}

void watch_inserted_child(Robot& robot) noexcept {
  constexpr int patience_ticks = 30;
  State& self = robot.self;
  const int k = robot.table().find(self.inserted_child);
  const bool done = k >= 0 && robot.said(k).parent == self.id;
  if (!done) robot.add_elapsed(self.inserted_ticks);
  if (done || self.inserted_ticks > patience_ticks) self.inserted_child = nobody;
}

// ---- Spare robots: WAIT -> EXTEND EDGE -> connector, or ADJUST POSITION ----

// "look for an edge to extend [...] a search for edges in need among their neighbors": the owner of that whose midpoint
// is nearest; both ends must be heard.
RobotId nearest_edge_in_need(const Robot& robot) noexcept {
  const int best = least_of(robot.neighbors(), not_counted, [&](int k) {
    const Message& m = robot.said(k);
    const bool in_need = robot.alive(k) && m.need == Need::need && m.role != Role::spare && m.grant == nobody &&
                         m.parent != nobody && m.parent != robot.self.id && m.epoch == robot.self.epoch;
    Vec2 midpoint;
    return in_need && edge_midpoint(robot, robot.table().id(k), midpoint) ? norm(midpoint) : not_counted;
  });
  return best < 0 ? nobody : robot.table().id(best);
}

// The robot that a spare uses "as reference": the nearest of the tree, else the spare through which the tree is
// nearest. It keeps its present one while that is as good: a robot that turns to another every tick gets nowhere.
RobotId nearest_reference(const Robot& robot) noexcept {
  int best = -1;
  int best_hops = 0;  // in half hops: any spare but the present reference counts half a hop more
  for (int k = 0; k < robot.neighbors(); ++k) {
    const Message& m = robot.said(k);
    if (!robot.alive(k)) continue;
    const bool other = robot.table().id(k) != robot.self.reference;
    const int hops = m.role != Role::spare ? -1 : 2 * m.tree_hops + (other ? 1 : 0);
    if (best < 0 || hops < best_hops || (hops == best_hops && robot.range(k) < robot.range(best)))
      best = k, best_hops = hops;
  }
  return best < 0 ? nobody : robot.table().id(best);
}

void look_for_edge(Robot& robot) noexcept {
  State& self = robot.self;
  self.reference = robot.reading.keeps_links && robot.hold < 0 ? nobody : nearest_reference(robot);
  self.request = self.phase == Phase::grow_tree ? nearest_edge_in_need(robot) : nobody;
  if (self.request == nobody && robot.caller >= 0) self.reference = robot.table().id(robot.caller);
  self.request_ticks = self.ungranted_ticks = 0;
  self.spare_state = self.request != nobody ? SpareState::wait : SpareState::adjust_position;
}

void give_up(State& self) noexcept {
  self.request = nobody;
  self.spare_state = SpareState::wait;
}

// "Distance threshold to switch to connector" reached (Table I, J). Its label is the mean of both ends, so that it
// takes its place between them in the order of the tree.
void join_edge(Robot& robot, int owner, int parent) noexcept {
  State& self = robot.self;
  if (!is_ahead(robot, parent)) return;  // its sequence number will overtake mine
  const Message& above = robot.said(parent);
  auto label = static_cast<std::uint16_t>((std::uint32_t{robot.said(owner).label} + above.label) / 2);
  if (label <= above.label) label = label_below(above.label, 0.0F);
  self.label = is_newer(above.seqno, self.seqno) ? label : std::min(label, self.label);  // never fall back (is_ahead)
  self.seqno = above.seqno;
  take_parent(robot, parent);
  self.inserted_child = self.request;
  self.inserted_ticks = 0;
  self.role = Role::connector;
  self.childless_ticks = 0;
  give_up(self);
  ++self.tally.insertions;
}

// "In the EXTEND EDGE state, spare robots head for the middle of the edge to be extended", once its owner grants it.
void extend_edge(Robot& robot) noexcept {
  State& self = robot.self;
  const int owner = robot.table().find(self.request);
  Vec2 midpoint;
  if (!robot.alive(owner) || !edge_midpoint(robot, self.request, midpoint)) return give_up(self);
  robot.add_elapsed(self.request_ticks);
  const Message& m = robot.said(owner);
  const bool granted = m.grant == self.id;
  self.ungranted_ticks = granted ? std::uint16_t{0} : static_cast<std::uint16_t>(self.ungranted_ticks + 1);
  if (self.request_ticks > robot.params.rounds(insertion_drives) || self.ungranted_ticks > answer_ticks ||
      (m.grant != nobody && !granted))
    return give_up(self);
  if (!granted) return;
  self.spare_state = SpareState::extend_edge;
  if (norm(midpoint) <= robot.params.insertion_distance) join_edge(robot, owner, robot.table().find(m.parent));
}

}  // namespace

// "if their distance to their parent becomes smaller than the safe communication range S": a misprint (row 2).
bool is_stretched(const Robot& robot) noexcept {
  return robot.parent >= 0 && robot.range(robot.parent) > robot.params.recruitment_distance;
}

bool edge_midpoint(const Robot& robot, RobotId owner, Vec2& midpoint) noexcept {
  const int k = robot.table().find(owner);
  const int parent = k < 0 ? -1 : robot.table().find(robot.said(k).parent);
  if (!robot.alive(parent)) return false;
  midpoint = (robot.position(k) + robot.position(parent)) * 0.5F;
  return true;
}

void manage_spares(Robot& robot) noexcept {
  State& self = robot.self;
  if (self.inserted_child != nobody) watch_inserted_child(robot);
  if (self.role != Role::spare) {
    self.request = nobody;
    if (self.parent != nobody) own_edge(robot);
    else end_grant(self);
    return;
  }
  end_grant(self);
  if (self.parent != nobody || robot.children.size > 0) give_up(self);  // still part of a branch
  else if (self.request != nobody) extend_edge(robot);
  else look_for_edge(robot);
}

}  // namespace banyan::paper
