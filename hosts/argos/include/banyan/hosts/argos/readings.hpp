// SPDX-License-Identifier: MIT
// Between ARGoS' devices and a controller: units, frames, inverse characteristics. ARGoS measures in cm and cm/s,
// Banyan in m; both have x forward, y to the left, and angles counter-clockwise. Knows nothing of ARGoS' types.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "banyan/controller/core/inputs.hpp"
#include "banyan/controller/core/platform.hpp"

namespace banyan::argos {

// Where the sender of a range-and-bearing packet is. ARGoS' range is the distance in space.
[[nodiscard]] Vec2 position_of(double range_cm, double bearing_rad, double vertical_bearing_rad) noexcept;

// Only zeros: the sender has not said anything yet, or has been silenced. No message of ours is that.
[[nodiscard]] bool is_silence(std::span<const std::uint8_t> bytes) noexcept;

// The way of two wheels that have turned at these speeds for one tick: the chord of the arc.
[[nodiscard]] Odometry odometry_of(double left_cm_s, double right_cm_s, double wheel_distance_m,
                                   double tick_s) noexcept;

struct WheelCommand {
  double left_cm_s = 0.0;
  double right_cm_s = 0.0;
};
// Each wheel within the limit: ARGoS' actuator has none.
[[nodiscard]] WheelCommand wheel_command(const Velocity& velocity, const Platform& platform) noexcept;

// `target` in the body frame of a robot at `position` that looks along `heading_rad`.
[[nodiscard]] Vec2 in_body_frame(BasicVec2<double> target, BasicVec2<double> position, double heading_rad) noexcept;

// How far what a proximity sensor sees is from the body's edge, m; nothing: it sees nothing.
struct ProximityModel {
  std::optional<double> (*distance_m)(double reading);
  double ring_m;  // the sensors' distance from the robot's centre
};
extern const ProximityModel kheperaiv_proximity;  // 0.04 to 0.12 m; nearer is 0.04 m
extern const ProximityModel footbot_proximity;    // up to 0.1 m
[[nodiscard]] std::optional<Vec2> obstacle_at(const ProximityModel& model, double reading, double angle_rad) noexcept;

// One light sensor of a ring, as the foot-bot's are simulated: exp(-2 d / intensity), falling to nothing at a right
// angle, and nothing farther away than 2.5 times the intensity.
struct LightReading {
  double value = 0.0;
  double angle_rad = 0.0;
};
// Where the only light is, m. None: it is not seen.
[[nodiscard]] std::optional<Vec2> light_at(std::span<const LightReading> ring, double intensity_m) noexcept;

// The number that the name of a robot ends with ("kh12": 12). None if there is none, or it is no RobotId.
[[nodiscard]] std::optional<RobotId> id_of(std::string_view name) noexcept;

}  // namespace banyan::argos
