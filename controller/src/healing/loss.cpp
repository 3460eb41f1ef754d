// SPDX-License-Identifier: MIT
#include <algorithm>

#include "banyan/controller/healing/healing.hpp"
#include "banyan/controller/tree/tie.hpp"

namespace banyan {
namespace {

constexpr float fading = 0.99F;           // per tick: about the last hundred ticks count
constexpr float prior_packets = 2.0F;     // counted as heard before the first one
constexpr float silent_by_chance = 1e-5F;

// A packet of a robot that was heard a tick ago, is in range and not hidden has been lost. One such robot is looked at
// in a step: if packets get lost, another will be soon.
bool radio_loses(const HealingRobot& robot) noexcept {
  const TreeTable& table = robot.table();
  const float range_m = longest_link * robot.params.communication_range_m;
  if (table.missed() == 0) return false;
  for (int k = 0; k < table.size(); ++k)
    if (table.age(k) == robot.elapsed_ticks && table.range(k) <= range_m) return is_in_the_clear(robot, k);
  return false;
}

// Packets may be lost many in a row, or over some links more than over others. Then their share says little of how long
// a robot that is there may be silent, but silences that have ended do.
void note_silence(HealingRobot& robot) noexcept {
  constexpr int first_silence_ticks = 32;  // assumed once the radio loses packets
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

// A robot heard a tick ago is still there, so that its silence now is a lost packet. One silent for
// longer may be dead or hidden and says nothing about the radio.
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
