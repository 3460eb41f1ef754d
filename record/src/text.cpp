// SPDX-License-Identifier: MIT
// Numbers and strings as text (text.hpp).
#include "text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "banyan/controller/core/printable.hpp"
#include "banyan/world/decimal.hpp"

namespace banyan::record {

namespace {

constexpr std::array<char, 200> digit_pairs = [] {
  std::array<char, 200> pairs{};
  for (std::size_t k = 0; k < 100; ++k) {
    pairs[2 * k] = static_cast<char>('0' + k / 10);
    pairs[2 * k + 1] = static_cast<char>('0' + k % 10);
  }
  return pairs;
}();

constexpr std::array<std::uint64_t, 10> power{1,      10,      100,      1000,      10000,
                                              100000, 1000000, 10000000, 100000000, 1000000000};

constexpr double exact_limit = 9e15;  // below, scaled values are whole numbers of an int64

constexpr std::string_view replacement = "\xEF\xBF\xBD";

}  // namespace

char* write_natural(char* at, std::uint64_t value) noexcept {
  if (value < 10) {
    *at = static_cast<char>('0' + value);
    return at + 1;
  }
  std::array<char, 20> digits;
  std::size_t begin = digits.size();
  while (value >= 100) {
    begin -= 2;
    std::memcpy(&digits[begin], &digit_pairs[2 * (value % 100)], 2);
    value /= 100;
  }
  if (value >= 10) {
    begin -= 2;
    std::memcpy(&digits[begin], &digit_pairs[2 * value], 2);
  } else {
    digits[--begin] = static_cast<char>('0' + value);
  }
  const std::size_t length = digits.size() - begin;
  std::memcpy(at, &digits[begin], length);
  return at + length;
}

void Text::grow(std::size_t n) { buffer_.resize(std::max({size_ + n, 2 * buffer_.size(), std::size_t{256}})); }

void Text::put(std::string_view text) {
  if (text.empty()) return;  // its data may be null, which memcpy() must not be given
  std::memcpy(space(text.size()), text.data(), text.size());
  size_ += text.size();
}

void Text::natural(std::uint64_t value) { advance_to(write_natural(space(20), value)); }

void Text::integer(std::int64_t value) {
  char* at = space(21);
  if (value < 0) *at++ = '-';
  const auto bits = static_cast<std::uint64_t>(value);
  advance_to(write_natural(at, value < 0 ? std::uint64_t{0} - bits : bits));
}

template <int decimals> void Text::fixed_of(double value) {
  constexpr std::uint64_t unit = power[decimals];
  const auto number = static_cast<std::uint64_t>(std::fabs(value) * static_cast<double>(unit) + 0.5);
  char* at = space(40);
  if (value < 0.0 && number != 0) *at++ = '-';
  at = write_natural(at, number / unit);
  std::uint64_t rest = number % unit;
  *at = '.';
  for (int k = decimals - 1; k > 0; k -= 2) {
    std::memcpy(at + k, &digit_pairs[2 * (rest % 100)], 2);
    rest /= 100;
  }
  advance_to(at + decimals + 1);
}

void Text::fixed(double value, int decimals, std::string_view otherwise) {
  if (!std::isfinite(value)) return put(otherwise);
  // Frames consist of numbers with four and two decimals; known divisors become multiplications.
  if (decimals == 4 && std::fabs(value) < exact_limit / 1e4) return fixed_of<4>(value);
  if (decimals == 2 && std::fabs(value) < exact_limit / 1e2) return fixed_of<2>(value);
  const std::uint64_t unit = power[static_cast<std::size_t>(decimals)];
  const double scaled = std::fabs(value) * static_cast<double>(unit);
  if (scaled >= exact_limit) { return advance_to(world::write_fixed(space(world::longest_fixed), value, decimals)); }
  const auto number = static_cast<std::uint64_t>(scaled + 0.5);
  char* at = space(40);
  if (value < 0.0 && number != 0) *at++ = '-';
  at = write_natural(at, number / unit);
  if (decimals > 0) {
    std::uint64_t rest = number % unit;
    *at = '.';
    for (int k = decimals; k > 0; --k) {
      at[k] = static_cast<char>('0' + rest % 10);
      rest /= 10;
    }
    at += decimals + 1;
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
