// SPDX-License-Identifier: MIT
#include "obstacles/way_round.hpp"

#include <algorithm>
#include <cmath>

namespace banyan {
namespace {

constexpr float keep = 0.02F;           // between body and obstacle while driving along it
constexpr float same_obstacle = 0.10F;  // the contact point moves on by less in a tick
constexpr float progress = 0.025F;      // of C: a detour ends only so much nearer to the goal
constexpr float first_span = 0.35F;     // of C
constexpr float goal_moved = 0.15F;     // of C: it is another goal

// ---- One obstacle point: which directions it leaves free ----

// The largest allowed cosine between a direction of motion and that of an obstacle `d` away: only along the
// obstacle if it is near, towards it if there is room.
float allowed_cosine(const SensedObstacles& robot, float d) noexcept {
  constexpr float steers_off = 0.5F;  // at 30 degrees from an obstacle that it touches
  const float gap = d - robot.body_radius;
  return std::clamp((gap - keep) / (obstacle_near - keep), -steers_off, 1.0F);
}

bool is_blocked(const SensedObstacles& robot, Vec2 direction, Vec2 obstacle) noexcept {
  constexpr float rounding = 1e-3F;  // what sweep() finds is free
  const float d = norm(obstacle);
  return d < robot.body_radius + obstacle_near && dot(direction, obstacle) > (allowed_cosine(robot, d) + rounding) * d;
}

// Index of the first obstacle in the way, -1 if the direction is free.
int find_blocking(const SensedObstacles& robot, Vec2 direction) noexcept {
  for (std::size_t k = 0; k < robot.obstacles.size(); ++k)
    if (is_blocked(robot, direction, robot.obstacles[k])) return static_cast<int>(k);
  return -1;
}

struct FreeCourse {
  Vec2 direction;
  Vec2 contact;
};

// Along the obstacle at `contact`, and along any other that blocks the way on this side.
FreeCourse sweep(const SensedObstacles& robot, Vec2 contact, int side) noexcept {
  FreeCourse course{{}, contact};
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

// It may have been in vain: the robot remembers where the detour began and how wide it was.
void end(Detour& detour) noexcept {
  if (detour.side != 0) detour.last_side = detour.side;
  detour.side = 0;
}

// Takes the side that leads less far away from the goal; if both are equal, robots choose differently, so
// that several of them explore both.
void begin(const SensedObstacles& robot, Detour& detour, Vec2 goal, Vec2 contact) noexcept {
  detour.contact = contact;
  // Back where the last detour began, and no nearer to the goal: continue that one, and end it less easily.
  // Otherwise the robot would alternate for ever between the two ends of a pocket, or of a row of robots.
  const float before = distance(detour.origin, detour.goal);
  if (detour.last_side != 0 && norm(goal) > before - progress) {
    detour.side = detour.last_side;
    detour.again = true;
    detour.leave = before;
    return;
  }
  const Vec2 to_goal = unit(goal);
  const float left = dot(sweep(robot, contact, 1).direction, to_goal);
  const float right = dot(sweep(robot, contact, -1).direction, to_goal);
  constexpr float as_far = 0.01F;  // cosines differ by less
  const bool equal = std::abs(left - right) < as_far;
  detour.side = (equal ? robot.id % 2 == 0 : left > right) ? std::int8_t{1} : std::int8_t{-1};
  detour.again = false;
  detour.origin = {};
  detour.goal = goal;
  detour.leave = norm(goal);
  detour.span = first_span;
}

// The point of the obstacle that is being followed; the null vector if it is out of sight.
Vec2 followed(const SensedObstacles& robot, const Detour& detour) noexcept {
  Vec2 best;
  float best_length = same_obstacle;
  for (const Vec2 o : robot.obstacles) {
    const float d = distance(o, detour.contact);
    if (d >= best_length) continue;
    best = o;
    best_length = d;
  }
  return best;
}

}  // namespace

void carry_detour(Detour& detour, const Carry& carry) noexcept {
  // A robot pushed back on its way round might never get as near to the goal as it was, and would circle
  // for ever: so the distance at which the detour counts as done grows with the way driven.
  constexpr float allowance = 0.25F;
  constexpr float allowance_again = 0.025F;  // the same for a detour that is continued
  if (detour.side == 0 && detour.last_side == 0) return;
  for (Vec2* v : {&detour.contact, &detour.origin, &detour.goal}) *v = carry.point(*v);
  detour.leave += (detour.again ? allowance_again : allowance) * norm(carry.shift);
}

Vec2 bypass(const SensedObstacles& robot, Detour& detour, Vec2 goal) noexcept {
  const Vec2 straight = unit(goal);
  // It has left the area that it searched, or has another goal.
  if (detour.last_side != 0 && detour.side == 0 &&
      (norm(detour.origin) > detour.span || distance(goal, detour.goal) > goal_moved))
    detour = {};
  if (robot.obstacles.empty()) {
    end(detour);
    return straight;
  }
  const int blocking = find_blocking(robot, straight);
  Vec2 contact = detour.side != 0 ? followed(robot, detour) : Vec2{};
  if (detour.side != 0) {
    if (distance(goal, detour.goal) > goal_moved) {  // another goal, or one that moves
      detour.goal = goal;
      detour.leave = norm(goal);
    }
    const bool done = blocking < 0 && norm(goal) < detour.leave - progress;
    if (done || contact == Vec2{}) end(detour);
  }
  if (detour.side == 0) {
    if (blocking < 0) return straight;
    contact = robot.obstacles[static_cast<std::size_t>(blocking)];
    begin(robot, detour, goal, contact);
  } else if (norm(detour.origin) > detour.span) {
    detour.side = static_cast<std::int8_t>(-detour.side);
    detour.span *= 2.0F;
  }
  const FreeCourse course = sweep(robot, contact, detour.side);
  detour.contact = course.contact;
  return course.direction;
}

void keep_off(const SensedObstacles& robot, float rate, Guard& guard) noexcept {
  for (const Vec2 o : robot.obstacles) {
    const float d = norm(o);
    if (d > 0.0F) guard.add_limit(o / d, (d - robot.body_radius - 0.5F * keep) * rate);
  }
}

}  // namespace banyan
