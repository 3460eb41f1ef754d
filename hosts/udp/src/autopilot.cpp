// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/autopilot.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "banyan/controller/core/trig.hpp"

namespace banyan::udp {
namespace {

constexpr double silent_after_s = 2.0;    // heartbeats come once a second
constexpr double estimate_lasts_s = 0.5;  // of a position and a heading
constexpr double begin_within_s = 2.0;    // before it is said that nothing has been heard
constexpr std::size_t most_sources = 8;
constexpr std::uint8_t autopilot_component = 1, ardupilot = 3, no_autopilot = 8;

// ESTIMATOR_STATUS_FLAGS
constexpr unsigned attitude_ok = 1, velocity_ok = 2, relative_position_ok = 8, absolute_position_ok = 16,
                   constant_position = 128;

constexpr float climb_per_m = 1.0F, fastest_climb_m_s = 1.0F;

constexpr double earth_radius_m = 6371000.0;

bool is_sure(std::uint16_t flags) noexcept {
  const bool has_position = (flags & (relative_position_ok | absolute_position_ok)) != 0;
  return (flags & (attitude_ok | velocity_ok)) == (attitude_ok | velocity_ok) && has_position &&
         (flags & constant_position) == 0;
}

std::string in_hex(unsigned value) {
  std::string text;
  for (int shift = 12; shift >= 0; shift -= 4) text += "0123456789abcdef"[value >> static_cast<unsigned>(shift) & 15U];
  return "0x" + text;
}

}  // namespace

BasicVec2<double> metres_from(const GlobePoint& origin, const GlobePoint& point) noexcept {
  constexpr double radians = pi<double> / 180.0;
  double east_deg = point.longitude_deg - origin.longitude_deg;
  if (east_deg > 180.0) east_deg -= 360.0;
  if (east_deg < -180.0) east_deg += 360.0;
  const double shrink = unit_vector(radians * origin.latitude_deg).x;
  return {earth_radius_m * shrink * radians * east_deg,
          earth_radius_m * radians * (point.latitude_deg - origin.latitude_deg)};
}

void Autopilot::hear_heartbeat(const MavlinkWord& word, const MavlinkHeartbeat& heartbeat, const Address& from,
                               double now_s) {
  if (heartbeat.autopilot == no_autopilot) return;
  if (word.system != setup_.system) {
    other_system_ = word.system;
    return;
  }
  is_ardupilot_ = heartbeat.autopilot == ardupilot;
  const auto known =
      std::find_if(sources_.begin(), sources_.end(), [&](const Source& source) { return source.address == from; });
  if (known != sources_.end()) known->heartbeat_s = now_s;
  else if (sources_.size() < most_sources) sources_.push_back({from, now_s});
}

void Autopilot::take(const MavlinkPosition& position, double now_s) {
  position_s_ = now_s;
  down_m_ = position.down_m;
  if (now_s - yaw_s_ > estimate_lasts_s) return;
  poses_.take({{position.east_m, position.north_m}, pi<float> / 2.0F - yaw_rad_}, now_s);
}

void Autopilot::hear(const MavlinkWord& word, const Address& from, double now_s) {
  if (word.component != autopilot_component) return;
  if (const auto* heartbeat = std::get_if<MavlinkHeartbeat>(&word.message))
    return hear_heartbeat(word, *heartbeat, from, now_s);
  if (word.system != setup_.system || sources_.size() != 1 || !(sources_.front().address == from)) return;
  if (const auto* attitude = std::get_if<MavlinkAttitude>(&word.message)) {
    yaw_rad_ = attitude->yaw_rad;
    yaw_s_ = now_s;
  } else if (const auto* position = std::get_if<MavlinkPosition>(&word.message)) {
    local_position_s_ = now_s;
    take(*position, now_s);
  } else if (const auto* odometry = std::get_if<MavlinkOdometry>(&word.message)) {
    if (now_s - local_position_s_ <= estimate_lasts_s) return;
    yaw_rad_ = odometry->yaw_rad;
    yaw_s_ = now_s;
    take(odometry->position, now_s);
  } else if (const auto* estimator = std::get_if<MavlinkEstimator>(&word.message)) {
    estimator_flags_ = estimator->flags;
  } else if (const auto* reference = std::get_if<MavlinkReference>(&word.message)) {
    if (!setup_.origin || (!reference->is_origin && (knows_origin_ || is_ardupilot_))) return;
    knows_origin_ = knows_origin_ || reference->is_origin;
    const auto point = metres_from(*setup_.origin, {reference->latitude_deg, reference->longitude_deg});
    home_ = point - BasicVec2<double>{reference->east_m, reference->north_m};
  }
}

Autopilot::Fault Autopilot::judge(double now_s) const noexcept {
  if (sources_.empty()) return Fault::unheard;
  if (sources_.size() > 1) return Fault::doubled;
  if (now_s - sources_.front().heartbeat_s > silent_after_s) return Fault::silent;
  if (estimator_flags_ && !is_sure(*estimator_flags_)) return Fault::uncertain;
  if (now_s - position_s_ > estimate_lasts_s) return Fault::no_position;
  if (now_s - yaw_s_ > estimate_lasts_s || !poses_.last_s()) return Fault::no_yaw;
  if (setup_.origin && !home_) return Fault::no_home;
  return Fault::none;
}

std::string Autopilot::words_for(Fault fault) const {
  const std::string system = std::to_string(setup_.system);
  switch (fault) {
    case Fault::none: return {};
    case Fault::unheard:
      return "nothing is heard of MAVLink system " + system +
             (other_system_ ? ", but of " + std::to_string(*other_system_) + "; --system says which is this robot's"
                            : std::string());
    case Fault::silent: return "no heartbeat of MAVLink system " + system + " for 2 s";
    case Fault::doubled:
      return "two vehicles are MAVLink system " + system + ": at " + to_string(sources_[0].address) + " and at " +
             to_string(sources_[1].address);
    case Fault::uncertain:
      return "MAVLink system " + system + " is not sure where it is: its estimator's flags are " +
             in_hex(estimator_flags_.value_or(0));
    case Fault::no_position:
      return "MAVLink system " + system +
             " has not said where it is for 0.5 s: LOCAL_POSITION_NED, or ODOMETRY in MAV_FRAME_LOCAL_NED, is needed "
             "ten times a second";
    case Fault::no_yaw:
      return "MAVLink system " + system +
             " has not said where it points for 0.5 s: ATTITUDE is needed ten times a second";
    case Fault::no_home:
      return "MAVLink system " + system + " has not said where its local frame begins: GPS_GLOBAL_ORIGIN" +
             (is_ardupilot_ ? "" : " or HOME_POSITION") + " is needed once";
  }
  return {};
}

void Autopilot::refresh(double now_s) {
  if (begun_s_ < 0.0) begun_s_ = now_s;
  std::sort(sources_.begin(), sources_.end(),
            [](const Source& a, const Source& b) { return a.heartbeat_s > b.heartbeat_s; });
  while (sources_.size() > 1 && now_s - sources_.back().heartbeat_s > silent_after_s) sources_.pop_back();
  fault_ = judge(now_s);
  // At the start there is nothing to say yet.
  if (fault_ != Fault::none && fault_ != Fault::doubled && now_s - begun_s_ < begin_within_s) return;
  if (std::string words = words_for(fault_); words != fault_text_) fault_text_ = std::move(words);
}

MavlinkSetPoint Autopilot::set_point(const Velocity& velocity, double now_s) const noexcept {
  MavlinkSetPoint set_point{static_cast<std::uint32_t>(std::fmod(now_s * 1000.0, 4294967296.0)), setup_.system,
                            autopilot_component};
  if (fault_ != Fault::none) return set_point;
  // Left of forward in a frame whose second axis is to the right of the first is its negative.
  const Vec2 ground = rotate(unit_vector(yaw_rad_), Vec2{velocity.forward_m_s, -velocity.sideways_m_s});
  set_point.north_m_s = ground.x;
  set_point.east_m_s = ground.y;
  set_point.down_m_s =
      std::clamp(-climb_per_m * (static_cast<float>(setup_.height_m) + down_m_), -fastest_climb_m_s, fastest_climb_m_s);
  set_point.yaw_rate_rad_s = -velocity.turn_rad_s;
  return set_point;
}

std::optional<TrackedPose> Autopilot::place() const {
  if (fault_ != Fault::none || !home_) return std::nullopt;
  const OdometricPose pose = poses_.at(poses_.last_s().value_or(0.0));
  return TrackedPose{*home_ + BasicVec2<double>{pose.position.x, pose.position.y}, pose.turn_rad};
}

}  // namespace banyan::udp
