// SPDX-License-Identifier: MIT
// Writes an .argos file for a scenario: what `argos3 -c` runs. Needs no ARGoS.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "banyan/world/scenario.hpp"

namespace banyan::argos {

// A robot of ARGoS that can do it: range and bearing, two wheels, positioning.
struct RobotKind {
  std::string_view entity;     // "kheperaiv"
  std::string_view proximity;  // its proximity sensor
  double radius_m;
  double wheel_distance_m;
};
[[nodiscard]] std::span<const RobotKind> robot_kinds() noexcept;
[[nodiscard]] const RobotKind* find_robot_kind(std::string_view entity) noexcept;

// Which lines of sight are free: ARGoS' own answer, or geometry's.
enum class Sight : unsigned char { stock, exact };
// Who sees obstacles: the robots' proximity sensors, or the world for them, up to robot.proximity_m.
enum class Eyes : unsigned char { sensors, world };

struct Experiment {
  std::string made_by;  // for the comment at the top: a command line
  std::string world;    // the scenario's file. These three paths should be absolute: ARGoS is started anywhere
  std::string out;      // directory of the results
  std::string library;  // libbanyan_argos, or its name alone if ARGOS_PLUGIN_PATH leads to it
  const RobotKind* robot = nullptr;
  Sight sight = Sight::stock;
  Eyes eyes = Eyes::sensors;
  bool force = false;  // results may replace others
};

// The scenario with a robot of that kind: its radius and wheel distance.
[[nodiscard]] world::Scenario with_robot(world::Scenario scenario, const RobotKind& kind);

// Of a scenario without faults that ARGoS can do (mission.hpp), made for experiment.robot.
[[nodiscard]] std::string experiment_xml(const world::Scenario& scenario, const Experiment& experiment);

}  // namespace banyan::argos
