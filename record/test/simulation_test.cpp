// SPDX-License-Identifier: MIT
// A run is its world stepped and observed, whoever is told of it.
#include "banyan/record/simulation.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "sample.hpp"

namespace banyan::record {
namespace {

// What it is told, and lambda_2 if it asks for it.
struct Onlooker final : Sink {
  explicit Onlooker(bool asks = false) : fiedler(asks) {}
  void start(const world::World& world) override { started_at = world.tick(); }
  void tick(const world::World& world, const measure::Tick& tick) override {
    EXPECT_EQ(tick.tick, world.tick());
    EXPECT_EQ(tick.fiedler >= 0.0, fiedler);
    ticks.push_back(tick.tick);
  }
  void finish(const world::World& world, const RunEnd& run_end) override {
    EXPECT_EQ(run_end.run.hash, world.hash());
    end = run_end;
    ++finishes;
  }
  [[nodiscard]] bool wants_fiedler(const world::World&) const override { return fiedler; }

  bool fiedler;
  std::uint64_t started_at = 99;
  std::vector<std::uint64_t> ticks;
  RunEnd end;
  int finishes = 0;
};

TEST(RunScenario, IsTheWorldSteppedToTheEndOfItsMission) {
  world::World world(test::small_world());
  measure::Observer observer(world);
  while (!observer.finished()) {
    world.step();
    observer.observe(world);
  }
  for (const bool fiedler : {false, true}) {
    Onlooker onlooker(fiedler);
    world::Executor two(2);
    const RunEnd end = run_scenario(world::World(test::small_world()), onlooker, two);
    EXPECT_EQ(end.run.hash, world.hash());
    EXPECT_EQ(end.run.ticks, world.tick());
    EXPECT_EQ(end.last.tick, world.tick());
    EXPECT_FALSE(end.interrupted);
    EXPECT_EQ(onlooker.started_at, 0U);
    ASSERT_EQ(onlooker.ticks.size(), world.tick());
    for (std::size_t k = 0; k < onlooker.ticks.size(); ++k) EXPECT_EQ(onlooker.ticks[k], k + 1);
    EXPECT_EQ(onlooker.finishes, 1);
    EXPECT_EQ(onlooker.end.run.hash, end.run.hash);
  }
}

TEST(RunScenario, StoppedItIsAnInterruptedRunOfWhatWasDone) {
  Onlooker onlooker;
  world::Executor one(1);
  const RunEnd end = run_scenario(world::World(test::small_world()), onlooker, one,
                                  [](const Simulation& s) { return s.world().tick() < 7; });
  EXPECT_TRUE(end.interrupted);
  EXPECT_TRUE(onlooker.end.interrupted);
  EXPECT_EQ(end.run.ticks, 7U);
  EXPECT_EQ(onlooker.ticks.size(), 7U);
  EXPECT_EQ(onlooker.finishes, 1);
}

// At the end of the mission nobody asks whether to go on.
TEST(RunScenario, StoppedAtItsEndItIsNotInterrupted) {
  Onlooker onlooker;
  world::Executor one(1);
  const auto never_at_the_end = [](const Simulation& s) { return !s.finished(); };
  EXPECT_FALSE(run_scenario(world::World(test::small_world()), onlooker, one, never_at_the_end).interrupted);
}

TEST(RunScenario, ASinkOnItsOwnMayEndTheRun) {
  struct Failing final : Sink {
    void tick(const world::World& world, const measure::Tick&) override {
      if (world.tick() == 3) throw std::runtime_error("no more");
    }
  } failing;
  world::Executor one(1);
  EXPECT_THROW(run_scenario(world::World(test::small_world()), failing, one), std::runtime_error);
}

TEST(Simulation, StepsBeyondTheEndAndInterferes) {
  Onlooker onlooker;
  world::Executor one(1);
  Simulation simulation(world::World(test::small_world()), onlooker);
  while (!simulation.finished()) simulation.step(one);
  const std::uint64_t end = simulation.world().tick();
  simulation.intervene({.action = world::Die{3}});
  simulation.step(one);
  EXPECT_EQ(simulation.last().tick, end + 1);
  EXPECT_EQ(simulation.last().alive, 5U);
  EXPECT_EQ(simulation.result().deaths, 1U);
  EXPECT_EQ(onlooker.finishes, 0);
  EXPECT_EQ(simulation.finish(true).run.ticks, end + 1);
  EXPECT_EQ(onlooker.finishes, 1);
}

}  // namespace
}  // namespace banyan::record
