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
#include <limits>
#include <string>
#include <string_view>

namespace banyan::world {
namespace without_to_chars {
namespace {

template <class Float> Float read(const char* text) noexcept {
  if constexpr (sizeof(Float) == sizeof(double)) return std::strtod(text, nullptr);
  else return std::strtof(text, nullptr);
}

// 0.d1d2d3... x 10^point
struct Digits {
  std::array<char, 24> text{};
  int size = 0;
  int point = 0;

  // What "%.*e" has written: "d.ddde-05".
  explicit Digits(const char* scientific) noexcept {
    for (; *scientific != 'e'; ++scientific)
      if (*scientific != '.') text[static_cast<std::size_t>(size++)] = *scientific;
    point = static_cast<int>(std::strtol(scientific + 1, nullptr, 10)) + 1;
  }
  void increment() noexcept {
    int k = size;
    while (k > 0 && text[static_cast<std::size_t>(k - 1)] == '9') text[static_cast<std::size_t>(--k)] = '0';
    if (k > 0) {
      ++text[static_cast<std::size_t>(k - 1)];
      return;
    }
    text[0] = '1';  // 999 became 000
    ++point;
  }
  void drop_zeros() noexcept {
    while (size > 1 && text[static_cast<std::size_t>(size - 1)] == '0') --size;
  }
  [[nodiscard]] std::string_view view() const noexcept { return {text.data(), static_cast<std::size_t>(size)}; }
  template <class Float> [[nodiscard]] Float value() const noexcept {
    std::array<char, 40> all;
    static_cast<void>(std::snprintf(all.data(), all.size(), "0.%.*se%d", size, text.data(), point));
    return read<Float>(all.data());
  }
};

// The fewest digits that read back as `value` > 0, and of those the nearest. Rounding to so many digits
// gives the nearest; but at a power of two the interval that reads back is wider above than below, so
// that the next one up may read back where the nearest does not.
template <class Float> Digits shortest_digits(Float value) noexcept {
  std::array<char, 40> text;
  for (int size = 1;; ++size) {
    static_cast<void>(std::snprintf(text.data(), text.size(), "%.*e", size - 1, static_cast<double>(value)));
    Digits digits(text.data());
    bool good = digits.value<Float>() == value;
    if (!good) {
      digits.increment();
      good = digits.value<Float>() == value;
    }
    if (!good && size < std::numeric_limits<Float>::max_digits10) continue;
    digits.drop_zeros();
    return digits;
  }
}

char* copy(char* at, std::string_view text) noexcept {
  std::memcpy(at, text.data(), text.size());
  return at + text.size();
}

char* repeat(char* at, char c, int times) noexcept {
  std::fill_n(at, times, c);
  return at + times;
}

char* write_scientific(char* at, const Digits& digits) noexcept {
  *at++ = digits.text[0];
  if (digits.size > 1) {
    *at++ = '.';
    at = copy(at, digits.view().substr(1));
  }
  const int exponent = digits.point - 1;
  return at + std::snprintf(at, 8, "e%c%02d", exponent < 0 ? '-' : '+', std::abs(exponent));
}

char* write_plain(char* at, const Digits& digits, double value) noexcept {
  // A whole number with more digits than needed to identify it is written exactly, as by printf().
  if (digits.point > digits.size) return at + std::snprintf(at, longest_shortest, "%.0f", value);
  if (digits.point <= 0) {
    at = copy(at, "0.");
    return copy(repeat(at, '0', -digits.point), digits.view());
  }
  const auto whole = static_cast<std::size_t>(digits.point);
  at = copy(at, digits.view().substr(0, whole));
  if (digits.point == digits.size) return at;
  *at++ = '.';
  return copy(at, digits.view().substr(whole));
}

template <class Float> char* shortest(char* at, Float value) noexcept {
  if (std::signbit(value)) *at++ = '-';
  value = std::fabs(value);
  if (!std::isfinite(value)) return copy(at, std::isnan(value) ? "nan" : "inf");
  if (value == Float{0}) return copy(at, "0");
  const Digits digits = shortest_digits(value);
  const int exponent = std::abs(digits.point - 1);
  const int scientific = digits.size + (digits.size > 1 ? 1 : 0) + (exponent >= 100 ? 5 : 4);
  const int plain = digits.point <= 0            ? 2 - digits.point + digits.size
                    : digits.point < digits.size ? digits.size + 1
                                                 : digits.point;
  return plain <= scientific ? write_plain(at, digits, static_cast<double>(value)) : write_scientific(at, digits);
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
