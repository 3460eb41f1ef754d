// SPDX-License-Identifier: MIT
// The determinism contract: each shared scenario, after some ticks, has one state hash for any
// number of threads, and it is the one in golden_hashes.csv.
//
// When behaviour has changed on purpose:   BANYAN_RENEW_GOLDEN=1 banyan_cli_test --gtest_filter='Golden.*'
// rewrites the last column of the table; commit it together with the change.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "banyan/world/threads.hpp"
#include "banyan/world/world.hpp"
#include "banyan/config/config.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

constexpr const char* table_path = BANYAN_GOLDEN;
constexpr const char* header = "scenario,overrides,ticks,hash";

struct Row {
  std::string scenario, overrides;  // overrides separated by spaces
  std::uint64_t ticks = 0;
  std::string hash;
};

std::vector<Row> read_table() {
  std::vector<Row> rows;
  std::ifstream in(table_path);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, header);
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    Row row;
    std::string ticks;
    std::getline(cells, row.scenario, ',');
    std::getline(cells, row.overrides, ',');
    std::getline(cells, ticks, ',');
    std::getline(cells, row.hash, ',');
    row.ticks = std::stoull(ticks);
    rows.push_back(row);
  }
  return rows;
}

void write_table(const std::vector<Row>& rows) {
  std::ofstream out(table_path);
  out << header << "\n";
  for (const auto& r : rows) out << r.scenario << "," << r.overrides << "," << r.ticks << "," << r.hash << "\n";
}

std::string hash_of(const Row& row, int threads) {
  std::vector<config::Override> overrides;
  std::istringstream words(row.overrides);
  for (std::string word; words >> word;) overrides.push_back({word, "golden"});
  const auto loaded = config::load_configuration(std::string(BANYAN_SCENARIOS) + "/" + row.scenario + ".toml", overrides);
  EXPECT_TRUE(loaded.ok()) << row.scenario << " " << row.overrides;
  world::World world(loaded.configuration.scenario);
  world::Executor executor(threads);
  for (std::uint64_t t = 0; t < row.ticks; ++t) world.step(executor);
  return format("%016llx", static_cast<unsigned long long>(world.hash()));
}

TEST(Golden, EveryScenarioHasItsHashForOneTwoAndFourThreads) {
  auto rows = read_table();
  const bool renew = std::getenv("BANYAN_RENEW_GOLDEN") != nullptr;
  std::map<std::string, int> covered;
  for (auto& row : rows) {
    SCOPED_TRACE(row.scenario + " " + row.overrides);
    ++covered[row.scenario];
    const auto one = hash_of(row, 1);
    EXPECT_EQ(hash_of(row, 2), one) << "2 threads";
    EXPECT_EQ(hash_of(row, 4), one) << "4 threads";
    if (renew) row.hash = one;
    EXPECT_EQ(one, row.hash);
  }
  for (const auto& entry : std::filesystem::directory_iterator(BANYAN_SCENARIOS)) {
    EXPECT_GT(covered[entry.path().stem().string()], 0) << entry.path() << " has no row in " << table_path;
  }
  if (renew) write_table(rows);
}

}  // namespace
}  // namespace banyan::cli
