// SPDX-License-Identifier: MIT
// A world whose robots live in another simulator, so that everything that observes and records a world stays as it is:
// bodies that are where the simulator has them, and a Swarm that says what the robots there have done. The world keeps
// targets, events and deaths, and what it tells its robots is passed on.
#pragma once

#include <memory>

#include "banyan/hosts/argos/robot.hpp"
#include "banyan/world/bodies.hpp"

namespace banyan::argos {

struct Pose {
  BasicVec2<double> position;
  double heading_rad = 0.0;
};

// The robots of the other simulator, by index.
class MirroredRobots {
 public:
  virtual ~MirroredRobots() = default;
  [[nodiscard]] virtual Pose pose(std::size_t i) const = 0;
  [[nodiscard]] virtual Said said(std::size_t i) const = 0;
  // Holds from its next step on; `obstacles` until the next call. The target's place is not filled in.
  virtual void tell(std::size_t i, const Told& told) = 0;

 protected:
  MirroredRobots() = default;
};

// In each tick robots are where they are there. `robots` must outlive it.
[[nodiscard]] std::unique_ptr<world::Bodies> mirrored_bodies(const MirroredRobots& robots);

// A swarm of those robots, of a `local` one, which knows its messages. `robots` must outlive it. It steps on one
// thread.
[[nodiscard]] std::unique_ptr<Swarm> mirrored_swarm(std::unique_ptr<Swarm> local, MirroredRobots& robots);

}  // namespace banyan::argos
