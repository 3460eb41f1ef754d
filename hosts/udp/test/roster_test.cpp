// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/roster.hpp"

#include <gtest/gtest.h>

#include "banyan/hosts/udp/option_error.hpp"

namespace banyan::udp {
namespace {

using Words = std::vector<std::string>;
using Ids = std::vector<NodeId>;

Words names_of(const Roster& roster) {
  Words names;
  for (std::size_t i = 0; i < roster.size(); ++i) names.push_back(roster.name(i));
  return names;
}
Ids ids_of(const Roster& roster) {
  Ids ids;
  for (std::size_t i = 0; i < roster.size(); ++i) ids.push_back(roster.id(i));
  return ids;
}
std::string fault_of(const std::string& names) {
  try {
    const Roster roster(names);
  } catch (const OptionError& error) { return error.what(); }
  return "";
}

TEST(Roster, WithoutNamesRobotsAreCalledByTheirIdsFromZero) {
  const Roster roster(3);
  EXPECT_EQ(names_of(roster), (Words{"0", "1", "2"}));
  EXPECT_EQ(ids_of(roster), (Ids{0, 1, 2}));
}

TEST(Roster, ANameEndsInItsId) {
  const Roster roster("cf_1,cf_2,cf231");
  EXPECT_EQ(names_of(roster), (Words{"cf_1", "cf_2", "cf231"}));
  EXPECT_EQ(ids_of(roster), (Ids{1, 2, 231}));
  EXPECT_EQ(ids_of(Roster("leo,mia")), (Ids{0, 1}));  // where none has a number, they are counted
}

TEST(Roster, ARangeStandsForItsNumbersWithTheDigitsOfTheFirst) {
  EXPECT_EQ(names_of(Roster("robot_{08-10},lead_42")), (Words{"robot_08", "robot_09", "robot_10", "lead_42"}));
  EXPECT_EQ(ids_of(Roster("robot_{08-10},lead_42")), (Ids{8, 9, 10, 42}));
  EXPECT_EQ(names_of(Roster("{9-11}")), (Words{"9", "10", "11"}));
  EXPECT_EQ(names_of(Roster("a{3-3}")), (Words{"a3"}));
}

TEST(Roster, FindsByNameAndById) {
  const Roster roster("cf_1,cf_07,cf231");
  EXPECT_EQ(roster.find("cf_07"), 1U);
  EXPECT_EQ(roster.find("7"), 1U);
  EXPECT_EQ(roster.find("cf_7"), std::nullopt);
  EXPECT_EQ(roster.find("2"), std::nullopt);
  EXPECT_EQ(roster.find(""), std::nullopt);
  EXPECT_EQ(roster.with_id(231), 2U);
  EXPECT_EQ(roster.with_id(0), std::nullopt);
}

TEST(Roster, WhoeverJoinsIsNamedAsTheOthersAre) {
  Roster padded("robot_{01-02}", 2);
  EXPECT_EQ(padded.most(), 4U);
  EXPECT_EQ(padded.name_of(7), "robot_07");
  EXPECT_EQ(padded.id_of("robot_07"), 7);
  EXPECT_EQ(padded.id_of("robot_x"), std::nullopt);
  EXPECT_EQ(padded.add(7), 2U);
  EXPECT_EQ(padded.find("robot_07"), 2U);
  EXPECT_EQ(padded.find("7"), 2U);
  EXPECT_EQ(Roster("cf_1,lead_2").name_of(7), "7");  // they have no name in common
  EXPECT_EQ(Roster(2).name_of(7), "7");
}

TEST(Roster, SaysWhatIsWrongWithAList) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "a name is empty"},
      {"a1,,a2", "a name is empty"},
      {"a1,a1", "\"a1\" is given twice"},
      {"a1,b01", "\"a1\" and \"b01\" have the same id, 1"},
      {"a1,b", "\"b\" must end in a number, its id, as others do"},
      {"a65534", "from 0 to 65533"},
      {"a99999999999999999999", "from 0 to 65533"},
      {"a b1", "\"a b1\" has ' '"},
      {"a{1-", "must end in braces with a range of numbers, from 0 to 65533, as cf{1-9} or robot_{01-12}"},
      {"a{}", "must end in braces"},
      {"a{3-1}", "must end in braces"},
      {"a{1-x}", "must end in braces"},
      {"a{1..3}", "must end in braces"},
      {"a{1-2}{1-2}", "must end in braces"},
      {"a{1-2}b", "must end in braces"},
      {"a{0-65533},b{0-65533}", "at most 65534 robots"},
  };
  for (const auto& [names, words] : cases)
    EXPECT_NE(fault_of(names).find(words), std::string::npos) << names << ": " << fault_of(names);
}

}  // namespace
}  // namespace banyan::udp
