// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/mavlink.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "banyan/controller/core/trig.hpp"

namespace banyan::udp {
namespace {

constexpr std::uint8_t start_v1 = 0xFE, start_v2 = 0xFD;
constexpr std::size_t header_v1 = 6, header_v2 = 10, crc_bytes = 2, signature_bytes = 13;
constexpr std::uint8_t is_signed = 0x01;                    // the one incompatible feature that there is
constexpr std::size_t most_waiting = std::size_t{1} << 16;  // bytes; beyond, nobody reads them in time

constexpr std::uint8_t frame_local_ned = 1;
constexpr std::uint8_t type_onboard_controller = 18, autopilot_invalid = 8, state_active = 4, wire_version = 3;
// POSITION_TARGET_TYPEMASK: ignore x, y, z; accelerations; yaw.
constexpr std::uint16_t velocity_and_yaw_rate = 0x007 | 0x1C0 | 0x400;

struct MavlinkDefinition {
  std::uint32_t id;
  std::uint8_t crc_extra;
  std::uint8_t length;  // without extensions, as version 1 has it
};
constexpr MavlinkDefinition heartbeat{0, 50, 9}, attitude{30, 39, 28}, local_position_ned{32, 185, 28},
    gps_global_origin{49, 39, 12}, set_position_target{84, 143, 53}, ekf_status_report{193, 71, 22},
    estimator_status{230, 163, 42}, home_position{242, 104, 52}, odometry{331, 91, 230};
constexpr std::array heard{heartbeat,         attitude,         local_position_ned, gps_global_origin,
                           ekf_status_report, estimator_status, home_position,      odometry};

// Where a packet lies in the bytes that begin with it.
struct PacketLayout {
  std::size_t header = 0, payload = 0, signature = 0;
  std::uint32_t id = 0;
  std::uint8_t system = 0, component = 0;
  bool is_known_form = true;
  [[nodiscard]] std::size_t size() const noexcept { return header + payload + crc_bytes + signature; }
};

// Nothing if the header is not complete.
std::optional<PacketLayout> layout_of(ByteView bytes) noexcept {
  const bool is_v2 = bytes[0] == start_v2;
  PacketLayout layout;
  layout.header = is_v2 ? header_v2 : header_v1;
  if (bytes.size() < layout.header) return std::nullopt;
  layout.payload = bytes[1];
  const std::size_t sender = is_v2 ? 5 : 3;
  layout.system = bytes[sender];
  layout.component = bytes[sender + 1];
  layout.id = bytes[sender + 2];
  if (is_v2) {
    layout.id |= static_cast<std::uint32_t>(bytes[8]) << 8U | static_cast<std::uint32_t>(bytes[9]) << 16U;
    if ((bytes[2] & is_signed) != 0) layout.signature = signature_bytes;
    layout.is_known_form = (bytes[2] & ~is_signed) == 0;
  }
  return layout;
}

bool is_intact(ByteView packet, const PacketLayout& layout, const MavlinkDefinition& definition) noexcept {
  const std::size_t end = layout.header + layout.payload;
  const std::array extra{definition.crc_extra};
  const std::uint16_t crc = mavlink_crc(extra, mavlink_crc(packet.subspan(1, end - 1)));
  return packet[end] == (crc & 0xFFU) && packet[end + 1] == crc >> 8U;
}

// Reads the payload field by field; zeros that were left out read as zeros.
class PayloadReader {
 public:
  explicit PayloadReader(ByteView payload) noexcept { std::copy_n(payload.begin(), payload.size(), bytes_.begin()); }
  void skip(std::size_t bytes) noexcept { static_cast<void>(reader_.take(bytes)); }
  template <std::integral T> [[nodiscard]] T number() noexcept { return reader_.take<T>(); }
  [[nodiscard]] float real() noexcept {
    const float value = reader_.take_float();
    is_finite_ = is_finite_ && std::isfinite(value);
    return value;
  }
  [[nodiscard]] MavlinkPosition position() noexcept {
    const float north = real(), east = real();
    return {north, east, real()};
  }
  [[nodiscard]] bool is_finite() const noexcept { return is_finite_; }

