// SPDX-License-Identifier: MIT
// Scenarios, the algorithms that come with Banyan, and those that are written in Python.
#include <utility>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/world/scenario.hpp"
#include "binding.hpp"

namespace banyan::python {
namespace {

// A policy written in Python, in one swarm: an object with decide(arrays) and clone(), in Python's part of the package.
class PythonMind final : public Mind {
 public:
  explicit PythonMind(Held policy) : policy_(std::move(policy)) {}

  void decide(const std::shared_ptr<Block>& block) override {
    const py::gil_scoped_acquire interpreter;
    // The arrays are made once for each block. A copied world has a block of its own.
    if (block != block_.lock()) {
      arrays_ = std::make_unique<Held>(arrays_of(block, false));
      block_ = block;
    }
    policy_.get().attr("decide")(arrays_->get());
  }

  [[nodiscard]] std::unique_ptr<Mind> clone() const override {
    const py::gil_scoped_acquire interpreter;
    return std::make_unique<PythonMind>(Held(policy_.get().attr("clone")()));
  }

 private:
  Held policy_;
  std::unique_ptr<Held> arrays_;
  std::weak_ptr<Block> block_;
};

py::dict facts_of(const Setup& setup, std::span<const Member> members) {
  py::dict facts;
  py::list workers;
  py::object root = py::none();
  for (const Member& member : members) {
    if (member.worker) workers.append(static_cast<int>(member.id));
    if (member.root) root = py::int_(static_cast<int>(member.id));
  }
  facts["robots"] = members.size();
  facts["workers"] = workers;
  facts["root"] = root;
  facts["range_m"] = static_cast<double>(setup.platform.communication_range_m);
  facts["tick_s"] = static_cast<double>(setup.platform.tick_s);
  facts["speed_limit_m_s"] = static_cast<double>(setup.platform.wheel_limit_m_s);
  facts["wheel_distance_m"] = static_cast<double>(setup.platform.wheel_distance_m);
  facts["holonomic"] = setup.platform.drive == Drive::holonomic;
  facts["line_of_sight"] = setup.platform.line_of_sight;
  facts["arrival_distance_m"] = setup.arrival_distance_m;
  return facts;
}

// From (name, summary, neighbours, payload, floats, beneath, make, fingerprint); make(facts) gives the object for
// PythonMind, and None stands for arrays that are written between ticks.
std::unique_ptr<OutsideAlgorithm> algorithm_from(const py::tuple& told) {
  Outside outside;
  outside.name = told[0].cast<std::string>();
  outside.summary = told[1].cast<std::string>();
  outside.neighbours = told[2].cast<std::size_t>();
  outside.payload = told[3].cast<std::size_t>();
  outside.floats = told[4].cast<bool>();
  if (!told[5].is_none()) outside.beneath = algorithms().find(told[5].cast<std::string>());
  if (!told[6].is_none()) {
    outside.mind = [make = Held(told[6].cast<py::object>())](const Setup& setup, std::span<const Member> members,
                                                             const std::shared_ptr<Block>&) -> std::unique_ptr<Mind> {
      const py::gil_scoped_acquire interpreter;
      return std::make_unique<PythonMind>(Held(make.get()(facts_of(setup, members))));
    };
  }
  outside.fingerprint = told[7].cast<std::string>();
  return std::make_unique<OutsideAlgorithm>(std::move(outside));
}

PyScenario made_of(config::Loaded loaded, std::shared_ptr<const Algorithms> algorithms) {
  PyScenario made{std::move(loaded.configuration), std::move(algorithms), {}};
  std::string faults;
  for (const config::Problem& problem : loaded.problems) {
    if (problem.warning) made.warnings.push_back(to_string(problem));
    else faults += (faults.empty() ? "" : "\n") + to_string(problem);
  }
  if (!faults.empty()) throw ScenarioFault(faults);
  return made;
}

// `text`: of the file, or nothing: it is read.
PyScenario load_scenario(const std::string& path, const std::optional<std::string>& text,
                         const std::vector<std::pair<std::string, std::string>>& changes, const py::sequence& own) {
  auto algorithms = algorithms_from(own);
  const auto overrides = overrides_of(changes);
  auto loaded = text ? config::parse_configuration(path, *text, algorithms->list, overrides)
                     : config::load_configuration(path, algorithms->list, overrides);
  return made_of(std::move(loaded), std::move(algorithms));
}

py::list parameters_of(const Algorithm& algorithm) {
  const auto rows = algorithm.parameters();
  const auto defaults = algorithm.values(Setup{});
  py::list list;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const ParameterInfo& info = *rows[k];
    py::dict row;
    row["key"] = std::string(info.key);
    row["symbol"] = std::string(info.symbol);
    row["unit"] = std::string(info.unit);
    row["default"] = static_cast<double>(defaults[k]);
    row["minimum"] = static_cast<double>(info.minimum);
    row["maximum"] = static_cast<double>(info.maximum);
    row["meaning"] = std::string(info.meaning);
    row["advice"] = std::string(info.advice);
    list.append(row);
  }
  return list;
}

py::dict algorithm_table() {
  py::dict table;
  for (const Algorithm* algorithm : algorithms()) {
    py::dict row;
    row["summary"] = std::string(algorithm->summary());
    row["parameters"] = parameters_of(*algorithm);
    table[py::str(std::string(algorithm->name()))] = row;
  }
  return table;
}

std::vector<const Algorithm*> all_of(const std::vector<std::unique_ptr<OutsideAlgorithm>>& own) {
  std::vector<const Algorithm*> all(algorithms().begin(), algorithms().end());
  for (const auto& algorithm : own) all.push_back(algorithm.get());
  return all;
}

}  // namespace

