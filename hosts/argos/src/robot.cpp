// SPDX-License-Identifier: MIT
#include "banyan/hosts/argos/robot.hpp"

#include <algorithm>
#include <array>

namespace banyan::argos {
namespace {

constexpr int remembered_steps = 10;  // at 30 % loss, ten packets in a row get lost once in 170,000 times

}  // namespace

ArgosRobot::ArgosRobot(const Algorithm& algorithm, const Setup& setup, const Member& member, bool has_eyes)
    : swarm_(algorithm.make(setup, std::array{member})),
      has_eyes_(has_eyes),
      radius_m_(setup.platform.body_radius_m),
      step_m_(setup.platform.wheel_limit_m_s * setup.platform.tick_s),
      report_(swarm_->report(0)),
      message_(swarm_->message_bytes()) {}

void ArgosRobot::hear(std::span<const std::uint8_t> bytes, Vec2 position) {
  if (is_silence(bytes)) return;
  const auto place = swarm_->receive(bytes);
  if (!place) return;
  packets_.push_back({.sender = *place, .age_ticks = 1, .position = position, .age_s = 0.0F});
}

void ArgosRobot::see(Vec2 point) { seen_.push_back(point); }

// A robot's place is known from its packets: those of this step and, since packets get lost, of the last ones.
void ArgosRobot::remember(const Odometry& odometry) {
  const Carry carry(odometry);
  for (Known& robot : known_) {
    robot.position = carry.point(robot.position);
    ++robot.age_steps;
  }
  std::erase_if(known_, [](const Known& robot) { return robot.age_steps > remembered_steps; });
  for (const Packet& packet : packets_) known_.push_back({packet.position, 0});
}

bool ArgosRobot::is_robot(Vec2 point) const noexcept {
  return std::any_of(known_.begin(), known_.end(), [&](const Known& robot) {
    return distance(robot.position, point) < radius_m_ + static_cast<float>(robot.age_steps + 1) * step_m_;
  });
}

Said ArgosRobot::step(const Readings& readings) {
  obstacles_.assign(readings.obstacles.begin(), readings.obstacles.end());
  if (has_eyes_) remember(readings.odometry);
  std::copy_if(seen_.begin(), seen_.end(), std::back_inserter(obstacles_),
               [&](Vec2 point) { return !is_robot(point); });
  std::array<Sensed, 1> sensed;
  sensed[0].packets = packets_;
  sensed[0].senses.odometry = readings.odometry;
  sensed[0].senses.orders = {.sent = readings.sent, .target = readings.target, .given_up = readings.given_up};
  sensed[0].senses.obstacles = obstacles_;
  swarm_->step(0, sensed, std::span(&velocity_, 1), std::span(&report_, 1));
  swarm_->advance();
  swarm_->send(0, message_);
  packets_.clear();
  seen_.clear();
  return said();
}

}  // namespace banyan::argos
