// SPDX-License-Identifier: MIT
// A vector in the plane. Single precision on the robot (`Vec2`), double in the world.
#pragma once

#include <cmath>

namespace banyan {

// On a chip two floats are aligned as one double word: else gcc for ARM passes them through the stack, not in
// registers, which would take firmware 2,840 bytes more. Elsewhere states would only be larger.
template <class T> struct alignas(sizeof(void*) == 4 ? 8 : alignof(T)) BasicVec2 {
  T x{};
  T y{};

  // clang-format off
  constexpr BasicVec2& operator+=(BasicVec2 o) noexcept { x += o.x; y += o.y; return *this; }
  constexpr BasicVec2& operator-=(BasicVec2 o) noexcept { x -= o.x; y -= o.y; return *this; }
  constexpr BasicVec2& operator*=(T s) noexcept { x *= s; y *= s; return *this; }
  // clang-format on
  friend constexpr BasicVec2 operator+(BasicVec2 a, BasicVec2 b) noexcept { return {a.x + b.x, a.y + b.y}; }
  friend constexpr BasicVec2 operator-(BasicVec2 a, BasicVec2 b) noexcept { return {a.x - b.x, a.y - b.y}; }
  friend constexpr BasicVec2 operator-(BasicVec2 a) noexcept { return {-a.x, -a.y}; }
  friend constexpr BasicVec2 operator*(BasicVec2 a, T s) noexcept { return {a.x * s, a.y * s}; }
  friend constexpr BasicVec2 operator*(T s, BasicVec2 a) noexcept { return {a.x * s, a.y * s}; }
  friend constexpr BasicVec2 operator/(BasicVec2 a, T s) noexcept { return {a.x / s, a.y / s}; }
  friend constexpr bool operator==(BasicVec2, BasicVec2) noexcept = default;
};

using Vec2 = BasicVec2<float>;

template <class T> constexpr T dot(BasicVec2<T> a, BasicVec2<T> b) noexcept { return a.x * b.x + a.y * b.y; }
template <class T> constexpr T cross(BasicVec2<T> a, BasicVec2<T> b) noexcept { return a.x * b.y - a.y * b.x; }
template <class T> constexpr T squared_norm(BasicVec2<T> a) noexcept { return dot(a, a); }
// sqrt is exact under IEEE 754, so norms agree between machines; hypot does not.
template <class T> T norm(BasicVec2<T> a) noexcept { return std::sqrt(squared_norm(a)); }
template <class T> T distance(BasicVec2<T> a, BasicVec2<T> b) noexcept { return norm(b - a); }

// a / |a|; the zero vector stays zero.
template <class T> BasicVec2<T> unit(BasicVec2<T> a) noexcept {
  const T n = norm(a);
  return n > T(0) ? a / n : BasicVec2<T>{};
}

// a, shortened to `limit` if it is longer.
template <class T> BasicVec2<T> clamped(BasicVec2<T> a, T limit) noexcept {
  const T n = norm(a);
  return n > limit ? a * (limit / n) : a;
}

// A quarter turn to the left.
template <class T> constexpr BasicVec2<T> left_of(BasicVec2<T> v) noexcept { return {-v.y, v.x}; }

// The point of segment a-b that is nearest to the origin.
template <class T> constexpr BasicVec2<T> nearest_on_segment(BasicVec2<T> a, BasicVec2<T> b) noexcept {
  const BasicVec2<T> d = b - a;
  const T d2 = squared_norm(d);
  const T t = d2 > T(0) ? -dot(a, d) / d2 : T(0);
  return a + d * (t < T(0) ? T(0) : t > T(1) ? T(1) : t);
}

// The distance of p from segment a-b.
template <class T> T distance_to_segment(BasicVec2<T> p, BasicVec2<T> a, BasicVec2<T> b) noexcept {
  return norm(nearest_on_segment(a - p, b - p));
}

// The segment from the origin to `to` crosses the one from a to b.
template <class T> constexpr bool crosses(BasicVec2<T> to, BasicVec2<T> a, BasicVec2<T> b) noexcept {
  return cross(to, a) * cross(to, b) < T(0) && cross(b - a, -a) * cross(b - a, to - a) < T(0);
}

// A rotation is a unit vector (cos, sin): composing two is complex multiplication, no trigonometry.
template <class T> constexpr BasicVec2<T> rotate(BasicVec2<T> rotation, BasicVec2<T> v) noexcept {
  return {rotation.x * v.x - rotation.y * v.y, rotation.y * v.x + rotation.x * v.y};
}
template <class T> constexpr BasicVec2<T> rotate_back(BasicVec2<T> rotation, BasicVec2<T> v) noexcept {
  return {rotation.x * v.x + rotation.y * v.y, rotation.x * v.y - rotation.y * v.x};
}

}  // namespace banyan
