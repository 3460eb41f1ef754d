// SPDX-License-Identifier: MIT
#include "controller.hpp"

#include <argos3/core/utility/configuration/argos_exception.h>

#include "banyan/algorithms/algorithms.hpp"
#include "robot_sensors.hpp"
#include "simulator.hpp"

namespace banyan::argos {

using namespace ::argos;

void Controller::Init(TConfigurationNode& node) {
  try {
    voice_ = GetActuator<CCI_RangeAndBearingActuator>("range_and_bearing");
    wheels_ = GetActuator<CCI_DifferentialSteeringActuator>("differential_steering");
    ears_ = GetSensor<CCI_RangeAndBearingSensor>("range_and_bearing");
    find_sensors();
    tick_s_ = tick_of_simulator_s();
    settings_ = read_settings(attributes_of_node(node), algorithms(), tick_s_);
  } catch (const SettingsError& error) {
    THROW_ARGOSEXCEPTION(place_in_experiment(node) << ": " << error.what());
  } catch (CARGoSException& error) {
    THROW_ARGOSEXCEPTION_NESTED("The controller of robot \"" << GetId() << "\" cannot begin", error);
  }
  if (encoders_ != nullptr && !settings_.knows_wheels)
    settings_.setup.platform.wheel_distance_m = static_cast<float>(encoders_->GetReading().WheelAxisLength * 0.01);
  begin_by_settings();
  if (const std::size_t wanted = message_bytes(); voice_->GetSize() != wanted)
    THROW_ARGOSEXCEPTION("The messages of " << settings_.algorithm->name() << " have " << wanted
                                            << " bytes, but robot \"" << GetId() << "\" sends " << voice_->GetSize()
                                            << "; say rab_data_size=\"" << wanted << "\" in its element");
  bytes_ = CByteArray(message_bytes());
}

void Controller::find_sensors() {
  if (HasSensor("differential_steering"))
    encoders_ = GetSensor<CCI_DifferentialSteeringSensor>("differential_steering");
  if (HasSensor("positioning")) positioning_ = GetSensor<CCI_PositioningSensor>("positioning");
  eyes_ = eyes_of(*this);
  light_ = light_of(*this, settings_.light_intensity_m);
}

// Without loop functions: <params role="worker" target_m="3,0" />.
void Controller::begin_by_settings() {
  const std::optional<RobotId> id = id_of(GetId());
  if (!id)
    THROW_ARGOSEXCEPTION(
        "The id \"" << GetId()
                    << "\" does not end with a number up to 65534, which says who a robot is, such as \"kh12\"");
  member_ = {.id = *id, .worker = settings_.part == StartRole::worker, .root = settings_.part == StartRole::root};
  told_ = {};
  told_.sent = member_.worker;
  told_.target = settings_.target.value_or(BasicVec2<double>{});
  if (member_.worker && !finds_targets())
    THROW_ARGOSEXCEPTION("Robot \"" << GetId() << "\" is a worker and needs the sensor positioning or footbot_light");
  if (member_.worker && !finds_targets_by_light() && !settings_.target)
    THROW_ARGOSEXCEPTION("Robot \"" << GetId() << "\" is a worker; say target_m=\"X,Y\" in its <params>");
  make_robot();
}

void Controller::make_robot() {
  robot_.emplace(*settings_.algorithm, settings_.setup, member_, static_cast<bool>(eyes_));
  last_ = {};
}

void Controller::begin(const Member& member) {
  member_ = member;
  told_ = {};
  make_robot();
}

void Controller::tell(const Told& told) {
  told_ = told;
  told_obstacles_.assign(told.obstacles.begin(), told.obstacles.end());
}

void Controller::Reset() { begin_by_settings(); }

void Controller::hear() {
  for (const auto& packet : ears_->GetReadings())
    robot_->hear({packet.Data.ToCArray(), packet.Data.Size()},
                 position_of(packet.Range, packet.HorizontalBearing.GetValue(), packet.VerticalBearing.GetValue()));
}

Odometry Controller::odometry() const {
  const double wheel_distance_m = static_cast<double>(settings_.setup.platform.wheel_distance_m);
  if (encoders_ == nullptr) return odometry_of(last_.left_cm_s, last_.right_cm_s, wheel_distance_m, tick_s_);
  const auto& wheels = encoders_->GetReading();
  return odometry_of(wheels.VelocityLeftWheel, wheels.VelocityRightWheel, wheel_distance_m, tick_s_);
}

std::optional<Vec2> Controller::target() const {
  if (!told_.sent) return std::nullopt;
  if (positioning_ == nullptr) return light_ ? light_() : std::nullopt;
  const auto& here = positioning_->GetReading();
  CRadians heading, pitch, roll;
  here.Orientation.ToEulerAngles(heading, pitch, roll);
  return in_body_frame(told_.target, {here.Position.GetX(), here.Position.GetY()}, heading.GetValue());
}

void Controller::drive(const Velocity& velocity) {
  last_ = wheel_command(velocity, settings_.setup.platform);
  wheels_->SetLinearVelocity(last_.left_cm_s, last_.right_cm_s);
}

void Controller::ControlStep() {
  if (!told_.alive) {
    drive({});
    voice_->ClearData();
    return;
  }
  hear();
  if (eyes_) eyes_(*robot_);
  ArgosRobot::Readings readings;
  readings.odometry = odometry();
  readings.sent = told_.sent;
  readings.target = target();
  readings.given_up = told_.given_up;
  // They were seen from where the robot was one step ago.
  const Carry carry(readings.odometry);
  for (Vec2& point : told_obstacles_) point = carry.point(point);
  readings.obstacles = told_obstacles_;
  const Said said = robot_->step(readings);
  told_.given_up = nobody;
  drive(said.velocity);
  for (std::size_t k = 0; k < said.message.size(); ++k) bytes_[k] = said.message[k];
  voice_->SetData(bytes_);
}

}  // namespace banyan::argos

using BanyanController = banyan::argos::Controller;
REGISTER_CONTROLLER(BanyanController, "banyan_controller")
