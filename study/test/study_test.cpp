// SPDX-License-Identifier: MIT
// What a study file means, and that everything wrong with one is said with its line.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "banyan/study/plan.hpp"
#include "banyan/study/study.hpp"
#include "temporary_folder.hpp"

namespace banyan::study {
namespace {

std::string all_problems(const LoadedStudy& loaded) {
  std::string text;
  for (const auto& p : loaded.problems) text += config::to_string(p) + "\n";
  return text;
}

::testing::AssertionResult says(const LoadedStudy& loaded, const std::string& part) {
  const auto text = all_problems(loaded);
  if (text.find(part) != std::string::npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "\"" << part << "\" is not in:\n" << text;
}

std::vector<std::string> labels_of(const Axis& axis) {
  std::vector<std::string> labels;
  for (const auto& value : axis.values) labels.push_back(value.label);
  return labels;
}

std::vector<std::string> names_of(const Part& part) {
  std::vector<std::string> names;
  for (const auto& axis : part.axes) names.push_back(axis.name);
  return names;
}

const std::string head = "scenario = \"w.toml\"\nseeds = \"1-3\"\n";  // lines 1 and 2

class StudyFile : public TemporaryFolder {
 protected:
  [[nodiscard]] LoadedStudy parse(const std::string& text, const std::vector<config::Override>& overrides = {},
                                  const std::string& name = "s.toml") const {
    return parse_study(path(name), text, overrides);
  }
  [[nodiscard]] Study good(const std::string& text) const {
    auto loaded = parse(text);
    EXPECT_TRUE(loaded.ok()) << all_problems(loaded);
    return loaded.study;
  }
  // Without the folder, so that places are short.
  [[nodiscard]] static LoadedStudy bad(const std::string& text) {
    auto loaded = parse_study("s.toml", text);
    EXPECT_FALSE(loaded.ok());
    return loaded;
  }
};

TEST_F(StudyFile, NeedsLittle) {
  const auto study = good(head);
  EXPECT_EQ(study.name, "s");
  EXPECT_EQ(study.text, head);
  ASSERT_EQ(study.parts.size(), 1U);
  EXPECT_EQ(study.parts[0].name, "");
  EXPECT_EQ(study.parts[0].scenario, path("w.toml")) << "relative to the file";
  EXPECT_EQ(study.parts[0].seeds, (std::vector<std::uint64_t>{1, 2, 3}));
  EXPECT_EQ(study.parts[0].combinations(), 1.0);
  EXPECT_EQ(count_rows(study), 3.0);
}

TEST_F(StudyFile, IsLaidOverItsBase) {
  std::filesystem::create_directories(path("deep"));
  write("deep/base.toml",
        "name = \"base\"\ndescription = \"d\"\nscenario = \"w.toml\"\nseeds = [1]\n"
        "[set]\nradio.loss = 0.5\n[[axes]]\nkey = \"scenario\"\nvalues = [\"x.toml\"]\n");
  const auto study = good("base = \"deep/base.toml\"\nseeds = [7, 8]\n[set]\nradio.range_m = 3\n");
  EXPECT_EQ(study.name, "s") << "the file's, not the base's";
  EXPECT_EQ(study.description, "d");
  EXPECT_EQ(study.parts.at(0).scenario, path("deep/w.toml")) << "beside the base";
  EXPECT_EQ(study.parts[0].axes.at(0).values.at(0).scenario, path("deep/x.toml"));
  EXPECT_EQ(study.parts[0].seeds, (std::vector<std::uint64_t>{7, 8}));
  EXPECT_EQ(study.parts[0].changes.size(), 1U) << "[set] of both, as one tree of radio";
  write("deep/second.toml", "name = \"second\"\nbase = \"base.toml\"\nseeds = [9]\n");
  const auto third = good("base = \"deep/second.toml\"\n");
  EXPECT_EQ(third.name, "s");
  EXPECT_EQ(third.parts.at(0).scenario, path("deep/w.toml")) << "beside the base of the base";
  EXPECT_EQ(third.parts[0].seeds, (std::vector<std::uint64_t>{9}));
  write("deep/circle.toml", "base = \"circle.toml\"\n");
  EXPECT_TRUE(says(parse("base = \"deep/circle.toml\"\n"), "deep/circle.toml:1: error: base: is one too many"));
  EXPECT_TRUE(says(parse("base = \"none.toml\"\n"), "none.toml"));
  write("deep/wrong.toml", head + "seedz = 3\n");
  EXPECT_TRUE(says(parse("base = \"deep/wrong.toml\"\n"), "deep/wrong.toml:3: error: seedz"));
}

TEST_F(StudyFile, ComparesAgainstValuesThatExist) {
  const std::string axis =
      head + "[[axes]]\nkey = \"mission.algorithm\"\nvalues = [\"outwards\", \"convoy\"]\n[statistics]\n";
  EXPECT_EQ(good(axis + "against = \"convoy\"\n").statistics.against, (std::vector<std::string>{"convoy"}));
  EXPECT_TRUE(says(parse(axis + "against = [\"convoi\"]\n"),
                   "s.toml:7: error: statistics.against: \"convoi\" is no value of the "
                   "axis \"algorithm\"; did you mean \"convoy\"?"));
}

TEST_F(StudyFile, ReadsAxesOfEveryKind) {
  write("a.toml", "radio.range_m = 3.0\n");
  const auto study = good(head + R"(
[[axes]]
key = "mission.algorithm"
values = ["outwards", "inwards"]
[[axes]]
name = "los"
title = "line of sight"
key = "radio.line_of_sight"
values = [false, true]
[[axes]]
key = "targets.radius_m"
values = [3, 4.5, 6.0]
labels = ["near", "far", "farther"]
[[axes]]
name = "size"
keys = ["swarm.robots", "targets.count"]
values = [[8, 2], [16, 4]]
[[axes]]
key = "scenario"
values = ["x.toml", "deep/y.toml"]
[[axes]]
key = "with"
values = ["", "a.toml"]
)");
  const auto& axes = study.parts.at(0).axes;
  EXPECT_EQ(names_of(study.parts[0]),
            (std::vector<std::string>{"algorithm", "los", "radius_m", "size", "scenario", "with"}));
  EXPECT_EQ(labels_of(axes[0]), (std::vector<std::string>{"outwards", "inwards"}));
  EXPECT_EQ(labels_of(axes[1]), (std::vector<std::string>{"off", "on"}));
  EXPECT_EQ(labels_of(axes[2]), (std::vector<std::string>{"near", "far", "farther"}));
  EXPECT_EQ(labels_of(axes[3]), (std::vector<std::string>{"8,2", "16,4"}));
  EXPECT_EQ(labels_of(axes[4]), (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(labels_of(axes[5]), (std::vector<std::string>{"none", "a"}));
  EXPECT_EQ(axes[0].title, "algorithm");
  EXPECT_EQ(axes[1].title, "line of sight");
  EXPECT_EQ(axes[3].values[1].changes.size(), 2U);
  EXPECT_EQ(axes[3].values[1].changes[1].key, "targets.count");
  EXPECT_EQ(std::get<std::int64_t>(axes[3].values[1].changes[1].value.value), 4);
  EXPECT_EQ(axes[4].values[1].scenario, path("deep/y.toml"));
  EXPECT_TRUE(axes[5].values[0].changes.empty());
  ASSERT_EQ(axes[5].values[1].changes.size(), 1U);
  EXPECT_EQ(axes[5].values[1].changes[0].key, "");
  EXPECT_EQ(study.parts[0].combinations(), 2.0 * 2 * 3 * 2 * 2 * 2);
}

TEST_F(StudyFile, PartsInheritAndReplace) {
  const auto study = good(head + R"(
set.swarm.robots = 8
[[axes]]
key = "mission.algorithm"
values = ["outwards", "inwards"]
[[axes]]
name = "r"
key = "targets.radius_m"
values = [3, 6]
[[parts]]
name = "first"
[[parts]]
name = "second"
scenario = "v.toml"
seeds = [9]
set = { "radio.loss" = 0.5 }
[[parts.axes]]
name = "r"
key = "targets.radius_m"
values = [9]
[[parts.axes]]
key = "radio.range_m"
values = [2, 3, 4]
)");
  ASSERT_EQ(study.parts.size(), 2U);
  const auto& first = study.parts[0];
  const auto& second = study.parts[1];
  EXPECT_EQ(first.name, "first");
  EXPECT_EQ(first.scenario, path("w.toml"));
  EXPECT_EQ(first.changes.size(), 1U);
  EXPECT_EQ(names_of(first), (std::vector<std::string>{"algorithm", "r"}));
  EXPECT_EQ(second.scenario, path("v.toml"));
  EXPECT_EQ(second.seeds, (std::vector<std::uint64_t>{9}));
  ASSERT_EQ(second.changes.size(), 2U);
  EXPECT_EQ(second.changes[1].key, "radio.loss");
  EXPECT_EQ(names_of(second), (std::vector<std::string>{"algorithm", "r", "range_m"}));
  EXPECT_EQ(labels_of(second.axes[1]), (std::vector<std::string>{"9"}));
  EXPECT_EQ(count_rows(study), 2 * 2 * 3 + 2 * 1 * 3 * 1);
}

TEST_F(StudyFile, JsonMeansTheSame) {
  const auto toml = good(head +
                         "[set]\nradio.loss = 0.5\n[[axes]]\nname = \"r\"\nkey = \"targets.radius_m\"\n"
                         "values = [3, 4.5]\n[statistics]\nby = [[\"r\"]]\nconfidence = 0.9\n");
  const auto loaded = parse(R"({"scenario": "w.toml", "seeds": "1-3", "set": {"radio": {"loss": 0.5}},
      "axes": [{"name": "r", "key": "targets.radius_m", "values": [3, 4.5]}],
      "statistics": {"by": [["r"]], "confidence": 0.9}})",
                            {}, "s.json");
  ASSERT_TRUE(loaded.ok()) << all_problems(loaded);
  const auto& json = loaded.study;
  EXPECT_EQ(json.name, toml.name);
  EXPECT_EQ(json.parts[0].scenario, toml.parts[0].scenario);
  EXPECT_EQ(json.parts[0].seeds, toml.parts[0].seeds);
  EXPECT_EQ(labels_of(json.parts[0].axes[0]), labels_of(toml.parts[0].axes[0]));
  EXPECT_EQ(json.parts[0].changes.size(), toml.parts[0].changes.size());
  EXPECT_EQ(json.statistics.by, toml.statistics.by);
  EXPECT_EQ(json.statistics.confidence, toml.statistics.confidence);
  EXPECT_EQ(json.figures.size(), toml.figures.size());
}

TEST_F(StudyFile, FiguresAreStandardOrGivenOrNone) {
  const std::string axes =
      "[[axes]]\nkey = \"mission.algorithm\"\nvalues = [\"outwards\", \"inwards\"]\n"
      "[[axes]]\nname = \"r\"\nkey = \"targets.radius_m\"\nvalues = [3, 6]\n";
  const auto standard = good(head + axes);
  ASSERT_EQ(standard.figures.size(), 2U);
  EXPECT_EQ(standard.figures[0].metrics.at(0).column, "normalized_time");
  EXPECT_EQ(standard.figures[0].series, "algorithm");
  EXPECT_EQ(standard.figures[0].x, (std::vector<std::string>{"r"}));
  EXPECT_TRUE(good(head + "figures = []\n" + axes).figures.empty());
  const auto given = good(head + axes + R"(
[[figures]]
name = "f"
metric = "committed"
x = "r"
series = "algorithm"
where = { r = [6], algorithm = "inwards" }
y_minimum = 0
y_maximum = 1.5
)");
  ASSERT_EQ(given.figures.size(), 1U);
  EXPECT_EQ(given.figures[0].where, (Where{{"algorithm", {"inwards"}}, {"r", {"6"}}}));
  EXPECT_EQ(given.figures[0].y_minimum, 0.0);
  EXPECT_EQ(given.figures[0].y_maximum, 1.5);
}

TEST_F(StudyFile, DefaultNamesAreFitForFiles) {
  EXPECT_EQ(parse(head, {}, "a study, \"odd\".toml").study.name, "a-study---odd-");
  EXPECT_EQ(parse_study("-", "").study.name, "standard-input");
  EXPECT_EQ(parse(head, {}, ".toml").study.name, "-toml");
}

TEST_F(StudyFile, OptionsChangeAllParts) {
  write("tuned.toml", "radio.range_m = 3.0\n");
  const auto loaded = parse(head + "[[parts]]\nname = \"a\"\n[[parts]]\nname = \"b\"\n",
                            {{"radio.loss = 0.5", "--set"}, {"", "--with", path("tuned.toml")}});
  ASSERT_TRUE(loaded.ok()) << all_problems(loaded);
  for (const auto& part : loaded.study.parts) {
    ASSERT_EQ(part.changes.size(), 2U);
    EXPECT_EQ(part.changes[0].key, "radio.loss");
    EXPECT_EQ(std::get<double>(part.changes[0].value.value), 0.5);
    EXPECT_EQ(part.changes[1].key, "");
  }
  for (const char* wrong : {"", "=3", " = 3", "radio.loss"})
    EXPECT_FALSE(parse(head, {{wrong, "--set"}}).ok()) << wrong;
  EXPECT_TRUE(says(parse(head, {{"seed=3", "--set seed=3"}}), "--set seed=3: error: seed: a study takes its seeds"));
  EXPECT_TRUE(says(parse(head, {{"", "--with", path("none.toml")}}), "there is no such file"));
}

TEST_F(StudyFile, SaysWhatIsWrongWithAxes) {
  const auto axis = [](const std::string& text) { return bad(head + "[[axes]]\n" + text); };  // from line 4 on
  EXPECT_TRUE(says(axis("key = \"radio.loss\"\nvalues = []\n"), "s.toml:5: error: axes[0].values: is an empty list"));
  EXPECT_TRUE(says(axis("key = \"radio.loss\"\n"), "s.toml:3: error: axes[0].values: is missing"));
  EXPECT_TRUE(says(axis("values = [1]\n"), "s.toml:3: error: axes[0]: needs either key"));
  EXPECT_TRUE(says(axis("key = \"a\"\nkeys = [\"b\"]\nvalues = [1]\n"), "s.toml:3: error: axes[0]: needs either key"));
  EXPECT_TRUE(says(axis("key = \"\"\nvalues = [1]\n"), "s.toml:4: error: axes[0].key: is empty"));
  EXPECT_TRUE(says(axis("keys = [\"a\", \"\"]\nvalues = [[1, 2]]\n"), "s.toml:4: error: axes[0].keys: is empty"));
  EXPECT_TRUE(says(axis("key = \"seed\"\nvalues = [1]\n"), "s.toml:4: error: axes[0].key: is seed; a study takes"));
  EXPECT_TRUE(says(axis("key = \"radio.loss\"\nvlaues = [1]\n"),
                   "s.toml:5: error: axes[0].vlaues: there is no such key; did you mean axes[0].values?"));
  EXPECT_TRUE(says(axis("key = \"radio.loss\"\nvalues = 1\n"), "s.toml:5: error: axes[0].values: must be a list"));
  EXPECT_TRUE(
      says(axis("key = \"radio.loss\"\nvalues = [1, 1.0]\n"), "s.toml:5: error: axes[0].values: holds \"1\" twice"));
  EXPECT_TRUE(says(axis("key = \"radio.loss\"\nvalues = [1, 2]\nlabels = [\"a\"]\n"),
                   "s.toml:6: error: axes[0].labels: are 1 for 2 values"));
  EXPECT_TRUE(says(axis("key = \"radio.loss\"\nvalues = [1, 2]\nlabels = [\"a\", \"a\"]\n"),
                   "s.toml:6: error: axes[0].labels: holds \"a\" twice"));
  EXPECT_TRUE(says(axis("key = \"targets.positions_m\"\nvalues = [[[1, 2]]]\n"), "axes[0].labels: are needed"));
  EXPECT_TRUE(says(axis("keys = [\"a\", \"b\"]\nvalues = [[1, 2], [3]]\n"), "with 2 keys each value is a list of 2"));
  EXPECT_TRUE(says(axis("key = \"scenario\"\nvalues = [1]\n"), "needs names of files"));
  EXPECT_TRUE(
      says(axis("key = \"with\"\nvalues = [\"none.toml\"]\n"), "s.toml:5: error: axes[0].values: names a file"));
  EXPECT_TRUE(
      says(axis("name = \"a/b\"\nkey = \"radio.loss\"\nvalues = [1]\n"), "s.toml:4: error: axes[0].name: is \"a/b\""));
  EXPECT_TRUE(says(axis("name = \"complete\"\nkey = \"radio.loss\"\nvalues = [1]\n"), "is a column of results"));
  EXPECT_TRUE(says(axis("key = \"radio.loss\"\nvalues = [1]\n[[axes]]\nkey = \"radio.loss\"\nvalues = [2]\n"),
                   "s.toml:6: error: axes: has two axes named \"loss\""));
}

TEST_F(StudyFile, SaysWhatIsWrongElsewhere) {
  EXPECT_TRUE(says(bad(head + "descripton = \"x\"\n"),
                   "s.toml:3: error: descripton: there is no such key; did you mean description?"));
  EXPECT_TRUE(says(bad("seeds = [1]\n"), "has no scenario"));
  EXPECT_TRUE(says(bad("[bounds]\n"), "s.toml:1: error: no study, but a file for tuning, which banyan tune reads"));
  EXPECT_TRUE(says(bad("[targets]\n"), "s.toml:1: error: no study, but a scenario, which banyan run reads"));
  EXPECT_TRUE(says(bad("scenario = \"w.toml\"\n"), "has no seeds"));
  EXPECT_TRUE(says(bad("scenario = \"w.toml\"\nseeds = []\n"), "s.toml:2: error: seeds: is an empty list"));
  EXPECT_TRUE(says(bad("scenario = \"w.toml\"\nseeds = \"5-1\"\n"), "s.toml:2: error: seeds: "));
  EXPECT_TRUE(says(bad(head + "parts = []\n"), "s.toml:3: error: parts: is an empty list"));
  EXPECT_TRUE(says(bad(head + "[[parts]]\n"), "s.toml:3: error: parts[0].name: is missing"));
  EXPECT_TRUE(says(bad(head + "[[parts]]\nname = \"a\"\n[[parts]]\nname = \"a\"\n"),
                   "s.toml:6: error: parts[1].name: is the name of an earlier part"));
  EXPECT_TRUE(says(bad("seeds = [1]\n[[parts]]\nname = \"a\"\n"), "s.toml:2: error: parts.a: has no scenario"));
  EXPECT_TRUE(says(bad(head + "name = \"../x\"\n"), "s.toml:3: error: name: is \"../x\""));
  EXPECT_TRUE(says(bad(head + "set = 3\n"), "s.toml:3: error: set: is a section"));
  EXPECT_TRUE(says(bad(head + "[set]\nseed = 3\n"), "set: sets seed; a study takes its seeds"));
  EXPECT_TRUE(
      says(bad(head + "with = \"none.toml\"\n"), "s.toml:3: error: with: names a file that cannot be used: none.toml"));
  EXPECT_TRUE(says(bad("x = = 1\n"), "s.toml:1: error: this is not TOML"));
  EXPECT_TRUE(says(load_study("none.toml"), "none.toml: error: there is no such file"));
}

TEST_F(StudyFile, SaysWhatIsWrongWithStatisticsAndFigures) {
  const std::string axes =
      "[[axes]]\nname = \"r\"\nkey = \"targets.radius_m\"\nvalues = [1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 12, 13, "
      "14]\n";                                                                         // 3 to 6
  const auto with = [&](const std::string& text) { return bad(head + axes + text); };  // from line 7 on
  EXPECT_TRUE(says(with("[statistics]\nmetrics = [\"complet\"]\n"),
                   "s.toml:8: error: statistics.metrics: \"complet\" is no column of numbers in the table of runs; did "
                   "you mean \"complete\"?"));
  EXPECT_TRUE(says(with("[statistics]\ncompare = \"q\"\n"),
                   "s.toml:8: error: statistics.compare: \"q\" is no axis here (axes: r)"));
  EXPECT_TRUE(says(with("[statistics]\nby = [\"r\"]\n"), "s.toml:8: error: statistics.by: is a list of lists"));
  EXPECT_TRUE(says(with("[statistics]\nby = [[\"q\"]]\n"), "is no axis here"));
  EXPECT_TRUE(
      says(with("[statistics]\nconfidence = 1.5\n"), "s.toml:8: error: statistics.confidence: is 1.5; allowed"));
  EXPECT_TRUE(says(with("[statistics]\nmargin = -0.1\n"), "s.toml:8: error: statistics.margin: is -0.1; allowed"));
  EXPECT_EQ(good(head + axes + "[statistics]\nconfidence = 0.9\n").statistics.margin, 0.05);
  EXPECT_EQ(good(head + axes + "[statistics]\nmargin = 0.1\n").statistics.margin, 0.1);
  EXPECT_TRUE(says(with("[statistics]\nresamples = 0.5\n"), "must be a whole number"));
  const std::string figure = "[[figures]]\nmetric = \"committed\"\n";
  EXPECT_TRUE(says(with("[[figures]]\nname = \"x\"\n"), "s.toml:7: error: figures[0].metric: is missing"));
  EXPECT_TRUE(says(with("[[figures]]\nmetric = \"hash\"\n"), "\"hash\" is no column of numbers"));
  EXPECT_TRUE(says(with(figure + "x = \"q\"\n"), "s.toml:9: error: figures[0].x: \"q\" is no axis here"));
  EXPECT_TRUE(says(with(figure + "part = \"q\"\n"), "\"q\" is no part of this study"));
  EXPECT_TRUE(says(with(figure + "series = \"r\"\n"),
                   "s.toml:9: error: figures[0].series: \"r\" has 13 values; a figure has colours for 12"));
  EXPECT_TRUE(says(with(figure + "where = { r = [10] }\n"), "\"10\" is no label of the axis \"r\""));
  EXPECT_TRUE(says(with(figure + "where = { r = [] }\n"), "is an empty list"));
  EXPECT_TRUE(says(with(figure + "y_minimum = 2\ny_maximum = 1\n"), "must be below y_maximum"));
  EXPECT_TRUE(says(with(figure + figure), "has two figures named \"committed\""));
  (void)good(head + axes + figure + "series = \"r\"\nwhere = { r = [1, 2] }\n");
}

TEST_F(StudyFile, FiguresHaveSeveralMetricsAndScales) {
  const std::string axes =
      "[[axes]]\nkey = \"mission.algorithm\"\nvalues = [\"outwards\", \"inwards\"]\n"
      "[[axes]]\nkey = \"targets.radius_m\"\nvalues = [3, 6]\n";
  const auto study = good(head + axes + R"(
[[figures]]
metrics = ["time_ratio", "committed", "disconnected_time_ratio"]
y_scale = ["ratio", "log", "linear"]
ratio_to = "inwards"
series = "algorithm"
width_in = 3.5
columns = 2
)");
  const FigurePlan& figure = study.figures.at(0);
  ASSERT_EQ(figure.metrics.size(), 3U);
  EXPECT_EQ(figure.name, "time_ratio");
  EXPECT_EQ(figure.metrics[0].scale, FigureScale::ratio);
  EXPECT_EQ(figure.metrics[0].title, "completion time / lower bound (inwards\u00a0=\u00a01)");
  EXPECT_EQ(figure.metrics[1].scale, FigureScale::log);
  EXPECT_EQ(figure.metrics[2].title, "share of time with a broken edge");
  EXPECT_EQ(figure.width_in, 3.5);
  EXPECT_EQ(figure.columns, 2U);
  EXPECT_EQ(study.parts[0].axes[1].title, "radius (m)") << "words of the name";
  const auto one = good(head + axes +
                        "[[figures]]\nmetrics = [\"committed\", \"robots\"]\ny_scale = \"log\"\n"
                        "y_title = [\"a\", \"b\"]\n");
  EXPECT_EQ(one.figures[0].metrics[1].scale, FigureScale::log) << "one for all";
  EXPECT_EQ(one.figures[0].metrics[1].title, "b");
  EXPECT_FALSE(one.figures[0].width_in || one.figures[0].columns);
}

TEST_F(StudyFile, SaysWhatIsWrongWithScalesAndWidths) {
  const std::string axes =
      "[[axes]]\nname = \"a\"\nkey = \"mission.algorithm\"\nvalues = [\"outwards\", \"inwards\"]\n";  // 3 to 6
  const auto with = [&](const std::string& text) {
    return bad(head + axes + "[[figures]]\nmetrics = [\"committed\", \"robots\"]\n" + text);  // from line 9 on
  };
  EXPECT_TRUE(
      says(with("width_in = 5\n"), "s.toml:9: error: figures[0].width_in: is 5; allowed: 3.5, a column, or 7, a page"));
  EXPECT_TRUE(says(with("y_scale = \"lin\"\n"),
                   "s.toml:9: error: figures[0].y_scale: is \"lin\"; allowed: \"linear\", \"log\", \"ratio\""));
  EXPECT_TRUE(says(with("y_scale = [\"log\", \"rato\"]\n"), "did you mean \"ratio\"?"));
  EXPECT_TRUE(says(with("y_scale = [\"log\", \"log\", \"log\"]\n"),
                   "s.toml:9: error: figures[0].y_scale: are 3 for 2 metrics"));
  EXPECT_TRUE(says(with("y_title = \"x\"\n"), "s.toml:9: error: figures[0].y_title: are 1 for 2 metrics"));
  EXPECT_TRUE(
      says(with("y_scale = \"ratio\"\n"), "s.toml:9: error: figures[0].y_scale: \"ratio\" needs series, and ratio_to"));
  EXPECT_TRUE(says(with("y_scale = \"ratio\"\nratio_to = \"outwards\"\n"), "\"ratio\" needs series"));
  EXPECT_TRUE(says(with("series = \"a\"\ny_scale = \"ratio\"\nratio_to = \"outward\"\n"),
                   "s.toml:11: error: figures[0].ratio_to: \"outward\" is no label of the axis \"a\"; did you mean "
                   "\"outwards\"?"));
  EXPECT_TRUE(
      says(with("ratio_to = \"outwards\"\n"), "s.toml:9: error: figures[0].ratio_to: is for y_scale = \"ratio\""));
  EXPECT_TRUE(says(with("y_maximum = 1\n"), "s.toml:9: error: figures[0].y_maximum: is for a figure of one metric"));
  EXPECT_TRUE(says(with("metric = \"committed\"\n"), "s.toml:8: error: figures[0].metrics: stands beside metric"));
  EXPECT_TRUE(
      says(bad(head + axes + "[[figures]]\nmetrics = [\"comitted\"]\n"),
           "s.toml:8: error: figures[0].metrics: \"comitted\" is no column of numbers in the table of runs; did "
           "you mean \"committed\"?"));
  EXPECT_TRUE(says(bad(head + axes + "[[figures]]\nmetric = \"robots\"\ny_scale = \"log\"\ny_minimum = 0\n"),
                   "s.toml:10: error: figures[0].y_minimum: is 0; on a logarithmic scale it is above 0"));
}

TEST_F(StudyFile, SaysEverythingAtOnceInOrder) {
  const auto loaded =
      bad("sceanrio = \"w.toml\"\nseeds = 1\n[[axes]]\nkey = \"a\"\nvalues = []\n[statistics]\nx = 1\n");
  EXPECT_GE(loaded.problems.size(), 4U) << all_problems(loaded);
  for (std::size_t i = 1; i < loaded.problems.size(); ++i)
    EXPECT_LE(loaded.problems[i - 1].place.line, loaded.problems[i].place.line);
}

}  // namespace
}  // namespace banyan::study
