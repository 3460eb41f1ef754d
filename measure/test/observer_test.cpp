// SPDX-License-Identifier: MIT
// The account of a run, on worlds whose account can be told by hand or counted anew from outside.
#include "banyan/measure/observer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "banyan/algorithms/paper_algorithm.hpp"
#include "banyan/controller/core/trig.hpp"
#include "banyan/measure/fiedler.hpp"
#include "banyan/measure/recovery.hpp"
#include "banyan/measure/steiner.hpp"
#include "plain_scenario.hpp"

namespace banyan::measure {
namespace {

using world::Event;
using world::Scenario;
using world::Vec2;
using world::World;

Scenario ring(std::size_t robots, std::size_t targets, double radius_m, std::uint64_t seed = 1) {
  Scenario s = world::plain_scenario();
  s.swarm.robots = robots;
  s.targets = world::RingTargets{targets, radius_m};
  s.seed = seed;
  return s;
}

// Robots in a row along x, all frozen; the last one is the worker of a target 3 m further on.
Scenario chain(std::size_t robots, double pitch_m) {
  Scenario s = world::plain_scenario();
  s.swarm.start.layout = world::Layout::list;
  for (std::size_t i = 0; i < robots; ++i) {
    s.swarm.start.positions.push_back({static_cast<double>(i) * pitch_m, 0.0});
    s.events.push_back({.action = world::Freeze{i}});
  }
  s.swarm.robots = robots;
  s.swarm.root = 0;
  s.targets = std::vector<Vec2>{{static_cast<double>(robots - 1) * pitch_m + 3.0, 0.0}};
  s.mission.time_limit_s = 1000;
  s.mission.parameters = {{"give_up_after_drives", 30.0}};  // nor does the worker leave its target to others
  return s;
}

Tick after(World& world, Observer& observer, int ticks) {
  for (int t = 0; t < ticks; ++t) {
    world.step();
    observer.observe(world);
  }
  return observer.last();
}

TEST(Observer, CountsAChain) {
  World world(chain(6, 1.1));
  Observer observer(world);
  const Tick tick = after(world, observer, 150);
  EXPECT_EQ(tick.tick, 150U);
  EXPECT_NEAR(tick.time_s, 15.0, 1e-9);
  EXPECT_EQ(tick.alive, 6U);
  EXPECT_EQ(tick.roots, 1U);
  EXPECT_EQ(tick.workers, 1U);
  EXPECT_EQ(tick.connectors, 4U);
  EXPECT_EQ(tick.spares, 0U);
  EXPECT_EQ(tick.committed, 6U);
  EXPECT_EQ(tick.edges, 5U);
  EXPECT_EQ(tick.components, 1U);
  EXPECT_FALSE(tick.fiedler_low);
  EXPECT_EQ(tick.fiedler, -1.0);
  EXPECT_EQ(tick.targets_reached, 0U);
  EXPECT_NEAR(tick.worst_target_distance_m, 3.0, 1e-9);
  EXPECT_EQ(observer.run().broken_ticks, 0U);
}

// In a row whose robots reach the next one only, each pair of which one never hears the other is the end of a part.
TEST(Observer, CountsThePartsAtTheStartByLinksInBothDirections) {
  Scenario s = chain(30, 1.5);
  EXPECT_EQ(Observer(World(s)).run().start_parts, 1U);
  s.radio.model = world::RadioModel::Model::one_way;
  std::set<std::uint32_t> counts;
  for (s.seed = 1; s.seed <= 5; ++s.seed) {
    s.radio.one_way_share = 0.3;
    const World world(s);
    std::uint32_t parts = 1;
    for (std::size_t i = 0; i + 1 < 30; ++i) parts += world.is_deaf(i, i + 1) || world.is_deaf(i + 1, i) ? 1 : 0;
    EXPECT_EQ(Observer(world).run().start_parts, parts);
    counts.insert(parts);
    s.radio.one_way_share = 1.0;
    EXPECT_EQ(Observer(World(s)).run().start_parts, 30U);
  }
  EXPECT_GT(counts.size(), 1U);
}

TEST(Observer, ComputesTheFiedlerValueOfAPath) {
  World world(chain(7, 1.1));  // everybody hears the next one only
  Observer observer(world);
  world.step();
  const double expected = 2.0 - 2.0 * std::cos(pi<double> / 7.0);
  EXPECT_NEAR(observer.observe(world, true).fiedler, expected, 1e-9);
}

TEST(Observer, ADeadConnectorBreaksEdgesAndSplitsTheGraph) {
  Scenario s = chain(6, 1.1);
  s.events.push_back({.time_s = 15.0, .action = world::Die{2}});
  World world(s);
  Observer observer(world);
  EXPECT_EQ(after(world, observer, 150).broken_by_death, 0U);
  const Tick tick = after(world, observer, 1);
  EXPECT_EQ(tick.alive, 5U);
  EXPECT_EQ(tick.broken_by_death, 1U) << "robot 3 has lost its parent; a dead child is nobody's parent edge";
  EXPECT_EQ(tick.broken_by_distance, 0U);
  EXPECT_EQ(tick.components, 2U);
  EXPECT_TRUE(tick.fiedler_low);
  EXPECT_TRUE(tick.fiedler_low_by_distance);
  EXPECT_EQ(observer.run().split_ticks, 1U);
  EXPECT_EQ(observer.run().broken_ticks, 1U);
  const measure::Run run = observer.result(world);
  EXPECT_NEAR(run.disconnected_time_ratio, 1.0 / 151.0, 1e-12);
  EXPECT_NEAR(run.fiedler_time_ratio, 1.0 / 151.0, 1e-12);
  EXPECT_EQ(run.disconnected_time_ratio_by_distance, 0.0);
}

// A body dropped onto the line of sight between two robots: seen from outside the edge is there by
// distance and gone by occlusion.
TEST(Observer, TellsOcclusionFromDistance) {
  Scenario s = chain(4, 1.1);
  s.radio.line_of_sight = true;
  s.obstacles = {world::Wall{{1.65, -0.5}, {1.65, 0.5}}};
  World world(s);
  Observer observer(world);
  world.step();
  const Tick tick = observer.observe(world);
  EXPECT_EQ(tick.components, 2U);
  EXPECT_EQ(tick.components_by_distance, 1U);
  EXPECT_TRUE(tick.fiedler_low);
  EXPECT_FALSE(tick.fiedler_low_by_distance);
  EXPECT_EQ(observer.run().split_ticks, 1U);
  EXPECT_EQ(observer.run().split_ticks_by_distance, 0U);
}

TEST(Observer, CompletionIsTheFirstTickWithAllWorkersWithinTolerance) {
  World world(ring(12, 2, 2.0));
  Observer observer(world);
  std::uint64_t expected = 0;
  while (!observer.finished()) {
    world.step();
    observer.observe(world);
    std::size_t reached = 0;
    double worst = 0;
    for (const world::Target& target : world.targets()) {
      const double d = distance(world.positions()[target.worker], target.position);
      worst = std::max(worst, d);
      reached += d <= 0.2 ? 1 : 0;
    }
    EXPECT_EQ(observer.last().targets_reached, reached);
    EXPECT_NEAR(observer.last().worst_target_distance_m, worst, 1e-12);
    if (reached == 2 && expected == 0) expected = world.tick();
  }
  const measure::Run& run = observer.run();
  ASSERT_TRUE(run.complete);
  EXPECT_EQ(run.ticks, expected);
  EXPECT_NEAR(run.completion_time_s, static_cast<double>(expected) * 0.1, 1e-9);
  EXPECT_NEAR(run.time_limit_s, 10 * 2.0 / 0.2, 1e-9);
  EXPECT_NEAR(run.normalized_time, run.completion_time_s / run.time_limit_s, 1e-12);
}

TEST(Observer, GoesOnAfterCompletionIfToldTo) {
  Scenario s = ring(12, 2, 2.0);
  s.mission.stop_when_complete = false;
  s.mission.time_limit_s = 60;
  World world(s);
  Observer observer(world);
  while (!observer.finished()) {
    world.step();
    observer.observe(world);
  }
  EXPECT_EQ(world.tick(), 600U);
  EXPECT_TRUE(observer.run().complete);
  EXPECT_LT(observer.run().completion_time_s, 60.0);
}

TEST(Observer, AtTheTimeLimitARunIsOverAndNotComplete) {
  Scenario s = chain(3, 1.0);
  s.mission.time_limit_s = 2.0;
  World world(s);
  Observer observer(world);
  for (int t = 0; t < 19; ++t) after(world, observer, 1);
  EXPECT_FALSE(observer.finished());
  after(world, observer, 1);
  EXPECT_TRUE(observer.finished());
  const measure::Run run = observer.result(world);
  EXPECT_FALSE(run.complete);
  EXPECT_EQ(run.normalized_time, 1.0);
  EXPECT_EQ(run.completion_time_s, -1.0);
}

TEST(Observer, ADeadWorkerReachesNothing) {
  Scenario s = ring(12, 2, 1.0);
  World probe(s);
  s.events = {{.action = world::Die{probe.targets()[0].worker}}};
  World world(s);
  Observer observer(world);
  for (int t = 0; t < 400; ++t) EXPECT_LE(after(world, observer, 1).targets_reached, 1U);
  EXPECT_FALSE(observer.run().complete);
}

TEST(Observer, KnowsTheBounds) {
  World world(ring(20, 3, 3.0));
  const Observer observer(world);
  double slowest = 0;
  std::vector<Vec2> targets;
  for (const world::Target& target : world.targets()) {
    slowest = std::max(slowest, (distance(world.positions()[target.worker], target.position) - 0.2) / 0.2);
    targets.push_back(target.position);
  }
  EXPECT_NEAR(observer.run().time_bound_s, slowest, 1e-9);
  EXPECT_NEAR(observer.run().steiner_length_m, 9.0, 1e-5) << "three at 120 degrees: the star is minimal";
  EXPECT_EQ(observer.run().robots_bound, static_cast<std::uint32_t>(std::ceil((9.0 - 3 * 0.2) / 2.0)) + 1);
  EXPECT_EQ(observer.run().robots, 20U);
}

TEST(Observer, DoesNotAskTheOracleForMoreThanAThousandTargets) {
  Scenario s = chain(1'003, 0.2);
  for (const std::size_t targets : {1'000U, 1'001U}) {
    s.targets = world::RingTargets{.count = targets, .radius_m = 3.0, .phase_rad = 0.0, .center = {}};
    World world(s);
    Observer observer(world);
    after(world, observer, 1);
    const measure::Run run = observer.result(world);
    EXPECT_EQ(run.oracle_robots > 0, targets == 1'000U);
    EXPECT_EQ(run.oracle_time_s > 0.0, targets == 1'000U);
    EXPECT_TRUE(std::isfinite(run.oracle_ratio));
  }
}

// Robots on a line, 1 m apart, edges of at most 1.9 m: the worker at 0 drives to -2 m, the one at 5 to 8 m.
TEST(Observer, AsksTheOracleForRobotsAndTime) {
  Scenario s = chain(6, 1.0);
  s.targets = std::vector<Vec2>{{-2.0, 0.0}, {8.0, 0.0}};
  s.mission.target_tolerance_m = 0.2;
  World world(s);
  Observer observer(world);
  after(world, observer, 1);
  const measure::Run poor = observer.result(world);
  EXPECT_EQ(poor.oracle_robots, 7U) << "ten metres: six edges";
  EXPECT_TRUE(poor.oracle_exact);
  EXPECT_EQ(poor.oracle_time_s, -1.0) << "five relays, and four robots";
  EXPECT_NEAR(poor.oracle_ratio * 7.0, poor.committed, 1e-12);
  s.targets = std::vector<Vec2>{{-2.0, 0.0}, {5.5, 0.0}};
  World enough(s);
  Observer watcher(enough);
  const double v_max = s.robot.wheel_limit_m_s;
  // Relays at -0.125, 1.75 and 3.625 m, robots left at 1, 2, 3 and 4 m: the longest drive is 1.125 m.
  EXPECT_NEAR(watcher.result(enough).oracle_time_s, std::max(watcher.run().time_bound_s, 1.125 / v_max), 1e-9);
  EXPECT_EQ(watcher.result(enough).oracle_robots, 5U);
}

TEST(Observer, MeasuresTheNetworkThatIsLeft) {
  Scenario s = chain(6, 1.1);
  s.events.push_back({.time_s = 15.0, .action = world::Die{2}});
  World world(s);
  Observer observer(world);
  after(world, observer, 150);
  EXPECT_NEAR(observer.result(world).network_length_m, 5 * 1.1, 1e-9);
  EXPECT_EQ(observer.result(world).committed_ratio, 3.0) << "one target: a worker and the root would do";
  after(world, observer, 1);
  EXPECT_NEAR(observer.result(world).network_length_m, 3 * 1.1, 1e-9) << "neither its edge nor the edge to it";
}

TEST(Observer, RatiosAreToTheBounds) {
  World world(ring(24, 3, 3.0));
  Observer observer(world);
  long most = 0;
  while (!observer.run().complete) {
    after(world, observer, 1);
    most = std::max(most, std::count_if(world.reports().begin(), world.reports().end(),
                                        [](const Report& r) { return r.role != Role::spare; }));
  }
  while (!observer.finished()) after(world, observer, 1);
  const measure::Run run = observer.result(world);
  ASSERT_TRUE(run.complete);
  EXPECT_NEAR(run.deployment_ratio * run.robots_bound, static_cast<double>(most), 1e-9);
  EXPECT_GE(run.time_ratio, 1.0);
  EXPECT_NEAR(run.time_ratio * run.time_bound_s, run.completion_time_s, 1e-9);
  EXPECT_NEAR(run.committed_ratio * run.robots_bound, run.committed, 1e-9);
  World started(ring(24, 3, 3.0));
  EXPECT_EQ(Observer(started).result(started).time_ratio, -1.0) << "not complete";
  Scenario there = ring(12, 1, 0.1);
  there.mission.time_limit_s = 10.0;
  World at_home(there);
  Observer soon(at_home);
  after(at_home, soon, 1);
  EXPECT_TRUE(soon.run().complete);
  EXPECT_EQ(soon.result(at_home).time_ratio, -1.0) << "nothing to be a ratio of";
}

TEST(Observer, HeldTimeCountsFromCompletionOn) {
  Scenario s = ring(16, 2, 2.0);
  s.mission.stop_when_complete = false;
  s.mission.time_limit_s = 60.0;
  s.events.push_back({.time_s = 40.0, .action = world::MoveTarget{1, {0.0, 50.0}}});  // out of everybody's reach
  World world(s);
  Observer observer(world);
  double held = 0.0;
  int ticks = 0;
  while (!observer.finished()) {
    after(world, observer, 1);
    if (!observer.run().complete) continue;
    held += observer.last().targets_reached / 2.0;
    ++ticks;
  }
  const measure::Run run = observer.result(world);
  ASSERT_TRUE(run.complete);
  EXPECT_NEAR(run.held_time_ratio, held / ticks, 1e-12);
  EXPECT_LT(run.held_time_ratio, 0.9);
  EXPECT_GT(run.held_time_ratio, 0.5);
  EXPECT_EQ(run.held_ratio, 0.5) << "at the end, one of the two";
  World started(s);
  EXPECT_EQ(Observer(started).result(started).held_time_ratio, -1.0) << "not complete";
}

// outwards, but robot 2 calls itself root now and then, and counts what nobody does here.
using OutwardsSwarm = PaperSwarm<paper::outwards, paper::corrected>;
struct Pretending : OutwardsSwarm {
  static Output<Message> step(const Params& params, State& self, const Inputs<Heard>& inputs) {
    Output<Message> output = OutwardsSwarm::step(params, self, inputs);
    if (self.id != 2 || self.phase_ticks % 16 < 9) return output;
    output.message.role = self.role = Role::root;
    self.tally.elections += 1;
    self.tally.replacements += 2;
    self.tally.rejected += 3;
    return output;
  }
};
constexpr AlgorithmOf<Pretending> pretender(
    {.name = "pretender", .summary = "for this test", .defaults = paper::outwards_column, .bind = bind});

TEST(Observer, CountsTwoRootsElectionsAndReplacements) {
  World world(chain(6, 1.1), pretender);
  Observer observer(world);
  std::uint64_t ticks = 0, streak = 0, longest = 0;
  for (int t = 0; t < 150; ++t) {
    const std::uint32_t roots = after(world, observer, 1).roots;
    streak = roots > 1 ? streak + 1 : 0;
    longest = std::max(longest, streak);
    ticks += roots > 1 ? 1 : 0;
  }
  ASSERT_GT(ticks, longest) << "more than once";
  ASSERT_GT(longest, 1U);
  const measure::Run run = observer.result(world);
  EXPECT_EQ(run.two_roots_ticks, ticks);
  EXPECT_NEAR(run.longest_two_roots_s, 0.1 * static_cast<double>(longest), 1e-9);
  EXPECT_EQ(run.elections, world.reports()[2].tally.elections);
  EXPECT_EQ(run.replacements, 2 * run.elections);
  EXPECT_GT(run.elections, 0U);
  EXPECT_EQ(run.rejected, 3 * run.elections);
  EXPECT_EQ(run.rejected_by, "2");
}

// outwards, but its epochs are 15,000 apart, so the fifth comes after 65,535.
struct Striding : OutwardsSwarm {
  static constexpr int stride = 15000;
  static Report report(const State& self) {
    Report report = OutwardsSwarm::report(self);
    report.epoch = static_cast<Serial>(stride * report.epoch);
    return report;
  }
};
constexpr AlgorithmOf<Striding> striding(
    {.name = "striding", .summary = "for this test", .defaults = paper::outwards_column, .bind = bind});

TEST(Observer, CountsEpochsBeyondTheLastNumber) {
  Scenario s = chain(6, 1.1);
  s.mission.algorithm = "outwards";
  s.mission.parameters = {{"reconfiguration_drives", 0.2}};
  World plain(s), wrapped(s, striding);
  Observer of_plain(plain), of_wrapped(wrapped);
  after(plain, of_plain, 300);
  after(wrapped, of_wrapped, 300);
  const measure::Run expected = of_plain.result(plain), run = of_wrapped.result(wrapped);
  ASSERT_GT(expected.epochs, 4U);
  EXPECT_EQ(run.epochs, Striding::stride * expected.epochs);
  EXPECT_NEAR(Striding::stride * run.start_phase_ticks, expected.start_phase_ticks, 1e-9);
}

TEST(Observer, SettlesAfterCompletionEvenBeyondTheLimit) {
  Scenario s = ring(12, 2, 2.0);
  World brief(s);
  Observer first(brief);
  while (!first.finished()) after(brief, first, 1);
  const double complete_s = first.run().completion_time_s;
  s.mission.settle_s = 5.0;
  s.mission.time_limit_s = complete_s + 1.0;
  World world(s);
  Observer observer(world);
  while (!observer.finished()) after(world, observer, 1);
  EXPECT_NEAR(observer.run().completion_time_s, complete_s, 1e-9);
  EXPECT_NEAR(observer.run().time_s, complete_s + 5.0, 1e-9);
  EXPECT_EQ(observer.result(world).committed, observer.last().committed);
  s.mission.time_limit_s = complete_s - 1.0;
  World late(s);
  Observer cut(late);
  while (!cut.finished()) after(late, cut, 1);
  EXPECT_FALSE(cut.run().complete);
  EXPECT_NEAR(cut.run().time_s, complete_s - 1.0, 1e-9);
}

// The worker stands on its target from the first tick on.
Scenario held_chain() {
  Scenario s = chain(6, 1.1);
  s.targets = std::vector<Vec2>{s.swarm.start.positions.back()};
  s.mission.time_limit_s = 20.0;
  return s;
}

TEST(Observer, CompleteMeansHeldAndConnected) {
  World whole(held_chain());
  Observer observer(whole);
  const Tick first = after(whole, observer, 1);
  EXPECT_TRUE(first.all_held());
  EXPECT_EQ(first.components, 1U);
  EXPECT_EQ(first.tree_parts, 2U) << "root and worker, with spares between them";
  EXPECT_FALSE(observer.run().complete);
  const Tick grown = after(whole, observer, 149);
  EXPECT_EQ(grown.connectors, 4U);
  EXPECT_EQ(grown.tree_parts, 1U);
  EXPECT_TRUE(observer.run().complete);

  Scenario s = held_chain();
  s.events.push_back({.action = world::Die{3}});
  World split(s);
  Observer cut(split);
  const Tick held = after(split, cut, 150);
  EXPECT_TRUE(held.all_held());
  EXPECT_EQ(held.components, 2U);
  EXPECT_GE(held.tree_parts, 2U);
  EXPECT_FALSE(cut.run().complete) << "the worker holds its target, and nobody on the other side hears of it";
  EXPECT_EQ(cut.run().normalized_time, 1.0);
}

TEST(Observer, ASwarmWithoutRootIsNotComplete) {
  Scenario s = held_chain();
  s.events.push_back({.action = world::Die{0}});
  World world(s);
  Observer observer(world);
  const Tick tick = after(world, observer, 1);
  EXPECT_TRUE(tick.all_held());
  EXPECT_EQ(tick.components, 1U);
  EXPECT_EQ(tick.tree_parts, 0U);
  EXPECT_FALSE(observer.run().complete);
}

// A start at the limit of the radio, where today's algorithms lose workers before the first tree stands: whatever
// becomes of that, a run is complete only at a tick at which the tree is in one piece.
TEST(Observer, ALooseStartIsNotCompleteWhileItIsSplit) {
  Scenario s = ring(60, 3, 3.0);
  s.swarm.start.pitch_m = 1.85;
  s.radio.line_of_sight = true;
  World world(s);
  Observer observer(world);
  while (!observer.finished()) {
    const Tick tick = after(world, observer, 1);
    ASSERT_EQ(observer.run().complete, tick.all_held() && tick.tree_parts == 1) << tick.time_s;
  }
}

// ---- Deaths ----

Event death(std::size_t robot, double time_s, Event::When when = Event::When::time) {
  return {time_s, when, world::Die{robot}};
}

// A robot of the given role at the end of a run, the last of them.
std::size_t last_with(const World& world, Role role) {
  std::size_t found = world.size();
  for (std::size_t i = 0; i < world.size(); ++i)
    if (world.reports()[i].role == role) found = i;
  return found;
}

World completed(const Scenario& s) {
  World world(s);
  Observer observer(world);
  while (!observer.finished()) after(world, observer, 1);
  EXPECT_TRUE(observer.run().complete);
  return world;
}

TEST(Observer, ASpareIsNotMissed) {
  Scenario s = ring(20, 2, 2.0);
  const World probe = completed(s);
  const std::size_t spare = last_with(probe, Role::spare);
  ASSERT_LT(spare, probe.size());
  s.events = {death(spare, 3.0, Event::When::complete)};
  World world(s);
  Observer observer(world);
  std::vector<bool> whole;  // at each look after the death
  while (!observer.finished()) {
    const Tick tick = after(world, observer, 1);
    if (world.alive()[spare] == 0)
      whole.push_back(tick.components == 1 && tick.roots == 1 && world.holder(0) && world.holder(1));
  }
  const measure::Run run = observer.result(world);
  EXPECT_NEAR(run.completion_time_s, probe.time_s(), 1e-9) << "what comes later does not change it";
  EXPECT_EQ(run.deaths, 1U);
  EXPECT_EQ(run.survivors, 19U);
  EXPECT_NEAR(run.last_death_s, static_cast<double>(*world.last_death_tick()) * 0.1, 1e-9);
  EXPECT_GT(run.last_death_s, run.completion_time_s + 2.9);
  ASSERT_TRUE(run.recovered);
  EXPECT_TRUE(run.survivors_suffice);
  std::size_t first = 0;
  for (std::size_t t = 0; t < whole.size(); ++t)
    if (!whole[t]) first = t + 1;
  EXPECT_NEAR(run.recovery_time_s, 0.1 * static_cast<double>(first), 1e-9);
  EXPECT_EQ(whole.size(), first + 201) << "seen 20 s later, and not a tick longer";
}

TEST(Observer, AWorkerThatNobodyReplacesIsNeverRecoveredFrom) {
  Scenario s = ring(14, 2, 1.0);
  s.mission.algorithm = "outwards";
  s.mission.reading = "literal";  // which does not heal
  const World probe = completed(s);
  s.events = {death(probe.targets()[1].worker, 0.0, Event::When::complete)};
  World world(s);
  Observer observer(world);
  while (!observer.finished()) {
    const Tick tick = after(world, observer, 1);
    std::uint32_t held = 0;
    for (std::size_t t = 0; t < 2; ++t) held += world.holder(t) ? 1 : 0;
    EXPECT_EQ(tick.targets_reached, held);
  }
  const measure::Run run = observer.result(world);
  EXPECT_TRUE(run.complete);
  EXPECT_EQ(observer.last().targets_reached, 1U);
  EXPECT_FALSE(run.recovered);
  EXPECT_EQ(run.recovery_time_s, -1.0);
  EXPECT_NEAR(run.time_s, run.last_death_s + 0.1 + recovery_limit_drives * 10.0, 1e-9);
  const Vec2 body = world.positions()[probe.targets()[1].worker];
  EXPECT_GE(observer.last().worst_target_distance_m, distance(body, world.targets()[1].position) - 1e-12);
}

// What each target has seen, tick by tick: who holds it, and who is dead.
struct Seen {
  std::vector<RobotId> holders;
  std::vector<bool> dead;
};

Seen seen(const World& world) {
  Seen now;
  for (std::size_t t = 0; t < world.targets().size(); ++t) {
    const auto holder = world.holder(t);
    now.holders.push_back(holder ? static_cast<RobotId>(*holder) : nobody);
  }
  for (const auto alive : world.alive()) now.dead.push_back(alive == 0);
  return now;
}

// From each death at a target forward to the tick in which the target is held again, over all that was seen.
std::size_t unheld_by_death(const std::vector<Seen>& ticks) {
  std::size_t unheld = 0;
  for (std::size_t k = 1; k < ticks.size(); ++k)
    for (std::size_t t = 0; t < ticks[k].holders.size(); ++t) {
      const RobotId before = ticks[k - 1].holders[t];
      if (before == nobody || !ticks[k].dead[before]) continue;
      for (std::size_t later = k; later < ticks.size() && ticks[later].holders[t] == nobody; ++later) ++unheld;
    }
  return unheld;
}

// Of three targets, one loses its worker, one moves away from a living one, and both are held again.
TEST(Observer, WhatAWorkersOwnDeathCostsIsCountedApart) {
  Scenario s = ring(20, 3, 2.0);
  s.mission.stop_when_complete = false;
  s.mission.time_limit_s = 90.0;
  const World probe(s);
  s.events = {death(probe.targets()[0].worker, 40.0)};
  s.events.push_back({.time_s = 55.0, .action = world::MoveTarget{1, {0.0, 2.5}}});
  World world(s);
  Observer observer(world);
  std::vector<Seen> since_complete;
  std::size_t held = 0;
  while (!observer.finished()) {
    after(world, observer, 1);
    if (!observer.run().complete) continue;
    since_complete.push_back(seen(world));
    for (const RobotId holder : since_complete.back().holders) held += holder != nobody ? 1 : 0;
  }
  const measure::Run run = observer.result(world);
  ASSERT_TRUE(run.complete);
  ASSERT_LT(run.completion_time_s, 40.0);
  const auto target_ticks = static_cast<double>(3 * since_complete.size());
  const std::size_t by_death = unheld_by_death(since_complete);
  EXPECT_NEAR(run.unheld_time_ratio_by_death, static_cast<double>(by_death) / target_ticks, 1e-12);
  EXPECT_NEAR(run.held_time_ratio, static_cast<double>(held) / target_ticks, 1e-12);
  EXPECT_GT(by_death, 10U) << "a second at the least until anybody notices";
  EXPECT_LT(static_cast<double>(held + by_death), target_ticks - 10.0) << "the target that moved is no death's";
  EXPECT_NEAR(static_cast<double>(by_death) * 0.1, run.held_again_s, 1e-9) << "the only death";
  World started(s);
  EXPECT_EQ(Observer(started).result(started).unheld_time_ratio_by_death, -1.0) << "not complete";
}

TEST(Observer, WhatWasLostBeforeTheLimitIsWaitedForButNotWhatMayNeverCome) {
  Scenario s = chain(5, 1.0);
  s.mission.time_limit_s = 30.0;
  s.events.push_back(death(1, 0.0, Event::When::complete));
  World never(s);
  Observer idle(never);
  while (!idle.finished()) after(never, idle, 1);
  EXPECT_NEAR(idle.run().time_s, 30.0, 1e-9);
  EXPECT_EQ(idle.run().deaths, 0U);
  EXPECT_TRUE(never.pending_kills());
  s.events.push_back(death(2, 10.0));
  World world(s);
  Observer observer(world);
  while (!observer.finished()) after(world, observer, 1);
  EXPECT_FALSE(observer.run().complete);
  EXPECT_NEAR(observer.run().time_s, 10.1 + recovery_limit_drives * 10.0, 1e-9);
  s.mission.stop_when_complete = false;
  World cut(s);
  Observer limit(cut);
  while (!limit.finished()) after(cut, limit, 1);
  EXPECT_NEAR(limit.run().time_s, 30.0, 1e-9);
}

TEST(Observer, SurvivorsAreComparedWithWhatTheTargetsLeftNeed) {
  Scenario s = chain(7, 1.0);
  s.targets = std::vector<Vec2>{{-2.0, 0.0}, {8.0, 0.0}};  // (10 - 0.4) / 2 = 4.8: six robots
  s.mission.target_tolerance_m = 0.2;
  s.events.push_back(death(2, 1.0));
  s.events.push_back(death(3, 2.0));
  s.events.push_back({.time_s = 3.0, .action = world::RemoveTarget{1}});
  World world(s);
  Observer observer(world);
  EXPECT_EQ(observer.run().robots_bound, 6U);
  after(world, observer, 15);
  EXPECT_TRUE(observer.result(world).survivors_suffice) << "six of seven";
  EXPECT_EQ(after(world, observer, 10).active_targets, 2U);
  EXPECT_FALSE(observer.result(world).survivors_suffice) << "five";
  EXPECT_EQ(after(world, observer, 10).active_targets, 1U);
  EXPECT_TRUE(observer.result(world).survivors_suffice) << "one target needs two robots";
  EXPECT_EQ(observer.result(world).robots_bound, 6U) << "the start's";
}

// Components by repeated merging, edges by plain loops: the same run counted by somebody else.
class Recount {
 public:
  void add(const World& world, const Tick& tick) {
    const std::size_t n = world.size();
    const double range2 = world.scenario().radio.range_m * world.scenario().radio.range_m;
    std::uint32_t far = 0, hidden = 0, dead = 0, edges = 0, committed = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Report& s = world.reports()[i];
      if (world.alive()[i] == 0 || s.role == Role::spare) continue;
      ++committed;
      std::vector<RobotId> ups;
      if (s.parent != nobody) ups.push_back(s.parent);
      if (s.old_parent != nobody && s.old_parent != s.parent) ups.push_back(s.old_parent);
      for (const RobotId up : ups) {
        ++edges;
        const auto links = world.links(i);
        const bool linked = std::find(links.begin(), links.end(), std::uint32_t{up}) != links.end();
        if (linked) continue;
        if (world.alive()[up] == 0) ++dead;
        else if (squared_norm(world.positions()[i] - world.positions()[up]) >= range2) ++far;
        else ++hidden;
      }
    }
    EXPECT_EQ(tick.edges, edges);
    EXPECT_EQ(tick.committed, committed);
    EXPECT_EQ(tick.broken_by_distance, far);
    EXPECT_EQ(tick.broken_by_occlusion, hidden);
    EXPECT_EQ(tick.broken_by_death, dead);
    EXPECT_EQ(tick.components, components(world, false));
    EXPECT_EQ(tick.components_by_distance, components(world, true));
    EXPECT_EQ(tick.alive, tick.roots + tick.workers + tick.connectors + tick.spares);
    std::uint32_t held = 0;
    for (std::size_t t = 0; t < world.targets().size(); ++t) held += world.holder(t) ? 1 : 0;
    EXPECT_EQ(tick.targets_reached, held);
    ++ticks;
    broken += far + hidden + dead > 0 ? 1 : 0;
    broken_far += far > 0 ? 1 : 0;
    broken_hidden += hidden > 0 ? 1 : 0;
    split += tick.components > 1 ? 1 : 0;
    low += tick.fiedler_low ? 1 : 0;
    committed_sum += committed;
  }

  double ticks = 0, broken = 0, broken_far = 0, broken_hidden = 0, split = 0, low = 0, committed_sum = 0;

 private:
  static std::uint32_t components(const World& world, bool by_distance) {
    const std::size_t n = world.size();
    const double range2 = world.scenario().radio.range_m * world.scenario().radio.range_m;
    std::vector<std::size_t> leader(n);
    std::iota(leader.begin(), leader.end(), std::size_t{0});
    const auto find = [&](std::size_t i) {
      while (leader[i] != i) i = leader[i];
      return i;
    };
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < n; ++i) count += world.alive()[i] != 0 ? 1 : 0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j) {
        const auto links = world.links(i);
        const bool near = world.alive()[i] != 0 && world.alive()[j] != 0 &&
                          squared_norm(world.positions()[i] - world.positions()[j]) < range2;
        const bool joined =
            by_distance ? near : std::find(links.begin(), links.end(), static_cast<std::uint32_t>(j)) != links.end();
        if (!joined || find(i) == find(j)) continue;
        leader[find(i)] = find(j);
        --count;
      }
    return count;
  }
};

TEST(Observer, AgreesWithARecountOfAHardRun) {
  for (const char* algorithm : {"outwards", "inwards"}) {
    for (const char* reading : {"literal", "corrected"}) {
      const std::size_t message_bytes = wire_size<paper::Message>();
      Scenario s = ring(30, 3, 6.0, 4);
      s.mission.algorithm = algorithm;
      s.mission.reading = reading;
      s.radio.line_of_sight = true;
      s.radio.loss = 0.3;
      for (std::size_t k = 0; k < 6; ++k) {
        s.events.push_back({.time_s = 20.0 + 5.0 * static_cast<double>(k), .action = world::Die{3 * k}});
      }
      World world(s);
      Observer observer(world);
      Recount recount;
      for (int t = 0; t < 900; ++t) {
        world.step();
        recount.add(world, observer.observe(world));
      }
      const measure::Run run = observer.result(world);
      EXPECT_EQ(static_cast<double>(run.ticks), recount.ticks);
      EXPECT_NEAR(run.disconnected_time_ratio, recount.broken / 900, 1e-12);
      EXPECT_NEAR(run.disconnected_time_ratio_by_distance, recount.broken_far / 900, 1e-12);
      EXPECT_NEAR(run.disconnected_time_ratio_by_occlusion, recount.broken_hidden / 900, 1e-12);
      EXPECT_NEAR(run.fiedler_time_ratio, recount.low / 900, 1e-12);
      EXPECT_EQ(static_cast<double>(run.split_ticks), recount.split);
      EXPECT_NEAR(run.mean_committed, recount.committed_sum / 900, 1e-9);
      EXPECT_GT(run.broken_ticks, 0U) << "a run without trouble tests nothing";
      EXPECT_EQ(run.hash, world.hash());
      EXPECT_NEAR(run.bytes_per_robot_s, static_cast<double>(world.packets_sent() * message_bytes) / (30 * 90.0), 1e-9);
      std::uint64_t insertions = 0;
      std::uint64_t epochs = 0;
      for (const Report& report : world.reports()) {
        insertions += report.tally.insertions;
        epochs = std::max<std::uint64_t>(epochs, report.epoch);
      }
      EXPECT_EQ(run.insertions, insertions);
      EXPECT_LE(run.epochs, epochs);
      EXPECT_GE(run.epochs, 1U);
      EXPECT_GE(run.start_phase_ticks, 3.0);
    }
  }
}

// The threshold is judged at every tick and without a full eigenvalue: compare with one.
TEST(Observer, JudgesTheFiedlerValueAsItIs) {
  World world(chain(60, 1.9));  // lambda_2 of a path of 60: 0.0027
  Observer observer(world);
  world.step();
  const Tick path = observer.observe(world, true);
  EXPECT_NEAR(path.fiedler, 2.0 - 2.0 * std::cos(pi<double> / 60.0), 1e-9);
  EXPECT_FALSE(path.fiedler_low);
  World longer(chain(110, 1.9));  // 0.00082
  Observer second(longer);
  longer.step();
  const Tick low = second.observe(longer, true);
  EXPECT_EQ(low.components, 1U);
  EXPECT_LT(low.fiedler, 1e-3);
  EXPECT_TRUE(low.fiedler_low);
  EXPECT_TRUE(low.fiedler_low_by_distance);
}

// What takes long is given up, the tick is a tick all the same.
TEST(Observer, WaitsForNoValueOnceItIsToStop) {
  World world(ring(400, 3, 30.0));
  Observer observer(world);
  int asked = 0;
  bool stop = false;
  observer.stop_when([&] {
    ++asked;
    return stop;
  });
  world.step();
  EXPECT_GT(observer.observe(world, true).fiedler, 0.0);
  EXPECT_GT(asked, 1);
  stop = true;
  world.step();
  EXPECT_EQ(observer.observe(world, true).fiedler, -1.0);
  EXPECT_EQ(observer.last().components, 1U);
  EXPECT_EQ(observer.result(world).ticks, 2U);
}

TEST(Observer, CanBeMoved) {
  World world(chain(4, 1.0));
  Observer a(world);
  after(world, a, 3);
  Observer b(std::move(a));
  EXPECT_EQ(b.run().ticks, 3U);
  Observer c(world);
  c = std::move(b);
  after(world, c, 1);
  EXPECT_EQ(c.run().ticks, 4U);
}

}  // namespace
}  // namespace banyan::measure
