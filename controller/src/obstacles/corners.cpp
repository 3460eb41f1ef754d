// SPDX-License-Identifier: MIT
#include "obstacles/corners.hpp"

#include <algorithm>
#include <cmath>

#include "banyan/controller/core/edge_frame.hpp"
#include "banyan/controller/core/function_ref.hpp"
#include "banyan/controller/core/search.hpp"
#include "obstacles/bypass.hpp"
#include "obstacles/sight.hpp"
#include "tree/motion.hpp"

namespace banyan {
namespace {

constexpr float sight_margin = 0.015F;  // C: own motion brings no line of sight nearer to a corner than this
constexpr float sight_width = 0.06F;    // robots make room for lines nearer to a corner than this
constexpr float hinge_width = 0.15F;    // the parent is told of a corner so near to the edge
constexpr float pin_width = 0.03F;      // C: so near to the edge a corner is about to cut it
constexpr float pin_shortest = 0.15F;   // a parent nearer than this need not come up
constexpr float spacing = 0.03F;        // between remembered points
constexpr float least_lever = 0.1F;     // with less, my motion hardly moves the line there;
// But the body of a former parent lies beside the robot that is the parent now.
constexpr float least_lever_body = 0.02F;
constexpr float forget = 1.0F;  // of C: points farther away are forgotten, since no edge is longer

// Calls visit(o, r): points of obstacles with r = 0, centres of bodies with their radius. One loop, so that the
// firmware has the visitor's code once.
template <class Visit> void for_each_obstacle(const TreeRobot& robot, const Corners& corners, Visit visit) noexcept {
  const std::size_t sensed = robot.obstacles.size();
  const std::size_t points = sensed + corners.landmarks.size;
  for (std::size_t k = 0; k < points + corners.bodies.size; ++k) {
    const Vec2& o = k < sensed   ? robot.obstacles[k]
                    : k < points ? corners.landmarks.points[k - sensed]
                                 : corners.bodies.centers[k - points];
    visit(o, k < points ? 0.0F : robot.params.body_radius);
  }
}

// ---- Lines of sight ----

// An obstacle point beside the segment from me to a neighbour.
struct Threat {
  Vec2 towards;  // unit, from the segment to the point
  float room;    // the distance of its surface from the segment
  float lever;   // how far the segment moves there when I move by 1
  bool is_body;  // not a point of an obstacle
};

void for_each_threat(const TreeRobot& robot, const Corners& corners, Vec2 neighbor,
                     FunctionRef<void(const Threat&)> visit) noexcept {
  const float d = norm(neighbor);
  if (d <= 0.0F) return;
  const Vec2 along = neighbor / d;
  for_each_obstacle(robot, corners, [&](Vec2 o, float r) {
    const float a = dot(along, o);
    const float across = cross(along, o);
    const float room = std::max(std::abs(across) - r, 0.0F);
    if (a <= 0.0F || a >= d || room >= sight_width) return;
    visit(Threat{left_of(along) * (across < 0.0F ? -1.0F : 1.0F), room, 1.0F - a / d, r > 0.0F});
  });
}

void for_each_edge_of_both_trees(const TreeRobot& robot, FunctionRef<void(int)> visit) noexcept {
  const TreeTable& table = robot.table();
  if (robot.parent_alive()) visit(robot.parent);
  if (robot.old_parent_alive() && robot.old_parent != robot.parent) visit(robot.old_parent);
  for (const IndexList* below : {&robot.children, &robot.old_children})
    for (const int k : *below)
      if (table.message(k).role != Role::spare) visit(k);
}

// How far a point is from the nearest of my tree edges: the farther, the less it matters.
float to_edges(const TreeRobot& robot, Vec2 p) noexcept {
  float nearest = norm(p);
  for_each_edge_of_both_trees(
      robot, [&](int k) { nearest = std::min(nearest, distance_to_segment(p, Vec2{}, robot.table().position(k))); });
  return nearest;
}

// Remembers a point; when there is no room, the one that matters least is dropped.
void file(const TreeRobot& robot, Corners& corners, Vec2 o) noexcept {
  Landmarks& known = corners.landmarks;
  const auto begin = known.points.begin();
  if (banyan::any_of(begin, begin + known.size, [&](Vec2 p) { return distance(p, o) < spacing; })) return;
  if (known.size < landmark_capacity) {
    known.points[known.size++] = o;
    return;
  }
  const auto key = [&](Vec2 p) { return to_edges(robot, p); };
  Vec2& least = *std::max_element(begin, begin + known.size, [&](Vec2 a, Vec2 b) { return key(a) < key(b); });
  if (key(o) <= key(least)) least = o;
}

// Remembers corners that children report beside their edge to me.
void hear_of_corners(const TreeRobot& robot, Corners& corners) noexcept {
  const TreeTable& table = robot.table();
  const auto hear = [&](int k) {
    const TreeStanding& m = table.message(k);
    const CornerStanding& corner = corners.of(k);
    if (table.age(k) > 0 || up_of(m) != robot.self.id || (corner.hinge_x.bits == 0 && corner.hinge_y.bits == 0)) return;
    file(robot, corners, from_edge_frame({corner.hinge_x.value(), corner.hinge_y.value()}, table.position(k)));
  };
  for (const IndexList* below : {&robot.children, &robot.old_children})
    for (const int k : *below) hear(k);
}

// Where to go when the parent falls silent: to where I stood.
void note_contact(const TreeRobot& robot, Corners& corners) noexcept {
  if (robot.parent >= 0 && robot.table().age(robot.parent) == 0) corners.seen_from = {};
}

// How near obstacles come to the line of sight to a neighbour; sight_width if they do not.
float room_beside(const TreeRobot& robot, const Corners& corners, Vec2 neighbor) noexcept {
  float room = sight_width;
  for_each_threat(robot, corners, neighbor, [&](const Threat& t) { room = std::min(room, t.room); });
  return room;
}

// Whether I hold back a child that has to go on.
bool is_towed(const TreeRobot& robot, const Corners& corners, float start) noexcept {
  const TreeTable& table = robot.table();
  const auto tows = [&](int k) {
    const TreeStanding& m = table.message(k);
    return m.role != Role::spare && m.want > 0 && (corners.of(k).pinned || table.range(k) > start);
  };
  return banyan::any_of(robot.children, tows);
}

// Everything nearer would be sensed.
float nearest_sensed(const TreeRobot& robot) noexcept {
  float nearest = robot.params.body_radius + obstacle_near;
  for (const Vec2 o : robot.obstacles) nearest = std::min(nearest, norm(o));
  return nearest;
}

void forget_wrong(const TreeRobot& robot, Corners& corners) noexcept {
  Landmarks& known = corners.landmarks;
  const float nearest = nearest_sensed(robot);
  constexpr float far = forget;
  // A point nearer than everything that is sensed no longer exists, or never did.
  const auto is_wrong = [&](Vec2 p) { return norm(p) > far || norm(p) < nearest - spacing; };
  std::uint8_t kept = 0;
  for (std::size_t k = 0; k < known.size; ++k)
    if (!is_wrong(known.points[k])) known.points[kept++] = known.points[k];
  known.size = kept;
}

// A neighbour is heard past that place so closely that a body there would hide it.
bool is_heard_through(const TreeRobot& robot, Vec2 center) noexcept {
  constexpr float well_inside = 0.5F;  // of the radius: what is remembered drifts
  const TreeTable& table = robot.table();
  for (int k = 0; k < table.size(); ++k)
    if (table.age(k) == 0 &&
        distance_to_segment(center, Vec2{}, table.position(k)) < well_inside * robot.params.body_radius)
      return true;
  return false;
}

// Out of reach of all edges, not where the sensor would see it, heard again, or gone.
void forget_bodies(const TreeRobot& robot, KnownBodies& bodies) noexcept {
  const float nearest = nearest_sensed(robot);
  const auto is_wrong = [&](std::size_t k) {
    const float d = norm(bodies.centers[k]);
    const int place = robot.table().find(bodies.ids[k]);
    return d > forget || d - robot.params.body_radius < nearest - spacing ||
           (place >= 0 && robot.table().age(place) == 0) || is_heard_through(robot, bodies.centers[k]);
  };
  std::uint8_t kept = 0;
  for (std::size_t k = 0; k < bodies.size; ++k) {
    if (is_wrong(k)) continue;
    bodies.centers[kept] = bodies.centers[k];
    bodies.ids[kept++] = bodies.ids[k];
  }
  bodies.size = kept;
}

// Remembers neighbour k as a body, unless it may only be hidden or out of range.
void note_body(const TreeRobot& robot, Corners& corners, int k) noexcept {
  constexpr float clear = 0.08F;  // of other robots, which may have moved since it was heard
  const TreeTable& table = robot.table();
  KnownBodies& bodies = corners.bodies;
  if (table.range(k) > longest_link || !sees_clearly(robot, corners, k, clear)) return;
  const auto begin = bodies.ids.begin();
  if (banyan::any_of(begin, begin + bodies.size, [&](RobotId id) { return id == table.id(k); })) return;
  if (bodies.size == body_capacity) {  // the oldest makes room
    std::shift_left(bodies.centers.begin(), bodies.centers.end(), 1);
    std::shift_left(bodies.ids.begin(), bodies.ids.end(), 1);
    --bodies.size;
  }
  bodies.centers[bodies.size] = table.position(k);
  bodies.ids[bodies.size++] = table.id(k);
}

// Tree neighbours about to be forgotten: from now on their bodies are.
void note_silent(const TreeRobot& robot, Corners& corners) noexcept {
  if (!robot.params.line_of_sight) return;
  const int last_tick = robot.liveness_ticks() - robot.elapsed_ticks;
  const TreeTable& table = robot.table();
  for (int k = 0; k < table.size(); ++k)
    if (table.age(k) > last_tick && table.alive(k) && robot.is_tree_neighbor(k)) note_body(robot, corners, k);
}

}  // namespace

void carry_corners(Corners& corners, const Carry& carry) noexcept {
  corners.seen_from = carry.point(corners.seen_from);
  for (std::size_t k = 0; k < corners.bodies.size; ++k)
    corners.bodies.centers[k] = carry.point(corners.bodies.centers[k]);
  for (int k = 0; k < corners.landmarks.size; ++k) {
    Vec2& point = corners.landmarks.points[static_cast<std::size_t>(k)];
    point = carry.point(point);
  }
}

void remember_corners(const TreeRobot& robot, Corners& corners) noexcept {
  Landmarks& known = corners.landmarks;
  note_contact(robot, corners);
  hear_of_corners(robot, corners);
  if (corners.bodies.size > 0) forget_bodies(robot, corners.bodies);
  note_silent(robot, corners);
  if (known.size == 0 && robot.obstacles.empty()) return;
  forget_wrong(robot, corners);
  for (const Vec2 o : robot.obstacles) file(robot, corners, o);
}

bool find_hinge(const TreeRobot& robot, const Corners& corners, Vec2& hinge) noexcept {
  const int up = robot.up();
  if (up < 0) return false;
  const Vec2 parent = robot.table().position(up);
  const Vec2 direction = unit(parent);
  float best_length = hinge_width;
  for_each_obstacle(robot, corners, [&](Vec2 o, float r) {
    const float along = dot(o, parent);
    const float across = cross(direction, o);
    const float room = std::max(std::abs(across) - r, 0.0F);
    if (along <= 0.0F || along >= squared_norm(parent) || room >= best_length) return;
    best_length = room;
    hinge = o - left_of(direction) * (across < 0.0F ? -r : r);  // of a body the point nearest to the edge
  });
  return best_length < hinge_width;
}

void keep_sight(const TreeRobot& robot, const Corners& corners, Guard& guard) noexcept {
  if (!robot.params.line_of_sight) return;
  const auto keep = [&](int k) {
    for_each_threat(robot, corners, robot.table().position(k), [&](const Threat& t) {
      if (t.lever < (t.is_body ? least_lever_body : least_lever)) return;
      const float room = std::max(0.0F, t.room - sight_margin);
      guard.add_limit(t.towards, 0.5F * room * robot.params.guard_rate / t.lever);
    });
  };
  for_each_edge_of_both_trees(robot, keep);
}

Vec2 clear_sight(const TreeRobot& robot, const Corners& corners) noexcept {
  static constexpr float on_line = 5e-4F;
  static constexpr float most_push = 2.0F;  // that of a line at a third of the width
  Vec2 u;
  if (!robot.params.line_of_sight) return u;
  for_each_edge_of_both_trees(robot, [&](int k) {
    for_each_threat(robot, corners, robot.table().position(k), [&](const Threat& t) {
      u += -t.towards * (t.lever * std::min(sight_width / std::max(t.room, on_line) - 1.0F, most_push));
    });
  });
  return u;
}

bool is_pinned(const TreeRobot& robot, const Corners& corners, float towing_start) noexcept {
  if (robot.self.want <= 0.0F) return false;
  if (robot.is_root()) return false;
  if (!robot.parent_alive() || (!robot.self.is_worker && !is_towed(robot, corners, towing_start))) return false;
  return robot.table().range(robot.parent) > pin_shortest &&
         room_beside(robot, corners, robot.table().position(robot.parent)) < pin_width;
}

bool is_free(const TreeRobot& robot, const Corners& corners, Vec2 a, Vec2 b, float clearance) noexcept {
  const Vec2 d = b - a;
  const float d2 = squared_norm(d);
  bool free = true;
  for_each_obstacle(robot, corners, [&](Vec2 o, float r) {
    const float along = dot(o - a, d);
    const float across = cross(o - a, d);
    const float room_apart = clearance + r;
    free = free && (along <= 0.0F || along >= d2 || across * across >= room_apart * room_apart * d2);
  });
  return free;
}

}  // namespace banyan
