// SPDX-License-Identifier: MIT
// The filter of measured positions, against the truth of random walks and against a Kalman filter that knows the noise.
#include "banyan/controller/core/position_filter.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>

#include "banyan/controller/core/trig.hpp"

namespace banyan {
namespace {

constexpr float way = 0.01F;  // C a tick
constexpr int ticks = 4000;
constexpr int settled = 1500;  // by then the noise is known

// A neighbour that drives at full speed, straight on for about `course_ticks`, within reach of the radio.
class Neighbor {
 public:
  Neighbor(unsigned seed, int course_ticks) : random_(seed), turns_(1.0 / course_ticks) {}
  Vec2 step() {
    if (turns_(random_)) heading_ = unit_vector(angle_(random_));
    const Vec2 next = at_ + heading_ * way;
    if (norm(next) < 0.3F || norm(next) > 0.95F) heading_ = -unit(next) * (norm(next) > 0.5F ? 1.0F : -1.0F);
    else at_ = next;
    return at_;
  }
  Vec2 measure(float range_sigma, float bearing_sigma) {
    const float range = std::max(0.005F, norm(at_) + range_sigma * normal_(random_));
    return rotate(unit_vector(bearing_sigma * normal_(random_)), unit(at_)) * range;
  }

 private:
  std::mt19937 random_;
  std::bernoulli_distribution turns_;
  std::uniform_real_distribution<float> angle_{-3.14F, 3.14F};
  std::normal_distribution<float> normal_;
  Vec2 at_{0.6F, 0.0F};
  Vec2 heading_{0.0F, 1.0F};
};

struct Errors {
  double raw = 0.0, filtered = 0.0, kalman = 0.0;  // root mean squares, C
  float spread = 0.0F;
};

// `kalman`: of the range alone, which knows the noise and starts with its gain from the Riccati recursion.
Errors errors(Neighbor neighbor, float range_sigma, float bearing_sigma) {
  PositionFilter filter;
  Errors sum;
  Vec2 position;
  double range = 0.0, variance = 1.0;
  const double walk = 16.0 * way * way, noise = static_cast<double>(range_sigma) * range_sigma;
  double raw_range = 0.0, filtered_range = 0.0;
  for (int tick = 0; tick < ticks; ++tick) {
    const Vec2 truth = neighbor.step();
    const Vec2 measured = neighbor.measure(range_sigma, bearing_sigma);
    filter.begin(way);
    if (tick > 0) filter.learn(position, measured, 1);
    position = tick == 0 ? measured : filter.fuse(position, measured, 1, tick);
    variance += walk;
    const double gain = variance / (variance + noise);
    range += gain * (static_cast<double>(norm(measured)) - range);
    variance *= 1.0 - gain;
    if (tick < settled) continue;
    sum.raw += std::pow(distance(measured, truth), 2.0);
    sum.filtered += std::pow(distance(position, truth), 2.0);
    sum.kalman += std::pow(range - norm(truth), 2.0);
    filtered_range += std::pow(norm(position) - norm(truth), 2.0);
    raw_range += std::pow(norm(measured) - norm(truth), 2.0);
  }
  const double n = ticks - settled;
  if (bearing_sigma == 0.0F) sum.filtered = filtered_range, sum.raw = raw_range;
  return {std::sqrt(sum.raw / n), std::sqrt(sum.filtered / n), std::sqrt(sum.kalman / n), filter.spread()};
}

TEST(PositionFilter, WithoutNoiseMeasurementsAreTakenAsTheyAre) {
  Neighbor neighbor(1, 15);
  PositionFilter filter;
  Vec2 position = neighbor.step();
  for (int tick = 0; tick < 2000; ++tick) {
    const Vec2 truth = neighbor.step();
    filter.begin(way);
    filter.learn(position, truth, 1);
    position = filter.fuse(position, truth, 1, tick);
    ASSERT_EQ(position, truth);
  }
  EXPECT_FALSE(filter.has_seen_noise());
  EXPECT_EQ(filter.spread(), 0.0F);
}

// In as many ticks as passed a neighbour may have driven so far: that is no noise.
TEST(PositionFilter, LongStepsExplainLargerInnovations) {
  PositionFilter filter;
  filter.begin(way);
  filter.learn({0.5F, 0.0F}, {0.595F, 0.0F}, 10);
  EXPECT_FALSE(filter.has_seen_noise());
  filter.learn({0.5F, 0.0F}, {0.595F, 0.0F}, 2);
  EXPECT_TRUE(filter.has_seen_noise());
}

RC_GTEST_PROP(PositionFilter, IsAboutAsGoodAsAKalmanFilterThatKnowsTheNoise, ()) {
  const auto seed = *rc::gen::inRange(1U, 100000U);
  const float sigma = static_cast<float>(*rc::gen::inRange(15, 70)) * 0.005F;
  const Errors e = errors(Neighbor(seed, *rc::gen::inRange(8, 25)), sigma, 0.0F);
  RC_LOG() << sigma << ": raw " << e.raw << ", filtered " << e.filtered << ", Kalman " << e.kalman << ", spread "
           << e.spread;
  RC_ASSERT(e.filtered < 0.8 * e.raw);
  RC_ASSERT(e.filtered < 1.2 * e.kalman);
  RC_ASSERT(e.spread > 0.7 * e.filtered);  // what the guard keeps free
  RC_ASSERT(e.spread < 2.0 * e.filtered);
}

RC_GTEST_PROP(PositionFilter, BearingsAreFilteredApart, ()) {
  const auto seed = *rc::gen::inRange(1U, 100000U);
  const float sigma = static_cast<float>(*rc::gen::inRange(8, 30)) * 0.01F;
  const Errors e = errors(Neighbor(seed, 15), 0.0F, sigma);
  RC_LOG() << sigma << ": raw " << e.raw << ", filtered " << e.filtered;
  RC_ASSERT(e.filtered < 0.9 * e.raw);
  RC_ASSERT(e.spread == 0.0F);  // of ranges
}

// At first a mean of all; after a silence the newest counts for more.
TEST(PositionFilter, GainFollowsHowMuchIsKnown) {
  PositionFilter filter;
  std::mt19937 random(7);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same each time
  std::normal_distribution<float> normal(0.0F, 0.25F);
  for (int k = 0; k < 2000; ++k) {
    filter.begin(way);
    filter.learn({0.75F, 0.0F}, {std::max(0.005F, 0.75F + normal(random)), 0.0F}, 1);
  }
  filter.begin(way);
  const auto gain = [&](int since, int measurements) {
    return filter.fuse({0.5F, 0.0F}, {1.0F, 0.0F}, since, measurements).x / 0.5F - 1.0F;
  };
  EXPECT_NEAR(gain(1, 1), 0.5F, 1e-5F);
  EXPECT_NEAR(gain(1, 2), 1.0F / 3.0F, 1e-5F);
  EXPECT_NEAR(gain(1, 255), 0.08F / 0.48F, 0.02F);
  EXPECT_GT(gain(10, 255), 2.0F * gain(1, 255));
  EXPECT_GT(gain(1000, 255), 0.95F);
}

}  // namespace
}  // namespace banyan
