// SPDX-License-Identifier: MIT
#include <array>

#include "banyan/controller/policies.hpp"

namespace banyan {

std::span<const Policy* const> policies() noexcept {
  static const std::array<const Policy*, 3> all{&outwards(), &inwards(), &convoy()};
  return all;
}

const Policy* find_policy(std::string_view name) noexcept {
  for (const Policy* policy : policies())
    if (policy->name() == name) return policy;
  return nullptr;
}

}  // namespace banyan
