// SPDX-License-Identifier: MIT
// START TREE: the distance to the root along hops, and the echo by which the
// root learns that all robots have one (protocol 4, 5).
#pragma once

#include "tree/robot.hpp"

namespace banyan {

void update_label(TreeRobot& robot) noexcept;

// Length of an edge in the label's unit, 1 / per_range of C; at least 1, so that a label grows along every edge.
[[nodiscard]] std::uint16_t edge_label(float range) noexcept;
// label + edge, saturating below unknown_label.
[[nodiscard]] std::uint16_t label_below(std::uint16_t label, float range) noexcept;

}  // namespace banyan
