// SPDX-License-Identifier: MIT
#include "banyan/controller/core/proximity.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace banyan {
namespace {

TEST(Proximity, DropsWhatIsARobotsBodyAndNothingElse) {
  const std::vector<Vec2> robots{{0.30F, 0.0F}, {0.0F, -1.0F}};
  std::vector<Vec2> readings{{0.23F, 0.0F}, {0.0F, 0.2F}, {0.19F, 0.0F}, {0.0F, -0.93F}, {-0.1F, 0.0F}};
  const auto left = without_robots(readings, robots, 0.07F, 0.02F);
  EXPECT_EQ((std::vector<Vec2>{left.begin(), left.end()}),
            (std::vector<Vec2>{{0.0F, 0.2F}, {0.19F, 0.0F}, {-0.1F, 0.0F}}));
}

TEST(Proximity, WithoutRobotsAllAreObstacles) {
  std::vector<Vec2> readings{{0.2F, 0.0F}};
  EXPECT_EQ(without_robots(readings, {}, 0.07F, 0.02F).size(), 1U);
}

}  // namespace
}  // namespace banyan
