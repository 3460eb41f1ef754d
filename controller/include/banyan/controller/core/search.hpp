// SPDX-License-Identifier: MIT
// Searches as plain loops. libstdc++ unrolls std::any_of and the like four times, for size, too, which costs firmware
// almost three kilobytes; emscripten's library has no std::ranges::any_of.
#pragma once

namespace banyan {

// The first in [begin, end) of which `is` holds, or `end`.
template <class Iterator, class Is> [[nodiscard]] constexpr Iterator first_of(Iterator begin, Iterator end, Is is) {
  while (begin != end && !is(*begin)) ++begin;
  return begin;
}
template <class Range, class Is> [[nodiscard]] constexpr auto first_of(const Range& range, Is is) {
  return first_of(range.begin(), range.end(), is);
}

template <class Iterator, class Is> [[nodiscard]] constexpr bool any_of(Iterator begin, Iterator end, Is is) {
  return first_of(begin, end, is) != end;
}
template <class Range, class Is> [[nodiscard]] constexpr bool any_of(const Range& range, Is is) {
  return banyan::any_of(range.begin(), range.end(), is);
}
template <class Range, class Is> [[nodiscard]] constexpr bool all_of(const Range& range, Is is) {
  return !banyan::any_of(range, [&](const auto& element) { return !is(element); });
}

template <class Range, class Is> [[nodiscard]] constexpr int count_of(const Range& range, Is is) {
  int count = 0;
  for (const auto& element : range) count += is(element) ? 1 : 0;
  return count;
}

inline constexpr float not_counted = 1e9F;  // what does not count measures this

// The number from 0 to size - 1 whose measure is least and below the limit, the first of several; -1 if there is none.
template <class Measure> [[nodiscard]] constexpr int least_of(int size, float limit, Measure measure) {
  int least = -1;
  for (int k = 0; k < size; ++k)
    if (const float m = measure(k); m < limit) limit = m, least = k;
  return least;
}
// Likewise of those in a set (rows.hpp).
template <class Set, class Measure> [[nodiscard]] int least_of(const Set& set, float limit, Measure measure) {
  int least = -1;
  set.for_each([&](int k) {
    if (const float m = measure(k); m < limit) limit = m, least = k;
  });
  return least;
}

}  // namespace banyan
