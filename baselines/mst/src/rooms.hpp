// SPDX-License-Identifier: MIT
// The parts of a step of MST preservation, in their order.
#pragma once

#include "banyan/baselines/mst/mst.hpp"

namespace banyan::baselines::mst {

// A robot within its step.
struct Robot {
  const Params& params;
  State& self;
  int elapsed_ticks;

  [[nodiscard]] const Table<Message>& table() const noexcept { return self.neighbors; }
  // Null for `nobody` and for robots not heard.
  [[nodiscard]] const Message* said_by(RobotId id) const noexcept {
    const int k = table().find(id);
    return k < 0 ? nullptr : &table().message(k);
  }
};

// epoch.cpp: is a new tree wanted, and does its construction begin now?
void follow_epoch(Robot& robot) noexcept;
// construction.cpp
void begin_construction(Robot& robot) noexcept;
void construct(Robot& robot) noexcept;
// The link to neighbour k may become an edge: it is kept, or short enough, and both ends have room for it.
[[nodiscard]] bool may_be_edge(const Robot& robot, int k) noexcept;
void drop_old_edges(Robot& robot) noexcept;

}  // namespace banyan::baselines::mst
