// SPDX-License-Identifier: MIT
// No length, time or speed of the world is its own: with all lengths and speeds, or all times, multiplied by a power of
// two it is the same world, bit for bit. Without the body box2d, which has metres inside.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "banyan/controller/core/digest.hpp"
#include "scaled.hpp"
#include "toy_swarm.hpp"
#include "worlds.hpp"

namespace banyan::world {
namespace {

// All noise, every kind of obstacle and of event; many contacts.
Scenario busy() {
  Scenario s;
  s.seed = 7;
  s.swarm.robots = 40;
  s.targets = RingTargets{5, 3.0, 0.3, {0.1, -0.2}};
  s.radio.line_of_sight = true;
  s.radio.loss = 0.2;
  s.radio.range_noise_m = 0.7;  // so much that ranges below nothing are drawn
  s.radio.bearing_noise_rad = 0.05;
  s.robot.wheel_noise = 0.1;
  s.robot.wheel_bias = 0.05;
  s.robot.odometry_noise = 0.05;
  s.obstacles = {Disc{{1.6, 1.3}, 0.3}, Box{{-1.7, 0.3}, {0.5, 0.9}, 0.4}, Wall{{0.2, -1.7}, {1.4, -1.5}}};
  s.events = {{.time_s = 1.0, .action = Die{3}},
              {.time_s = 1.7, .action = Freeze{5, 0.9}},
              {.time_s = 2.3, .action = Kill{.count = 4, .every_s = 0.3}},
              {.time_s = 2.9, .action = MoveTarget{1, {2.0, 2.0}, 0.13}},
              {.time_s = 3.1, .action = AddTarget{{-2.5, -1.0}}},
              {.time_s = 3.3, .action = Blackout{0.4}},
              {.time_s = 4.1, .action = AddObstacle{{0.0, 0.9}, 0.25}},
              {.time_s = 4.9, .action = MoveObstacle{0, {1.1, 1.2}}},
              {.time_s = 0.7, .when = Event::When::half_way, .action = SetLoss{0.6}},
              {.time_s = 7.3, .action = RemoveTarget{0}}};
  return s;
}

// What a world is now, with its lengths as multiples of `length`.
std::uint64_t state_of(const World& world, double length) {
  Digest digest;
  for (std::size_t i = 0; i < world.size(); ++i) {
    digest.add(world.positions()[i] * (1.0 / length));
    digest.add(world.headings()[i]);
    digest.add(world.alive()[i]);
    world.swarm().add_to(digest, i);
    for (const std::uint32_t j : world.links(i)) digest.add(j);
  }
  for (const auto& [i, j] : world.blocked()) {
    digest.add(i);
    digest.add(j);
  }
  for (const Target& target : world.targets()) {
    digest.add(target.position * (1.0 / length));
    digest.add(target.active);
  }
  for (const double level : world.charge()) digest.add(level);
  digest.add(world.packets_received());
  return digest.value();
}

void expect_same_at_every_scale(const Scenario& scenario, const Algorithm& algorithm, int ticks) {
  World world(scenario, algorithm);
  std::vector<std::uint64_t> states{state_of(world, 1.0)};
  for (int t = 0; t < ticks; ++t) {
    world.step();
    states.push_back(state_of(world, 1.0));
  }
  EXPECT_GT(world.packets_received(), 1000U);
  for (const Factors factors : {Factors{0.25, 1.0}, Factors{2.0, 1.0}, Factors{16.0, 1.0}, Factors{1.0, 0.5},
                                Factors{1.0, 2.0}, Factors{4.0, 0.25}, Factors{0x1p-7, 1.0}, Factors{0x1p15, 8.0}}) {
    SCOPED_TRACE("lengths times " + std::to_string(factors.length) + ", times " + std::to_string(factors.time));
    World other(multiplied(scenario, factors), algorithm);
    ASSERT_EQ(state_of(other, factors.length), states[0]) << "at the start";
    for (int t = 0; t < ticks; ++t) {
      other.step();
      ASSERT_EQ(state_of(other, factors.length), states[static_cast<std::size_t>(t) + 1]) << "after tick " << t;
      ASSERT_EQ(other.time_s(), factors.time * scenario.tick_s * (t + 1));
    }
  }
}

void expect_same_at_every_scale(const Scenario& scenario) {
  constexpr ToyAlgorithm toy;
  expect_same_at_every_scale(scenario, toy, 120);
}

TEST(Scale, TheWorldHasNone) { expect_same_at_every_scale(busy()); }

TEST(Scale, PointMassesHaveNone) {
  Scenario s = busy();
  s.robot.body = BodyModel::linear;
  expect_same_at_every_scale(s);
}

TEST(Scale, ClocksAndLatencyHaveNone) {
  Scenario s = busy();
  s.radio.latency_ticks = 3;
  expect_same_at_every_scale(s);
  s.clocks = {.asynchronous = true, .drift = 0.1, .substeps = 4};
  expect_same_at_every_scale(s);
}

TEST(Scale, NoModelOfTheRadioHasOne) {
  for (const auto model : {RadioModel::Model::bursts, RadioModel::Model::path_loss, RadioModel::Model::one_way}) {
    Scenario s = busy();
    s.radio.model = model;
    s.radio.shadowing_s = 1.3;
    expect_same_at_every_scale(s);
  }
  Scenario s = busy();
  s.radio.sight_leak = 0.3;
  expect_same_at_every_scale(s);
}

TEST(Scale, NoStartHasOne) {
  for (const Layout layout :
       {Layout::grid, Layout::line, Layout::ring, Layout::cross, Layout::bridge, Layout::random}) {
    Scenario s = busy();
    s.swarm.start.layout = layout;
    if (layout != Layout::grid && layout != Layout::random) s.obstacles = {};
    if (s.obstacles.empty())
      std::erase_if(s.events, [](const Event& e) { return std::holds_alternative<MoveObstacle>(e.action); });
    expect_same_at_every_scale(s);
  }
}

TEST(Scale, BatteriesHaveNone) {
  Scenario s = busy();
  s.battery.model = Battery::Model::power;
  s.battery.capacity_j = 100.0;
  s.battery.places = {{0.5, 1.8}};
  expect_same_at_every_scale(s);
  s.battery.model = Battery::Model::time_motion;
  s.battery.charge_per_s = 0.01;
  s.battery.charge_per_m = 0.1;
  expect_same_at_every_scale(s);
}

// Its robots do, know and say the same, to the last bit: behind the gate there is no metre and no second.
class ScaleOf : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, ScaleOf,
                         testing::Values("outwards", "inwards", "convoy", "caravan", "link-consensus", "mst", "fiedler",
                                         "cohesion", "chains", "branches"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_P(ScaleOf, AnAlgorithmHasNone) {
  const Algorithm& algorithm = *algorithms().find(GetParam());
  for (const char* reading : {"corrected", "literal"}) {
    Scenario s = busy();
    s.radio.range_noise_m = 0.1;
    s.mission.reading = reading;
    expect_same_at_every_scale(s, algorithm, 300);
    if (!algorithm.knows_readings()) break;
  }
}

TEST(Scale, RobotsOnBatteriesHaveNone) {
  Scenario s = busy();
  s.battery.model = Battery::Model::power;
  s.battery.capacity_j = 500.0;
  s.battery.places = {{0.5, 1.8}};
  expect_same_at_every_scale(s, convoy(), 300);
}

// Else all the others prove little: this length is multiplied in none of them.
TEST(Scale, AWorldInWhichOneLengthStaysIsAnother) {
  constexpr ToyAlgorithm toy;
  Scenario larger = multiplied(busy(), {2.0, 1.0});
  larger.robot.radius_m *= 0.5;
  World world(busy(), toy), other(larger, toy);
  for (int t = 0; t < 20; ++t) world.step(), other.step();
  EXPECT_NE(state_of(other, 2.0), state_of(world, 1.0));
}

}  // namespace
}  // namespace banyan::world
