// SPDX-License-Identifier: MIT
#include "banyan/study/simulate.hpp"

#include <chrono>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "banyan/config/config.hpp"
#include "banyan/record/outputs.hpp"
#include "banyan/record/simulation.hpp"
#include "banyan/record/table.hpp"
#include "banyan/version.hpp"

namespace banyan::study {
namespace {

using nlohmann::json;

// A study has a table of its own for the results, and keeps files of a run where [output] asks for them. If it
// was stopped, it may find files of a run whose row was never written: they are replaced.
record::Sinks open_outputs(const config::Configuration& configuration, const RunTask& task) {
  if (task.directory.empty() || !configuration.output.any()) return {};
  const std::uint64_t seed = configuration.scenario.seed;
  record::SinkOptions options{{task.config_json, std::string(version), std::string(git_id()), seed},
                              configuration.output,
                              record::Existing::replace};
  options.output.results = false;
  std::error_code error;
  std::filesystem::create_directories(task.directory, error);
  if (error) throw record::FileError(task.directory, "cannot create", error.value());
  return record::open_outputs(task.directory, options);
}

// A run whose files cannot be kept has failed, and can be done again.
record::RunRow run(const config::Configuration& configuration, const RunTask& task) {
  record::Sinks sinks = open_outputs(configuration, task);
  world::Executor alone(1);
  const record::RunEnd end = record::run_scenario(world::World(configuration.scenario), sinks, alone);
  if (!sinks.failures().empty()) throw std::runtime_error(sinks.failures().front().text);
  return {record::identify(configuration.scenario, version, git_id()), end.run, end.interrupted};
}

std::string one_line(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  return text;
}

RunTask decode_task(std::string_view bytes) {
  const json task = json::from_msgpack(bytes);
  return {task.at("config").get<std::string>(), task.at("directory").get<std::string>()};
}

Outcome outcome_of(const RunTask& task, const AlgorithmList& algorithms) {
  const auto loaded = config::parse_configuration("run.json", task.config_json, algorithms);
  if (!loaded.ok()) {
    for (const auto& problem : loaded.problems) {
      if (!problem.warning) return {"", one_line(problem.key + ": " + problem.text)};
    }
  }
  return {record::run_csv_row(run(loaded.configuration, task)), ""};
}

}  // namespace

std::string encode(const RunTask& task) {
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

std::string simulate(std::string_view task, const AlgorithmList& algorithms) {
  const auto start = std::chrono::steady_clock::now();
  Outcome outcome;
  try {
    outcome = outcome_of(decode_task(task), algorithms);
  } catch (const std::bad_alloc&) { outcome.error = "out of memory"; } catch (const std::exception& e) {
    outcome.error = one_line(e.what());
  }
  outcome.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return encode(outcome);
}

}  // namespace banyan::study
