// SPDX-License-Identifier: MIT
// `banyan run`: one scenario from its file to its results.
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <thread>
#include <utility>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/record/outputs.hpp"
#include "banyan/record/simulation.hpp"
#include "banyan/record/table.hpp"
#include "banyan/version.hpp"
#include "commands.hpp"
#include "keep_run.hpp"
#include "link.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "ros2_beside.hpp"
#include "shipped.hpp"
#include "summary.hpp"
#include "terminal.hpp"

namespace banyan::cli {

using namespace config;
namespace {

// Below this, handing out work costs more than a second thread brings.
constexpr std::size_t robots_for_threads = 500;

int thread_count(int wanted, std::size_t robots) {
  if (wanted > 0) return wanted;
  if (robots < robots_for_threads) return 1;
  return static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 16U));
}

// A run may go on after its limit, to settle or until it has recovered from deaths.
std::string progress_text(const record::Simulation& simulation) {
  const auto& tick = simulation.last();
  const double now_s = simulation.world().time_s(), limit_s = simulation.run().time_limit_s;
  const std::string limit = number_text(limit_s);
  const std::string of_limit = now_s < limit_s ? " of at most " + limit + " s" : ", after its limit of " + limit + " s";
  if (simulation.run().ticks == 0) return "waiting for the first tick";
  return format("%.1f s", now_s) + of_limit +
         format(", %u of %u targets reached, farthest worker %.2f m off", tick.targets_reached, tick.active_targets,
                tick.worst_target_distance_m);
}

void show(ProgressLine& progress, const record::Simulation& simulation) {
  const auto& world = simulation.world();
  const double share = world.time_s() / std::max(simulation.run().time_limit_s, world.scenario().tick_s);
  progress.show(share < 1.0 ? share : 0.0, progress_text(simulation), true);  // the time left is unknown
}

void tell_of_rest(const std::string& rest, const char* before = "") {
  std::error_code ignored;
  if (!rest.empty() && std::filesystem::exists(rest, ignored))
    complain(before + ("what was recorded until then is in " + rest));
}

// Reports outputs that have failed, at once: the run may still take hours.
class Complaints {
 public:
  Complaints(const record::Sinks& sinks, ProgressLine& progress) : sinks_(sinks), progress_(progress) {}
  void tell() {
    for (; told_ < sinks_.failures().size(); ++told_) {
      const auto& failure = sinks_.failures()[told_];
      progress_.clear();
      complain(failure.text);
      tell_of_rest(failure.rest);
      std::error_code ignored;
      if (std::filesystem::is_regular_file(failure.path, ignored)) complain(failure.path + " is that of another run");
    }
  }
  [[nodiscard]] bool any() const { return told_ > 0; }
  [[nodiscard]] bool about(const std::string& path) const {
    const auto& failures = sinks_.failures();
    return std::any_of(failures.begin(), failures.end(), [&](const auto& failure) { return failure.path == path; });
  }

 private:
  const record::Sinks& sinks_;
  ProgressLine& progress_;
  std::size_t told_ = 0;
};

Loaded load_experiment(const RunOptions& options) {
  if (!is_link(options.scenario)) {
    return load_configuration(itself_or_shipped(options.scenario, "scenarios"), algorithms(), options.overrides);
  }
  LoadedLink link = load_link(options.scenario, options.overrides);
  if (link.loaded.ok() && link.runs > 1)
    complain(format(
        "the link shows %zu runs side by side; this is the first (--set mission.algorithm, --seed for the others)",
        link.runs));
  return std::move(link.loaded);
}

Loaded load_or_leave(const RunOptions& options) {
  auto loaded = load_experiment(options);
  print_problems(loaded.problems);
  return loaded;
}

// Steps until the mission ends or a signal comes. An exception here ends the run; an output that fails does not.
record::RunEnd play_out(world::World world, record::Sinks& sinks, int threads, Complaints& complaints,
                        ProgressLine& progress, const Play& play) {
  world::Executor executor(threads);
  const auto go_on = [&](const record::Simulation& simulation) {
    complaints.tell();
    if (progress.due()) show(progress, simulation);
    return stop_signal() == 0;
  };
  record::RunEnd end = play(std::move(world), sinks, executor, go_on);
  progress.clear();
  complaints.tell();
  return end;
}

}  // namespace

