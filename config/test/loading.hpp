// SPDX-License-Identifier: MIT
// Small scenarios as text, for tests.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/config/config.hpp"

namespace banyan::config {

inline std::string all_problems(const Loaded& loaded) {
  std::string text;
  for (const auto& p : loaded.problems) text += to_string(p) + "\n";
  return text;
}

inline Loaded parse(const std::string& text, const std::vector<std::string>& sets = {}) {
  std::vector<Override> overrides;
  overrides.reserve(sets.size());
  for (const auto& s : sets) overrides.push_back({s, "--set " + s});
  return parse_configuration("w.toml", text, algorithms(), overrides);
}

inline ::testing::AssertionResult says(const Loaded& loaded, const std::string& part) {
  const auto text = all_problems(loaded);
  if (text.find(part) != std::string::npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "\"" << part << "\" is not in:\n" << text;
}

inline const std::string small = "[targets]\ncount = 2\nradius_m = 2.0\n";  // lines 1 to 3

}  // namespace banyan::config
