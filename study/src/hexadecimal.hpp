// SPDX-License-Identifier: MIT
// Digests of texts, as they appear in files.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "banyan/controller/core/digest.hpp"

namespace banyan::study {

[[nodiscard]] inline std::uint64_t digest_of(std::string_view text) noexcept {
  Digest digest;
  for (const char c : text) digest.add(static_cast<unsigned char>(c));
  return digest.value();
}

// 16 digits.
[[nodiscard]] inline std::string hexadecimal(std::uint64_t value) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text(16, '0');
  for (std::size_t k = 0; k < 16; ++k) text[15 - k] = digits[(value >> (4 * k)) & 15U];
  return text;
}

}  // namespace banyan::study
