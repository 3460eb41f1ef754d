// SPDX-License-Identifier: MIT
// From a study to its runs: all of them, in order, each with an id that means what is simulated.
#include "banyan/study/plan.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>

#include "banyan/algorithms/algorithms.hpp"
#include "temporary_folder.hpp"

namespace banyan::study {
namespace {

std::string all_problems(const Plan& plan) {
  std::string text;
  for (const auto& p : plan.problems) text += config::to_string(p) + "\n";
  return text;
}

const std::string world =
    "name = \"w\"\n[mission]\ntime_limit_s = 5.0\n[swarm]\nrobots = 6\n[targets]\ncount = 2\nradius_m = 0.9\n";

class PlanTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    write("w.toml", world);
  }
  [[nodiscard]] Plan plan_of(const std::string& text) const {
    const auto loaded = parse_study(path("s.toml"), text);
    std::string problems;
    for (const auto& p : loaded.problems) problems += config::to_string(p) + "\n";
    EXPECT_TRUE(loaded.ok()) << problems;
    return make_plan(loaded.study, algorithms());
  }
  [[nodiscard]] Plan good(const std::string& text) const {
    auto plan = plan_of(text);
    EXPECT_TRUE(plan.ok()) << all_problems(plan);
    return plan;
  }
  // The id of the only run of w.toml with this set.
  [[nodiscard]] std::string id_with(const std::string& set, const std::string& seeds = "[1]") const {
    const auto plan = good("scenario = \"w.toml\"\nseeds = " + seeds + "\n[set]\n" + set);
    return plan.runs.empty() ? "" : plan.runs.front().id;
  }
};

std::string axis(const std::string& name, const std::string& key, const std::string& values) {
  return "[[axes]]\nname = \"" + name + "\"\nkey = \"" + key + "\"\nvalues = " + values + "\n";
}

const std::string plan_head = "scenario = \"w.toml\"\nseeds = [5, 3]\n";

TEST_F(PlanTest, CountsTheLastAxisAndThenTheSeedFastest) {
  const auto plan = good(plan_head + axis("a", "mission.algorithm", "[\"outwards\", \"inwards\"]") +
                         axis("l", "radio.loss", "[0, 0.5]"));
  ASSERT_EQ(plan.rows.size(), 8U);
  ASSERT_EQ(plan.combinations.size(), 4U);
  std::vector<std::string> order;
  for (const auto& row : plan.rows) {
    const auto configuration = configuration_of(plan, plan.runs[row.run]);
    EXPECT_EQ(configuration.scenario.seed, row.seed);
    EXPECT_EQ(configuration.scenario.mission.algorithm, row.values[0] ? "inwards" : "outwards");
    EXPECT_EQ(configuration.scenario.radio.loss, row.values[1] ? 0.5 : 0.0);
    EXPECT_FALSE(configuration.output["record"]);
    order.push_back(std::to_string(row.values[0]) + std::to_string(row.values[1]) + std::to_string(row.seed));
  }
  EXPECT_EQ(order, (std::vector<std::string>{"005", "003", "015", "013", "105", "103", "115", "113"}));
  EXPECT_EQ(plan.runs[3].directory, "a=outwards,l=0.5/seed=3");
  EXPECT_EQ(plan.runs[0].cost, 6 * 50.0);  // robots times ticks
}

TEST_F(PlanTest, LaterChangesWin) {
  write("tuned.toml", "radio.loss = 0.1\nradio.range_m = 3.0\n");
  const auto loss = [&](const std::string& text) {
    return good(plan_head + text).combinations.at(0).scenario.radio.loss;
  };
  EXPECT_EQ(loss("with = \"tuned.toml\"\n"), 0.1);
  EXPECT_EQ(loss("with = \"tuned.toml\"\nset = { radio.loss = 0.2 }\n"), 0.2);
  EXPECT_EQ(loss("set.radio.loss = 0.2\n[[parts]]\nname = \"p\"\nset = { radio.loss = 0.3 }\n"), 0.3);
  EXPECT_EQ(loss("set.radio.loss = 0.2\n" + axis("l", "radio.loss", "[0.4]")), 0.4);
  auto loaded = parse_study(path("s.toml"), plan_head + "set.radio.loss = 0.2\n", {{"radio.loss=0.6", "--set"}});
  EXPECT_EQ(make_plan(loaded.study, algorithms()).combinations.at(0).scenario.radio.loss, 0.6);
}

