// SPDX-License-Identifier: MIT
// The few messages of MAVLink (https://mavlink.io) that steer a vehicle and tell where it is. Versions 1 and 2 are
// read, 2 is written. A packet is
//
//   version 1   0xFE LENGTH SEQUENCE SYSTEM COMPONENT ID payload CRC
//   version 2   0xFD LENGTH INCOMPATIBLE COMPATIBLE SEQUENCE SYSTEM COMPONENT ID(3) payload CRC [SIGNATURE(13)]
//
// Numbers are little-endian. The CRC is CRC-16/MCRF4XX of all from LENGTH on, and of one byte more that belongs to the
// message's definition. Version 2 leaves out zeros at the end of a payload, but for its first byte. Signatures are
// skipped, not checked: the wire must be trusted.
//
// Positions are in the vehicle's local frame: x north, y east, z down, m. Angles are in rad, clockwise from north.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "banyan/hosts/udp/bytes.hpp"

namespace banyan::udp {

[[nodiscard]] std::uint16_t mavlink_crc(ByteView bytes, std::uint16_t before = 0xFFFF) noexcept;

// ---- What a vehicle says: the fields that are used ----

struct MavlinkHeartbeat {
  std::uint8_t type = 0;       // MAV_TYPE
  std::uint8_t autopilot = 0;  // MAV_AUTOPILOT; 8: it is none
};
struct MavlinkAttitude {
  float yaw_rad = 0.0F;
};
struct MavlinkPosition {  // LOCAL_POSITION_NED
  float north_m = 0.0F, east_m = 0.0F, down_m = 0.0F;
};
struct MavlinkOdometry {  // ODOMETRY in MAV_FRAME_LOCAL_NED; other frames know no north and count as unknown
  MavlinkPosition position;
  float yaw_rad = 0.0F;
};
struct MavlinkEstimator {  // ESTIMATOR_STATUS, and EKF_STATUS_REPORT, which has the same bits
  std::uint16_t flags = 0;
};
// HOME_POSITION or GPS_GLOBAL_ORIGIN: a place on the globe, and where that is in the local frame.
struct MavlinkReference {
  bool is_origin = false;  // of the local frame itself
  double latitude_deg = 0.0, longitude_deg = 0.0;
  float north_m = 0.0F, east_m = 0.0F;
};
using MavlinkMessage = std::variant<MavlinkHeartbeat, MavlinkAttitude, MavlinkPosition, MavlinkOdometry,
                                    MavlinkEstimator, MavlinkReference>;
struct MavlinkWord {
  std::uint8_t system = 0, component = 0;
  MavlinkMessage message;
};

// Takes packets out of bytes that come in pieces, with anything between them.
class MavlinkReader {
 public:
  void feed(ByteView bytes);
  // The next message of the above; nothing until more bytes come. Others are skipped, as are damaged packets and values
  // that are not finite.
  [[nodiscard]] std::optional<MavlinkWord> next();
  // What is left of a packet, when the next bytes do not continue it (a datagram has whole packets).
  void forget() noexcept { bytes_.clear(), begin_ = 0; }
  [[nodiscard]] std::uint64_t damaged() const noexcept { return damaged_; }  // starts of packets that were none

 private:
  Bytes bytes_;
  std::size_t begin_ = 0;
  std::uint64_t damaged_ = 0;
};

// ---- What is said to it ----

struct MavlinkSender {
  std::uint8_t system = 0, component = 0, sequence = 0;
};
// SET_POSITION_TARGET_LOCAL_NED with velocities and yaw rate alone: position, acceleration and yaw are ignored.
struct MavlinkSetPoint {
  std::uint32_t time_boot_ms = 0;  // of the sender
  std::uint8_t target_system = 0, target_component = 0;
  float north_m_s = 0.0F, east_m_s = 0.0F, down_m_s = 0.0F;
  float yaw_rate_rad_s = 0.0F;  // clockwise, seen from above
};
[[nodiscard]] Bytes encode(const MavlinkSetPoint& set_point, const MavlinkSender& sender);
// HEARTBEAT of an on-board computer, which is no autopilot.
[[nodiscard]] Bytes mavlink_heartbeat(const MavlinkSender& sender);

}  // namespace banyan::udp
