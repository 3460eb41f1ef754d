// SPDX-License-Identifier: MIT
// banyan._core: the part of `import banyan` that is C++. Python's part, in hosts/python/banyan, is what users call.
#include "banyan/record/file.hpp"
#include "banyan/version.hpp"
#include "binding.hpp"

PYBIND11_MODULE(_core, m) {
  namespace py = pybind11;
  namespace house = banyan::python;
  m.doc() = "What banyan is made of; call it through the package.";
  m.attr("version") = std::string(banyan::version);
  m.attr("git_id") = std::string(banyan::git_id());
  py::register_exception<house::ScenarioFault>(m, "ScenarioError", PyExc_ValueError);
  py::register_exception<banyan::record::FileError>(m, "FileError", PyExc_OSError);
  house::bind_scenario(m);
  house::bind_recording(m);
  house::bind_world(m);
  house::bind_run(m);
  house::bind_study(m);
  house::bind_lockstep(m);
}
