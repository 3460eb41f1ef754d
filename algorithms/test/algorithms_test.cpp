// SPDX-License-Identifier: MIT
// Algorithms as a host meets them: by name, with a table of parameters, defaults and faults.
#include "banyan/algorithms/algorithms.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <set>

#include "banyan/algorithms/inside.hpp"

namespace banyan {
namespace {

float value_of(const Algorithm& algorithm, const Setup& setup, std::string_view key) {
  const auto rows = algorithm.parameters();
  const auto values = algorithm.values(setup);
  EXPECT_EQ(rows.size(), values.size());
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (rows[k]->key == key) return values[k];
  ADD_FAILURE() << key;
  return 0.0F;
}

TEST(Algorithms, AreFoundByName) {
  for (const Algorithm* algorithm : algorithms()) {
    EXPECT_EQ(algorithms().find(algorithm->name()), algorithm);
    EXPECT_FALSE(algorithm->summary().empty());
    EXPECT_EQ(algorithm->fault({}), "");
  }
  EXPECT_EQ(algorithms().find("sideways"), nullptr);
  EXPECT_EQ(AlgorithmList({&outwards()}).find("inwards"), nullptr);
}

TEST(Algorithms, TheUsualOneIsTheFirstUnlessTheListSaysOtherwise) {
  EXPECT_EQ(algorithms().usual(), "convoy");
  EXPECT_EQ(AlgorithmList({&outwards(), &inwards()}).usual(), "outwards");
  EXPECT_EQ(AlgorithmList({&outwards(), &inwards()}, "inwards").usual(), "inwards");
  EXPECT_EQ(AlgorithmList({}).usual(), "");
}

TEST(Algorithms, TheTableHasEveryKeyOnce) {
  std::set<std::string_view> keys;
  for (const ParameterInfo& row : algorithms().parameters()) EXPECT_TRUE(keys.insert(row.key).second) << row.key;
  for (const Algorithm* algorithm : algorithms())
    for (const ParameterInfo* row : algorithm->parameters()) EXPECT_EQ(keys.count(row->key), 1U) << row->key;
}

TEST(Algorithms, EveryParameterIsCheckedAgainstItsRange) {
  for (const Algorithm* algorithm : algorithms()) {
    const auto rows = algorithm->parameters();
    const auto defaults = algorithm->values({});
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const ParameterInfo& row = *rows[k];
      EXPECT_GE(defaults[k], row.minimum) << row.key;
      EXPECT_LE(defaults[k], row.maximum) << row.key;
      for (const float bad : {row.minimum - 1.0F, row.maximum * 2.0F, std::numeric_limits<float>::quiet_NaN()}) {
        banyan::Setup setup;
        setup.parameters = {{std::string(row.key), static_cast<double>(bad)}};
        EXPECT_NE(algorithm->fault(setup), "") << row.key << " = " << bad;
      }
    }
  }
}

TEST(Algorithms, ValuesOfTheSetupCountAndUnknownKeysDoNot) {
  banyan::Setup setup;
  setup.parameters = {{"speed_gain", 0.25}, {"nonsense", 7.0}};
  setup.arrival_distance_m = 0.3;
  for (const Algorithm* algorithm : algorithms()) {
    EXPECT_EQ(value_of(*algorithm, setup, "speed_gain"), 0.25F);
    EXPECT_EQ(value_of(*algorithm, setup, "arrival_distance"), 0.15F) << "C is 2 m";
    EXPECT_EQ(algorithm->fault(setup), "");
  }
}

// Lengths are in C and times in rounds or drives, so no default depends on the robot; the tolerance is the mission's.
TEST(Algorithms, DefaultsAreTheSameForEveryRobot) {
  banyan::Setup drone;
  drone.platform = {.communication_range_m = 1000.0F,
                    .tick_s = 0.2F,
                    .wheel_limit_m_s = 15.0F,
                    .wheel_distance_m = 0.4F,
                    .body_radius_m = 1.0F,
                    .drive = Drive::holonomic};
  drone.arrival_distance_m = 100.0;
  for (const Algorithm* algorithm : algorithms()) {
    EXPECT_EQ(algorithm->values(drone), algorithm->values(banyan::Setup{})) << algorithm->name();
    EXPECT_EQ(algorithm->fault(drone), "") << algorithm->name();
  }
}

const ConvoyParams& params_of(const Swarm& swarm) { return swarm_as<ConvoySwarm>(swarm).params(); }

// Where bodies need room, bodies larger than a Khepera IV's at 2 m get as much more.
TEST(Algorithms, RoomForBodiesGrowsWithThem) {
  const auto params = [](float range_m, float radius_m) {
    banyan::Setup setup;
    setup.platform.communication_range_m = range_m;
    setup.platform.body_radius_m = radius_m;
    return params_of(*convoy().make(setup, std::array<Member, 1>{{{.id = 0, .worker = false, .root = true}}}));
  };
  const ConvoyParams usual = params(2.0F, 0.0704F);
  EXPECT_EQ(usual.clearance, 0.08F);
  EXPECT_FLOAT_EQ(params(2.0F, 0.1408F).clearance, 2.0F * usual.clearance);
  EXPECT_FLOAT_EQ(params(1.0F, 0.0704F).spare_avoidance, 2.0F * usual.spare_avoidance);
  EXPECT_EQ(params(20.0F, 0.0704F).clearance, usual.clearance) << "never less";
  EXPECT_EQ(params(1.0F, 0.0704F).corridor_width, usual.corridor_width) << "a width of the chain's";
}

TEST(Algorithms, RefuseRobotsThatNoAlgorithmIsMadeFor) {
  for (const Algorithm* algorithm : algorithms()) {
    const auto fault = [&](float range_m, float radius_m, float tick_s) {
      banyan::Setup setup;
      setup.platform.communication_range_m = range_m;
      setup.platform.body_radius_m = radius_m;
      setup.platform.tick_s = tick_s;
      return algorithm->fault(setup);
    };
    EXPECT_EQ(fault(2.0F, 0.33F, 0.1F), "");
    EXPECT_NE(fault(2.0F, 0.35F, 0.1F).find("radius"), std::string::npos) << "wider than 0.17 C";
    EXPECT_EQ(fault(2.0F, 0.0704F, 0.4F), "");
    EXPECT_NE(fault(2.0F, 0.0704F, 0.41F).find("control periods"), std::string::npos) << "24 rounds per drive";
    EXPECT_EQ(fault(2.0F, 0.0704F, 0.005F), "");
    EXPECT_NE(fault(2.0F, 0.0704F, 0.0049F).find("control periods"), std::string::npos) << "2,041";
  }
}

TEST(Algorithms, TimesThatSlowRobotsCannotCountAreAFault) {
  banyan::Setup setup;
  setup.parameters = {{"regroup_after_drives", 30.0}};
  EXPECT_EQ(convoy().fault(setup), "");
  setup.platform.tick_s = 0.005F;  // 2,000 rounds per drive
  EXPECT_TRUE(convoy().fault(setup).starts_with("regroup_after_drives must be at most 25 "));
}

// A reason and the values of all that it names, also of what nobody has set.
TEST(Algorithms, AFaultOfParametersSaysWhyAndWhatTheyAre) {
  const auto fault = [](const Algorithm& algorithm, std::vector<std::pair<std::string, double>> parameters,
                        const Platform& platform = {}) {
    banyan::Setup setup;
    setup.platform = platform;
    setup.parameters = std::move(parameters);
    return algorithm.fault(setup);
  };
  EXPECT_EQ(
      fault(convoy(), {{"safe_range", 0.2}}),
      "recruitment_distance (E) must be below safe_range (S), else an edge would stop growing before it asks for a "
      "spare; here safe_range = 0.2 C, recruitment_distance = 0.825 C by default");
  EXPECT_EQ(fault(*algorithms().find("chains"), {{"safe_distance", 0.7}, {"critical_distance", 0.6}}),
            "safe_distance must be below critical_distance, else a robot would go on and go back at the same distance; "
            "here safe_distance = 0.7 C, critical_distance = 0.6 C");
  Platform slow;
  slow.tick_s = 0.01F;  // 1,000 rounds in a drive
  EXPECT_EQ(fault(outwards(), {{"reconfiguration_drives", 40.0}}, slow),
            "reconfiguration_drives (R) must be below 30,000 rounds, else the numbers of its messages run out; here "
            "reconfiguration_drives = 40 drives (40000 rounds)");
  // Each parameter alone, at either end of its range: whatever is refused has a reason beside the rule.
  for (const Algorithm* algorithm : algorithms()) {
    for (const ParameterInfo* row : algorithm->parameters()) {
      for (const float end : {row->minimum, row->maximum}) {
        const std::string text = fault(*algorithm, {{std::string(row->key), static_cast<double>(end)}});
        if (text.empty()) continue;
        EXPECT_TRUE(text.find(", else ") != std::string::npos || text.find(": ") != std::string::npos) << text;
        EXPECT_NE(text.find(std::string(row->key) + " = "), std::string::npos) << text;
      }
    }
  }
}

TEST(Algorithms, DistancesOutOfOrderAreAFault) {
  banyan::Setup setup;
  setup.parameters = {{"safe_range", 0.975}};
  for (const Algorithm* algorithm : {&outwards(), &inwards()})
    EXPECT_NE(algorithm->fault(setup).find("safe_range"), std::string::npos);
}

}  // namespace
}  // namespace banyan
