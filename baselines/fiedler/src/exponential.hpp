// SPDX-License-Identifier: MIT
// e^-x from + - * / alone, so that it is the same on every machine (controller/core/trig.hpp). Relative error < 2e-6.
#pragma once

#include <bit>
#include <cstdint>

namespace banyan::baselines::fiedler {

// x >= 0; zero beyond 80.
constexpr float exp_minus(float x) noexcept {
  if (!(x < 80.0F)) return 0.0F;
  // e^-x = 2^-n e^r, |r| <= ln 2 / 2; the two-part ln 2 keeps the reduction exact.
  const auto n = static_cast<std::int32_t>(x * 1.44269504F + 0.5F);
  const float whole = static_cast<float>(n);
  const float r = (whole * 0.693359375F - x) + whole * -2.12194440e-4F;
  const float e = 1.0F + r * (1.0F + r * (1.0F / 2 + r * (1.0F / 6 + r * (1.0F / 24 + r * (1.0F / 120 + r / 720)))));
  return e * std::bit_cast<float>(static_cast<std::uint32_t>(127 - n) << 23U);
}

}  // namespace banyan::baselines::fiedler
