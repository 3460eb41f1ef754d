// SPDX-License-Identifier: MIT
// How long a neighbour may be silent follows the share of packets that are lost.
#include "banyan/controller/healing/healing.hpp"

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
      if (static_cast<float>(random() % 10000) >= loss * 10000.0F) bench.put(id, {0.05F * static_cast<float>(id), 1.0F});
    }
    bench.step();
  }
  const float wanted = std::log(1e-5F) / std::log(loss);
  RC_ASSERT(static_cast<float>(bench.state.loss_ticks) > 0.75F * wanted);
  RC_ASSERT(static_cast<float>(bench.state.loss_ticks) < 1.35F * wanted + 2.0F);
}

TEST(Loss, NobodyWaitsLongerWhereNothingIsLost) {
  Watch watch;
  for (RobotId id = 20; id < 24; ++id) watch.bench.put(id, {0.1F * static_cast<float>(id), 0.5F});
  watch.hear_root(200);
  watch.bench.silence(20);  // a death is no loss
  watch.hear_root(3);
  EXPECT_LE(watch.bench.state.loss_ticks, watch.bench.params.ticks(watch.bench.params.liveness_period_s));
}

TEST(Loss, AConnectorWaitsForItsChildAsLongAsAPacketMayBeLost) {
  const auto ticks_as_connector = [](std::uint16_t loss_ticks) {
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
  EXPECT_EQ(ticks_as_connector(0), 11);  // connector_patience_s, and the tick in which it is over
  EXPECT_EQ(ticks_as_connector(66), 67);
}

}  // namespace
}  // namespace banyan
