// SPDX-License-Identifier: MIT
// A world that Python steps. Its arrays are its own memory: they show what is, at any time, and keep the world alive.
#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>

#include "banyan/config/document.hpp"
#include "banyan/measure/observer.hpp"
#include "banyan/record/json.hpp"
#include "banyan/record/recording.hpp"
#include "banyan/version.hpp"
#include "banyan/world/threads.hpp"
#include "banyan/world/world.hpp"
#include "frame_binding.hpp"

namespace banyan::python {
namespace {

class PyWorld {
 public:
  PyWorld(const PyScenario& scenario, bool measured)
      : algorithms_(scenario.algorithms),
        configuration_(scenario.configuration),
        world(scenario.configuration.scenario) {
    if (measured) observer_.emplace(world);
  }
  // As the other is now. It is not measured, since measures are about a run from its start.
  explicit PyWorld(const PyWorld& other)  // NOLINT(google-explicit-constructor): only where a copy is asked for
      : algorithms_(other.algorithms_),
        configuration_(other.configuration_),
        world(other.idle()),
        broken_(other.broken_) {}

  void step(std::int64_t ticks, int threads) {
    if (ticks < 0) throw py::value_error("ticks: is " + std::to_string(ticks) + "; at least 0");
    if (threads < 1) throw py::value_error("threads: is " + std::to_string(threads) + "; at least 1");
    const Busy busy(stepping_, "this world");
    if (broken_)
      throw std::runtime_error(
          "this world is worthless since its controller has failed; make another, or copy it before");
    if (!team_ || team_->threads() != threads) team_ = std::make_unique<world::Executor>(threads);
    const py::gil_scoped_release others;
    CtrlC interrupt;
    for (; ticks > 0; --ticks) {
      step_once();
      if (observer_) observer_->observe(world);
      if (ticks > 1) interrupt.check();
    }
  }

  // Steps and records until the mission ends or that time has come; for a copy, since nothing else is measured.
  void record(const std::string& path, double until_s) {
    const Busy busy(stepping_, "this world");
    if (broken_) throw std::runtime_error("this world is worthless since its controller has failed");
    team_ = std::make_unique<world::Executor>(1);
    const config::Configuration& c = configuration_;
    const py::gil_scoped_release others;
    CtrlC interrupt;
    record::Recorder recorder(path,
                              {config::config_json(c), std::string(version), std::string(git_id()), c.scenario.seed});
    measure::Observer observer(world);
    recorder.frame(world, measure::at_start(world));
    while (!observer.finished() && world.time_s() < until_s) {
      step_once();
      recorder.frame(world, observer.observe(world));
      interrupt.check();
    }
    recorder.finish(observer.result(world), !observer.finished());
  }

  // What happens to a world changes its scenario, too.
  void intervene(const std::string& event_json) {
    const Busy busy(stepping_, "this world");
    config::Node event;
    try {
      event = config::parse_document("event.json", event_json);
    } catch (const config::DocumentError& e) { throw ScenarioFault(e.problem.text); }
    config::Configuration current = configuration_;
    current.scenario = world.scenario();
    const config::Loaded loaded = config::with_event(current, world.time_s(), std::move(event));
    std::string faults;
    for (const config::Problem& problem : loaded.problems)
      if (!problem.warning) faults += (faults.empty() ? "" : "\n") + problem.key + ": " + problem.text;
    if (!faults.empty()) throw ScenarioFault(faults);
    try {
      world.intervene(loaded.configuration.scenario.events.back());
    } catch (const std::invalid_argument& e) { throw ScenarioFault(e.what()); }
  }