std::shared_ptr<const Algorithms> algorithms_from(const py::sequence& own) {
  if (own.empty()) return shipped_algorithms();
  std::vector<std::unique_ptr<OutsideAlgorithm>> made;
  for (const py::handle told : own) {
    made.push_back(algorithm_from(told.cast<py::tuple>()));
    if (algorithms().find(made.back()->name()) != nullptr)
      throw ScenarioFault("a controller cannot be called \"" + std::string(made.back()->name()) +
                          "\": that is one of Banyan's algorithms");
  }
  return std::make_shared<Algorithms>(std::move(made));
}

Algorithms::Algorithms(std::vector<std::unique_ptr<OutsideAlgorithm>> of_user)
    : own(std::move(of_user)), list(all_of(own), algorithms().usual()) {}

std::shared_ptr<const Algorithms> shipped_algorithms() {
  static const auto shipped = std::make_shared<const Algorithms>(std::vector<std::unique_ptr<OutsideAlgorithm>>{});
  return shipped;
}

std::vector<config::Override> overrides_of(const std::vector<std::pair<std::string, std::string>>& changes) {
  std::vector<config::Override> overrides;
  overrides.reserve(changes.size());
  for (const auto& [key, value] : changes) {
    if (key.empty()) overrides.push_back({"", "with " + value, value});
    else overrides.push_back({key + "=" + value, key + " = " + value});
  }
  return overrides;
}

void bind_scenario(py::module_& m) {
  m.attr("largest_payload") = largest_payload;
  m.attr("most_kept_links") = most_kept_links;
  m.def("algorithm_table", &algorithm_table);
  m.def("field_table", [] {
    py::list rows;
    for (const FieldInfoOf& info : fields()) rows.append(py::make_tuple(info.name, info.meaning, info.decided));
    return rows;
  });
  py::class_<PyScenario>(m, "Scenario")
      .def(py::init(&load_scenario), py::arg("path"), py::arg("text"), py::arg("changes"), py::arg("controllers"))
      .def_readonly("warnings", &PyScenario::warnings)
      .def_property_readonly("name", [](const PyScenario& s) { return s.configuration.scenario.name; })
      .def_property_readonly("algorithm",
                             [](const PyScenario& s) { return s.configuration.scenario.mission.algorithm; })
      .def_property_readonly("seed", [](const PyScenario& s) { return s.configuration.scenario.seed; })
      .def_property_readonly("tick_s", [](const PyScenario& s) { return s.configuration.scenario.tick_s; })
      .def_property_readonly("time_limit_s",
                             [](const PyScenario& s) { return world::time_limit_s(s.configuration.scenario); })
      .def_property_readonly("robots", [](const PyScenario& s) { return world::robot_count(s.configuration.scenario); })
      .def_property_readonly("wheel_limit_m_s",
                             [](const PyScenario& s) { return s.configuration.scenario.robot.wheel_limit_m_s; })
      .def_property_readonly("wheel_distance_m",
                             [](const PyScenario& s) { return world::wheel_distance_m(s.configuration.scenario); })
      .def_property_readonly("range_m", [](const PyScenario& s) { return s.configuration.scenario.radio.range_m; })
      .def_property_readonly("asynchronous",
                             [](const PyScenario& s) { return s.configuration.scenario.clocks.asynchronous; })
      .def_property_readonly(
          "holonomic",
          [](const PyScenario& s) { return s.configuration.scenario.robot.body == world::BodyModel::linear; })
      .def("json", [](const PyScenario& s) { return config::config_json(s.configuration); })
      .def("toml", [](const PyScenario& s) { return config::config_toml(s.configuration); });
}

}  // namespace banyan::python
