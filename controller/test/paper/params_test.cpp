// SPDX-License-Identifier: MIT
// Table I, as the paper prints it, and what may not be set together.
#include "banyan/controller/paper/params.hpp"

#include <gtest/gtest.h>

namespace banyan::paper {
namespace {

// In centimetres and seconds, for a radio of 200 cm and robots of 20 cm/s that send ten times a second.
TEST(PaperParams, AreTableI) {
  const Params out = outwards_column();
  EXPECT_FLOAT_EQ(200.0F * out.safe_range, 138.93F);
  EXPECT_FLOAT_EQ(200.0F * out.avoidance_range, 43.16F);
  EXPECT_FLOAT_EQ(200.0F * out.ideal_distance, 190.0F);
  EXPECT_FLOAT_EQ(200.0F * out.interaction_gain, 10.0F);
  EXPECT_FLOAT_EQ(out.target_gain, 0.49F);
  EXPECT_FLOAT_EQ(10.0F * out.reconfiguration_drives, 38.8F);
  EXPECT_FLOAT_EQ(0.1F * out.liveness_rounds, 1.2F);
  EXPECT_FLOAT_EQ(200.0F * out.recruitment_distance, 132.09F);
  EXPECT_FLOAT_EQ(200.0F * out.insertion_distance, 9.79F);
  const Params in = inwards_column();
  EXPECT_FLOAT_EQ(200.0F * in.safe_range, 135.25581F);
  EXPECT_FLOAT_EQ(200.0F * in.avoidance_range, 40.99F);
  EXPECT_FLOAT_EQ(200.0F * in.ideal_distance, 154.0841F);
  EXPECT_FLOAT_EQ(200.0F * in.interaction_gain, 10.0F);
  EXPECT_FLOAT_EQ(in.target_gain, 0.2539F);
  EXPECT_FLOAT_EQ(10.0F * in.reconfiguration_drives, 44.0F);
  EXPECT_FLOAT_EQ(0.1F * in.liveness_rounds, 0.5F);
  EXPECT_FLOAT_EQ(200.0F * in.recruitment_distance, 132.1353F);
  EXPECT_FLOAT_EQ(200.0F * in.insertion_distance, 6.6395F);
}

TEST(PaperParams, TheirOrderIsAEThenSThenDelta) {
  const auto faulty = [](float Params::*member, float value) {
    Params p = outwards_column();
    p.*member = value;
    return !fault(p).empty();
  };
  EXPECT_EQ(fault(outwards_column()), "");
  EXPECT_EQ(fault(inwards_column()), "");
  EXPECT_TRUE(faulty(&Params::avoidance_range, 0.67F));
  EXPECT_TRUE(faulty(&Params::recruitment_distance, 0.70F));
  EXPECT_TRUE(faulty(&Params::safe_range, 0.96F));
  EXPECT_TRUE(faulty(&Params::ideal_distance, 1.01F));
  EXPECT_FALSE(faulty(&Params::ideal_distance, 1.0F)) << "an edge without margin, but possible";
  EXPECT_TRUE(faulty(&Params::reconfiguration_drives, 301.0F)) << "numbers of one epoch would wrap";
}

TEST(PaperParams, EachHasARowThatAllowsTableI) {
  Params out = outwards_column();
  Params in = inwards_column();
  for (const auto& row : parameters()) {
    for (const Params& p : {out, in}) {
      EXPECT_GE(p.*row.member, row.minimum) << row.key;
      EXPECT_LE(p.*row.member, row.maximum) << row.key;
    }
  }
  EXPECT_EQ(parameters().size(), 13U);
}

}  // namespace
}  // namespace banyan::paper
