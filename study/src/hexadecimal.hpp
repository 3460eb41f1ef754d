// SPDX-License-Identifier: MIT
// Digests of texts, as they appear in files.
#pragma once

#include <cstdint>
#include <string_view>

#include "banyan/controller/core/digest.hpp"
#include "banyan/measure/hexadecimal.hpp"

namespace banyan::study {

[[nodiscard]] inline std::uint64_t digest_of(std::string_view text) noexcept {
  Digest digest;
  for (const char c : text) digest.add(static_cast<unsigned char>(c));
  return digest.value();
}

using measure::hexadecimal;

}  // namespace banyan::study
