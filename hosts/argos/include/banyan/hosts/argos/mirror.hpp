// SPDX-License-Identifier: MIT
// A world whose robots live in another simulator, so that everything that observes and records a world stays as it is:
// bodies that are where the simulator has them, and a Swarm that says what the robots there have done. The world keeps
// targets, events and deaths, and what it tells its robots is passed on.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "banyan/controller/core/algorithm.hpp"
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

// The algorithm whose robots are there. Both must outlive it. Its swarms step on one thread.
class MirrorAlgorithm final : public AlgorithmElsewhere {
 public:
  MirrorAlgorithm(const Algorithm& real, MirroredRobots& robots) noexcept : AlgorithmElsewhere(real), robots_(robots) {}
  [[nodiscard]] std::unique_ptr<Swarm> make(const Setup& setup, std::span<const Member> members) const override;
  // How the robots begin of which the last swarm was made.
  [[nodiscard]] std::span<const Member> members() const noexcept { return members_; }

 private:
  MirroredRobots& robots_;
  mutable std::vector<Member> members_;
};

}  // namespace banyan::argos
