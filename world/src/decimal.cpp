// SPDX-License-Identifier: MIT
#include "banyan/world/decimal.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

namespace banyan::world {
namespace without_to_chars {
namespace {

template <class Float> Float read(const char* text) noexcept {
  if constexpr (sizeof(Float) == sizeof(double)) return std::strtod(text, nullptr);
  else return std::strtof(text, nullptr);
}

// One more in the last place of "d.ddde-05". (Not of 9.99: fewer digits would have read back.)
void increment(char* text) noexcept {
  char* digit = std::strchr(text, 'e') - 1;
  for (; digit > text && *digit == '9'; digit -= digit[-1] == '.' ? 2 : 1) *digit = '0';
  if (*digit != '9') ++*digit;
}

template <class Float> char* shortest(char* at, Float value) noexcept {
  if (value == Float{0} || !std::isfinite(value))
    return at + std::snprintf(at, longest_shortest, std::isnan(value) && std::signbit(value) ? "-nan" : "%.0f",
                              std::isnan(value) ? std::fabs(static_cast<double>(value)) : static_cast<double>(value));
  // The fewest digits that read back, and of those the nearest. At a power of two what reads back reaches farther up
  // than down, so that one more may do where the nearest does not.
  std::array<char, longest_shortest> scientific;
  int places = -1;
  do {
    ++places;
    static_cast<void>(std::snprintf(scientific.data(), scientific.size(), "%.*e", places, static_cast<double>(value)));
    if (read<Float>(scientific.data()) != value) increment(scientific.data());
  } while (read<Float>(scientific.data()) != value);
  const auto exponent = static_cast<int>(std::strtol(std::strchr(scientific.data(), 'e') + 1, nullptr, 10));
  std::array<char, 2 * longest_fixed> plain;
  const int length =
      std::snprintf(plain.data(), plain.size(), "%.*f", std::max(0, places - exponent), static_cast<double>(value));
  const std::string_view shorter = static_cast<std::size_t>(length) <= std::strlen(scientific.data())
                                       ? std::string_view(plain.data())
                                       : std::string_view(scientific.data());
  std::memcpy(at, shorter.data(), shorter.size());
  return at + shorter.size();
}

}  // namespace

char* write_shortest(char* at, double value) noexcept { return shortest(at, value); }
char* write_shortest(char* at, float value) noexcept { return shortest(at, value); }
char* write_fixed(char* at, double value, int decimals) noexcept {
  return at + std::snprintf(at, longest_fixed, "%.*f", decimals, value);
}

}  // namespace without_to_chars

#ifdef __cpp_lib_to_chars
char* write_shortest(char* at, double value) noexcept { return std::to_chars(at, at + longest_shortest, value).ptr; }
char* write_shortest(char* at, float value) noexcept { return std::to_chars(at, at + longest_shortest, value).ptr; }
char* write_fixed(char* at, double value, int decimals) noexcept {
  return std::to_chars(at, at + longest_fixed, value, std::chars_format::fixed, decimals).ptr;
}
double read_decimal(const char* text) noexcept {
  double value = 0.0;
  std::from_chars(text, text + std::strlen(text), value);
  return value;
}
#else
char* write_shortest(char* at, double value) noexcept { return without_to_chars::write_shortest(at, value); }
char* write_shortest(char* at, float value) noexcept { return without_to_chars::write_shortest(at, value); }
char* write_fixed(char* at, double value, int decimals) noexcept {
  return without_to_chars::write_fixed(at, value, decimals);
}
double read_decimal(const char* text) noexcept { return std::strtod(text, nullptr); }
#endif

std::string number_text(double value) {
  if (std::abs(value) >= 1e5 && std::abs(value) < 1e16 && value == std::trunc(value))
    return std::to_string(static_cast<std::int64_t>(value));
  std::array<char, longest_shortest> buffer;
  return {buffer.data(), write_shortest(buffer.data(), value)};
}

double widened(float value) {
  std::array<char, longest_shortest + 1> text;
  *write_shortest(text.data(), value) = '\0';
  return read_decimal(text.data());
}

}  // namespace banyan::world
