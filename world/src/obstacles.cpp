// SPDX-License-Identifier: MIT
// Discs, boxes, walls and maps. Every function works in the obstacle's own frame and uses + - * / and
// sqrt only, so results are the same on every machine.
#include "banyan/world/obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "banyan/controller/core/trig.hpp"

namespace banyan::world {
namespace {

constexpr bool before(Vec2 a, Vec2 b) noexcept { return a.x != b.x ? a.x < b.x : a.y < b.y; }

// The point of segment a-b nearest to p.
Vec2 nearest_on_segment(Vec2 a, Vec2 b, Vec2 p) noexcept {
  const Vec2 d = b - a;
  const double length2 = squared_norm(d);
  if (length2 == 0.0) return a;
  return a + d * std::clamp(dot(p - a, d) / length2, 0.0, 1.0);
}

struct LocalBox {
  Vec2 rotation, half;
  explicit LocalBox(const Box& box) noexcept : rotation{unit(unit_vector(box.angle_rad))}, half{box.size * 0.5} {}
};

bool blocks_ordered(const Disc& disc, Vec2 a, Vec2 b) noexcept {
  const Vec2 gap = nearest_on_segment(a, b, disc.center) - disc.center;
  return squared_norm(gap) < disc.radius_m * disc.radius_m;
}

// Cuts [from, to] of the segment's parameter down to where low < p + t d < high.
bool clip(double p, double d, double half, double& from, double& to) noexcept {
  if (d == 0.0) return -half < p && p < half;
  const double t1 = (-half - p) / d;
  const double t2 = (half - p) / d;
  from = std::max(from, std::min(t1, t2));
  to = std::min(to, std::max(t1, t2));
  return from < to;
}

bool blocks_ordered(const Box& box, Vec2 a, Vec2 b) noexcept {
  const Vec2 far = nearest_on_segment(a, b, box.center) - box.center;
  if (squared_norm(far) >= 0.25 * squared_norm(box.size)) return false;  // outside the circumscribed disc
  const LocalBox local(box);
  const Vec2 p = rotate_back(local.rotation, a - box.center);
  const Vec2 d = rotate_back(local.rotation, b - a);
  double from = 0.0;
  double to = 1.0;
  if (a == b) return std::abs(p.x) < local.half.x && std::abs(p.y) < local.half.y;
  return clip(p.x, d.x, local.half.x, from, to) && clip(p.y, d.y, local.half.y, from, to);
}

// A wall has no thickness: a line of sight along it, or one that ends on it, is free; one through
// an end point of the wall is not.
bool blocks_ordered(const Wall& wall, Vec2 a, Vec2 b) noexcept {
  const Vec2 w = wall.to - wall.from;
  const double side_a = cross(w, a - wall.from);
  const double side_b = cross(w, b - wall.from);
  if (!((side_a < 0.0 && side_b > 0.0) || (side_a > 0.0 && side_b < 0.0))) return false;
  const double side_from = cross(b - a, wall.from - a);
  const double side_to = cross(b - a, wall.to - a);
  return (side_from <= 0.0 && side_to >= 0.0) || (side_from >= 0.0 && side_to <= 0.0);
}

// Between two segments that do not cross, some end is nearest.
double gap_between(Vec2 a, Vec2 b, Vec2 c, Vec2 d) noexcept {
  return std::min({distance(nearest_on_segment(a, b, c), c), distance(nearest_on_segment(a, b, d), d),
                   distance(nearest_on_segment(c, d, a), a), distance(nearest_on_segment(c, d, b), b)});
}

double gap_of(const Disc& disc, Vec2 a, Vec2 b) noexcept {
  return std::max(0.0, distance(nearest_on_segment(a, b, disc.center), disc.center) - disc.radius_m);
}

double gap_of(const Wall& wall, Vec2 a, Vec2 b) noexcept { return gap_between(a, b, wall.from, wall.to); }

double gap_of(const Box& box, Vec2 a, Vec2 b) noexcept {
  const LocalBox local(box);
  const Vec2 p = rotate_back(local.rotation, a - box.center);
  const Vec2 q = rotate_back(local.rotation, b - box.center);
  const Vec2 corner = local.half;
  const Vec2 other{-corner.x, corner.y};
  return std::min({gap_between(p, q, corner, other), gap_between(p, q, other, corner * -1.0),
                   gap_between(p, q, corner * -1.0, other * -1.0), gap_between(p, q, other * -1.0, corner)});
}

double clearance_of(const Disc& disc, Vec2 p) noexcept { return distance(disc.center, p) - disc.radius_m; }

double clearance_of(const Box& box, Vec2 p) noexcept {
  const LocalBox local(box);
  const Vec2 q = rotate_back(local.rotation, p - box.center);
  const Vec2 over{std::abs(q.x) - local.half.x, std::abs(q.y) - local.half.y};
  if (over.x <= 0.0 && over.y <= 0.0) return std::max(over.x, over.y);
  return norm(Vec2{std::max(over.x, 0.0), std::max(over.y, 0.0)});
}

double clearance_of(const Wall& wall, Vec2 p) noexcept {
  return distance(nearest_on_segment(wall.from, wall.to, p), p);
}

Vec2 surface_of(const Disc& disc, Vec2 p) noexcept {
  const Vec2 away = unit(p - disc.center);
  return disc.center + (away == Vec2{} ? Vec2{1.0, 0.0} : away) * disc.radius_m;
}

Vec2 surface_of(const Box& box, Vec2 p) noexcept {
  const LocalBox local(box);
  const Vec2 q = rotate_back(local.rotation, p - box.center);
  Vec2 surface{std::clamp(q.x, -local.half.x, local.half.x), std::clamp(q.y, -local.half.y, local.half.y)};
  if (surface == q) {  // inside: out through the nearest side
    const bool sideways = local.half.x - std::abs(q.x) <= local.half.y - std::abs(q.y);
    if (sideways) surface.x = q.x < 0.0 ? -local.half.x : local.half.x;
    else surface.y = q.y < 0.0 ? -local.half.y : local.half.y;
  }
  return box.center + rotate(local.rotation, surface);
}

Vec2 surface_of(const Wall& wall, Vec2 p) noexcept { return nearest_on_segment(wall.from, wall.to, p); }

// Away from `from` until `reach` is between them; along `fallback` if they coincide.
Vec2 push_from(Vec2 from, Vec2 p, double reach, Vec2 fallback) noexcept {
  const Vec2 away = p - from;
  const double d = norm(away);
  if (d >= reach) return {};
  return d > 0.0 ? away * ((reach - d) / d) : fallback * reach;
}

Vec2 push_out_of(const Disc& disc, Vec2 p, double radius) noexcept {
  return push_from(disc.center, p, disc.radius_m + radius, {1.0, 0.0});
}

Vec2 push_out_of(const Box& box, Vec2 p, double radius) noexcept {
  const LocalBox local(box);
  const Vec2 q = rotate_back(local.rotation, p - box.center);
  const Vec2 over{std::abs(q.x) - local.half.x, std::abs(q.y) - local.half.y};
  const Vec2 side{q.x < 0.0 ? -1.0 : 1.0, q.y < 0.0 ? -1.0 : 1.0};
  Vec2 shift{};
  if (over.x > 0.0 || over.y > 0.0) {
    const Vec2 surface{std::clamp(q.x, -local.half.x, local.half.x), std::clamp(q.y, -local.half.y, local.half.y)};
    shift = push_from(surface, q, radius, {});
  } else if (over.x > over.y) {
    shift = {side.x * (radius - over.x), 0.0};
  } else {
    shift = {0.0, side.y * (radius - over.y)};
  }
  return rotate(local.rotation, shift);
}

Vec2 push_out_of(const Wall& wall, Vec2 p, double radius) noexcept {
  const Vec2 along = unit(wall.to - wall.from);
  const Vec2 normal = along == Vec2{} ? Vec2{1.0, 0.0} : Vec2{-along.y, along.x};
  return push_from(nearest_on_segment(wall.from, wall.to, p), p, radius, normal);
}

// ---- Maps: what their cells say, in metres ----

bool blocks_ordered(const FloorMap& map, Vec2 a, Vec2 b) noexcept {
  const CellFrame frame(map);
  return map.cells->blocks(frame.in_cells(a), frame.in_cells(b));
}
double gap_of(const FloorMap& map, Vec2 a, Vec2 b) noexcept {
  const CellFrame frame(map);
  return map.cells->gap(frame.in_cells(a), frame.in_cells(b)) * map.cell_m;
}
double clearance_of(const FloorMap& map, Vec2 p) noexcept {
  return map.cells->clearance(CellFrame(map).in_cells(p)) * map.cell_m;
}
Vec2 surface_of(const FloorMap& map, Vec2 p) noexcept {
  const CellFrame frame(map);
  return frame.in_metres(map.cells->nearest_surface_point(frame.in_cells(p)));
}
Vec2 push_out_of(const FloorMap& map, Vec2 p, double radius) noexcept {
  const CellFrame frame(map);
  const Vec2 shift = map.cells->push_out(frame.in_cells(p), radius / map.cell_m);
  return shift == Vec2{} ? shift : frame.shift_m(shift);
}
Vec2 size_of(const FloorMap& map) noexcept {
  return Vec2{static_cast<double>(map.cells->columns()), static_cast<double>(map.cells->rows())};
}

}  // namespace

CellFrame::CellFrame(const FloorMap& map) noexcept
    : rotation_{map.angle_rad == 0.0 ? Vec2{1.0, 0.0} : unit(unit_vector(map.angle_rad))},
      origin_{map.origin},
      cell_m_{map.cell_m} {}

bool blocks(const Obstacle& obstacle, Vec2 a, Vec2 b) noexcept {
  if (before(b, a)) std::swap(a, b);
  return std::visit([&](const auto& o) { return blocks_ordered(o, a, b); }, obstacle);
}

double gap(const Obstacle& obstacle, Vec2 a, Vec2 b) noexcept {
  return std::visit([&](const auto& o) { return gap_of(o, a, b); }, obstacle);
}

double clearance(const Obstacle& obstacle, Vec2 p) noexcept {
  return std::visit([&](const auto& o) { return clearance_of(o, p); }, obstacle);
}
double clearance(std::span<const Obstacle> obstacles, Vec2 p) noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (const Obstacle& o : obstacles) least = std::min(least, clearance(o, p));
  return least;
}

