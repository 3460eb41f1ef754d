// SPDX-License-Identifier: MIT
// How long a neighbour may be silent follows the share of packets that are lost.
#include "healing/healing.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>

#include "watch.hpp"

namespace banyan {
namespace {

RC_GTEST_PROP(Loss, LivenessFollowsTheShareOfPacketsLost, ()) {
  const float loss = static_cast<float>(*rc::gen::inRange(20, 80)) * 0.01F;
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  ConvoyBench bench = grown<Convoy>();
  for (int tick = 0; tick < 500; ++tick) {
    for (RobotId id = 20; id < 40; ++id) {
      bench.silence(id);
      if (static_cast<float>(random() % 10000) >= loss * 10000.0F)
        bench.put(id, {0.025F * static_cast<float>(id), 0.5F});
    }
    bench.step();
  }
  const float wanted = std::log(1e-5F) / std::log(loss);
  RC_ASSERT(static_cast<float>(bench.state.loss_ticks) > 0.75F * wanted);
  RC_ASSERT(static_cast<float>(bench.state.loss_ticks) < 1.35F * wanted + 2.0F);
}

TEST(Loss, NobodyWaitsLongerWhereNothingIsLost) {
  Watch watch;
  for (RobotId id = 20; id < 24; ++id) watch.bench.put(id, {0.05F * static_cast<float>(id), 0.25F});
  watch.hear_root(200);
  watch.bench.silence(20);  // a death is no loss
  watch.hear_root(3);
  EXPECT_LE(watch.bench.state.loss_ticks, whole(watch.bench.params.liveness_rounds));
}

// A neighbour falls silent: a robot can tell whether that has another reason than the radio.
TEST(Loss, OnlySilencesWithoutAnyOtherReasonAreTheRadios) {
  const auto after_losses = [](int losses, Vec2 at, Vec2 other, bool line_of_sight, bool obstacle) {
    ConvoyBench bench = grown<Convoy>();
    bench.params.line_of_sight = line_of_sight;
    bench.state.turn = 0;
    bench.put(21, other);
    if (obstacle) bench.obstacles.push_back({0.125F, 0.0F});
    for (int k = 0; k < losses; ++k) {
      bench.put(20, at);
      bench.steps(2);
      bench.silence(20);
      bench.step();
    }
    return static_cast<int>(bench.state.usual_silence);
  };
  EXPECT_EQ(after_losses(2, {0.5F, 0.0F}, {0.0F, 0.5F}, true, false), 0) << "they may be deaths";
  EXPECT_EQ(after_losses(3, {0.5F, 0.0F}, {0.0F, 0.5F}, true, false), 32);
  EXPECT_EQ(after_losses(3, {0.975F, 0.0F}, {0.0F, 0.5F}, true, false), 0) << "it may have gone out of range";
  EXPECT_EQ(after_losses(3, {0.5F, 0.0F}, {0.25F, 0.05F}, true, false), 0) << "a body hides it";
  EXPECT_EQ(after_losses(3, {0.5F, 0.0F}, {0.25F, 0.05F}, false, false), 32) << "bodies hide nobody";
  EXPECT_EQ(after_losses(3, {0.5F, 0.0F}, {0.0F, 0.5F}, true, true), 0) << "an obstacle may hide it";
  EXPECT_EQ(after_losses(3, {0.5F, 0.0F}, {0.0F, 0.5F}, false, true), 32) << "obstacles hide nobody";
}

// Deaths that are far apart do not add up to a bad radio.
TEST(Loss, SilencesOfLongAgoAreForgotten) {
  ConvoyBench bench = grown<Convoy>();
  for (const RobotId dead : {RobotId{20}, RobotId{21}, RobotId{22}, RobotId{23}}) {
    bench.put(dead, {0.5F, 0.0F});
    bench.steps(2);
    bench.silence(dead);
    bench.step();
    EXPECT_EQ(bench.state.usual_silence, 0) << dead;
    bench.steps(520);
  }
}

// Then silences that have ended say how long one may last. A child that comes back late makes patient.
TEST(Loss, PatienceFollowsTheSilencesThatHaveEnded) {
  ConvoyBench bench = grown<Convoy>();
  bench.put(20, {0.5F, 0.0F});
  auto& child = bench.put(21, {0.0F, 0.5F});
  child.role = Role::worker;
  child.parent = bench.state.id;
  bench.steps(5);
  const auto said = child;
  bench.state.missed_in_the_clear = 2;
  bench.silence(20);
  bench.step();
  EXPECT_EQ(bench.state.usual_silence, 32);
  bench.silence(21);
  bench.steps(60);
  EXPECT_LE(bench.state.usual_silence, 32) << "a silence that lasts may be a death";
  bench.put(21, {0.0F, 0.5F}) = said;
  bench.step();
  EXPECT_EQ(bench.state.usual_silence, 60);
  bench.steps(200);
  EXPECT_LT(bench.state.usual_silence, 50);
  bench.steps(1000);
  EXPECT_EQ(bench.state.usual_silence, 0) << "nothing gets lost any more";
}

TEST(Loss, AConnectorWaitsForItsChildAsLongAsAPacketMayBeLost) {
  const auto ticks_as_connector = [](std::uint8_t loss_ticks) {
    ConvoyBench bench = grown<Convoy>();
    bench.state.role = Role::connector;
    bench.state.loss_ticks = loss_ticks;
    int ticks = 0;
    for (; bench.state.role == Role::connector && ticks < 1000; ++ticks) {
      auto robot = bench.tick();
      update_role(robot);
    }
    return ticks;
  };
  EXPECT_EQ(ticks_as_connector(0), 11);  // connector_rounds, and the tick in which it is over
  EXPECT_EQ(ticks_as_connector(66), 67);
}

}  // namespace
}  // namespace banyan
