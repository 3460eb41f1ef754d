// SPDX-License-Identifier: MIT
// SELECT PARENT, and keeping a parent afterwards: repair of a silent one, re-attachment of orphans
// (paper Sec. III-D, III-E; spec 5).
#pragma once

#include "banyan/controller/robot.hpp"

namespace banyan {

// Candidate parent: alive, no worker, same epoch, near enough, label strictly smaller than mine.
// The strict order of labels is what makes cycles impossible.
[[nodiscard]] bool is_candidate(const Robot& robot, int k) noexcept;

// A living child of this epoch that is no spare names me as its parent.
[[nodiscard]] bool is_named_parent(const Robot& robot) noexcept;

// Chooses a parent if this robot may and needs to, repairs a lost one, re-attaches an orphan, and
// keeps label, depth and hops to the rooted tree consistent with the parent.
void select_parent(Robot& robot) noexcept;

// The tree edge to `k` of the table becomes this robot's edge to its parent.
void take_parent(Robot& robot, int k) noexcept;

void leave_tree(Robot& robot) noexcept;

// Depth invalid for so long that this robot must not pull its branch any further (spec 5).
[[nodiscard]] bool is_orphan(const Robot& robot) noexcept;

}  // namespace banyan
