// SPDX-License-Identifier: MIT
// From every start that is connected the swarm stays in one piece: watched from outside, by distances alone,
// from the first tick on. BANYAN_LONG=1 watches many more.
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "worlds.hpp"

namespace banyan::world {
namespace {

struct ConnectedStart {
  std::string start;
  Layout layout;
  double pitch;  // of the radio range
  std::size_t robots;
  std::string algorithm;
  double loss;
};

void PrintTo(const ConnectedStart& c, std::ostream* out) {
  *out << c.start << ", " << c.algorithm << ", loss " << c.loss;
}

std::vector<ConnectedStart> connected_starts() {
  std::vector<ConnectedStart> all;
  for (const char* algorithm : {"convoy", "outwards", "inwards"})
    for (const double loss : {0.0, 0.2}) {
      all.push_back({"line", Layout::line, 0.92, 24, algorithm, loss});
      all.push_back({"ring", Layout::ring, 0.92, 32, algorithm, loss});
      all.push_back({"cross", Layout::cross, 0.9, 33, algorithm, loss});
      all.push_back({"bridge", Layout::bridge, 0.16, 35, algorithm, loss});
      all.push_back({"random", Layout::random, 0.3, 40, algorithm, loss});
      all.push_back({"loose", Layout::hexagonal, 0.93, 37, algorithm, loss});
      all.push_back(
          {"nearly_broken", Layout::hexagonal, 0.975, 19, algorithm, loss});  // drawn together before anybody leaves
    }
  return all;
}

Scenario scenario_of(const ConnectedStart& c, std::uint64_t seed) {
  Scenario s = ring(c.algorithm, c.robots, 3, 7.0, seed);
  s.swarm.start.layout = c.layout;
  s.swarm.start.pitch_share = c.pitch;
  s.radio.loss = c.loss;
  return s;
}

class EveryStart : public testing::TestWithParam<ConnectedStart> {};

TEST_P(EveryStart, StaysInOnePiece) {
  const std::uint64_t seeds = long_search() ? 80 : 2;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    World world(scenario_of(GetParam(), seed));
    ASSERT_EQ(parts_by_range(world), 1U) << "seed " << seed;
    while (world.tick() < 600) {
      world.step();
      ASSERT_EQ(parts_by_range(world), 1U) << "seed " << seed << ", tick " << world.tick();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllStarts, EveryStart, testing::ValuesIn(connected_starts()),
                         [](const testing::TestParamInfo<ConnectedStart>& info) {
                           return info.param.start + "_" + info.param.algorithm +
                                  (info.param.loss > 0.0 ? "_lossy" : "");
                         });

}  // namespace
}  // namespace banyan::world
