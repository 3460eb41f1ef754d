// SPDX-License-Identifier: MIT
// Words for what has no title of its own.
#include "../../src/figure/words.hpp"

#include <gtest/gtest.h>

#include <set>

#include "banyan/study/results.hpp"

namespace banyan::study {
namespace {

TEST(FigureWords, EveryMetricHasThem) {
  std::set<std::string> all;
  for (const std::string_view metric : metrics()) {
    const std::string words = words_of_metric(metric);
    EXPECT_EQ(words.find('_'), std::string::npos) << metric;
    EXPECT_LT(words.size(), 50U) << metric;
    EXPECT_TRUE(all.insert(words).second) << words << " is two metrics";
  }
  EXPECT_EQ(words_of_metric("disconnected_time_ratio"), "share of time with a broken edge");
  EXPECT_EQ(words_of_metric("insertions"), "insertions");
}

TEST(FigureWords, NamesLoseTheirUnderscores) {
  EXPECT_EQ(words_of_name("line_of_sight"), "line of sight");
  EXPECT_EQ(words_of_name("radius_m"), "radius (m)");
  EXPECT_EQ(words_of_name("wheel_limit_m_s"), "wheel limit (m/s)");
  EXPECT_EQ(words_of_name("r"), "r");
  EXPECT_EQ(words_of_name("_m"), " m");
}

TEST(FigureWords, AValueStandsWithItsUnit) {
  EXPECT_EQ(with_value("target radius r (m)", "3"), "target radius r = 3 m");
  EXPECT_EQ(with_value("targets T", "4"), "targets T = 4");
  EXPECT_EQ(with_value("line of sight", "on"), "line of sight on");
  EXPECT_EQ(with_value("reading", "literal"), "reading: literal");
  EXPECT_EQ(with_value("packet loss", "30 %"), "packet loss: 30 %");
  EXPECT_EQ(with_value("(m)", "1.5"), "(m) = 1.5");
}

}  // namespace
}  // namespace banyan::study
