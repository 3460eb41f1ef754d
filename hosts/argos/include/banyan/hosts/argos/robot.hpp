// SPDX-License-Identifier: MIT
// One robot in another simulator: readings of one control step in, wheel speeds and bytes to broadcast out. Allocates
// nothing after the first steps.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "banyan/controller/core/algorithm.hpp"
#include "banyan/hosts/argos/readings.hpp"

namespace banyan::argos {

// What has been told to a robot by the mission. Without one, what its settings say.
struct Told {
  bool alive = true;
  bool sent = false;                  // to a target
  BasicVec2<double> target;           // where that is, m, in the arena's frame
  RobotId given_up = nobody;          // announced once
  std::span<const Vec2> obstacles{};  // in its body frame of the last step; a world's, instead of sensors
};

// What a robot has done in its last step.
struct Said {
  Velocity velocity;
  Report report;
  std::span<const std::uint8_t> message;  // until its next step
};

class ArgosRobot {
 public:
  // `algorithm` must outlive it. `has_eyes`: see() will be called.
  ArgosRobot(const Algorithm& algorithm, const Setup& setup, const Member& member, bool has_eyes);

  // A packet of this step; silence, and bytes that are no message of this algorithm, are not heard.
  void hear(std::span<const std::uint8_t> bytes, Vec2 position);
  // A point that a proximity sensor sees: an obstacle, unless a robot was heard there lately.
  void see(Vec2 point);

  struct Readings {
    Odometry odometry{};
    bool sent = false;
    std::optional<Vec2> target;  // in the body frame; none: not sensed
    RobotId given_up = nobody;
    std::span<const Vec2> obstacles{};  // besides those seen
  };
  // One step with what was heard and seen since the last.
  Said step(const Readings& readings);

  [[nodiscard]] Said said() const noexcept { return {velocity_, report_, message_}; }
  [[nodiscard]] std::size_t message_bytes() const noexcept { return swarm_->message_bytes(); }

 private:
  struct Known {  // where a robot was, carried along
    Vec2 position;
    int age_steps = 0;
  };
  void remember(const Odometry& odometry);
  [[nodiscard]] bool is_robot(Vec2 point) const noexcept;

  std::unique_ptr<Swarm> swarm_;  // of this robot alone
  bool has_eyes_;
  float radius_m_;  // of a robot, generously
  float step_m_;    // the farthest that one moves in a step
  std::vector<Packet> packets_;
  std::vector<Known> known_;
  std::vector<Vec2> seen_, obstacles_;
  Velocity velocity_;
  Report report_;
  std::vector<std::uint8_t> message_;
};

}  // namespace banyan::argos
