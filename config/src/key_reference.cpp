// SPDX-License-Identifier: MIT
// The reference of keys, as rows and as Markdown.
#include <array>

#include "banyan/config/document.hpp"
#include "banyan/config/keys.hpp"
#include "banyan/controller/core/algorithm.hpp"

namespace banyan::config {
namespace {

using world::Type;

std::string_view type_name(Type type) {
  constexpr std::array<std::string_view, 9> names = {
      "true or false",   "whole number",         "number", "name", "text", "[x, y]", "[[x, y], ...]",
      "list of numbers", "[[\"a\", \"b\"], ...]"};
  return names.at(static_cast<std::size_t>(type));
}

struct ValueText {
  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(bool truth) const { return truth ? "true" : "false"; }
  std::string operator()(std::int64_t n) const { return std::to_string(n); }
  std::string operator()(double x) const { return number_text(x); }
  std::string operator()(const std::string& text) const { return text; }
  std::string operator()(world::Vec2 p) const { return "[" + number_text(p.x) + ", " + number_text(p.y) + "]"; }
  std::string operator()(const std::pair<std::string, std::string>& pair) const {
    return "[\"" + pair.first + "\", \"" + pair.second + "\"]";
  }
  template <class Element> std::string operator()(const std::vector<Element>& list) const {
    std::string text;
    for (const Element& element : list) text += (text.empty() ? "" : ", ") + (*this)(element);
    return "[" + text + "]";
  }
};

// What holds without the key; `owner`: all defaults.
template <class Owner>
std::string fallback_of(const world::Key<Owner>& key, std::span<const world::Key<Owner>> keys,
                        const std::vector<std::string_view>& with, Owner owner) {
  if (key.terms.required) return "required";
  if (!key.terms.otherwise.empty()) return std::string(key.terms.otherwise);
  if (!key.access.applies(owner)) set(*find_key(keys, selector_of(key)), owner, std::string(with.front()));
  return std::visit(ValueText{}, get(key, owner));
}

// `owner`: all defaults, and what else the choices depend on.
template <class Owner>
KeyRow row_of(const world::Key<Owner>& key, std::span<const world::Key<Owner>> keys, const Owner& owner) {
  const auto with = applies_with(key, keys);
  KeyRow row;
  row.path = key.path;
  row.type = type_name(key.access.type);
  row.meaning = key.meaning;
  row.selector = selector_of(key);
  for (const auto name : with) row.when += (row.when.empty() ? "" : " ") + std::string(name);
  row.fallback = fallback_of(key, keys, with, owner);
  if (key.access.type == Type::name) {
    for (const auto name : key.access.names(owner)) {
      row.allowed += (row.allowed.empty() ? "" : ", ") + std::string(name);
      row.choices.emplace_back(name);
    }
  } else if (key.access.type == Type::truth) {
    row.choices = {"true", "false"};
  } else if (key.access.type != Type::text) {
    row.allowed = range_text(key.range, key.unit);
  }
  return row;
}

template <class Owner>
void add_rows(std::vector<KeyRow>& rows, std::string_view section, std::span<const world::Key<Owner>> keys,
              const Owner& owner) {
  for (const auto& key : keys)
    if (key.section() == section) rows.push_back(row_of(key, keys, owner));
}

void add_parameter_rows(std::vector<KeyRow>& rows, const AlgorithmList& algorithms) {
  for (const auto& info : algorithms.parameters()) {
    KeyRow row;
    row.path = "mission.parameters." + std::string(info.key);
    row.type = type_name(Type::number);
    row.allowed = range_text({widened(info.minimum), widened(info.maximum)}, info.unit);
    row.fallback = "see `banyan algorithms`";
    row.meaning = (info.symbol.empty() ? "" : std::string(info.symbol) + ": ") + std::string(info.meaning);
    rows.push_back(std::move(row));
  }
}

std::string section_of(const std::string& path) {
  const auto dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot);
}

std::string escaped(std::string text) {
  for (auto at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) text.insert(at, 1, '\\');
  return text;
}

std::string title_of(const world::Section& section) {
  const std::string path(section.path);
  if (path.empty()) return "At the top";
  return section.repeated ? "[[" + path + "]]" : "[" + path + "]";
}

// With its condition, the selector named as seen from the section: "layout", "start.layout".
std::string meaning_of(const KeyRow& row, const std::string& section) {
  if (row.when.empty()) return row.meaning;
  const std::string selector = row.selector.substr(section.size() + 1);
  return row.meaning + " (only with " + selector + " " + row.when + ")";
}

}  // namespace

std::vector<KeyRow> key_rows(const AlgorithmList& algorithms) {
  Configuration standard;
  standard.scenario = world::plain_scenario(algorithms);
  std::vector<KeyRow> rows;
  for (const auto& section : sections()) {
    each_part(std::as_const(standard),
              [&](const auto& keys, const auto& owner) { add_rows(rows, section.path, keys, owner); });
    world::each_list(standard.scenario, [&](auto, const auto& keys, const auto& list) {
      add_rows(rows, section.path, keys, typename std::decay_t<decltype(list)>::value_type{});
    });
    if (section.path == "mission.parameters") add_parameter_rows(rows, algorithms);
  }
  return rows;
}

std::string key_reference_markdown(const AlgorithmList& algorithms) {
  std::string text =
      "# The keys of a scenario\n\n"
      "Written by `banyan keys --markdown`; a test checks it. A scenario is TOML, or JSON with the same tree. Every "
      "key "
      "but those of `[targets]` may be left out. Angles are in degrees, counter-clockwise from the x axis; indices "
      "count "
      "from 0. On the command line `--set section.key=value` changes any of them, and `--set events[0].time_s=3` "
      "reaches "
      "into lists.\n";
  const auto rows = key_rows(algorithms);
  for (const auto& section : sections()) {
    const std::string path(section.path);
    text += "\n## " + title_of(section) + "\n\n" + std::string(section.meaning) +
            "\n\n| key | value | allowed | default | meaning |\n|---|---|---|---|---|\n";
    for (const auto& row : rows) {
      if (section_of(row.path) != path) continue;
      text += "| `" + row.path.substr(path.empty() ? 0 : path.size() + 1) + "` | " + row.type + " | " +
              escaped(row.allowed) + " | " + escaped(row.fallback) + " | " + escaped(meaning_of(row, path)) + " |\n";
    }
  }
  return text;
}

}  // namespace banyan::config
