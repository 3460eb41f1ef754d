// SPDX-License-Identifier: MIT
#include <algorithm>

#include "banyan/controller/healing/healing.hpp"
#include "banyan/controller/healing/tie.hpp"

namespace banyan {
namespace {

constexpr float fading = 0.99F;           // per tick: about the last hundred ticks count
constexpr float prior_packets = 2.0F;     // counted as heard before the first one
constexpr float silent_by_chance = 1e-5F;

// A neighbour that was heard a tick ago, is in range and in the clear is silent. One such neighbour is looked at in a
// step: where packets get lost, there will soon be another.
bool is_missed(const HealingRobot& robot) noexcept {
  const TreeTable& table = robot.table();
  const float range_m = longest_link * robot.params.communication_range_m;
  if (table.missed() == 0) return false;
  for (int k = 0; k < table.size(); ++k)
    if (table.age(k) == robot.elapsed_ticks && table.range(k) <= range_m) return is_in_the_clear(robot, k);
  return false;
}

// Packets may be lost many in a row, or over some links more than over others. Then their share says little of how long
// a robot that is there may be silent, but silences that have ended do. One or two that begin may be deaths.
void note_silence(HealingRobot& robot) noexcept {
  constexpr int memory_turns = 512;
  constexpr int deaths = 2;                // within this time, that are no sign of lost packets
  constexpr int first_silence_ticks = 32;  // assumed once the radio loses packets
  constexpr int fading_turns = 16;         // to be a tick shorter
  HealingState& self = robot.self;
  if (self.turn % memory_turns == 0) self.missed_in_the_clear = 0;
  if (self.usual_silence == 0) {
    if (is_missed(robot) && ++self.missed_in_the_clear > deaths) self.usual_silence = first_silence_ticks;
    return;
  }
  const int ended_ticks = std::min(robot.table().returned() - robot.elapsed_ticks, longest_silence_ticks);
  if (ended_ticks > self.usual_silence) self.usual_silence = static_cast<std::uint8_t>(ended_ticks);
  else if (self.turn % fading_turns == 0) --self.usual_silence;
}

}  // namespace

// For so many ticks a silent neighbour may be there: twice what is usual, and longer while the first tree is built.
void HealingRobot::take_patience() noexcept {
  constexpr int silences = 2;
  loss_ticks = self.loss_ticks;
  if (self.usual_silence == 0) tie_ticks = 0;
  else if (self.phase < Phase::grow_tree) tie_ticks = longest_silence_ticks;
  else tie_ticks = std::max(liveness_ticks(), silences * self.usual_silence);
}

// A robot heard a tick ago is still there, so that its silence now is a lost packet. One silent for
// longer may be dead or hidden and says nothing about the radio.
void estimate_loss(HealingRobot& robot) noexcept {
  HealingState& self = robot.self;
  if (!robot.params.heals()) return;
  self.expected_packets = self.expected_packets * fading + static_cast<float>(robot.table().expected());
  self.missed_packets = self.missed_packets * fading + static_cast<float>(robot.table().missed());
  const float loss = std::min(self.missed_packets / (self.expected_packets + prior_packets), robot.params.largest_loss);
  self.loss_ticks = 0;
  for (float chance = 1.0F; loss > 0.0F && chance > silent_by_chance; chance *= loss) ++self.loss_ticks;
  note_silence(robot);
  robot.take_patience();
}

}  // namespace banyan
