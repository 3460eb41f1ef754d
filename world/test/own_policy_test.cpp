// SPDX-License-Identifier: MIT
// A world that is given a policy instead of the name of one.
#include <gtest/gtest.h>

#include <stdexcept>

#include "banyan/controller/policies.hpp"
#include "banyan/world/world.hpp"

namespace banyan::world {
namespace {

// inwards with parameters of one's own choice.
class Mine final : public Policy {
 public:
  explicit Mine(float safe_range_m) : safe_range_m_(safe_range_m) {}
  std::string_view name() const noexcept override { return "mine"; }
  std::string_view summary() const noexcept override { return "for this test"; }
  Params defaults(Reading reading) const noexcept override {
    Params params = inwards().defaults(reading);
    params.safe_range_m = safe_range_m_;
    return params;
  }
  bool may_join(const Robot& robot) const noexcept override { return inwards().may_join(robot); }
  bool accepts(const Robot& robot, int k) const noexcept override { return inwards().accepts(robot, k); }
  bool prefers(const Robot& robot, int a, int b) const noexcept override { return inwards().prefers(robot, a, b); }
  bool tree_complete(const Robot& robot) const noexcept override { return inwards().tree_complete(robot); }
  bool leaves_branch(const Robot& robot) const noexcept override { return inwards().leaves_branch(robot); }

 private:
  float safe_range_m_;
};

std::uint64_t hash_after_100_ticks(World world) {
  for (int t = 0; t < 100; ++t) world.step();
  return world.hash();
}

TEST(OwnPolicy, ARegisteredOneByReferenceIsTheSameAsByName) {
  Scenario scenario;
  scenario.mission.algorithm = "inwards";
  EXPECT_EQ(hash_after_100_ticks(World(scenario)), hash_after_100_ticks(World(Scenario{}, inwards())));
  EXPECT_NE(hash_after_100_ticks(World(scenario)), hash_after_100_ticks(World(Scenario{})));
}

TEST(OwnPolicy, DecidesWithItsOwnParameters) {
  const Mine mine(1.45F);
  const World world(Scenario{}, mine);
  EXPECT_EQ(world.scenario().mission.algorithm, "mine");
  EXPECT_EQ(&world.policy(), &mine);
  EXPECT_FLOAT_EQ(world.params().safe_range_m, 1.45F);
  EXPECT_NE(hash_after_100_ticks(world), hash_after_100_ticks(World(Scenario{}, inwards())));
}

TEST(OwnPolicy, ItsWorldCanBeInterferedWith) {
  const Mine mine(1.45F);
  World world(Scenario{}, mine);
  world.intervene({.kind = Event::Kind::die, .index = 0});
  world.step();
  EXPECT_EQ(world.alive()[0], 0);
}

TEST(OwnPolicy, ImpossibleParametersAreToldWithItsName) {
  const Mine mine(1.2F);   // S below E
  try {
    const World world(Scenario{}, mine);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "mine: recruitment_distance_m (E) must be below safe_range_m (S)");
  }
}

}  // namespace
}  // namespace banyan::world
