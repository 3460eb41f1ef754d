// SPDX-License-Identifier: MIT
#include <algorithm>

#include "healing/healing.hpp"
#include "healing/tie.hpp"

namespace banyan {
namespace {

constexpr float fading = 0.99F;            // per tick: about the last hundred ticks count
constexpr float prior_packets = 2.0F;      // counted as heard before the first one
constexpr float silent_by_chance = 1e-5F;  // so seldom a living neighbour is silent for I
constexpr int first_silence_ticks = 32;    // usual silence, assumed once the radio loses packets
constexpr int beyond_chance = 2;           // a burst: times as long as a silence by chance

// So long a living neighbour may be silent by chance.
int by_chance_ticks(const HealingRobot& robot) noexcept {
  return std::max<int>(whole(robot.params.liveness_rounds), robot.self.loss_ticks);
}

bool is_in_reach(const HealingRobot& robot, int k) noexcept {
  return robot.table().range(k) <= longest_link && is_in_the_clear(robot, k);
}

// A neighbour that was heard a tick ago, is in range and in the clear is silent; -1 if there is none. One such
// neighbour is looked at in a step: where packets get lost, there will soon be another.
int missed(const HealingRobot& robot) noexcept {
  const TreeTable& table = robot.table();
  if (table.missed() == 0) return -1;
  for (int k = 0; k < table.size(); ++k)
    if (table.age(k) == robot.elapsed_ticks && table.range(k) <= longest_link)
      return is_in_the_clear(robot, k) ? k : -1;
  return -1;
}

// Packets may be lost many in a row, or over some links more than over others. Then their share says little of how long
// a robot that is there may be silent, but silences that have ended do. One or two that begin may be deaths.
void note_silence(HealingRobot& robot) noexcept {
  constexpr int memory_turns = 512;  // then what was missed is forgotten
  constexpr int deaths = 2;          // within this time, that are no sign of lost packets
  constexpr int fading_turns = 16;   // to be a tick shorter
  HealingState& self = robot.self;
  if (self.turn % memory_turns == 0) self.missed_in_the_clear = 0;
  if (self.usual_silence == 0) {
    if (missed(robot) >= 0) ++self.missed_in_the_clear;
    if (self.missed_in_the_clear > (starts_thin(self) ? 0 : deaths)) self.usual_silence = first_silence_ticks;
    return;
  }
  const int ended_ticks = std::min(robot.table().returned() - robot.elapsed_ticks, longest_silence_ticks);
  if (ended_ticks > self.usual_silence) self.usual_silence = static_cast<std::uint8_t>(ended_ticks);
  else if (self.turn % fading_turns == 0) --self.usual_silence;
}

// With line of sight, a robot that falls silent in the clear may have been hidden by a dead body, or by an obstacle
// that no sensor reaches. That is less likely in a thin start, where bodies are few, once a burst is known, and where
// long silences are usual. With more targets than a robot remembers there are hundreds of bodies, and silences are long
// for that.
bool may_be_hidden(const HealingRobot& robot) noexcept {
  const HealingState& self = robot.self;
  return robot.params.line_of_sight && self.neighbors_at_start == 0 && self.burst_ticks == 0 &&
         (self.forgets || self.usual_silence <= first_silence_ticks + beyond_chance * by_chance_ticks(robot));
}

// A neighbour comes back after a silence that lost packets alone do not explain: they get lost many in a row. Every
// robot watches one silent neighbour at a time, and passes on the longest such silence that it knows of.
void note_burst(HealingRobot& robot) noexcept {
  constexpr int fading_turns = 16;  // to be a tick shorter
  HealingState& self = robot.self;
  const TreeTable& table = robot.table();
  for (const Heard& h : robot.heard)
    if (const int known = std::min<int>(burst_of(*h.message), longest_silence_ticks); known > self.burst_ticks)
      self.burst_ticks = static_cast<std::uint8_t>(known);
  if (self.burst_ticks > 0 && self.turn % fading_turns == 0) --self.burst_ticks;
  const bool hidden = may_be_hidden(robot);
  // In a full table it may only have had no room.
  if (hidden || table.size() == neighbor_capacity) self.watched = nobody;
  if (self.watched != nobody) {
    const int ticks = std::min(self.watched_ticks + robot.elapsed_ticks, longest_silence_ticks + 1);
    self.watched_ticks = static_cast<std::uint8_t>(ticks);
    const int k = table.find(self.watched);
    const bool back = k >= 0 && table.age(k) == 0;
    const int silent_ticks = ticks - robot.elapsed_ticks;
    const int least_ticks = std::max<int>(self.burst_ticks, beyond_chance * by_chance_ticks(robot));
    if (back && silent_ticks > least_ticks && is_in_reach(robot, k))
      self.burst_ticks = static_cast<std::uint8_t>(silent_ticks);
    if (back || self.watched_ticks > longest_silence_ticks) self.watched = nobody;
  }
  // One that has missed nothing (note_silence) need not look again.
  if (hidden || self.watched != nobody || (self.usual_silence == 0 && self.missed_in_the_clear == 0)) return;
  const int k = missed(robot);
  if (k < 0) return;
  self.watched = table.id(k);
  self.watched_ticks = static_cast<std::uint8_t>(table.age(k));
}

}  // namespace

// For so many ticks a silent neighbour may be there: twice what is usual, and longer while the first tree is built.
void HealingRobot::take_patience() noexcept {
  constexpr int silences = 2;  // times the usual one
  forget_ticks = by_chance_ticks(*this);
  loss_ticks = std::max<int>(self.loss_ticks, silences * self.burst_ticks);
  if (self.usual_silence == 0) tie_ticks = 0;
  else if (self.phase < Phase::grow_tree || is_thin(self)) tie_ticks = longest_silence_ticks;
  else tie_ticks = std::max(liveness_ticks(), silences * self.usual_silence);
  if (has_bursts()) tie_ticks = std::max(tie_ticks, loss_ticks);
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
  note_burst(robot);
  robot.take_patience();
}

}  // namespace banyan
