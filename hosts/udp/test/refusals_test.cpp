// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/refusals.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace banyan::udp {
namespace {

TEST(Refusals, WhoHasNoKeyCannotUseUpTheLinesOfThoseWhoHave) {
  std::vector<std::string> told;
  Refusals refusals;
  refusals.tell([&](const std::string& text) { told.push_back(text); });
  for (int port = 1; port <= 1000; ++port)
    refusals.refuse(Drop::foreign, parse_address("10.0.0.1:" + std::to_string(port)), std::nullopt);
  EXPECT_EQ(told.size(), 33U);  // the last says that there are more
  refusals.refuse(Drop::misaddressed, parse_address("10.0.0.2:1"), NodeId{7});
  refusals.refuse(Drop::misaddressed, parse_address("10.0.0.2:1"), NodeId{7});
  ASSERT_EQ(told.size(), 34U);
  EXPECT_EQ(told.back(), "refused robot 7 at 10.0.0.2:1: nobody of this id is expected here");
}

TEST(Refusals, ASecondRobotIsToldWithBothPlaces) {
  std::vector<std::string> told;
  Refusals refusals;
  refusals.tell([&](const std::string& text) { told.push_back(text); },
                [](NodeId id) { return "cf_" + std::to_string(id); });
  refusals.refuse(Drop::in_use, parse_address("10.0.0.3:1"), NodeId{4});
  EXPECT_TRUE(told.empty());  // it may be one that has started again
  refusals.rival(4, parse_address("10.0.0.2:1"));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("robot cf_4 at 10.0.0.3:1: the one at 10.0.0.2:1 is running"), std::string::npos) << told[0];
}

}  // namespace
}  // namespace banyan::udp
