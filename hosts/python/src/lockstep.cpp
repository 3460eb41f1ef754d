// SPDX-License-Identifier: MIT
// Many worlds of one shape, tick by tick together, their robots decided for by arrays: what learning needs.
#include <algorithm>
#include <exception>
#include <mutex>
#include <optional>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/measure/observer.hpp"
#include "banyan/version.hpp"
#include "banyan/world/threads.hpp"
#include "banyan/world/world.hpp"
#include "frame_binding.hpp"

namespace banyan::python {
namespace {

// Of all worlds, per tick; the columns of a series and what rewards want besides.
constexpr const char* mean_distance = "mean_target_distance_m";

double number_in(const record::Cell& cell) noexcept {
  if (const bool* const flag = std::get_if<bool>(&cell)) return *flag ? 1.0 : 0.0;
  if (const auto* const whole = std::get_if<std::uint64_t>(&cell)) return static_cast<double>(*whole);
  if (const double* const real = std::get_if<double>(&cell)) return *real;
  return std::numeric_limits<double>::quiet_NaN();
}

// Of the targets that are not given up, from the robot first sent there.
double mean_target_distance_m(const world::World& world) noexcept {
  double sum = 0.0;
  std::size_t count = 0;
  for (const world::Target& target : world.targets()) {
    if (!target.active) continue;
    sum += distance(world.positions()[target.worker], target.position);
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

class Lockstep {
 public:
  Lockstep(const PyScenario& scenario, std::size_t worlds, std::size_t neighbours, std::size_t payload, bool floats,
           const std::optional<std::string>& beneath, int threads)
      : scenario_(scenario),
        robots_(world::robot_count(scenario.configuration.scenario)),
        team_(threads),
        places_(worlds) {
    block_ = std::make_shared<Block>(Shape{robots_, neighbours, payload}, worlds);
    const Algorithm* const under = beneath ? algorithms().find(*beneath) : nullptr;
    for (std::size_t w = 0; w < worlds; ++w) {
      Outside outside;
      outside.name = under != nullptr ? std::string(under->name()) : "actions";
      outside.summary = "decided by arrays";
      outside.neighbours = neighbours;
      outside.payload = payload;
      outside.floats = floats;
      outside.beneath = under;
      outside.block = block_;
      outside.place = w;
      algorithms_.push_back(std::make_unique<OutsideAlgorithm>(std::move(outside)));
    }
    const std::size_t columns = record::series_columns().size() + 1;
    metrics_.resize(worlds * columns);
    complete_.resize(worlds);
    finished_.resize(worlds);
  }

  // New worlds at the places where `which` is true, each with its seed; in each a first tick, in which robots sense.
  void reset(const std::vector<std::uint64_t>& seeds, const std::vector<bool>& which) {
    const Busy busy(stepping_, "this environment");
    if (seeds.size() != places_.size() || which.size() != places_.size())
      throw std::invalid_argument("as many seeds as worlds are needed");
    const py::gil_scoped_release others;
    everywhere([&](std::size_t w) {
      if (which[w]) begin(w, seeds[w]);
    });
  }

  void step() {
    const Busy busy(stepping_, "this environment");
    if (!places_.empty() && !places_[0].world) throw std::runtime_error("reset() comes before step()");
    const py::gil_scoped_release others;
    everywhere([&](std::size_t w) {
      Place& place = places_[w];
      block_->decided(w) = 1;
      place.world->decide();
      tick(w);
    });
  }

  [[nodiscard]] const world::World& world(std::size_t w) const {
    if (w >= places_.size())
      throw py::index_error("there is no world " + std::to_string(w) + " of " + std::to_string(places_.size()));
    if (stepping_) throw std::runtime_error("this environment is being stepped by another thread");
    if (!places_[w].world) throw std::runtime_error("reset() comes first");
    return *places_[w].world;
  }
  [[nodiscard]] py::dict result(std::size_t w) const {
    const world::World& of = world(w);
    const record::RunRow row{record::identify(of.scenario(), version, git_id()), places_[w].observer->result(of),
                             !places_[w].observer->finished()};
    return row_of(record::run_columns(), row);
  }

  [[nodiscard]] std::size_t robots() const noexcept { return robots_; }
  [[nodiscard]] std::size_t size() const noexcept { return places_.size(); }
  [[nodiscard]] const std::shared_ptr<Block>& block() const noexcept { return block_; }
  [[nodiscard]] py::dict outcomes(const py::object& self) const {
    const auto worlds = static_cast<py::ssize_t>(places_.size());
    const auto columns = static_cast<py::ssize_t>(record::series_columns().size() + 1);
    py::dict arrays;
    py::ssize_t c = 0;
    const auto column = [&] {
      return view_of(py::dtype::of<double>(), {worlds}, {columns * static_cast<py::ssize_t>(sizeof(double))},
                     metrics_.data() + c++, self);
    };
    for (const auto& info : record::series_columns()) arrays[py::str(std::string(info.name))] = column();
    arrays[mean_distance] = column();
    arrays["complete"] = view_of(py::dtype::of<bool>(), {worlds}, {1}, complete_.data(), self);
    arrays["finished"] = view_of(py::dtype::of<bool>(), {worlds}, {1}, finished_.data(), self);
    return arrays;
  }

 private:
  struct Place {
    std::optional<world::World> world;
    std::optional<measure::Observer> observer;
  };

  // The first exception is rethrown when all are done.
  template <class Call> void everywhere(const Call& call) {
    std::exception_ptr failed;
    std::mutex one;
    team_.parallel_for(places_.size(), [&](std::size_t begin, std::size_t end, int) {
      try {
        for (std::size_t w = begin; w < end; ++w) call(w);
      } catch (...) {
        const std::lock_guard lock(one);
        if (!failed) failed = std::current_exception();
      }
    });
    if (failed) std::rethrow_exception(failed);
  }

  void begin(std::size_t w, std::uint64_t seed) {
    world::Scenario scenario = scenario_.configuration.scenario;
    scenario.seed = seed;
    if (world::robot_count(scenario) != robots_)
      throw ScenarioFault(
          "the number of robots depends on the seed: give swarm.robots, since all worlds need the same number");
    Place& place = places_[w];
    place.observer.reset();
    block_->clear(w);
    place.world.emplace(scenario, *algorithms_[w]);
    place.observer.emplace(*place.world);
    tick(w);
  }

  void tick(std::size_t w) {
    Place& place = places_[w];
    place.world->step();
    const measure::Tick& seen = place.observer->observe(*place.world);
    double* at = metrics_.data() + w * (record::series_columns().size() + 1);
    for (const auto& column : record::series_columns()) *at++ = number_in(column.cell(seen));
    *at = mean_target_distance_m(*place.world);
    complete_[w] = place.observer->run().complete ? 1 : 0;
    finished_[w] = place.observer->finished() ? 1 : 0;
  }

  PyScenario scenario_;
  std::size_t robots_;
  world::Executor team_;
  std::shared_ptr<Block> block_;
  std::vector<std::unique_ptr<OutsideAlgorithm>> algorithms_;
  std::vector<Place> places_;
  std::vector<double> metrics_;
  std::vector<std::uint8_t> complete_, finished_;
  std::atomic<bool> stepping_ = false;
};

PyFrame picture_of(const Lockstep& lockstep, std::size_t w) {
  PyFrame frame{record::setting_of(lockstep.world(w)), {}, {}};
  record::capture(lockstep.world(w), frame.frame);
  return frame;
}

py::array_t<double> copied(std::span<const world::Vec2> points) {
  py::array_t<double> array({static_cast<py::ssize_t>(points.size()), py::ssize_t{2}});
  double* at = array.mutable_data();
  for (const world::Vec2& p : points) {
    *at++ = p.x;
    *at++ = p.y;
  }
  return array;
}

}  // namespace

void bind_lockstep(py::module_& m) {
  py::class_<Lockstep>(m, "Lockstep")
      .def(py::init<const PyScenario&, std::size_t, std::size_t, std::size_t, bool, const std::optional<std::string>&,
                    int>(),
           py::arg("scenario"), py::arg("worlds"), py::arg("neighbours"), py::arg("payload"), py::arg("floats"),
           py::arg("beneath"), py::arg("threads"))
      .def("reset", &Lockstep::reset, py::arg("seeds"), py::arg("which"))
      .def("step", &Lockstep::step)
      .def_property_readonly("robots", &Lockstep::robots)
      .def("__len__", &Lockstep::size)
      .def("arrays", [](const Lockstep& l) { return arrays_of(l.block(), true); })
      .def("outcomes", [](const py::object& self) { return self.cast<const Lockstep&>().outcomes(self); })
      .def(
          "hash", [](const Lockstep& l, std::size_t w) { return l.world(w).hash(); }, py::arg("world"))
      .def(
          "time_s", [](const Lockstep& l, std::size_t w) { return l.world(w).time_s(); }, py::arg("world"))
      .def(
          "positions", [](const Lockstep& l, std::size_t w) { return copied(l.world(w).positions()); },
          py::arg("world"))
      .def(
          "headings", [](const Lockstep& l, std::size_t w) { return copied(l.world(w).headings()); }, py::arg("world"))
      .def("result", &Lockstep::result, py::arg("world"))
      .def("frame", &picture_of, py::arg("world"));
}

}  // namespace banyan::python
