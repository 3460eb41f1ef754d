// SPDX-License-Identifier: MIT
// `banyan argos`: an experiment for ARGoS from a scenario.
#include <filesystem>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/hosts/argos/experiment.hpp"
#include "banyan/hosts/argos/mission.hpp"
#include "banyan/record/file.hpp"
#include "banyan/version.hpp"
#include "commands.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

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

}  // namespace

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

}  // namespace banyan::cli
