// SPDX-License-Identifier: MIT
#include "banyan/hosts/argos/experiment.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/hosts/argos/mission.hpp"

namespace banyan::argos {
namespace {

world::Scenario scenario(const char* name, const std::vector<std::string>& assignments = {}) {
  return load_mission(std::string(BANYAN_SCENARIOS) + "/" + name, assignments, algorithms()).scenario;
}

Experiment experiment(const char* robot = "kheperaiv") {
  Experiment e;
  e.made_by = "a test";
  e.world = "/somewhere/world.toml";
  e.out = "/somewhere/out";
  e.library = "/somewhere/libbanyan_argos.so";
  e.robot = find_robot_kind(robot);
  return e;
}

// BANYAN_RENEW_GOLDEN=1 writes the file anew.
TEST(Experiment, OfThePapersMediumScale) {
  const std::string path = std::string(BANYAN_ARGOS_TEST) + "/paper-medium.argos";
  const std::string xml = experiment_xml(scenario("paper-medium.toml"), experiment());
  if (std::getenv("BANYAN_RENEW_GOLDEN") != nullptr) std::ofstream(path) << xml;
  std::ostringstream golden;
  golden << std::ifstream(path).rdbuf();
  EXPECT_EQ(xml, golden.str());
}

TEST(Experiment, SaysWhatTheScenarioSays) {
  Experiment e = experiment("foot-bot");
  e.sight = Sight::exact;
  const std::string xml = experiment_xml(
      with_robot(scenario("wall-with-gap.toml", {"radio.line_of_sight=true", "radio.loss=0.3", "seed=42"}), *e.robot),
      e);
  for (const char* words :
       {"packet_drop_prob=\"0.3\"", "<footbot_proximity implementation=\"default\" />", "random_seed=\"42\"",
        "wheel_distance_m=\"0.14\"", "<banyan_exact_range_and_bearing id=\"rab\" />", "robot=\"foot-bot\"",
        "line_of_sight=\"true\""})
    EXPECT_NE(xml.find(words), std::string::npos) << words << " in\n" << xml;
  e.eyes = Eyes::world;
  EXPECT_EQ(experiment_xml(scenario("wall-with-gap.toml"), e).find("footbot_proximity"), std::string::npos);
}

// Elements are closed in the order in which they were opened, and what users write cannot break out.
TEST(Experiment, IsWellFormed) {
  Experiment e = experiment();
  e.out = "/a \"strange\" <folder> & more";
  e.made_by = "someone -- or other --";
  const std::string xml = experiment_xml(scenario("rooms.toml"), e);
  EXPECT_NE(xml.find("out=\"/a &quot;strange&quot; &lt;folder&gt; &amp; more\""), std::string::npos);
  EXPECT_EQ(xml.find("someone --"), std::string::npos);
  const std::regex tag(R"(<(/?)([a-z_0-9-]+)((?: [a-z_0-9]+="[^"<>]*")*)( ?/?)>)");
  std::vector<std::string> open;
  std::size_t tags = 0;
  for (std::sregex_iterator at(xml.begin(), xml.end(), tag), end; at != end; ++at, ++tags) {
    if ((*at)[1].length() > 0) {
      ASSERT_FALSE(open.empty());
      EXPECT_EQ(open.back(), (*at)[2].str());
      open.pop_back();
    } else if ((*at)[4].length() == 0) {
      open.push_back((*at)[2]);
    }
  }
  EXPECT_TRUE(open.empty());
  EXPECT_GT(tags, 20U);
}

// Nobody who drives between start, targets and obstacles leaves the arena.
TEST(Experiment, ArenaHoldsEverything) {
  for (const char* name : {"paper-small.toml", "corridor.toml", "following.toml", "ring-of-8.toml"}) {
    const world::Scenario s = scenario(name);
    const std::string xml = experiment_xml(s, experiment());
    std::smatch found;
    ASSERT_TRUE(std::regex_search(xml, found,
                                  std::regex(R"(<arena size="([0-9.]+),([0-9.]+),1" center="([-0-9.]+),([-0-9.]+),)")))
        << xml;
    const double width = std::stod(found[1]), height = std::stod(found[2]), x = std::stod(found[3]),
                 y = std::stod(found[4]);
    for (const world::Vec2 p : world::target_positions(s)) {
      EXPECT_LT(std::abs(p.x - x), 0.5 * width - 9.9) << name;
      EXPECT_LT(std::abs(p.y - y), 0.5 * height - 9.9) << name;
    }
  }
}

}  // namespace
}  // namespace banyan::argos
