// SPDX-License-Identifier: MIT
#include "banyan/hosts/argos/robot.hpp"

#include <gtest/gtest.h>

#include <array>

#include "banyan/algorithms/algorithms.hpp"

namespace banyan::argos {
namespace {

const Algorithm& convoy() { return *algorithms().find("convoy"); }

ArgosRobot lone_worker(bool has_eyes = false) {
  return {convoy(), {}, Member{.id = 3, .worker = true, .root = false}, has_eyes};
}
ArgosRobot lone_root() { return {convoy(), {}, Member{.id = 1, .worker = false, .root = true}, false}; }

TEST(ArgosRobot, WhatOneSaysAnotherHears) {
  ArgosRobot root = lone_root();
  ArgosRobot worker = lone_worker();
  ArgosRobot alone = lone_worker();
  std::vector<std::uint8_t> message;
  ArgosRobot::Readings sent;
  sent.sent = true;
  sent.target = Vec2{3.0F, 0.0F};
  for (int k = 0; k < 20; ++k) {
    const Said said = root.step({});
    message.assign(said.message.begin(), said.message.end());
    worker.hear(message, {-0.5F, 0.0F});
    const Said answer = worker.step(sent);
    root.hear({answer.message.begin(), answer.message.end()}, {0.5F, 0.0F});  // it would be deaf to the worker
    (void)alone.step(sent);
  }
  EXPECT_EQ(worker.said().report.parent, 1);
  EXPECT_EQ(alone.said().report.parent, nobody);
}

TEST(ArgosRobot, SilenceAndRubbishAreNotHeard) {
  ArgosRobot robot = lone_worker(), undisturbed = lone_worker();
  const std::vector<std::uint8_t> silence(robot.message_bytes()), rubbish(robot.message_bytes(), 0xA5), shorter(3, 1);
  for (int k = 0; k < 5; ++k) {
    for (const auto& bytes : {silence, rubbish, shorter}) robot.hear(bytes, {0.4F, 0.0F});
    const Said one = robot.step({}), other = undisturbed.step({});
    EXPECT_TRUE(std::equal(one.message.begin(), one.message.end(), other.message.begin(), other.message.end()));
  }
}

// A robot seen by the proximity sensor is no obstacle, even if its packet of this step got lost; a wall is one.
TEST(ArgosRobot, RobotsAreNoObstacles) {
  const auto turns_away = [](bool is_robot, bool lost_lately) {
    ArgosRobot robot = lone_worker(true);
    ArgosRobot other = lone_root();
    ArgosRobot::Readings readings;
    readings.sent = true;
    readings.target = Vec2{3.0F, 0.0F};
    Said said;
    for (int k = 0; k < 30; ++k) {
      const Said words = other.step({});
      const std::vector<std::uint8_t> bytes(words.message.begin(), words.message.end());
      const Vec2 where = is_robot ? Vec2{0.17F, 0.02F} : Vec2{-0.5F, 0.0F};
      if (!lost_lately || k % 3 == 0) robot.hear(bytes, where);
      robot.see({0.1F, 0.012F});
      said = robot.step(readings);
    }
    return said.report.tally.rejected > 0 ? -1.0 : static_cast<double>(said.velocity.turn_rad_s);
  };
  const double wall = turns_away(false, false), robot = turns_away(true, false), robot_lossy = turns_away(true, true);
  EXPECT_NE(wall, robot);
  EXPECT_EQ(robot, robot_lossy);
}

}  // namespace
}  // namespace banyan::argos
