// SPDX-License-Identifier: MIT
// Numbers and strings as text (text.hpp).
#include "text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>

#include "banyan/controller/core/printable.hpp"
#include "banyan/world/decimal.hpp"

namespace banyan::record {

namespace {

constexpr std::array<std::uint64_t, 10> power{1,      10,      100,      1000,      10000,
                                              100000, 1000000, 10000000, 100000000, 1000000000};

constexpr double exact_limit = 9e15;  // below, scaled values are whole numbers of an int64

constexpr std::string_view replacement = "\xEF\xBF\xBD";

}  // namespace

void Text::grow(std::size_t n) { buffer_.resize(std::max({size_ + n, 2 * buffer_.size(), std::size_t{256}})); }

void Text::put(std::string_view text) {
  if (text.empty()) return;  // its data may be null, which memcpy() must not be given
  std::memcpy(space(text.size()), text.data(), text.size());
  size_ += text.size();
}

void Text::natural(std::uint64_t value) {
  char* at = space(20);
  advance_to(std::to_chars(at, at + 20, value).ptr);
}

void Text::integer(std::int64_t value) {
  char* at = space(20);
  advance_to(std::to_chars(at, at + 20, value).ptr);
}

void Text::fixed(double value, int decimals, std::string_view otherwise) {
  if (!std::isfinite(value)) return put(otherwise);
  const std::uint64_t unit = power[static_cast<std::size_t>(decimals)];
  const double scaled = std::fabs(value) * static_cast<double>(unit);
  if (scaled >= exact_limit) return advance_to(world::write_fixed(space(world::longest_fixed), value, decimals));
  const auto number = static_cast<std::uint64_t>(scaled + 0.5);
  char* at = space(40);
  if (value < 0.0 && number != 0) *at++ = '-';
  at = std::to_chars(at, at + 20, number / unit).ptr;
  if (decimals > 0) {
    char* point = at;
    at = std::to_chars(at, at + 20, unit + number % unit).ptr;  // zeros after a 1
    *point = '.';
  }
  advance_to(at);
}

void Text::shortest(double value) {
  if (!std::isfinite(value)) return put("null");
  advance_to(world::write_shortest(space(world::longest_shortest), value));
}

void Text::json_string(std::string_view text) {
  constexpr std::string_view hex = "0123456789abcdef";
  put('"');
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const char c = text.front();
    if (length == 0) {
      put(replacement);
    } else if (c == '"' || c == '\\') {
      put('\\');
      put(c);
    } else if (c == '\n') {
      put("\\n");
    } else if (static_cast<unsigned char>(c) < 0x20) {
      put("\\u00");
      put(hex[static_cast<unsigned char>(c) >> 4]);
      put(hex[static_cast<unsigned char>(c) & 15]);
    } else {
      put(text.substr(0, length));
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  put('"');
}

void Text::xml(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const char c = text.front();
    if (c == '&') {
      put("&amp;");
    } else if (c == '<') {
      put("&lt;");
    } else if (c == '>') {
      put("&gt;");
    } else if (c == '"') {
      put("&quot;");
    } else if (length == 0 || (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t')) {
      put(replacement);  // XML 1.0 has no way to write a control character
    } else {
      put(text.substr(0, length));
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
}

}  // namespace banyan::record
