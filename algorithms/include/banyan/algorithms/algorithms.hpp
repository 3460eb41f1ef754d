// SPDX-License-Identifier: MIT
// The algorithms that come with Banyan as a list, and those over the tree one by one; others are found by name. Static
// lifetime.
#pragma once

#include "banyan/controller/core/algorithm.hpp"

namespace banyan {

[[nodiscard]] const Algorithm& outwards() noexcept;
[[nodiscard]] const Algorithm& inwards() noexcept;
[[nodiscard]] const Algorithm& convoy() noexcept;
[[nodiscard]] const Algorithm& caravan_algorithm() noexcept;
[[nodiscard]] const AlgorithmList& algorithms() noexcept;

}  // namespace banyan
