// SPDX-License-Identifier: MIT
// A chain grows at its base end: the robot there asks the nearest free robot to come between it and the base.
#include <cmath>

#include "rooms.hpp"

namespace banyan::baselines::chains {
namespace {

bool has_joined(const Robot& robot, const Message& m) noexcept {
  return m.worker == robot.self.worker && m.below[0] == robot.self.id;
}

// What became of a request. Who has joined is waited for: it may have some way to go.
void follow_request(Robot& robot, Chain& chain) noexcept {
  State& self = robot.self;
  if (chain.asked == nobody) return;
  const int k = robot.table().find(chain.asked);
  const bool joined = k >= 0 && has_joined(robot, robot.table().message(k));
  if (joined) {
    chain.asked_ticks = 0;
    const bool leads = robot.table().message(k).above[0] != nobody || chain.parent == nobody;
    if (!leads || !(robot.table().range(k) < robot.params.safe_distance)) return;
    chain.parent = chain.asked;
    chain.above = no_ids();
    chain.above[0] = chain.parent;
    chain.asked = nobody;
    return;
  }
  const bool declined = k >= 0 && robot.table().message(k).worker != nobody;
  chain.asked_ticks = static_cast<std::uint16_t>(chain.asked_ticks + robot.elapsed_ticks);
  if (!declined && chain.asked_ticks <= whole(robot.params.request_rounds)) return;
  self.ignored = chain.asked;
  self.ignored_ticks = static_cast<std::uint16_t>(whole(robot.params.ignore_rounds));
  chain.asked = nobody;
}

// (3)
bool wants_another(const Robot& robot, const Chain& chain) noexcept {
  const State& self = robot.self;
  if (chain.parent == nobody) return self.whole;
  const int k = robot.find_fresh(chain.parent);
  if (k < 0 || chain.parent != self.root) return false;
  const float safe = robot.params.safe_distance;
  const bool short_of = static_cast<float>(self.links + 1) < std::ceil(self.path / safe);
  return short_of || (robot.missing() > slack && robot.table().range(k) >= safe);
}

// The nearest that is nearer to the base than me; nobody if there is none.
RobotId find_free(const Robot& robot) noexcept {
  const State& self = robot.self;
  const Table<Message>& table = robot.table();
  const int base = robot.find_fresh(self.root);
  int nearest = -1;
  for (int k = 0; k < table.size(); ++k) {
    const Message& m = table.message(k);
    if (m.worker != nobody || m.root == m.id || m.id == self.ignored || table.age(k) > 0) continue;
    const bool nearer = base >= 0 ? distance(table.position(k), table.position(base)) < table.range(base)
                                  : m.root == self.root && m.root_age < self.root_age;
    if (nearer && (nearest < 0 || table.range(k) < table.range(nearest))) nearest = k;
  }
  return nearest < 0 ? nobody : table.id(nearest);
}

}  // namespace

void recruit(Robot& robot) noexcept {
  State& self = robot.self;
  self.ignored_ticks = static_cast<std::uint16_t>(std::max(self.ignored_ticks - robot.elapsed_ticks, 0));
  if (self.ignored_ticks == 0) self.ignored = nobody;
  if (self.is_free()) return;
  bool asks = false;
  for (Chain& chain : robot.chains()) {
    follow_request(robot, chain);
    if (!asks && chain.asked == nobody && wants_another(robot, chain)) {
      chain.asked = find_free(robot);
      chain.asked_ticks = 0;
    }
    if (asks) chain.asked = nobody;  // one request at a time
    if (chain.asked == nobody) continue;
    asks = true;
    if (self.is_worker()) self.number = robot.number_of(chain);
  }
}

}  // namespace banyan::baselines::chains
