// SPDX-License-Identifier: MIT
// Connectivity against shortest ways between all robots, from their positions alone.
#include "banyan/measure/connectivity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "banyan/measure/observer.hpp"
#include "plain_scenario.hpp"

namespace banyan::measure {
namespace {

// A base, and a vehicle that is too fast for the swarm now and then.
world::Scenario torn() {
  world::Scenario s = world::plain_scenario();
  s.mission.stop_when_complete = false;
  s.mission.time_limit_s = 120.0;
  s.swarm.robots = 7;
  s.targets = std::vector<world::Vec2>{{-1.5, 1.0}};
  s.stations = {{.name = "base", .position = {0.0, -0.7}},
                {.name = "vehicle",
                 .position = {0.9, 0.0},
                 .course = {{5.0, 0.0}},
                 .speed_m_s = 0.4,
                 .pause_s = 10.0,
                 .loop = true}};
  return s;
}

// Floyd and Warshall: hops, and of ways with as few the least longest link.
struct Way {
  int hops = 1'000'000;
  double longest = std::numeric_limits<double>::infinity();
};
std::vector<std::vector<Way>> ways(const world::World& world) {
  const std::size_t n = world.size();
  std::vector<std::vector<Way>> way(n, std::vector<Way>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const double d = distance(world.positions()[i], world.positions()[j]);
      if (i == j) way[i][j] = {0, 0.0};
      else if (d < world.scenario().radio.range_m) way[i][j] = {1, d};
    }
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        const Way over{way[i][k].hops + way[k][j].hops, std::max(way[i][k].longest, way[k][j].longest)};
        if (over.hops < way[i][j].hops || (over.hops == way[i][j].hops && over.longest < way[i][j].longest))
          way[i][j] = over;
      }
  return way;
}

TEST(Connectivity, IsWhatShortestWaysBetweenAllRobotsSay) {
  for (const bool all_pairs : {true, false}) {
    world::Scenario s = torn();
    if (!all_pairs) s.mission.connect = {{"vehicle", "base"}};
    world::World world(s);
    Observer observer(world);
    int ticks = 0, connected = 0, apart = 0, longest_apart = 0, breaks = 0, paths = 0, hops = 0;
    std::vector<int> by_pair(3, 0);
    double longest = 0.0, first_s = -1.0, last_s = -1.0;
    while (!observer.finished()) {
      world.step();
      observer.observe(world);
      ++ticks;
      const auto way = ways(world);
      const std::size_t none = world.size(), base = 7, vehicle = 8, target = world.holder(0).value_or(none);
      std::vector<std::pair<std::size_t, std::size_t>> pairs{{base, vehicle}};
      if (all_pairs) pairs.insert(pairs.end(), {{base, target}, {vehicle, target}});
      bool all = true;
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        const auto [a, b] = pairs[k];
        if (a == none || b == none || way[a][b].hops > 1000) {
          all = false;
          continue;
        }
        ++by_pair[k];
        ++paths;
        hops += way[a][b].hops;
        longest += way[a][b].longest;
      }
      connected += all ? 1 : 0;
      if (!all) {
        if (apart == 0) ++breaks;
        if (first_s < 0.0) first_s = world.time_s();
        last_s = world.time_s();
      }
      apart = all ? 0 : apart + 1;
      longest_apart = std::max(longest_apart, apart);
    }
    const auto run = observer.result(world);
    ASSERT_GT(breaks, 1) << "nothing ever broke: the test shows little";
    ASSERT_GT(connected, 100);
    const auto share = [&](int n) { return static_cast<double>(n) / ticks; };
    EXPECT_DOUBLE_EQ(run.connected_time_ratio, share(connected));
    const auto end = by_pair.begin() + (all_pairs ? 3 : 1);
    EXPECT_DOUBLE_EQ(run.least_connected_time_ratio, share(*std::min_element(by_pair.begin(), end)));
    EXPECT_EQ(run.disconnections, breaks);
    EXPECT_NEAR(run.longest_disconnection_s, 0.1 * longest_apart, 1e-9);
    EXPECT_DOUBLE_EQ(run.first_disconnection_s, first_s);
    EXPECT_DOUBLE_EQ(run.last_disconnection_s, last_s);
    EXPECT_NEAR(run.hops, static_cast<double>(hops) / paths, 1e-9);
    EXPECT_NEAR(run.longest_hop_m, longest / paths, 1e-9);
  }
}

TEST(Connectivity, IsNotMeasuredWhereNobodyAsks) {
  world::Scenario s = world::plain_scenario();
  world::World world(s);
  Observer observer(world);
  for (int t = 0; t < 20; ++t) {
    world.step();
    observer.observe(world);
  }
  EXPECT_LT(observer.result(world).connected_time_ratio, 0.0);
}

}  // namespace
}  // namespace banyan::measure
