// SPDX-License-Identifier: MIT
#include "banyan/hosts/argos/readings.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "banyan/controller/core/trig.hpp"

namespace banyan::argos {
namespace {

constexpr double cm = 0.01;

Vec2 single(BasicVec2<double> v) noexcept { return {static_cast<float>(v.x), static_cast<float>(v.y)}; }

// 4.14 exp(-33 d) - 0.085 from 0.04 to 0.12 m; 1 nearer, 0 farther.
std::optional<double> kheperaiv_distance_m(double reading) {
  if (!(reading > 0.0)) return std::nullopt;
  constexpr double nearest_m = 0.04, farthest_m = 0.12;
  if (reading >= 1.0) return nearest_m;
  return std::clamp(std::log(4.14 / (reading + 0.085)) / 33.0, nearest_m, farthest_m);
}

// 0.0100527 / (d + 0.000163144), 1 nearer than 1 cm.
std::optional<double> footbot_distance_m(double reading) {
  constexpr double farthest_m = 0.1;
  if (!(reading > 0.0)) return std::nullopt;
  const double distance_m = 0.0100527 / std::min(reading, 1.0) - 0.000163144;
  return distance_m <= farthest_m * 1.001 ? std::optional(distance_m) : std::nullopt;
}

}  // namespace

const ProximityModel kheperaiv_proximity{kheperaiv_distance_m, 0.0704};
const ProximityModel footbot_proximity{footbot_distance_m, 0.085036758};

Vec2 position_of(double range_cm, double bearing_rad, double vertical_bearing_rad) noexcept {
  return single(range_cm * cm * unit_vector(vertical_bearing_rad).x * unit_vector(bearing_rad));
}

bool is_silence(std::span<const std::uint8_t> bytes) noexcept {
  return std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t byte) { return byte == 0; });
}

Odometry odometry_of(double left_cm_s, double right_cm_s, double wheel_distance_m, double tick_s) noexcept {
  const double way_m = 0.5 * (left_cm_s + right_cm_s) * cm * tick_s;
  const double turn_rad = (right_cm_s - left_cm_s) * cm * tick_s / wheel_distance_m;
  const double half = 0.5 * turn_rad;
  const double chord_m = std::abs(half) < 1e-4 ? way_m : way_m * unit_vector(half).y / half;
  const Vec2 shift = single(chord_m * unit_vector(half));
  return {shift.x, shift.y, static_cast<float>(turn_rad)};
}

WheelCommand wheel_command(const Velocity& velocity, const Platform& platform) noexcept {
  const WheelSpeeds wheels = wheel_speeds(velocity, platform.wheel_distance_m);
  const float limit = platform.wheel_limit_m_s;
  return {static_cast<double>(std::clamp(wheels.left_m_s, -limit, limit)) / cm,
          static_cast<double>(std::clamp(wheels.right_m_s, -limit, limit)) / cm};
}

Vec2 in_body_frame(BasicVec2<double> target, BasicVec2<double> position, double heading_rad) noexcept {
  return single(rotate_back(unit_vector(heading_rad), target - position));
}

std::optional<Vec2> obstacle_at(const ProximityModel& model, double reading, double angle_rad) noexcept {
  const std::optional<double> distance_m = model.distance_m(reading);
  if (!distance_m) return std::nullopt;
  return single((model.ring_m + *distance_m) * unit_vector(angle_rad));
}

std::optional<Vec2> light_at(std::span<const LightReading> ring, double intensity_m) noexcept {
  BasicVec2<double> sum;
  const LightReading* brightest = nullptr;
  for (const LightReading& sensor : ring) {
    if (!(sensor.value > 0.0)) continue;
    sum += sensor.value * unit_vector(sensor.angle_rad);
    if (brightest == nullptr || sensor.value > brightest->value) brightest = &sensor;
  }
  if (brightest == nullptr || norm(sum) <= 0.0) return std::nullopt;
  const double off_rad = std::abs(angle_of(rotate_back(unit_vector(brightest->angle_rad), sum)));
  const double head_on = brightest->value / std::max(0.1, 1.0 - 2.0 * off_rad / pi<double>);
  const double distance_m = -0.5 * intensity_m * std::log(std::min(head_on, 1.0));
  return single(distance_m / norm(sum) * sum);
}

std::optional<RobotId> id_of(std::string_view name) noexcept {
  std::size_t begin = name.size();
  while (begin > 0 && name[begin - 1] >= '0' && name[begin - 1] <= '9') --begin;
  RobotId id = nobody;
  const auto [end, error] = std::from_chars(name.data() + begin, name.data() + name.size(), id);
  if (error != std::errc() || end != name.data() + name.size() || id == nobody) return std::nullopt;
  return id;
}

}  // namespace banyan::argos
