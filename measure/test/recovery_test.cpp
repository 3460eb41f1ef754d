// SPDX-License-Identifier: MIT
// Recovery told by hand: ticks of 1 s and drives of 10 s, so that the limit is 200 ticks and the hold 20.
#include "banyan/measure/recovery.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "banyan/world/random.hpp"

namespace banyan::measure {
namespace {

void observe(Recovery& recovery, int ticks, std::uint64_t deaths, bool whole) {
  for (int t = 0; t < ticks; ++t) recovery.observe(deaths, whole);
}

TEST(Recovery, WithoutDeathsThereIsNothingToRecoverFrom) {
  Recovery recovery(1.0, 10.0);
  observe(recovery, 500, 0, true);
  EXPECT_FALSE(recovery.recovered());
  EXPECT_EQ(recovery.time_s(), -1.0);
  EXPECT_TRUE(recovery.settled());
}

TEST(Recovery, ASwarmThatStaysWholeNeedsNoTime) {
  Recovery recovery(1.0, 10.0);
  observe(recovery, 50, 0, true);
  observe(recovery, 20, 1, true);
  EXPECT_FALSE(recovery.recovered()) << "still to be seen 20 s later";
  EXPECT_FALSE(recovery.settled());
  observe(recovery, 1, 1, true);
  EXPECT_TRUE(recovery.recovered());
  EXPECT_TRUE(recovery.settled());
  EXPECT_EQ(recovery.time_s(), 0.0);
}

TEST(Recovery, CountsFromTheDeathToTheFirstInstant) {
  Recovery recovery(1.0, 10.0);
  observe(recovery, 7, 3, false);
  observe(recovery, 21, 3, true);
  EXPECT_EQ(recovery.time_s(), 7.0);
  observe(recovery, 300, 3, false);
  EXPECT_EQ(recovery.time_s(), 7.0) << "what comes later is another matter";
}

TEST(Recovery, HoldsForTwentySecondsWithoutABreak) {
  Recovery recovery(1.0, 10.0);
  observe(recovery, 10, 1, true);
  observe(recovery, 1, 1, false);
  observe(recovery, 20, 1, true);
  EXPECT_FALSE(recovery.recovered()) << "it was whole 20 s ago, but not ever since";
  observe(recovery, 1, 1, true);
  EXPECT_EQ(recovery.time_s(), 11.0);
}

TEST(Recovery, HoldsForAsLongAsTheMissionSettles) {
  Recovery recovery(1.0, 10.0, 60.0);
  observe(recovery, 60, 1, true);
  observe(recovery, 1, 1, false);
  observe(recovery, 60, 1, true);
  EXPECT_FALSE(recovery.recovered());
  observe(recovery, 1, 1, true);
  EXPECT_EQ(recovery.time_s(), 61.0);
  Recovery brief(1.0, 10.0, 5.0);
  observe(brief, 20, 1, true);
  EXPECT_FALSE(brief.recovered()) << "but never shorter than 20 s";
}

TEST(Recovery, EveryDeathBeginsAnew) {
  Recovery recovery(1.0, 10.0);
  observe(recovery, 30, 1, true);
  EXPECT_TRUE(recovery.recovered());
  observe(recovery, 5, 2, false);
  EXPECT_FALSE(recovery.recovered());
  EXPECT_FALSE(recovery.settled());
  observe(recovery, 21, 2, true);
  EXPECT_EQ(recovery.time_s(), 5.0);
}

TEST(Recovery, TheLastInstantThatCountsIsAtTheLimit) {
  Recovery in_time(1.0, 10.0);
  observe(in_time, 200, 1, false);
  observe(in_time, 20, 1, true);
  EXPECT_FALSE(in_time.settled());
  observe(in_time, 1, 1, true);
  EXPECT_EQ(in_time.time_s(), 200.0);
  Recovery too_late(1.0, 10.0);
  observe(too_late, 200, 1, false);
  EXPECT_FALSE(too_late.settled());
  observe(too_late, 1, 1, false);
  EXPECT_TRUE(too_late.settled()) << "whatever comes begins too late";
  observe(too_late, 100, 1, true);
  EXPECT_FALSE(too_late.recovered());
  EXPECT_EQ(too_late.time_s(), -1.0);
}

// The definition word for word, over random histories.
TEST(Recovery, IsWhatItsDefinitionSays) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Recovery recovery(0.5, 10.0);
    std::vector<bool> whole;
    std::uint64_t deaths = 0;
    std::size_t last_death = 0;
    for (std::uint64_t t = 0; t < 700; ++t) {
      if (t == 0 || world::bits(seed, {}, t, 1) % 200 == 0) {
        ++deaths;
        last_death = t;
      }
      whole.push_back(world::bits(seed, {}, t, 2) % (2 + seed) != 0);
      recovery.observe(deaths, whole.back());
    }
    std::optional<std::size_t> first;
    for (std::size_t t = last_death; t + 40 < whole.size() && t <= last_death + 400 && !first; ++t)
      if (const auto from = whole.begin() + static_cast<std::ptrdiff_t>(t);
          std::all_of(from, from + 41, [](bool w) { return w; }))
        first = t;
    EXPECT_EQ(recovery.recovered(), first.has_value()) << seed;
    EXPECT_EQ(recovery.time_s(), first ? 0.5 * static_cast<double>(*first - last_death) : -1.0) << seed;
  }
}

}  // namespace
}  // namespace banyan::measure
