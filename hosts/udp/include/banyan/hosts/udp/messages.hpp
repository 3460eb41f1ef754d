// SPDX-License-Identifier: MIT
// What hub and robots tell each other, as payloads of datagrams (envelope.hpp). Numbers are little-endian, lengths in
// m, angles in rad. Decoding returns nothing for bytes that encoding does not write, and never reads beyond them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "banyan/controller/core/inputs.hpp"
#include "banyan/controller/core/report.hpp"
#include "banyan/hosts/udp/bytes.hpp"

namespace banyan::udp {

// Where a robot's odometry says that it is, since the hub or the base began to count. Lost packets lose no motion.
struct OdometricPose {
  Vec2 position;
  float turn_rad = 0.0F;

  // From the body frame to the frame of the odometry, and back.
  [[nodiscard]] Vec2 outside(Vec2 in_body) const noexcept { return position + rotate(unit_vector(turn_rad), in_body); }
  [[nodiscard]] Vec2 inside(Vec2 point) const noexcept { return rotate_back(unit_vector(turn_rad), point - position); }
  friend bool operator==(const OdometricPose&, const OdometricPose&) = default;
};
[[nodiscard]] OdometricPose moved(const OdometricPose& pose, const Odometry& motion) noexcept;
[[nodiscard]] Odometry motion_between(const OdometricPose& before, const OdometricPose& now) noexcept;

inline constexpr std::size_t most_seen = 64;  // obstacle points in a frame

// EnvelopeKind::frame, hub to robot, once a tick: the mission's orders and what the robot senses.
struct SensorFrame {
  std::uint32_t mission = 0;  // a hub that goes on with a mission after a restart keeps its number
  std::uint32_t tick = 0;
  bool root = false;    // how a robot begins: the first root,
  bool worker = false;  // one that will be sent to a target
  bool begun = false;   // it has taken part before and has started again
  bool sent = false;    // Orders
  bool has_target = false;
  bool line_of_sight = true;
  bool station = false;    // Orders
  OdometricPose odometry;  // a robot with a base of its own measures that itself
  Vec2 target;
  RobotId given_up = nobody;  // repeated until the robot's status has its serial
  std::uint8_t given_up_serial = 0;
  std::vector<Vec2> obstacles;
  friend bool operator==(const SensorFrame&, const SensorFrame&) = default;
};

// EnvelopeKind::heard, hub to robot: a message of another robot and where that was measured to be.
struct Hearing {
  RobotId sender = nobody;
  Vec2 position;  // in the receiver's body frame at `tick`
  Bytes message;
  friend bool operator==(const Hearing&, const Hearing&) = default;
};
struct HeardBundle {
  std::uint32_t tick = 0;
  OdometricPose odometry;  // of the receiver at `tick`
  std::vector<Hearing> packets;
  friend bool operator==(const HeardBundle&, const HeardBundle&) = default;
};

// EnvelopeKind::status, robot to hub, once a step: what it broadcasts, how it wants to move, what it reports.
struct Status {
  std::uint32_t frame_tick = 0;  // of the newest frame that it has
  std::uint32_t period_us = 0;   // since its last step
  std::uint32_t dropped = 0;     // datagrams that it did not accept
  std::uint8_t given_up_serial = 0;
  Velocity velocity;
  Report report;
  Bytes message;
};

// EnvelopeKind::account, robot to whoever listens to robots without a hub, once a step: its status, and what it has
// measured.
struct Sighting {
  RobotId robot = nobody;
  Vec2 position;  // in the body frame of the teller
  friend bool operator==(const Sighting&, const Sighting&) = default;
};
inline constexpr std::size_t most_sightings = 64;
struct Account {
  Status status;
  OdometricPose odometry;      // its turn within half a turn: whole turns are not told
  std::optional<Vec2> target;  // in its body frame, as are sightings
  std::vector<Sighting> seen;
};

[[nodiscard]] Bytes encode(const SensorFrame& frame);
[[nodiscard]] Bytes encode(const HeardBundle& heard);
[[nodiscard]] Bytes encode(const Status& status);
[[nodiscard]] Bytes encode(const Account& account);  // the first most_sightings
[[nodiscard]] std::optional<SensorFrame> decode_frame(ByteView bytes);
[[nodiscard]] std::optional<HeardBundle> decode_heard(ByteView bytes);
[[nodiscard]] std::optional<Status> decode_status(ByteView bytes);
[[nodiscard]] std::optional<Account> decode_account(ByteView bytes);

}  // namespace banyan::udp
