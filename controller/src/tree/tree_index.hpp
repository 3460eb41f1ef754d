// SPDX-License-Identifier: MIT
// One pass over the neighbour table that finds the tree neighbours (robot.hpp).
#pragma once

#include "tree/robot.hpp"

namespace banyan {

void index_neighbors(TreeRobot& robot) noexcept;

// spare, connector, worker or root (protocol 3), from the index. A robot that turns spare leaves the tree,
// unless spares still have it as parent.
void update_role(TreeRobot& robot) noexcept;

}  // namespace banyan
