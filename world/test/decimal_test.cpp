// SPDX-License-Identifier: MIT
// What stands in for std::to_chars where it is missing, against std::to_chars.
#include "banyan/world/decimal.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "banyan/world/random.hpp"

namespace banyan::world {
namespace {

template <class Float> std::string ours(Float value) {
  char text[longest_shortest];
  return {text, without_to_chars::write_shortest(text, value)};
}

template <class Float> std::string standard(Float value) {
  char text[64];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

template <class Float> void expect_the_same(Float value) {
  ASSERT_EQ(ours(value), standard(value));
  ASSERT_EQ(ours(-value), standard(-value));
}

TEST(Decimal, ShortestOfWhateverBitsAreIsThatOfTheStandardLibrary) {
  for (std::uint64_t k = 0; k < 4000; ++k) {
    expect_the_same(std::bit_cast<double>(mix(k)));
    expect_the_same(std::bit_cast<float>(static_cast<std::uint32_t>(mix(k))));
  }
}

// Above a power of two the neighbours are farther away than below it: the one case in which rounding
// to the fewest digits is not enough.
TEST(Decimal, ShortestOfPowersOfTwo) {
  for (int e = -1074; e < 1024; ++e) expect_the_same(std::ldexp(1.0, e));
  for (int e = -149; e < 128; ++e) expect_the_same(std::ldexp(1.0F, e));
}

TEST(Decimal, ShortestOfNumbersThatPeopleWrite) {
  for (std::uint64_t k = 0; k < 20000; ++k) {
    const double scale = std::pow(10.0, static_cast<double>(k % 12) - 4.0);
    expect_the_same(std::round(to_uniform(mix(k)) * 1e4) / scale);
    expect_the_same(static_cast<float>(std::round(to_uniform(mix(k)) * 1e3) / scale));
    expect_the_same(static_cast<double>(k) * 0.1);                   // times of ticks
    expect_the_same(std::floor(to_uniform(mix(k)) * scale * 1e20));  // whole, and larger than digits can tell
  }
}

TEST(Decimal, ShortestAtTheEnds) {
  using D = std::numeric_limits<double>;
  for (const double x :
       {0.0, D::min(), D::max(), D::denorm_min(), D::epsilon(), D::infinity(), 1e22, 1e23, 9007199254740993.0,
        123456789012345680.0, 1e5, 100000.5, 1e-5, 0.0001, 0.00012, 1e15, 1e16, 99999.0})
    expect_the_same(x);
  EXPECT_EQ(ours(D::quiet_NaN()), standard(D::quiet_NaN()));
  for (const float x :
       {0.0F, std::numeric_limits<float>::max(), std::numeric_limits<float>::denorm_min(), 16777216.0F, 33554432.0F})
    expect_the_same(x);
}

TEST(Decimal, FixedIsThatOfTheStandardLibrary) {
  for (std::uint64_t k = 0; k < 5000; ++k) {
    const double value = std::bit_cast<double>(mix(k));
    if (!std::isfinite(value)) continue;
    const int decimals = static_cast<int>(k % 10);
    char a[longest_fixed], b[longest_fixed];
    ASSERT_EQ(std::string(a, without_to_chars::write_fixed(a, value, decimals)),
              std::string(b, std::to_chars(b, b + longest_fixed, value, std::chars_format::fixed, decimals).ptr));
  }
}

TEST(Decimal, ReadsBack) {
  for (std::uint64_t k = 0; k < 5000; ++k) {
    const double value = std::bit_cast<double>(mix(k));
    if (!std::isfinite(value)) continue;
    EXPECT_EQ(read_decimal(ours(value).c_str()), value);
  }
}

}  // namespace
}  // namespace banyan::world
