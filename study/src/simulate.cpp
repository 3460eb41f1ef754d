// SPDX-License-Identifier: MIT
#include "banyan/study/simulate.hpp"

#include <chrono>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "banyan/config/config.hpp"
#include "banyan/measure/observer.hpp"
#include "banyan/record/file.hpp"
#include "banyan/record/recording.hpp"
#include "banyan/record/table.hpp"
#include "banyan/version.hpp"
#include "banyan/world/threads.hpp"
#include "banyan/world/world.hpp"

namespace banyan::study {
namespace {

using nlohmann::json;

// What the configuration's [output] asks for. A study that was stopped may find files of a run
// whose row was never written: they are replaced.
class Keeper {
 public:
  Keeper(const config::Configuration& configuration, const Task& task) {
    if (task.directory.empty()) return;
    const auto& output = configuration.output;
    if (!output.record && !output.series) return;
    std::error_code error;
    std::filesystem::create_directories(task.directory, error);
    if (error) throw record::FileError(task.directory, "cannot create", error.value());
    if (output.record) {
      record::RecorderOptions options;
      options.every_ticks = output.record_every;
      options.messages = output.messages;
      options.existing = record::Existing::replace;
      recorder_.emplace(task.directory + "/run.mcap",
                        record::Provenance{task.config_json, std::string(version), std::string(git_id()),
                                           configuration.scenario.seed},
                        options);
    }
    if (output.series) series_.emplace(task.directory + "/series.csv", record::Existing::replace);
  }
  void start(const world::World& world) {
    if (!recorder_) return;
    measure::Observer before(world);
    recorder_->frame(world, before.observe(world, measure::is_plotted(world)));
  }
  void tick(const world::World& world, const measure::Tick& tick) {
    if (recorder_) recorder_->frame(world, tick);
    if (series_) series_->row(tick);
  }
  void finish(const measure::Run& run) {
    if (recorder_) recorder_->finish(run);
    if (series_) series_->finish();
  }
  [[nodiscard]] bool wants_fiedler(const world::World& world) const noexcept {
    return series_.has_value() || (recorder_.has_value() && measure::is_plotted(world));
  }

 private:
  std::optional<record::Recorder> recorder_;
  std::optional<record::SeriesWriter> series_;
};

record::RunRow run(const config::Configuration& configuration, const Task& task) {
  Keeper keeper(configuration, task);
  world::World world(configuration.scenario);
  measure::Observer observer(world);
  world::Executor alone(1);
  keeper.start(world);
  while (!observer.finished()) {
    world.step(alone);
    keeper.tick(world, observer.observe(world, keeper.wants_fiedler(world)));
  }
  const auto result = observer.result(world);
  keeper.finish(result);
  return {record::identify(configuration.scenario, version, git_id()), result, false};
}

std::string one_line(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  return text;
}

Task decode_task(std::string_view bytes) {
  const json task = json::from_msgpack(bytes);
  return {task.at("config").get<std::string>(), task.at("directory").get<std::string>()};
}

Outcome outcome_of(const Task& task) {
  const auto loaded = config::parse_configuration("run.json", task.config_json);
  if (!loaded.ok()) {
    for (const auto& problem : loaded.problems) {
      if (!problem.warning) return {"", one_line(problem.key + ": " + problem.text)};
    }
  }
  return {record::run_csv_row(run(loaded.configuration, task)), ""};
}

}  // namespace

std::string encode(const Task& task) {
  // Not as text: a directory's name may hold any bytes.
  std::string bytes;
  json::to_msgpack({{"config", task.config_json}, {"directory", task.directory}}, bytes);
  return bytes;
}

std::string encode(const Outcome& outcome) {
  return json{{"row", outcome.row}, {"error", outcome.error}, {"wall_s", outcome.wall_s}}.dump(
      -1, ' ', false, json::error_handler_t::replace);
}

Outcome decode_outcome(std::string_view bytes) {
  const json outcome = json::parse(bytes, nullptr, false);
  try {
    return {outcome.at("row").get<std::string>(), outcome.at("error").get<std::string>(),
            outcome.at("wall_s").get<double>()};
  } catch (const json::exception&) { return {"", "a worker sent what is no outcome"}; }
}

std::string simulate(std::string_view task) {
  const auto start = std::chrono::steady_clock::now();
  Outcome outcome;
  try {
    outcome = outcome_of(decode_task(task));
  } catch (const std::bad_alloc&) { outcome.error = "out of memory"; } catch (const std::exception& e) {
    outcome.error = one_line(e.what());
  }
  outcome.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return encode(outcome);
}

}  // namespace banyan::study
