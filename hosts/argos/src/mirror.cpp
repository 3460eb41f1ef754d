// SPDX-License-Identifier: MIT
#include "banyan/hosts/argos/mirror.hpp"

#include <utility>

#include "banyan/controller/core/elsewhere.hpp"
#include "banyan/controller/core/trig.hpp"

namespace banyan::argos {
namespace {

class MirroredBodies final : public world::Bodies {
 public:
  explicit MirroredBodies(const MirroredRobots& robots) noexcept : robots_(robots) {}
  [[nodiscard]] std::unique_ptr<world::Bodies> clone() const override {
    return std::make_unique<MirroredBodies>(robots_);
  }
  void step(std::span<const Velocity> /*command*/, world::NearPairs /*near*/, std::uint64_t /*tick*/,
            world::Poses& poses, std::span<Odometry> odometry) override {
    for (std::size_t i = 0; i < odometry.size(); ++i) {
      const Pose now = robots_.pose(i);
      const world::Vec2 heading = unit_vector(now.heading_rad);
      const world::Vec2 shift = rotate_back(poses.heading[i], now.position - poses.position[i]);
      odometry[i] = {static_cast<float>(shift.x), static_cast<float>(shift.y),
                     static_cast<float>(angle_of(rotate_back(poses.heading[i], heading)))};
      poses.position[i] = now.position;
      poses.heading[i] = heading;
    }
  }
  void set_obstacles(std::span<const world::Obstacle> /*obstacles*/) override {}
  [[nodiscard]] std::uint64_t hash(std::uint64_t h) const noexcept override { return h; }

 private:
  const MirroredRobots& robots_;
};

class MirrorSwarm final : public SwarmElsewhere {
 public:
  MirrorSwarm(std::unique_ptr<Swarm> local, MirroredRobots& robots)
      : SwarmElsewhere(std::move(local)), robots_(&robots) {}
  MirrorSwarm(const MirrorSwarm& other) : SwarmElsewhere(other) {}
  MirrorSwarm& operator=(const MirrorSwarm&) = delete;
  // A clone stays as it is: nobody lives in it.
  [[nodiscard]] std::unique_ptr<Swarm> clone() const override { return std::make_unique<MirrorSwarm>(*this); }

  void step(std::size_t first, std::span<const Sensed> sensed, std::span<Velocity> commands,
            std::span<Report> reports) override {
    for (std::size_t k = 0; k < sensed.size(); ++k) {
      const Orders& orders = sensed[k].senses.orders;
      Told told;
      told.alive = sensed[k].steps;
      if (told.alive) {
        hear(first + k, commands[k]);
        reports[k] = report(first + k);
        told.sent = orders.sent;
        told.given_up = orders.given_up;
        told.obstacles = sensed[k].senses.obstacles;
      }
      if (robots_ != nullptr) robots_->tell(first + k, told);
    }
  }
  void advance() noexcept override { end_taking(); }
  void set_line_of_sight(bool /*on*/) noexcept override {}

 private:
  void hear(std::size_t i, Velocity& command) {
    if (robots_ == nullptr) return;
    const Said said = robots_->said(i);
    command = said.velocity;
    take(i, said.report);
    take(i, said.message);  // none before its first step
  }

  MirroredRobots* robots_ = nullptr;  // null: a clone
};

}  // namespace

std::unique_ptr<world::Bodies> mirrored_bodies(const MirroredRobots& robots) {
  return std::make_unique<MirroredBodies>(robots);
}

std::unique_ptr<Swarm> mirrored_swarm(std::unique_ptr<Swarm> local, MirroredRobots& robots) {
  return std::make_unique<MirrorSwarm>(std::move(local), robots);
}

}  // namespace banyan::argos
