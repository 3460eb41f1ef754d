// SPDX-License-Identifier: MIT
// The start cluster grows from its centre over lattice neighbours, nearest first, and never
// through an obstacle: robots of a corridor stay in it. Without obstacles these are the lattice
// points nearest to the centre, because each has a neighbour that is nearer still.
#include "banyan/world/placement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <span>
#include <tuple>
#include <unordered_set>

#include "banyan/controller/core/trig.hpp"
#include "banyan/world/obstacles.hpp"
#include "banyan/world/random.hpp"

namespace banyan::world {
namespace {

// A lattice point in integer coordinates; distances compare exactly.
struct Cell {
  std::int64_t distance2 = 0;  // in units of pitch^2
  std::int32_t row = 0;
  std::int32_t column = 0;
};
constexpr bool farther(const Cell& a, const Cell& b) noexcept {
  return std::tie(a.distance2, a.row, a.column) > std::tie(b.distance2, b.row, b.column);
}

struct Step { std::int32_t row, column; };
constexpr std::array<Step, 6> hexagonal_steps{{{0, 1}, {1, 0}, {1, -1}, {0, -1}, {-1, 0}, {-1, 1}}};
constexpr std::array<Step, 4> grid_steps{{{0, 1}, {1, 0}, {0, -1}, {-1, 0}}};

class Lattice {
 public:
  explicit Lattice(const Scenario& scenario)
      : start_{scenario.swarm.start}, obstacles_{scenario.obstacles},
        room_{scenario.robot.radius_m + start_.jitter_m}, hexagonal_{start_.layout == Layout::hexagonal} {}

  [[nodiscard]] std::vector<Vec2> nearest(std::size_t count) const {
    std::priority_queue<Cell, std::vector<Cell>, decltype(&farther)> open(&farther);
    std::unordered_set<std::uint64_t> seen;
    seen.reserve(2 * count);
    const auto visit = [&](const Cell& cell) {
      if (free(point(cell)) && seen.insert(key(cell)).second) open.push(cell);
    };
    std::vector<Vec2> points;
    points.reserve(count);
    visit(Cell{});
    while (points.size() < count && !open.empty()) {
      const Cell cell = open.top();
      open.pop();
      points.push_back(point(cell));
      for (const Step s : steps()) {
        const Cell next = at(cell.row + s.row, cell.column + s.column);
        if (!seen.contains(key(next)) && open_between(point(cell), point(next))) visit(next);
      }
    }
    return points;
  }

 private:
  [[nodiscard]] std::span<const Step> steps() const noexcept {
    return hexagonal_ ? std::span<const Step>(hexagonal_steps) : std::span<const Step>(grid_steps);
  }
  [[nodiscard]] Cell at(std::int32_t row, std::int32_t column) const noexcept {
    const std::int64_t r = row;
    const std::int64_t c = column;
    return {hexagonal_ ? r * r + r * c + c * c : r * r + c * c, row, column};
  }
  [[nodiscard]] Vec2 point(const Cell& cell) const noexcept {
    const double r = cell.row;
    const double c = cell.column;
    const Vec2 unit_point = hexagonal_ ? Vec2{c + 0.5 * r, 0.86602540378443864676 * r} : Vec2{c, r};
    return start_.center + start_.pitch_m * unit_point;
  }
  static std::uint64_t key(const Cell& cell) noexcept {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(cell.row)) << 32 |
           static_cast<std::uint32_t>(cell.column);
  }
  [[nodiscard]] bool free(Vec2 p) const noexcept {
    return std::all_of(obstacles_.begin(), obstacles_.end(),
                       [&](const Obstacle& o) { return clearance(o, p) >= room_; });
  }
  [[nodiscard]] bool open_between(Vec2 a, Vec2 b) const noexcept {
    return std::none_of(obstacles_.begin(), obstacles_.end(), [&](const Obstacle& o) { return blocks(o, a, b); });
  }

  const Start& start_;
  std::span<const Obstacle> obstacles_;
  double room_;
  bool hexagonal_;
};

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
  Poses poses;
  poses.position = list ? start.positions : Lattice(scenario).nearest(robot_count(scenario));
  poses.heading.reserve(poses.position.size());
  for (std::size_t i = 0; i < poses.position.size(); ++i) {
    if (!list) poses.position[i] += jitter(scenario.seed, i, start.jitter_m);
    const bool given = list && i < start.headings_rad.size();
    poses.heading.push_back(given ? unit_vector(start.headings_rad[i]) : random_heading(scenario.seed, i));
  }
  return poses;
}

Assignment assign(const Scenario& scenario, const Poses& poses, const std::vector<Vec2>& targets) {
  const std::size_t n = poses.position.size();
  Assignment result;
  std::vector<std::uint8_t> taken(n, 0);
  if (scenario.swarm.root) taken[*scenario.swarm.root] = 1;
  for (const Vec2 target : targets) {
    const std::size_t worker = nearest_robot(poses, taken, target);
    taken[worker] = 1;
    result.worker.push_back(worker);
  }
  if (scenario.swarm.root) {
    result.root = *scenario.swarm.root;
    return result;
  }
  const std::size_t others = n - targets.size();
  auto draw = static_cast<std::size_t>(to_uniform(bits(scenario.seed, Purpose::root, 0)) * static_cast<double>(others));
  for (std::size_t i = 0; i < n; ++i) {
    if (taken[i]) continue;
    result.root = i;
    if (draw-- == 0) break;
  }
  return result;
}

}  // namespace banyan::world
