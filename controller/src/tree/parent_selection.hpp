// SPDX-License-Identifier: MIT
// SELECT PARENT, and keeping a parent afterwards: repair of a silent one, re-attachment of orphans
// (paper Sec. III-D, III-E; protocol 5).
#pragma once

#include "banyan/controller/core/function_ref.hpp"
#include "tree/robot.hpp"

namespace banyan {

// Who joins, and whom. Whether a neighbour is a candidate at all is decided by is_candidate() for every rule: its
// order keeps the tree free of cycles.
struct ParentRule {
  bool may_join;                            // a robot without parent may join the tree now
  FunctionRef<bool(int a, int b)> prefers;  // candidate a is better than candidate b
};

// Candidate parent: alive, same epoch, near enough, label strictly smaller than mine, and ahead of me.
[[nodiscard]] bool is_candidate(const TreeRobot& robot, int k) noexcept;

// Neighbour k's (seqno, label) is ahead of mine: a newer number, or the same and a smaller label. No robot
// ever falls back behind a pair it has sent, and none takes a parent that is not ahead; so the pairs
// strictly rise along every chain of parents, however old the messages are, and no chain can close
// (the feasibility condition of EIGRP and Babel, RFC 8966 sec. 2.4).
[[nodiscard]] bool is_ahead(const TreeRobot& robot, int k) noexcept;

// The pair (seqno, label) flows down the tree: the seqno of neighbour k, and a label above its label.
void keep_up(TreeRobot& robot, int k) noexcept;

// A living child of this epoch that is not a spare names me as its parent.
[[nodiscard]] bool is_named_parent(const TreeRobot& robot) noexcept;

// Chooses a parent if this robot may and needs to, repairs a lost one, re-attaches an orphan, and
// keeps label, depth and hops to the rooted tree consistent with the parent.
void select_parent(TreeRobot& robot, const ParentRule& rule) noexcept;

// The tree edge to `k` of the table becomes this robot's edge to its parent.
void take_parent(TreeRobot& robot, int k) noexcept;

void leave_tree(TreeRobot& robot) noexcept;

// Depth invalid for so long that this robot must not pull its branch any further (protocol 5).
[[nodiscard]] bool is_orphan(const TreeRobot& robot) noexcept;

}  // namespace banyan
