// SPDX-License-Identifier: MIT
// How wide ids and counts of robots are: 16 bits, or 32 in a build for larger swarms (-DBANYAN_ID_BITS=32). Nothing
// else asks for the option: all follows from these names.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace banyan {

#ifdef BANYAN_ID_BITS
inline constexpr int id_bits = BANYAN_ID_BITS;
#else
inline constexpr int id_bits = 16;
#endif
static_assert(id_bits == 16 || id_bits == 32);
inline constexpr bool has_wide_ids = id_bits == 32;

using RobotId = std::conditional_t<has_wide_ids, std::uint32_t, std::uint16_t>;
inline constexpr RobotId nobody = static_cast<RobotId>(~RobotId{});
using RobotCount = RobotId;  // of robots in a tree

// The ids of a swarm are those from 0 on; the largest one of 16 bits means nobody.
inline constexpr std::uint16_t narrow_nobody = 0xFFFF;
inline constexpr std::uint32_t most_narrow_robots = 65535;
inline constexpr std::uint32_t most_robots = has_wide_ids ? 1'000'000 : most_narrow_robots;

// An id where all have 16 bits, in any build, and back. One that is too large is nobody's there.
constexpr std::uint16_t to_narrow(RobotId id) noexcept {
  return id < narrow_nobody ? static_cast<std::uint16_t>(id) : narrow_nobody;
}
constexpr RobotId from_narrow(std::uint16_t id) noexcept { return id == narrow_nobody ? nobody : RobotId{id}; }

// Whether two values are equal: as one word if they fill it, else field by field.
template <std::unsigned_integral Word, auto... fields, class T>
constexpr bool equal_as(const T& a, const T& b) noexcept {
  if constexpr (sizeof(T) == sizeof(Word)) return std::bit_cast<Word>(a) == std::bit_cast<Word>(b);
  else return (... && (a.*fields == b.*fields));
}

}  // namespace banyan
