// SPDX-License-Identifier: MIT
// The determinism contract: each run of golden_hashes.csv, after so many ticks, has one state hash for any number of
// threads, and it is the one in the table.
//
// When behaviour has changed on purpose:   BANYAN_RENEW_GOLDEN=1 banyan_cli_test --gtest_filter='Golden.*'
// rewrites the last column of the table; commit it together with the change, and say why. A new algorithm needs a row:
// in a hard scenario, for few ticks, since all rows together are to take some seconds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/config/config.hpp"
#include "banyan/world/threads.hpp"
#include "banyan/world/world.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

constexpr const char* golden_header = "scenario,overrides,ticks,hash";

struct GoldenRow {
  std::string scenario;
  std::string overrides;  // with spaces between them
  std::uint64_t ticks = 0;
  std::string hash;
};

std::vector<GoldenRow> read_golden() {
  std::vector<GoldenRow> rows;
  std::ifstream in(BANYAN_GOLDEN);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, golden_header);
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    GoldenRow row;
    std::getline(cells, row.scenario, ',');
    std::getline(cells, row.overrides, ',');
    char comma = 0;
    cells >> row.ticks >> comma >> row.hash;
    EXPECT_EQ(comma, ',') << line;
    rows.push_back(row);
  }
  return rows;
}

void write_golden(const std::vector<GoldenRow>& rows) {
  std::ofstream out(BANYAN_GOLDEN);
  out << golden_header << "\n";
  for (const GoldenRow& row : rows)
    out << row.scenario << "," << row.overrides << "," << row.ticks << "," << row.hash << "\n";
}

world::Scenario scenario_of(const GoldenRow& row) {
  std::vector<config::Override> overrides;
  std::istringstream words(row.overrides);
  for (std::string word; words >> word;) overrides.push_back({word, "golden_hashes.csv"});
  const auto loaded =
      config::load_configuration(std::string(BANYAN_SCENARIOS) + "/" + row.scenario + ".toml", algorithms(), overrides);
  EXPECT_TRUE(loaded.ok());
  return loaded.configuration.scenario;
}

std::string hash_after(const world::Scenario& scenario, std::uint64_t ticks, int threads) {
  world::World world(scenario);
  world::Executor executor(threads);
  for (std::uint64_t t = 0; t < ticks; ++t) world.step(executor);
  return format("%016llx", static_cast<unsigned long long>(world.hash()));
}

TEST(Golden, EveryRunHasItsHashForOneTwoAndFourThreads) {
  std::vector<GoldenRow> rows = read_golden();
  std::set<std::string_view> missing(algorithms().names().begin(), algorithms().names().end());
  for (GoldenRow& row : rows) {
    SCOPED_TRACE(row.scenario + " " + row.overrides);
    const world::Scenario scenario = scenario_of(row);
    missing.erase(scenario.mission.algorithm);
    const std::string one = hash_after(scenario, row.ticks, 1);
    EXPECT_EQ(one, row.hash);
    EXPECT_EQ(hash_after(scenario, row.ticks, 2), one) << "2 threads";
    EXPECT_EQ(hash_after(scenario, row.ticks, 4), one) << "4 threads";
    row.hash = one;
  }
  EXPECT_TRUE(missing.empty()) << "no row of " << *missing.begin();
  if (std::getenv("BANYAN_RENEW_GOLDEN") != nullptr) write_golden(rows);
}

}  // namespace
}  // namespace banyan::cli
