// SPDX-License-Identifier: MIT
// Power iteration for the Fiedler vector, after Yang et al. 2010: each robot has one component and a step a tick. What
// it needs of all robots, three means, comes from proportional-integral average consensus (Freeman, Yang & Lynch 2006),
// which forgets wrong initial values: robots may join, die and lose packets.
#include <algorithm>

#include "rooms.hpp"

namespace banyan::baselines::fiedler {
namespace {

// Gains of the sources, scaled to one step a tick. Those of the iteration are in units of s = h lambda_2, the rate at
// which its vector decays: what is slow in a long chain must not be corrected fast, or the correction oscillates.
constexpr float deflation = 0.05F;         // k1
constexpr float normalisation = 1.2F;      // k3
constexpr float input_gain = 1.2F;         // gamma
constexpr float least_mean_input = 0.02F;  // smallest gamma, of the mean
constexpr float least_input = 0.05F;       // and of the other two, whose errors cancel in their quotient
constexpr float proportional = 0.5F;       // K_P
constexpr float integral = 0.4F;           // K_I
constexpr float least_fading = 0.01F;      // smallest s, in units of the iteration rate
constexpr float most_fading = 0.5F;        // largest s

constexpr float least_square = 1e-5F;  // smallest divisor
constexpr float first_square = 0.3F;
constexpr float faded = 0.02F;  // a mean square below this: the vector has vanished
constexpr float largest_component = 100.0F;

float limited(float v) noexcept { return std::clamp(v, -largest_real, largest_real); }

// In [-1, 1], different at each call and for each robot (Steele, Lea & Flood's mixer of 32 bits).
float draw(State& self) noexcept {
  std::uint32_t h = (self.id + 1U) * 0x9E3779B9U + self.draws++ * 0x85EBCA6BU;
  h = (h ^ h >> 16U) * 0x7FEB352DU;
  h = (h ^ h >> 15U) * 0x846CA68BU;
  h ^= h >> 16U;
  return static_cast<float>(h >> 8U) * (2.0F / 16777216.0F) - 1.0F;
}

// The mean starts at its input: relative to one that lags far behind, all robots would seem to deviate alike. And
// lambda_2 starts at its bound: with gains that are too small the vector would decay before it is known.
void begin_anew(State& self, float largest_lambda) noexcept {
  self.component = draw(self);
  self.mean = {self.component, 0.0F};
  self.square = {first_square, 0.0F};
  self.product = {first_square * largest_lambda, 0.0F};
}

// Differences to neighbours: sums over links of weight times (mine - theirs).
struct Differences {
  float value = 0.0F;
  float integral = 0.0F;
  void add(float w, const Average& mine, const Average& theirs) noexcept {
    value += w * (mine.value - theirs.value);
    integral += w * (mine.integral - theirs.integral);
  }
};

// (3)  z <- z + gamma (input - z) - K_P sum w_ij (z_i - z_j) + K_I sum w_ij (q_i - q_j)
// (4)  q <- q - K_I sum w_ij (z_i - z_j)
void average(Average& a, float input, float gamma, const Differences& d) noexcept {
  a.value = limited(a.value + gamma * (input - a.value) - proportional * d.value + integral * d.integral);
  a.integral = limited(a.integral - integral * d.value);
}

}  // namespace

void iterate(Robot& robot) noexcept {
  State& self = robot.self;
  const Table<Message>& table = robot.table();
  float laplacian = 0.0F;
  Differences mean, square, product;
  for (int k = 0; k < table.size(); ++k) {
    const float a = robot.links[k];
    if (!(a > 0.0F)) continue;
    const Message& m = table.message(k);
    laplacian += a * (self.component - m.component);
    // Metropolis weights: averages converge independently of what the links weigh.
    const float w = 1.0F / static_cast<float>(1 + std::max(self.links, m.links));
    mean.add(w, self.mean, m.mean);
    square.add(w, self.square, m.square);
    product.add(w, self.product, m.product);
  }
  // lambda_2 of N robots is at most N / (N - 1) times the least degree (Fiedler 1973): a bound that does not lag.
  const float bound =
      self.links > 0 ? robot.links.degree * static_cast<float>(self.links + 1) / static_cast<float>(self.links) : 0.0F;
  self.lambda = std::clamp(self.product.value / std::max(self.square.value, least_square), 0.0F, bound);
  const float rate = robot.params.iteration_rate;
  const float h = rate * per_weight / static_cast<float>(std::max<int>(self.largest_degree, 1));
  const float s = std::clamp(h * self.lambda, least_fading * rate, most_fading);
  const float x = self.component;
  const float deviation = x - self.mean.value;

  // (2)  x <- x - h L x - k1 s z1 + k3 s (1 - z2) (x - z1)
  const float growth = normalisation * s * (1.0F - std::min(self.square.value, 3.0F));
  const float next = x - h * laplacian - deflation * s * self.mean.value + growth * deviation;
  average(self.mean, x, std::max(input_gain * s, least_mean_input), mean);
  average(self.square, deviation * deviation, std::max(input_gain * s, least_input), square);
  average(self.product, deviation * laplacian, std::max(input_gain * s, least_input), product);
  self.component = std::clamp(next, -largest_component, largest_component);
  if (self.square.value < faded) begin_anew(self, bound);
}

}  // namespace banyan::baselines::fiedler
