// SPDX-License-Identifier: MIT
// Counters that wrap, against the definition of RFC 1982 written out, and the one rule for silence.
#include "banyan/controller/core/serial.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace banyan {
namespace {

Serial arbitrary_serial() { return *rc::gen::arbitrary<Serial>(); }

TEST(Serial, TheNextIsNewerAllTheWayRound) {
  for (int n = 0; n < 65536; ++n) {
    const auto now = static_cast<Serial>(n);
    const auto next = static_cast<Serial>(n + 1);
    ASSERT_TRUE(is_newer(next, now)) << n;
    ASSERT_FALSE(is_newer(now, next)) << n;
    ASSERT_EQ(ahead_by(next, now), 1) << n;
  }
  EXPECT_FALSE(is_newer(7, 7));
}

// RFC 1982, sec. 3.2: i1 < i2 if i1 < i2 and i2 - i1 < 2^15, or i1 > i2 and i1 - i2 > 2^15.
RC_GTEST_PROP(Serial, ComparesAsRfc1982, ()) {
  const int i1 = arbitrary_serial();
  const int i2 = arbitrary_serial();
  RC_PRE(i1 - i2 != 32768 && i2 - i1 != 32768);  // the one pair that the standard leaves undefined
  const bool less = (i1 < i2 && i2 - i1 < 32768) || (i1 > i2 && i1 - i2 > 32768);
  RC_ASSERT(is_newer(static_cast<Serial>(i2), static_cast<Serial>(i1)) == less);
}

RC_GTEST_PROP(Serial, AheadByUndoesAnAddition, ()) {
  const Serial from = arbitrary_serial();
  const int by = *rc::gen::inRange(-32768, 32768);
  RC_ASSERT(ahead_by(advanced(from, by), from) == by);
}

TEST(Serial, HalfTheRangeAwayNeitherIsNewer) {
  EXPECT_EQ(ahead_by(32768, 0), -32768);
  EXPECT_FALSE(is_newer(32768, 0));
  EXPECT_FALSE(is_newer(0, 32768));
}

TEST(Serial, AfterMoreThanHalfTheRangeOfSilenceWhateverIsHeardIsNews) {
  for (const int silence : {0, 1, 1000, serial_half_range - 1}) {
    EXPECT_TRUE(is_news(101, 100, silence)) << silence;
    EXPECT_FALSE(is_news(99, 100, silence)) << silence;
    EXPECT_FALSE(is_news(100 + 40000, 100, silence)) << silence;
  }
  EXPECT_TRUE(is_news(99, 100, serial_half_range));
  EXPECT_TRUE(is_news(100 + 40000, 100, serial_half_range));
  EXPECT_FALSE(is_news(100, 100, serial_half_range)) << "the same is never news";
}

}  // namespace
}  // namespace banyan
