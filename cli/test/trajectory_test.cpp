// SPDX-License-Identifier: MIT
// What the robots do, whatever they remember and however they say it: a hash over the poses, roles and
// parents of all robots at every tick, for each shared scenario and each algorithm and reading. A change
// of structure leaves it as it is; a change of behaviour does not.
//
// When behaviour has changed on purpose:   BANYAN_RENEW_GOLDEN=1 banyan_cli_test --gtest_filter='Trajectory.*'
// rewrites the last column of the table; commit it together with the change, and say why.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "banyan/config/config.hpp"
#include "banyan/controller/core/digest.hpp"
#include "banyan/world/threads.hpp"
#include "banyan/world/world.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

constexpr const char* trajectory_header = "scenario,algorithm,reading,ticks,hash";

struct TrajectoryRow {
  std::string scenario, algorithm, reading;
  std::uint64_t ticks = 0;
  std::string hash;
};

std::vector<TrajectoryRow> read_trajectories() {
  std::vector<TrajectoryRow> rows;
  std::ifstream in(BANYAN_TRAJECTORIES);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, trajectory_header);
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    TrajectoryRow row;
    std::string ticks;
    std::getline(cells, row.scenario, ',');
    std::getline(cells, row.algorithm, ',');
    std::getline(cells, row.reading, ',');
    std::getline(cells, ticks, ',');
    std::getline(cells, row.hash, ',');
    row.ticks = std::stoull(ticks);
    rows.push_back(row);
  }
  return rows;
}

void write_trajectories(const std::vector<TrajectoryRow>& rows) {
  std::ofstream out(BANYAN_TRAJECTORIES);
  out << trajectory_header << "\n";
  for (const TrajectoryRow& r : rows)
    out << r.scenario << "," << r.algorithm << "," << r.reading << "," << r.ticks << "," << r.hash << "\n";
}

void add_robots(const world::World& world, Digest& digest) {
  for (std::size_t i = 0; i < world.size(); ++i) {
    digest.add(world.positions()[i]);
    digest.add(world.headings()[i]);
    digest.add(static_cast<int>(world.reports()[i].role));
    digest.add(world.reports()[i].parent);
    digest.add(world.reports()[i].old_parent);
  }
}

std::string hash_of(const TrajectoryRow& row) {
  const std::vector<config::Override> overrides{{"mission.algorithm=" + row.algorithm, "trajectory"},
                                                {"mission.reading=" + row.reading, "trajectory"}};
  const auto loaded = config::load_configuration(std::string(BANYAN_SCENARIOS) + "/" + row.scenario + ".toml", overrides);
  if (!loaded.ok()) return "refused";  // Table I's lengths fit one radio range
  world::World world(loaded.configuration.scenario);
  world::Executor executor(1);
  Digest digest;
  for (std::uint64_t t = 0; t < row.ticks; ++t) {
    world.step(executor);
    add_robots(world, digest);
  }
  return format("%016llx", static_cast<unsigned long long>(digest.value()));
}

TEST(Trajectory, OfEveryAlgorithmInEveryScenario) {
  auto rows = read_trajectories();
  const bool renew = std::getenv("BANYAN_RENEW_GOLDEN") != nullptr;
  std::map<std::string, int> covered;
  for (TrajectoryRow& row : rows) {
    SCOPED_TRACE(row.scenario + " " + row.algorithm + " " + row.reading);
    ++covered[row.scenario];
    const std::string hash = hash_of(row);
    if (renew) row.hash = hash;
    EXPECT_EQ(hash, row.hash);
  }
  for (const auto& entry : std::filesystem::directory_iterator(BANYAN_SCENARIOS))
    EXPECT_GT(covered[entry.path().stem().string()], 0) << entry.path() << " has no row in " << BANYAN_TRAJECTORIES;
  if (renew) write_trajectories(rows);
}

}  // namespace
}  // namespace banyan::cli
