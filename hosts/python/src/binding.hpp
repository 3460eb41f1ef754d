// SPDX-License-Identifier: MIT
// What the files of the extension module have in common: Python on one side, the rooms of the house on the other.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "banyan/config/config.hpp"
#include "banyan/controller/core/printable.hpp"
#include "banyan/hosts/python/outside_swarm.hpp"
#include "banyan/measure/metrics.hpp"
#include "banyan/record/table.hpp"

namespace banyan::python {

namespace py = pybind11;

// A scenario that cannot be: ScenarioError in Python, all problems in its text.
class ScenarioFault : public std::runtime_error {
 public:
  explicit ScenarioFault(const std::string& text) : std::runtime_error(printable_lines(text)) {}
};

// A Python object that C++ may keep, copy and drop without holding the interpreter.
class Held {
 public:
  explicit Held(py::object object)
      : object_(new py::object(std::move(object)), [](py::object* o) {
          const py::gil_scoped_acquire interpreter;
          delete o;
        }) {}
  [[nodiscard]] const py::object& get() const noexcept { return *object_; }

 private:
  std::shared_ptr<py::object> object_;
};

// The algorithms of a scenario: Banyan's and those written in Python.
struct Algorithms {
  explicit Algorithms(std::vector<std::unique_ptr<OutsideAlgorithm>> of_user);
  std::vector<std::unique_ptr<OutsideAlgorithm>> own;
  AlgorithmList list;
};
// Each of `own` is (name, summary, neighbours, payload, floats, beneath, make, fingerprint): make(facts) gives the
// object that decides, with decide(arrays) and clone().
[[nodiscard]] std::shared_ptr<const Algorithms> algorithms_from(const py::sequence& own);
// Changes of a scenario or a study: a key and its value as TOML, or "" and a file.
[[nodiscard]] std::vector<config::Override> overrides_of(
    const std::vector<std::pair<std::string, std::string>>& changes);
// Banyan's alone.
[[nodiscard]] std::shared_ptr<const Algorithms> shipped_algorithms();

struct PyScenario {
  config::Configuration configuration;
  std::shared_ptr<const Algorithms> algorithms;  // configuration.scenario refers to them
  std::vector<std::string> warnings;
};

// Asks now and then whether Ctrl-C was pressed, from code that does not hold the interpreter. The main thread alone
// hears of it.
class CtrlC {
 public:
  // Throws what Python raised, KeyboardInterrupt.
  void check() {
    const auto now = Clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(50);
    const py::gil_scoped_acquire interpreter;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point next_ = Clock::now() + std::chrono::milliseconds(50);
};

// One thread at a time: a second one, or a controller that steps its own world, is refused.
class Busy {
 public:
  Busy(std::atomic<bool>& flag, const char* what) : flag_(flag) {
    if (flag_.exchange(true))
      throw std::runtime_error(std::string(what) + " is being stepped, by another thread or from within a controller");
  }
  ~Busy() { flag_ = false; }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

 private:
  std::atomic<bool>& flag_;
};

// Memory of `owner` as an array that keeps it alive and cannot be written.
[[nodiscard]] py::array view_of(const py::dtype& type, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
                                const void* data, const py::handle& owner, bool writeable = false);
// A vector that numpy takes over.
template <class T> [[nodiscard]] py::array_t<T> taken(std::vector<T> values, std::vector<py::ssize_t> shape) {
  auto* const kept = new std::vector<T>(std::move(values));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return py::array_t<T>(std::move(shape), kept->data(), owner);
}
// All fields of a block by name; with many swarms, or `always`, their number is the first axis.
[[nodiscard]] py::dict arrays_of(const std::shared_ptr<Block>& block, bool always);

[[nodiscard]] py::object object_of(const record::Cell& cell);
template <class Columns, class Row> [[nodiscard]] py::dict row_of(const Columns& columns, const Row& row) {
  py::dict dict;
  for (const auto& column : columns) dict[py::str(std::string(column.name))] = object_of(column.cell(row));
  return dict;
}
[[nodiscard]] py::dict table_of(std::span<const measure::Tick> ticks);

void bind_scenario(py::module_& m);
void bind_world(py::module_& m);
void bind_run(py::module_& m);
void bind_recording(py::module_& m);
void bind_study(py::module_& m);
void bind_lockstep(py::module_& m);

}  // namespace banyan::python
