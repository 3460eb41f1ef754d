// SPDX-License-Identifier: MIT
// "The state machine diagram in Fig. 5 describes the part of the GROW TREE state that concerns the interaction between
// spare robots and non-spare robots" (paper Sec. III-F)
//
// An edge belongs to its child end, its owner, which lets in one spare at a time (row y).
#include "banyan/controller/paper/rules.hpp"

namespace banyan::paper {
namespace {

constexpr float insertion_drives = 2.5F;  // EXTEND EDGE gives up after this
constexpr int answer_ticks = 14;          // enough for a question and an answer at five ticks of latency

// ---- Non-spare robots: NO NEED -> NEED -> AWAIT ----

// "either if their distance to their parent becomes smaller than the safe communication range S, or if at least one of
// their children's state is the NEED state": smaller than S is a misprint for larger than E (row 2).
bool needs_spare(const Robot& robot) noexcept {
  const float E = robot.params.recruitment_distance;
  const bool wanted = !robot.reading.asks_while_wanted || robot.self.want > 0;
  return (wanted && robot.range(robot.parent) > E) || robot.any([&](int k) {
    return robot.is_child(k) && robot.said(k).role != Role::spare && robot.said(k).need == Need::need;
  });
}

void end_grant(State& self) noexcept {
  self.grant = nobody;
  self.need = Need::no_need;
}

// Ends the grant when the spare has arrived, has given up, or has fallen silent.
void follow_grant(Robot& robot) noexcept {
  State& self = robot.self;
  const int k = robot.find(self.grant);
  robot.add_elapsed(self.grant_ticks);
  if (!robot.alive(k)) return end_grant(self);
  const Message& m = robot.said(k);
  const bool asks = m.request == self.id;
  if (asks && m.role != Role::spare && m.parent != nobody && m.parent != self.id && is_ahead(robot, k)) {
    take_parent(robot, k);
    return end_grant(self);
  }
  const int limit_ticks = asks ? robot.params.rounds(insertion_drives) + answer_ticks : answer_ticks;
  if (self.grant_ticks > limit_ticks) end_grant(self);
}

// "accepted to join an edge": of the spares that ask for mine the one nearest to its midpoint.
RobotId best_request(const Robot& robot) noexcept {
  const Vec2 midpoint = robot.position(robot.parent) * 0.5F;
  return robot.id(robot.least([&](int k) {
    const bool asks = robot.alive(k) && robot.said(k).role == Role::spare && robot.said(k).request == robot.self.id;
    return asks ? distance(robot.position(k), midpoint) : not_counted;
  }));
}

// "In the NEED state, each robot continuously checks if it is in an edge selected by a spare robot, or if their parent
// is in the AWAIT state. If one of these conditions is fulfilled, the robot transitions to the AWAIT state."
void own_edge(Robot& robot) noexcept {
  State& self = robot.self;
  if (self.grant != nobody) follow_grant(robot);
  if (!robot.alive(robot.parent)) return end_grant(self);
  const Message& parent = robot.said(robot.parent);
  // Of its own edge: else all branches would wait for each other at the root (row c).
  const bool parent_awaits = parent.need == Need::await && parent.grant != nobody;
  switch (self.need) {
    case Need::no_need:
      if (needs_spare(robot)) self.need = Need::need;
      return;
    case Need::need:
      if (parent_awaits) self.need = Need::await;
      else if (!needs_spare(robot)) self.need = Need::no_need;
      else if (self.phase == Phase::grow_tree) {
        self.grant = best_request(robot);
        self.grant_ticks = 0;
        if (self.grant != nobody) self.need = Need::await;
      }
      return;
    case Need::await:
      if (self.grant == nobody && !parent_awaits) self.need = Need::no_need;
      return;
  }
}

// Until the owner names it as parent, a robot that has joined keeps its request.
void watch_owner(Robot& robot) noexcept {
  constexpr int patience_ticks = 30;
  State& self = robot.self;
  if (self.request == nobody) return;
  const int owner = robot.find(self.request);
  const bool named = owner >= 0 && robot.said(owner).parent == self.id;
  if (!named) robot.add_elapsed(self.request_ticks);
  if (named || self.request_ticks > patience_ticks) self.request = nobody;
}

// ---- Spare robots: WAIT -> EXTEND EDGE -> connector, or ADJUST POSITION ----

// "look for an edge to extend [...] a search for edges in need among their neighbors": the owner of that whose midpoint
// is nearest; both ends must be heard.
RobotId nearest_edge_in_need(const Robot& robot) noexcept {
  return robot.id(robot.least([&](int k) {
    const Message& m = robot.said(k);
    const bool open = robot.alive(k) && m.need == Need::need && m.role != Role::spare && m.grant == nobody &&
                      m.parent != nobody && m.parent != robot.self.id && m.epoch == robot.self.epoch;
    Vec2 midpoint;
    return open && edge_midpoint(robot, k, midpoint) ? norm(midpoint) : not_counted;
  }));
}

// "select a robot to use as reference": the nearest of the tree, else the spare through which the tree is nearest. Of
// spares it keeps the present one, as if others were half a hop farther: one that turns to another each tick gets
// nowhere.
RobotId nearest_reference(const Robot& robot) noexcept {
  constexpr std::pair none(2 * unreachable + 2, 0.0F);
  return robot.id(robot.least(none, [&](int k) {
    const Message& m = robot.said(k);
    const int half_hops = 2 * m.tree_hops + (m.id != robot.self.reference ? 1 : 0);
    return robot.alive(k) ? std::pair(m.role != Role::spare ? -1 : half_hops, robot.range(k)) : none;
  }));
}

// "They transition to the EXTEND EDGE state or the ADJUST POSITION state after performing a search for edges in need"
void look_for_edge(Robot& robot) noexcept {
  State& self = robot.self;
  self.reference = robot.reading.keeps_links && robot.hold < 0 ? nobody : nearest_reference(robot);
  self.request = self.phase == Phase::grow_tree ? nearest_edge_in_need(robot) : nobody;
  if (self.request == nobody && robot.caller >= 0) self.reference = robot.id(robot.caller);
  self.request_ticks = self.ungranted_ticks = 0;
  self.spare_state = self.request != nobody ? SpareState::wait : SpareState::adjust_position;
}

void give_up(State& self) noexcept {
  self.request = nobody;
  self.spare_state = SpareState::wait;
}

// Its label is the mean of both ends, so that it takes its place between them in the order of the tree.
void join_edge(Robot& robot, int owner, int parent) noexcept {
  State& self = robot.self;
  if (!is_ahead(robot, parent)) return;  // its sequence number will overtake mine
  const Message& above = robot.said(parent);
  auto label = static_cast<std::uint16_t>((std::uint32_t{robot.said(owner).label} + above.label) / 2);
  if (label <= above.label) label = label_below(above.label, 0.0F);
  self.label = is_newer(above.seqno, self.seqno) ? label : std::min(label, self.label);  // never fall back (is_ahead)
  self.seqno = above.seqno;
  take_parent(robot, parent);
  self.role = Role::connector;
  self.spare_state = SpareState::wait;
  self.request_ticks = self.childless_ticks = 0;
  ++self.tally.insertions;
}

// "In the EXTEND EDGE state, spare robots head for the middle of the edge to be extended", once its owner grants it,
// and switch to connector within J of it.
void extend_edge(Robot& robot) noexcept {
  State& self = robot.self;
  const int owner = robot.find(self.request);
  Vec2 midpoint;
  if (!robot.alive(owner) || !edge_midpoint(robot, owner, midpoint)) return give_up(self);
  const Message& m = robot.said(owner);
  const bool granted = m.grant == self.id;
  robot.add_elapsed(self.request_ticks);
  self.ungranted_ticks = granted ? std::uint16_t{0} : advanced(self.ungranted_ticks);
  if (self.request_ticks > robot.params.rounds(insertion_drives) || self.ungranted_ticks > answer_ticks ||
      (m.grant != nobody && !granted))
    return give_up(self);
  if (!granted) return;
  self.spare_state = SpareState::extend_edge;
  if (norm(midpoint) <= robot.params.insertion_distance) join_edge(robot, owner, robot.find(m.parent));
}

}  // namespace

bool edge_midpoint(const Robot& robot, int owner, Vec2& midpoint) noexcept {
  const int parent = owner < 0 ? -1 : robot.find(robot.said(owner).parent);
  if (!robot.alive(parent)) return false;
  midpoint = (robot.position(owner) + robot.position(parent)) * 0.5F;
  return true;
}

void manage_spares(Robot& robot) noexcept {
  State& self = robot.self;
  if (self.role != Role::spare) {
    watch_owner(robot);
    if (self.parent != nobody) own_edge(robot);
    else end_grant(self);
    return;
  }
  end_grant(self);
  if (self.parent != nobody || robot.has_child()) give_up(self);  // still part of a branch
  else if (self.request != nobody) extend_edge(robot);
  else look_for_edge(robot);
}

}  // namespace banyan::paper
