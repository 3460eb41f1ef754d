// SPDX-License-Identifier: MIT
// When a tree is built: triggered, as in Aragues et al. 2014, by an edge that gets long, besides by one that is lost.
// The word spreads with a countdown, so that all measure their links at the same moment: two ends of a link that
// disagree about its length may choose edges that close a circle.
#include <algorithm>

#include "rooms.hpp"

namespace banyan::rivals::mst {
namespace {

// Another tree reaches here, of the same number or of one long ago: two networks have met.
bool meets_strangers(const Robot& robot) noexcept {
  const State& self = robot.self;
  for (int k = 0; k < robot.table().size(); ++k) {
    const Message& m = robot.table().message(k);
    if (m.done && m.epoch == self.epoch && self.done && m.root != self.root) return true;
  }
  return false;
}

bool wants_new_tree(const Robot& robot) noexcept {
  const State& self = robot.self;
  if (self.epoch_ticks < robot.params.ticks(robot.params.least_period_s)) return false;
  if (!self.done) return self.epoch_ticks > robot.params.ticks(robot.params.build_timeout_s);
  if (self.root == self.id && self.errand.sent) return true;  // a worker is no root
  for (const RobotId end : self.tree) {
    const int k = robot.table().find(end);
    if (k < 0 || robot.table().range(k) > robot.params.trigger_distance_m) return true;
  }
  if (self.tree.size() == 0 && robot.table().size() > 0) return true;
  return meets_strangers(robot);
}

}  // namespace

void follow_epoch(Robot& robot) noexcept {
  State& self = robot.self;
  self.epoch_ticks = static_cast<std::uint16_t>(std::min(self.epoch_ticks + robot.elapsed_ticks, 0xFFFF));
  const auto count_down = [&](int ticks) { self.countdown = static_cast<std::uint8_t>(std::clamp(ticks, 0, 255)); };
  const bool counted = is_newer(self.next, self.epoch);
  if (counted) count_down(self.countdown - robot.elapsed_ticks);
  for (int k = 0; k < robot.table().size(); ++k) {
    const Message& m = robot.table().message(k);
    if (robot.table().age(k) > 0) continue;
    if (is_newer(m.next, self.next)) {
      self.next = m.next;
      count_down(m.next == m.epoch ? 0 : m.countdown - 1);
    } else if (m.next == self.next && is_newer(self.next, self.epoch)) {
      count_down(std::min<int>(self.countdown, m.next == m.epoch ? 0 : m.countdown - 1));
    }
  }
  if (!is_newer(self.next, self.epoch)) {
    if (!wants_new_tree(robot)) return;
    self.next = static_cast<Serial>(self.epoch + 1);
    count_down(robot.params.ticks(robot.params.countdown_s));
  }
  if (self.countdown > 0) return;
  self.epoch = self.next;
  self.epoch_ticks = 0;
  begin_construction(robot);
}

}  // namespace banyan::rivals::mst
