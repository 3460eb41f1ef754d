// SPDX-License-Identifier: MIT
// "Did you mean": the known name nearest to a misspelt one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace banyan::world {

// Levenshtein distance.
[[nodiscard]] inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row[b.size()];
}

// The first of the nearest names; empty if `known` is empty or none is even half like `word`.
[[nodiscard]] inline std::string_view nearest_name(std::string_view word, std::span<const std::string_view> known) {
  const std::string_view shown = word.substr(0, 100);  // a very long word is like nothing anyway
  std::string_view best;
  std::size_t best_distance = shown.size() / 2 + 2;
  for (const std::string_view name : known) {
    const std::size_t d = edit_distance(shown, name);
    if (d < best_distance) {
      best = name;
      best_distance = d;
    }
  }
  return best;
}

// "a, b or c".
[[nodiscard]] inline std::string listed(std::span<const std::string_view> names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += names[i];
  }
  return text;
}

}  // namespace banyan::world