bool may_be_nearer(const Obstacle& obstacle, Vec2 p, double distance_m) noexcept {
  const auto* map = std::get_if<FloorMap>(&obstacle);
  if (map == nullptr) return clearance(obstacle, p) < distance_m;
  return map->cells->least_clearance(CellFrame(*map).in_cells(p)) * map->cell_m < distance_m;
}

Disc enclosing(const Obstacle& obstacle) noexcept {
  struct Enclose {
    Disc operator()(const Disc& disc) const { return disc; }
    Disc operator()(const Box& box) const { return {box.center, 0.5 * norm(box.size)}; }
    Disc operator()(const Wall& wall) const {
      return {(wall.from + wall.to) * 0.5, 0.5 * distance(wall.from, wall.to)};
    }
    Disc operator()(const FloorMap& map) const {
      return {CellFrame(map).in_metres(0.5 * size_of(map)), 0.5 * map.cell_m * norm(size_of(map))};
    }
  };
  return std::visit(Enclose{}, obstacle);
}

Vec2 nearest_surface_point(const Obstacle& obstacle, Vec2 p) noexcept {
  return std::visit([&](const auto& o) { return surface_of(o, p); }, obstacle);
}

Vec2 push_out(const Obstacle& obstacle, Vec2 p, double radius) noexcept {
  return std::visit([&](const auto& o) { return push_out_of(o, p, radius); }, obstacle);
}

