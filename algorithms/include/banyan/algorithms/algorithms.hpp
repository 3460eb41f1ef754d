// SPDX-License-Identifier: MIT
// The algorithms that come with Banyan. Static lifetime. All of them, by name: core/algorithm.hpp.
#pragma once

#include "banyan/controller/core/algorithm.hpp"

namespace banyan {

[[nodiscard]] const Algorithm& outwards() noexcept;
[[nodiscard]] const Algorithm& inwards() noexcept;
[[nodiscard]] const Algorithm& convoy() noexcept;

}  // namespace banyan
