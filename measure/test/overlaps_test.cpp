// SPDX-License-Identifier: MIT
// Ticks with bodies in one place, against each pair of robots looked at.
#include "banyan/measure/overlaps.hpp"

#include <gtest/gtest.h>

#include "banyan/measure/observer.hpp"
#include "banyan/world/bodies.hpp"
#include "plain_scenario.hpp"

namespace banyan::measure {
namespace {

world::Scenario crowd(world::BodyModel body) {
  world::Scenario s = world::plain_scenario();
  s.robot.body = body;
  s.swarm.robots = 30;
  s.targets = world::RingTargets{4, 6.0, 0.0, {}};
  for (std::size_t k = 0; k < 6; ++k)
    s.events.push_back({.time_s = 5.0 + static_cast<double>(k), .action = world::Die{k}});
  return s;
}

bool overlap(const world::World& world) {
  const auto positions = world.positions();
  for (std::size_t i = 0; i < world.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (world.alive()[i] != 0 && world.alive()[j] != 0 &&
          distance(positions[i], positions[j]) < 2.0 * world.scenario().robot.radius_m)
        return true;
  return false;
}

TEST(Overlaps, AreCountedWhereBodiesHaveNoContacts) {
  std::int64_t all = 0;
  for (const char* algorithm : {"outwards", "inwards", "convoy"}) {
    world::Scenario s = crowd(world::BodyModel::linear);
    s.mission.algorithm = algorithm;
    world::World world(s);
    Observer observer(world);
    std::int64_t ticks = 0;
    for (int t = 0; t < 400; ++t) {
      world.step();
      observer.observe(world);
      ticks += overlap(world) ? 1 : 0;
    }
    EXPECT_EQ(observer.result(world).overlap_ticks, ticks) << algorithm;
    EXPECT_LT(ticks, 400) << "robots start apart";
    all += ticks;
  }
  EXPECT_GT(all, 0) << "else nothing is tested";
}

TEST(Overlaps, AreNotLookedForWhereBodiesPushEachOtherApart) {
  for (const auto body : {world::BodyModel::disks, world::BodyModel::box2d}) {
    if (body == world::BodyModel::box2d && !world::has_box2d()) continue;
    world::World world(crowd(body));
    Observer observer(world);
    world.step();
    observer.observe(world);
    EXPECT_EQ(observer.result(world).overlap_ticks, -1);
  }
}

}  // namespace
}  // namespace banyan::measure
