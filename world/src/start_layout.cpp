// SPDX-License-Identifier: MIT
// Layouts of a start. Those on a lattice grow from its centre over neighbouring points of the layout,
// nearest first, and never through an obstacle: robots of a corridor stay in it. Without obstacles
// these are the points nearest to the centre, because each has a neighbour that is nearer still. A
// ring and two clusters with a bridge are rigid figures: what an obstacle covers is left out, and
// faults() refuses the start. A random start grows robot by robot and so is connected by construction.
#include "start_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <span>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

#include "banyan/controller/core/trig.hpp"
#include "banyan/world/obstacles.hpp"
#include "banyan/world/random.hpp"

namespace banyan::world {
namespace {

// Where robots may stand, and which neighbours no obstacle separates.
class Ground {
 public:
  Ground(std::span<const Obstacle> obstacles, double room) : obstacles_{obstacles}, room_{room} {}
  [[nodiscard]] bool free(Vec2 p) const noexcept {
    return std::all_of(obstacles_.begin(), obstacles_.end(),
                       [&](const Obstacle& o) { return clearance(o, p) >= room_; });
  }
  [[nodiscard]] bool open_between(Vec2 a, Vec2 b) const noexcept {
    return std::none_of(obstacles_.begin(), obstacles_.end(), [&](const Obstacle& o) { return blocks(o, a, b); });
  }

 private:
  std::span<const Obstacle> obstacles_;
  double room_;
};

std::uint64_t key_of(std::int32_t row, std::int32_t column) noexcept {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(row)) << 32 | static_cast<std::uint32_t>(column);
}

// ---- On a lattice ----

// A lattice point in integer coordinates; distances compare exactly.
struct LatticeCell {
  std::int64_t distance2 = 0;  // in units of pitch^2
  std::int32_t row = 0;
  std::int32_t column = 0;
};
constexpr bool farther(const LatticeCell& a, const LatticeCell& b) noexcept {
  return std::tie(a.distance2, a.row, a.column) > std::tie(b.distance2, b.row, b.column);
}

struct LatticeStep {
  std::int32_t row, column;
};
constexpr std::array<LatticeStep, 6> hexagonal_steps{{{0, 1}, {1, 0}, {1, -1}, {0, -1}, {-1, 0}, {-1, 1}}};
constexpr std::array<LatticeStep, 4> grid_steps{{{0, 1}, {1, 0}, {0, -1}, {-1, 0}}};

class Lattice {
 public:
  Lattice(Layout layout, Vec2 center, double pitch, const Ground& ground)
      : layout_{layout}, center_{center}, pitch_{pitch}, ground_{ground} {}

  [[nodiscard]] std::vector<Vec2> nearest(std::size_t count) const {
    std::priority_queue<LatticeCell, std::vector<LatticeCell>, decltype(&farther)> open(&farther);
    std::unordered_set<std::uint64_t> seen;
    seen.reserve(2 * count);
    const auto visit = [&](const LatticeCell& cell) {
      if (ground_.free(point(cell)) && seen.insert(key_of(cell.row, cell.column)).second) open.push(cell);
    };
    std::vector<Vec2> points;
    points.reserve(count);
    visit(LatticeCell{});
    while (points.size() < count && !open.empty()) {
      const LatticeCell cell = open.top();
      open.pop();
      points.push_back(point(cell));
      for (const LatticeStep s : steps()) {
        const LatticeCell next = at(cell.row + s.row, cell.column + s.column);
        if (belongs(next) && !seen.contains(key_of(next.row, next.column)) &&
            ground_.open_between(point(cell), point(next)))
          visit(next);
      }
    }
    return points;
  }

 private:
  [[nodiscard]] bool hexagonal() const noexcept { return layout_ == Layout::hexagonal; }
  [[nodiscard]] std::span<const LatticeStep> steps() const noexcept {
    return hexagonal() ? std::span<const LatticeStep>(hexagonal_steps) : std::span<const LatticeStep>(grid_steps);
  }
  [[nodiscard]] bool belongs(const LatticeCell& cell) const noexcept {
    if (layout_ == Layout::line) return cell.row == 0;
    if (layout_ == Layout::cross) return cell.row == 0 || cell.column == 0;
    return true;
  }
  [[nodiscard]] LatticeCell at(std::int32_t row, std::int32_t column) const noexcept {
    const std::int64_t r = row;
    const std::int64_t c = column;
    return {hexagonal() ? r * r + r * c + c * c : r * r + c * c, row, column};
  }
  [[nodiscard]] Vec2 point(const LatticeCell& cell) const noexcept {
    const double r = cell.row;
    const double c = cell.column;
    const Vec2 unit_point = hexagonal() ? Vec2{c + 0.5 * r, 0.86602540378443864676 * r} : Vec2{c, r};
    return center_ + pitch_ * unit_point;
  }

