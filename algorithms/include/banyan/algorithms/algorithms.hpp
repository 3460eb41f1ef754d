// SPDX-License-Identifier: MIT
// The algorithms that come with Banyan, one by one and as a list. Static lifetime.
#pragma once

#include "banyan/controller/core/algorithm.hpp"

namespace banyan {

[[nodiscard]] const Algorithm& outwards() noexcept;
[[nodiscard]] const Algorithm& inwards() noexcept;
[[nodiscard]] const Algorithm& convoy() noexcept;
// By other authors (rivals/).
[[nodiscard]] const Algorithm& link_consensus() noexcept;
[[nodiscard]] const Algorithm& mst() noexcept;
[[nodiscard]] const Algorithm& fiedler() noexcept;
[[nodiscard]] const AlgorithmList& algorithms() noexcept;

}  // namespace banyan
