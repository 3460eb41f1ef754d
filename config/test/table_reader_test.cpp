// SPDX-License-Identifier: MIT
// Strict reading of tables that are no scenarios: what is not asked for, or not as asked for, is told.
#include "banyan/config/table_reader.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

namespace banyan::config {
namespace {

class Reading {
 public:
  explicit Reading(const std::string& text) : root_(parse_document("t.toml", text)), reader(root_, "", problems) {}

 private:
  Node root_;

 public:
  std::vector<Problem> problems;
  TableReader reader;

  // The only problem, and that there was just one since the last call.
  std::string problem() {
    EXPECT_EQ(problems.size(), 1U);
    auto text = problems.empty() ? "" : to_string(problems.back());
    problems.clear();
    return text;
  }
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(TableReader, GivesWhatIsThereElseTheFallback) {
  Reading r("t = \"x\"\nb = true\nn = 1.5\nw = 7\nl = [\"a\", \"b\"]\nc = \"two\"\n[s]\n[[m]]\n[[m]]\n");
  EXPECT_EQ(r.reader.text("t"), "x");
  EXPECT_EQ(r.reader.text("none", "y"), "y");
  EXPECT_TRUE(r.reader.boolean("b", false));
  EXPECT_TRUE(r.reader.boolean("none", true));
  EXPECT_EQ(r.reader.number("n", 2.0), 1.5);
  EXPECT_EQ(r.reader.number("w", 2.0), 7.0);
  EXPECT_EQ(r.reader.number("none", 2.0), 2.0);
  EXPECT_EQ(r.reader.number("none"), std::nullopt);
  EXPECT_EQ(r.reader.whole("w", 1), 7);
  EXPECT_EQ(r.reader.whole("none", 1), 1);
  EXPECT_EQ(r.reader.choice("c", {"one", "two"}, 0), 1U);
  EXPECT_EQ(r.reader.choice("none", {"one", "two"}, 0), 0U);
  EXPECT_EQ(r.reader.texts("l"), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(r.reader.texts("t"), (std::vector<std::string>{"x"}));
  EXPECT_TRUE(r.reader.texts("none").empty());
  EXPECT_NE(r.reader.table("s"), nullptr);
  EXPECT_EQ(r.reader.table("none"), nullptr);
  EXPECT_EQ(r.reader.tables("m").size(), 2U);
  EXPECT_TRUE(r.reader.tables("none").empty());
  EXPECT_NE(r.reader.list("l"), nullptr);
  EXPECT_EQ(r.reader.list("none"), nullptr);
  EXPECT_TRUE(r.reader.has("t"));
  EXPECT_FALSE(r.reader.has("none"));
  r.reader.require("t");
  r.reader.finish();
  EXPECT_TRUE(r.problems.empty());
}

TEST(TableReader, WrongTypesAreToldAndTakeTheFallback) {
  Reading r("x = [1]\nt = \"x\"\nn = 1.5\ne = []\n");
  EXPECT_EQ(r.reader.text("x", "f"), "f");
  EXPECT_EQ(r.problem(), "t.toml:1: error: x: must be a text, not a list of 1 value");
  EXPECT_FALSE(r.reader.boolean("t", false));
  EXPECT_EQ(r.problem(), "t.toml:2: error: t: must be true or false, not the text \"x\"");
  EXPECT_EQ(r.reader.number("t", 3.0), 3.0);
  EXPECT_TRUE(has(r.problem(), "t.toml:2: error: t: must be a number ("));
  EXPECT_EQ(r.reader.whole("n", 4), 4);
  EXPECT_TRUE(has(r.problem(), "t.toml:3: error: n: must be a whole number ("));
  EXPECT_TRUE(r.reader.texts("x").empty());
  EXPECT_TRUE(has(r.problem(), "x: must be a text or a list of texts, not empty"));
  EXPECT_TRUE(r.reader.texts("e").empty());
  EXPECT_TRUE(has(r.problem(), "t.toml:4: error: e: must be a text or a list of texts, not empty"));
  EXPECT_EQ(r.reader.table("t"), nullptr);
  EXPECT_EQ(r.problem(), "t.toml:2: error: t: is a section, [t], not the text \"x\"");
  EXPECT_TRUE(r.reader.tables("x").empty());
  EXPECT_TRUE(has(r.problem(), "x: is a list of tables, [[x]] once for each"));
  EXPECT_EQ(r.reader.list("e"), nullptr);
  EXPECT_EQ(r.problem(), "t.toml:4: error: e: is an empty list: give at least one value");
  EXPECT_EQ(r.reader.list("t"), nullptr);
  EXPECT_EQ(r.problem(), "t.toml:2: error: t: must be a list, [...], not the text \"x\"");
  EXPECT_EQ(r.reader.choice("t", {"one", "two"}, 1), 1U);
  EXPECT_EQ(r.problem(), "t.toml:2: error: t: is the text \"x\"; allowed: \"one\", \"two\"");
}

TEST(TableReader, RangesHoldAtTheirEnds) {
  Reading r("a = 0\nb = 1\nc = 1.0000001\nd = nan\ne = inf\n");
  EXPECT_EQ(r.reader.number("a", 9.0, {0.0, 1.0}), 0.0);
  EXPECT_EQ(r.reader.number("b", 9.0, {0.0, 1.0}), 1.0);
  EXPECT_TRUE(r.problems.empty());
  EXPECT_EQ(r.reader.number("a", 9.0, {0.0, 1.0, true}), 9.0);
  EXPECT_TRUE(has(r.problem(), "t.toml:1: error: a: is 0; allowed: "));
  for (const char* key : {"c", "d", "e"}) {
    EXPECT_EQ(r.reader.number(key, 9.0, {0.0, 1.0}), 9.0);
    EXPECT_TRUE(has(r.problem(), "; allowed: ")) << key;
  }
  EXPECT_EQ(r.reader.whole("b", 9, {2, 3}), 9);
  EXPECT_TRUE(has(r.problem(), "b: is 1; allowed: "));
}

TEST(TableReader, WhatNobodyAskedForIsToldWithTheNearestName) {
  Reading r("metrc = 1\nother = 2\n");
  (void)r.reader.text("metric");
  r.reader.finish();
  ASSERT_EQ(r.problems.size(), 2U);
  EXPECT_EQ(to_string(r.problems[0]),
            "t.toml:1: error: metrc: there is no such key; did you mean metric? (at the top: metric)");
  EXPECT_TRUE(has(to_string(r.problems[1]), "t.toml:2: error: other: there is no such key"));
}

TEST(TableReader, NamesTheTableItReads) {
  const Node root = parse_document("t.toml", "[[figures]]\nx = 1\n");
  std::vector<Problem> problems;
  TableReader reader((*root.find("figures")->array())[0], "figures[0]", problems);
  (void)reader.text("x");
  reader.require("metric", "it is drawn");
  reader.report("", "all wrong");
  ASSERT_EQ(problems.size(), 3U);
  EXPECT_EQ(to_string(problems[0]), "t.toml:2: error: figures[0].x: must be a text, not the number 1");
  EXPECT_EQ(to_string(problems[1]), "t.toml:1: error: figures[0].metric: is missing: it is drawn");
  EXPECT_EQ(to_string(problems[2]), "t.toml:1: error: figures[0]: all wrong");
}

TEST(Seeds, AreRangesOrLists) {
  const auto seeds = [](const std::string& value) {
    Reading r("seeds = " + value + "\n");
    auto list = r.reader.seeds("seeds");
    EXPECT_EQ(list.empty(), r.problems.size() == 1) << value;
    return list;
  };
  EXPECT_EQ(seeds("\"3-5\""), (std::vector<std::uint64_t>{3, 4, 5}));
  EXPECT_EQ(seeds("\"7\""), (std::vector<std::uint64_t>{7}));
  EXPECT_EQ(seeds("[9, 0, 9007199254740992]"), (std::vector<std::uint64_t>{9, 0, std::uint64_t{1} << 53U}));
  for (const char* bad : {"[]", "[1, 1]", "[-1]", "[1.0]", "[\"1\"]", "[9007199254740993]", "3", "\"\"", "\"5-3\"",
                          "\"1-\"", "\"-3\"", "\"1 - 3\"", "\"1-2-3\"", "\"a\"", "\"1.5-3\"", "\"0-10000000\"",
                          "\"0-9007199254740993\"", "\"99999999999999999999999\"", "true"})
    EXPECT_TRUE(seeds(bad).empty()) << bad;
}

RC_GTEST_PROP(Seeds, ARangeCountsFromItsFirstToItsLast, ()) {
  const auto first = *rc::gen::inRange<std::uint64_t>(0, std::uint64_t{1} << 52U);
  const auto count = *rc::gen::inRange<std::uint64_t>(1, 1000);
  const auto range = seed_range(std::to_string(first) + "-" + std::to_string(first + count - 1));
  RC_ASSERT(range.has_value());
  RC_ASSERT(range->size() == count);
  for (std::uint64_t i = 0; i < count; ++i) RC_ASSERT((*range)[i] == first + i);
}

}  // namespace
}  // namespace banyan::config
