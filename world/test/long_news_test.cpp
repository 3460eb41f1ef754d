// SPDX-License-Identifier: MIT
// Missions that begin as a ring of robots. It opens somewhere, and from then on news of a worker comes to the other end
// all the way round: there it was taken for dead and replaced, though it lived.
#include <gtest/gtest.h>

#include "banyan/world/world.hpp"
#include "plain_scenario.hpp"

namespace banyan::world {
namespace {

Scenario ring_start(std::uint64_t seed, std::size_t robots, double pitch_share, double loss,
                    std::vector<Vec2> targets) {
  Scenario s = plain_scenario();
  s.seed = seed;
  s.mission.algorithm = "convoy";
  s.swarm.robots = robots;
  s.swarm.start.layout = Layout::ring;
  s.swarm.start.pitch_share = pitch_share;
  s.swarm.start.jitter_m = 0.01;
  s.radio.loss = loss;
  s.targets = std::move(targets);
  return s;
}

std::uint32_t replacements(const Scenario& scenario, double until_s) {
  World world(scenario);
  while (world.time_s() < until_s) world.step();
  std::uint32_t count = 0;
  for (const Report& report : world.reports()) count += report.tally.replacements;
  return count;
}

TEST(LongNews, OfALivingWorkerComesBeforePatienceEnds) {
  EXPECT_EQ(replacements(ring_start(3215682349, 30, 0.92, 0.0,
                                    {{-2.815506721799992, -0.811062204457257},
                                     {-1.1213257624224, -2.7069408073557537},
                                     {1.4172363669362518, -2.564437770785862},
                                     {-2.389553693791654, 1.6955627810505423}}),
                         60.0),
            0U);
  EXPECT_EQ(replacements(ring_start(2743973988, 27, 0.48, 0.25,
                                    {{6.769058340458516, -3.182092431016443},
                                     {6.749460302027439, 2.6875108125994567},
                                     {3.4239714881199816, 3.449127476743423},
                                     {-1.3148695585539196, 6.831919424199233},
                                     {2.828919219185177, -6.059887560885514}}),
                         60.0),
            0U);
}

}  // namespace
}  // namespace banyan::world