Vec2 center_of(const Obstacle& obstacle) noexcept { return enclosing(obstacle).center; }

Obstacle moved(const Obstacle& obstacle, Vec2 center) noexcept {
  struct Move {
    Vec2 center;
    Obstacle operator()(const Disc& disc) const { return Disc{center, disc.radius_m}; }
    Obstacle operator()(const Box& box) const { return Box{center, box.size, box.angle_rad}; }
    Obstacle operator()(const Wall& wall) const {
      const Vec2 half = (wall.to - wall.from) * 0.5;
      return Wall{center - half, center + half};
    }
    Obstacle operator()(FloorMap map) const {
      map.origin += center - center_of(Obstacle{map});
      return map;
    }
  };
  return std::visit(Move{center}, obstacle);
}

bool change(std::vector<Obstacle>& obstacles, const Action& action) {
  if (const auto* add = std::get_if<AddObstacle>(&action)) {
    obstacles.emplace_back(Disc{add->position, add->radius_m});
    return true;
  }
  if (const auto* move = std::get_if<MoveObstacle>(&action); move != nullptr && move->obstacle < obstacles.size()) {
    obstacles[move->obstacle] = moved(obstacles[move->obstacle], move->position);
    return true;
  }
  if (const auto* gone = std::get_if<RemoveObstacle>(&action); gone != nullptr && gone->obstacle < obstacles.size()) {
    obstacles.erase(obstacles.begin() + static_cast<std::ptrdiff_t>(gone->obstacle));
    return true;
  }
  return false;
}

}  // namespace banyan::world
