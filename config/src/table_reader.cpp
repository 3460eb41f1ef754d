// SPDX-License-Identifier: MIT
#include "banyan/config/table_reader.hpp"

#include <algorithm>
#include <charconv>
#include <set>

namespace banyan::config {
namespace {

constexpr double most_seeds = 1e7;

// Whole numbers only, so that "1.5-3" or " 1-3" is not a range.
std::optional<std::uint64_t> whole_number(std::string_view text) {
  std::uint64_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop != text.data() + text.size() || text.empty()) return std::nullopt;
  if (value > (std::uint64_t{1} << 53U)) return std::nullopt;
  return value;
}

std::string known_text(const std::vector<std::string>& known) {
  std::string text;
  for (const auto& name : known) text += (text.empty() ? "" : ", ") + name;
  return text;
}

}  // namespace

std::optional<std::vector<std::uint64_t>> seed_range(std::string_view text) {
  const auto dash = std::min(text.find('-'), text.size());
  const auto first = whole_number(text.substr(0, dash));
  const auto last = dash == text.size() ? first : whole_number(text.substr(dash + 1));
  if (!first || !last || *last < *first || static_cast<double>(*last - *first) >= most_seeds) return std::nullopt;
  std::vector<std::uint64_t> seeds(*last - *first + 1);
  for (std::size_t i = 0; i < seeds.size(); ++i) seeds[i] = *first + i;
  return seeds;
}

TableReader::TableReader(const Node& table, std::string path, std::vector<Problem>& problems)
    : table_(table), path_(std::move(path)), problems_(problems) {}

std::string TableReader::path(std::string_view name) const {
  if (name.empty()) return path_;
  return path_.empty() ? std::string(name) : path_ + "." + std::string(name);
}

Place TableReader::place(std::string_view name) const {
  const Node* node = table_.find(name);
  return node ? node->place : table_.place;
}

void TableReader::report(std::string_view name, std::string text) {
  problems_.push_back({place(name), path(name), std::move(text)});
}

const Node* TableReader::find(std::string_view name) {
  if (std::find(known_.begin(), known_.end(), name) == known_.end()) known_.emplace_back(name);
  return table_.find(name);
}

const Node* TableReader::any(std::string_view name) { return find(name); }

std::string TableReader::text(std::string_view name, std::string fallback) {
  const Node* node = find(name);
  if (!node) return fallback;
  if (node->string()) return *node->string();
  report(name, "must be a text, not " + node->describe());
  return fallback;
}

bool TableReader::boolean(std::string_view name, bool fallback) {
  const Node* node = find(name);
  if (!node) return fallback;
  if (const auto* value = std::get_if<bool>(&node->value)) return *value;
  report(name, "must be true or false, not " + node->describe());
  return fallback;
}

std::optional<double> TableReader::number(std::string_view name, const Range& range) {
  const Node* node = find(name);
  if (!node) return std::nullopt;
  double value = 0.0;
  if (const auto* real = std::get_if<double>(&node->value)) value = *real;
  else if (const auto* integer = std::get_if<std::int64_t>(&node->value)) value = static_cast<double>(*integer);
  else {
    report(name, "must be a number (" + range_text(range, "") + "), not " + node->describe());
    return std::nullopt;
  }
  if (auto fault = world::range_fault(value, range, "")) {
    report(name, std::move(*fault));
    return std::nullopt;
  }
  return value;
}

double TableReader::number(std::string_view name, double fallback, const Range& range) {
  return number(name, range).value_or(fallback);
}

std::int64_t TableReader::whole(std::string_view name, std::int64_t fallback, const Range& range) {
  const Node* node = find(name);
  if (!node) return fallback;
  const auto* whole = std::get_if<std::int64_t>(&node->value);
  if (!whole) {
    report(name, "must be a whole number (" + range_text(range, "") + "), not " + node->describe());
    return fallback;
  }
  if (auto fault = world::whole_range_fault(*whole, range, "")) {
    report(name, std::move(*fault));
    return fallback;
  }
  return *whole;
}

