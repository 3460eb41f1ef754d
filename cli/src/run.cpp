// SPDX-License-Identifier: MIT
// `banyan run`: one scenario from its file to its results.
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <thread>

#include "banyan/measure/observer.hpp"
#include "banyan/record/recording.hpp"
#include "banyan/record/table.hpp"
#include "banyan/version.hpp"
#include "banyan/world/threads.hpp"
#include "banyan/world/world.hpp"
#include "commands.hpp"
#include "outputs.hpp"
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

// What a run writes while it goes on; every part optional.
class Keeper {
 public:
  Keeper(const RunOutputs& outputs, const Configuration& configuration)
      : outputs_(outputs), json_(config_json(configuration)) {
    const auto& scenario = configuration.scenario;
    if (configuration.output.record) {
      record::RecorderOptions options;
      options.every_ticks = configuration.output.record_every;
      options.messages = configuration.output.messages;
      options.existing = outputs.existing();
      recorder_.emplace(outputs.recording(),
                        record::Provenance{json_, std::string(version), std::string(git_id()), scenario.seed}, options);
    }
    if (configuration.output.series) series_.emplace(outputs.series(), outputs.existing());
  }

  void start(const world::World& world) {
    if (!recorder_) return;
    measure::Observer before(world);  // the run's own observer counts ticks, and this is none
    recorder_->frame(world, before.observe(world, measure::is_plotted(world)));
  }
  void tick(const world::World& world, const measure::Tick& tick) {
    if (recorder_) recorder_->frame(world, tick);
    if (series_) series_->row(tick);
  }
  void finish(const record::RunRow& row) {
    if (recorder_) {
      if (row.interrupted) recorder_->event("interrupt", "stopped from outside");
      recorder_->finish(row.run, row.interrupted);
    }
    if (series_) series_->finish();
    record::write_run_csv(outputs_.table(), row, outputs_.existing());
    record::write_run_json(outputs_.json(), row, json_, outputs_.existing());
  }
  [[nodiscard]] bool records() const noexcept { return recorder_.has_value(); }
  [[nodiscard]] const std::string& config() const noexcept { return json_; }

 private:
  const RunOutputs& outputs_;
  std::string json_;
  std::optional<record::Recorder> recorder_;
  std::optional<record::SeriesWriter> series_;
};

std::string progress_text(const world::World& world, const measure::Observer& observer) {
  const auto& tick = observer.last();
  return format("%.1f s of at most %s s, %u of %u targets reached, farthest worker %.2f m off", world.time_s(),
                number_text(observer.run().time_limit_s).c_str(), tick.targets_reached, tick.active_targets,
                tick.worst_target_distance_m);
}

// Steps until the mission ends or a signal comes.
void play_out(world::World& world, measure::Observer& observer, Keeper& keeper, int threads, bool exact_fiedler,
              Progress& progress) {
  world::Executor executor(threads);
  keeper.start(world);
  while (!observer.finished() && stop_signal() == 0) {
    world.step(executor);
    keeper.tick(world, observer.observe(world, exact_fiedler || (keeper.records() && measure::is_plotted(world))));
    if (progress.due()) {
      const double share = world.time_s() / std::max(observer.run().time_limit_s, world.scenario().tick_s);
      progress.show(std::min(share, 1.0), progress_text(world, observer), true);
    }
  }
}

Loaded load_or_leave(const RunOptions& options) {
  auto loaded = load_configuration(options.scenario, options.overrides);
  print_problems(loaded.problems);
  return loaded;
}

}  // namespace

int run_command(const RunOptions& options) {
  const auto loaded = load_or_leave(options);
  if (!loaded.ok()) return exit_usage;
  const Configuration& configuration = loaded.configuration;
  ::signal(SIGPIPE, SIG_IGN);  // a reader of the summary that goes away must not cost the results

  const RunOutputs outputs(configuration, options.out, options.force);
  record::RunRow row;
  SummaryExtras extras;
  std::string config;
  try {
    catch_stop_signals();
    Progress progress(!options.quiet);
    world::World world(configuration.scenario);
    measure::Observer observer(world);
    Keeper keeper(outputs, configuration);
    extras.threads = thread_count(options.threads, world.size());
    play_out(world, observer, keeper, extras.threads, configuration.output.series, progress);
    extras.wall_s = progress.elapsed_s();
    extras.targets = observer.last().active_targets;
    extras.targets_reached = observer.last().targets_reached;
    row = {record::identify(configuration.scenario, version, git_id()), observer.result(world),
           stop_signal() != 0 && !observer.finished()};
    keeper.finish(row);
    config = keeper.config();
  } catch (...) {
    outputs.abandon();
    if (std::filesystem::exists(outputs.recording() + ".part")) {
      complain("the run is lost; what was recorded until then is in " + outputs.recording() + ".part");
    }
    throw;
  }
  if (options.force) outputs.remove_leftovers(configuration.output);

  if (options.json)
    print(record::run_json(row, config));
  else if (!options.quiet)
    print(summary_text(row, configuration, outputs, extras));
  if (!row.interrupted) return exit_done;
  complain(format("stopped by %s at %.1f s; what was done until then is in %s",
                  stop_signal() == SIGINT ? "Ctrl-C" : "SIGTERM", row.run.time_s, outputs.directory().c_str()));
  return exit_signal + stop_signal();
}

}  // namespace banyan::cli
