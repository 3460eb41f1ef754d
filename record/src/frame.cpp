// SPDX-License-Identifier: MIT
// The one place where record/ looks into a world (frame.hpp).
#include "banyan/record/frame.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "banyan/controller/core/trig.hpp"
#include "banyan/world/obstacles.hpp"
#include "banyan/world/world.hpp"

namespace banyan::record {

namespace {

std::int32_t index_of(RobotId id) noexcept { return id == nobody ? -1 : static_cast<std::int32_t>(id); }

// Lengths in a report are multiples of the radio range.
void capture_robot(const Report& state, double range_m, RobotFrame& robot) noexcept {
  robot.role = state.role;
  robot.phase = state.phase;
  robot.need = state.need;
  robot.spare_state = state.spare_state;
  robot.connected = false;
  robot.epoch = state.epoch;
  robot.label_m = state.label < 0.0F ? -1.0 : range_m * static_cast<double>(state.label);
  robot.depth = state.depth;
  robot.parent = index_of(state.parent);
  robot.old_parent = index_of(state.old_parent);
  robot.grant = index_of(state.grant);
  robot.request = index_of(state.request);
  robot.want_m = range_m * static_cast<double>(state.want);
  robot.target = -1;
}

// A worker names its target by the robot first sent there, which for a successor is another robot.
void capture_targets(const world::World& world, Frame& frame) {
  static thread_local std::vector<std::int32_t> target_of;  // by that robot
  target_of.assign(world.size(), -1);
  frame.targets.clear();
  for (const world::Target& target : world.targets()) {
    const auto worker = target.worker < world.size() ? static_cast<std::int32_t>(target.worker) : -1;
    if (worker >= 0 && target.active) target_of[target.worker] = static_cast<std::int32_t>(frame.targets.size());
    frame.targets.push_back({target.position, worker, target.active});
  }
  for (std::size_t i = 0; i < frame.robots.size(); ++i) {
    const Report& state = world.reports()[i];
    if (state.serves < world.size()) frame.robots[i].target = target_of[state.serves];
  }
}

// During a hand-over there may be two; the newer token decides.
std::optional<std::uint32_t> newest_root(const world::World& world) noexcept {
  std::optional<std::uint32_t> root;
  for (std::uint32_t i = 0; i < world.size(); ++i) {
    const Report& state = world.reports()[i];
    if (world.alive()[i] == 0 || state.role != Role::root) continue;
    if (!root || has_newer_root(state, world.reports()[*root])) root = i;
  }
  return root;
}

void mark_connected(const world::World& world, std::vector<RobotFrame>& robots) {
  const auto root = newest_root(world);
  if (!root) return;
  static thread_local std::vector<std::uint32_t> queue;  // kept: this runs at every tick
  queue.assign(1, *root);
  robots[*root].connected = true;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    for (const std::uint32_t j : world.links(queue[head])) {
      if (robots[j].connected) continue;
      robots[j].connected = true;
      queue.push_back(j);
    }
  }
}

}  // namespace

void capture(const world::World& world, Frame& frame) {
  frame.tick = world.tick();
  frame.time_s = world.time_s();
  frame.robots.resize(world.arrived());
  for (std::size_t i = 0; i < frame.robots.size(); ++i) {
    RobotFrame& robot = frame.robots[i];
    robot.position = world.positions()[i];
    robot.heading_rad = angle_of(world.headings()[i]);
    robot.alive = world.alive()[i] != 0;
    robot.spent = world.charge().empty() ? 0.0 : 1.0 - world.charge()[i];
    robot.raised = i < world.raised().size() && world.raised()[i] != 0;
    capture_robot(world.reports()[i], world.scenario().radio.range_m, robot);
  }
  mark_connected(world, frame.robots);
  capture_targets(world, frame);
}

Frame between(const Frame& a, const Frame& b, double time_s) {
  if (!(time_s > a.time_s)) return a;
  if (!(time_s < b.time_s)) return b;
  const double share = (time_s - a.time_s) / (b.time_s - a.time_s);
  const auto on_line = [share](Vec2 from, Vec2 to) { return from + share * (to - from); };
  Frame frame = a;
  frame.time_s = time_s;
  for (std::size_t i = 0; i < std::min(a.robots.size(), b.robots.size()); ++i) {
    RobotFrame& robot = frame.robots[i];
    robot.position = on_line(a.robots[i].position, b.robots[i].position);
    const double turn = std::remainder(b.robots[i].heading_rad - robot.heading_rad, 2.0 * std::numbers::pi);
    robot.heading_rad = std::remainder(robot.heading_rad + share * turn, 2.0 * std::numbers::pi);
  }
  for (std::size_t k = 0; k < std::min(a.targets.size(), b.targets.size()); ++k) {
    frame.targets[k].position = on_line(a.targets[k].position, b.targets[k].position);
  }
  return frame;
}

Setting setting_of(const world::World& world) {
  const world::Scenario& scenario = world.scenario();
  Setting setting;
  setting.name = scenario.name;
  setting.algorithm = scenario.mission.algorithm;
  setting.reading = scenario.mission.reading;
  setting.seed = scenario.seed;
  setting.tick_s = scenario.tick_s;
  setting.radius_m = scenario.robot.radius_m;
  setting.range_m = scenario.radio.range_m;
  setting.line_of_sight = world.line_of_sight();
  setting.sight_leak = scenario.radio.sight_leak;
  setting.dead_bodies = scenario.robot.dead_bodies;
  setting.target_tolerance_m = world::target_tolerance_m(scenario);
  setting.time_limit_s = world::time_limit_s(scenario);
  setting.names.assign(world.names().begin(), world.names().end());
  setting.obstacles.assign(world.obstacles().begin(), world.obstacles().end());
  return setting;
}

bool still_holds(const Setting& setting, const world::World& world) noexcept {
  return setting.line_of_sight == world.line_of_sight() &&
         std::equal(setting.names.begin(), setting.names.end(), world.names().begin(), world.names().end()) &&
         std::equal(setting.obstacles.begin(), setting.obstacles.end(), world.obstacles().begin(),
                    world.obstacles().end());
}

std::string_view name_of(Role role) noexcept {
  switch (role) {
    case Role::spare: return "spare";
    case Role::connector: return "connector";
    case Role::worker: return "worker";
    case Role::root: return "root";
  }
  return "?";
}

std::string_view name_of(Phase phase) noexcept {
  switch (phase) {
    case Phase::init: return "init";
    case Phase::start_tree: return "start_tree";
    case Phase::select_parent: return "select_parent";
    case Phase::grow_tree: return "grow_tree";
    case Phase::select_root: return "select_root";
  }
  return "?";
}

std::string_view name_of(Need need) noexcept {
  switch (need) {
    case Need::no_need: return "no_need";
    case Need::need: return "need";
    case Need::await: return "await";
  }
  return "?";
}

std::string_view name_of(SpareState state) noexcept {
  switch (state) {
    case SpareState::wait: return "wait";
    case SpareState::extend_edge: return "extend_edge";
    case SpareState::adjust_position: return "adjust_position";
  }
  return "?";
}

}  // namespace banyan::record
