// SPDX-License-Identifier: MIT
// Links that matter are promises, and how long a promise outlasts silence is learnt.
#include "caravan/rules.hpp"

namespace banyan::caravan {
namespace {

constexpr float fading = 0.99F;        // a round: about the last hundred count
constexpr float prior_packets = 2.0F;  // counted as heard before the first one
constexpr float largest_loss = 0.9F;
constexpr float silent_by_chance = 1e-5F;  // so seldom a robot that is there is taken for gone
constexpr float some_loss = 0.005F;        // from here on silences are learnt, and this long at first
constexpr int first_silence = 32;
constexpr int forgets_after = 64;  // rounds, to be one shorter

// Nothing that could hide neighbour k is near the line between us.
bool is_in_the_clear(const Robot& robot, int k) noexcept {
  if (!robot.params.line_of_sight) return true;
  if (!robot.obstacles.empty()) return false;
  const Table& table = robot.table();
  for (int j = 0; j < table.size(); ++j)
    if (j != k && distance_to_segment(table.position(j), Vec2{}, table.position(k)) < 3.0F * robot.params.body_radius)
      return false;
  return true;
}

}  // namespace

void measure_silence(Robot& robot) noexcept {
  State& self = robot.self;
  const Table& table = robot.table();
  int missed = 0;
  for (int k = 0; table.missed() > 0 && k < table.size(); ++k)
    if (table.age(k) == robot.elapsed_rounds && table.range(k) <= robot.params.longest_edge &&
        is_in_the_clear(robot, k))
      ++missed;
  self.expected_packets = self.expected_packets * fading + static_cast<float>(table.expected());
  self.missed_packets = self.missed_packets * fading + static_cast<float>(missed);
  const float loss = std::min(self.missed_packets / (self.expected_packets + prior_packets), largest_loss);
  self.loss_rounds = 0;
  if (loss > some_loss)
    for (float chance = 1.0F; chance > silent_by_chance; chance *= loss) ++self.loss_rounds;
  ++self.round;
  if (loss > some_loss) self.assumed_silence = first_silence;
  else if (self.assumed_silence > 0 && self.round % forgets_after == 0) --self.assumed_silence;
}

// One that is hidden has not heard me either, and stays; one that is out of reach for a burst may drive on.
float strayed(const Robot& robot, int k) noexcept {
  const int rounds = robot.table().age(k) - robot.hidden_after();
  if (robot.self.assumed_silence == 0 || rounds <= 0 || !is_in_the_clear(robot, k)) return 0.0F;
  return robot.params.speed_gain * robot.params.way_in_a_round() * static_cast<float>(rounds);
}

bool is_promised(const Robot& robot, int k) noexcept {
  const State& self = robot.self;
  const Statement& m = robot.said(k);
  const RobotId id = robot.table().id(k);
  const bool named = id == self.parent || id == self.other || m.parent == self.id || m.other == self.id;
  const bool unbound =
      (m.parent == nobody && m.role != Role::root) || (self.parent == nobody && self.role != Role::root);
  if (!named) return unbound && robot.table().age(k) <= robot.lease();
  return robot.table().age(k) <= (robot.is_edge(k) ? robot.tree_lease() : robot.lease());
}

}  // namespace banyan::caravan
