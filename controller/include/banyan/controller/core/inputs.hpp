// SPDX-License-Identifier: MIT
// What a robot senses between two steps, as its host hands it in, and what its step answers. Hosts measure in metres
// and seconds; behind the gate (gate.hpp) and in Motion lengths are in C and speeds in v_max (platform.hpp). Everything
// is in the robot's own body frame: x forward, y to the left.
#pragma once

#include <optional>
#include <span>

#include "banyan/controller/core/platform.hpp"
#include "banyan/controller/core/robot_id.hpp"
#include "banyan/controller/core/trig.hpp"
#include "banyan/controller/core/vec2.hpp"

namespace banyan {

// The robot's own motion since its last step, in the body frame it had then, as its wheels measure it.
// A differential robot that has turned while it drove reports the chord: `sideways_m` is how far the
// arc has left the straight line, zero if the robot does not measure it.
struct Odometry {
  float forward_m = 0.0F;
  float sideways_m = 0.0F;
  float turn_rad = 0.0F;  // to the left
};

// A station does not wait for a robot that comes between it and its parent: its edge asks for one from here on, C.
inline constexpr float station_asks_from = 0.55F;

// What the mission tells a robot, over whatever channel the host has.
struct Orders {
  // This robot has been sent to a target. It stays sent until this is false again. A robot may
  // resign, or serve another robot's target instead; the host need not know.
  bool sent = false;
  // While it is sent: from the robot to that target; m from a host, C behind the gate. None: not sensed in this tick.
  std::optional<Vec2> target;
  // A target that has been given up, named by the robot first sent there: the robot that serves it stops.
  // Announced once.
  RobotId given_up = nobody;
  // The target that it is sent to is a charging place: the robot there keeps the place in the network.
  bool charging_place = false;
  // It is a station: somebody else moves it. It keeps its target, or the root's token if it began with that, and hands
  // neither on. `target` is where it will be before long; none: behind the gate it follows from how it moves.
  bool station = false;
};

// What a robot knows of its battery.
struct Charge {
  float level = 1.0F;     // share of a full one
  bool charging = false;  // it is being charged
  [[nodiscard]] constexpr bool is_possible() const noexcept { return level >= 0.0F && level <= 1.0F; }
};

struct Senses {
  Odometry odometry{};
  Orders orders{};
  // The nearest point of each obstacle within reach of the proximity sensor, m. No robots.
  std::span<const Vec2> obstacles{};
  // None: it does not run on a battery, or not measured in this step.
  std::optional<Charge> charge{};
  // Since the last step; a host without ticks may step when it likes. Counted in whole ticks, at least one. What the
  // paper gives in seconds, and every age and silence, grows by that time. What follows from how news travels, a hop
  // a message (a barrier that holds, an orphan without a parent, a question without an answer), counts steps, and
  // so do the root's and the workers' signs of life: robots that step less often than once a tick wait longer for them.
  float elapsed_s = 0.0F;  // 0: one tick

  // Readings that a robot may lack. One that is not possible counts as not sensed (gate.hpp).
  template <class Visit> constexpr void for_each_reading(Visit visit) { visit(charge); }
};

// What a step wants the motors to do until the next one. A differential robot is never given `sideways`; its two wheels
// never exceed v_max.
struct Motion {
  float forward = 0.0F;   // v_max
  float sideways = 0.0F;  // v_max
  float turn = 0.0F;      // rad per drive, to the left
};

// The same for a host's motors.
struct Velocity {
  float forward_m_s = 0.0F;
  float sideways_m_s = 0.0F;
  float turn_rad_s = 0.0F;
};
[[nodiscard]] constexpr Velocity velocity_of(const Motion& motion, const Platform& platform) noexcept {
  const float v_max = platform.wheel_limit_m_s;
  return {motion.forward * v_max, motion.sideways * v_max, motion.turn * (v_max / platform.communication_range_m)};
}

// The speeds of the two wheels that make that motion, m/s.
struct WheelSpeeds {
  float left_m_s = 0.0F;
  float right_m_s = 0.0F;
};
[[nodiscard]] constexpr WheelSpeeds wheel_speeds(const Velocity& velocity, float wheel_distance_m) noexcept {
  const float turn = 0.5F * velocity.turn_rad_s * wheel_distance_m;
  return {velocity.forward_m_s - turn, velocity.forward_m_s + turn};
}

// A point or vector remembered over ticks, carried along by own odometry every tick.
struct Carry {
  Vec2 shift;                 // C, or m for a host
  Vec2 rotation{1.0F, 0.0F};  // (cos, sin) of the turn
  Carry() = default;
  Carry(Vec2 moved, float turn_rad) noexcept : shift(moved), rotation(unit_vector(turn_rad)) {}
  explicit Carry(const Odometry& odometry) noexcept
      : Carry({odometry.forward_m, odometry.sideways_m}, odometry.turn_rad) {}
  [[nodiscard]] Vec2 point(Vec2 p) const noexcept { return rotate_back(rotation, p - shift); }
  [[nodiscard]] Vec2 vector(Vec2 v) const noexcept { return rotate_back(rotation, v); }
};

}  // namespace banyan
