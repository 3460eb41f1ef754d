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

}  // namespace banyan
