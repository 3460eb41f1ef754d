// SPDX-License-Identifier: MIT
#include "banyan/hosts/ros2/names.hpp"

#include <algorithm>

namespace banyan::ros2 {
namespace {

constexpr std::size_t longest_topic = 246;  // 255 in DDS, and the prefix
constexpr std::size_t longest_node = 255;

bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }
bool is_letter(char c) noexcept { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_word(std::string_view word) noexcept {
  return !word.empty() && is_letter(word.front()) &&
         std::all_of(word.begin(), word.end(), [](char c) { return is_letter(c) || is_digit(c); });
}

}  // namespace

std::string of_robot(std::string_view pattern, std::size_t id) {
  std::string name;
  const std::string number = std::to_string(id);
  while (!pattern.empty()) {
    const std::size_t open = std::min(pattern.find('{'), pattern.size());
    name += pattern.substr(0, open);
    pattern.remove_prefix(open);
    if (pattern.starts_with("{:0") && pattern.size() > 4 && is_digit(pattern[3]) && pattern[4] == '}') {
      const auto wanted = static_cast<std::size_t>(pattern[3] - '0');
      name += std::string(wanted - std::min(wanted, number.size()), '0') + number;
      pattern.remove_prefix(5);
    } else if (pattern.starts_with("{}")) {
      name += number;
      pattern.remove_prefix(2);
    } else if (!pattern.empty()) {
      name += pattern.front();
      pattern.remove_prefix(1);
    }
  }
  return name;
}

std::string topic_fault(std::string_view name) {
  if (!name.starts_with('/')) return "must begin with /";
  if (name.size() > longest_topic) return "is longer than " + std::to_string(longest_topic) + " characters";
  if (name.find("__") != std::string_view::npos) return "has two underscores in a row";
  while (!name.empty()) {
    name.remove_prefix(1);
    const std::size_t end = std::min(name.find('/'), name.size());
    if (!is_word(name.substr(0, end)))
      return "must consist of words of letters, digits and _, none of which begins with a digit, with / before each";
    name.remove_prefix(end);
  }
  return "";
}

std::string node_fault(std::string_view name) {
  if (name.size() > longest_node) return "is longer than " + std::to_string(longest_node) + " characters";
  return is_word(name) ? "" : "must consist of letters, digits and _, and not begin with a digit";
}

std::string dds_topic(std::string_view name) { return "rt" + std::string(name); }

}  // namespace banyan::ros2
