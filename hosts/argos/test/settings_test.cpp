// SPDX-License-Identifier: MIT
#include "banyan/hosts/argos/settings.hpp"

#include <gtest/gtest.h>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/config/config.hpp"

namespace banyan::argos {
namespace {

std::string fault_of(const std::vector<Attribute>& attributes) {
  try {
    (void)read_settings(attributes, algorithms(), 0.1);
  } catch (const SettingsError& error) { return error.what(); }
  return "";
}

// What a scenario says of its robots arrives through the attributes, for all algorithms.
world::Scenario paper_medium(const std::vector<std::string>& assignments) {
  std::vector<config::Override> overrides;
  overrides.reserve(assignments.size());
  for (const std::string& assignment : assignments) overrides.push_back({assignment, "test"});
  auto loaded =
      config::load_configuration(std::string(BANYAN_SCENARIOS) + "/paper-medium.toml", algorithms(), overrides);
  EXPECT_TRUE(loaded.ok());
  return loaded.configuration.scenario;
}

TEST(Settings, CarryAScenario) {
  for (const Algorithm* algorithm : algorithms()) {
    const std::string name(algorithm->name());
    const world::Scenario scenario =
        paper_medium({"mission.algorithm=" + name, "radio.range_m=2.5", "robot.wheel_limit_m_s=0.15"});
    const Settings settings = read_settings(attributes_of(scenario), algorithms(), scenario.tick_s);
    EXPECT_EQ(settings.algorithm, algorithm);
    EXPECT_EQ(settings.algorithm->values(settings.setup), algorithm->values(world::setup_of(scenario))) << name;
    EXPECT_EQ(settings.setup.platform.communication_range_m, 2.5F);
    EXPECT_EQ(settings.setup.platform.wheel_limit_m_s, 0.15F);
    EXPECT_TRUE(settings.setup.platform.line_of_sight);
  }
}

TEST(Settings, ParametersAreThoseOfTheTable) {
  const Settings settings =
      read_settings(std::vector<Attribute>{{"algorithm", "outwards"}, {"target_gain", "0.5"}}, algorithms(), 0.1);
  const auto rows = settings.algorithm->parameters();
  const auto values = settings.algorithm->values(settings.setup);
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (rows[k]->key == "target_gain") { EXPECT_EQ(values[k], 0.5F); }
  EXPECT_EQ(settings.assignments,
            (std::vector<std::string>{"mission.algorithm=outwards", "mission.parameters.target_gain=0.5"}));
}

TEST(Settings, RobotsMayBeToldHowTheyBegin) {
  const Settings settings =
      read_settings(std::vector<Attribute>{{"role", "worker"}, {"target_m", "3,-1.5"}}, algorithms(), 0.1);
  EXPECT_EQ(settings.part, StartRole::worker);
  ASSERT_TRUE(settings.target);
  EXPECT_EQ(settings.target->y, -1.5);
}

TEST(Settings, CarryTwoPaths) {
  const world::Scenario scenario = paper_medium({"mission.algorithm=convoy", "mission.link_redundancy=2"});
  EXPECT_EQ(read_settings(attributes_of(scenario), algorithms(), scenario.tick_s).setup.link_redundancy, 2);
  EXPECT_NE(fault_of({{"algorithm", "outwards"}, {"link_redundancy", "2"}}).find("outwards keeps one path"),
            std::string::npos);
  EXPECT_NE(fault_of({{"link_redundancy", "1.5"}}).find("must be a whole number"), std::string::npos);
  EXPECT_NE(fault_of({{"link_redundancy", "4"}}).find("link_redundancy"), std::string::npos);
}

TEST(Settings, SayWhatIsWrongAllAtOnce) {
  EXPECT_NE(fault_of({{"algorithm", "convoi"}}).find("did you mean \"convoy\"?"), std::string::npos)
      << fault_of({{"algorithm", "convoi"}});
  EXPECT_NE(fault_of({{"rnage_m", "2"}}).find("rnage_m is unknown to the algorithm convoy; did you mean range_m?"),
            std::string::npos);
  EXPECT_NE(fault_of({{"algorithm", "outwards"}, {"target_gian", "1"}}).find("did you mean target_gain?"),
            std::string::npos);
  const std::string many = fault_of({{"range_m", "far"},
                                     {"line_of_sight", "yes"},
                                     {"reading", "loose"},
                                     {"radius_m", "-1"},
                                     {"role", "boss"},
                                     {"target_m", "3"}});
  for (const char* word : {"range_m must be a number", "line_of_sight must be true or false", "reading",
                           "radius_m is -1", "role", "target_m must be X,Y"})
    EXPECT_NE(many.find(word), std::string::npos) << word << " in " << many;
  EXPECT_NE(fault_of({{"algorithm", "outwards"}, {"target_gain", "nan"}}), "");
  EXPECT_NE(fault_of({{"algorithm", "outwards"}, {"target_gain", "1e9"}}).find("target_gain is"), std::string::npos);
}

}  // namespace
}  // namespace banyan::argos
