// SPDX-License-Identifier: MIT
// Ids and counts of robots.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <type_traits>

namespace banyan {

// The ids of a swarm are those from 0 on; the largest number means nobody.
using RobotId = std::uint16_t;
inline constexpr RobotId nobody = 0xFFFF;
using RobotCount = std::uint16_t;  // of robots in a tree
inline constexpr std::uint32_t most_robots = 65535;

// Whether two values that fill a word are equal: in one comparison.
template <std::unsigned_integral Word, class T> constexpr bool equal_as(const T& a, const T& b) noexcept {
  static_assert(std::has_unique_object_representations_v<T>);
  return std::bit_cast<Word>(a) == std::bit_cast<Word>(b);
}

}  // namespace banyan
