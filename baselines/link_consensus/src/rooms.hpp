// SPDX-License-Identifier: MIT
// The parts of a step of link consensus, in their order.
#pragma once

#include "banyan/baselines/link_consensus/link_consensus.hpp"

namespace banyan::baselines::link_consensus {

inline constexpr int alone_ticks = 10;  // a robot without a root for so long is cut off

// A robot within its step.
struct Robot {
  const Params& params;
  State& self;
  int elapsed_ticks;  // 0 if it steps more often than once a tick
  int step_ticks;     // the length of the step, at least one

  [[nodiscard]] const Table<Message>& table() const noexcept { return self.neighbors; }
};

// root.cpp: is there a root, and which neighbour is the next hop to it?
void follow_root(Robot& robot) noexcept;
// links.cpp: links that are gone, and new ones.
void renew_links(Robot& robot) noexcept;
// agreement.cpp: vouch for bids, answer them, make my own.
void agree(Robot& robot) noexcept;
// Whether there is a link to neighbour k: kept by me, listed by it.
[[nodiscard]] inline bool is_kept(const Robot& robot, int k) noexcept {
  return robot.self.links.keeps(robot.table().id(k)) && lists(robot.table().message(k), robot.self.id);
}
// Whether it is also not about to be given up.
[[nodiscard]] bool is_open(const Robot& robot, int k) noexcept;
// links.cpp: the ends of the link to neighbour k have a neighbour that is nearer to both, over kept links.
[[nodiscard]] bool is_detoured(const Robot& robot, int k) noexcept;

}  // namespace banyan::baselines::link_consensus
