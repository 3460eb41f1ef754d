// SPDX-License-Identifier: MIT
// How soon targets are held again, against courses that are written out.
#include "banyan/measure/takeovers.hpp"

#include <gtest/gtest.h>

namespace banyan::measure {
namespace {

struct Watch {
  Takeovers takeovers{0.1};
  std::vector<world::Target> targets;
  std::vector<std::uint8_t> alive = std::vector<std::uint8_t>(8, 1);

  explicit Watch(std::size_t count) : targets(count) {}
  void see(std::vector<RobotId> holders, int ticks = 1) {
    for (; ticks > 0; --ticks) takeovers.observe(holders, targets, alive);
  }
};

TEST(Takeovers, ATargetWaitsFromTheDeathOfItsWorkerUntilAnotherHoldsIt) {
  Watch watch(1);
  watch.see({0}, 5);
  watch.alive[0] = 0;
  watch.see({nobody}, 30);
  EXPECT_EQ(watch.takeovers.lost(), 1U);
  EXPECT_EQ(watch.takeovers.median_s(), -1.0) << "it still waits";
  watch.see({3}, 7);
  EXPECT_NEAR(watch.takeovers.median_s(), 3.0, 1e-12);
}

TEST(Takeovers, AnotherWorkerThatIsThereAlreadyMakesItNoTime) {
  Watch watch(1);
  watch.see({0});
  watch.alive[0] = 0;
  watch.see({1});
  EXPECT_EQ(watch.takeovers.lost(), 1U);
  EXPECT_EQ(watch.takeovers.median_s(), 0.0);
}

TEST(Takeovers, AWorkerThatDoesNotHoldItsTargetIsNoLoss) {
  Watch watch(2);
  watch.see({0, nobody});
  watch.see({nobody, nobody});  // driven off
  watch.alive[0] = watch.alive[1] = 0;
  watch.see({nobody, nobody}, 10);
  EXPECT_EQ(watch.takeovers.lost(), 0U);
  EXPECT_EQ(watch.takeovers.median_s(), -1.0);
}

TEST(Takeovers, ATargetWithoutItsLivingWorkerDoesNotWait) {
  Watch watch(3);
  watch.see({0, 1, 2});
  EXPECT_EQ(watch.takeovers.waiting(), 0U);
  watch.alive[0] = 0;
  watch.see({nobody, nobody, 2});  // 1 lives, away from its target
  EXPECT_EQ(watch.takeovers.waiting(), 1U) << "in the tick of the death";
  watch.alive[1] = watch.alive[2] = 0;
  watch.see({nobody, nobody, nobody}, 9);
  EXPECT_EQ(watch.takeovers.waiting(), 2U) << "1 held nothing when it died";
  watch.see({4, nobody, nobody});
  EXPECT_EQ(watch.takeovers.waiting(), 1U);
  watch.see({nobody, nobody, nobody});
  EXPECT_EQ(watch.takeovers.waiting(), 1U) << "held again once; 4 lives";
  watch.targets[2].active = false;
  watch.see({nobody, nobody, nobody});
  EXPECT_EQ(watch.takeovers.waiting(), 0U) << "nobody waits for a target that is given up";
}

TEST(Takeovers, WhoStillWaitsCountsAsLongest) {
  Watch watch(4);
  watch.see({0, 1, 2, 3});
  watch.alive[0] = watch.alive[1] = watch.alive[2] = 0;
  watch.see({nobody, nobody, nobody, 3}, 10);
  watch.see({4, nobody, nobody, 3}, 10);
  EXPECT_EQ(watch.takeovers.median_s(), -1.0) << "two of three wait";
  watch.see({4, 5, nobody, 3});
  EXPECT_EQ(watch.takeovers.lost(), 3U);
  EXPECT_NEAR(watch.takeovers.median_s(), 2.0, 1e-12) << "1 s, 2 s, longer";
  watch.alive[3] = 0;
  watch.see({4, 5, nobody, nobody});
  EXPECT_EQ(watch.takeovers.median_s(), -1.0) << "two of four wait";
  watch.see({4, 5, 6, nobody});
  EXPECT_NEAR(watch.takeovers.median_s(), 0.5 * (2.0 + 2.2), 1e-12) << "1 s, 2 s, 2.2 s, longer";
}

TEST(Takeovers, TheNextWorkerOfATargetMayDieToo) {
  Watch watch(1);
  watch.see({0});
  watch.alive[0] = 0;
  watch.see({nobody}, 10);
  watch.see({1});
  watch.alive[1] = 0;
  watch.see({nobody}, 20);
  watch.see({2});
  EXPECT_EQ(watch.takeovers.lost(), 2U);
  EXPECT_NEAR(watch.takeovers.median_s(), 1.5, 1e-12);
}

TEST(Takeovers, ATargetThatIsGivenUpMeanwhileDoesNotCountAndOneMayBeAdded) {
  Watch watch(1);
  watch.see({0});
  watch.alive[0] = 0;
  watch.see({nobody}, 5);
  watch.targets[0].active = false;
  watch.see({nobody});
  EXPECT_EQ(watch.takeovers.lost(), 0U);
  watch.targets.emplace_back();
  watch.see({nobody, 1});
  watch.alive[1] = 0;
  watch.see({nobody, nobody}, 4);
  watch.see({nobody, 2});
  EXPECT_NEAR(watch.takeovers.median_s(), 0.4, 1e-12);
}

}  // namespace
}  // namespace banyan::measure
