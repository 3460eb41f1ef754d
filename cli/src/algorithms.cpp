// SPDX-License-Identifier: MIT
// `banyan algorithms`: the choices for mission.algorithm, with all their parameters.
#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>

#include "banyan/algorithms/algorithms.hpp"
#include "commands.hpp"
#include "options.hpp"
#include "terminal.hpp"

namespace banyan::cli {

using namespace config;
namespace {

struct AlgorithmsOptions {
  std::string name;  // "": all
  bool json = false;
};

constexpr std::string_view readings[] = {"corrected", "literal"};

// As a person would write it: 1.3893, not 1.38929999.
std::string value_text(float value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}
double as_written(float value) { return std::stod(value_text(value)); }

std::vector<const Algorithm*> chosen(const std::string& name) {
  const AlgorithmList& all = algorithms();
  if (name.empty()) return {all.begin(), all.end()};
  if (const Algorithm* algorithm = all.find(name)) return {algorithm};
  const auto near = nearest(name, {all.names().begin(), all.names().end()});
  std::string text = "there is no algorithm \"" + name + "\"";
  text += near.empty() ? "; `banyan algorithms` lists them" : "; did you mean " + std::string(near) + "?";
  throw CommandError(exit_usage, text);
}

std::string range_text(const ParameterInfo& info) {
  return value_text(info.minimum) + " to " + value_text(info.maximum);
}

nlohmann::ordered_json json_of(const Algorithm& algorithm) {
  nlohmann::ordered_json entry = {{"name", algorithm.name()},
                                  {"summary", algorithm.summary()},
                                  {"message_bytes", message_bytes(algorithm, Setup{})}};
  auto& list = entry["parameters"] = nlohmann::ordered_json::array();
  const auto rows = algorithm.parameters();
  const auto defaults = algorithm.values(Setup{});
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const ParameterInfo& info = *rows[k];
    nlohmann::ordered_json row = {{"key", info.key},
                                  {"symbol", info.symbol},
                                  {"unit", info.unit},
                                  {"meaning", info.meaning},
                                  {"advice", info.advice},
                                  {"source", info.source},
                                  {"minimum", as_written(info.minimum)},
                                  {"maximum", as_written(info.maximum)},
                                  {"grows_with_body", info.grows_with_body}};
    for (const auto reading : readings)
      row["default"][std::string(reading)] = as_written(defaults[k]);  // the same in both
    row["set_by"] = "mission.parameters." + std::string(info.key);
    list.push_back(std::move(row));
  }
  return entry;
}

// "-" if the algorithm has no such parameter.
std::string default_text(const Algorithm& algorithm, std::string_view key) {
  const auto rows = algorithm.parameters();
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const ParameterInfo* info) { return info->key == key; });
  return row == rows.end() ? "-" : value_text(algorithm.values(Setup{})[static_cast<std::size_t>(row - rows.begin())]);
}

// As wide as its name, or as the numbers below it.
int column_width(const Algorithm& algorithm) { return std::max(9, static_cast<int>(algorithm.name().size())); }

// The text of a row besides its numbers: grouped by algorithms with the same text.
struct ParameterGroup {
  const ParameterInfo* info;
  std::string names;
};
bool is_same(const ParameterInfo& a, const ParameterInfo& b) {
  return a.meaning == b.meaning && a.advice == b.advice && a.source == b.source && range_text(a) == range_text(b) &&
         a.grows_with_body == b.grows_with_body;
}

void append_name(std::string& names, std::string_view name) {
  names += (names.empty() ? "" : ", ") + std::string(name);
}

std::vector<ParameterGroup> said_of(std::string_view key, const std::vector<const Algorithm*>& list) {
  std::vector<ParameterGroup> said;
  for (const Algorithm* algorithm : list) {
    const auto rows = algorithm->parameters();
    const auto row =
        std::find_if(rows.begin(), rows.end(), [&](const ParameterInfo* info) { return info->key == key; });
    if (row == rows.end()) continue;
    auto group =
        std::find_if(said.begin(), said.end(), [&](const ParameterGroup& s) { return is_same(*s.info, **row); });
    if (group == said.end()) group = said.insert(said.end(), {*row, ""});
    append_name(group->names, algorithm->name());
  }
  return said;
}

// A row for each key that one of them has. Where its meaning differs, each meaning is printed.
std::string table_text(const std::vector<const Algorithm*>& list) {
  std::string head = format("%-26s %-8s %-4s", "parameter", "symbol", "unit");
  for (const Algorithm* algorithm : list)
    head += format("  %-*s", column_width(*algorithm), std::string(algorithm->name()).c_str());
  std::string text = head + "  defined in\n";
  for (const auto& row : algorithms().parameters()) {
    const std::vector<ParameterGroup> said = said_of(row.key, list);
    if (said.empty()) continue;
    text += format("%-26s %-8s %-4s", std::string(row.key).c_str(), std::string(said[0].info->symbol).c_str(),
                   std::string(said[0].info->unit).c_str());
    for (const Algorithm* algorithm : list)
      text += format("  %-*s", column_width(*algorithm), default_text(*algorithm, row.key).c_str());
    text += "  " + std::string(said[0].info->source) + "\n";
    for (const ParameterGroup& group : said) {
      const ParameterInfo* info = group.info;
      text += "    " + (said.size() > 1 ? group.names + ": " : "") + std::string(info->meaning);
      text += "; " + range_text(*info) + (info->grows_with_body ? ", more for larger bodies" : "");
      text += "\n    " + std::string(info->advice) +
              (said.size() > 1 && info != said[0].info ? " (" + std::string(info->source) + ")" : "") + "\n";
    }
  }
  return text;
}

int algorithms_command(const AlgorithmsOptions& options) {
  const auto list = chosen(options.name);
  if (options.json) {
    auto entries = nlohmann::ordered_json::array();
    for (const Algorithm* algorithm : list) entries.push_back(json_of(*algorithm));
    print(entries.dump(2) + "\n");
    return exit_done;
  }
  std::string text = "Choose one with mission.algorithm = \"...\" in a scenario, or --set mission.algorithm=...\n\n";
  for (const Algorithm* algorithm : list)
    text += format("  %-14s ", std::string(algorithm->name()).c_str()) + std::string(algorithm->summary()) + "\n";
  std::string sizes;
  for (const Algorithm* algorithm : list)
    append_name(sizes, std::string(algorithm->name()) + " " + std::to_string(message_bytes(*algorithm, Setup{})));
  text += "\nBytes of a message: " + sizes + "\n";
  text +=
      "\nTwo readings of the paper, by mission.reading: corrected (default) closes its gaps, literal is as printed.\n"
      "Change a parameter by mission.parameters.<parameter>. Defaults:\n\n";
  print(text + table_text(list));
  return exit_done;
}

}  // namespace

void add_algorithms(CLI::App& command, CommandAction& action) {
  auto options = std::make_shared<AlgorithmsOptions>();
  command.footer("Examples:\n  banyan algorithms\n  banyan algorithms inwards --json");
  command.add_option("name", options->name, "only this one")->type_name("NAME");
  command.add_flag("--json", options->json, "as JSON");
  command.callback([options, &action] { action = [options] { return algorithms_command(*options); }; });
}

}  // namespace banyan::cli
