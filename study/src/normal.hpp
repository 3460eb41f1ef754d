// SPDX-License-Identifier: MIT
// The standard normal distribution by + - * / and sqrt alone: the same bits whatever the machine's C library.
#pragma once

namespace banyan::study {

// P(Z > z), z >= 0; relative error < 1e-13 as far as doubles reach.
[[nodiscard]] double upper_tail(double z) noexcept;
// The z with P(-z < Z < z) = confidence.
[[nodiscard]] double two_sided_quantile(double confidence) noexcept;

}  // namespace banyan::study
