// SPDX-License-Identifier: MIT
// Robots that stand still and talk: the whole step of convoy, over a radio that loses packets at random.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "bench.hpp"

namespace banyan {

class Network {
 public:
  // Robot 0 is the root, the last `targets.size()` are workers. Everybody's frame is the world's.
  Network(std::vector<Vec2> places, std::vector<Vec2> targets, float loss, std::uint64_t seed)
      : places_(std::move(places)), targets_(std::move(targets)), loss_(loss), random_(seed) {
    for (std::size_t i = 0; i < places_.size(); ++i)
      states.push_back(initial_convoy_state(static_cast<RobotId>(i), is_sent(i), i == 0));
    params.give_up_after_drives = 30.0F;
    alive_.assign(places_.size(), true);
    for (const ConvoyState& state : states) said_.emplace_back().id = state.id;
  }

  void step() {
    std::vector<ConvoyMessage> next = said_;
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (!alive_[i]) continue;
      heard_.clear();
      for (std::size_t j = 0; j < states.size(); ++j) {
        if (j == i || !alive_[j] || distance(places_[i], places_[j]) >= 1.0F || chance() < loss_) continue;
        heard_.push_back({&said_[j], places_[j] - places_[i]});
      }
      Senses senses;
      senses.orders.sent = is_sent(i);
      if (is_sent(i)) senses.orders.target = targets_[i - first_worker()] - places_[i];
      next[i] = convoy_step(params, states[i], {heard_, senses, test_platform}).message;
    }
    said_ = next;
  }
  void steps(int count) {
    for (int k = 0; k < count; ++k) step();
  }

  void kill(std::size_t i) { alive_[i] = false; }
  [[nodiscard]] bool lives(std::size_t i) const { return alive_[i]; }
  [[nodiscard]] std::size_t first_worker() const { return places_.size() - targets_.size(); }
  [[nodiscard]] std::uint32_t replacements() const {
    std::uint32_t sum = 0;
    for (const ConvoyState& state : states) sum += state.tally.replacements;
    return sum;
  }
  // Living robots that serve that target.
  [[nodiscard]] int holders(RobotId serves) const {
    int count = 0;
    for (std::size_t i = 0; i < states.size(); ++i)
      count += static_cast<int>(alive_[i] && states[i].is_worker && states[i].serves == serves);
    return count;
  }

  ConvoyParams params = convoy_defaults();
  std::vector<ConvoyState> states;

 private:
  [[nodiscard]] bool is_sent(std::size_t i) const { return i >= first_worker(); }
  float chance() {  // splitmix64
    random_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = random_;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
    return static_cast<float>((z ^ (z >> 31U)) >> 40U) * 0x1p-24F;
  }
  std::vector<Vec2> places_;
  std::vector<Vec2> targets_;
  float loss_;
  std::uint64_t random_;
  std::vector<bool> alive_;
  std::vector<ConvoyMessage> said_;
  std::vector<Heard> heard_;
};

}  // namespace banyan
