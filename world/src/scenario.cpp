// SPDX-License-Identifier: MIT
// What a scenario stands for: positions, numbers and parameters that follow from what is written.
#include "banyan/world/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "banyan/controller/core/trig.hpp"
#include "banyan/world/obstacles.hpp"
#include "banyan/world/random.hpp"

namespace banyan::world {
namespace {

constexpr double khepera_radius_m = 0.0704;
constexpr double khepera_ranges = 2.0 / khepera_radius_m;  // radii in C = 2 m

struct TargetPositions {
  const Scenario& scenario;
  std::vector<Vec2> operator()(const std::vector<Vec2>& list) const { return list; }
  std::vector<Vec2> operator()(const RingTargets& ring) const {
    std::vector<Vec2> positions;
    for (std::size_t i = 0; i < ring.count; ++i) {
      const double turn = 2.0 * pi<double> * (static_cast<double>(i) / static_cast<double>(ring.count));
      positions.push_back(ring.center + radius_m(ring) * unit_vector(ring.phase_rad + turn));
    }
    return positions;
  }
  std::vector<Vec2> operator()(const RandomTargets& random) const {
    std::vector<Vec2> positions;
    for (std::size_t i = 0; i < random.count; ++i) positions.push_back(draw(random, i));
    return positions;
  }
  template <class Around> [[nodiscard]] double radius_m(const Around& targets) const {
    return targets.radius_m.value_or(1.5 * scenario.radio.range_m);
  }
  // A draw in an obstacle is repeated; when obstacles cover everything, faults() sees the last one.
  [[nodiscard]] Vec2 draw(const RandomTargets& random, std::size_t i) const {
    Vec2 p{};
    for (std::uint64_t attempt = 0; attempt < 1000; ++attempt) {
      const double u = to_uniform(bits(scenario.seed, Purpose::targets, i, 2 * attempt));
      const double v = to_uniform(bits(scenario.seed, Purpose::targets, i, 2 * attempt + 1));
      p = random.center + radius_m(random) * std::sqrt(0.1 + 0.9 * u) * unit_vector(2.0 * pi<double> * v);
      if (clearance(scenario.obstacles, p) >= scenario.robot.radius_m) break;
    }
    return p;
  }
};

// Prim's algorithm: length of the minimum spanning tree, O(T^2), but without a root in the inner loop: 10,000 targets
// take a twentieth of a second.
double spanning_tree_length(const std::vector<Vec2>& points) {
  std::vector<double> gap(points.size(), std::numeric_limits<double>::infinity());
  std::vector<std::uint8_t> done(points.size(), 0);
  double length = 0.0;
  std::size_t next = 0;
  for (std::size_t step = 0; step < points.size(); ++step) {
    const std::size_t last = next;
    done[last] = 1;
    if (step > 0) length += std::sqrt(gap[last]);
    next = points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (done[i]) continue;
      gap[i] = std::min(gap[i], squared_norm(points[i] - points[last]));
      if (next == points.size() || gap[i] < gap[next]) next = i;
    }
  }
  return length;
}

// ceil that tolerates the rounding of sines and divisions.
std::size_t robots_for(double x) noexcept { return static_cast<std::size_t>(std::max(0.0, std::ceil(x - 1e-9))); }

}  // namespace

std::vector<Vec2> mission_targets(const Scenario& scenario) {
  return std::visit(TargetPositions{scenario}, scenario.targets);
}

std::vector<Vec2> target_positions(const Scenario& scenario) {
  std::vector<Vec2> positions = mission_targets(scenario);
  const std::vector<Vec2> charging = held_charging_places(scenario);
  positions.insert(positions.end(), charging.begin(), charging.end());
  for (const Station& station : scenario.stations)
    if (!station.root) positions.push_back(station.position);
  return positions;
}

bool charges(const Scenario& scenario, const Station& station) noexcept {
  const std::vector<Vec2>& places = scenario.battery.places;
  return scenario.battery.on() && station.course.empty() &&
         std::find(places.begin(), places.end(), station.position) != places.end();
}

std::vector<Vec2> held_charging_places(const Scenario& scenario) {
  std::vector<Vec2> places;
  if (!scenario.battery.on()) return places;
  for (const Vec2 place : scenario.battery.places)
    if (std::none_of(scenario.stations.begin(), scenario.stations.end(),
                     [&](const Station& s) { return s.position == place && s.course.empty(); }))
      places.push_back(place);
  return places;
}

double redundancy_edge_m(const Scenario& scenario) noexcept { return 0.7704205 * scenario.radio.range_m; }

std::size_t free_robot_count(const Scenario& scenario) {
  const SwarmModel& swarm = scenario.swarm;
  if (swarm.start.layout == Layout::list) return swarm.start.positions.size();
  if (swarm.robots) return *swarm.robots;
  double length = 0.0;
  const std::vector<Vec2> targets = mission_targets(scenario);
  for (const Vec2 p : targets) length += distance(swarm.start.center, p);
  for (const Station& station : scenario.stations) length += distance(swarm.start.center, station.position);
  const std::size_t places = held_charging_places(scenario).size();
  return std::max(robots_for(swarm.redundancy * length / redundancy_edge_m(scenario)), targets.size() + places + 1);
}

std::size_t robot_count(const Scenario& scenario) { return free_robot_count(scenario) + scenario.stations.size(); }

