// SPDX-License-Identifier: MIT
// A link is kept by both its ends. It ends when one of them falls silent, no longer names it, or finds that it closes
// a loop.
#include "rooms.hpp"

namespace banyan::baselines::branches {
namespace {

constexpr int steadiness_ticks = 4;  // another link leads to the root only if its news are newer by more than this

// Who has lost its way to the root goes to where that was; who has lost a connector beyond it waits for those who come.
void lose(Robot& robot, const Link& link) noexcept {
  State& self = robot.self;
  if (robot.said_by(link.to) == nullptr && (link.to == self.parent || link.connector)) {
    self.lost = link.to;
    self.lost_root = link.to == self.parent ? self.root : nobody;
    self.lost_at = link.at;
    self.lost_ticks = 0;
  }
  if (self.parent == link.to) self.parent = nobody;
  self.links.remove(link.to);
}

void remember_places(Robot& robot, const Carry& carry) noexcept {
  State& self = robot.self;
  self.lost_at = carry.point(self.lost_at);
  for (std::size_t i = 0; i < self.links.size(); ++i) {
    Link& link = self.links[i];
    const int k = robot.table().find(link.to);
    link.at = k >= 0 ? robot.table().position(k) : carry.point(link.at);
    if (k >= 0) link.connector = robot.table().message(k).connector;
  }
}

bool is_named(const Robot& robot, RobotId id) noexcept {
  for (int k = 0; k < robot.table().size(); ++k)
    if (lists(robot.table().message(k).links, id)) return true;
  return false;
}

// It is back, or was only hidden, or the way to the root leads elsewhere, or nobody is there.
void forget_lost(Robot& robot) noexcept {
  State& self = robot.self;
  if (self.lost == nobody) return;
  self.lost_ticks = robot.counted(self.lost_ticks);
  const bool rejoined = self.is_joined() && self.root == self.lost_root;
  // For all who were linked with it.
  const bool gone = self.lost_ticks > whole(robot.params.liveness_rounds);
  const bool lives = robot.said_by(self.lost) != nullptr || (gone && is_named(robot, self.lost));
  const bool there = norm(self.lost_at) < robot.params.arrival_distance;
  const bool waited =
      !self.has_lost_parent() && self.lost_ticks > robot.params.rounds(robot.params.join_patience_drives);
  if (rejoined || lives || there || waited) self.forget();
}

bool is_mine_to_watch(const State& self, RobotId id) noexcept {
  return id != self.held_other && !(self.change.stage == offered && id == self.change.joins);
}

// Whether the link has an end.
bool has_ended(const Robot& robot, Link& link) noexcept {
  const State& self = robot.self;
  const Message* m = robot.said_by(link.to);
  if (m == nullptr) return true;
  if (!is_mine_to_watch(self, link.to)) return false;
  const bool answered = lists(m->links, self.id);
  link.unanswered_ticks = answered ? std::uint16_t{0} : robot.counted(link.unanswered_ticks);
  const bool leads = link.to == self.parent || m->parent == self.id || !self.is_joined();
  link.loop_ticks = leads ? std::uint16_t{0} : robot.counted(link.loop_ticks);
  const int timeout = whole(robot.params.change_rounds);
  return link.unanswered_ticks > timeout || link.loop_ticks > 2 * timeout;
}

// How old the news of the root are over the link to `id`; news that come from here are none.
std::uint8_t age_over(const Robot& robot, RobotId id) noexcept {
  const int k = robot.table().find(id);
  if (k < 0) return unknown_age;
  const Message& m = robot.table().message(k);
  if (!lists(m.links, robot.self.id) || m.parent == robot.self.id) return unknown_age;
  return news_age(m.joined_age, robot.table(), k);
}

void find_parent(Robot& robot) noexcept {
  State& self = robot.self;
  if (self.is_root()) {
    self.parent = nobody;
    self.joined_age = 0;
    return;
  }
  RobotId best = self.links.has(self.parent) ? self.parent : nobody;
  int age = age_over(robot, best);
  for (std::size_t i = 0; i < self.links.size(); ++i) {
    const int other = age_over(robot, self.links[i].to);
    if (other + (best == nobody || age == unknown_age ? 0 : steadiness_ticks) >= age) continue;
    best = self.links[i].to;
    age = other;
  }
  self.parent = age == unknown_age ? nobody : best;
  self.joined_age = static_cast<std::uint8_t>(age);
}

}  // namespace

void watch_links(Robot& robot, const Carry& carry) noexcept {
  State& self = robot.self;
  remember_places(robot, carry);
  if (self.is_follower()) self.links.clear();
  for (std::size_t i = self.links.size(); i-- > 0;)
    if (has_ended(robot, self.links[i])) lose(robot, Link(self.links[i]));
  find_parent(robot);
  forget_lost(robot);
  self.cut_ticks = self.is_joined() ? std::uint16_t{0} : robot.counted(self.cut_ticks);
}

}  // namespace banyan::baselines::branches
