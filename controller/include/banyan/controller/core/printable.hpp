// SPDX-License-Identifier: MIT
// Text from outside – a file's name, a key, a value, a link – made fit for a message. A terminal obeys control
// characters: a scenario must not rename its window, clear the screen or forge a line of what the program says.
// For people's eyes only: JSON, CSV and TOML have escapes of their own.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace banyan {

// Length of the valid UTF-8 sequence at the beginning of `text`, 0 if there is none (RFC 3629).
[[nodiscard]] inline std::size_t utf8_length(std::string_view text) noexcept {
  const auto at = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
  const auto follows = [&](std::size_t k) { return (at(k) & 0xC0U) == 0x80U; };
  const unsigned c = at(0);
  if (c < 0x80U) return text.empty() ? 0 : 1;
  if (c >= 0xC2U && c <= 0xDFU) return follows(1) ? 2 : 0;
  if (c >= 0xE0U && c <= 0xEFU) {
    if (!follows(1) || !follows(2)) return 0;
    if ((c == 0xE0U && at(1) < 0xA0U) || (c == 0xEDU && at(1) > 0x9FU)) return 0;  // overlong, surrogate
    return 3;
  }
  if (c >= 0xF0U && c <= 0xF4U) {
    if (!follows(1) || !follows(2) || !follows(3)) return 0;
    if ((c == 0xF0U && at(1) < 0x90U) || (c == 0xF4U && at(1) > 0x8FU)) return 0;
    return 4;
  }
  return 0;
}

[[nodiscard]] inline bool valid_utf8(std::string_view text) noexcept {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

namespace printing {

inline std::string hexadecimal(unsigned value, int digits) {
  std::string text;
  for (int k = digits - 1; k >= 0; --k) text += "0123456789abcdef"[value >> 4U * static_cast<unsigned>(k) & 0xFU];
  return text;
}

// The escape of the character that `text` begins with, a valid sequence; nothing if it may be shown as it is.
inline std::string escape(std::string_view text) {
  const auto at = [&](std::size_t k) { return static_cast<unsigned>(static_cast<unsigned char>(text[k])); };
  if (text.size() == 1) {
    const unsigned c = at(0);
    if (c == '\n') return "\\n";
    if (c == '\r') return "\\r";
    if (c == '\t') return "\\t";
    return c < 0x20U || c == 0x7FU ? "\\x" + hexadecimal(c, 2) : "";
  }
  if (text.size() == 2 && at(0) == 0xC2U && at(1) < 0xA0U) return "\\u" + hexadecimal(at(1), 4);  // C1
  if (text.size() != 3 || at(0) != 0xE2U) return "";
  // Ends of lines, and what writes from right to left: either shows a text as what it is not.
  const unsigned c = 0x2000U | (at(1) & 0x3FU) << 6U | (at(2) & 0x3FU);
  const bool misleads = (c >= 0x2028U && c <= 0x202EU) || (c >= 0x2066U && c <= 0x2069U);
  return misleads ? "\\u" + hexadecimal(c, 4) : "";
}

}  // namespace printing

// On one line and without control characters or broken UTF-8: "\x1b[2J", "\n", "\u009b", "\xff". Text that has none of
// these stays as it is, so doing it twice does no harm.
[[nodiscard]] inline std::string printable(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const std::string escape = length == 0 ? "\\x" + printing::hexadecimal(static_cast<unsigned char>(text[0]), 2)
                                           : printing::escape(text.substr(0, length));
    if (escape.empty()) result += text.substr(0, length);
    else result += escape;
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return result;
}

// The same for a text of several lines, which stay lines.
[[nodiscard]] inline std::string printable_lines(std::string_view text) {
  std::string result;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    result += printable(text.substr(0, end)) + "\n";
    text.remove_prefix(end + 1);
  }
  return result + printable(text);
}

}  // namespace banyan
