// SPDX-License-Identifier: MIT
// The reference of keys, as rows and as Markdown.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "banyan/config/config.hpp"
#include "banyan/config/document.hpp"
#include "banyan/config/keys.hpp"
#include "banyan/controller/core/algorithm.hpp"

namespace banyan::config {
namespace {

template <class Owner> struct TypeName {
  std::string operator()(bool& (*)(Owner&)) const { return "true or false"; }
  std::string operator()(double& (*)(Owner&)) const { return "number"; }
  std::string operator()(int& (*)(Owner&)) const { return "whole number"; }
  std::string operator()(std::uint32_t& (*)(Owner&)) const { return "whole number"; }
  std::string operator()(std::size_t& (*)(Owner&)) const { return "whole number"; }
  std::string operator()(std::optional<std::size_t>& (*)(Owner&)) const { return "whole number"; }
  std::string operator()(std::optional<double>& (*)(Owner&)) const { return "number"; }
  std::string operator()(std::string& (*)(Owner&)) const { return "text"; }
  std::string operator()(world::Vec2& (*)(Owner&)) const { return "[x, y]"; }
  std::string operator()(std::vector<world::Vec2>& (*)(Owner&)) const { return "[[x, y], ...]"; }
  std::string operator()(std::vector<double>& (*)(Owner&)) const { return "list of numbers"; }
  std::string operator()(const ChoiceAccess<Owner>&) const { return "name"; }
  std::string operator()(const SeedAccess<Owner>&) const { return "whole number"; }
};

template <class Owner> KeyRow row_of(const Key<Owner>& key) {
  KeyRow row;
  row.path = (key.section.empty() ? "" : std::string(key.section) + ".") + std::string(key.name);
  row.type = std::visit(TypeName<Owner>{}, key.access);
  row.meaning = key.meaning;
  row.when = key.when;
  row.fallback = key.required ? "required" : std::string(key.fallback);
  if (const auto* choice = std::get_if<ChoiceAccess<Owner>>(&key.access)) {
    for (const auto name : choice->names()) {
      row.allowed += (row.allowed.empty() ? "" : ", ") + std::string(name);
      row.choices.emplace_back(name);
    }
  } else if (row.type == "true or false") {
    row.choices = {"true", "false"};
  } else if (row.type != "text") {
    row.allowed = range_text(key.range, key.unit);
  }
  return row;
}

// What a scenario without the key has, as it would be written in a file.
std::string default_of(const nlohmann::ordered_json& defaults, std::string_view section, std::string_view name) {
  const nlohmann::ordered_json* at = &defaults;
  while (!section.empty()) {
    const auto end = std::min(section.find('.'), section.size());
    at = &at->at(std::string(section.substr(0, end)));
    section.remove_prefix(std::min(end + 1, section.size()));
  }
  const auto found = at->find(std::string(name));
  if (found == at->end()) return "";
  return found->is_string()   ? found->get<std::string>()
         : found->is_number() ? number_text(found->get<double>())
                              : found->dump();
}

std::vector<KeyRow> parameter_rows() {
  std::vector<KeyRow> rows;
  for (const auto& info : parameter_table()) {
    if (!platform_key(info.key).empty()) continue;
    KeyRow row;
    row.path = "mission.parameters." + std::string(info.key);
    row.type = "number";
    row.allowed = number_text(widened(info.minimum)) + " to " + number_text(widened(info.maximum)) +
                  (info.unit.empty() ? "" : " " + std::string(info.unit));
    row.fallback = "see `banyan algorithms`";
    row.meaning = (info.symbol.empty() ? "" : std::string(info.symbol) + ": ") + std::string(info.meaning);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string section_of(const std::string& path) {
  const auto dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot);
}

std::string escaped(std::string text) {
  for (auto at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) text.insert(at, 1, '\\');
  return text;
}

}  // namespace

std::vector<KeyRow> key_rows() {
  Configuration standard;
  standard.scenario.name = "";
  const auto defaults = nlohmann::ordered_json::parse(config_json(standard));
  std::vector<KeyRow> rows;
  for (const auto& section : sections()) {
    if (section.path == "mission.parameters") {
      for (auto& row : parameter_rows()) rows.push_back(std::move(row));
      continue;
    }
    for (const auto& key : scenario_keys()) {
      if (key.section != section.path) continue;
      rows.push_back(row_of(key));
      if (rows.back().fallback.empty()) rows.back().fallback = default_of(defaults, key.section, key.name);
    }
    if (section.path == "obstacles")
      for (const auto& key : obstacle_keys()) rows.push_back(row_of(key));
    if (section.path == "events")
      for (const auto& key : event_keys()) rows.push_back(row_of(key));
  }
  return rows;
}

std::string key_reference_markdown() {
  std::string text =
      "# The keys of a scenario\n\n"
      "Written by `banyan keys --markdown`; a test keeps it so. A scenario is TOML, or JSON with the same tree. Every "
      "key "
      "but those of `[targets]` may be left out. Angles are in degrees, counter-clockwise from the x axis; indices "
      "count "
      "from 0. On the command line `--set section.key=value` changes any of them, and `--set events[0].time_s=3` "
      "reaches "
      "into lists.\n";
  const auto rows = key_rows();
  for (const auto& section : sections()) {
    const bool repeated = section.path == "obstacles" || section.path == "events";
    const std::string path(section.path);
    text += "\n## " +
            (path.empty() ? "At the top"
             : repeated   ? "[[" + path + "]]"
                          : "[" + path + "]") +
            "\n\n" + std::string(section.meaning) +
            "\n\n| key | value | allowed | default | meaning |\n|---|---|---|---|---|\n";
    for (const auto& row : rows) {
      if (section_of(row.path) != path) continue;
      std::string meaning = row.meaning;
      if (!row.when.empty()) meaning += " (only with " + std::string(section.selector) + " " + row.when + ")";
      text += "| `" + row.path.substr(path.empty() ? 0 : path.size() + 1) + "` | " + row.type + " | " +
              escaped(row.allowed) + " | " + escaped(row.fallback) + " | " + escaped(meaning) + " |\n";
    }
  }
  return text;
}

}  // namespace banyan::config