  // What is rebuilt in a step must not be read meanwhile. The interpreter's lock is held: none begins now.
  [[nodiscard]] const world::World& idle() const {
    if (stepping_)
      throw std::runtime_error("this world is being stepped, by another thread or from within a controller");
    return world;
  }
  [[nodiscard]] const measure::Observer& observer() const {
    static_cast<void>(idle());
    if (!observer_) throw std::runtime_error("this world is not measured: make it with World(..., measure=True)");
    return *observer_;
  }
  [[nodiscard]] const config::Configuration& configuration() const noexcept { return configuration_; }
  [[nodiscard]] const std::shared_ptr<const Algorithms>& algorithms() const noexcept { return algorithms_; }

 private:
  void step_once() {
    try {
      world.step(*team_);
    } catch (...) {
      broken_ = true;
      throw;
    }
  }

  std::shared_ptr<const Algorithms> algorithms_;
  config::Configuration configuration_;

 public:
  world::World world;

 private:
  std::optional<measure::Observer> observer_;
  std::unique_ptr<world::Executor> team_;
  std::atomic<bool> stepping_ = false;
  bool broken_ = false;
};

py::ssize_t robots(const PyWorld& w) { return static_cast<py::ssize_t>(w.world.size()); }

template <class Rows> py::array pairs_view(const py::object& self, Rows rows) {
  const auto data = rows(self.cast<const PyWorld&>());
  static_assert(sizeof(world::Vec2) == 2 * sizeof(double));
  return view_of(py::dtype::of<double>(), {static_cast<py::ssize_t>(data.size()), 2},
                 {2 * sizeof(double), sizeof(double)}, data.data(), self);
}

// A member of every report, where it lies.
template <class T> py::array report_view(const py::object& self, std::size_t offset) {
  const auto& w = self.cast<const PyWorld&>();
  const auto* const first = reinterpret_cast<const std::byte*>(w.world.reports().data()) + offset;
  return view_of(py::dtype::of<T>(), {robots(w)}, {static_cast<py::ssize_t>(sizeof(Report))}, first, self);
}
// Ids as signed numbers: nobody is -1. Where there are more robots than those hold, as they are.
py::array id_view(const py::object& self, std::size_t offset) {
  using Signed = std::make_signed_t<RobotId>;
  return robots(self.cast<const PyWorld&>()) <= std::numeric_limits<Signed>::max() ? report_view<Signed>(self, offset)
                                                                                   : report_view<RobotId>(self, offset);
}

py::array_t<std::int32_t> links_of(const PyWorld& w) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < w.idle().size(); ++i) count += w.idle().links(i).size();
  py::array_t<std::int32_t> pairs({static_cast<py::ssize_t>(count / 2), py::ssize_t{2}});
  std::int32_t* at = pairs.mutable_data();
  for (std::size_t i = 0; i < w.idle().size(); ++i) {
    for (const std::uint32_t j : w.idle().links(i)) {
      if (j <= i) continue;
      *at++ = static_cast<std::int32_t>(i);
      *at++ = static_cast<std::int32_t>(j);
    }
  }
  return pairs;
}

py::array_t<double> targets_of(const PyWorld& w) {
  const auto targets = w.idle().targets();
  py::array_t<double> positions({static_cast<py::ssize_t>(targets.size()), py::ssize_t{2}});
  double* at = positions.mutable_data();
  for (const world::Target& target : targets) {
    *at++ = target.position.x;
    *at++ = target.position.y;
  }
  return positions;
}

PyFrame frame_of(const PyWorld& w) {
  PyFrame frame{record::setting_of(w.idle()), {}, {}};
  record::capture(w.idle(), frame.frame);
  return frame;
}

py::dict result_of(const PyWorld& w) {
  const record::RunRow row{record::identify(w.world.scenario(), version, git_id()), w.observer().result(w.world),
                           !w.observer().finished()};
  return row_of(record::run_columns(), row);
}

std::string message_of(const PyWorld& w, std::size_t robot) {
  if (robot >= w.idle().size())
    throw py::index_error("there is no robot " + std::to_string(robot) + ": the world has " +
                          std::to_string(w.idle().size()));
  return record::message_json(w.idle().swarm(), robot);
}