TEST_F(PlanTest, AScenarioAxisChoosesTheWorld) {
  write("v.toml", world + "[radio]\nloss = 0.5\n");
  const auto plan = good("seeds = [1]\n" + axis("world", "scenario", "[\"w.toml\", \"v.toml\"]"));
  ASSERT_EQ(plan.combinations.size(), 2U);
  EXPECT_EQ(plan.combinations[0].scenario.radio.loss, 0.0);
  EXPECT_EQ(plan.combinations[1].scenario.radio.loss, 0.5);
}

TEST_F(PlanTest, IdsMeanWhatIsSimulated) {
  const auto id = id_with("");
  EXPECT_EQ(id_with("name = \"other\"\n"), id);
  EXPECT_EQ(id_with("description = \"other\"\n"), id);
  EXPECT_EQ(id_with("output.record = true\noutput.series = true\n"), id);
  EXPECT_EQ(id_with("radio.loss = 0.0\n"), id) << "a default that is written down";

  std::set<std::string> ids{id, id_with("", "[2]")};
  const std::vector<std::string> changes{"mission.algorithm = \"inwards\"",
                                         "mission.reading = \"literal\"",
                                         "mission.time_limit_s = 6.0",
                                         "mission.stop_when_complete = false",
                                         "mission.parameters.target_gain = 0.25",
                                         "swarm.robots = 7",
                                         "swarm.start.center_m = [0.1, 0]",
                                         "robot.body = \"linear\"",
                                         "mission.link_redundancy = 2",
                                         "battery.model = \"time\"",
                                         "radio.model = \"bursts\"",
                                         "radio.range_m = 2.5",
                                         "radio.line_of_sight = true",
                                         "radio.loss = 0.1",
                                         "radio.sight_leak = 0.1",
                                         "radio.bearing_noise_deg = 3",
                                         "targets.count = 3",
                                         "targets.radius_m = 1.0",
                                         "targets.phase_deg = 10",
                                         "tick_s = 0.05",
                                         "obstacles = [{ kind = \"disc\", center_m = [5, 5], radius_m = 0.5 }]",
                                         "events = [{ time_s = 1, kind = \"freeze\", robot = 1, duration_s = 1 }]"};
  for (const auto& change : changes) ids.insert(id_with(change + "\n"));
  EXPECT_EQ(ids.size(), 2 + changes.size());
}

TEST_F(PlanTest, TheOrderOfAxesChangesNoId) {
  const auto ids = [&](const std::string& axes) {
    std::set<std::string> set;
    for (const auto& run : good(plan_head + axes).runs) set.insert(run.id);
    return set;
  };
  const auto a = axis("a", "mission.algorithm", "[\"outwards\", \"inwards\"]"), l = axis("l", "radio.loss", "[0, 0.5]");
  EXPECT_EQ(ids(a + l), ids(l + a));
  EXPECT_EQ(ids(a + l).size(), 8U);
}

TEST_F(PlanTest, PartsShareARunThatBothAskFor) {
  const auto plan =
      good(plan_head + "[[parts]]\nname = \"p\"\n[[parts.axes]]\nkey = \"radio.loss\"\nvalues = [0, 0.1]\n" +
           "[[parts]]\nname = \"q\"\n[[parts.axes]]\nkey = \"radio.loss\"\nvalues = [0.1, 0.2]\n");
  EXPECT_EQ(plan.rows.size(), 8U);
  EXPECT_EQ(plan.runs.size(), 6U);
  EXPECT_EQ(plan.rows[2].run, plan.rows[4].run);
  EXPECT_EQ(plan.rows[4].part, 1U);
}

