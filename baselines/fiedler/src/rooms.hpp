// SPDX-License-Identifier: MIT
// The parts of a step of Fiedler control, in their order.
#pragma once

#include <array>

#include "banyan/baselines/fiedler/fiedler.hpp"
#include "exponential.hpp"

namespace banyan::baselines::fiedler {

// (1)  a_ij = exp(-d^2 / (2 sigma^2)) up to the longest link, zero beyond.
[[nodiscard]] inline float weight(const Params& params, Vec2 neighbor) noexcept {
  const float square = dot(neighbor, neighbor);
  if (!(square < params.longest_link * params.longest_link)) return 0.0F;
  return exp_minus(square / (2.0F * params.weight_width * params.weight_width));
}

// The weight of the link to each entry of the table, once for the whole step.
struct Links {
  std::array<float, neighbor_capacity> weights{};
  float degree = 0.0F;
  std::uint8_t count = 0;  // of links with a weight

  Links(const Params& params, const Table<Message>& table) noexcept {
    for (int k = 0; k < table.size(); ++k) {
      const float a = weights[static_cast<std::size_t>(k)] = weight(params, table.position(k));
      degree += a;
      if (a > 0.0F) ++count;
    }
  }
  [[nodiscard]] float operator[](int k) const noexcept { return weights[static_cast<std::size_t>(k)]; }
};

// A robot within its step.
struct Robot {
  const Params& params;
  State& self;
  int elapsed_ticks;
  Links links{params, self.neighbors};

  [[nodiscard]] const Table<Message>& table() const noexcept { return self.neighbors; }
};

// flood.cpp: how many links I have, what the largest weighted degree is, which robot is root.
void spread_news(Robot& robot) noexcept;
// estimate.cpp: one step of the power iteration and of the averages.
void iterate(Robot& robot) noexcept;

}  // namespace banyan::baselines::fiedler
