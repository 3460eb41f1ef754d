// SPDX-License-Identifier: MIT
// `banyan algorithms`: what can be chosen as mission.algorithm, and every number of it.
#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>

#include "banyan/controller/params.hpp"
#include "banyan/controller/policy.hpp"
#include "commands.hpp"
#include "terminal.hpp"

namespace banyan::cli {

using namespace config;
namespace {

constexpr Reading readings[] = {Reading::corrected, Reading::literal};

std::string_view name_of(Reading reading) { return reading == Reading::literal ? "literal" : "corrected"; }

// As a person would write it: 1.3893, not 1.38929999.
std::string value_text(float value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}
double as_written(float value) { return std::stod(value_text(value)); }

std::vector<const Policy*> chosen(const std::string& name) {
  const auto all = policies();
  if (name.empty()) return {all.begin(), all.end()};
  if (const Policy* policy = find_policy(name)) return {policy};
  std::vector<std::string_view> names;
  for (const Policy* policy : all) names.push_back(policy->name());
  const auto near = nearest(name, names);
  std::string text = "there is no algorithm \"" + name + "\"";
  text += near.empty() ? "; `banyan algorithms` lists them" : "; did you mean " + std::string(near) + "?";
  throw CommandError(exit_usage, text);
}

nlohmann::ordered_json json_of(const Policy& policy) {
  nlohmann::ordered_json entry = {{"name", policy.name()}, {"summary", policy.summary()}};
  auto& list = entry["parameters"] = nlohmann::ordered_json::array();
  for (const auto& info : parameter_table()) {
    nlohmann::ordered_json row = {{"key", info.key},
                                  {"symbol", info.symbol},
                                  {"unit", info.unit},
                                  {"meaning", info.meaning},
                                  {"source", info.source},
                                  {"minimum", as_written(info.minimum)},
                                  {"maximum", as_written(info.maximum)}};
    for (const auto reading : readings)
      row["default"][std::string(name_of(reading))] = as_written(policy.defaults(reading).*info.member);
    const auto owner = platform_key(info.key);
    row["set_by"] = owner.empty() ? "mission.parameters." + std::string(info.key) : std::string(owner);
    list.push_back(std::move(row));
  }
  return entry;
}

std::string table_text(const std::vector<const Policy*>& list) {
  std::string head = format("%-26s %-8s %-4s", "parameter", "symbol", "unit");
  std::string under = format("%-26s %-8s %-4s", "", "", "");
  for (const Policy* policy : list) {
    head += format("  %-18s", std::string(policy->name()).c_str());
    under += format("  %-9s %-8s", "corrected", "literal");
  }
  std::string text = head + "  source\n" + under + "\n";
  for (const auto& info : parameter_table()) {
    text += format("%-26s %-8s %-4s", std::string(info.key).c_str(), std::string(info.symbol).c_str(),
                   std::string(info.unit).c_str());
    for (const Policy* policy : list) {
      text += format("  %-9s %-8s", value_text(policy->defaults(Reading::corrected).*info.member).c_str(),
                     value_text(policy->defaults(Reading::literal).*info.member).c_str());
    }
    text += "  " + std::string(info.source) + "\n    " + std::string(info.meaning);
    if (const auto owner = platform_key(info.key); !owner.empty()) text += " (set by " + std::string(owner) + ")";
    text += "\n";
  }
  return text;
}

}  // namespace

int algorithms_command(const AlgorithmsOptions& options) {
  const auto list = chosen(options.name);
  if (options.json) {
    auto entries = nlohmann::ordered_json::array();
    for (const Policy* policy : list) entries.push_back(json_of(*policy));
    print(entries.dump(2) + "\n");
    return exit_done;
  }
  std::string text = "Choose one with mission.algorithm = \"...\" in a scenario, or --set mission.algorithm=...\n\n";
  for (const Policy* policy : list)
    text += format("  %-10s ", std::string(policy->name()).c_str()) + std::string(policy->summary()) + "\n";
  text +=
      "\nTwo readings of the paper, by mission.reading: corrected (default) closes its gaps, literal is as printed.\n"
      "Change a parameter by mission.parameters.<parameter>. Defaults:\n\n";
  print(text + table_text(list));
  return exit_done;
}

}  // namespace banyan::cli
