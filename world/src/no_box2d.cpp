// SPDX-License-Identifier: MIT
// Stands in for box2d.cpp where there is no Box2D: faults() refuses the body model before any of
// this is called.
#include <stdexcept>

#include "banyan/world/bodies.hpp"

namespace banyan::world {

bool has_box2d() noexcept { return false; }

double least_side_in_box2d_m(const Box&) noexcept { return 0.0; }

std::unique_ptr<Bodies> make_box2d(const Scenario&, const Poses&) {
  throw std::logic_error("this program was built without Box2D");
}

}  // namespace banyan::world
