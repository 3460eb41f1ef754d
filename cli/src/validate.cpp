// SPDX-License-Identifier: MIT
// `banyan validate`: everything that is wrong with some scenarios, without running them.
#include <nlohmann/json.hpp>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/controller/core/printable.hpp"
#include "commands.hpp"
#include "options.hpp"
#include "shipped.hpp"
#include "terminal.hpp"

namespace banyan::cli {

using namespace config;
namespace {

struct ValidateOptions {
  std::vector<std::string> files;
  std::vector<config::Override> overrides;
  bool json = false;
  bool quiet = false;
  std::string show;  // "toml" or "json": print the complete effective configuration
};

std::string count_of(std::size_t n, const std::string& noun) {
  return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
}

std::string summary(const std::string& file, const Configuration& configuration) {
  const auto& scenario = configuration.scenario;
  return printable(file) + ": ok: " + scenario.mission.algorithm + " (" + scenario.mission.reading + "), " +
         count_of(world::robot_count(scenario), "robot") + ", " +
         count_of(world::target_positions(scenario).size(), "target") +
         format(", at most %.1f s\n", world::time_limit_s(scenario));
}

nlohmann::ordered_json json_of(const std::string& file, const Loaded& loaded) {
  nlohmann::ordered_json entry = {{"file", file}, {"ok", loaded.ok()}};
  auto& list = entry["problems"] = nlohmann::ordered_json::array();
  for (const auto& p : loaded.problems) {
    list.push_back({{"severity", p.warning ? "warning" : "error"},
                    {"place", p.place.text()},
                    {"line", p.place.line},
                    {"key", p.key},
                    {"text", p.text}});
  }
  if (loaded.ok()) {
    entry["robots"] = world::robot_count(loaded.configuration.scenario);
    entry["config"] = nlohmann::ordered_json::parse(config_json(loaded.configuration));
  }
  return entry;
}

int validate_command(const ValidateOptions& options) {
  bool all_ok = true;
  auto report = nlohmann::ordered_json::array();
  std::vector<Problem> problems;
  std::string text;
  for (const auto& file : options.files) {
    const auto loaded = load_configuration(itself_or_shipped(file, "scenarios"), algorithms(), options.overrides);
    all_ok = all_ok && loaded.ok();
    problems.insert(problems.end(), loaded.problems.begin(), loaded.problems.end());
    if (options.json) report.push_back(json_of(file, loaded));
    if (!loaded.ok()) continue;
    if (options.show == "toml") text += config_toml(loaded.configuration);
    else if (options.show == "json") text += config_json(loaded.configuration, 2) + "\n";
    else if (!options.quiet) text += summary(file, loaded.configuration);
  }
  if (options.json) text = report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  else print_problems(problems);
  print(text);
  return all_ok ? exit_done : exit_usage;
}

}  // namespace

void add_validate(CLI::App& command, CommandAction& action) {
  auto options = std::make_shared<ValidateOptions>();
  command.footer(
      "Reports everything that is wrong at once, as file:line. The exit code is 2 if anything is.\n\n"
      "Examples:\n"
      "  banyan validate scenarios/*.toml\n"
      "  banyan validate my.toml --set swarm.robots=12 --show toml");
  command.add_option("files", options->files, "scenarios")->required()->type_name("FILE");
  add_overrides(command, options->overrides);
  add_seed(command, options->overrides);
  command.add_option("--show", options->show, "print the complete configuration, defaults included")
      ->type_name("toml|json")
      ->check(CLI::IsMember({"toml", "json"}).description(""));
  command.add_flag("--json", options->json, "print the report as JSON");
  command.add_flag("-q,--quiet", options->quiet, "say nothing about scenarios that are fine");
  command.callback([options, &action] { action = [options] { return validate_command(*options); }; });
}

}  // namespace banyan::cli
