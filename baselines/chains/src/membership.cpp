// SPDX-License-Identifier: MIT
// Who is in which chain, and between whom. A robot knows of its chain what its parent and its child say: the ids of
// some robots beyond them, so that one that falls silent can be passed over.
#include "banyan/controller/core/fixed_point.hpp"
#include "rooms.hpp"

namespace banyan::baselines::chains {
namespace {

Ids with_first(RobotId first, const Ids& rest) noexcept {
  Ids ids{first};
  std::copy(rest.begin(), rest.end() - 1, ids.begin() + 1);
  return ids;
}

bool is_base(const Message& m) noexcept { return m.root == m.id; }
bool is_worker(const Message& m) noexcept { return m.worker == m.id; }
bool names_as_parent(const Message& m, RobotId id) noexcept {
  return m.worker != nobody && (is_worker(m) ? lists(m.above, id) : m.above[0] == id);
}
Ids list_above(const Message& m) noexcept { return with_first(m.id, is_base(m) ? no_ids() : m.above); }

void leave(State& self) noexcept {
  self.worker = self.child = nobody;
  self.chains = {};
  self.below = no_ids();
  self.links = 0;
  self.beyond = self.path = 0.0F;
  self.whole = self.gap.known = self.child_place.known = false;
  self.linked = false;
  self.astray_ticks = self.gap_ticks = 0;
}

void follow_child(Robot& robot, int k) noexcept {
  State& self = robot.self;
  const Message& m = robot.table().message(k);
  self.child = m.id;
  self.child_place.put(robot.table().position(k));
  self.below = with_first(m.id, is_worker(m) ? no_ids() : m.below);
  self.links = static_cast<std::uint8_t>(std::min(m.links + 1, 255));
  self.beyond = robot.table().range(k) + from_fixed(m.beyond);
  self.path = from_fixed(m.path);
  self.whole = m.whole;
  self.gap.known = false;
}

bool is_within(const Robot& robot, int k, float reach) noexcept { return k >= 0 && robot.table().range(k) < reach; }

// A free robot joins whoever asks it to, between that robot and its parent.
void answer(Robot& robot) noexcept {
  State& self = robot.self;
  for (int k = 0; k < robot.table().size(); ++k) {
    const Message& m = robot.table().message(k);
    if (m.asks != self.id || m.worker == nobody || robot.table().age(k) > 0) continue;
    self.worker = m.worker;
    self.number = m.chain;
    follow_child(robot, k);
    for (const RobotId id : {m.above[is_worker(m) ? m.chain % listed : 0], self.root})
      if (self.chains[0].parent == nobody && is_within(robot, robot.find_fresh(id), robot.params.longest_link))
        self.chains[0].parent = id;
    ++self.tally.insertions;
    return;
  }
}

// To the next gap, one link nearer to the worker.
void move_up(State& self, Vec2 place) noexcept {
  self.gap.put(place);
  self.links = static_cast<std::uint8_t>(std::max(self.links - 1, 0));
  self.gap_ticks = 0;
}

// The child fell silent: its place is where it was, or where it was going to. What was beyond it is straight on.
void close_up(Robot& robot) noexcept {
  State& self = robot.self;
  const Vec2 there = self.child_place.at;
  const float beyond = std::max(self.beyond - norm(there), 0.0F);
  const float links = std::max(static_cast<float>(self.links) - 1.0F, 0.0F);
  const float child_missing = std::max(beyond - links * robot.params.safe_distance, 0.0F);
  self.outwards = unit(there) * (links > 0.0F ? (beyond - child_missing) / links : 0.0F);
  move_up(self, there + unit(there) * child_missing);
  self.child = nobody;
  self.whole = false;
}

// The robot of my chain that names me as its parent; if there are two, the one that leads to the worker.
int find_child(const Robot& robot) noexcept {
  const State& self = robot.self;
  int found = -1;
  for (int k = 0; k < robot.table().size(); ++k) {
    const Message& m = robot.table().message(k);
    const bool mine = m.worker == self.worker && (is_worker(m) || m.chain == self.number);
    if (!mine || !names_as_parent(m, self.id)) continue;
    const bool found_whole = found >= 0 && robot.table().message(found).whole;
    if (found < 0 || (m.whole && !found_whole) || (m.id == self.child && m.whole == found_whole)) found = k;
  }
  return found;
}

// Who has come to the place of a dead worker and finds nobody there takes over its target.
void take_over(Robot& robot) noexcept {
  State& self = robot.self;
  if (self.links > 0 || self.whole || norm(self.gap.at) > robot.params.arrival_distance) return;
  self.whole = true;
  ++self.tally.replacements;
}

void watch_child(Robot& robot) noexcept {
  State& self = robot.self;
  if (const int k = find_child(robot); k >= 0) {
    follow_child(robot, k);
    self.linked = true;
  } else if (self.child != nobody && robot.table().find(self.child) < 0) {
    if (!self.linked) return leave(self);
    close_up(robot);
  }
  if (!self.gap.known) return;
  // One of those that were beyond the child may be in sight by now.
  for (const RobotId id : self.below)
    if (const int k = robot.find_fresh(id); k >= 0 && robot.table().message(k).worker == self.worker) {
      self.gap.put(robot.table().position(k));
      break;
    }
  self.beyond = norm(self.gap.at) + static_cast<float>(self.links) * robot.params.safe_distance;
  take_over(robot);
}

// Whether the sender of m can be my parent in chain `number`.
bool leads_to_base(const State& self, const Message& m, std::uint8_t number) noexcept {
  if (m.id == self.child || m.id == self.id || lists(m.above, self.id)) return false;
  return is_base(m) || (m.worker == self.worker && !is_worker(m) && m.chain == number);
}

void watch_parent(const Robot& robot, Chain& chain) noexcept {
  State& self = robot.self;
  const std::uint8_t number = robot.number_of(chain);
  const Message* m = robot.said_by(chain.parent);
  if (m == nullptr || !leads_to_base(self, *m, number)) {
    const bool had = chain.parent != nobody || chain.above[0] != nobody;
    chain.parent = nobody;
    const auto adopt = [&](RobotId id) {
      const int k = robot.find_fresh(id);
      if (chain.parent != nobody || !is_within(robot, k, robot.params.safe_distance)) return;
      if (!leads_to_base(self, robot.table().message(k), number)) return;
      chain.parent = id;
      if (had) ++self.tally.repairs;
    };
    for (const RobotId id : chain.above) adopt(id);
    adopt(self.root);
    m = robot.said_by(chain.parent);
  }
  if (m != nullptr) chain.above = list_above(*m);
}

// Another parent than me leads the sender of m, which is of my chain, to the base.
bool is_led_by_another(const State& self, const Message& m) noexcept {
  const RobotId parent = m.above[is_worker(m) ? self.number % listed : 0];
  return m.worker == self.worker && parent != nobody && parent != self.id;
}

// A relay is of no use if those beyond it have another parent, its parent another child, or if it has become the base.
bool is_astray(const Robot& robot) noexcept {
  const State& self = robot.self;
  for (const RobotId id : self.below)
    if (const Message* m = robot.said_by(id); m != nullptr && self.gap.known && is_led_by_another(self, *m))
      return true;
  const Message* child = robot.said_by(self.child);
  if (self.is_base() || (child != nullptr && !names_as_parent(*child, self.id) && child->asks != self.id)) return true;
  const Message* parent = robot.said_by(self.chains[0].parent);
  return parent != nullptr && !is_base(*parent) && parent->below[0] != self.id && !self.whole;
}

void count(std::uint16_t& ticks, bool counts, const Robot& robot) noexcept {
  ticks = static_cast<std::uint16_t>(counts ? std::min(ticks + robot.elapsed_ticks, 0xFFFF) : 0);
}

// Leaves if it has been astray for long. Where the rest of its worker's only chain has not come back to a gap, it goes
// on to find it; where there are others the rest need not come back.
void watch_use(Robot& robot) noexcept {
  State& self = robot.self;
  count(self.astray_ticks, is_astray(robot), robot);
  count(self.gap_ticks, self.gap.known && !self.whole, robot);
  if (self.astray_ticks > whole(robot.params.request_rounds)) return leave(self);
  if (self.gap_ticks <= robot.params.rounds(robot.params.gap_patience_drives)) return;
  const bool goes_on = robot.params.chains() == 1 && self.links > 0;
  if (!goes_on || norm(self.gap.at) > robot.params.arrival_distance) return leave(self);
  move_up(self, self.gap.at + self.outwards);
}

}  // namespace

void follow_chain(Robot& robot, RobotId given_up) noexcept {
  State& self = robot.self;
  if (given_up != nobody && given_up == self.worker) leave(self);
  const bool sent = self.assignment.sent;
  if (sent != self.is_worker()) leave(self);
  if (sent) {
    self.worker = self.id;
    self.whole = true;
    self.beyond = self.assignment.away();
    self.path = self.assignment.known && self.base.known ? distance(self.assignment.target, self.base.at) : 0.0F;
  } else if (self.is_free()) {
    if (!self.is_base()) answer(robot);
  } else {
    watch_child(robot);
    watch_use(robot);
  }
  if (self.is_free()) return;  // it may have left
  bool lost = false;
  for (Chain& chain : robot.chains()) {
    watch_parent(robot, chain);
    lost = lost || chain.parent == nobody;
  }
  if (sent) count(self.gap_ticks, lost, robot);
}

}  // namespace banyan::baselines::chains
