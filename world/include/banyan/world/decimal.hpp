// SPDX-License-Identifier: MIT
// The shortest decimal text of a number, the same everywhere: std::to_chars where the library has
// it for floating point, elsewhere (libc++ 14, for the browser) the same by other means.
#pragma once

#include <cstddef>
#include <string>

namespace banyan::world {

inline constexpr std::size_t longest_shortest = 32;  // bytes that write_shortest() may need
inline constexpr std::size_t longest_fixed = 340;    // and write_fixed(), with at most 20 decimals

// The fewest characters that read back as `value`, as std::to_chars(at, …, value) writes them: fixed or
// with an exponent, whichever is shorter; "inf", "-nan". Adds no '\0'. Returns the end.
char* write_shortest(char* at, double value) noexcept;
char* write_shortest(char* at, float value) noexcept;
// Exactly `decimals` digits after the point (0 to 20), rounded to nearest, even at ties; finite values.
char* write_fixed(char* at, double value, int decimals) noexcept;
// The number that `text` begins with. Correctly rounded. `text` must end in '\0'.
[[nodiscard]] double read_decimal(const char* text) noexcept;

// For messages: the shortest decimal text of a number; "1" rather than "1.0", "10000000" for 1e7.
[[nodiscard]] std::string number_text(double value);
// 1.9F as the double 1.9.
[[nodiscard]] double widened(float value);

// The replacement where std::to_chars is missing; here so that tests can compare the two.
namespace without_to_chars {
char* write_shortest(char* at, double value) noexcept;
char* write_shortest(char* at, float value) noexcept;
char* write_fixed(char* at, double value, int decimals) noexcept;
}  // namespace without_to_chars

}  // namespace banyan::world
