// SPDX-License-Identifier: MIT
#include "banyan/controller/convoy/params.hpp"

#include <gtest/gtest.h>

#include <string>

#include "banyan/controller/convoy/convoy.hpp"

namespace banyan {
namespace {

TEST(ConvoyParams, EdgesPullBeforeTheyAreAsLongAsTheyMayBe) {
  ConvoyParams p = convoy_defaults();
  EXPECT_TRUE(convoy_fault(p).empty());
  p.pull_start = 1.0F;
  EXPECT_NE(convoy_fault(p).find("pull_start"), std::string_view::npos);
  p = convoy_defaults();
  p.join_margin = 0.95F;
  EXPECT_NE(convoy_fault(p).find("join_margin"), std::string_view::npos);
}

TEST(ConvoyParams, NoEdgeIsBroughtToALengthBeyondDelta) {
  const auto fault = [](float ConvoyParams::*length) {
    ConvoyParams p = convoy_defaults();
    p.*length = 1.0F;
    return std::string(convoy_fault(p));
  };
  EXPECT_TRUE(fault(&ConvoyParams::compact_distance).starts_with("compact_distance"));
  EXPECT_TRUE(fault(&ConvoyParams::merge_distance).starts_with("merge_distance"));
  EXPECT_TRUE(fault(&ConvoyParams::release_distance).starts_with("release_distance"));
  EXPECT_TRUE(fault(&ConvoyParams::shortest_split).starts_with("shortest_split"));
  ConvoyParams p = convoy_defaults();
  p.ideal_distance = 0.775F;
  EXPECT_EQ(convoy_fault(p), "") << "a shorter delta, and the rest as it was";
}

// Table I is written out: another value of inwards, or of the tree's defaults, is none of convoy's.
TEST(ConvoyParams, TheDefaultsAreConvoysOwn) {
  const ConvoyParams p = convoy_defaults();
  EXPECT_EQ(p.reconfiguration_drives, 4.4F);
  EXPECT_EQ(p.liveness_rounds, 5.0F);
}

}  // namespace
}  // namespace banyan
