// SPDX-License-Identifier: MIT
// Names in messages: which are allowed, and "did you mean", the known one nearest to a misspelt one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/controller/core/printable.hpp"

namespace banyan::world {

// Names that users give, which may become parts of paths.
inline constexpr std::string_view name_rule = "1 to 100 letters, digits, '-', '_' and '.', no '.' at the start";
[[nodiscard]] inline bool good_name(std::string_view name) {
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
           c == '.';
  };
  return !name.empty() && name.size() <= 100 && name.front() != '.' && std::all_of(name.begin(), name.end(), good);
}

// Optimal string alignment distance: letters added, left out or replaced, or two neighbours exchanged.
[[nodiscard]] inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

// The first of the nearest names; nothing if none is near enough.
[[nodiscard]] inline std::string_view nearest_name(std::string_view word, std::span<const std::string_view> known) {
  word = word.substr(0, 100);  // a very long word is near none anyway
  std::string_view best;
  std::size_t best_distance = std::max<std::size_t>(1, (word.size() + 1) / 3) + 1;
  for (const std::string_view name : known) {
    // A unit left out ("range" for "range_m") or a word cut short is a near miss, however long.
    const bool shortened = word.size() >= 3 && name.starts_with(word);
    const std::size_t d = shortened ? 1 : edit_distance(word, name);
    if (d < best_distance) {
      best = name;
      best_distance = d;
    }
  }
  return best;
}

// "\"a\", \"b\" or \"c\"".
[[nodiscard]] inline std::string alternatives(std::span<const std::string_view> names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += "\"" + std::string(names[i]) + "\"";
  }
  return text;
}

// A user's text in a message: the text "fast", cut short if it is long, between two characters.
[[nodiscard]] inline std::string the_text(std::string_view text) {
  constexpr std::size_t most = 40, kept = 37;
  if (text.size() <= most) return "the text \"" + printable(text) + "\"";
  std::size_t end = 0;
  for (std::size_t next = 0; next <= kept; next += std::max<std::size_t>(1, utf8_length(text.substr(next)))) end = next;
  return "the text \"" + printable(text.substr(0, end)) + "...\"";
}

}  // namespace banyan::world
