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
}

// ---- paper ----

TEST(ParamsOfThePaper, AreTableI) {
  const HealingParams out = outwards_defaults();
  EXPECT_FLOAT_EQ(out.ideal_distance, 0.95F);
  EXPECT_FLOAT_EQ(out.target_gain, 0.49F);
  EXPECT_FLOAT_EQ(out.reconfiguration_drives, 3.88F);
  EXPECT_FLOAT_EQ(out.liveness_rounds, 12.0F);
  const HealingParams in = inwards_defaults();
  EXPECT_FLOAT_EQ(in.ideal_distance, 0.7704205F);
  EXPECT_FLOAT_EQ(in.target_gain, 0.2539F);
  EXPECT_FLOAT_EQ(BenchOf<InwardsLiteral>().tick().parent_range(), 1.0F) << "literal: parents up to C";
  EXPECT_FLOAT_EQ(Bench().tick().parent_range(), 0.94F);
  EXPECT_EQ(tree_fault(out), "");
  EXPECT_EQ(tree_fault(in), "");
}

}  // namespace
}  // namespace banyan
