// SPDX-License-Identifier: MIT
// The proximity sensor: the nearest point on the surface of each obstacle within reach, of a map that in each eighth of
// the plane around the robot. Dead robots
// that stay are sensed, living ones are not, since they can be heard.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "banyan/world/bodies.hpp"
#include "banyan/world/scenario.hpp"

namespace banyan::world {

class Proximity {
 public:
  static constexpr std::size_t capacity = 8;  // what is farther than the nearest eight goes unseen
  using Seen = std::array<banyan::Vec2, capacity>;

  // Reach: proximity_m(scenario) from the robot's centre to the nearest point of a surface.
  explicit Proximity(const Scenario& scenario);

  // From now on these are the obstacles.
  void set_obstacles(std::span<const Obstacle> obstacles);
  // Where the dead lie now. O(dead log dead), nothing while all live or the dead vanish.
  void update(std::span<const Vec2> positions, std::span<const std::uint8_t> alive, std::size_t dead);
  // What robot i sees, in its body frame, m: ascending by distance; at equal distance obstacles before
  // bodies, each in their order. Returns how many of `seen` are valid. O(obstacles + log dead).
  std::size_t sense(const Poses& poses, std::size_t i, Seen& seen) const noexcept;

 private:
  struct Around {
    Vec2 center;
    double radius_m;
  };  // a disc that holds the obstacle
  struct Body {
    Vec2 position;
    std::uint32_t index;
  };
  class Nearest;
  void see_map(const FloorMap& map, Vec2 here, std::size_t index, Nearest& nearest) const noexcept;

  double reach_m_;
  double radius_m_;
  bool sees_dead_;
  std::vector<Obstacle> obstacles_;
  std::vector<Around> around_;  // of each obstacle
  std::vector<Body> dead_;      // by x
};

}  // namespace banyan::world
