// SPDX-License-Identifier: MIT
// Searches as plain loops, beside those of the standard library.
#include "banyan/controller/core/search.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "banyan/controller/core/fixed_point.hpp"
#include "banyan/controller/core/rows.hpp"

namespace banyan {
namespace {

// Few different values, so that there are ties, and some at the limit or beyond it.
std::vector<int> some_values() { return *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 8)); }

RC_GTEST_PROP(Search, FindsTheFirst, ()) {
  const std::vector<int> values = some_values();
  const auto is = [wanted = *rc::gen::inRange(0, 8)](int v) { return v == wanted; };
  RC_ASSERT(banyan::first_of(values, is) == std::find_if(values.begin(), values.end(), is));
  RC_ASSERT(banyan::any_of(values, is) == std::any_of(values.begin(), values.end(), is));
  RC_ASSERT(banyan::all_of(values, is) == std::all_of(values.begin(), values.end(), is));
}

RC_GTEST_PROP(Search, FindsTheFirstOfTheLeastBelowTheLimit, ()) {
  std::vector<int> values = some_values();
  values.resize(std::min<std::size_t>(values.size(), neighbor_capacity));
  Rows members;
  for (std::size_t k = 0; k < values.size(); ++k) members.set(static_cast<int>(k), *rc::gen::arbitrary<bool>());
  const int limit = *rc::gen::inRange(0, 9);
  const auto measure = [&](int k) { return static_cast<float>(values[static_cast<std::size_t>(k)]); };
  const auto least = std::min_element(values.begin(), values.end());
  const bool found = least != values.end() && *least < limit;
  RC_ASSERT(least_of(static_cast<int>(values.size()), static_cast<float>(limit), measure) ==
            (found ? static_cast<int>(least - values.begin()) : -1));

  int of_members = -1;
  members.for_each([&](int k) {
    if (measure(k) < static_cast<float>(limit) && (of_members < 0 || measure(k) < measure(of_members))) of_members = k;
  });
  RC_ASSERT(least_of(members, static_cast<float>(limit), measure) == of_members);
}

TEST(Saturated, StaysAtTheLargest) {
  EXPECT_EQ(saturated(0), 0);
  EXPECT_EQ(saturated(65'534), 65'534);
  EXPECT_EQ(saturated(65'535), 65'535);
  EXPECT_EQ(saturated(65'536), 65'535);
  EXPECT_EQ(saturated(UINT32_MAX), 65'535);
}

TEST(Search, CountsThoseThatAreSo) {
  constexpr std::array numbers{3, 5, 8};
  EXPECT_EQ(count_of(numbers, [](int n) { return n % 2 == 1; }), 2);
  EXPECT_EQ(count_of(numbers, [](int n) { return n > 8; }), 0);
}

}  // namespace
}  // namespace banyan
