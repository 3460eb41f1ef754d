// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/periods.hpp"

#include <gtest/gtest.h>

#include <random>

namespace banyan::udp {
namespace {

TEST(Periods, AgreeWithSortingThem) {
  std::mt19937 random(1);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same cases every time
  Periods periods;
  std::vector<std::uint32_t> all;
  EXPECT_EQ(periods.quantile_ms(0.5), 0.0);
  for (int k = 0; k < 10'000; ++k) {
    all.push_back(90'000 + static_cast<std::uint32_t>(random() % 20'000));
    periods.add(all.back());
  }
  std::sort(all.begin(), all.end());
  for (const double share : {0.01, 0.5, 0.9, 0.99})
    EXPECT_NEAR(periods.quantile_ms(share), all[static_cast<std::size_t>(share * 10'000.0)] / 1000.0, 0.051) << share;
  EXPECT_NEAR(periods.quantile_ms(1.0), all.back() / 1000.0, 0.1);
  EXPECT_EQ(periods.longest_ms(), all.back() / 1000.0);
  EXPECT_EQ(periods.count(), 10'000U);
}

TEST(Periods, OfSecondsCountAsTheLongest) {
  Periods periods;
  for (const std::uint32_t us : {100'000U, 3'000'000U, 4'000'000U}) periods.add(us);
  EXPECT_NEAR(periods.quantile_ms(0.1), 100.0, 0.051);
  EXPECT_EQ(periods.quantile_ms(0.9), 4000.0);
}

}  // namespace
}  // namespace banyan::udp
