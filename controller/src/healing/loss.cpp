// SPDX-License-Identifier: MIT
#include <algorithm>

#include "banyan/controller/healing/healing.hpp"
#include "banyan/controller/obstacles/sight.hpp"

namespace banyan {
namespace {

constexpr float fading = 0.99F;           // per tick: what counts are the last hundred
constexpr float prior_packets = 2.0F;     // heard before the first
constexpr float silent_by_chance = 1e-5F;

// Heard a tick ago, in range, and nothing stands between: the radio has lost what it said.
bool is_lost_by_radio(const HealingRobot& robot, int k) noexcept {
  constexpr float bodies = 2.0F;  // of the distance between the wheels: who hides it may be hidden, too
  const HealingParams& p = robot.params;
  const TreeTable& table = robot.table();
  if (table.age(k) != robot.elapsed_ticks || table.range(k) > longest_link * p.communication_range_m) return false;
  const Vec2 there = table.position(k);
  for (int j = 0; p.line_of_sight && j < table.size(); ++j)
    if (j != k && norm(nearest_on_segment(-table.position(j), there - table.position(j))) < bodies * p.wheel_distance_m) return false;
  return true;
}

bool radio_loses(const HealingRobot& robot) noexcept {
  if (robot.table().missed() == 0 || !robot.obstacles.empty()) return false;
  for (int k = 0; k < robot.table().size(); ++k)
    if (is_lost_by_radio(robot, k)) return true;
  return false;
}

// Packets may be lost many in a row, or over some links more than over others: then the share says little, but
// silences that have ended do.
void note_silence(HealingRobot& robot) noexcept {
  constexpr int first_silence_ticks = 32;  // taken for granted once the radio loses packets
  constexpr int fading_turns = 16;         // to be a tick shorter
  constexpr int silences = 2;              // so much patience
  HealingState& self = robot.self;
  const int ended_ticks = std::min(robot.table().returned() - robot.elapsed_ticks, longest_silence_ticks);
  if (self.usual_silence == 0) self.usual_silence = static_cast<std::uint8_t>(radio_loses(robot) ? first_silence_ticks : 0);
  else if (ended_ticks > self.usual_silence) self.usual_silence = static_cast<std::uint8_t>(ended_ticks);
  else if (self.turn % fading_turns == 0) --self.usual_silence;
  const bool growing = self.phase >= Phase::grow_tree;
  robot.tie_ticks = self.usual_silence == 0 ? 0 : growing ? std::max(robot.liveness_ticks(), silences * self.usual_silence) : longest_silence_ticks;
}

}  // namespace

// Whoever was heard a tick ago is there, so that its silence now is a lost packet. Those silent for
// longer may be dead or hidden and say nothing about the radio.
void estimate_loss(HealingRobot& robot) noexcept {
  HealingState& self = robot.self;
  self.loss_ticks = 0;
  robot.loss_ticks = 0;
  if (!robot.params.heals()) return;
  self.expected_packets = self.expected_packets * fading + static_cast<float>(robot.table().expected());
  self.missed_packets = self.missed_packets * fading + static_cast<float>(robot.table().missed());
  const float loss = std::min(self.missed_packets / (self.expected_packets + prior_packets), robot.params.largest_loss);
  float chance = 1.0F;
  while (loss > 0.0F && chance > silent_by_chance) {
    chance *= loss;
    ++self.loss_ticks;
  }
  robot.loss_ticks = self.loss_ticks;
  note_silence(robot);
}

}  // namespace banyan
