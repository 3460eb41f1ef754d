// SPDX-License-Identifier: MIT
// Two values that all robots must agree on spread with an age, and are forgotten unless their owner keeps sending
// them: the largest weighted degree, which sets the step of the power iteration, and the root, which the metrics
// need and no source has.
#include "banyan/controller/core/fixed_point.hpp"
#include "rooms.hpp"

namespace banyan::baselines::fiedler {
namespace {

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

}  // namespace

void spread_news(Robot& robot) noexcept {
  say_own_links(robot);
  follow_degree(robot);
  State& self = robot.self;
  self.follow_root(self.id, self.assignment.sent, robot.table(), robot.elapsed_ticks, self.tally);
}

}  // namespace banyan::baselines::fiedler
