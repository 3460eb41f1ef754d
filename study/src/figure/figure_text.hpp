// SPDX-License-Identifier: MIT
// Text in figures: made safe for gnuplot and XML, measured and broken into lines, so that labels
// are placed by their size and never run into each other.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace banyan::study {

// `text` as valid UTF-8 without control characters other than "\n": a tab or carriage return
// becomes a space, anything else that XML forbids U+FFFD.
[[nodiscard]] std::string clean(std::string_view text);

// The width of one line in DejaVu Sans of a size, in the unit of that size; at most a little too
// large. Characters beyond ASCII count as the widest of the Latin, Greek and CJK ones.
[[nodiscard]] double text_width(std::string_view line, double size) noexcept;

// `line` if it is at most that wide, else its beginning with an ellipsis.
[[nodiscard]] std::string shortened(std::string_view line, double width, double size);

// Breaks at "\n" and, where a line would be wider than `width`, at spaces. A single word may be
// wider. No lines for an empty text. `text` is clean.
[[nodiscard]] std::vector<std::string> wrapped(std::string_view text, double width, double size);

// clean() and wrapped(), and shortened() where a word is wider still: fits in any case.
[[nodiscard]] std::vector<std::string> fitted(std::string_view text, double width, double size);

// As a gnuplot string: in double quotes, with what gnuplot would act on there (quotes, backslashes,
// commands in backquotes, macros) and control characters as octal numbers. Single quotes would not
// do: gnuplot 5.4 takes '''x' for an empty string with commands behind it.
[[nodiscard]] std::string in_quotes(std::string_view text);

// The fewest digits that read back as `value`; "NaN" if it is not finite.
[[nodiscard]] std::string number(double value);

// With `decimals` digits behind the point, "0.5000" as "0.5000"; finite.
[[nodiscard]] std::string fixed(double value, int decimals);

}  // namespace banyan::study