TEST_F(PlanTest, TwoEqualRunsInOnePartAreAFault) {
  const auto plan = plan_of(plan_head + axis("a", "radio.loss", "[0.1, 0.2]") + axis("b", "radio.loss", "[0.3, 0.4]"));
  EXPECT_FALSE(plan.ok());
  ASSERT_EQ(plan.problems.size(), 1U) << all_problems(plan);
  EXPECT_NE(plan.problems[0].text.find("two of its runs are the same: (a=0.1, b=0.3) and (a=0.2, b=0.3) with seed 5"),
            std::string::npos)
      << plan.problems[0].text;
}

TEST_F(PlanTest, AFaultIsToldOnceWithItsCombination) {
  const auto everywhere = plan_of(plan_head + "set.radio.los = 1\n" + axis("r", "radio.range_m", "[2, 3]"));
  ASSERT_EQ(everywhere.problems.size(), 1U) << all_problems(everywhere);
  EXPECT_NE(all_problems(everywhere).find("s.toml:3: error: radio.los: "), std::string::npos)
      << all_problems(everywhere);
  EXPECT_EQ(all_problems(everywhere).find("combinations"), std::string::npos);

  const auto somewhere = plan_of(plan_head + axis("r", "radio.range_m", "[2, 3]") + axis("l", "radio.loss", "[0, 7]"));
  ASSERT_EQ(somewhere.problems.size(), 1U) << all_problems(somewhere);
  EXPECT_NE(all_problems(somewhere).find("s.toml:10: error: radio.loss: "), std::string::npos)
      << all_problems(somewhere);
  EXPECT_NE(all_problems(somewhere).find("(in 2 combinations of axes, the first: r=2, l=7)"), std::string::npos)
      << all_problems(somewhere);
}

TEST_F(PlanTest, ScenariosThatCannotBeReadAreToldOnce) {
  const auto plan = plan_of("scenario = \"none.toml\"\nseeds = [1]\n" + axis("r", "radio.range_m", "[2, 3]"));
  ASSERT_EQ(plan.problems.size(), 1U) << all_problems(plan);
  EXPECT_NE(all_problems(plan).find("none.toml: error: there is no such file"), std::string::npos);
  EXPECT_FALSE(plan.ok());
}

TEST_F(PlanTest, DirectoriesAreUniqueAndTame) {
  std::string labels = "[";
  for (const char* label : {"a/b", "a b", "a:b", "../..", "\xC3\xA9"}) labels += "\"" + std::string(label) + "\", ";
  labels += "\"" + std::string(300, 'x') + "\", \"" + std::string(300, 'x') + "y\"]";
  const auto plan =
      good(plan_head + axis("l", "radio.loss", "[0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6]") + "labels = " + labels + "\n");
  std::set<std::string> directories;
  for (const auto& run : plan.runs) {
    directories.insert(run.directory);
    EXPECT_EQ(std::count(run.directory.begin(), run.directory.end(), '/'), 1) << run.directory;
    EXPECT_FALSE(run.directory.starts_with('.'));
    EXPECT_LT(run.directory.size(), 250U);
    EXPECT_TRUE(std::all_of(run.directory.begin(), run.directory.end(), [](char c) { return c > ' ' && c < 127; }));
  }
  EXPECT_EQ(directories.size(), plan.runs.size());
}

TEST_F(PlanTest, TheDigestIsOfWhatIsRunAlone) {
  const auto digest = [&](const std::string& text) { return plan_text(good(text)); };
  const auto one = digest(plan_head + axis("l", "radio.loss", "[0, 0.5]"));
  EXPECT_EQ(one.size(), 16U);
  EXPECT_EQ(digest("name = \"x\"\nfigures = []\n" + plan_head + axis("loss", "radio.loss", "[0, 0.5]")), one);
  EXPECT_NE(digest(plan_head + axis("l", "radio.loss", "[0.5, 0]")), one);
  EXPECT_NE(digest(plan_head + axis("l", "radio.loss", "[0]")), one);
  EXPECT_NE(digest("scenario = \"w.toml\"\nseeds = [5, 4]\n" + axis("l", "radio.loss", "[0, 0.5]")), one);
}

