// SPDX-License-Identifier: MIT
// Missions in which convoy once did wrong, by the day on which it was found. A scar that has not hurt for a year may
// go.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "banyan/world/world.hpp"
#include "plain_scenario.hpp"
#include "worlds.hpp"

namespace banyan::world {
namespace {

struct Scar {
  const char* day;
  const char* what;
  std::uint64_t seed;
  std::size_t robots;
  double loss;
  bool line_of_sight;
  Targets targets;
  double pitch_share;  // of a start as a ring; 0: a compact start
};

Scenario scenario_of(const Scar& scar) {
  Scenario s = plain_scenario();
  s.seed = scar.seed;
  s.mission.algorithm = "convoy";
  s.mission.time_limit_s = 200.0;
  s.targets = scar.targets;
  s.swarm.robots = scar.robots;
  s.radio.loss = scar.loss;
  s.radio.line_of_sight = scar.line_of_sight;
  if (scar.pitch_share > 0.0) {
    s.swarm.start.layout = Layout::ring;
    s.swarm.start.pitch_share = scar.pitch_share;
    s.swarm.start.jitter_m = 0.01;
  }
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

constexpr const char* starved = "a worker waited for a spare behind one that stood at its target";  // 1.6 to 3 drives
constexpr const char* late_news = "news of a living worker came all the way round a ring that had opened, too late";

const Scar scars[] = {
    {"2026-11-22", starved, 4037996777, 73, 0.17, false, RandomTargets{10, 7.69, {}}, 0.0},
    {"2026-11-22", starved, 67568779, 63, 0.16, false, RandomTargets{8, 8.36, {}}, 0.0},
    {"2026-11-22", starved, 3229455640, 17, 0.16, true, RandomTargets{4, 5.31, {}}, 0.0},
    {"2026-11-22", starved, 573739842, 176, 0.06, false, RandomTargets{12, 8.60, {}}, 0.0},
    {"2026-11-22", starved, 925947508, 175, 0.22, true, RandomTargets{8, 8.16, {}}, 0.0},
    {"2026-11-22", starved, 1985480412, 49, 0.27, true, RandomTargets{3, 5.24, {}}, 0.0},
    {"2026-11-23", late_news, 3215682349, 30, 0.0, false,
     std::vector<Vec2>{{-2.815506721799992, -0.811062204457257},
                       {-1.1213257624224, -2.7069408073557537},
                       {1.4172363669362518, -2.564437770785862},
                       {-2.389553693791654, 1.6955627810505423}},
     0.92},
    {"2026-11-23", late_news, 2743973988, 27, 0.25, false,
     std::vector<Vec2>{{6.769058340458516, -3.182092431016443},
                       {6.749460302027439, 2.6875108125994567},
                       {3.4239714881199816, 3.449127476743423},
                       {-1.3148695585539196, 6.831919424199233},
                       {2.828919219185177, -6.059887560885514}},
     0.48},
};

class Scars : public testing::TestWithParam<Scar> {};

// Compact starts within 1.6 straight drives; from a ring, a minute in which no living worker is replaced.
TEST_P(Scars, HaveHealed) {
  const Scar& scar = GetParam();
  SCOPED_TRACE(std::string(scar.day) + ": " + scar.what);
  World world(scenario_of(scar));
  const bool from_ring = scar.pitch_share > 0.0;
  const double limit_s = from_ring ? 60.0 : 1.6 * straight_drive_s(world);
  double longest_m = 0.0;
  while (world.time_s() < limit_s && (from_ring || !all_held(world))) {
    world.step();
    if (!from_ring) longest_m = std::max(longest_m, longest_edge_m(world));
  }
  if (!from_ring) { EXPECT_TRUE(all_held(world)) << "not within " << limit_s << " s"; }
  EXPECT_LT(longest_m, world.scenario().radio.range_m);
  for (const Report& report : world.reports()) EXPECT_EQ(report.tally.replacements, 0U);
}

INSTANTIATE_TEST_SUITE_P(All, Scars, testing::ValuesIn(scars));

}  // namespace
}  // namespace banyan::world
