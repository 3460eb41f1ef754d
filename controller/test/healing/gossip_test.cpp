// SPDX-License-Identifier: MIT
// Points told to a neighbour: exact although both move and turn between writing and reading.
#include "healing/healing.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>

#include "banyan/controller/core/edge_frame.hpp"
#include "watch.hpp"

namespace banyan {
namespace {

RC_GTEST_PROP(Gossip, APointArrivesWhereItIs, ()) {
  const auto number = [](int low, int high) { return static_cast<float>(*rc::gen::inRange(low, high)) * 0.001F; };
  const auto rotation = [&] {
    const float a = number(-3141, 3142);
    return Vec2{std::cos(a), std::sin(a)};
  };
  // World coordinates: the sender writes at t, the reader has moved by `odometry` at t + 1.
  const Vec2 sender{number(150, 900), number(-450, 450)};
  const Vec2 sender_heading = rotation();
  const Vec2 reader_heading = rotation();
  const Vec2 point{number(-4500, 4500), number(-4500, 4500)};
  const Odometry odometry{number(0, 10), 0.0F, number(-400, 400)};
  // Written as gossip.cpp does: point - addressee, in the sender's frame, in the edge frame.
  const Vec2 addressee = rotate_back(sender_heading, -sender);
  const Vec2 v = to_edge_frame(rotate_back(sender_heading, point - sender) - addressee, addressee);

  ConvoyBench bench = grown<Convoy>();
  bench.put(5, rotate_back(reader_heading, sender));
  bench.tick();
  const Vec2 reader = rotate(reader_heading, {odometry.forward_m, 0.0F});
  const Vec2 heading = rotate(reader_heading, {std::cos(odometry.turn_rad), std::sin(odometry.turn_rad)});
  const Vec2 sender_moved = sender + Vec2{0.01F, -0.005F};
  bench.move(5, rotate_back(heading, sender_moved - reader));
  const ConvoyRobot robot = bench.tick(odometry);

  Vec2 read;
  RC_ASSERT(robot.read_point(robot.heard[0], Coordinate::of(v.x), Coordinate::of(v.y), read));
  RC_ASSERT(distance(read, rotate_back(heading, point - reader)) < 0.004F);
}

TEST(Gossip, NoPointFromWhomIHaveNotHeardTheTickBefore) {
  ConvoyBench bench = grown<Convoy>();
  bench.put(5, {0.5F, 0.0F});
  Vec2 point;
  const ConvoyRobot first = bench.tick();
  EXPECT_FALSE(first.read_point(first.heard[0], Coordinate::of(0.5F), {}, point));
  const ConvoyRobot second = bench.tick();
  EXPECT_TRUE(second.read_point(second.heard[0], Coordinate::of(0.5F), {}, point));
}

TEST(Gossip, EveryPairOfNeighbourAndTargetHasItsTurn) {
  Watch watch;
  watch.tell_of_target(20, {0.5F, 0.0F}, {1.5F, 0.0F}, 50, 1);
  watch.bench.steps(2);
  watch.tell_of_target(21, {0.0F, 0.5F}, {0.0F, 1.5F}, 51, 1);
  watch.bench.steps(2);
  ASSERT_EQ(watch.bench.state.task_count, 2);
  watch.bench.put(22, {0.0F, -0.5F});
  watch.bench.step();
  std::map<std::pair<RobotId, RobotId>, int> told;
  for (int k = 0; k < 8; ++k) {
    const auto m = watch.bench.step().message;
    ++told[{m.told, m.task_serves}];
  }
  EXPECT_EQ(told.size(), 8U);  // 4 neighbours, 2 targets
}

}  // namespace
}  // namespace banyan
