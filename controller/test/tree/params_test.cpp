// SPDX-License-Identifier: MIT
// The defaults and what must hold among them.
#include "banyan/controller/tree/params.hpp"

#include <gtest/gtest.h>

#include "bench.hpp"

namespace banyan {
namespace {

TEST(Params, AParentIsChosenWithinDeltaAndSomeMargin) {
  EXPECT_EQ(tree_fault(convoy_defaults()), "");
  EXPECT_FLOAT_EQ(ConvoyBench().tick().parent_range(), 0.94F);
}

TEST(Params, TheOrderOfDistancesIsChecked) {
  const auto faulty = [](float TreeParams::*member, float value) {
    TreeParams p;
    p.*member = value;
    return !tree_fault(p).empty();
  };
  EXPECT_TRUE(faulty(&TreeParams::avoidance_range, 0.665F));
  EXPECT_TRUE(faulty(&TreeParams::recruitment_distance, 0.7F));
  EXPECT_TRUE(faulty(&TreeParams::safe_range, 0.975F));
  EXPECT_TRUE(faulty(&TreeParams::ideal_distance, 1.005F));
  EXPECT_FALSE(faulty(&TreeParams::ideal_distance, 1.0F)) << "an edge without margin, but possible";
}

TEST(Params, ThereMayBeParentsAndOneHeirAtATime) {
  ConvoyParams p = convoy_defaults();
  EXPECT_EQ(healing_fault(p), "");
  p.parent_margin = 2.5F;
  EXPECT_TRUE(healing_fault(p).starts_with("parent_margin"));
  p = convoy_defaults();
  p.claim_radius = 0.5F;
  EXPECT_TRUE(healing_fault(p).starts_with("claim_radius"));
  p = convoy_defaults();
  p.give_up_after_drives = 30.0F;
  EXPECT_EQ(healing_fault(p), "") << "18 x 30 x 100 are 54,000 rounds";
  p.rounds_per_drive = 2000.0F;
  EXPECT_TRUE(healing_fault(p).starts_with("give_up_after_drives"));
  p.give_up_after_drives = convoy_defaults().give_up_after_drives;
  EXPECT_EQ(healing_fault(p), "");
}

}  // namespace
}  // namespace banyan
