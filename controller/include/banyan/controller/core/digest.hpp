// SPDX-License-Identifier: MIT
// A running 64-bit digest of values, for state hashes: field by field, never over padding. It does not depend on how
// wide they are.
#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

#include "banyan/controller/core/fixed_point.hpp"
#include "banyan/controller/core/vec2.hpp"

namespace banyan {

class Digest {
 public:
  constexpr explicit Digest(std::uint64_t seed = 0xCBF29CE484222325ULL) noexcept : h_(seed) {}

  template <class T> constexpr void add(T v) noexcept {
    if constexpr (std::is_same_v<T, float>) absorb(std::bit_cast<std::uint32_t>(v));
    else if constexpr (std::is_same_v<T, double>) absorb(std::bit_cast<std::uint64_t>(v));
    else absorb(static_cast<std::uint64_t>(v));
  }
  template <class T> constexpr void add(BasicVec2<T> v) noexcept {
    add(v.x);
    add(v.y);
  }
  [[nodiscard]] constexpr std::uint64_t value() const noexcept { return h_; }

 private:
  constexpr void absorb(std::uint64_t v) noexcept {
    h_ = (h_ ^ v) * 0x9E3779B97F4A7C15ULL;
    h_ ^= h_ >> 29;
  }
  std::uint64_t h_;
};

// Adds what a message type lists as its fields (wire.hpp).
struct FieldDigest {
  Digest& digest;
  template <class E> constexpr void choice(const char*, const char*, const E& v, int, E) noexcept { digest.add(v); }
  constexpr void flag(const char*, const char*, bool v) noexcept { digest.add(v); }
  template <class T> constexpr void number(const char*, const char*, const T& v) noexcept { digest.add(v); }
  template <class T> constexpr void known(const char*, const char*, const T& v) noexcept { digest.add(v); }
  template <class T> constexpr void robot(const char*, const char*, const T& v) noexcept { digest.add(v); }
  template <class T> constexpr void count(const char*, const char*, const T& v) noexcept { digest.add(v); }
  template <class T> constexpr void scaled(const char*, const char*, const T& v, float) noexcept { digest.add(v); }
  constexpr void coordinate(const char*, const char*, Coordinate v) noexcept { digest.add(v.bits); }
  constexpr void real(const char*, const char*, float v, float) noexcept { digest.add(v); }
};

}  // namespace banyan