int keep_run(const Configuration& configuration, const RunOutputs& outputs, const RunOptions& options,
             FunctionRef<world::World()> make_world, const Play& play, const std::function<std::string()>& remarks) {
  catch_stop_signals();
  ProgressLine progress(!options.quiet);
  const record::SinkOptions wanted{
      {config_json(configuration), std::string(version), std::string(git_id()), configuration.scenario.seed},
      configuration.output,
      outputs.existing()};
  record::Sinks sinks = record::open_outputs(outputs.directory(), wanted);
  Complaints complaints(sinks, progress);
  const int threads = thread_count(options.threads, world::robot_count(configuration.scenario));
  record::RunEnd end;
  try {
    end = play_out(make_world(), sinks, threads, complaints, progress, play);
  } catch (...) {
    for (const auto& rest : sinks.rests()) tell_of_rest(rest, "the run is lost; ");
    throw;
  }
  SummaryExtras extras{progress.elapsed_s(), threads, end.last.active_targets, end.last.targets_reached,
                       end.last.tree_parts,  {},      remarks ? remarks() : ""};
  if (options.force) outputs.remove_leftovers(configuration.output);
  for (const auto& format : record::output_formats) {
    if (wanted.output.wants(format) && !complaints.about(outputs.path(format))) extras.written.push_back(&format);
  }

  const record::RunRow row{record::identify(configuration.scenario, version, git_id()), end.run, end.interrupted};
  if (options.json) print(record::run_json(row, wanted.provenance.config_json));
  else if (!options.quiet) print_text(summary_text(row, configuration, outputs, extras));
  if (complaints.any()) return exit_lost;
  if (!end.interrupted) return exit_done;
  complain(format("stopped by %s at %.1f s; what was done until then is in %s", stop_signal_name(), end.run.time_s,
                  outputs.directory().c_str()));
  return exit_signal + stop_signal();
}

namespace {

struct RunCommand : RunOptions {
  bool ros2 = false;  // shown in ROS 2, and so in real time
  double speed = 1.0;
};

int run_command(const RunCommand& options) {
  const auto loaded = load_or_leave(options);
  if (!loaded.ok()) return exit_usage;
  const Configuration& configuration = loaded.configuration;
  ::signal(SIGPIPE, SIG_IGN);  // a reader of the summary that goes away must not cost the results

  const RunOutputs outputs(configuration, options.out, options.force);
  try {
    std::optional<Ros2Beside> ros2;
    if (options.ros2) ros2.emplace();
    const Play play = ros2 ? played_in_ros2({ros2->socket(), configuration}, options.speed) : record::run_scenario;
    return keep_run(
        configuration, outputs, options, [&] { return world::World(configuration.scenario); }, play);
  } catch (...) {
    outputs.abandon();
    throw;
  }
}

}  // namespace

void add_run(CLI::App& command, CommandAction& action) {
  auto options = std::make_shared<RunCommand>();
  command.footer(
      "Writes run.mcap (the recording), run.csv (one row) and run.json (the same with the whole\n"
      "configuration; `banyan run out/.../run.json` runs it again).\n\n"
      "Examples:\n"
      "  banyan run scenarios/three-targets.toml\n"
      "  banyan run scenarios/three-targets.toml --set mission.algorithm=inwards --set radio.loss=0.3\n"
      "  banyan run scenarios/paper-large.toml --seed 7 --out results/large-7 --series\n"
      "  banyan run scenarios/swarm-10000.toml --no-record --json > result.json\n\n"
      "`banyan keys` lists what can be set, `banyan algorithms` the algorithms and their parameters.");
  command
      .add_option("scenario", options->scenario,
                  "a scenario (.toml or .json), an earlier run.json, a link of the page, - for standard input")
      ->required()
      ->type_name("FILE");
  add_results(command, *options);
  command
      .add_option_function<std::string>(
          "--record-every",
          [options](const std::string& n) {
            options->overrides.push_back({"output.record_every=" + n, "--record-every " + n});
          },
          "record the robots at every Nth tick only")
      ->type_name("N");
  command
      .add_option("-t,--threads", options->threads,
                  "threads within the run, default 1, or all cores from 500 robots on; never changes the result")
      ->type_name("N")
      ->check(whole_within(1, 256));
  add_ros2(command, *options);
  command.add_option("--speed", options->speed, "with --ros2: how many times faster than real time, default 1")
      ->type_name("X")
      ->check(number_within(0.01, 100.0))
      ->needs("--ros2");
  command.callback([options, &action] { action = [options] { return run_command(*options); }; });
}

}  // namespace banyan::cli
