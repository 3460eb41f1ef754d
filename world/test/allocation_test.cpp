// SPDX-License-Identifier: MIT
// A tick of a world that has warmed up takes nothing from the heap.
#include <gtest/gtest.h>

#include <string>

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

// Buffers grow, by a quarter at a time, when there are more links than ever before. That ends; what is left then
// would be an allocation in every tick.
TEST(Allocation, ATickTakesNothingFromTheHeap) {
  for (const std::string_view algorithm : algorithms().names()) {
    for (const std::size_t robots : {20U, 150U}) {
      Scenario s = hostile(std::string(algorithm), robots, 5);
      s.targets = RingTargets{3, 1.5};
      s.radio.latency_ticks = 2;
      s.radio.slots = 10;
      World world(s);
      Executor executor(1);
      const auto in_200_ticks = [&] {
        const long before = allocations;
        for (int t = 0; t < 200; ++t) world.step(executor);
        return allocations - before;
      };
      int quiet = 0;  // stretches in a row
      for (int stretch = 0; stretch < 20 && quiet < 3; ++stretch) quiet = in_200_ticks() == 0 ? quiet + 1 : 0;
      EXPECT_EQ(quiet, 3) << algorithm << ", " << robots << " robots";
    }
  }
}

}  // namespace
}  // namespace banyan::world
