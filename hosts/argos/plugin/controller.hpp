// SPDX-License-Identifier: MIT
// A robot of ARGoS with one of Banyan's algorithms: any that has range and bearing and two wheels.
//
//   <banyan_controller id="banyan" library="libbanyan_argos">
//     <actuators> range_and_bearing, differential_steering </actuators>
//     <sensors>   range_and_bearing; if there, differential_steering (else wheels do what they are told), positioning
//     or
//                 footbot_light (workers), kheperaiv_proximity or footbot_proximity (obstacles) </sensors>
//     <params algorithm="convoy" range_m="2" ... />   settings.hpp
//   </banyan_controller>
#pragma once

#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_positioning_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_sensor.h>

#include <functional>
#include <optional>
#include <vector>

#include "banyan/hosts/argos/robot.hpp"
#include "banyan/hosts/argos/settings.hpp"

namespace banyan::argos {

class Controller final : public ::argos::CCI_Controller {
 public:
  void Init(::argos::TConfigurationNode& node) override;
  void ControlStep() override;
  void Reset() override;

  // What of this the loop functions take over: how the robot begins, and from then on what it is told.
  void begin(const Member& member);
  void tell(const Told& told);
  [[nodiscard]] Said said() const { return robot_->said(); }
  [[nodiscard]] const Settings& settings() const noexcept { return settings_; }
  [[nodiscard]] bool finds_targets_by_light() const noexcept {
    return positioning_ == nullptr && static_cast<bool>(light_);
  }
  [[nodiscard]] bool finds_targets() const noexcept { return positioning_ != nullptr || static_cast<bool>(light_); }
  [[nodiscard]] std::size_t message_bytes() const { return robot_->message_bytes(); }

 private:
  void find_sensors();
  void begin_by_settings();
  void make_robot();
  void hear();
  [[nodiscard]] Odometry odometry() const;
  [[nodiscard]] std::optional<Vec2> target() const;
  void drive(const Velocity& velocity);

  ::argos::CCI_RangeAndBearingActuator* voice_ = nullptr;
  ::argos::CCI_RangeAndBearingSensor* ears_ = nullptr;
  ::argos::CCI_DifferentialSteeringActuator* wheels_ = nullptr;
  ::argos::CCI_DifferentialSteeringSensor* encoders_ = nullptr;  // these two may be null
  ::argos::CCI_PositioningSensor* positioning_ = nullptr;
  std::function<std::optional<Vec2>()> light_;  // where the light is
  std::function<void(ArgosRobot&)> eyes_;       // shows the robot what proximity sensors see

  Settings settings_;
  double tick_s_ = 0.1;
  Member member_;
  std::optional<ArgosRobot> robot_;
  Told told_;
  std::vector<Vec2> told_obstacles_;
  WheelCommand last_;
  ::argos::CByteArray bytes_;
};

}  // namespace banyan::argos