TEST_F(PlanTest, TheScenariosOwnSeedAndRecordingDoNotCount) {
  const auto id = id_with("");
  write("w.toml", "seed = 99\n" + world + "[output]\nrecord = true\n");
  EXPECT_EQ(id_with(""), id);
  EXPECT_FALSE(good(plan_head).combinations.at(0).output["record"]);
  EXPECT_TRUE(good(plan_head + "set.output.record = true\n").combinations.at(0).output["record"]);
}

// Axes of these change a world in ways of their own.
const std::vector<std::string> keys{"radio.loss", "radio.range_m", "targets.radius_m"};

RC_GTEST_FIXTURE_PROP(PlanTest, HoldsEveryCombinationOnce, ()) {
  const auto sizes = *rc::gen::resize(4, rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 4)));
  const auto seeds = *rc::gen::inRange(1, 4);
  std::string text = "scenario = \"w.toml\"\nseeds = \"11-" + std::to_string(10 + seeds) + "\"\n";
  const std::size_t axes = std::min<std::size_t>(sizes.size(), 3);
  for (std::size_t a = 0; a < axes; ++a) {
    std::string values;
    for (int v = 0; v < sizes[a]; ++v)
      values += std::string(v > 0 ? ", " : "") + (a == 0 ? "0." : "2.") + std::to_string(v + 1);
    text += axis("axis" + std::to_string(a), keys[a], "[" + values + "]");
  }
  const auto loaded = parse_study(path("s.toml"), text);
  RC_ASSERT(loaded.ok());
  const auto plan = make_plan(loaded.study, algorithms());
  RC_ASSERT(plan.ok());

  // Counted by nested loops, the last axis and then the seed fastest.
  std::vector<std::pair<std::vector<std::size_t>, std::uint64_t>> wanted;
  const auto size_of = [&](std::size_t a) { return a < axes ? static_cast<std::size_t>(sizes[a]) : 1U; };
  for (std::size_t i = 0; i < size_of(0); ++i)
    for (std::size_t j = 0; j < size_of(1); ++j)
      for (std::size_t k = 0; k < size_of(2); ++k)
        for (int s = 0; s < seeds; ++s) {
          std::vector<std::size_t> values{i, j, k};
          values.resize(axes);
          wanted.emplace_back(values, 11 + static_cast<std::uint64_t>(s));
        }
  RC_ASSERT(plan.rows.size() == wanted.size());
  RC_ASSERT(count_rows(loaded.study) == static_cast<double>(wanted.size()));
  std::set<std::string> ids;
  for (std::size_t row = 0; row < wanted.size(); ++row) {
    RC_ASSERT(plan.rows[row].values == wanted[row].first);
    RC_ASSERT(plan.rows[row].seed == wanted[row].second);
    ids.insert(plan.runs[plan.rows[row].run].id);
  }
  RC_ASSERT(ids.size() == wanted.size());
}

TEST_F(PlanTest, SaysHowFarItIs) {
  const auto loaded = parse_study(
      path("s.toml"), "scenario = \"w.toml\"\nseeds = \"1-2500\"\n" + axis("loss", "radio.loss", "[0.0, 0.1]"));
  ASSERT_TRUE(loaded.ok());
  std::vector<double> told;
  const auto plan = make_plan(loaded.study, algorithms(), [&](double rows) { told.push_back(rows); });
  ASSERT_EQ(plan.rows.size(), 5000U);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_GE(told.size(), 6U);  // every thousand
  EXPECT_EQ(told.back(), 5000.0);
}

RC_GTEST_PROP(Shards, TogetherHoldEachRunOnce, ()) {
  const auto count = *rc::gen::inRange<std::size_t>(1, 50);
  const auto runs = *rc::gen::inRange<std::size_t>(0, 200);
  for (std::size_t run = 0; run < runs; ++run) {
    std::size_t holders = 0;
    for (std::size_t number = 1; number <= count; ++number) holders += Shard{number, count}.holds(run) ? 1 : 0;
    RC_ASSERT(holders == 1U);
  }
  RC_ASSERT(Shard{}.whole());
}

}  // namespace
}  // namespace banyan::study
