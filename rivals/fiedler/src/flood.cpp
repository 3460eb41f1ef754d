// SPDX-License-Identifier: MIT
// Two things that all robots must know alike spread with an age, and are forgotten unless their owner goes on saying
// them: the largest weighted degree, by which the step of the power iteration is chosen, and the root, which metrics
// ask for and no source has.
#include <algorithm>

#include "banyan/controller/core/fixed_point.hpp"
#include "rooms.hpp"

namespace banyan::rivals::fiedler {
namespace {

constexpr int news_ticks = 64;  // news that are older are none; so many hops may be between two robots

// How old the news of neighbour k are by now.
int age_now(int said, const Table<Message>& table, int k) noexcept { return said + 1 + table.age(k); }

void say_own_links(Robot& robot) noexcept {
  robot.self.links = robot.links.count;
  robot.self.largest_degree = to_fixed<std::uint16_t>(robot.links.degree, per_weight);
  robot.self.degree_age = 0;
}

void follow_degree(Robot& robot) noexcept {
  State& self = robot.self;
  for (int k = 0; k < robot.table().size(); ++k) {
    const Message& m = robot.table().message(k);
    const int age = age_now(m.degree_age, robot.table(), k);
    if (age > news_ticks || m.largest_degree < self.largest_degree) continue;
    if (m.largest_degree == self.largest_degree && age >= self.degree_age) continue;
    self.largest_degree = m.largest_degree;
    self.degree_age = static_cast<std::uint8_t>(age);
  }
}

// The smallest id among those that call themselves root; where there is none, a robot calls itself so.
void follow_root(Robot& robot) noexcept {
  State& self = robot.self;
  const bool was_root = self.root == self.id;
  RobotId best = was_root && !self.assignment.sent ? self.id : nobody;
  int best_age = 0;
  for (int k = 0; k < robot.table().size(); ++k) {
    const Message& m = robot.table().message(k);
    const int age = age_now(m.root_age, robot.table(), k);
    if (m.root == nobody || m.root == self.id || age > news_ticks || m.root > best || (m.root == best && age >= best_age)) continue;
    best = m.root;
    best_age = age;
  }
  self.rootless_ticks = static_cast<std::uint8_t>(best == nobody ? std::min(self.rootless_ticks + robot.elapsed_ticks, 255) : 0);
  if (self.rootless_ticks > news_ticks && !self.assignment.sent) {
    best = self.id;
    ++self.tally.elections;
  }
  self.root = best;
  self.root_age = static_cast<std::uint8_t>(best_age);
}

}  // namespace

void spread_news(Robot& robot) noexcept {
  say_own_links(robot);
  follow_degree(robot);
  follow_root(robot);
}

}  // namespace banyan::rivals::fiedler
