// SPDX-License-Identifier: MIT
// What the robots do, whatever they remember and however they say it: a hash over the poses, roles and
// parents of all robots at every tick, for each shared scenario and each algorithm and reading. A change
// of structure leaves it as it is; a change of behaviour does not.
//
// When behaviour has changed on purpose:   BANYAN_RENEW_GOLDEN=1 banyan_cli_test --gtest_filter='*Trajectory.*'
// rewrites the last column of the table; commit it together with the change, and say why. It also adds the rows of
// a new algorithm or scenario.
#include <gtest/gtest.h>

#include <algorithm>

#include "banyan/controller/core/digest.hpp"
#include "banyan/world/threads.hpp"
#include "banyan/world/world.hpp"
#include "hash_table.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

void add_robots(const world::World& world, Digest& digest) {
  for (std::size_t i = 0; i < world.size(); ++i) {
    digest.add(world.positions()[i]);
    digest.add(world.headings()[i]);
    digest.add(static_cast<int>(world.reports()[i].role));
    digest.add(world.reports()[i].parent);
    digest.add(world.reports()[i].old_parent);
  }
}

std::string trajectory_hash(const HashRow& row) {
  const auto loaded = load_shared(row.run[0], {"mission.algorithm=" + row.run[1], "mission.reading=" + row.run[2]});
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

// A test for each algorithm, so that they share the cores.
class Trajectory : public testing::TestWithParam<std::string_view> {};

TEST_P(Trajectory, InEveryScenario) {
  const std::string algorithm(GetParam());
  Runs every;
  for (const std::string& scenario : shared_scenarios()) every.push_back({scenario, algorithm, "corrected"});
  check_hashes(BANYAN_TRAJECTORIES, "scenario,algorithm,reading", every, trajectory_hash,
               [&](const HashRow& row) { return row.run[1] == algorithm; });
}

INSTANTIATE_TEST_SUITE_P(All, Trajectory, testing::ValuesIn(algorithms().names()), [](const auto& test) {
  std::string name(test.param);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(Trajectories, AreOfAlgorithmsThatThereAre) {
  for (const HashRow& row : read_hashes(BANYAN_TRAJECTORIES, "scenario,algorithm,reading"))
    EXPECT_NE(algorithms().find(row.run[1]), nullptr) << row.run[1];
}

}  // namespace
}  // namespace banyan::cli
