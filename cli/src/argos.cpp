// SPDX-License-Identifier: MIT
// `banyan argos`: an experiment for ARGoS from a scenario.
#include <filesystem>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/hosts/argos/experiment.hpp"
#include "banyan/hosts/argos/mission.hpp"
#include "banyan/record/file.hpp"
#include "banyan/version.hpp"
#include "commands.hpp"
#include "options.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

// An experiment for ARGoS (docs/argos.md).
struct ArgosOptions {
  std::string scenario;
  std::vector<config::Override> overrides;
  std::string output;  // the .argos file; the world goes beside it
  std::string out;     // directory of its results; "": beside it, without the ending
  std::string robot = "kheperaiv";
  std::string sight = "stock";        // or "exact"
  std::string obstacles = "sensors";  // or "world"
  std::string library;                // "": the one that was built with this program
  bool force = false;
};

namespace fs = std::filesystem;

std::string whole_path(const fs::path& path) { return fs::absolute(path).lexically_normal().string(); }

// As it was built, or as it was installed; else its name, which ARGoS looks for in ARGOS_PLUGIN_PATH.
std::string library_of(const ArgosOptions& options) {
  if (!options.library.empty()) {
    if (!fs::exists(options.library)) throw CommandError(exit_usage, options.library + " is not there");
    return whole_path(options.library);
  }
  std::error_code ignored;
  const fs::path beside = fs::read_symlink("/proc/self/exe", ignored).parent_path().parent_path() / "lib";
  for (const fs::path& folder : {beside, beside / "banyan"})
    if (const fs::path library = folder / "libbanyan_argos.so"; fs::exists(library, ignored)) return library.string();
  complain("libbanyan_argos was not built with this program; ARGOS_PLUGIN_PATH must lead to it");
  return "libbanyan_argos";
}

// Everything that keeps this scenario from being an experiment.
void refuse(const world::Scenario& scenario) {
  std::vector<std::string> wrong = argos::not_in_argos(scenario);
  for (const world::Fault& fault : world::faults(scenario))
    if (!fault.warning) wrong.push_back(fault.key + ": " + fault.text);
  if (wrong.empty()) return;
  for (const std::string& line : wrong) complain(line);
  throw CommandError(exit_usage, "ARGoS cannot play this scenario; nothing was written");
}

int argos_command(const ArgosOptions& options) {
  auto loaded = config::load_configuration(options.scenario, algorithms(), options.overrides);
  print_problems(loaded.problems);
  if (!loaded.ok()) return exit_usage;
  const fs::path file = options.output;
  if (file.extension() != ".argos") throw CommandError(exit_usage, options.output + " must end with .argos");
  const argos::RobotKind* kind = argos::find_robot_kind(options.robot);
  config::Configuration& configuration = loaded.configuration;
  configuration.scenario = argos::with_robot(std::move(configuration.scenario), *kind);
  refuse(configuration.scenario);

  argos::Experiment experiment;
  experiment.made_by = "banyan " + std::string(version) + " for the scenario " + configuration.scenario.name;
  experiment.world = whole_path(fs::path(file).replace_extension(".world.toml"));
  experiment.out = whole_path(options.out.empty() ? fs::path(file).replace_extension() : fs::path(options.out));
  experiment.library = library_of(options);
  experiment.robot = kind;
  experiment.sight = options.sight == "exact" ? argos::Sight::exact : argos::Sight::stock;
  experiment.eyes = options.obstacles == "world" ? argos::Eyes::world : argos::Eyes::sensors;
  experiment.force = options.force;
  const auto existing = options.force ? record::Existing::replace : record::Existing::keep;
  record::write_file(experiment.world, config::config_toml(configuration), existing);
  record::write_file(file.string(), argos::experiment_xml(configuration.scenario, experiment), existing);
  print_text(file.string() + ": " + plural(world::robot_count(configuration.scenario), "robot") + ", " +
             plural(world::target_positions(configuration.scenario).size(), "target") + "; run it with argos3 -z -c " +
             file.string() + "\n");
  return exit_done;
}

}  // namespace

void add_argos(CLI::App& command, CommandAction& action) {
  auto options = std::make_shared<ArgosOptions>();
  command.footer(
      "Writes FILE.argos, which `argos3 -c` runs from any directory, and FILE.world.toml, the scenario with all\n"
      "changes. Robots, targets and obstacles come from the scenario; the results are those of `banyan run`.\n"
      "docs/argos.md has the rest.\n\n"
      "Examples:\n"
      "  banyan argos scenarios/paper-medium.toml -o medium.argos\n"
      "  banyan argos scenarios/paper-medium.toml --set mission.algorithm=convoy --seed 7 --sight exact -o "
      "convoy.argos");
  command.add_option("scenario", options->scenario, "a scenario (.toml or .json)")->required()->type_name("FILE");
  command.add_option("-o,--output", options->output, "the experiment, FILE.argos")->required()->type_name("FILE");
  command.add_option("--out", options->out, "directory for its results, default FILE without .argos")->type_name("DIR");
  const auto choice = [&](const char* name, std::string& value, const std::vector<std::string>& allowed,
                          const char* meaning) {
    command.add_option(name, value, meaning)->check(CLI::IsMember(allowed).description(""));
  };
  choice("--robot", options->robot, {"kheperaiv", "foot-bot"}, "kheperaiv, the default, or foot-bot");
  choice("--sight", options->sight, {"stock", "exact"},
         "stock: lines of sight as ARGoS has them, the default; or exact");
  choice("--obstacles", options->obstacles, {"sensors", "world"},
         "how robots see them: by sensors of their own, the default, or told by the world");
  command.add_option("--library", options->library, "libbanyan_argos, default the one built with this program")
      ->type_name("FILE");
  command.add_flag("-f,--force", options->force, "replace the files, and later the results, that are there");
  add_overrides(command, options->overrides);
  add_seed(command, options->overrides);
  command.callback([options, &action] { action = [options] { return argos_command(*options); }; });
}

}  // namespace banyan::cli
