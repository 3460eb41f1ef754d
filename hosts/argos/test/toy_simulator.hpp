// SPDX-License-Identifier: MIT
// Another simulator, as small as can be, in ARGoS' order of a tick: wheels turn, the radio carries what was said last,
// robots step, then the mission looks. Measures in cm and radians, as ARGoS does.
#pragma once

#include <cmath>
#include <vector>

#include "banyan/hosts/argos/mission.hpp"
#include "banyan/hosts/argos/settings.hpp"

namespace banyan::argos {

class ToySimulator final : public MirroredRobots {
 public:
  explicit ToySimulator(const world::Scenario& scenario) : scenario_(scenario) {}

  void enter(const MissionRun& mission) {
    mission_ = &mission;
    const Settings settings = read_settings(attributes_of(scenario_), *scenario_.algorithms, scenario_.tick_s);
    for (std::size_t i = 0; i < mission.world().size(); ++i) {
      const Member& member = mission.member(i);
      robots_.push_back({mission.start(i),
                         {},
                         {},
                         std::vector<std::uint8_t>(96),
                         ArgosRobot(*settings.algorithm, settings.setup, member, false)});
      platform_ = settings.setup.platform;
    }
  }

  void step() {
    for (Inhabitant& robot : robots_) move(robot);
    std::vector<std::vector<std::uint8_t>> said;
    for (const Inhabitant& robot : robots_) said.push_back(robot.last_words);
    for (std::size_t i = 0; i < robots_.size(); ++i) think(i, said);
  }

  [[nodiscard]] Pose pose(std::size_t i) const override { return robots_[i].pose; }
  [[nodiscard]] Said said(std::size_t i) const override { return robots_[i].robot.said(); }
  void tell(std::size_t i, const Told& told) override {
    robots_[i].told = told;
    if (const auto target = mission_->target_of(i)) robots_[i].told.target = *target;
  }
  [[nodiscard]] const Told& told(std::size_t i) const { return robots_[i].told; }

 private:
  struct Inhabitant {
    Pose pose;
    WheelCommand wheels;
    Told told;
    std::vector<std::uint8_t> last_words;  // zeros before the first
    ArgosRobot robot;
  };

  void move(Inhabitant& robot) const {
    constexpr int parts = 20;
    for (int k = 0; k < parts; ++k) {
      const double forward_m = 0.005 * (robot.wheels.left_cm_s + robot.wheels.right_cm_s) * scenario_.tick_s / parts;
      robot.pose.position +=
          forward_m * BasicVec2<double>{std::cos(robot.pose.heading_rad), std::sin(robot.pose.heading_rad)};
      robot.pose.heading_rad += 0.01 * (robot.wheels.right_cm_s - robot.wheels.left_cm_s) /
                                wheel_distance_m(scenario_) * scenario_.tick_s / parts;
    }
  }

  void think(std::size_t i, const std::vector<std::vector<std::uint8_t>>& said) {
    Inhabitant& me = robots_[i];
    if (!me.told.alive) {
      me.wheels = {};
      me.last_words.assign(me.last_words.size(), 0);
      return;
    }
    for (std::size_t j = 0; j < robots_.size(); ++j) {
      const BasicVec2<double> d = robots_[j].pose.position - me.pose.position;
      if (j == i || norm(d) >= scenario_.radio.range_m) continue;
      const double bearing = std::remainder(std::atan2(d.y, d.x) - me.pose.heading_rad, 2.0 * pi<double>);
      me.robot.hear(said[j], position_of(100.0 * norm(d), bearing, 0.0));
    }
    ArgosRobot::Readings readings;
    readings.odometry =
        odometry_of(me.wheels.left_cm_s, me.wheels.right_cm_s, wheel_distance_m(scenario_), scenario_.tick_s);
    readings.sent = me.told.sent;
    if (me.told.sent) readings.target = in_body_frame(me.told.target, me.pose.position, me.pose.heading_rad);
    readings.given_up = me.told.given_up;
    const Said now = me.robot.step(readings);
    me.wheels = wheel_command(now.velocity, platform_);
    me.last_words.assign(now.message.begin(), now.message.end());
  }

  const world::Scenario& scenario_;
  const MissionRun* mission_ = nullptr;
  Platform platform_;
  std::vector<Inhabitant> robots_;
};

}  // namespace banyan::argos
