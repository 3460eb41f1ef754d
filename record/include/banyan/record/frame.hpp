// SPDX-License-Identifier: MIT
// One instant of a world as it is recorded, exported and drawn. The rest of record/ is built on
// this plain value; capture() is the only function that looks into a world.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "banyan/controller/core/report.hpp"
#include "banyan/world/scenario.hpp"

namespace banyan::world {
class World;
}

namespace banyan::record {

using world::Vec2;

struct RobotFrame {
  Vec2 position;             // m
  double heading_rad = 0.0;  // (-pi, pi]
  Role role = Role::spare;
  Phase phase = Phase::init;
  Need need = Need::no_need;
  SpareState spare_state = SpareState::wait;
  bool alive = true;
  bool connected = false;  // alive and in the radio component of the newest living root
  Serial epoch = 0;
  double label_m = -1.0;     // -1: unknown
  std::int32_t depth = 0;    // root 1; 0: not connected to the root by tree edges
  std::int32_t parent = -1;  // robot index, -1: nobody; so are the next three
  std::int32_t old_parent = -1;
  std::int32_t grant = -1;
  std::int32_t request = -1;
  double want_m = 0.0;       // largest remaining worker distance below
  std::int32_t target = -1;  // index of the target that it serves, sent there or in place of another; -1: none
  double spent = 0.0;        // share of its battery that is used up; 0 without batteries
  bool raised = false;       // where sight leaks: its antenna looks over the bodies near it
  friend bool operator==(const RobotFrame&, const RobotFrame&) = default;
};

struct TargetFrame {
  Vec2 position;
  std::int32_t worker = -1;  // robot first sent there, -1: nobody; who serves it now has it as RobotFrame::target
  bool active = true;        // false once it has been given up
  friend bool operator==(const TargetFrame&, const TargetFrame&) = default;
};

struct Frame {
  std::uint64_t tick = 0;
  double time_s = 0.0;
  std::vector<RobotFrame> robots;
  std::vector<TargetFrame> targets;
  friend bool operator==(const Frame&, const Frame&) = default;
};

// What a picture needs beside a frame: mostly the same during a run, but an obstacle can be moved and
// line of sight switched.
struct Setting {
  std::string name;
  std::string algorithm;
  std::string reading;
  std::uint64_t seed = 0;
  double tick_s = 0.1;
  double radius_m = 0.07;
  double range_m = 2.0;
  bool line_of_sight = false;
  double sight_leak = 0.0;  // radio.sight_leak
  bool dead_bodies = true;  // the dead hide what is behind them; false: they vanish
  double target_tolerance_m = 0.2;
  double time_limit_s = 0.0;
  std::vector<std::string> names;  // World::names
  std::vector<world::Obstacle> obstacles;
  friend bool operator==(const Setting&, const Setting&) = default;
};

// The world at `time_s` between two frames of it, `a` the earlier: positions of robots and targets on a
// line, headings by the shorter way, everything else as in `a`. At or outside their times, `a` or `b` itself.
[[nodiscard]] Frame between(const Frame& a, const Frame& b, double time_s);

// Reuses the memory of `frame`. O(robots + links).
void capture(const world::World& world, Frame& frame);
[[nodiscard]] Setting setting_of(const world::World& world);  // as it is now
// Whether setting_of(world) would still be `setting`, which it was before. O(obstacles + names), no allocation.
[[nodiscard]] bool still_holds(const Setting& setting, const world::World& world) noexcept;

// Names as they appear in exports ("connector", "grow_tree", "no_need", "extend_edge").
[[nodiscard]] std::string_view name_of(Role role) noexcept;
[[nodiscard]] std::string_view name_of(Phase phase) noexcept;
[[nodiscard]] std::string_view name_of(Need need) noexcept;
[[nodiscard]] std::string_view name_of(SpareState state) noexcept;

}  // namespace banyan::record
