// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/config/keys.hpp"

namespace banyan::config {
namespace {

TEST(Config, EveryKeyIsInTheTableOnceAndExplained) {
  std::set<std::string> paths;
  for (const auto& row : key_rows(algorithms())) {
    EXPECT_TRUE(paths.insert(row.path).second) << row.path;
    EXPECT_FALSE(row.meaning.empty()) << row.path;
    EXPECT_FALSE(row.type.empty()) << row.path;
  }
  EXPECT_TRUE(paths.contains("radio.loss"));
  EXPECT_TRUE(paths.contains("mission.parameters.target_gain"));
  EXPECT_TRUE(paths.contains("events.time_s"));
}

TEST(Config, ARowSaysWithWhatTheKeyAppliesAndWhatHoldsWithoutIt) {
  std::map<std::string, KeyRow> rows;
  for (const auto& row : key_rows(algorithms())) rows[row.path] = row;
  EXPECT_EQ(rows["events.duration_s"].when, "freeze blackout");
  EXPECT_EQ(rows["events.duration_s"].selector, "events.kind");
  EXPECT_EQ(rows["events.duration_s"].fallback, "0");
  EXPECT_EQ(rows["events.of"].fallback, "robots");
  EXPECT_EQ(rows["events.of"].choices.size(), 5U);
  EXPECT_EQ(rows["swarm.robots"].fallback, "from redundancy, or the length of start.positions_m");
  EXPECT_EQ(rows["targets.positions_m"].fallback, "required");
  EXPECT_EQ(rows["targets.center_m"].fallback, "[0, 0]");
  EXPECT_EQ(rows["battery.places_m"].fallback, "[]");
  EXPECT_EQ(rows["radio.range_m"].allowed, "0.01 to 100000 m");
  EXPECT_EQ(rows["radio.loss"].when, "");
}

TEST(Config, TheReferenceOfKeysIsUpToDate) {
  std::ifstream in(std::string(BANYAN_DOCS) + "/scenario-keys.md");
  const std::string page((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  EXPECT_EQ(page, key_reference_markdown(algorithms())) << "renew it: banyan keys --markdown > docs/scenario-keys.md";
}

}  // namespace
}  // namespace banyan::config