 private:
  std::array<std::uint8_t, 256> bytes_{};
  DatagramReader reader_{bytes_};
  bool is_finite_ = true;
};

constexpr float largest_angle_rad = 1e4F;  // beyond, a turn would not be exact (trig.hpp)

std::optional<MavlinkMessage> attitude_of(PayloadReader& fields) noexcept {
  fields.skip(12);  // time, roll, pitch
  const float yaw = fields.real();
  if (!fields.is_finite() || std::fabs(yaw) > largest_angle_rad) return std::nullopt;
  return MavlinkAttitude{yaw};
}

std::optional<MavlinkMessage> position_of(PayloadReader& fields) noexcept {
  fields.skip(4);
  const MavlinkPosition position = fields.position();
  if (!fields.is_finite()) return std::nullopt;
  return position;
}

std::optional<MavlinkMessage> odometry_of(PayloadReader& fields) noexcept {
  fields.skip(8);
  MavlinkOdometry said{fields.position()};
  const float w = fields.real(), x = fields.real(), y = fields.real(), z = fields.real();
  if (!fields.is_finite()) return std::nullopt;
  fields.skip(24 + 168);  // speeds, covariances
  if (fields.number<std::uint8_t>() != frame_local_ned) return std::nullopt;
  const Vec2 forward{w * w + x * x - y * y - z * z, 2.0F * (w * z + x * y)};  // its shadow on the ground
  if (!(norm(forward) > 1e-3F)) return std::nullopt;  // it points up or down, or that is no rotation
  said.yaw_rad = angle_of(unit(forward));
  return said;
}

MavlinkMessage estimator_of(PayloadReader& fields, std::size_t before) noexcept {
  fields.skip(before);
  return MavlinkEstimator{fields.number<std::uint16_t>()};
}

std::optional<MavlinkMessage> reference_of(PayloadReader& fields, bool is_origin) noexcept {
  constexpr double degrees = 1e-7;
  MavlinkReference reference{is_origin};
  reference.latitude_deg = degrees * fields.number<std::int32_t>();
  reference.longitude_deg = degrees * fields.number<std::int32_t>();
  if (is_origin) return reference;
  fields.skip(4);
  reference.north_m = fields.real();
  reference.east_m = fields.real();
  if (!fields.is_finite()) return std::nullopt;
  return reference;
}

MavlinkMessage heartbeat_of(PayloadReader& fields) noexcept {
  fields.skip(4);
  const auto type = fields.number<std::uint8_t>();
  return MavlinkHeartbeat{type, fields.number<std::uint8_t>()};
}

std::optional<MavlinkMessage> message_of(std::uint32_t id, ByteView payload) noexcept {
  PayloadReader fields(payload);
  switch (id) {
    case heartbeat.id: return heartbeat_of(fields);
    case attitude.id: return attitude_of(fields);
    case local_position_ned.id: return position_of(fields);
    case odometry.id: return odometry_of(fields);
    case estimator_status.id: return estimator_of(fields, 40);
    case ekf_status_report.id: return estimator_of(fields, 20);
    case home_position.id: return reference_of(fields, false);
    default: return reference_of(fields, true);
  }
}

Bytes packet_of(const MavlinkDefinition& definition, Bytes payload, const MavlinkSender& sender) {
  while (payload.size() > 1 && payload.back() == 0) payload.pop_back();
  Bytes packet;
  DatagramWriter writer(packet);
  writer.put(start_v2);
  writer.put(static_cast<std::uint8_t>(payload.size()));
  writer.put(std::uint16_t{0});  // no features
  writer.put(sender.sequence);
  writer.put(sender.system);
  writer.put(sender.component);
  writer.put(static_cast<std::uint16_t>(definition.id));
  writer.put(static_cast<std::uint8_t>(definition.id >> 16U));
  writer.put(ByteView(payload));
  const std::array extra{definition.crc_extra};
  writer.put(mavlink_crc(extra, mavlink_crc(ByteView(packet).subspan(1))));
  return packet;
}

}  // namespace

std::uint16_t mavlink_crc(ByteView bytes, std::uint16_t before) noexcept {
  unsigned crc = before;
  for (const std::uint8_t byte : bytes) {
    unsigned mixed = byte ^ (crc & 0xFFU);
    mixed = (mixed ^ mixed << 4U) & 0xFFU;
    crc = (crc >> 8U) ^ mixed << 8U ^ mixed << 3U ^ mixed >> 4U;
  }
  return static_cast<std::uint16_t>(crc);
}

void MavlinkReader::feed(ByteView bytes) {
  bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(begin_));
  begin_ = 0;
  if (bytes_.size() + bytes.size() > most_waiting) bytes_.clear();
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

std::optional<MavlinkWord> MavlinkReader::next() {
  while (begin_ < bytes_.size()) {
    const ByteView left = ByteView(bytes_).subspan(begin_);
    if (left[0] != start_v1 && left[0] != start_v2) {
      ++begin_;
      continue;
    }
    const auto layout = layout_of(left);
    if (!layout || left.size() < layout->size()) return std::nullopt;
    const auto* const known =
        std::find_if(heard.begin(), heard.end(), [&](const MavlinkDefinition& one) { return one.id == layout->id; });
    const bool is_read = layout->is_known_form && known != heard.end();
    if (is_read && (!is_intact(left, *layout, *known) || (left[0] == start_v1 && layout->payload < known->length))) {
      ++damaged_;
      ++begin_;
      continue;
    }
    begin_ += layout->size();
    if (!is_read) continue;
    if (const auto message = message_of(layout->id, left.subspan(layout->header, layout->payload)))
      return MavlinkWord{layout->system, layout->component, *message};
  }
  return std::nullopt;
}

Bytes encode(const MavlinkSetPoint& set_point, const MavlinkSender& sender) {
  Bytes payload;
  DatagramWriter writer(payload);
  writer.put(set_point.time_boot_ms);
  for (int axis = 0; axis < 3; ++axis) writer.put(0.0F);  // position
  for (const float speed : {set_point.north_m_s, set_point.east_m_s, set_point.down_m_s}) writer.put(speed);
  for (int axis = 0; axis < 4; ++axis) writer.put(0.0F);  // acceleration, yaw
  writer.put(set_point.yaw_rate_rad_s);
  writer.put(velocity_and_yaw_rate);
  for (const std::uint8_t byte : {set_point.target_system, set_point.target_component, frame_local_ned})
    writer.put(byte);
  return packet_of(set_position_target, std::move(payload), sender);
}

Bytes mavlink_heartbeat(const MavlinkSender& sender) {
  return packet_of(heartbeat, {0, 0, 0, 0, type_onboard_controller, autopilot_invalid, 0, state_active, wire_version},
                   sender);
}

}  // namespace banyan::udp
