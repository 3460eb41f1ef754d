// SPDX-License-Identifier: MIT
// The parts of a step of chains from a base, in their order.
#pragma once

#include <algorithm>

#include "banyan/baselines/chains/chains.hpp"

namespace banyan::baselines::chains {

inline constexpr int fresh_ticks = 5;   // who was heard within these is where it is said to be
inline constexpr float slack = 0.005F;  // a robot so near its place is there

// A robot within its step.
struct Robot {
  const Params& params;
  State& self;
  int elapsed_ticks;

  [[nodiscard]] const Table<Message>& table() const noexcept { return self.neighbors; }
  // Null for `nobody` and for robots not heard.
  [[nodiscard]] const Message* said_by(RobotId id) const noexcept {
    const int k = table().find(id);
    return k < 0 ? nullptr : &table().message(k);
  }
  // Of a chain, by its number among those of its worker.
  [[nodiscard]] std::span<Chain> chains() const noexcept {
    return std::span(self.chains).first(self.is_worker() ? static_cast<std::size_t>(params.chains()) : 1);
  }
  [[nodiscard]] std::uint8_t number_of(const Chain& chain) const noexcept {
    return self.is_worker() ? static_cast<std::uint8_t>(&chain - self.chains.data()) : self.number;
  }
  // The index of `id` if it was heard lately, or -1.
  [[nodiscard]] int find_fresh(RobotId id) const noexcept {
    const int k = table().find(id);
    return k >= 0 && table().age(k) <= fresh_ticks ? k : -1;
  }
  // How far the robot is from its place: n links from the worker it is n SAFE before the target.
  [[nodiscard]] float missing() const noexcept {
    return self.beyond - static_cast<float>(self.links) * params.safe_distance;
  }
};

[[nodiscard]] inline bool lists(const Ids& ids, RobotId id) noexcept {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

// membership.cpp: which chain am I in, who are my parents and who my child, and are they still there?
// `given_up`: the worker whose target is none any more.
void follow_chain(Robot& robot, RobotId given_up) noexcept;
// recruiting.cpp: ask a free robot to join, and see what came of it.
void recruit(Robot& robot) noexcept;
// spacing.cpp
[[nodiscard]] Vec2 spacing_motion(const Robot& robot) noexcept;
void guard_chain(const Robot& robot, Guard& guard) noexcept;

}  // namespace banyan::baselines::chains
