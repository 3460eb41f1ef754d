// SPDX-License-Identifier: MIT
// What is measured has no length and no time of its own either (world/test/scale_test.cpp).
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "banyan/measure/observer.hpp"
#include "scaled.hpp"
#include "toy_swarm.hpp"

namespace banyan::measure {
namespace {

struct Account {
  Run run;
  std::vector<bool> plotted;  // by tick
};

Account account_of(const world::Scenario& scenario) {
  constexpr world::ToyAlgorithm toy;
  world::World world(scenario, toy);
  Observer observer(world);
  Account account;
  while (!observer.finished()) {
    world.step();
    observer.observe(world);
    account.plotted.push_back(is_plotted(world));
  }
  account.run = observer.result(world);
  return account;
}

using Number = double Run::*;
using Count = std::uint32_t Run::*;

void expect_same(const Run& a, const Run& b, const world::Factors& f) {
  EXPECT_EQ(b.ticks, a.ticks);
  for (const Number time : std::initializer_list<Number>{
           &Run::time_s, &Run::completion_time_s, &Run::time_limit_s, &Run::time_bound_s, &Run::oracle_time_s,
           &Run::liveness_period_s, &Run::last_death_s, &Run::recovery_time_s, &Run::lasts_s})
    EXPECT_EQ(b.*time, a.*time < 0.0 ? a.*time : f.time * (a.*time));
  for (const Number length : std::initializer_list<Number>{&Run::network_length_m, &Run::driven_m})
    EXPECT_EQ(b.*length, f.length * (a.*length));
  for (const Number share :
       std::initializer_list<Number>{&Run::normalized_time, &Run::held_time_ratio, &Run::fiedler_time_ratio,
                                     &Run::least_charge, &Run::mean_charge})
    EXPECT_EQ(b.*share, a.*share);
  for (const Count count :
       std::initializer_list<Count>{&Run::robots_bound, &Run::oracle_robots, &Run::oracle_targets, &Run::survivors})
    EXPECT_EQ(b.*count, a.*count);
  EXPECT_EQ(b.split_ticks, a.split_ticks);
  EXPECT_EQ(b.broken_ticks, a.broken_ticks);
}

// So many robots that lambda_2 is not judged at every tick; one dies.
TEST(ScaleMeasure, AnAccountHasNone) {
  world::Scenario s;
  s.swarm.robots = 160;
  s.targets = world::RingTargets{4, 3.5};
  s.mission.time_limit_s = 60.0;
  s.battery.model = world::Battery::Model::power;
  s.battery.places = {{1.0, 1.0}};
  s.events = {{.when = world::Event::When::complete, .action = world::Die{50}}};
  const Account first = account_of(s);
  EXPECT_TRUE(first.run.complete);
  EXPECT_TRUE(first.run.recovered);
  EXPECT_GT(first.run.time_s, first.run.completion_time_s);
  for (const world::Factors f :
       {world::Factors{0.25, 1.0}, world::Factors{16.0, 1.0}, world::Factors{1.0, 0.5}, world::Factors{1.0, 2.0}}) {
    SCOPED_TRACE("lengths times " + std::to_string(f.length) + ", times " + std::to_string(f.time));
    const Account other = account_of(multiplied(s, f));
    EXPECT_EQ(other.plotted, first.plotted);
    expect_same(first.run, other.run, f);
  }
}

}  // namespace
}  // namespace banyan::measure
