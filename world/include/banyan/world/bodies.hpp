// SPDX-License-Identifier: MIT
// How robots move: one interface, three models. `disks` is the fast, reproducible default,
// `box2d` the independent check with mass and force limits, `linear` the paper's Sec. II-A.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "banyan/controller/core/inputs.hpp"
#include "banyan/world/scenario.hpp"

namespace banyan::world {

// Where the robots are: structure of arrays, one entry per robot, dead ones included.
struct Poses {
  std::vector<Vec2> position;
  std::vector<Vec2> heading;  // unit vectors
};

// Robots so near to each other that they could touch within the next tick: i < j, ascending. The
// radio phase finds them on its way (distance < 2 1/7 radius + 4 wheel_limit tick).
using NearPairs = std::span<const std::pair<std::uint32_t, std::uint32_t>>;

class Bodies {
 public:
  virtual ~Bodies() = default;
  [[nodiscard]] virtual std::unique_ptr<Bodies> clone() const = 0;
  // Advances all robots by one tick. `command`: one per robot, zero for dead and frozen ones
  // (noise is the model's own, drawn by (seed, robot, tick)). Writes `poses` and what each robot's
  // odometry measures: the motion of its wheels, not a push by a neighbour.
  virtual void step(std::span<const Velocity> command, NearPairs near, std::uint64_t tick, Poses& poses,
                    std::span<Odometry> odometry) = 0;
  // From now on robot i has no body and touches no other. Its command stays zero.
  virtual void remove(std::size_t) {}  // where contacts are only those of `near` there is nothing to do
  // From now on robot i has a body, which stands where its pose is: it has just been put there.
  virtual void arrive(std::size_t) {}  // where poses are all there is there is nothing to do
  // From the next step on these are the obstacles. A robot that is then inside one is pushed out of it.
  virtual void set_obstacles(std::span<const Obstacle> obstacles) = 0;
  // Adds what the model remembers beside the poses (velocities) to a running hash.
  [[nodiscard]] virtual std::uint64_t hash(std::uint64_t h) const noexcept = 0;
};

// One factory per model. All of scenario.robot, .obstacles, .tick_s and .seed count.
[[nodiscard]] std::unique_ptr<Bodies> make_disks(const Scenario& scenario, std::size_t robots);
[[nodiscard]] std::unique_ptr<Bodies> make_box2d(const Scenario& scenario, const Poses& poses);
[[nodiscard]] std::unique_ptr<Bodies> make_linear(const Scenario& scenario, std::size_t robots);
// False in a build without Box2D, such as the browser's: make_box2d() throws there.
[[nodiscard]] bool has_box2d() noexcept;
// The least side that box2d needs this box to have where it is, m: a thinner one would end the program.
[[nodiscard]] double least_side_in_box2d_m(const Box& box) noexcept;

}  // namespace banyan::world