std::size_t TableReader::choice(std::string_view name, const std::vector<std::string_view>& names,
                                std::size_t fallback) {
  const Node* node = find(name);
  if (!node) return fallback;
  const std::string* word = node->string();
  const auto at = word ? std::find(names.begin(), names.end(), *word) : names.end();
  if (at != names.end()) return static_cast<std::size_t>(at - names.begin());
  std::string allowed;
  for (const auto candidate : names) allowed += (allowed.empty() ? "\"" : ", \"") + std::string(candidate) + "\"";
  const auto near = word ? nearest(*word, names) : std::string_view();
  report(name, "is " + node->describe() + "; allowed: " + allowed +
                   (near.empty() ? "" : "; did you mean \"" + std::string(near) + "\"?"));
  return fallback;
}

std::vector<std::string> TableReader::texts(std::string_view name) {
  const Node* node = find(name);
  if (!node) return {};
  if (node->string()) return {*node->string()};
  std::vector<std::string> list;
  if (const auto* items = node->array()) {
    for (const auto& item : *items) {
      if (item.string()) list.push_back(*item.string());
    }
    if (list.size() == items->size() && !list.empty()) return list;
  }
  report(name, "must be a text or a list of texts, not empty; it is " + node->describe());
  return {};
}

std::vector<std::uint64_t> TableReader::seeds(std::string_view name) {
  const Node* node = find(name);
  if (!node) return {};
  const std::string allowed = "allowed: \"1-50\", or a list of whole numbers from 0 to 2^53";
  if (node->string()) {
    if (auto range = seed_range(*node->string())) return std::move(*range);
    report(name, "is " + node->describe() + "; " + allowed + " (first to last, first not above last)");
    return {};
  }
  const auto* items = node->array();
  if (!items || items->empty()) {
    report(name, "is " + std::string(items ? "an empty list" : node->describe()) + "; " + allowed);
    return {};
  }
  std::vector<std::uint64_t> list;
  std::set<std::int64_t> seen;
  for (const auto& item : *items) {
    const auto* number = std::get_if<std::int64_t>(&item.value);
    if (!number || *number < 0 || *number > (std::int64_t{1} << 53)) {
      report(name, "holds " + item.describe() + "; " + allowed);
      return {};
    }
    if (!seen.insert(*number).second) {
      report(name, "holds the seed " + std::to_string(*number) + " twice");
      return {};
    }
    list.push_back(static_cast<std::uint64_t>(*number));
  }
  return list;
}

const Node* TableReader::table(std::string_view name) {
  const Node* node = find(name);
  if (node && !node->table()) {
    report(name, "is a section, [" + path(name) + "], not " + node->describe());
    return nullptr;
  }
  return node;
}

std::vector<const Node*> TableReader::tables(std::string_view name) {
  const Node* node = find(name);
  if (!node) return {};
  const auto* items = node->array();
  std::vector<const Node*> list;
  for (std::size_t i = 0; items && i < items->size(); ++i) {
    if ((*items)[i].table()) list.push_back(&(*items)[i]);
  }
  if (!items || list.size() != items->size()) {
    report(name, "is a list of tables, [[" + path(name) + "]] once for each, not " + node->describe());
    return {};
  }
  return list;
}

const Node* TableReader::list(std::string_view name) {
  const Node* node = find(name);
  if (!node) return nullptr;
  if (node->array() && !node->array()->empty()) return node;
  report(name, node->array() ? "is an empty list: give at least one value"
                             : "must be a list, [...], not " + node->describe());
  return nullptr;
}

void TableReader::require(std::string_view name, std::string_view why) {
  if (!find(name)) report(name, "is missing" + (why.empty() ? std::string() : ": " + std::string(why)));
}

void TableReader::finish() {
  const std::vector<std::string_view> known(known_.begin(), known_.end());
  for (const auto& [name, value] : *table_.table()) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const auto near = nearest(name, known);
    problems_.push_back({value.place, path(name),
                         "there is no such key" +
                             (near.empty() ? std::string() : "; did you mean " + path(near) + "?") + " (" +
                             (path_.empty() ? "at the top" : "[" + path_ + "] has") + ": " + known_text(known_) + ")"});
  }
}

}  // namespace banyan::config
