// SPDX-License-Identifier: MIT
// A run from its start to the end of the mission, as `banyan run` does it, and what Python keeps of it.
#include <filesystem>
#include <optional>
#include <utility>

#include "banyan/measure/observer.hpp"
#include "banyan/record/outputs.hpp"
#include "banyan/record/simulation.hpp"
#include "banyan/version.hpp"
#include "frame_binding.hpp"

namespace banyan::python {
namespace {

// What of a run stays in memory.
class Keeper final : public record::Sink {
 public:
  Keeper(bool series, std::size_t every, record::Sinks& files) : series_(series), every_(every), files_(files) {}

  void start(const world::World& world) override {
    files_.start(world);
    if (every_ > 0) remember(world);
  }
  void tick(const world::World& world, const measure::Tick& tick) override {
    files_.tick(world, tick);
    if (series_) ticks.push_back(tick);
    if (every_ > 0 && world.tick() % every_ == 0) remember(world);
  }
  void finish(const world::World& world, const record::RunEnd& end) override {
    files_.finish(world, end);
    last.setting = record::setting_of(world);
    record::capture(world, last.frame);
  }
  [[nodiscard]] bool wants_fiedler(const world::World& world) const override {
    return files_.wants_fiedler(world) || (series_ && measure::is_plotted(world));
  }

  std::vector<measure::Tick> ticks;
  std::vector<double> time_s, positions, headings;
  std::vector<std::uint8_t> roles, alive;
  std::vector<std::int32_t> parents;
  PyFrame last;

 private:
  void remember(const world::World& world) {
    time_s.push_back(world.time_s());
    for (const world::Vec2& p : world.positions()) positions.insert(positions.end(), {p.x, p.y});
    for (const world::Vec2& h : world.headings()) headings.insert(headings.end(), {h.x, h.y});
    for (const Report& report : world.reports()) {
      roles.push_back(static_cast<std::uint8_t>(report.role));
      parents.push_back(report.parent == nobody ? -1 : static_cast<std::int32_t>(report.parent));
    }
    alive.insert(alive.end(), world.alive().begin(), world.alive().end());
  }
  bool series_;
  std::size_t every_;
  record::Sinks& files_;
};

record::Sinks files_of(const PyScenario& scenario, const std::string& folder, bool replace) {
  if (folder.empty()) return {};
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw record::FileError(folder, "cannot create", error.value());
  const config::Configuration& configuration = scenario.configuration;
  return record::open_outputs(folder, {{config::config_json(configuration), std::string(version), std::string(git_id()),
                                        configuration.scenario.seed},
                                       configuration.output,
                                       replace ? record::Existing::replace : record::Existing::keep});
}

py::dict tracks_of(Keeper& keeper, std::size_t robots_count) {
  const auto frames = static_cast<py::ssize_t>(keeper.time_s.size());
  const auto robots = static_cast<py::ssize_t>(robots_count);
  py::dict tracks;
  tracks["time_s"] = taken(std::move(keeper.time_s), {frames});
  tracks["positions"] = taken(std::move(keeper.positions), {frames, robots, 2});
  tracks["headings"] = taken(std::move(keeper.headings), {frames, robots, 2});
  tracks["roles"] = taken(std::move(keeper.roles), {frames, robots});
  tracks["parents"] = taken(std::move(keeper.parents), {frames, robots});
  tracks["alive"] = taken(std::move(keeper.alive), {frames, robots}).attr("view")("bool");
  return tracks;
}

// `told(share, time_s)` now and then, if it is not None.
py::dict run(const PyScenario& scenario, const std::string& folder, bool replace, bool series, std::size_t every,
             int threads, const py::object& told) {
  record::Sinks files = files_of(scenario, folder, replace);
  Keeper keeper(series, every, files);
  record::RunEnd end;
  world::World world(scenario.configuration.scenario);
  const std::size_t robots = world.size();
  {
    const py::gil_scoped_release others;
    world::Executor team(threads);
    CtrlC interrupt;
    auto next = std::chrono::steady_clock::now() + std::chrono::milliseconds(200);
    end = record::run_scenario(std::move(world), keeper, team, [&](const record::Simulation& simulation) {
      interrupt.check();
      if (!told.is_none() && std::chrono::steady_clock::now() >= next) {
        next += std::chrono::milliseconds(200);
        const py::gil_scoped_acquire interpreter;
        told(simulation.world().time_s() / simulation.run().time_limit_s, simulation.world().time_s());
      }
      return true;
    });
  }
  for (const auto& failure : files.failures()) throw record::FileError(failure.path, failure.text);
  const record::RunRow row{record::identify(scenario.configuration.scenario, version, git_id()), end.run,
                           end.interrupted};
  py::dict result;
  result["row"] = row_of(record::run_columns(), row);
  result["frame"] = std::move(keeper.last);
  result["series"] = series ? py::object(table_of(keeper.ticks)) : py::none();
  result["trajectories"] = every > 0 ? py::object(tracks_of(keeper, robots)) : py::none();
  return result;
}

}  // namespace

void bind_run(py::module_& m) {
  m.def("run", &run, py::arg("scenario"), py::arg("folder"), py::arg("replace"), py::arg("series"), py::arg("every"),
        py::arg("threads"), py::arg("told"));
}

}  // namespace banyan::python
