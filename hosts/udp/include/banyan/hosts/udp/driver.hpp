// SPDX-License-Identifier: MIT
// What a robot drives on. With simulated wheels the hub's world is the base: velocities reach it in the robot's status,
// and odometry comes with its frames. Another base has a driver of its own (line_base.hpp).
#pragma once

#include <optional>
#include <span>
#include <string>

#include "banyan/hosts/udp/messages.hpp"

namespace banyan::udp {

struct Measured {
  Vec2 position;   // in the body frame of that moment
  double s = 0.0;  // the moment
};

class Driver {
 public:
  virtual ~Driver() = default;
  // Takes in what the base has said until now.
  virtual void listen(double now_s) = 0;
  // Until the next call. Zero stops it.
  virtual void drive(const Velocity& velocity) = 0;
  // Where the wheels say that it was at that moment, of the last second; nothing if the hub knows that.
  [[nodiscard]] virtual std::optional<OdometricPose> pose_at(double moment_s) const = 0;
  // Obstacle points in the body frame, as of now.
  [[nodiscard]] virtual std::span<const Vec2> obstacles() const = 0;
  // The newest measurement of another robot, and of the own target; nothing if there is none, or if the hub has it.
  [[nodiscard]] virtual std::optional<Measured> neighbour(RobotId robot) const = 0;
  [[nodiscard]] virtual std::optional<Measured> target() const = 0;
  [[nodiscard]] virtual std::optional<double> last_pose_s() const = 0;  // when it has said last where it is
  [[nodiscard]] virtual int descriptor() const noexcept = 0;  // that something to listen() to arrives on; -1: none
  // Nothing more will come: the robot stands and its program ends.
  [[nodiscard]] virtual bool lost() const noexcept = 0;
  // Why it stands still whatever drive() says, in words; empty: it does not.
  [[nodiscard]] virtual const std::string& fault() const noexcept { return nothing_; }

 protected:
  Driver() = default;

 private:
  std::string nothing_;
};

class SimulatedWheels final : public Driver {
 public:
  void listen(double /*now_s*/) override {}
  void drive(const Velocity& /*velocity*/) override {}
  [[nodiscard]] std::optional<OdometricPose> pose_at(double /*moment_s*/) const override { return std::nullopt; }
  [[nodiscard]] std::span<const Vec2> obstacles() const override { return {}; }
  [[nodiscard]] std::optional<Measured> neighbour(RobotId /*robot*/) const override { return std::nullopt; }
  [[nodiscard]] std::optional<Measured> target() const override { return std::nullopt; }
  [[nodiscard]] std::optional<double> last_pose_s() const override { return std::nullopt; }
  [[nodiscard]] int descriptor() const noexcept override { return -1; }
  [[nodiscard]] bool lost() const noexcept override { return false; }
};

}  // namespace banyan::udp
