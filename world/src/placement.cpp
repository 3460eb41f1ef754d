// SPDX-License-Identifier: MIT
// Robots stand at the points of their layout (start_layout.hpp), each a little off, in a random heading.
#include "banyan/world/placement.hpp"

#include <algorithm>
#include <cmath>

#include "banyan/controller/core/trig.hpp"
#include "banyan/world/obstacles.hpp"
#include "banyan/world/random.hpp"
#include "banyan/world/world.hpp"
#include "start_layout.hpp"

namespace banyan::world {
namespace {

// Uniform in a disc.
Vec2 jitter(std::uint64_t seed, std::size_t robot, double radius) noexcept {
  const double r = radius * std::sqrt(to_uniform(bits(seed, Purpose::placement, robot, 0)));
  return r * unit_vector(2.0 * pi<double> * to_uniform(bits(seed, Purpose::placement, robot, 1)));
}

Vec2 random_heading(std::uint64_t seed, std::size_t robot) noexcept {
  return unit_vector(2.0 * pi<double> * to_uniform(bits(seed, Purpose::heading, robot)));
}

std::size_t nearest_robot(const Poses& poses, const std::vector<std::uint8_t>& taken, Vec2 target) noexcept {
  std::size_t best = taken.size();
  double best2 = 0.0;
  for (std::size_t i = 0; i < taken.size(); ++i) {
    const double d2 = squared_norm(poses.position[i] - target);
    if (!taken[i] && (best == taken.size() || d2 < best2)) {
      best = i;
      best2 = d2;
    }
  }
  return best;
}

}  // namespace

Poses place(const Scenario& scenario) {
  const Start& start = scenario.swarm.start;
  const bool list = start.layout == Layout::list;
  const bool exact = list || start.layout == Layout::random;
  Poses poses;
  poses.position = list ? start.positions : start_points(scenario);
  poses.heading.reserve(poses.position.size());
  for (std::size_t i = 0; i < poses.position.size(); ++i) {
    if (!exact) poses.position[i] += jitter(scenario.seed, i, start_jitter_m(scenario));
    const bool given = list && i < start.headings_rad.size();
    poses.heading.push_back(given ? unit_vector(start.headings_rad[i]) : random_heading(scenario.seed, i));
  }
  return poses;
}

Poses place_all(const Scenario& scenario) {
  constexpr double outside = 300.0, apart = 4.0;  // C; all that a scenario names lies within 200
  Poses poses = place(scenario);
  for (const Station& station : scenario.stations) {
    poses.position.push_back(station.position);
    poses.heading.push_back({1.0, 0.0});
  }
  const std::size_t first = poses.position.size(), places = place_count(scenario);
  for (std::size_t i = first; i < places; ++i) {
    const double along = outside + apart * static_cast<double>(i - first);
    poses.position.push_back(scenario.swarm.start.center - scenario.radio.range_m * Vec2{outside, along});
    poses.heading.push_back(random_heading(scenario.seed, i));
  }
  return poses;
}

Assignment assign(const Scenario& scenario, const Poses& poses, const std::vector<Vec2>& targets) {
  const std::size_t n = std::min(poses.position.size(), free_robot_count(scenario));
  Assignment result;
  std::vector<std::uint8_t> taken(n, 0);
  std::optional<std::size_t> root = scenario.swarm.root;
  std::vector<std::size_t> stations;  // that hold a place
  for (std::size_t s = 0; s < scenario.stations.size(); ++s)
    if (scenario.stations[s].root) root = n + s;
    else stations.push_back(n + s);
  if (root && *root < n) taken[*root] = 1;
  for (std::size_t t = 0; t + stations.size() < targets.size(); ++t) {
    const std::size_t worker = nearest_robot(poses, taken, targets[t]);
    taken[worker] = 1;
    result.worker.push_back(worker);
  }
  const std::size_t others = n - result.worker.size();
  result.worker.insert(result.worker.end(), stations.begin(), stations.end());
  if (root) {
    result.root = *root;
    return result;
  }
  auto draw = static_cast<std::size_t>(to_uniform(bits(scenario.seed, Purpose::root, 0)) * static_cast<double>(others));
  for (std::size_t i = 0; i < n; ++i) {
    if (taken[i]) continue;
    result.root = i;
    if (draw-- == 0) break;
  }
  return result;
}

std::optional<Vec2> free_place(const World& world) {
  constexpr int directions = 12;
  constexpr double slack = 0.99;
  const double pitch_m = start_pitch_m(world.scenario()), radius_m = world.scenario().robot.radius_m;
  const auto positions = world.positions().first(world.arrived());
  const auto is_free = [&](Vec2 here, Vec2 p) {
    for (const Vec2 other : positions)
      if (distance(other, p) < slack * pitch_m) return false;
    const auto hides = [&](const Obstacle& o) { return blocks(o, here, p); };
    return clearance(world.obstacles(), p) > radius_m &&
           std::none_of(world.obstacles().begin(), world.obstacles().end(), hides);
  };
  for (const bool spare : {true, false})
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (world.alive()[i] == 0 || (world.reports()[i].role == Role::spare) != spare) continue;
      for (int k = 0; k < directions; ++k) {
        const Vec2 p = positions[i] + pitch_m * unit_vector(2.0 * pi<double> * k / directions);
        if (is_free(positions[i], p)) return p;
      }
    }
  return std::nullopt;
}

}  // namespace banyan::world
