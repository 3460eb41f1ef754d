// SPDX-License-Identifier: MIT
// The policies that come with Banyan, one file each. Static lifetime.
#pragma once

#include "banyan/controller/policy.hpp"

namespace banyan {

[[nodiscard]] const Policy& outwards() noexcept;
[[nodiscard]] const Policy& inwards() noexcept;
[[nodiscard]] const Policy& convoy() noexcept;

}  // namespace banyan
