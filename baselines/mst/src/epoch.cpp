// SPDX-License-Identifier: MIT
// When a tree is built: triggered, as in Aragues et al. 2014, by an edge that gets long, besides by one that is lost.
// The call spreads with a countdown, so that all measure their links at the same moment: two ends of a link that
// disagree about its length may choose edges that close a cycle.
#include <algorithm>

#include "rooms.hpp"

namespace banyan::baselines::mst {
namespace {

// Neighbour k is in another complete tree with the same number as mine: two networks have met, or the tree was
// complete before I came.
bool is_stranger(const Robot& robot, int k) noexcept {
  const State& self = robot.self;
  const Message& m = robot.table().message(k);
  return m.done && m.epoch == self.epoch && m.fragment != self.fragment && may_be_edge(robot, k);
}

bool meets_strangers(const Robot& robot) noexcept {
  for (int k = 0; k < robot.table().size(); ++k)
    if (is_stranger(robot, k)) return true;
  return false;
}

bool wants_new_tree(const Robot& robot) noexcept {
  const State& self = robot.self;
  if (self.epoch_ticks < whole(robot.params.least_period_rounds)) return false;
  if (meets_strangers(robot)) return true;
  if (!self.done) return self.failed || self.epoch_ticks > whole(robot.params.build_rounds);
  if (self.root == self.id && self.assignment.sent) return true;  // a worker is no root
  return std::any_of(self.tree.begin(), self.tree.end(), [&](RobotId end) {
    const int k = robot.table().find(end);
    return k < 0 || robot.table().range(k) > robot.params.trigger_distance;
  });
}

// A tree that is wanted, and in how many ticks its construction begins.
struct Call {
  Serial next;
  int ticks;
};

// What neighbour k says of it. If a tree with a number ahead of mine is complete without me, two networks have met that
// have built different numbers of trees: the next tree is one for both.
Call called_by(const Robot& robot, int k) noexcept {
  const Message& m = robot.table().message(k);
  if (m.next != m.epoch) return {m.next, m.countdown - 1};
  if (!m.done || !is_newer(m.epoch, robot.self.epoch)) return {m.epoch, 0};
  if (!may_be_edge(robot, k)) return {robot.self.next, robot.self.countdown};  // too far to be one network
  return {advanced(m.epoch), whole(robot.params.countdown_rounds)};
}

}  // namespace

void follow_epoch(Robot& robot) noexcept {
  State& self = robot.self;
  self.epoch_ticks = static_cast<std::uint16_t>(std::min(self.epoch_ticks + robot.elapsed_ticks, 0xFFFF));
  const auto count_down = [&](int ticks) { self.countdown = static_cast<std::uint8_t>(std::clamp(ticks, 0, 255)); };
  const bool counted = is_newer(self.next, self.epoch);
  if (counted) count_down(self.countdown - robot.elapsed_ticks);
  for (int k = 0; k < robot.table().size(); ++k) {
    if (robot.table().age(k) > 0) continue;
    const Call call = called_by(robot, k);
    if (is_newer(call.next, self.next)) {
      self.next = call.next;
      count_down(call.ticks);
    } else if (call.next == self.next && is_newer(self.next, self.epoch)) {
      count_down(std::min<int>(self.countdown, call.ticks));
    }
  }
  if (!is_newer(self.next, self.epoch)) {
    if (!wants_new_tree(robot)) return;
    self.next = advanced(self.epoch);
    count_down(whole(robot.params.countdown_rounds));
  }
  if (self.countdown > 0) return;
  self.epoch = self.next;
  self.epoch_ticks = 0;
  begin_construction(robot);
}

}  // namespace banyan::baselines::mst