std::size_t place_count(const Scenario& scenario) {
  std::size_t places = robot_count(scenario) + scenario.swarm.room;
  for (const Event& event : scenario.events)
    if (const auto* join = std::get_if<Join>(&event.action)) places = std::max(places, join->robot + 1);
  return places;
}

double length_scale_m(const Scenario& scenario) noexcept {
  return std::max(scenario.radio.range_m, khepera_ranges * scenario.robot.radius_m);
}

double start_pitch_m(const Scenario& scenario) noexcept {
  const Start& start = scenario.swarm.start;
  if (start.pitch_share) return *start.pitch_share * scenario.radio.range_m;
  return start.pitch_m.value_or(0.16 * length_scale_m(scenario));
}
double start_jitter_m(const Scenario& scenario) noexcept {
  return scenario.swarm.start.jitter_m.value_or(0.01 * length_scale_m(scenario));
}
double target_tolerance_m(const Scenario& scenario) noexcept {
  return scenario.mission.target_tolerance_m.value_or(0.1 * length_scale_m(scenario));
}
double proximity_m(const Scenario& scenario) noexcept {
  return scenario.robot.proximity_m.value_or(0.15 * length_scale_m(scenario));
}
double charging_reach_m(const Scenario& scenario) noexcept {
  return scenario.battery.reach_m.value_or(0.3 * length_scale_m(scenario));
}
double wheel_distance_m(const Scenario& scenario) noexcept {
  return scenario.robot.wheel_distance_m.value_or(0.1054 * (scenario.robot.radius_m / khepera_radius_m));
}
double max_acceleration_m_s2(const Scenario& scenario) noexcept {
  const double fastest = scenario.robot.wheel_limit_m_s;
  return scenario.robot.max_acceleration_m_s2.value_or(50.0 * fastest * (fastest / scenario.radio.range_m));
}

// The most steps of the swarm between composing and hearing a packet: it travels, and waits until its receiver
// steps.
static std::size_t longest_way(const Scenario& scenario) {
  const auto latency = static_cast<std::size_t>(std::max(1, scenario.radio.latency_ticks));
  if (!scenario.clocks.asynchronous) return latency;
  const auto substeps = static_cast<std::size_t>(std::max(1, scenario.clocks.substeps));
  const double slowest = std::max(1.0 - scenario.clocks.drift, 1e-3);
  return (latency - 1) * substeps + static_cast<std::size_t>(std::ceil(static_cast<double>(substeps) / slowest)) + 2;
}

double drive_s(const Scenario& scenario) noexcept { return scenario.radio.range_m / scenario.robot.wheel_limit_m_s; }

double time_rounding_s(const Scenario& scenario) noexcept { return 1e-8 * scenario.tick_s; }

double time_limit_s(const Scenario& scenario) {
  if (scenario.mission.time_limit_s > 0.0) return scenario.mission.time_limit_s;
  double farthest = 0.0;
  for (const Vec2 p : target_positions(scenario))
    farthest = std::max(farthest, distance(scenario.swarm.start.center, p));
  for (const Vec2 p : scenario.visits.places()) farthest = std::max(farthest, distance(scenario.swarm.start.center, p));
  for (const Station& station : scenario.stations)
    for (const Vec2 p : station.course) farthest = std::max(farthest, distance(scenario.swarm.start.center, p));
  return 10.0 * farthest / scenario.robot.wheel_limit_m_s;
}

Scenario plain_scenario(const AlgorithmList& algorithms) {
  Scenario scenario;
  scenario.algorithms = &algorithms;
  scenario.mission.algorithm = algorithms.usual();
  return scenario;
}

const Algorithm& algorithm_of(const Scenario& scenario) {
  return *scenario.algorithms->find(scenario.mission.algorithm);
}

Setup setup_of(const Scenario& scenario) {
  Setup setup;
  setup.reading = scenario.mission.reading;
  setup.platform.communication_range_m = static_cast<float>(scenario.radio.range_m);
  setup.platform.line_of_sight = scenario.radio.line_of_sight;
  setup.platform.tick_s = static_cast<float>(scenario.tick_s);
  setup.platform.wheel_limit_m_s = static_cast<float>(scenario.robot.wheel_limit_m_s);
  setup.platform.wheel_distance_m = static_cast<float>(wheel_distance_m(scenario));
  setup.platform.body_radius_m = static_cast<float>(scenario.robot.radius_m);
  setup.platform.drive = scenario.robot.body == BodyModel::linear ? Drive::holonomic : Drive::differential;
  setup.platform.battery = scenario.battery.on();
  setup.arrival_distance_m = target_tolerance_m(scenario);
  setup.link_redundancy = static_cast<int>(scenario.mission.link_redundancy);
  setup.parameters = scenario.mission.parameters;
  setup.history = longest_way(scenario);
  return setup;
}

std::size_t least_robots(const std::vector<Vec2>& targets, double tolerance_m, double range_m) {
  double longest = 0.0;
  for (std::size_t a = 0; a < targets.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) longest = std::max(longest, squared_norm(targets[b] - targets[a]));
  longest = std::sqrt(longest);
  const double count = static_cast<double>(targets.size());
  const double links =
      std::max(longest - 2.0 * tolerance_m, 0.8241 * spanning_tree_length(targets) - count * tolerance_m) / range_m;
  return robots_for(links) + 1;
}

}  // namespace banyan::world
