// SPDX-License-Identifier: MIT
// Labels as parts of file names.
#pragma once

#include <string>
#include <string_view>

namespace banyan::study {

// At most 60 characters; characters that some file system or shell does not accept become '-'.
[[nodiscard]] inline std::string file_text(std::string_view label) {
  std::string text;
  for (const char c : label) {
    const bool good = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                      c == '_' || c == '.' || c == ',' || c == '+';
    text += good ? c : '-';
  }
  return text.substr(0, 60);
}

}  // namespace banyan::study
