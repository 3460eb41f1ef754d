// SPDX-License-Identifier: MIT
// What becomes of a table of parameters on a robot.
#include "banyan/controller/core/algorithm_of.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace banyan {
namespace {

struct Params : Machine {
  float clearance = 0.08F;
  float edge = 0.9F;
};
constexpr Parameter<Params> table[] = {
    {{"clearance", "", "C", "room beside a body", "", "", 0.0F, 1.0F, true}, &Params::clearance},
    {{"edge", "", "C", "longest edge", "", "", 0.1F, 1.0F}, &Params::edge},
};

constexpr Parameter<Params> times[] = {
    {{"patience", "", "drives", "waits so long", "", "", 0.0F, 600.0F}, &Params::clearance},
    {{"silence", "", "rounds", "is not heard for so long", "", "", 0.0F, 60'000.0F}, &Params::edge},
};

Params on_a_body(float radius) {
  Params params;
  params.body_radius = radius;
  const auto rows = bind_all(params, table);
  algorithm_detail::resolve(std::array{0.08F, 0.9F}, rows, params);
  return params;
}

TEST(GrowsWithBody, WhereBodiesNeedRoomLargeOnesGetMore) {
  EXPECT_EQ(on_a_body(0.0352F).clearance, 0.08F) << "of a Khepera IV at 2 m";
  EXPECT_FLOAT_EQ(on_a_body(0.0704F).clearance, 0.16F);
  EXPECT_FLOAT_EQ(on_a_body(0.17F).clearance, 0.08F * 0.17F / 0.0352F);
  EXPECT_EQ(on_a_body(0.001F).clearance, 0.08F) << "small ones not less";
  for (const float radius : {0.001F, 0.0352F, 0.17F})
    EXPECT_EQ(on_a_body(radius).edge, 0.9F) << "nor what has no body in it";
}

TEST(RangeFault, SaysWhichAndWhatIsAllowed) {
  Params params;
  const auto rows = bind_all(params, table);
  EXPECT_EQ(algorithm_detail::range_fault(std::array{0.08F, 1.0F}, rows), "");
  EXPECT_EQ(algorithm_detail::range_fault(std::array{0.08F, 0.05F}, rows), "edge must be between 0.1 and 1, not 0.05");
  EXPECT_EQ(algorithm_detail::range_fault(std::array{-1.0F, 0.5F}, rows), "clearance must be between 0 and 1, not -1");
  EXPECT_NE(algorithm_detail::range_fault(std::array{0.0F, std::nanf("")}, rows), "");
}

// A time in drives is more rounds the slower the robots are, and rounds are counted in 16 bits.
TEST(TimeFault, RefusesWhatTheRobotsCannotCount) {
  Params params;
  const auto rows = bind_all(params, times);
  const auto fault = [&](float rounds_per_drive, float patience) {
    params.rounds_per_drive = rounds_per_drive;
    return algorithm_detail::time_fault(std::array{patience, 60'000.0F}, rows, params);
  };
  EXPECT_EQ(fault(100.0F, 500.0F), "");
  EXPECT_NE(fault(100.0F, 501.0F), "");
  EXPECT_EQ(fault(2000.0F, 25.0F), "");
  EXPECT_EQ(fault(2000.0F, 26.0F),
            "patience must be at most 25 for robots so slow, not 26: they count 50000 control periods");
}

}  // namespace
}  // namespace banyan
