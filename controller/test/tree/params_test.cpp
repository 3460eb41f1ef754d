// SPDX-License-Identifier: MIT
// The defaults and what must hold among them.
#include "banyan/controller/tree/params.hpp"

#include <gtest/gtest.h>

#include "bench.hpp"

namespace banyan {
namespace {

TEST(Params, DefaultsAreTableI) {
  const HealingParams out = outwards_defaults();
  EXPECT_FLOAT_EQ(out.ideal_distance_m, 1.90F);
  EXPECT_FLOAT_EQ(out.target_gain, 0.49F);
  EXPECT_FLOAT_EQ(out.reconfiguration_period_s, 38.8F);
  EXPECT_FLOAT_EQ(out.liveness_period_s, 1.2F);
  const HealingParams in = inwards_defaults();
  EXPECT_FLOAT_EQ(in.ideal_distance_m, 1.540841F);
  EXPECT_FLOAT_EQ(in.target_gain, 0.2539F);
  EXPECT_FLOAT_EQ(BenchOf<InwardsLiteral>().tick().parent_range_m(), 2.0F) << "literal: parents up to C";
  EXPECT_FLOAT_EQ(Bench().tick().parent_range_m(), 1.88F);
  EXPECT_EQ(tree_fault(out), "");
  EXPECT_EQ(tree_fault(in), "");
  EXPECT_EQ(tree_fault(convoy_defaults()), "");
}

TEST(Params, TheOrderOfDistancesIsChecked) {
  const auto faulty = [](float TreeParams::*member, float value) {
    TreeParams p;
    p.*member = value;
    return !tree_fault(p).empty();
  };
  EXPECT_TRUE(faulty(&TreeParams::avoidance_range_m, 1.33F));
  EXPECT_TRUE(faulty(&TreeParams::recruitment_distance_m, 1.40F));
  EXPECT_TRUE(faulty(&TreeParams::safe_range_m, 1.95F));
  EXPECT_TRUE(faulty(&TreeParams::ideal_distance_m, 2.01F));
  EXPECT_FALSE(faulty(&TreeParams::ideal_distance_m, 2.0F)) << "an edge without margin, but possible";
  EXPECT_TRUE(faulty(&TreeParams::reconfiguration_period_s, 6600.0F)) << "more ticks than are counted";
}

TEST(Params, ThereMayBeParentsAndOneHeirAtATime) {
  HealingParams p = inwards_defaults();
  EXPECT_EQ(healing_fault(p), "");
  p.parent_margin_m = 5.0F;
  EXPECT_TRUE(healing_fault(p).starts_with("parent_margin_m"));
  p = inwards_defaults();
  p.claim_radius_m = 0.5F * p.communication_range_m;
  EXPECT_TRUE(healing_fault(p).starts_with("claim_radius"));
}

}  // namespace
}  // namespace banyan
