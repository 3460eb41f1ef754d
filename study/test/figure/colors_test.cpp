// SPDX-License-Identifier: MIT
// Whether the colours of series can be told apart, also by people who lack one kind of cone.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>

#include "../../src/figure/figure_script.hpp"

namespace banyan::study {
namespace {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

Vector times(const Matrix& m, const Vector& v) {
  Vector result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return result;
}

Vector linear_rgb(const std::string& hex) {
  Vector rgb{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = std::stoi(hex.substr(1 + 2 * i, 2), nullptr, 16) / 255.0;
    rgb[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
  return rgb;
}

// CIE L*a*b* under D65.
Vector lab(const Vector& rgb) {
  const Matrix to_xyz{{{0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}}};
  const Vector xyz = times(to_xyz, rgb), white{0.9505, 1.0, 1.089};
  Vector f{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double t = std::max(0.0, xyz[i] / white[i]);
    f[i] = t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0;
  }
  return {116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])};
}

double distance(const Vector& a, const Vector& b) {
  return std::sqrt(std::pow(a[0] - b[0], 2) + std::pow(a[1] - b[1], 2) + std::pow(a[2] - b[2], 2));
}

// What protanopes, deuteranopes and tritanopes see (Machado, Oliveira, Fernandes 2009, severity 1), and all others.
const std::array<Matrix, 4> sights{{
    {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
    {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}},
    {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}},
    {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}},
}};

double least_distance() {
  double least = 1e9;
  for (const Matrix& sight : sights) {
    for (std::size_t a = 0; a < most_series; ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const auto seen = [&](std::size_t s) { return lab(times(sight, linear_rgb(std::string(style_of(s).color)))); };
        least = std::min(least, distance(seen(a), seen(b)));
      }
    }
  }
  return least;
}

// A difference of 2.3 is just noticeable.
TEST(FigureColors, CanBeToldApartByAll) { EXPECT_GT(least_distance(), 15.0); }

TEST(FigureColors, AreDarkEnoughForLinesOnWhite) {
  for (std::size_t s = 0; s < most_series; ++s)
    EXPECT_LT(lab(linear_rgb(std::string(style_of(s).color)))[0], 75.0) << style_of(s).color;
}

// Variants of a colour differ in their fill by at least an eighth, and in their points.
TEST(FigureColors, NoTwoLooksAreTheSame) {
  std::set<std::string> points;
  for (std::size_t s = 0; s < most_series; ++s) {
    for (std::size_t v = 0; v < most_variants; ++v) {
      const Style style = style_of(s, v);
      EXPECT_TRUE(style.fill >= 0.0 && style.fill < 1.0);
      EXPECT_EQ(style.color, style_of(s).color) << "variants keep the colour";
      for (std::size_t w = 0; w < v; ++w) EXPECT_GT(std::fabs(style.fill - style_of(s, w).fill), 0.12);
      points.insert(std::string(style.color) + std::to_string(style.point));
    }
  }
  EXPECT_EQ(points.size(), most_series * most_variants);
}

}  // namespace
}  // namespace banyan::study
