// SPDX-License-Identifier: MIT
// Silences against a count over whole histories, on made-up edges and on a recorded run.
#include "banyan/measure/silence.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "banyan/algorithms/inside.hpp"
#include "banyan/measure/observer.hpp"
#include "banyan/world/random.hpp"
#include "plain_scenario.hpp"

namespace banyan::measure {
namespace {

using world::Scenario;
using world::World;

TEST(Silence, IsLongOnceItLastsLongerThanTheLimit) {
  Silence silence(0.5, 0.1);
  for (int tick = 1; tick <= 8; ++tick) {
    silence.next_tick();
    EXPECT_EQ(silence.is_long(3, 7), tick > 5) << tick;
    EXPECT_EQ(silence.is_long(7, 3), tick > 5) << "whichever end tells, and twice";
  }
  silence.next_tick();
  EXPECT_FALSE(silence.is_long(3, 8)) << "another edge";
  silence.next_tick();
  EXPECT_FALSE(silence.is_long(3, 7)) << "heard in between: it begins anew";
}

// 0.7F is less than seven times 0.1.
TEST(Silence, CountsWholeTicks) {
  for (int limit = 0; limit < 30; ++limit) {
    Silence silence(static_cast<double>(static_cast<float>(0.1 * limit)), 0.1);
    int ticks = 0;
    do {
      silence.next_tick();
      ++ticks;
    } while (!silence.is_long(1, 2));
    EXPECT_EQ(ticks, limit + 1);
  }
}

using Ends = std::pair<RobotId, RobotId>;
using History = std::vector<std::set<Ends>>;  // per tick, the edges without a link

// Ticks up to and including the last one of which each has this edge without a link.
std::size_t silent_ticks(const History& history, Ends ends) {
  std::size_t ticks = 0;
  while (ticks < history.size() && history[history.size() - 1 - ticks].contains(ends)) ++ticks;
  return ticks;
}

TEST(Silence, AgreesWithACountOverTheWholeHistory) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Silence silence(0.4, 0.1);
    History history;
    for (std::uint64_t tick = 0; tick < 200; ++tick) {
      history.emplace_back();
      silence.next_tick();
      std::vector<Ends> edges;
      for (std::uint64_t edge = 0; edge < 30; ++edge)
        if (world::to_uniform(world::bits(seed, world::Purpose::loss, edge, tick / 3, tick % 7)) < 0.6)
          edges.emplace_back(static_cast<RobotId>(edge * 7 % 30), static_cast<RobotId>(edge * 11 % 30 + 30));
      if (tick % 2 == 0) std::reverse(edges.begin(), edges.end());
      history.back().insert(edges.begin(), edges.end());
      for (const Ends& ends : edges)
        ASSERT_EQ(silence.is_long(ends.second, ends.first), silent_ticks(history, ends) > 4) << tick;
    }
  }
}

TEST(Silence, TakesIFromTheTableOfTheAlgorithm) {
  Scenario s = world::plain_scenario();
  s.swarm.robots = 9;
  s.mission.algorithm = "outwards";
  EXPECT_NEAR(liveness_period_s(World(s)), 1.2, 1e-6);
  s.mission.algorithm = "inwards";
  EXPECT_NEAR(liveness_period_s(World(s)), 0.5, 1e-6);
  s.mission.parameters = {{"liveness_rounds", 9.0}};
  EXPECT_NEAR(liveness_period_s(World(s)), 0.9, 1e-6);
  World world(s);
  EXPECT_NEAR(Observer(world).result(world).liveness_period_s, 0.9, 1e-6);
}

// A run kept tick by tick and counted afterwards: edges from reports, links by distance and by World::links.
struct Kept {
  History silent;
  std::vector<std::uint32_t> edges;  // per tick, broken for longer than I, as many as there are
  void add(const World& world, std::size_t limit_ticks) {
    std::vector<Ends> found;
    for (std::size_t i = 0; i < world.size(); ++i) {
      const Report& r = world.reports()[i];
      if (world.alive()[i] == 0 || r.role == Role::spare) continue;
      std::vector<RobotId> ups{r.parent};
      if (r.old_parent != r.parent) ups.push_back(r.old_parent);
      for (const RobotId up : ups) {
        if (up == nobody) continue;
        const auto links = world.links(i);
        if (std::find(links.begin(), links.end(), std::uint32_t{up}) == links.end())
          found.push_back(std::minmax(static_cast<RobotId>(i), up));
      }
    }
    silent.emplace_back(found.begin(), found.end());
    edges.push_back(static_cast<std::uint32_t>(std::count_if(
        found.begin(), found.end(), [&](const Ends& ends) { return silent_ticks(silent, ends) > limit_ticks; })));
  }
};

TEST(Silence, OfARunIsThatOfItsRecordedEdges) {
  struct Case {
    const char* algorithm;
    const char* reading;
    double leak;
    std::size_t limit_ticks;
  };
  std::uint64_t long_ones = 0;
  std::uint64_t short_ones = 0;
  for (const auto& [algorithm, reading, leak, limit_ticks] : {Case{"outwards", "literal", 0.0, 12},
                                                              {"inwards", "corrected", 0.0, 5},
                                                              {"inwards", "corrected", 0.18, 5},
                                                              {"convoy", "corrected", 0.18, 5}}) {
    Scenario s = world::plain_scenario();
    s.mission.algorithm = algorithm;
    s.mission.reading = reading;
    s.swarm.robots = 40;
    s.targets = world::RingTargets{3, 5.0};
    s.radio.line_of_sight = true;
    s.radio.sight_leak = leak;
    s.events = {{.time_s = 20.0, .action = world::Die{7}},
                {.time_s = 20.0, .action = world::Die{11}},
                {.time_s = 20.0, .action = world::Die{3}}};
    World world(s);
    Observer observer(world);
    Kept kept;
    std::uint64_t broken = 0;
    for (int t = 0; t < 800; ++t) {
      world.step();
      const Tick& tick = observer.observe(world);
      kept.add(world, limit_ticks);
      ASSERT_EQ(tick.broken_after_silence, kept.edges.back()) << algorithm << ", tick " << t;
      ASSERT_LE(tick.broken_after_silence, tick.broken_by_death + tick.broken_by_distance + tick.broken_by_occlusion);
      broken += tick.broken_after_silence > 0 ? 1 : 0;
    }
    const measure::Run run = observer.result(world);
    EXPECT_EQ(run.broken_ticks_after_silence, broken);
    EXPECT_NEAR(run.disconnected_time_ratio_after_silence, static_cast<double>(broken) / 800.0, 1e-12);
    long_ones += broken;
    short_ones += run.broken_ticks - broken;
  }
  EXPECT_GT(long_ones, 50U);
  EXPECT_GT(short_ones, 50U);
}

}  // namespace
}  // namespace banyan::measure
