// SPDX-License-Identifier: MIT
#include <algorithm>

#include "banyan/controller/healing/healing.hpp"

namespace banyan {
namespace {

constexpr float fading = 0.99F;           // per tick: about the last hundred ticks count
constexpr float prior_packets = 2.0F;     // counted as heard before the first one
constexpr float silent_by_chance = 1e-5F;

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
}

}  // namespace banyan
