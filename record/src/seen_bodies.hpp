// SPDX-License-Identifier: MIT
// The robots of a frame as the world's radio wants them.
#pragma once

#include <cstdint>
#include <vector>

#include "banyan/record/frame.hpp"
#include "banyan/world/sight.hpp"

namespace banyan::record {

struct SeenBodies {
  explicit SeenBodies(const Frame& frame) {
    for (const RobotFrame& robot : frame.robots) {
      positions.push_back(robot.position);
      alive.push_back(robot.alive ? 1 : 0);
      raised.push_back(robot.raised ? 1 : 0);
    }
  }
  // Refers to this and to the setting.
  [[nodiscard]] world::Scene scene(const Setting& s) const {
    return {positions, alive, raised, s.obstacles, s.range_m, s.radius_m, s.line_of_sight, s.dead_bodies};
  }
  std::vector<Vec2> positions;
  std::vector<std::uint8_t> alive, raised;
};

}  // namespace banyan::record
