// SPDX-License-Identifier: MIT
#include "banyan/controller/bypass.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "banyan/controller/edge_frame.hpp"
#include "banyan/controller/motion.hpp"
#include "banyan/controller/sight.hpp"

namespace banyan {
namespace {

// A body's radius is not among the parameters; the wheels stand on about 1.5 of it.
constexpr float body_per_axle = 0.67F;
constexpr float keep_m = 0.04F;           // between body and obstacle, while it slides along
constexpr float near_m = 0.19F;           // between body and obstacle, when it begins to matter
constexpr float sight_margin_m = 0.03F;   // no line of sight comes nearer to a corner by own motion
constexpr float sight_width_m = 0.12F;    // and robots make room within this
constexpr float hinge_width_m = 0.30F;    // of such a corner the parent is told
constexpr float pin_width_m = 0.06F;
constexpr float pin_shortest_m = 0.30F;   // a parent nearer than this need not come up
constexpr float spacing_m = 0.06F;        // of remembered points
constexpr float forget = 1.0F;            // of C: an edge is no longer
constexpr float same_obstacle_m = 0.20F;  // the contact point moves on by less in a tick
constexpr float progress_m = 0.05F;
constexpr float first_span = 0.35F;        // of C
constexpr float goal_moved_m = 0.30F;

float body_m(const Robot& robot) noexcept { return body_per_axle * robot.params.wheel_distance_m; }

Vec2 left_of(Vec2 v) noexcept { return {-v.y, v.x}; }

// ---- One obstacle point: which directions it leaves ----

// The largest cosine between a direction of motion and that of an obstacle `d` away: along it where it
// is near enough, towards it where there is room.
float allowed_cosine(const Robot& robot, float d) noexcept {
  const float gap = d - body_m(robot);
  return std::clamp((gap - keep_m) / (near_m - keep_m), -0.5F, 1.0F);
}

bool is_blocked(const Robot& robot, Vec2 direction, Vec2 obstacle) noexcept {
  const float d = norm(obstacle);
  return d < body_m(robot) + near_m && dot(direction, obstacle) > (allowed_cosine(robot, d) + 1e-3F) * d;
}

// Index of the first obstacle in the way, -1 if the direction is free.
int find_blocking(const Robot& robot, Vec2 direction) noexcept {
  for (std::size_t k = 0; k < robot.obstacles.size(); ++k)
    if (is_blocked(robot, direction, robot.obstacles[k])) return static_cast<int>(k);
  return -1;
}

struct Course {
  Vec2 direction;
  Vec2 contact;
};

// Along the obstacle at `contact`, and along whatever else turns up on this side.
Course sweep(const Robot& robot, Vec2 contact, int side) noexcept {
  Course course{{}, contact};
  for (std::size_t round = 0; round <= robot.obstacles.size(); ++round) {
    const Vec2 n = unit(course.contact);
    const float c = allowed_cosine(robot, norm(course.contact));
    course.direction = n * c + left_of(n) * (static_cast<float>(side) * std::sqrt(std::max(0.0F, 1.0F - c * c)));
    const int k = find_blocking(robot, course.direction);
    if (k < 0) return course;
    course.contact = robot.obstacles[static_cast<std::size_t>(k)];
  }
  return course;
}

// ---- A detour ----

// The side on which the obstacle takes me less far from the goal; of equal ones each robot its own,
// so that several find out more.
void begin(const Robot& robot, Vec2 goal, Vec2 contact) noexcept {
  Detour& detour = robot.self.detour;
  const Vec2 to_goal = unit(goal);
  const float left = dot(sweep(robot, contact, 1).direction, to_goal);
  const float right = dot(sweep(robot, contact, -1).direction, to_goal);
  const bool equal = std::abs(left - right) < 0.01F;
  detour.side = (equal ? robot.self.id % 2 == 0 : left > right) ? std::int8_t{1} : std::int8_t{-1};
  detour.contact = contact;
  detour.origin = {};
  detour.goal = goal;
  detour.leave_m = norm(goal);
  detour.span_m = first_span * robot.params.communication_range_m;
}

// The point of the obstacle that is being followed; the null vector if it is out of sight.
Vec2 followed(const Robot& robot) noexcept {
  Vec2 best;
  float best_m = same_obstacle_m;
  for (const Vec2 o : robot.obstacles) {
    const float d = distance(o, robot.self.detour.contact);
    if (d >= best_m) continue;
    best = o;
    best_m = d;
  }
  return best;
}

template <class Visit>
void for_each_obstacle(const Robot& robot, Visit visit) noexcept {
  for (const Vec2 o : robot.obstacles) visit(o);
  const Landmarks& known = robot.self.landmarks;
  for (int k = 0; k < known.size; ++k) visit(known.points[static_cast<std::size_t>(k)]);
}

// ---- Lines of sight ----

// An obstacle point beside the segment from me to a neighbour.
struct Threat {
  Vec2 towards;   // unit, from the segment to the point
  float across_m; // its distance from the segment
  float lever;    // how far the segment moves there when I move by 1
};

template <class Visit>
void for_each_threat(const Robot& robot, Vec2 neighbor, Visit visit) noexcept {
  const float d = norm(neighbor);
  if (d <= 0.0F) return;
  const Vec2 along = neighbor / d;
  for_each_obstacle(robot, [&](Vec2 o) {
    const float a = dot(along, o);
    const float across = cross(along, o);
    if (a <= 0.0F || a >= d || std::abs(across) >= sight_width_m) return;
    visit(Threat{left_of(along) * (across < 0.0F ? -1.0F : 1.0F), std::abs(across), 1.0F - a / d});
  });
}

template <class Visit>
void for_each_edge_of_both_trees(const Robot& robot, Visit visit) noexcept {
  const Neighborhood& table = robot.table();
  if (robot.parent_alive()) visit(robot.parent);
  if (robot.old_parent_alive() && robot.old_parent != robot.parent) visit(robot.old_parent);
  for (const int k : robot.children)
    if (table.message(k).role != Role::spare) visit(k);
  for (const int k : robot.old_children)
    if (table.message(k).role != Role::spare) visit(k);
}

// How far a point is from the nearest of my tree edges: how little it matters.
float to_edges(const Robot& robot, Vec2 p) noexcept {
  float nearest_m = norm(p);
  for_each_edge_of_both_trees(robot, [&](int k) { nearest_m = std::min(nearest_m, norm(nearest_on_segment(-p, robot.table().position(k) - p))); });
  return nearest_m;
}

// Of more than there is room for, those go that matter least.
void file(const Robot& robot, Vec2 o) noexcept {
  Landmarks& known = robot.self.landmarks;
  const auto begin = known.points.begin();
  if (std::any_of(begin, begin + known.size, [&](Vec2 p) { return distance(p, o) < spacing_m; })) return;
  if (known.size < landmark_capacity) {
    known.points[known.size++] = o;
    return;
  }
  const auto key = [&](Vec2 p) { return to_edges(robot, p); };
  Vec2& least = *std::max_element(begin, begin + known.size, [&](Vec2 a, Vec2 b) { return key(a) < key(b); });
  if (key(o) <= key(least)) least = o;
}

// What children know of corners beside their edge to me.
void hear_of_corners(const Robot& robot) noexcept {
  const Neighborhood& table = robot.table();
  const auto hear = [&](int k) {
    const Standing& m = table.message(k);
    if (table.age(k) > 0 || up_of(m) != robot.self.id || (m.hinge_x_cm == 0 && m.hinge_y_cm == 0)) return;
    file(robot, from_edge_frame({static_cast<float>(m.hinge_x_cm) * 0.01F, static_cast<float>(m.hinge_y_cm) * 0.01F}, table.position(k)));
  };
  for (const int k : robot.children) hear(k);
  for (const int k : robot.old_children) hear(k);
}

// Where to go when the tree falls silent: a robot of the tree to where it stood, a spare to where the
// nearest robot of the tree was.
void note_contact(const Robot& robot) noexcept {
  State& self = robot.self;
  const Neighborhood& table = robot.table();
  if (robot.parent >= 0) {
    if (table.age(robot.parent) == 0) self.seen_from = {};
    return;
  }
  // By way of whom the root's count comes, there is the tree.
  int nearest = -1;
  const auto key = [&](int k) { return std::pair(table.message(k).tree_hops, table.range(k)); };
  for (int k = 0; k < table.size(); ++k)
    if (table.age(k) == 0 && (nearest < 0 || key(k) < key(nearest))) nearest = k;
  if (nearest < 0) return;
  const Standing& m = table.message(nearest);
  if (m.epoch == self.epoch && m.pulse > self.pulse) self.seen_from = table.position(nearest);
}

// How near obstacles come to the line of sight to a neighbour; sight_width_m if they do not.
float room_beside(const Robot& robot, Vec2 neighbor) noexcept {
  float room_m = sight_width_m;
  for_each_threat(robot, neighbor, [&](const Threat& t) { room_m = std::min(room_m, t.across_m); });
  return room_m;
}

// The root is where the spares are: it must not lose the last of them behind a corner. Index of the
// one that it sees best; -1 if that one is in no danger, or for all other robots.
int last_in_sight(const Robot& robot) noexcept {
  if (!robot.is_root() || robot.self.landmarks.size == 0) return -1;
  const Neighborhood& table = robot.table();
  int best = -1;
  float best_m = 0.0F;
  for (int k = 0; k < table.size(); ++k) {
    if (!table.alive(k) || table.message(k).role != Role::spare) continue;
    const float room_m = room_beside(robot, table.position(k));
    if (room_m >= sight_width_m) return -1;
    if (best >= 0 && room_m <= best_m) continue;
    best = k;
    best_m = room_m;
  }
  return best;
}

// A child that has to go on is held back by me.
bool is_towed(const Robot& robot) noexcept {
  const Neighborhood& table = robot.table();
  const float start_m = robot.params.pull_start * robot.params.communication_range_m;
  const auto tows = [&](int k) {
    const Standing& m = table.message(k);
    return m.role != Role::spare && m.want_cm > 0 && (m.pinned || table.range(k) > start_m);
  };
  return std::any_of(robot.children.begin(), robot.children.end(), tows);
}

void forget_wrong(const Robot& robot) noexcept {
  Landmarks& known = robot.self.landmarks;
  float nearest_m = body_m(robot) + near_m;
  for (const Vec2 o : robot.obstacles) nearest_m = std::min(nearest_m, norm(o));
  const float far_m = forget * robot.params.communication_range_m;
  // A point nearer than anything that is sensed is not there any more, or never was.
  const auto is_wrong = [&](Vec2 p) { return norm(p) > far_m || norm(p) < nearest_m - spacing_m; };
  const auto end = std::remove_if(known.points.begin(), known.points.begin() + known.size, is_wrong);
  known.size = static_cast<std::uint8_t>(end - known.points.begin());
}

}  // namespace

void remember_obstacles(Robot& robot) noexcept {
  Landmarks& known = robot.self.landmarks;
  note_contact(robot);
  hear_of_corners(robot);
  if (known.size == 0 && robot.obstacles.empty()) return;
  forget_wrong(robot);
  for (const Vec2 o : robot.obstacles) file(robot, o);
}

bool find_hinge(const Robot& robot, Vec2& hinge) noexcept {
  const int up = robot.self.parent != nobody ? robot.parent : robot.old_parent;
  if (up < 0) return false;
  const Vec2 parent = robot.table().position(up);
  float best_m = hinge_width_m;
  for_each_obstacle(robot, [&](Vec2 o) {
    const float along = dot(o, parent);
    const float across_m = std::abs(cross(o, parent)) / std::max(norm(parent), 1e-3F);
    if (along <= 0.0F || along >= squared_norm(parent) || across_m >= best_m) return;
    best_m = across_m;
    hinge = o;
  });
  return best_m < hinge_width_m;
}

Vec2 bypass(const Robot& robot, Vec2 goal) noexcept {
  Detour& detour = robot.self.detour;
  const Vec2 straight = unit(goal);
  if (robot.obstacles.empty()) {
    detour = {};
    return straight;
  }
  const int blocking = find_blocking(robot, straight);
  Vec2 contact = detour.side != 0 ? followed(robot) : Vec2{};
  if (detour.side != 0) {
    if (distance(goal, detour.goal) > goal_moved_m) {  // another goal, or one that drives
      detour.goal = goal;
      detour.leave_m = norm(goal);
    }
    const bool done = blocking < 0 && norm(goal) < detour.leave_m - progress_m;
    if (done || contact == Vec2{}) detour = {};
  }
  if (detour.side == 0) {
    if (blocking < 0) return straight;
    contact = robot.obstacles[static_cast<std::size_t>(blocking)];
    begin(robot, goal, contact);
  } else if (norm(detour.origin) > detour.span_m) {
    detour.side = static_cast<std::int8_t>(-detour.side);
    detour.span_m *= 2.0F;
  }
  const Course course = sweep(robot, contact, detour.side);
  detour.contact = course.contact;
  return course.direction;
}

void keep_off(const Robot& robot, Guard& guard) noexcept {
  for (const Vec2 o : robot.obstacles) {
    const float d = norm(o);
    if (d > 0.0F) guard.add_limit(o / d, (d - body_m(robot) - 0.5F * keep_m) * robot.params.guard_rate_per_s);
  }
}

void keep_sight(const Robot& robot, Guard& guard) noexcept {
  if (!robot.params.line_of_sight) return;
  const auto keep = [&](int k) {
    for_each_threat(robot, robot.table().position(k), [&](const Threat& t) {
      if (t.lever < 0.1F) return;
      const float room_m = std::max(0.0F, t.across_m - sight_margin_m);
      guard.add_limit(t.towards, 0.5F * room_m * robot.params.guard_rate_per_s / t.lever);
    });
  };
  for_each_edge_of_both_trees(robot, keep);
  if (const int k = last_in_sight(robot); k >= 0) keep(k);
}

Vec2 clear_sight(const Robot& robot) noexcept {
  Vec2 u;
  if (!robot.params.line_of_sight) return u;
  for_each_edge_of_both_trees(robot, [&](int k) {
    for_each_threat(robot, robot.table().position(k), [&](const Threat& t) {
      u += -t.towards * (t.lever * std::min(sight_width_m / std::max(t.across_m, 1e-3F) - 1.0F, 2.0F));
    });
  });
  return u;
}

bool is_pinned(const Robot& robot) noexcept {
  if (robot.self.want_m <= 0.0F) return false;
  if (robot.is_root()) {
    const int k = last_in_sight(robot);
    return k >= 0 && robot.table().range(k) > pin_shortest_m;
  }
  if (!robot.parent_alive() || (!robot.self.is_worker && !is_towed(robot))) return false;
  return robot.table().range(robot.parent) > pin_shortest_m && room_beside(robot, robot.table().position(robot.parent)) < pin_width_m;
}

bool is_free(const Robot& robot, Vec2 a, Vec2 b, float clearance_m) noexcept {
  const Vec2 d = b - a;
  const float d2 = squared_norm(d);
  bool free = true;
  for_each_obstacle(robot, [&](Vec2 o) {
    const float along = dot(o - a, d);
    const float across = cross(o - a, d);
    free = free && (along <= 0.0F || along >= d2 || across * across >= clearance_m * clearance_m * d2);
  });
  return free;
}

}  // namespace banyan
