// SPDX-License-Identifier: MIT
// A link of the page is the same experiment here as there: against the scenario file that says the same.
#include "link.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "banyan/algorithms/algorithms.hpp"

namespace banyan::cli {
namespace {

using config::config_json;

std::string three_targets() {
  std::ifstream in(BANYAN_SCENARIOS "/three-targets.toml");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

config::Loaded scenario(const std::string& text) {
  return config::parse_configuration("three-targets.toml", text, algorithms());
}

std::string problem_of(const std::string& link) {
  const auto loaded = load_link(link).loaded;
  EXPECT_FALSE(loaded.ok()) << link;
  return loaded.problems.empty() ? "" : to_string(loaded.problems.front());
}

TEST(Link, IsToldFromAFile) {
  for (const char* link : {"#rooms", "http://127.0.0.1:8000/?start#rooms", "https://example.org/page/#seed=3",
                           "file:///page/index.html#a"})
    EXPECT_TRUE(is_link(link)) << link;
  for (const char* file : {"", "rooms.toml", "scenarios/a#1.toml", "./#1.toml", "http://example.org/a.toml"})
    EXPECT_FALSE(is_link(file)) << file;
}

TEST(Link, WithANameIsThatScenario) {
  const auto link = load_link("http://127.0.0.1:8000/#three-targets");
  ASSERT_TRUE(link.loaded.ok());
  EXPECT_EQ(config_json(link.loaded.configuration), config_json(scenario(three_targets()).configuration));
  EXPECT_EQ(link.fragment, "#three-targets");
  EXPECT_EQ(link.runs, 1U);
}

TEST(Link, CarriesChangesAndWhatWasDone) {
  const auto link = load_link(
      "#scenario=three-targets&algorithm=outwards&algorithm=convoy&seed=7&set=radio.loss%3D0.25&t=9&view=1,2,30&robot=3"
      "&do=20:%7B%22kind%22%3A%22die%22%2C%22robot%22%3A4%7D&do=30@1:{\"kind\":\"set_loss\",\"loss\":0.5}"
      "&do=30@2:{\"kind\":\"set_loss\",\"loss\":0.9}");
  ASSERT_TRUE(link.loaded.ok()) << to_string(link.loaded.problems.front());
  EXPECT_EQ(link.runs, 2U);
  std::string text = three_targets();
  auto expected = config::parse_configuration(
      "three-targets.toml",
      text +
          "\n[[events]]\nkind = \"die\"\nrobot = 4\ntime_s = 2.0\n[[events]]\nkind = \"set_loss\"\nloss = 0.5\ntime_s "
          "= 3.0\n",
      algorithms(), {{"radio.loss=0.25", "", {}}, {"seed=7", "", {}}, {"mission.algorithm=outwards", "", {}}});
  ASSERT_TRUE(expected.ok());
  EXPECT_EQ(config_json(link.loaded.configuration), config_json(expected.configuration));
}

TEST(Link, CarriesATextOfAnyLetters) {
  // name = "ä"\n[targets]\ncount = 2
  const auto link = load_link("#name=mine.toml&text=ZGVzY3JpcHRpb24gPSAiw6QiClt0YXJnZXRzXQpjb3VudCA9IDIK");
  ASSERT_TRUE(link.loaded.ok()) << to_string(link.loaded.problems.front());
  EXPECT_EQ(link.loaded.configuration.scenario.name, "mine");
  EXPECT_EQ(link.loaded.configuration.scenario.description, "ä");
}

TEST(Link, TheCommandLineHasTheLastWord) {
  const auto link = load_link("#scenario=three-targets&seed=7", {{"seed=9", "--seed 9", {}}});
  ASSERT_TRUE(link.loaded.ok());
  EXPECT_EQ(link.loaded.configuration.scenario.seed, 9U);
}

TEST(Link, SaysWhatIsWrong) {
  const auto has = [](const std::string& text, const char* words) {
    return testing::AssertionResult(text.find(words) != std::string::npos) << text;
  };
  EXPECT_TRUE(has(problem_of("#three-target"), "did you mean three-targets?"));
  EXPECT_TRUE(has(problem_of("#"), "names no scenario"));
  EXPECT_TRUE(has(problem_of("#../secret"), "there is no scenario"));
  EXPECT_TRUE(has(problem_of("#scenario=three-targets&algoritm=mst"), "did you mean algorithm?"));
  EXPECT_TRUE(has(problem_of("#scenario=three-targets&do=5"), "it is a tick, a colon and an event as JSON"));
  EXPECT_TRUE(has(problem_of("#scenario=three-targets&do=99999999999999999999:{}"), "it is a tick"));
  EXPECT_TRUE(has(problem_of("#scenario=three-targets&do=5:{\"kind\":\"die\",\"robot\":99}"), "robot"));
  EXPECT_TRUE(has(problem_of("#scenario=three-targets&do=5:[1]"), "error"));
  EXPECT_TRUE(has(problem_of("#scenario=three-targets&do=5:{"), "error"));
  EXPECT_TRUE(has(problem_of("#text=%2A"), "is not base64url"));
  EXPECT_TRUE(has(problem_of("#recording=a.mcap"), "shows a recording"));
  EXPECT_TRUE(has(problem_of("#scenario=three targets"), "no address has"));
  EXPECT_TRUE(has(problem_of("#scenario=three-targets&set=radio.los=1"), "radio.los"));
  EXPECT_TRUE(has(problem_of("#scenario=three-targets&seed=-1"), "seed"));
}

}  // namespace
}  // namespace banyan::cli
