// SPDX-License-Identifier: MIT
// The parts of a step of Fiedler control, in their order.
#pragma once

#include "banyan/rivals/fiedler/fiedler.hpp"
#include "exponential.hpp"

namespace banyan::rivals::fiedler {

// A robot within its step.
struct Robot {
  const Params& params;
  State& self;
  int elapsed_ticks;

  [[nodiscard]] const Table<Message>& table() const noexcept { return self.neighbors; }
};

// (1)  a_ij = exp(-d^2 / (2 sigma^2)) up to the longest link, zero beyond.
[[nodiscard]] inline float weight(const Params& params, Vec2 neighbor) noexcept {
  const float square = dot(neighbor, neighbor);
  if (!(square < params.longest_link_m * params.longest_link_m)) return 0.0F;
  return exp_minus(square / (2.0F * params.weight_width_m * params.weight_width_m));
}

// flood.cpp: how many links I have, what the largest weighted degree is, who is root.
void spread_news(Robot& robot) noexcept;
// estimate.cpp: one step of the power iteration and of the averages.
void iterate(Robot& robot) noexcept;

}  // namespace banyan::rivals::fiedler
