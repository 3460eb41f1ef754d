// SPDX-License-Identifier: MIT
// Labels are taken once, along the shortest hop, and the echo tells the root when all have one.
#include "tree/label.hpp"

#include <gtest/gtest.h>

#include "bench.hpp"
#include "tree/parent_selection.hpp"

namespace banyan {
namespace {

ConvoyBench starting() {
  ConvoyBench bench;
  bench.state.epoch = 1;
  bench.state.phase = Phase::start_tree;
  bench.state.root = {1, 9};
  return bench;
}

TEST(Label, IsTheSmallestSumOfLabelAndRangeAndTakenOnce) {
  ConvoyBench bench = starting();
  bench.put(9, {0.9F, 0}).label = 0;     // 230
  bench.put(5, {0.25F, 0}).label = 128;  // 192
  bench.put(6, {0.05F, 0}).label = 243;  // 256
  bench.put(7, {0.05F, 0.05F});          // no label yet
  bench.step();
  EXPECT_EQ(bench.state.label, unknown_label) << "nearer ones may still speak up";
  bench.steps(2);
  EXPECT_EQ(bench.state.label, 192);
  EXPECT_EQ(bench.state.flood_parent, 5);
  bench.say(5).label = 10;
  bench.steps(5);
  EXPECT_EQ(bench.state.label, 192) << "fixed for the epoch";
}

// Along a line nobody stands between: the flood need not rest at each hop.
TEST(Label, WhoIsNotPatientWaitsOnlyForWhomItHears) {
  const auto ticks_until_labelled = [](Vec2 other, float labelled) {
    ConvoyBench bench = starting();
    bench.put(9, {labelled, 0}).label = 0;
    bench.put(5, other);
    for (int ticks = 1;; ++ticks) {
      auto robot = bench.tick();
      update_label(robot);
      if (bench.state.label != unknown_label) return ticks;
    }
  };
  EXPECT_EQ(ticks_until_labelled({-0.5F, 0}, 0.5F), 1) << "on the other side";
  EXPECT_EQ(ticks_until_labelled({0.7F, 0}, 0.5F), 1) << "farther than the one that has a label";
  EXPECT_EQ(ticks_until_labelled({0.25F, 0.1F}, 0.5F), 3);
}

TEST(Label, OfAnotherEpochCountsNothing) {
  ConvoyBench bench = starting();
  bench.put(9, {0.5F, 0}).label = 0;
  bench.say(9).epoch = 0;
  bench.steps(20);
  EXPECT_EQ(bench.state.label, unknown_label);
}

TEST(Label, TheEchoSumsTheFloodTree) {
  ConvoyBench bench = starting();
  bench.put(9, {0.5F, 0}).label = 0;
  for (const RobotId id : {RobotId{5}, RobotId{6}}) {
    auto& m = bench.put(id, {-0.25F, 0.05F * static_cast<float>(id)});
    m.label = 150;
    m.flood_parent = 1;
    m.flood_robots = 3;
    m.flood_workers = 1;
  }
  bench.steps(4);
  EXPECT_FALSE(bench.state.flood_done);
  bench.say(5).flood_done = true;
  EXPECT_FALSE(bench.step().message.flood_done);
  bench.say(6).flood_done = true;
  const auto output = bench.step();
  EXPECT_TRUE(output.message.flood_done);
  EXPECT_EQ(output.message.flood_robots, 7);
  EXPECT_EQ(output.message.flood_workers, 2);
  bench.put(7, {0.15F, 0});  // somebody without label appears
  EXPECT_FALSE(bench.step().message.flood_done);
}

TEST(Label, GrowsAlongEveryEdgeAndSaturates) {
  EXPECT_EQ(edge_label(0.0F), 1);
  EXPECT_EQ(edge_label(0.617F), 158);
  EXPECT_EQ(label_below(100, 0.25F), 164);
  EXPECT_EQ(label_below(unknown_label - 1, 1.0F), unknown_label - 1);
}

// 255.99 C from the root, along the tree: nothing fits behind that.
TEST(Label, ARobotAtTheEndOfTheScaleTakesNoChildAndReportsIt) {
  for (const std::uint16_t label : {largest_label, static_cast<std::uint16_t>(largest_label - 1)}) {
    auto child = grown<Convoy>();
    child.state.label = unknown_label;
    child.put_connector(2, {0.3F, 0}, label, 5);
    const ConvoyRobot robot = child.tick();
    EXPECT_EQ(is_ahead(robot, robot.table().find(2)), label != largest_label);
    auto parent = grown<Convoy>();
    parent.state.label = label;
    EXPECT_EQ(convoy_report(parent.state).out_of_scale, label == largest_label);
  }
}

}  // namespace
}  // namespace banyan
