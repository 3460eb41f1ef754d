// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/messages.hpp"

#include "banyan/controller/core/wire.hpp"

namespace banyan::udp {
namespace {

float within_half_turn(float turn_rad) noexcept {
  const Vec2 direction = unit_vector(turn_rad);
  return angle_of(direction);
}

void put(DatagramWriter& out, Vec2 v) {
  out.put(v.x);
  out.put(v.y);
}
Vec2 take_point(DatagramReader& in) noexcept {
  const float x = in.take_float();
  return {x, in.take_float()};
}

void put(DatagramWriter& out, const OdometricPose& pose) {
  put(out, pose.position);
  out.put(pose.turn_rad);
}
OdometricPose take_pose(DatagramReader& in) noexcept {
  const Vec2 position = take_point(in);
  return {position, in.take_float()};
}
// Turns beyond this would not be exact (trig.hpp), and no encoder writes them.
bool is_sound(const OdometricPose& pose) noexcept {
  return std::isfinite(pose.position.x) && std::isfinite(pose.position.y) && std::fabs(pose.turn_rad) <= 4.0F;
}

void put_message(DatagramWriter& out, const Bytes& message) {
  out.put(static_cast<std::uint8_t>(message.size()));
  out.put(ByteView(message));
}
std::optional<Bytes> take_message(DatagramReader& in) {
  const auto size = in.take<std::uint8_t>();
  if (size > largest_wire) return std::nullopt;
  const ByteView bytes = in.take(size);
  return Bytes(bytes.begin(), bytes.end());
}

void put(DatagramWriter& out, const Report& r) {
  out.put(static_cast<std::uint8_t>(r.role));
  out.put(static_cast<std::uint8_t>(r.phase));
  out.put(static_cast<std::uint8_t>(r.need));
  out.put(static_cast<std::uint8_t>(r.spare_state));
  for (const RobotId id : {r.parent, r.old_parent, r.serves, r.root, r.grant, r.request}) out.put(id);
  for (const RobotId id : r.kept) out.put(id);
  for (const std::uint16_t number : {r.root_sequence, r.epoch, r.depth}) out.put(number);
  out.put(r.label);
  out.put(r.want);
  out.put(std::uint8_t{r.out_of_scale});
  const Tally& t = r.tally;
  for (const std::uint32_t n : {t.insertions, t.handovers, t.repairs, t.elections, t.replacements, t.rejected})
    out.put(n);
}

template <class E> bool take_choice(DatagramReader& in, E& choice, E last) noexcept {
  const auto number = in.take<std::uint8_t>();
  choice = static_cast<E>(number);
  return number <= static_cast<std::uint8_t>(last);
}

std::optional<Report> take_report(DatagramReader& in) noexcept {
  Report r;
  bool sound = take_choice(in, r.role, Role::root);
  sound = take_choice(in, r.phase, Phase::select_root) && sound;
  sound = take_choice(in, r.need, Need::await) && sound;
  sound = take_choice(in, r.spare_state, SpareState::adjust_position) && sound;
  for (RobotId* id : {&r.parent, &r.old_parent, &r.serves, &r.root, &r.grant, &r.request}) *id = in.take<RobotId>();
  for (RobotId& id : r.kept) id = in.take<RobotId>();
  for (std::uint16_t* number : {&r.root_sequence, &r.epoch, &r.depth}) *number = in.take<std::uint16_t>();
  r.label = in.take_float();
  r.want = in.take_float();
  const auto out_of_scale = in.take<std::uint8_t>();
  sound = sound && out_of_scale <= 1;
  r.out_of_scale = out_of_scale == 1;
  Tally& t = r.tally;
  for (std::uint32_t* n : {&t.insertions, &t.handovers, &t.repairs, &t.elections, &t.replacements, &t.rejected})
    *n = in.take<std::uint32_t>();
  if (!sound || !in.ok()) return std::nullopt;
  return r;
}

constexpr std::uint8_t all_flags = 0x7F;

std::uint8_t flags_of(const SensorFrame& frame) noexcept {
  unsigned flags = 0, bit = 1;
  for (const bool flag :
       {frame.root, frame.worker, frame.begun, frame.sent, frame.has_target, frame.line_of_sight, frame.station}) {
    flags |= flag ? bit : 0U;
    bit <<= 1U;
  }
  return static_cast<std::uint8_t>(flags);
}

}  // namespace

OdometricPose moved(const OdometricPose& pose, const Odometry& motion) noexcept {
  return {pose.outside({motion.forward_m, motion.sideways_m}), within_half_turn(pose.turn_rad + motion.turn_rad)};
}

Odometry motion_between(const OdometricPose& before, const OdometricPose& now) noexcept {
  const Vec2 shift = before.inside(now.position);
  return {shift.x, shift.y, within_half_turn(now.turn_rad - before.turn_rad)};
}

Bytes encode(const SensorFrame& frame) {
  Bytes bytes;
  DatagramWriter out(bytes);
  out.put(frame.mission);
  out.put(frame.tick);
  out.put(flags_of(frame));
  put(out, frame.odometry);
  put(out, frame.target);
  out.put(frame.given_up);
  out.put(frame.given_up_serial);
  out.put(static_cast<std::uint8_t>(frame.obstacles.size()));
  for (const Vec2 point : frame.obstacles) put(out, point);
  return bytes;
}

std::optional<SensorFrame> decode_frame(ByteView bytes) {
  DatagramReader in(bytes);
  SensorFrame frame;
  frame.mission = in.take<std::uint32_t>();
  frame.tick = in.take<std::uint32_t>();
  unsigned flags = in.take<std::uint8_t>();
  if (flags > all_flags) return std::nullopt;
  for (bool* flag : {&frame.root, &frame.worker, &frame.begun, &frame.sent, &frame.has_target, &frame.line_of_sight,
                     &frame.station}) {
    *flag = (flags & 1U) != 0;
    flags >>= 1U;
  }
  frame.odometry = take_pose(in);
  frame.target = take_point(in);
  frame.given_up = in.take<RobotId>();
  frame.given_up_serial = in.take<std::uint8_t>();
  const auto count = in.take<std::uint8_t>();
  if (count > most_seen) return std::nullopt;
  for (int k = 0; k < count; ++k) frame.obstacles.push_back(take_point(in));
  if (!in.at_end() || !is_sound(frame.odometry)) return std::nullopt;
  return frame;
}

Bytes encode(const HeardBundle& heard) {
  Bytes bytes;
  DatagramWriter out(bytes);
  out.put(heard.tick);
  put(out, heard.odometry);
  out.put(static_cast<std::uint8_t>(heard.packets.size()));
  for (const Hearing& packet : heard.packets) {
    out.put(packet.sender);
    put(out, packet.position);
    put_message(out, packet.message);
  }
  return bytes;
}

std::optional<HeardBundle> decode_heard(ByteView bytes) {
  DatagramReader in(bytes);
  HeardBundle heard;
  heard.tick = in.take<std::uint32_t>();
  heard.odometry = take_pose(in);
  const auto count = in.take<std::uint8_t>();
  for (int k = 0; k < count && in.ok(); ++k) {
    Hearing packet;
    packet.sender = in.take<RobotId>();
    packet.position = take_point(in);
    auto message = take_message(in);
    if (!message) return std::nullopt;
    packet.message = std::move(*message);
    heard.packets.push_back(std::move(packet));
  }
  if (!in.at_end() || !is_sound(heard.odometry)) return std::nullopt;
  return heard;
}

Bytes encode(const Status& status) {
  Bytes bytes;
  DatagramWriter out(bytes);
  out.put(status.frame_tick);
  out.put(status.period_us);
  out.put(status.dropped);
  out.put(status.given_up_serial);
  out.put(status.velocity.forward_m_s);
  out.put(status.velocity.sideways_m_s);
  out.put(status.velocity.turn_rad_s);
  put(out, status.report);
  put_message(out, status.message);
  return bytes;
}

std::optional<Status> decode_status(ByteView bytes) {
  DatagramReader in(bytes);
  Status status;
  status.frame_tick = in.take<std::uint32_t>();
  status.period_us = in.take<std::uint32_t>();
  status.dropped = in.take<std::uint32_t>();
  status.given_up_serial = in.take<std::uint8_t>();
  status.velocity.forward_m_s = in.take_float();
  status.velocity.sideways_m_s = in.take_float();
  status.velocity.turn_rad_s = in.take_float();
  const auto report = take_report(in);
  auto message = take_message(in);
  const Velocity& v = status.velocity;
  const bool finite = std::isfinite(v.forward_m_s) && std::isfinite(v.sideways_m_s) && std::isfinite(v.turn_rad_s);
  if (!report || !message || !in.at_end() || !finite) return std::nullopt;
  status.report = *report;
  status.message = std::move(*message);
  return status;
}

Bytes encode(const Account& account) {
  Bytes bytes;
  DatagramWriter out(bytes);
  put(out, OdometricPose{account.odometry.position, within_half_turn(account.odometry.turn_rad)});
  out.put(static_cast<std::uint8_t>(account.target ? 1 : 0));
  put(out, account.target.value_or(Vec2{}));
  const std::size_t count = std::min(account.seen.size(), most_sightings);
  out.put(static_cast<std::uint8_t>(count));
  for (const Sighting& sighting : std::span(account.seen).first(count)) {
    out.put(sighting.robot);
    put(out, sighting.position);
  }
  const Bytes status = encode(account.status);
  out.put(ByteView(status));
  return bytes;
}

std::optional<Account> decode_account(ByteView bytes) {
  DatagramReader in(bytes);
  Account account;
  account.odometry = take_pose(in);
  const auto has_target = in.take<std::uint8_t>();
  const Vec2 target = take_point(in);
  if (has_target > 1) return std::nullopt;
  if (has_target == 1) account.target = target;
  const auto count = in.take<std::uint8_t>();
  if (count > most_sightings) return std::nullopt;
  for (int k = 0; k < count && in.ok(); ++k) {
    const RobotId robot = in.take<RobotId>();
    account.seen.push_back({robot, take_point(in)});
  }
  if (!in.ok() || !is_sound(account.odometry)) return std::nullopt;
  const auto finite = [](Vec2 p) { return std::isfinite(p.x) && std::isfinite(p.y); };
  const auto status = decode_status(in.take(in.left()));
  if (!status || !finite(target) ||
      !std::all_of(account.seen.begin(), account.seen.end(), [&](const Sighting& s) { return finite(s.position); }))
    return std::nullopt;
  account.status = *status;
  return account;
}

}  // namespace banyan::udp
