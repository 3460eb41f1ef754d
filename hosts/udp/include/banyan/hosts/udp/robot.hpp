// SPDX-License-Identifier: MIT
// One robot: the controller at its own clock, between what the hub says and what its base does. Knows neither sockets
// nor wall time.
//
// Positions arrive as they were when they were measured. They are kept in the frame of the robot's own odometry and
// turned into the body frame of the moment in which the controller steps.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "banyan/controller/core/algorithm.hpp"
#include "banyan/hosts/udp/messages.hpp"

namespace banyan::udp {

class UdpRobot {
 public:
  // Stands still while its newest frame is older than `stop_after_s`. `algorithm` must outlive
  // it. Of what a base sees, what is farther than `proximity_m` is left out; 0: nothing is.
  UdpRobot(const Algorithm& algorithm, Setup setup, RobotId id, double stop_after_s, double proximity_m = 0.0);

  // What the hub has said. `at`: where the own odometry was when it was measured; nothing: the hub knows that itself.
  void take(const SensorFrame& frame, double now_s, const std::optional<OdometricPose>& at = {});
  void take(const HeardBundle& heard, const std::optional<OdometricPose>& at = {});

  // Whether a step makes sense: it has been told how to begin, and lately.
  [[nodiscard]] bool is_guided(double now_s) const noexcept;
  // One step of the controller. Call it only if is_guided(). `pose` and `seen`: of a base that measures them itself;
  // what it sees where a robot was heard is that robot, and no obstacle.
  [[nodiscard]] Status step(double now_s, const std::optional<OdometricPose>& pose = {},
                            std::span<const Vec2> seen = {});
  // Messages of other robots that were none of this algorithm: cut short, too long, or of another one.
  [[nodiscard]] std::uint32_t refused() const noexcept { return refused_; }

 private:
  struct Known {  // a packet that waits for the next step
    std::uint32_t tick = 0;
    Vec2 position;         // in the frame of the odometry
    Bytes message;         // empty: it has been given to the controller
    double given_s = 0.0;  // when that was
  };

  void begin(const SensorFrame& frame);
  void follow(std::uint32_t tick, const OdometricPose& odometry);  // if it is newer than what is known
  [[nodiscard]] float elapsed_s(double now_s) const noexcept;
  [[nodiscard]] Senses sense(const OdometricPose& pose, std::span<const Vec2> seen, double now_s);
  void collect(const OdometricPose& pose, double now_s);
  [[nodiscard]] std::span<const Vec2> without_neighbors(const OdometricPose& pose, std::span<const Vec2> seen,
                                                        double now_s);

  const Algorithm& algorithm_;
  Setup setup_;
  RobotId id_;
  double stop_after_s_;
  float proximity_m_;
  std::unique_ptr<Swarm> swarm_;  // of this robot alone; none before the first frame

  SensorFrame frame_;       // the newest
  double frame_s_ = 0.0;    // when it came
  OdometricPose odometry_;  // the newest that the hub has said, with whatever
  std::uint32_t odometry_tick_ = 0;
  Vec2 target_;  // in the frame of the odometry
  std::map<RobotId, Known> known_;

  OdometricPose pose_;           // at the last step
  double step_s_ = 0.0;          // when that was
  std::uint32_t step_tick_ = 0;  // and the newest tick that it knew
  bool interrupted_ = false;     // it has been without guidance since
  std::uint8_t given_up_serial_ = 0;
  std::uint32_t refused_ = 0;
  std::vector<Packet> packets_;
  std::vector<Vec2> obstacles_, seen_, neighbors_;
};

}  // namespace banyan::udp
