// SPDX-License-Identifier: MIT
#include "tree/label.hpp"

#include <algorithm>

#include "banyan/controller/core/fixed_point.hpp"

namespace banyan {
namespace {

// Whether a neighbour without a label is nearer to me and to neighbour `k` than we two are to each other.
bool somebody_between(const TreeRobot& robot, int k) noexcept {
  const TreeTable& table = robot.table();
  const float range = table.range(k);
  for (int j = 0; j < table.size(); ++j) {
    const TreeStanding& m = table.message(j);
    if (!table.alive(j) || (m.epoch == robot.self.epoch && m.label != unknown_label) || table.range(j) >= range)
      continue;
    if (distance(table.position(j), table.position(k)) < range) return true;
  }
  return false;
}

// Fixed once an epoch: if recomputed every tick, motion would leave robots in local minima, with no candidate.
void take_label(TreeRobot& robot) noexcept {
  constexpr int wait_ticks = 2;  // gives nearer labelled neighbours time to be heard
  TreeState& self = robot.self;
  const TreeTable& table = robot.table();
  int best = -1;
  std::uint16_t best_label = unknown_label;
  for (int k = 0; k < table.size(); ++k) {
    const TreeStanding& m = table.message(k);
    if (!table.alive(k) || m.epoch != self.epoch || m.label == unknown_label) continue;
    const std::uint16_t label = label_below(m.label, table.range(k));
    if (label < best_label) best_label = label, best = k;
  }
  if (best < 0) return;
  if (self.label_wait_ticks++ < wait_ticks && somebody_between(robot, best)) return;
  self.label = best_label;
  self.flood_parent = table.id(best);
}

// Echo (Chang 1982): done when all neighbours have a label and all robots below are done. A robot that fell silent
// just before the epoch opened may have left: waiting for it would delay all robots by I.
constexpr int echo_silence_ticks = 4;

void echo(TreeRobot& robot) noexcept {
  TreeState& self = robot.self;
  const TreeTable& table = robot.table();
  bool done = true;
  std::uint32_t robots = 1;
  std::uint32_t workers = self.is_worker ? 1 : 0;
  for (int k = 0; k < table.size(); ++k) {
    if (table.age(k) > echo_silence_ticks) continue;
    const TreeStanding& m = table.message(k);
    if (m.epoch != self.epoch || m.label == unknown_label) {
      done = false;
    } else if (m.flood_parent == self.id) {
      done = done && m.flood_done;
      robots += m.flood_robots;
      workers += m.flood_workers;
    }
  }
  self.flood_done = done;
  self.flood_robots = saturated(robots);
  self.flood_workers = saturated(workers);
}

}  // namespace

std::uint16_t edge_label(float range) noexcept {
  constexpr float longest = 60000.0F;  // far below the numbers that mean something else
  return static_cast<std::uint16_t>(std::clamp(range * per_range + 0.5F, 1.0F, longest));
}

std::uint16_t label_below(std::uint16_t label, float range) noexcept {
  return static_cast<std::uint16_t>(
      std::min<std::uint32_t>(std::uint32_t{label} + edge_label(range), unknown_label - 1));
}

void update_label(TreeRobot& robot) noexcept {
  TreeState& self = robot.self;
  if (self.phase == Phase::init) return;
  if (robot.is_root()) {
    // A root by hand-over keeps its label until the epoch that it opens.
    if (self.phase == Phase::start_tree) self.label = 0;
  } else if (self.label == unknown_label) {
    take_label(robot);
  }
  if (self.phase == Phase::start_tree && self.label != unknown_label) echo(robot);
}

}  // namespace banyan
