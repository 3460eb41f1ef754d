// SPDX-License-Identifier: MIT
#include "banyan/world/names.hpp"

#include <gtest/gtest.h>

namespace banyan::world {
namespace {

TEST(Names, TheNearestIsSuggestedAndNonsenseIsNot) {
  const std::string_view known[] = {"outwards", "inwards", "convoy"};
  EXPECT_EQ(nearest_name("outward", known), "outwards");
  EXPECT_EQ(nearest_name("invards", known), "inwards");
  EXPECT_EQ(nearest_name("zzzzzzzzzzzz", known), "");
  EXPECT_EQ(nearest_name("x", {}), "");
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("nmae", "name"), 1U) << "two letters exchanged are one slip";
  EXPECT_EQ(edit_distance("ca", "abc"), 3U);
  EXPECT_EQ(alternatives(known), "\"outwards\", \"inwards\" or \"convoy\"");
  EXPECT_EQ(alternatives({}), "");
}

TEST(Names, AWordCutShortIsANearMissHoweverLong) {
  const std::string_view known[] = {"range_noise_m", "radius_m", "loss"};
  EXPECT_EQ(nearest_name("range", known), "range_noise_m");
  EXPECT_EQ(nearest_name("rad", known), "radius_m");
  EXPECT_EQ(nearest_name("l", known), "") << "too short to mean anything";
}

TEST(Names, ALongTextIsCutShortInAMessage) {
  EXPECT_EQ(the_text("fast"), "the text \"fast\"");
  EXPECT_EQ(the_text(std::string(50, 'x')), "the text \"" + std::string(37, 'x') + "...\"");
  EXPECT_EQ(the_text(std::string(36, 'x') + "ü" + std::string(9, 'y')), "the text \"" + std::string(36, 'x') + "...\"");
}

TEST(Names, ATextInAMessageIsPrintable) { EXPECT_EQ(the_text("\x1b[2J\n"), "the text \"\\x1b[2J\\n\""); }

}  // namespace
}  // namespace banyan::world
