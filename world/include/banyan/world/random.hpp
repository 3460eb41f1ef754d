// SPDX-License-Identifier: MIT
// Random numbers as a function of their purpose: (seed, purpose, a, b, tick) -> bits. No
// generator has a state, so neither thread count nor order of calls can change a draw.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "banyan/controller/core/trig.hpp"

namespace banyan::world {

// clang-format off
enum class Purpose : std::uint64_t {
  placement = 1, heading, root, targets, loss, range_noise, bearing_noise, wheel_noise, wheel_bias,
  odometry_noise, slots, kill, clock_phase, clock_rate, start,
  burst_end, path_loss, shadowing, one_way, antenna,
  start_charge, charge_noise
};
// clang-format on

// SplitMix64's finaliser (Steele, Lea & Flood 2014): a bijection with full avalanche.
constexpr std::uint64_t mix(std::uint64_t x) noexcept {
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31);
}

constexpr std::uint64_t bits(std::uint64_t seed, Purpose purpose, std::uint64_t a, std::uint64_t b = 0,
                             std::uint64_t c = 0) noexcept {
  return mix(mix(mix(mix(seed ^ (static_cast<std::uint64_t>(purpose) << 56)) ^ a) ^ b) ^ c);
}

// [0, 1), 53 bits.
constexpr double to_uniform(std::uint64_t b) noexcept { return static_cast<double>(b >> 11) * 0x1.0p-53; }

// Natural logarithm of x > 0 from + - * / alone, relative error < 1e-12: like trig.hpp, because
// the C library's differ between machines.
constexpr double deterministic_log(double x) noexcept {
  const std::uint64_t u = std::bit_cast<std::uint64_t>(x);
  int e = static_cast<int>((u >> 52) & 0x7FF) - 1023;
  double m = std::bit_cast<double>((u & 0x000FFFFFFFFFFFFFULL) | 0x3FF0000000000000ULL);  // [1, 2)
  if (m > 1.4142135623730951) {
    m *= 0.5;
    ++e;
  }
  const double t = (m - 1.0) / (m + 1.0);
  const double z = t * t;
  double s = 1.0 / 17;
  for (int k = 15; k >= 1; k -= 2) s = 1.0 / k + z * s;
  return 2.0 * t * s + e * 0.69314718055994530942;
}

// e^x for |x| < 700 from + - * / alone, relative error < 1e-12.
constexpr double deterministic_exp(double x) noexcept {
  const double halves = x * 1.44269504088896340736;
  const int k = static_cast<int>(halves < 0.0 ? halves - 0.5 : halves + 0.5);
  const double r = (x - k * 0.693147180369123816490) - k * 1.90821492927058770002e-10;  // ln 2 in two parts
  double s = 1.0;
  for (int i = 14; i >= 1; --i) s = 1.0 + r / i * s;
  return s * std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52);
}

// Standard normal from one draw of 64 bits (Box-Muller; 32 bits for each of its two uniforms).
inline double to_normal(std::uint64_t b) noexcept {
  const double u = (static_cast<double>(b >> 32) + 0.5) * 0x1.0p-32;
  const double v = static_cast<double>(b & 0xFFFFFFFFULL) * 0x1.0p-32;
  return std::sqrt(-2.0 * deterministic_log(u)) * unit_vector(2.0 * pi<double> * v).x;
}

}  // namespace banyan::world
