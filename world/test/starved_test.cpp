// SPDX-License-Identifier: MIT
// Missions in which one worker waited long for a spare though most robots were spare: it hung on a worker that stood at
// its target and that nobody can tow. They took 1.6 to 3 times the straight drive.
#include <gtest/gtest.h>

#include <algorithm>

#include "banyan/world/world.hpp"
#include "plain_scenario.hpp"
#include "worlds.hpp"

namespace banyan::world {
namespace {

struct Mission {
  std::uint64_t seed;
  std::size_t targets;
  double radius_m;
  std::size_t robots;
  double loss;
  bool line_of_sight;
};

Scenario scenario_of(const Mission& m) {
  Scenario s = plain_scenario();
  s.seed = m.seed;
  s.mission.algorithm = "convoy";
  s.targets = RandomTargets{m.targets, m.radius_m, {}};
  s.swarm.robots = m.robots;
  s.radio.loss = m.loss;
  s.radio.line_of_sight = m.line_of_sight;
  s.mission.time_limit_s = 200.0;
  return s;
}

// A straight drive of the worker that has the longest one.
double straight_drive_s(const World& world) {
  double longest_m = 0.0;
  for (const Target& t : world.targets())
    longest_m =
        std::max(longest_m, distance(world.positions()[t.worker], t.position) - target_tolerance_m(world.scenario()));
  return longest_m / world.scenario().robot.wheel_limit_m_s;
}

double longest_edge_m(const World& world) {
  double longest_m = 0.0;
  for (std::size_t i = 0; i < world.size(); ++i) {
    const Report& r = world.reports()[i];
    if (r.role == Role::spare || r.role == Role::root) continue;
    for (const RobotId up : {r.parent, r.old_parent})
      if (up < world.size()) longest_m = std::max(longest_m, distance(world.positions()[i], world.positions()[up]));
  }
  return longest_m;
}

class Starved : public testing::TestWithParam<Mission> {};

TEST_P(Starved, NobodyWaitsForASpareForLong) {
  World world(scenario_of(GetParam()));
  const double limit_s = 1.6 * straight_drive_s(world);
  double longest_m = 0.0;
  while (!all_held(world) && world.time_s() < limit_s) {
    world.step();
    longest_m = std::max(longest_m, longest_edge_m(world));
  }
  EXPECT_TRUE(all_held(world)) << "not within " << limit_s << " s";
  EXPECT_LT(longest_m, world.scenario().radio.range_m);
}

INSTANTIATE_TEST_SUITE_P(Missions, Starved,
                         testing::Values(Mission{4037996777, 10, 7.69, 73, 0.17,
                                                 false},                                // 2.99 times the straight drive
                                         Mission{67568779, 8, 8.36, 63, 0.16, false},   // 2.27
                                         Mission{3229455640, 4, 5.31, 17, 0.16, true},  // 2.00
                                         Mission{573739842, 12, 8.60, 176, 0.06, false},  // 1.97
                                         Mission{925947508, 8, 8.16, 175, 0.22, true},    // 1.76
                                         Mission{1985480412, 3, 5.24, 49, 0.27, true}));  // 1.63

}  // namespace
}  // namespace banyan::world
