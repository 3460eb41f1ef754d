// SPDX-License-Identifier: MIT
#include "banyan/config/override.hpp"

#include <charconv>
#include <optional>

#include "banyan/controller/core/printable.hpp"

namespace banyan::config {
namespace {

// A step of "events[0].time_s": a name, or an index into a list.
struct PathStep {
  std::string name;
  std::optional<std::size_t> index;
};

std::optional<std::vector<PathStep>> split_path(std::string_view path) {
  std::vector<PathStep> steps;
  while (true) {
    const auto end = path.find_first_of(".[");
    if (end == 0 || path.empty()) return std::nullopt;
    steps.push_back({std::string(path.substr(0, end)), {}});
    if (end == std::string_view::npos) return steps;
    path.remove_prefix(end);
    while (path.starts_with('[')) {
      std::size_t index = 0;
      const auto [stop, error] = std::from_chars(path.data() + 1, path.data() + path.size(), index);
      if (error != std::errc{} || stop == path.data() + path.size() || *stop != ']') return std::nullopt;
      steps.push_back({"", index});
      path.remove_prefix(static_cast<std::size_t>(stop - path.data()) + 1);
    }
    if (path.empty()) return steps;
    if (path.front() != '.') return std::nullopt;
    path.remove_prefix(1);
  }
}

}  // namespace

std::vector<Problem> assign(Node& root, std::string_view key, Node value) {
  const auto place = value.place;
  const auto steps = split_path(key);
  if (!steps || steps->size() > deepest_nesting) {
    return {{place, "", "\"" + std::string(key) + "\" is no key; keys look like radio.loss or events[0].time_s"}};
  }
  Node* at = &root;
  for (const auto& step : *steps) {
    if (step.index) {
      auto* items = at->array();
      if (!items) return {{place, std::string(key), "has an index, but there is no list to reach into"}};
      if (*step.index >= items->size()) {
        return {
            {place, std::string(key),
             "the list has " + std::to_string(items->size()) + " entries, counted from 0; this one does not exist"}};
      }
      at = &(*items)[*step.index];
      continue;
    }
    // A section that is missing, or a value in the way: the reader judges the result.
    if (!at->table()) *at = {Node::Table{}, place};
    Node* next = at->find(step.name);
    if (!next) {
      at->table()->push_back({step.name, Node{Node::Table{}, place}});
      next = &at->table()->back().value;
    }
    at = next;
  }
  *at = std::move(value);
  return {};
}

Node as_option(Node node) {
  node.place = {std::make_shared<const std::string>(node.place.text()), 0};
  if (auto* members = node.table()) {
    for (auto& member : *members) member.value = as_option(std::move(member.value));
  }
  if (auto* items = node.array()) {
    for (auto& item : *items) item = as_option(std::move(item));
  }
  return node;
}

void overlay(Node& root, Node changes) {
  if (!root.table() || !changes.table()) {
    root = std::move(changes);
    return;
  }
  for (auto& [name, value] : *changes.table()) {
    if (Node* there = root.find(name)) overlay(*there, std::move(value));
    else root.table()->push_back({std::move(name), std::move(value)});
  }
}

std::vector<Problem> apply(Node& root, const Override& change) {
  if (!change.file.empty()) {
    overlay(root, as_option(parse_document(change.file, read_text_file(change.file))));
    return {};
  }
  const std::string_view assignment = change.assignment;
  const Place place{std::make_shared<const std::string>(change.origin), 0};
  const auto equals = assignment.find('=');
  if (equals == std::string_view::npos) { return {{place, "", "expects key=value, such as radio.loss=0.3"}}; }
  if (!valid_utf8(assignment)) return {{place, "", "is not valid UTF-8 text"}};
  auto trim = [](std::string_view s) {
    while (s.starts_with(' ')) s.remove_prefix(1);
    while (s.ends_with(' ')) s.remove_suffix(1);
    return s;
  };
  const auto key = trim(assignment.substr(0, equals));
  return assign(root, key, parse_value(trim(assignment.substr(equals + 1)), place.origin));
}

}  // namespace banyan::config
