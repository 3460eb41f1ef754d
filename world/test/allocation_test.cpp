// SPDX-License-Identifier: MIT
// A tick of a world that has warmed up takes nothing from the heap.
#include <gtest/gtest.h>

#include "banyan/world/threads.hpp"
#include "heap_counter.hpp"
#include "worlds.hpp"

namespace banyan::world {
namespace {

using banyan::test::allocations;

TEST(Allocation, TheCounterCounts) {
  const long before = allocations;
  { const std::vector<int> v(10); }
  EXPECT_GT(allocations, before);
}

// Buffers grow while the swarm spreads, by a quarter at a time. Once nobody spreads out further none has
// to grow any more: what is left would be an allocation in every tick.
TEST(Allocation, ATickTakesNothingFromTheHeap) {
  for (const char* algorithm : {"outwards", "inwards", "convoy"}) {
    for (const std::size_t robots : {20U, 150U}) {
      Scenario s = hostile(algorithm, robots, 5);
      s.targets = RingTargets{3, 1.5};
      s.radio.latency_ticks = 2;
      s.radio.slots = 10;
      World world(s);
      Executor executor(1);
      for (int t = 0; t < 2000; ++t) world.step(executor);
      const long before = allocations;
      constexpr int ticks = 200;
      for (int t = 0; t < ticks; ++t) world.step(executor);
      EXPECT_EQ(allocations - before, 0) << algorithm << ", " << robots << " robots";
    }
  }
}

}  // namespace
}  // namespace banyan::world
