// SPDX-License-Identifier: MIT
#include "banyan/controller/convoy/params.hpp"

#include <gtest/gtest.h>

#include "banyan/controller/convoy/convoy.hpp"

namespace banyan {
namespace {

TEST(ConvoyParams, EdgesPullBeforeTheyAreAsLongAsTheyMayBe) {
  ConvoyParams p = convoy_defaults();
  EXPECT_TRUE(convoy_fault(p).empty());
  p.pull_start_m = p.communication_range_m;
  EXPECT_NE(convoy_fault(p).find("pull_start"), std::string_view::npos);
  p = convoy_defaults();
  p.join_margin_m = 0.95F * p.communication_range_m;
  EXPECT_NE(convoy_fault(p).find("join_margin"), std::string_view::npos);
}

}  // namespace
}  // namespace banyan
