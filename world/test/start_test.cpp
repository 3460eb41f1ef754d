// SPDX-License-Identifier: MIT
// From every start that is connected the swarm stays in one piece: watched from outside, by distances alone,
// from the first tick on. BANYAN_LONG=1 watches many more.
#include <gtest/gtest.h>

#include <numeric>
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

// In how many pieces those nearer than C to one another lie.
int pieces(const World& world, double range_m) {
  const auto at = world.positions();
  std::vector<std::size_t> piece(at.size());
  std::iota(piece.begin(), piece.end(), std::size_t{0});
  const auto head = [&](std::size_t i) {
    while (piece[i] != i) i = piece[i];
    return i;
  };
  for (std::size_t i = 0; i < at.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (norm(at[i] - at[j]) < range_m) piece[head(i)] = head(j);
  int count = 0;
  for (std::size_t i = 0; i < at.size(); ++i) count += static_cast<int>(piece[i] == i);
  return count;
}

class EveryStart : public testing::TestWithParam<ConnectedStart> {};

TEST_P(EveryStart, StaysInOnePiece) {
  const std::uint64_t seeds = long_search() ? 80 : 2;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const Scenario scenario = scenario_of(GetParam(), seed);
    World world(scenario);
    ASSERT_EQ(pieces(world, scenario.radio.range_m), 1) << "seed " << seed;
    while (world.tick() < 600) {
      world.step();
      ASSERT_EQ(pieces(world, scenario.radio.range_m), 1) << "seed " << seed << ", tick " << world.tick();
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
