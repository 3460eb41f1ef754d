// SPDX-License-Identifier: MIT
// What a vehicle with an autopilot (PX4, ArduPilot) is to its robot's process: where it says that it is, what it is to
// be told, and whether either can be trusted. Knows neither sockets nor wall time. It never arms a vehicle and never
// changes its mode.
//
// A scenario's x is east, its y north. A vehicle's local frame is north, east, down, from an origin of its own: `home`
// says where that is in the scenario.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "banyan/hosts/udp/mavlink.hpp"
#include "banyan/hosts/udp/pose_history.hpp"
#include "banyan/hosts/udp/pose_stream.hpp"

namespace banyan::udp {

struct GlobePoint {
  double latitude_deg = 0.0, longitude_deg = 0.0;
};
// How far `point` is east (x) and north (y) of `origin`, in m; for distances that are small against the earth.
[[nodiscard]] BasicVec2<double> metres_from(const GlobePoint& origin, const GlobePoint& point) noexcept;

struct AutopilotSetup {
  std::uint8_t system = 1;  // MAV_SYS_ID of the vehicle
  double height_m = 0.0;    // to be kept, above the origin of its local frame
  // Where that is, in the scenario's frame: given; or by the vehicle's GPS_GLOBAL_ORIGIN or HOME_POSITION, from where
  // on the globe the scenario's origin is; or neither, if a tracker sees the vehicle.
  std::optional<BasicVec2<double>> home;
  std::optional<GlobePoint> origin;
};

class Autopilot {
 public:
  explicit Autopilot(const AutopilotSetup& setup) : setup_(setup), home_(setup.home) {}

  void hear(const MavlinkWord& word, const Address& from, double now_s);
  // Judges what has been heard until now. To be called after hear(), and often.
  void refresh(double now_s);

  // Why it must stand still, in words; empty: it need not.
  [[nodiscard]] const std::string& fault() const noexcept { return fault_text_; }
  // Where its system has been heard: two of them are a fault. A lone one stays when it has fallen silent.
  struct Source {
    Address address;
    double heartbeat_s = 0.0;
  };
  [[nodiscard]] std::span<const Source> sources() const noexcept { return sources_; }

  // `velocity`, of the body, as a set-point; all zeros while there is a fault.
  [[nodiscard]] MavlinkSetPoint set_point(const Velocity& velocity, double now_s) const noexcept;
  // Its local frame as that of an odometry: x east, y north.
  [[nodiscard]] const PoseHistory& poses() const noexcept { return poses_; }
  // In the scenario's frame; nothing while there is a fault, or if only a tracker knows.
  [[nodiscard]] std::optional<TrackedPose> place() const;

 private:
  enum class Fault { none, unheard, silent, doubled, uncertain, no_position, no_yaw, no_home };
  void hear_heartbeat(const MavlinkWord& word, const MavlinkHeartbeat& heartbeat, const Address& from, double now_s);
  void take(const MavlinkPosition& position, double now_s);
  [[nodiscard]] Fault judge(double now_s) const noexcept;
  [[nodiscard]] std::string words_for(Fault fault) const;

  AutopilotSetup setup_;
  std::optional<BasicVec2<double>> home_;  // east, north
  bool knows_origin_ = false;              // by GPS_GLOBAL_ORIGIN, which says it directly
  bool is_ardupilot_ = false;              // whose HOME_POSITION leaves out where that is in the local frame
  std::vector<Source> sources_;
  std::optional<std::uint8_t> other_system_;  // another autopilot that was heard
  PoseHistory poses_;
  float yaw_rad_ = 0.0F, down_m_ = 0.0F;
  double yaw_s_ = long_ago_s, position_s_ = long_ago_s;  // when they came
  double local_position_s_ = long_ago_s;                 // a LOCAL_POSITION_NED, which goes before ODOMETRY
  std::optional<std::uint16_t> estimator_flags_;
  Fault fault_ = Fault::unheard;
  std::string fault_text_;
  double begun_s_ = -1.0;

  static constexpr double long_ago_s = -1e9;
};

}  // namespace banyan::udp
