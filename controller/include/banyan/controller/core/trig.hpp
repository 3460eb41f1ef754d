// SPDX-License-Identifier: MIT
// Sine, cosine, arc tangent and logarithm from + - * / alone. The C library's differ between
// glibc, musl and newlib in the last bit; these give one result on every machine, which the
// determinism contract (docs/determinism.md) needs. Absolute errors: sin, cos < 4e-11 for
// |angle| < 1e4; atan2 < 2e-11 (double) or a few ulp (float).
#pragma once

#include "banyan/controller/core/vec2.hpp"

namespace banyan {

template <class T> inline constexpr T pi = T(3.14159265358979323846);

// (cos angle, sin angle); angle in rad, |angle| < 1e4.
template <class T> constexpr BasicVec2<T> unit_vector(T angle) noexcept {
  // Reduce to [-pi/4, pi/4] by quarter turns; the two-part pi/2 keeps the reduction exact.
  const T quarters = angle * T(0.63661977236758134308);
  const int q = static_cast<int>(quarters < T(0) ? quarters - T(0.5) : quarters + T(0.5));
  const T turns = static_cast<T>(q);
  const T a = (angle - turns * T(1.5703125)) - turns * T(4.83826794896619e-4);
  const T z = a * a;
  const T s =
      a * (T(1) + z * (T(-1) / 6 + z * (T(1) / 120 + z * (T(-1) / 5040 + z * (T(1) / 362880 - z / T(39916800))))));
  const T c =
      T(1) + z * (T(-0.5) +
                  z * (T(1) / 24 + z * (T(-1) / 720 + z * (T(1) / 40320 + z * (T(-1) / 3628800 + z / T(479001600))))));
  switch (q & 3) {
    case 0: return {c, s};
    case 1: return {-s, c};
    case 2: return {-c, -s};
    default: return {s, -c};
  }
}

// Angle of v in (-pi, pi], rad; 0 for the zero vector.
template <class T> constexpr T angle_of(BasicVec2<T> v) noexcept {
  const T ax = v.x < T(0) ? -v.x : v.x;
  const T ay = v.y < T(0) ? -v.y : v.y;
  if (ax == T(0) && ay == T(0)) return T(0);
  const bool steep = ay > ax;
  T t = steep ? ax / ay : ay / ax;  // [0, 1]
  // atan t = pi/8 + atan((t - k) / (1 + k t)) with k = tan(pi/8) leaves |t| < 0.42; once more at
  // pi/16 leaves |t| < 0.2, where the series below is exact to 2e-11.
  T offset = T(0);
  if (t > T(0.19891236737965800691)) {
    constexpr T k = T(0.41421356237309504880);
    t = (t - k) / (T(1) + k * t);
    offset = pi<T> / 8;
    if (t > T(0.19891236737965800691)) {
      t = (t - k) / (T(1) + k * t);
      offset = pi<T> / 4;
    }
  }
  const T z = t * t;
  T a = offset +
        t * (T(1) + z * (T(-1) / 3 + z * (T(1) / 5 + z * (T(-1) / 7 + z * (T(1) / 9 + z * (T(-1) / 11 + z / 13))))));
  if (steep) a = pi<T> / 2 - a;
  if (v.x < T(0)) a = pi<T> - a;
  return v.y < T(0) ? -a : a;
}

}  // namespace banyan
