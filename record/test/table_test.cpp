// SPDX-License-Identifier: MIT
// Results as CSV and JSON, read back by a parser of their own here and by the JSON library.
#include "banyan/record/table.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "sample.hpp"

namespace banyan::record {
namespace {

// RFC 4180, all rows.
std::vector<std::vector<std::string>> parse_csv(const std::string& text) {
  std::vector<std::vector<std::string>> rows(1, {""});
  bool quoted = false;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (quoted && c == '"' && k + 1 < text.size() && text[k + 1] == '"') {
      rows.back().back() += '"';
      ++k;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      rows.back().emplace_back();
    } else if (!quoted && c == '\n') {
      if (k + 1 < text.size()) rows.push_back({""});
    } else {
      rows.back().back() += c;
    }
  }
  return rows;
}

RunRow sample_row() {
  RunRow row;
  row.id.name = "a \"b\", c\nd";
  row.id.algorithm = "outwards";
  row.id.loss = 0.3;
  row.id.seed = 18446744073709551615ULL;
  row.run = test::sample_run(300);
  row.run.disconnected_time_ratio = 1.0 / 3.0;
  return row;
}

TEST(Table, CsvAndJsonAgree) {
  const test::TemporaryDirectory directory;
  const RunRow row = sample_row();
  write_run_csv(directory.file("run.csv"), row);
  write_run_json(directory.file("run.json"), row, test::sample_provenance().config_json);
  const auto csv = parse_csv(test::contents(directory.file("run.csv")));
  const auto json = nlohmann::json::parse(test::contents(directory.file("run.json")));
  ASSERT_EQ(csv.size(), 2U);
  ASSERT_EQ(csv[0].size(), csv[1].size());
  ASSERT_EQ(csv[0].size(), json["result"].size());
  for (std::size_t k = 0; k < csv[0].size(); ++k) {
    ASSERT_TRUE(json["result"].contains(csv[0][k]));
    const auto& value = json["result"][csv[0][k]];
    if (value.is_null()) EXPECT_EQ(csv[1][k], "");
    else if (value.is_string()) EXPECT_EQ(csv[1][k], value.get<std::string>());
    else if (value.is_number_float()) EXPECT_EQ(std::stod(csv[1][k]), value.get<double>()) << csv[0][k];
    else EXPECT_EQ(csv[1][k], value.dump()) << csv[0][k];
  }
  EXPECT_EQ(json["config"]["mission"]["algorithm"], "outwards");
  EXPECT_EQ(json["result"]["name"], row.id.name);
  EXPECT_EQ(json["result"]["seed"], row.id.seed);
  EXPECT_EQ(json["result"]["hash"], "0123456789abcdef");
  EXPECT_NEAR(json["result"]["disconnected_time_ratio"].get<double>(), 1.0 / 3.0, 1e-6);
}

TEST(Table, ColumnNamesAreUniqueAndSnakeCase) {
  std::set<std::string_view> seen;
  for (const auto& column : run_columns()) {
    EXPECT_TRUE(seen.insert(column.name).second) << column.name;
    EXPECT_EQ(column.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"), std::string_view::npos);
    EXPECT_FALSE(column.meaning.empty());
  }
  for (const std::string_view needed : {"name", "algorithm", "reading", "body", "line_of_sight", "loss", "targets",
                                        "redundancy", "robots", "range_m", "seed", "version", "git", "hash"}) {
    EXPECT_TRUE(seen.contains(needed)) << needed;
  }
}

TEST(Table, ColumnsOfTheResultFollowThoseThatIdentifyTheRun) {
  const auto all = run_columns(), results = result_columns();
  ASSERT_LT(results.size(), all.size());
  for (std::size_t k = 1; k <= results.size(); ++k)
    EXPECT_EQ(all[all.size() - k].name, results[results.size() - k].name);
  EXPECT_EQ(all[all.size() - results.size() - 1].name, "git");
  EXPECT_EQ(results.front().name, "robots");
  EXPECT_EQ(results.back().name, "format_version");
}

TEST(Table, ARowOfAnotherVersionIsNone) {
  const std::string row = run_csv_row(sample_row());
  EXPECT_EQ(run_cells(row), csv_cells(row));
  ASSERT_TRUE(row.ends_with(",1"));
  EXPECT_FALSE(run_cells(row.substr(0, row.size() - 1) + "2").has_value()) << "another format version";
  EXPECT_FALSE(run_cells("a column more," + row).has_value());
  EXPECT_FALSE(run_cells(row.substr(row.find(',') + 1)).has_value()) << "a column less";
  EXPECT_FALSE(run_cells("").has_value());
}

TEST(Table, WhatIsNotThereIsEmptyOrNull) {
  RunRow row = sample_row();
  row.run.complete = false;
  row.run.completion_time_s = -1.0;
  const auto csv = parse_csv(run_csv_header() + "\n" + run_csv_row(row) + "\n");
  const auto json = nlohmann::json::parse(run_json(row, "{}"));
  const auto at = std::find(csv[0].begin(), csv[0].end(), "completion_time_s") - csv[0].begin();
  EXPECT_EQ(csv[1][static_cast<std::size_t>(at)], "");
  EXPECT_TRUE(json["result"]["completion_time_s"].is_null());
}

TEST(Table, ColumnsOfHealingAreThereOrEmpty) {
  RunRow row = sample_row();
  row.run.elections = 2;
  row.run.two_roots_ticks = 17;
  row.run.network_length_m = 12.25;
  const auto before = nlohmann::json::parse(run_json(row, "{}"))["result"];
  for (const char* name : {"last_death_s", "recovery_time_s", "time_ratio"})
    EXPECT_TRUE(before[name].is_null()) << name;
  EXPECT_EQ(before["deaths"], 0);
  EXPECT_EQ(before["recovered"], false);
  EXPECT_EQ(before["elections"], 2);
  EXPECT_EQ(before["two_roots_ticks"], 17);
  EXPECT_EQ(before["network_length_m"], 12.25);
  row.run.deaths = 3;
  row.run.last_death_s = 0.0;
  row.run.recovered = true;
  row.run.recovery_time_s = 0.0;
  row.run.time_ratio = 1.125;
  const auto after = nlohmann::json::parse(run_json(row, "{}"))["result"];
  EXPECT_EQ(after["last_death_s"], 0.0) << "at the very start is not never";
  EXPECT_EQ(after["recovery_time_s"], 0.0) << "at once is not never";
  EXPECT_EQ(after["recovered"], true);
  EXPECT_EQ(after["time_ratio"], 1.125);
}

TEST(Table, TheReferenceOfColumnsIsUpToDate) {
  EXPECT_EQ(test::contents(BANYAN_SOURCE_DIR "/docs/columns.md"), columns_markdown())
      << "renew it: banyan keys --columns > docs/columns.md";
}

TEST(Table, AConfigurationThatIsNoJsonIsKeptAsText) {
  EXPECT_EQ(nlohmann::json::parse(run_json(sample_row(), "not {json"))["config"], "not {json");
  EXPECT_EQ(nlohmann::json::parse(run_json(sample_row(), ""))["config"], "");
  EXPECT_EQ(nlohmann::json::parse(run_json(sample_row(), "{\"a\":1}\n\n"))["config"]["a"], 1);
}

TEST(Table, QuotingFollowsRfc4180) {
  EXPECT_EQ(csv_quoted("plain text"), "plain text");
  EXPECT_EQ(csv_quoted("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_quoted("say \"x\""), "\"say \"\"x\"\"\"");
  EXPECT_EQ(csv_quoted("two\nlines"), "\"two\nlines\"");
  for (std::uint64_t k = 0; k < 500; ++k) {
    std::string field;
    for (std::uint64_t b = 0; b < k % 9; ++b) field += "a,\"\n\r;x "[world::bits(k, {}, b) % 8];
    const auto parsed = parse_csv(csv_quoted(field) + "," + csv_quoted(field) + "\n");
    ASSERT_EQ(parsed.size(), 1U);
    EXPECT_EQ(parsed[0], (std::vector<std::string>{field, field}));
  }
}

TEST(Table, IdentifyTellsWhatWasRun) {
  world::Scenario scenario;
  scenario.name = "x";
  scenario.targets = world::RingTargets{3, 3.0, 0.0, {1.0, 0.0}};
  scenario.swarm.start.center = {1.0, 0.0};
  scenario.swarm.redundancy = 2.5;
  scenario.robot.body = world::BodyModel::linear;
  Identification id = identify(scenario, "0.2.0", "abc");
  EXPECT_EQ(id.targets, 3U);
  EXPECT_NEAR(id.target_radius_m, 3.0, 1e-9);
  EXPECT_EQ(id.redundancy, 2.5);
  EXPECT_EQ(id.body, "linear");
  scenario.swarm.robots = 9;
  EXPECT_NEAR(identify(scenario, "", "").redundancy, 9.0 * 1.540841 / 9.0, 1e-6);
  scenario.radio.range_m = 4.0;
  EXPECT_NEAR(identify(scenario, "", "").redundancy, 9.0 * 3.081682 / 9.0, 1e-6);
}

}  // namespace
}  // namespace banyan::record
