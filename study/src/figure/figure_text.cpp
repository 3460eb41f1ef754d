// SPDX-License-Identifier: MIT
// Text in figures (figure_text.hpp).
#include "figure_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace banyan::study {

namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD
constexpr std::string_view ellipsis = "\xE2\x80\xA6";     // U+2026
constexpr double widest_em = 1.1;

// Advance widths of DejaVu Sans from the space to "~", in hundredths of the font size, rounded up.
constexpr std::array<std::uint8_t, 95> ascii_widths{
    32, 41, 46, 84, 64, 96, 78, 28, 40,  40, 50, 84, 32, 37, 32, 34, 64, 64, 64, 64, 64, 64, 64, 64,
    64, 64, 34, 34, 84, 84, 84, 54, 100, 69, 69, 70, 78, 64, 58, 78, 76, 30, 30, 66, 56, 87, 75, 79,
    61, 79, 70, 64, 62, 74, 69, 99, 69,  62, 69, 40, 34, 40, 84, 50, 50, 62, 64, 55, 64, 62, 36, 64,
    64, 28, 28, 58, 28, 98, 64, 62, 64,  64, 42, 53, 40, 64, 60, 82, 60, 60, 53, 64, 34, 64, 84};

std::uint8_t byte(std::string_view text, std::size_t i) noexcept {
  return i < text.size() ? static_cast<std::uint8_t>(text[i]) : std::uint8_t{0};
}

bool continues(std::uint8_t b) noexcept { return (b & 0xC0U) == 0x80U; }

// The length of the valid multi-byte sequence at `i`, 0 if there is none: no overlong forms, no
// surrogates, nothing beyond U+10FFFF, not U+FFFE or U+FFFF (Unicode 15, table 3-7; XML 1.0, 2.2).
std::size_t sequence_length(std::string_view text, std::size_t i) noexcept {
  const std::uint8_t a = byte(text, i), b = byte(text, i + 1), c = byte(text, i + 2), d = byte(text, i + 3);
  if (!continues(b)) return 0;
  if (a >= 0xC2U && a <= 0xDFU) return (a == 0xC2U && b < 0xA0U) ? 0 : 2;  // C1 controls
  if (!continues(c)) return 0;
  if (a >= 0xE0U && a <= 0xEFU) {
    const bool overlong = a == 0xE0U && b < 0xA0U;
    const bool surrogate = a == 0xEDU && b > 0x9FU;
    const bool noncharacter = a == 0xEFU && b == 0xBFU && c >= 0xBEU;
    return overlong || surrogate || noncharacter ? 0 : 3;
  }
  if (!continues(d) || a < 0xF0U || a > 0xF4U) return 0;
  return (a == 0xF0U && b < 0x90U) || (a == 0xF4U && b > 0x8FU) ? 0 : 4;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t at = text.find(separator);
    parts.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

}  // namespace

std::string clean(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const std::uint8_t b = byte(text, i);
    std::size_t length = 1;
    if (b == '\t' || b == '\r') {
      result += ' ';
    } else if (b == '\n' || (b >= 0x20U && b < 0x7FU)) {
      result += text[i];
    } else if (const std::size_t n = b < 0x80U ? 0 : sequence_length(text, i); n > 0) {
      result += text.substr(i, n);
      length = n;
    } else {
      result += replacement;
    }
    i += length;
  }
  return result;
}

double text_width(std::string_view line, double size) noexcept {
  double em = 0.0;
  for (const char c : line) {
    const auto b = static_cast<std::uint8_t>(c);
    if (b >= 0x20U && b < 0x7FU) {
      em += ascii_widths[b - 0x20U] / 100.0;
    } else if (!continues(b)) {
      em += widest_em;
    }
  }
  return em * size;
}

std::string shortened(std::string_view line, double width, double size) {
  if (text_width(line, size) <= width) return std::string(line);
  const double room = width - text_width(ellipsis, size);
  while (!line.empty() && text_width(line, size) > room) {
    while (continues(byte(line, line.size() - 1)) && line.size() > 1) line.remove_suffix(1);
    line.remove_suffix(1);
  }
  return std::string(line) + std::string(ellipsis);
}

std::vector<std::string> wrapped(std::string_view text, double width, double size) {
  std::vector<std::string> lines;
  if (text.empty()) return lines;
  for (const std::string_view paragraph : split(text, '\n')) {
    std::string line;
    for (const std::string_view word : split(paragraph, ' ')) {
      const std::string longer = line.empty() ? std::string(word) : line + ' ' + std::string(word);
      if (line.empty() || text_width(longer, size) <= width) {
        line = longer;
      } else {
        lines.push_back(line);
        line = word;
      }
    }
    lines.push_back(line);
  }
  return lines;
}

std::vector<std::string> fitted(std::string_view text, double width, double size) {
  std::vector<std::string> lines = wrapped(clean(text), width, size);
  for (std::string& line : lines) line = shortened(line, width, size);
  return lines;
}

std::string in_quotes(std::string_view text) {
  std::string result = "\"";
  bool after_number = false;  // which would swallow a digit: gnuplot reads more than three
  for (const char c : text) {
    const auto b = static_cast<std::uint8_t>(c);
    const bool digit = c >= '0' && c <= '9';
    after_number = after_number && digit;
    if (!after_number && b >= 0x20U && b != 0x7FU && std::string_view("\"\\`@").find(c) == std::string_view::npos) {
      result += c;
    } else {
      after_number = true;
      for (const unsigned shift : {6U, 3U, 0U}) result += static_cast<char>('0' + ((b >> shift) & 7U));
      result.insert(result.size() - 3, 1, '\\');
    }
  }
  return result + "\"";
}

std::string number(double value) {
  if (!std::isfinite(value)) return "NaN";
  std::array<char, 40> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

std::string fixed(double value, int decimals) {
  std::array<char, 360> buffer{};  // 1e308 has 309 digits
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, decimals).ptr;
  return {buffer.data(), end};
}

}  // namespace banyan::study