  Layout layout_;
  Vec2 center_;
  double pitch_;
  const Ground& ground_;
};

// ---- Rigid figures ----

// Chords between neighbours are as long as the pitch.
std::vector<Vec2> ring(std::size_t count, Vec2 center, double pitch) {
  if (count < 2) return {center};
  const double turn = 2.0 * pi<double> / static_cast<double>(count);
  const double radius = 0.5 * pitch / unit_vector(0.5 * turn).y;
  std::vector<Vec2> points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    points.push_back(center + radius * unit_vector(turn * static_cast<double>(i)));
  return points;
}

// Two compact clusters, mirrored, and the bridge along the x axis between them.
std::vector<Vec2> bridge(std::size_t count, const Start& start, double pitch, double link) {
  const std::size_t between = std::min(start.bridge_robots, count);
  const std::size_t left = (count - between + 1) / 2;
  const Ground flat({}, 0.0);
  const std::vector<Vec2> cluster = Lattice(Layout::hexagonal, {}, pitch, flat).nearest(left);
  const auto edge_of = [&](std::size_t robots) {  // of the row that the bridge continues
    double edge = 0.0;
    for (std::size_t i = 0; i < robots; ++i)
      if (cluster[i].y == 0.0) edge = std::max(edge, cluster[i].x);
    return edge;
  };
  const double edge_left = edge_of(left);
  const double edge_right = edge_of(count - between - left);  // it may lack the robot at the end of that row
  const double half = 0.5 * link * static_cast<double>(between + 1);
  std::vector<Vec2> points;
  points.reserve(count);
  for (std::size_t i = 1; i <= between; ++i)
    points.push_back(start.center + Vec2{link * static_cast<double>(i) - half, 0.0});
  for (std::size_t i = 0; points.size() < count; ++i) {
    points.push_back(start.center + cluster[i] - Vec2{half + edge_left, 0.0});
    if (points.size() < count) points.push_back(start.center - cluster[i] + Vec2{half + edge_right, 0.0});
  }
  std::stable_sort(points.begin(), points.end(),
                   [&](Vec2 a, Vec2 b) { return squared_norm(a - start.center) < squared_norm(b - start.center); });
  return points;
}

// ---- Random ----

// Points no nearer to each other than a given distance, found by squares of that size.
class Spaced {
 public:
  explicit Spaced(double least) : least_{least} {}
  [[nodiscard]] bool has_room(Vec2 p) const {
    for (std::int32_t row = index(p.y) - 1; row <= index(p.y) + 1; ++row)
      for (std::int32_t column = index(p.x) - 1; column <= index(p.x) + 1; ++column)
        if (const auto found = squares_.find(key_of(row, column)); found != squares_.end())
          for (const Vec2 q : found->second)
            if (distance(p, q) < least_) return false;
    return true;
  }
  void add(Vec2 p) { squares_[key_of(index(p.y), index(p.x))].push_back(p); }

 private:
  [[nodiscard]] std::int32_t index(double x) const noexcept {
    return static_cast<std::int32_t>(std::clamp(std::floor(x / least_), -2e9, 2e9));
  }
  double least_;
  std::unordered_map<std::uint64_t, std::vector<Vec2>> squares_;  // looked up, never iterated
};

// Each robot stands in the ring around one that is already there, drawn evenly among them and within
// the ring, where it has room and no obstacle is in between.
std::vector<Vec2> grown(const Scenario& scenario, const Ground& ground, double least, double longest) {
  constexpr std::uint64_t attempts = 2000;
  const std::size_t count = free_robot_count(scenario);
  const auto draw = [&](std::size_t robot, std::uint64_t k) {
    return to_uniform(bits(scenario.seed, Purpose::start, robot, k));
  };
  std::vector<Vec2> points;
  points.reserve(count);
  Spaced spaced(least);
  const auto put = [&](Vec2 p) { points.push_back(p), spaced.add(p); };
  if (ground.free(scenario.swarm.start.center)) put(scenario.swarm.start.center);
  while (!points.empty() && points.size() < count) {
    const std::size_t robot = points.size();
    for (std::uint64_t k = 0; k < 3 * attempts && points.size() == robot; k += 3) {
      const Vec2 from = points[static_cast<std::size_t>(draw(robot, k) * static_cast<double>(robot))];
      const double r = std::sqrt(least * least + draw(robot, k + 1) * (longest * longest - least * least));
      const Vec2 p = from + r * unit_vector(2.0 * pi<double> * draw(robot, k + 2));
      if (spaced.has_room(p) && ground.free(p) && ground.open_between(from, p)) put(p);
    }
    if (points.size() == robot) break;
  }
  return points;
}

}  // namespace

std::vector<Vec2> start_points(const Scenario& scenario) {
  const Start& start = scenario.swarm.start;
  const bool random = start.layout == Layout::random;
  std::vector<Obstacle> taken = scenario.obstacles;
  for (const Station& station : scenario.stations) taken.emplace_back(Disc{station.position, scenario.robot.radius_m});
  const Ground ground(taken, scenario.robot.radius_m + (random ? 0.0 : start_jitter_m(scenario)));
  const std::size_t count = free_robot_count(scenario);
  const double pitch = start_pitch_m(scenario);
  const double link = start.link_share * scenario.radio.range_m;
  if (random) return grown(scenario, ground, pitch, link);
  if (start.layout != Layout::ring && start.layout != Layout::bridge)
    return Lattice(start.layout, start.center, pitch, ground).nearest(count);
  std::vector<Vec2> points =
      start.layout == Layout::ring ? ring(count, start.center, pitch) : bridge(count, start, pitch, link);
  std::erase_if(points, [&](Vec2 p) { return !ground.free(p); });
  return points;
}

}  // namespace banyan::world
