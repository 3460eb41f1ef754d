// SPDX-License-Identifier: MIT
#include "tracked_bodies.hpp"

#include "banyan/controller/core/trig.hpp"

namespace banyan::cli {
namespace {

class TrackedBodies final : public world::Bodies {
 public:
  explicit TrackedBodies(SeenPoses seen) noexcept : seen_(seen) {}
  [[nodiscard]] std::unique_ptr<world::Bodies> clone() const override { return std::make_unique<TrackedBodies>(seen_); }

  void step(std::span<const Velocity> /*command*/, world::NearPairs /*near*/, std::uint64_t /*tick*/,
            world::Poses& poses, std::span<Odometry> odometry) override {
    const SeenPoses seen = seen_;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (!seen[i]) continue;
      const world::Vec2 heading = unit_vector(seen[i]->heading_rad);
      const world::Vec2 shift = rotate_back(poses.heading[i], seen[i]->position - poses.position[i]);
      const double turn_rad = angle_of(rotate_back(poses.heading[i], heading));
      odometry[i] = {static_cast<float>(shift.x), static_cast<float>(shift.y), static_cast<float>(turn_rad)};
      poses.position[i] = seen[i]->position;
      poses.heading[i] = heading;
    }
  }
  void set_obstacles(std::span<const world::Obstacle> /*obstacles*/) override {}
  [[nodiscard]] std::uint64_t hash(std::uint64_t h) const noexcept override { return h; }

 private:
  SeenPoses seen_;
};

}  // namespace

std::unique_ptr<world::Bodies> tracked_bodies(SeenPoses seen) { return std::make_unique<TrackedBodies>(seen); }

world::Scenario started_where_seen(world::Scenario scenario, SeenPoses seen) {
  world::Start& start = scenario.swarm.start;
  start = {};
  start.layout = world::Layout::list;
  start.jitter_m = 0.0;
  for (const auto& pose : seen) {
    start.positions.push_back(pose->position);
    start.headings_rad.push_back(angle_of(unit_vector(pose->heading_rad)));  // trackers may count whole turns
  }
  return scenario;
}

}  // namespace banyan::cli
