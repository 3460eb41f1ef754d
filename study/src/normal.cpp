// SPDX-License-Identifier: MIT
#include "normal.hpp"

#include <cmath>
#include <numbers>

namespace banyan::study {
namespace {

// e^x for x <= 0: 2^k e^r with |r| <= ln(2) / 2, and Taylor's series of e^r. ln(2) is in two parts
// (fdlibm's), of which k times the first is exact.
double exponential(double x) noexcept {
  if (x < -745.2) return 0.0;  // below half the smallest double
  const double k = std::floor(x * std::numbers::log2e + 0.5);
  const double r = (x - k * 6.93147180369123816490e-01) - k * 1.90821492927058770002e-10;
  double sum = 1.0;
  for (int i = 17; i >= 1; --i) sum = 1.0 + sum * r / i;
  return std::ldexp(sum, static_cast<int>(k));
}

double normal_density(double z) noexcept {
  return exponential(-0.5 * z * z) * (std::numbers::inv_sqrtpi / std::numbers::sqrt2);
}

}  // namespace

// The series loses digits where the tail is small, the continued fraction (Laplace) converges only away from 0.
double upper_tail(double z) noexcept {
  if (z >= 2.5) {
    double fraction = z;
    for (int k = 120; k >= 1; --k) fraction = z + k / fraction;
    return normal_density(z) / fraction;
  }
  double term = z;
  double sum = z;
  for (int k = 3; term > 1e-17 * sum; k += 2) {
    term *= z * z / k;
    sum += term;
  }
  return 0.5 - normal_density(z) * sum;
}

// The tail is convex, so Newton's steps from 0 rise to the root and never pass it but by rounding.
double two_sided_quantile(double confidence) noexcept {
  const double tail = 0.5 * (1.0 - confidence);
  double z = 0.0;
  for (int i = 0; i < 200; ++i) {
    const double next = z + (upper_tail(z) - tail) / normal_density(z);
    if (!(next > z)) break;
    z = next;
  }
  return z;
}

}  // namespace banyan::study
