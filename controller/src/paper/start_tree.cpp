// SPDX-License-Identifier: MIT
// "The START TREE state is triggered by the root, which propagates a signal throughout the robot network. [...] As the
// message propagates throughout the network, the robots estimate their distance from the root. This is possible because
// of situated communication - every robot can estimate a relative vector to each of its immediate neighbors." (paper
// Sec. III-B)
#include "banyan/controller/paper/rules.hpp"

namespace banyan::paper {
namespace {

bool is_labelled(const Robot& robot, int k) noexcept {
  return robot.said(k).epoch == robot.self.epoch && robot.said(k).label != unknown_label;
}

// Fixed once an epoch: if recomputed every tick, motion would leave robots in local minima, with no candidate.
void take_label(Robot& robot) noexcept {
  constexpr int wait_ticks = 2;      // gives nearer labelled neighbours time to be heard
  constexpr int wait_far_ticks = 6;  // if all heard so far are near the edge of the range,
  constexpr float far_off = 0.85F;   // C: the next may be heard any moment
  State& self = robot.self;
  int best = -1;
  std::uint16_t label = unknown_label;
  float nearest = 1.0F;
  for (int k = 0; k < robot.size(); ++k) {
    if (!robot.alive(k) || !is_labelled(robot, k)) continue;
    nearest = std::min(nearest, robot.range(k));
    if (const std::uint16_t l = label_below(robot.said(k).label, robot.range(k)); l < label) label = l, best = k;
  }
  if (best < 0 || self.label_wait_ticks++ < (nearest > far_off ? wait_far_ticks : wait_ticks)) return;
  self.label = label;
  self.flood_parent = robot.said(best).id;
}

// How the root learns that all robots have a label (row m; Chang 1982): a robot is done when all its neighbours have
// one and all those below it in the flood are done. One that fell silent just before may have left.
void echo(Robot& robot) noexcept {
  constexpr int silence_ticks = 4;
  State& self = robot.self;
  std::uint32_t robots = 1;
  std::uint32_t workers = self.is_worker ? 1 : 0;
  self.flood_done = true;
  for (int k = 0; k < robot.size(); ++k) {
    const Message& m = robot.said(k);
    if (robot.self.neighbors.age(k) > silence_ticks) continue;
    const bool is_below = is_labelled(robot, k) && m.flood_parent == self.id;
    if (!is_labelled(robot, k) || (is_below && !m.flood_done)) self.flood_done = false;
    if (!is_below) continue;
    robots += m.flood_robots;
    workers += m.flood_workers;
  }
  self.flood_robots = saturated(robots);
  self.flood_workers = saturated(workers);
}

}  // namespace

std::uint16_t label_below(std::uint16_t label, float range) noexcept {
  constexpr float longest = 60000.0F;
  const auto edge = static_cast<std::uint32_t>(std::clamp(range * per_range + 0.5F, 1.0F, longest));
  return static_cast<std::uint16_t>(std::min<std::uint32_t>(label + edge, largest_label));
}

// "the robots estimate their distance from the root"
void start_tree(Robot& robot) noexcept {
  State& self = robot.self;
  // A root by hand-over keeps its label until the epoch that it opens.
  if (robot.is_root() && self.phase == Phase::start_tree) self.label = 0;
  if (!robot.is_root() && self.phase != Phase::init && self.label == unknown_label) take_label(robot);
  if (self.phase == Phase::start_tree && self.label != unknown_label) echo(robot);
}

}  // namespace banyan::paper