PyScenario scenario_of(const PyWorld& w) {
  PyScenario scenario{w.configuration(), w.algorithms(), {}};
  scenario.configuration.scenario = w.idle().scenario();
  return scenario;
}

void bind_arrays(py::class_<PyWorld>& c) {
  c.def_property_readonly(
       "positions",
       [](const py::object& s) { return pairs_view(s, [](const PyWorld& w) { return w.world.positions(); }); })
      .def_property_readonly(
          "headings",
          [](const py::object& s) { return pairs_view(s, [](const PyWorld& w) { return w.world.headings(); }); })
      .def_property_readonly("roles",
                             [](const py::object& s) { return report_view<std::uint8_t>(s, offsetof(Report, role)); })
      .def_property_readonly("parents", [](const py::object& s) { return id_view(s, offsetof(Report, parent)); })
      .def_property_readonly("old_parents",
                             [](const py::object& s) { return id_view(s, offsetof(Report, old_parent)); })
      .def_property_readonly("serves", [](const py::object& s) { return id_view(s, offsetof(Report, serves)); })
      .def_property_readonly("roots", [](const py::object& s) { return id_view(s, offsetof(Report, root)); })
      .def_property_readonly("alive",
                             [](const py::object& s) {
                               const auto alive = s.cast<const PyWorld&>().world.alive();
                               return view_of(py::dtype::of<bool>(), {static_cast<py::ssize_t>(alive.size())}, {1},
                                              alive.data(), s);
                             })
      .def_property_readonly("links", &links_of)
      .def_property_readonly("targets", &targets_of)
      .def(
          "neighbours",
          [](const PyWorld& w, std::size_t i) {
            if (i >= w.world.size()) throw py::index_error("there is no robot " + std::to_string(i));
            const auto links = w.idle().links(i);
            return py::array_t<std::uint32_t>(static_cast<py::ssize_t>(links.size()), links.data());
          },
          py::arg("robot"))
      .def(
          "holder", [](const PyWorld& w, std::size_t target) { return w.idle().holder(target); }, py::arg("target"));
}

}  // namespace

void bind_world(py::module_& m) {
  py::class_<PyWorld> c(m, "World");
  c.def(py::init<const PyScenario&, bool>(), py::arg("scenario"), py::arg("measure"))
      .def("step", &PyWorld::step, py::arg("ticks") = 1, py::arg("threads") = 1)
      .def(py::init<const PyWorld&>(), py::arg("other"))
      .def("record", &PyWorld::record, py::arg("path"), py::arg("until_s"))
      .def("intervene_json", &PyWorld::intervene, py::arg("event"))
      .def("__len__", [](const PyWorld& w) { return w.world.size(); })
      .def_property_readonly("hash", [](const PyWorld& w) { return w.idle().hash(); })
      .def_property_readonly("tick", [](const PyWorld& w) { return w.world.tick(); })
      .def_property_readonly("time_s", [](const PyWorld& w) { return w.world.time_s(); })
      .def_property_readonly("core_scenario", &scenario_of)
      .def_property_readonly("memory_bytes", [](const PyWorld& w) { return w.idle().memory_bytes(); })
      .def_property_readonly("packets_sent", [](const PyWorld& w) { return w.world.packets_sent(); })
      .def_property_readonly("packets_received", [](const PyWorld& w) { return w.world.packets_received(); })
      .def_property_readonly("finished", [](const PyWorld& w) { return w.observer().finished(); })
      .def("metrics_row", [](const PyWorld& w) { return row_of(record::series_columns(), w.observer().last()); })
      .def("result_row", &result_of)
      .def("message_json", &message_of, py::arg("robot"))
      .def("frame", &frame_of)
      .def("svg", [](const PyWorld& w, const py::kwargs& look) { return svg_of(frame_of(w), look); });
  bind_arrays(c);
}

}  // namespace banyan::python
