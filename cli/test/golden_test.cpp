// SPDX-License-Identifier: MIT
// The determinism contract: each shared scenario, after some ticks, has one state hash for any
// number of threads, and it is the one in golden_hashes.csv.
//
// When behaviour has changed on purpose:   BANYAN_RENEW_GOLDEN=1 banyan_cli_test --gtest_filter='Golden.*'
// rewrites the last column of the table; commit it together with the change.
#include <gtest/gtest.h>

#include "banyan/world/threads.hpp"
#include "banyan/world/world.hpp"
#include "hash_table.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

std::string state_hash(const HashRow& row, int threads) {
  const auto loaded = load_shared(row.run[0], split_at(row.run[1], ' '));
  EXPECT_TRUE(loaded.ok());
  world::World world(loaded.configuration.scenario);
  world::Executor executor(threads);
  for (std::uint64_t t = 0; t < row.ticks; ++t) world.step(executor);
  return format("%016llx", static_cast<unsigned long long>(world.hash()));
}

TEST(Golden, EveryScenarioHasItsHashForOneTwoAndFourThreads) {
  Runs every;
  for (const std::string& scenario : shared_scenarios()) every.push_back({scenario});
  check_hashes(BANYAN_GOLDEN, "scenario,overrides", every, [](const HashRow& row) {
    std::string one = state_hash(row, 1);
    EXPECT_EQ(state_hash(row, 2), one) << "2 threads";
    EXPECT_EQ(state_hash(row, 4), one) << "4 threads";
    return one;
  });
}

}  // namespace
}  // namespace banyan::cli
