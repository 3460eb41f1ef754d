// SPDX-License-Identifier: MIT
// Numbers as text, against printf and the JSON library.
#include "text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

#include "banyan/world/random.hpp"

namespace banyan::record {
namespace {

std::string fixed(double value, int decimals) {
  Text text;
  text.fixed(value, decimals);
  return std::string(text.view());
}

std::string printed(double value, int decimals) {
  std::array<char, 400> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*f", decimals, value);
  return buffer.data();
}

TEST(Text, FixedAgreesWithPrintfAwayFromTies) {
  for (std::uint64_t k = 0; k < 20000; ++k) {
    const double magnitude = std::pow(10.0, static_cast<double>(k % 9) - 3.0);
    const double value = (world::to_uniform(world::mix(k)) - 0.5) * magnitude;
    const int decimals = static_cast<int>(k % 10);
    const double scaled = std::fabs(value) * std::pow(10.0, decimals);
    if (std::fabs(scaled - std::floor(scaled) - 0.5) < 1e-6 * std::max(1.0, scaled)) continue;  // a tie or nearly
    std::string expected = printed(value, decimals);
    if (expected.find_first_of("123456789") == std::string::npos && expected[0] == '-') expected.erase(0, 1);
    EXPECT_EQ(fixed(value, decimals), expected) << value << " " << decimals;
  }
}

TEST(Text, FixedRoundsHalfAwayFromZeroAndNeverWritesMinusZero) {
  EXPECT_EQ(fixed(0.125, 2), "0.13");
  EXPECT_EQ(fixed(-0.125, 2), "-0.13");
  EXPECT_EQ(fixed(-0.0, 3), "0.000");
  EXPECT_EQ(fixed(-0.0004, 3), "0.000");
  EXPECT_EQ(fixed(2.5, 0), "3");
}

TEST(Text, FixedOfWhatIsHugeOrNotFinite) {
  EXPECT_EQ(fixed(1e300, 4), printed(1e300, 4));
  EXPECT_EQ(fixed(-std::numeric_limits<double>::max(), 9), printed(-std::numeric_limits<double>::max(), 9));
  EXPECT_EQ(fixed(std::numeric_limits<double>::quiet_NaN(), 4), "null");
  EXPECT_EQ(fixed(-std::numeric_limits<double>::infinity(), 4), "null");
}

TEST(Text, IntegersOfEveryLength) {
  std::uint64_t value = 0;
  for (int k = 0; k < 64; ++k) {
    for (const std::uint64_t v : {value, value + 1, ~value}) {
      Text natural, integer;
      natural.natural(v);
      integer.integer(static_cast<std::int64_t>(v));
      EXPECT_EQ(natural.view(), std::to_string(v));
      EXPECT_EQ(integer.view(), std::to_string(static_cast<std::int64_t>(v)));
    }
    value = 2 * value + static_cast<std::uint64_t>(k % 2);
  }
}

TEST(Text, ShortestReadsBackExactly) {
  for (std::uint64_t k = 0; k < 1000; ++k) {
    const double value = world::to_normal(world::mix(k)) * 1e3;
    Text text;
    text.shortest(value);
    EXPECT_EQ(std::stod(std::string(text.view())), value);
  }
}

// Every byte value in every position: valid JSON whatever comes in, unchanged if it was UTF-8.
TEST(Text, JsonStringsAreAlwaysValid) {
  for (std::uint64_t k = 0; k < 5000; ++k) {
    std::string bytes;
    for (std::uint64_t b = 0; b < k % 12; ++b) bytes.push_back(static_cast<char>(world::bits(k, {}, b)));
    Text text;
    text.json_string(bytes);
    EXPECT_TRUE(nlohmann::json::accept(text.view())) << text.view();
  }
  const std::string fine = "a\"b\\c\n\t\x01 \xC3\xA4 \xE2\x82\xAC \xF0\x9F\x8C\xB3";
  Text text;
  text.json_string(fine);
  EXPECT_EQ(nlohmann::json::parse(text.view()).get<std::string>(), fine);
}

TEST(Text, XmlIsEscaped) {
  Text text;
  text.xml("a<b>&\"c\" \xFF\x01");
  EXPECT_EQ(text.view(), "a&lt;b&gt;&amp;&quot;c&quot; \xEF\xBF\xBD\xEF\xBF\xBD");
}

}  // namespace
}  // namespace banyan::record
