// SPDX-License-Identifier: MIT
// One instant as a picture and as numbers.
#pragma once

#include "banyan/record/draw.hpp"
#include "binding.hpp"

namespace banyan::python {

struct PyFrame {
  record::Setting setting;
  record::Frame frame;
  record::Trails trails;
};

[[nodiscard]] std::string svg_of(const PyFrame& frame, const py::kwargs& look);

}  // namespace banyan::python
