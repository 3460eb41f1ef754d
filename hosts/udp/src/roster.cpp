// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/roster.hpp"

#include <algorithm>
#include <charconv>

#include "banyan/hosts/udp/option_error.hpp"

namespace banyan::udp {
namespace {

bool is_digit(char c) noexcept { return c >= '0' && c <= '9'; }
bool is_fit(char c) noexcept {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-' || c == '.';
}

// Of a text that is digits and nothing else, and not too large for an id.
std::optional<NodeId> id_in(std::string_view digits) noexcept {
  NodeId id = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), id);
  if (error != std::errc{} || end != digits.data() + digits.size() || id >= most_fleet_robots) return std::nullopt;
  return id;
}

std::string_view digits_of(std::string_view name) noexcept {
  std::size_t begin = name.size();
  while (begin > 0 && is_digit(name[begin - 1])) --begin;
  return name.substr(begin);
}

std::string padded(NodeId number, std::size_t digits) {
  const std::string text = std::to_string(number);
  return std::string(digits - std::min(digits, text.size()), '0') + text;
}

[[noreturn]] void fail(const std::string& text) { throw OptionError("--names: " + text); }

// cf{01-12}: cf01, cf02, ...
void add_names(const std::string& word, std::vector<std::string>& names) {
  const std::size_t open = word.find('{'), dash = word.find('-', open), close = word.find('}', open);
  if (open == std::string::npos) return names.push_back(word);
  const auto number = [&](std::size_t begin, std::size_t end) -> std::optional<NodeId> {
    return begin < end && end < word.size() ? id_in(std::string_view(word).substr(begin, end - begin)) : std::nullopt;
  };
  const auto first = number(open + 1, dash), last = number(dash + 1, close);
  if (!first || !last || *first > *last || close + 1 != word.size())
    fail("\"" + word + "\" must end in braces with a range of numbers, from 0 to " +
         std::to_string(most_fleet_robots - 1) + ", as cf{1-9} or robot_{01-12}");
  for (std::size_t k = *first; k <= *last; ++k)
    names.push_back(word.substr(0, open) + padded(static_cast<NodeId>(k), dash - open - 1));
}

std::vector<std::string> names_in(const std::string& text) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    add_names(text.substr(begin, end - begin), names);
    if (names.size() > most_fleet_robots) fail("a fleet has at most " + std::to_string(most_fleet_robots) + " robots");
    begin = end + 1;
  }
  for (const std::string& name : names) {
    if (name.empty()) fail("a name is empty; names are separated by single commas");
    if (const auto bad = std::find_if_not(name.begin(), name.end(), is_fit); bad != name.end())
      fail("\"" + name + "\" has '" + *bad + "'; names are made of letters, digits, '_', '-' and '.'");
  }
  return names;
}

}  // namespace

Roster::Roster(std::size_t robots, std::size_t room) : most_(std::min(robots + room, most_fleet_robots)) {
  for (std::size_t i = 0; i < robots; ++i) keep({static_cast<NodeId>(i), std::to_string(i)});
}

Roster::Roster(const std::string& names, std::size_t room) {
  const std::vector<std::string> all = names_in(names);
  const auto numbered = [](const std::string& name) { return !digits_of(name).empty(); };
  const bool have_numbers = std::any_of(all.begin(), all.end(), numbered);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string_view digits = digits_of(all[i]);
    if (have_numbers && digits.empty())
      fail("\"" + all[i] + "\" must end in a number, its id, as others do; or none may");
    const auto id = have_numbers ? id_in(digits) : std::optional(static_cast<NodeId>(i));
    if (!id)
      fail("\"" + all[i] + "\" must end in a number from 0 to " + std::to_string(most_fleet_robots - 1) + ", its id");
    if (by_name_.contains(all[i])) fail("\"" + all[i] + "\" is given twice");
    if (const auto other = with_id(*id))
      fail("\"" + name(*other) + "\" and \"" + all[i] + "\" have the same id, " + std::to_string(*id));
    keep({*id, all[i]});
  }
  most_ = std::min(robots_.size() + room, most_fleet_robots);
  prefix_ = all.front().substr(0, all.front().size() - digits_of(all.front()).size());
  for (const std::string& name : all)
    if (!have_numbers || name.substr(0, name.size() - digits_of(name).size()) != prefix_) prefix_.clear();
  if (const std::string_view digits = digits_of(all.front()); digits.size() > 1 && digits.front() == '0')
    digits_ = digits.size();
}

void Roster::keep(Entry entry) {
  by_id_.emplace(entry.id, robots_.size());
  by_name_.emplace(entry.name, robots_.size());
  robots_.push_back(std::move(entry));
}

std::optional<std::size_t> Roster::with_id(NodeId id) const {
  const auto found = by_id_.find(id);
  return found == by_id_.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::size_t> Roster::find(std::string_view name) const {
  if (const auto found = by_name_.find(name); found != by_name_.end()) return found->second;
  const auto id = id_in(name);
  return id ? with_id(*id) : std::nullopt;
}

std::optional<NodeId> Roster::id_of(std::string_view name) const {
  if (const auto robot = find(name)) return robots_[*robot].id;
  if (const auto id = id_in(name)) return id;
  if (prefix_.empty() || !name.starts_with(prefix_)) return std::nullopt;
  return id_in(name.substr(prefix_.size()));
}

std::string Roster::name_of(NodeId id) const {
  if (const auto robot = with_id(id)) return robots_[*robot].name;
  return prefix_ + padded(id, digits_);
}

std::string Roster::list_of(const std::vector<std::size_t>& robots) const {
  std::string text;
  for (const std::size_t robot : robots) text += (text.empty() ? "" : ", ") + robots_[robot].name;
  return text;
}

std::size_t Roster::add(NodeId id) {
  keep({id, name_of(id)});
  return robots_.size() - 1;
}

}  // namespace banyan::udp
