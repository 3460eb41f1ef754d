// SPDX-License-Identifier: MIT
// Options change what they say and nothing else.
#include "banyan/config/override.hpp"

#include <gtest/gtest.h>

namespace banyan::config {
namespace {

TEST(Override, TakesTomlOrBareText) {
  Node root = parse_document("a.toml", "[radio]\nloss = 0.1\n[[events]]\ntime_s = 1\n");

  EXPECT_TRUE(apply(root, {"radio.loss=0.3", "--set"}).empty());
  EXPECT_TRUE(apply(root, {"mission.algorithm = inwards", "--set"}).empty());
  EXPECT_TRUE(apply(root, {"name=\"x y\"", "--set"}).empty());
  EXPECT_TRUE(apply(root, {"events[0].time_s=2", "--set"}).empty());
  EXPECT_TRUE(apply(root, {"targets.positions_m=[[1, 2]]", "--set"}).empty());

  EXPECT_EQ(std::get<double>(root.find("radio")->find("loss")->value), 0.3);
  EXPECT_EQ(*root.find("mission")->find("algorithm")->string(), "inwards");
  EXPECT_EQ(*root.find("name")->string(), "x y");
  EXPECT_EQ(std::get<std::int64_t>((*root.find("events")->array())[0].find("time_s")->value), 2);
  EXPECT_EQ((*root.find("targets")->find("positions_m")->array()).size(), 1U);
}

TEST(Override, OneAssignmentSetsOneKey) {
  Node root = parse_document("a.toml", "seed = 1\n");

  EXPECT_TRUE(apply(root, {"name=1\nseed = 2", "--set"}).empty());

  EXPECT_EQ(*root.find("name")->string(), "1\nseed = 2");  // bare text, for the reader to refuse
  EXPECT_EQ(std::get<std::int64_t>(root.find("seed")->value), 1);
}

TEST(Override, SaysWhatIsWrongWithIt) {
  for (const char* bad : {"", "radio", "=1", ".a=1", "a.=1", "a..b=1", "a[=1", "a[x]=1", "a[0]b=1", "events[7].x=1",
                          "seed[0]=1", "name=\xff"}) {
    Node root = parse_document("a.toml", "seed = 1\nevents = [{}]\n");
    EXPECT_EQ(apply(root, {bad, "--set x"}).size(), 1U) << bad;
  }
}

TEST(Assign, MakesWhatIsMissingAndReachesIntoLists) {
  Node root = parse_document("a.toml", "x = 1\n[[events]]\ntime_s = 1\n[[events]]\ntime_s = 2\n");

  EXPECT_TRUE(assign(root, "a.b.c", {std::int64_t{5}, {}}).empty());
  EXPECT_TRUE(assign(root, "events[1].time_s", {3.5, {}}).empty());
  EXPECT_TRUE(assign(root, "x", {true, {}}).empty());
  EXPECT_TRUE(assign(root, "events[0]", {std::string("whole"), {}}).empty());

  EXPECT_EQ(std::get<std::int64_t>(root.find("a")->find("b")->find("c")->value), 5);
  const auto& events = *root.find("events")->array();
  EXPECT_EQ(std::get<double>(events[1].find("time_s")->value), 3.5);
  EXPECT_EQ(*events[0].string(), "whole");
  EXPECT_TRUE(std::get<bool>(root.find("x")->value));
}

TEST(Assign, FaultsAreAtThePlaceOfTheValue) {
  Node root = parse_document("a.toml", "x = 1\nevents = []\n");
  const Node value = parse_document("b.toml", "\n\nv = 1\n").table()->front().value;

  for (const char* key : {"", "a..b", "events[0]", "x[0]", ".a", "a[", "a[b]"}) {
    const auto problems = assign(root, key, value);
    ASSERT_EQ(problems.size(), 1U) << key;
    EXPECT_EQ(problems[0].place.text(), "b.toml:3") << key;
  }
}

TEST(AsOption, KeepsEveryPlaceInWordsButNotAsAFile) {
  const Node option = as_option(parse_document("a.toml", "[s]\ny = [1,\n 2]\n"));

  const Node* y = option.find("s")->find("y");
  EXPECT_EQ(y->place.text(), "a.toml:2");
  EXPECT_FALSE(y->place.from_file());
  EXPECT_EQ((*y->array())[1].place.text(), "a.toml:3");
  EXPECT_EQ(as_option(option).find("s")->find("y")->place.text(), "a.toml:2");  // again is no change
}

TEST(Overlay, MergesTablesAndReplacesTheRest) {
  Node root = parse_document("a.toml", "x = 1\nl = [1, 2]\n[s]\na = 1\nb = 2\n[t]\nq = 1\n");

  overlay(root, parse_document("b.toml", "l = [3]\nn = 4\nt = 5\n[s]\nb = 3\nc.d = 4\n[x]\ny = 1\n"));

  EXPECT_EQ(root.find("l")->array()->size(), 1U);
  EXPECT_EQ(std::get<std::int64_t>(root.find("n")->value), 4);
  EXPECT_EQ(std::get<std::int64_t>(root.find("t")->value), 5);
  EXPECT_EQ(std::get<std::int64_t>(root.find("s")->find("a")->value), 1);
  EXPECT_EQ(std::get<std::int64_t>(root.find("s")->find("b")->value), 3);
  EXPECT_EQ(std::get<std::int64_t>(root.find("s")->find("c")->find("d")->value), 4);
  EXPECT_EQ(std::get<std::int64_t>(root.find("x")->find("y")->value), 1);
  EXPECT_EQ(root.find("s")->find("b")->place.text(), "b.toml:5");
}

}  // namespace
}  // namespace banyan::config
