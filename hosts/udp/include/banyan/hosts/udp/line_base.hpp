// SPDX-License-Identifier: MIT
// A base that speaks lines of text over TCP or a serial port, so that thirty lines of program on its side are enough
// (hosts/udp/examples/base.py). Numbers are decimal, separated by single spaces, lengths in m, angles in rad.
//
//   robot to base   drive FORWARD SIDEWAYS TURN    velocities, m/s and rad/s, once a step; until the next such line
//   base to robot   pose X Y TURN                  odometry since the base was switched on; at least ten times a second
//                   seen X Y [X Y ...]             obstacle points, x forward, y to the left; replaces the last;
//                   "seen": none near ID RANGE BEARING [...]    other robots that it measures, bearing
//                   counter-clockwise from forward, in
//                                                  any number of lines; only without a hub
//                   target X Y                     where its target is, in the body frame of now; "target": it has
//                   none, as in
//                                                  the beginning; only without a hub
//
// A base that hears nothing for half a second must stop by itself: the wire may break.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "banyan/hosts/udp/base_wire.hpp"
#include "banyan/hosts/udp/driver.hpp"
#include "banyan/hosts/udp/pose_history.hpp"

namespace banyan::udp {

struct Seen {
  std::vector<Vec2> points;  // at most 4096
};
struct Near {
  struct Robot {
    RobotId id = nobody;
    Vec2 position;  // in the body frame
  };
  std::vector<Robot> robots;  // at most most_seen
};
struct Sought {
  std::optional<Vec2> target;  // in the body frame
};
using BaseLine = std::variant<OdometricPose, Seen, Near, Sought>;
// One line without its end; nothing if it is none of a base.
[[nodiscard]] std::optional<BaseLine> parse_base_line(std::string_view line);
[[nodiscard]] std::string drive_line(const Velocity& velocity);
// The base's side of both: nothing if the line, without its end, is no command; a pose with its end.
[[nodiscard]] std::optional<Velocity> parse_drive_line(std::string_view line);
[[nodiscard]] std::string base_pose_line(const OdometricPose& pose);

class LineBase final : public Driver {
 public:
  // Takes over the descriptor, which must not block.
  explicit LineBase(int descriptor) noexcept : descriptor_(descriptor) {}
  ~LineBase() override;
  LineBase(const LineBase&) = delete;
  LineBase& operator=(const LineBase&) = delete;

  void listen(double now_s) override;
  void drive(const Velocity& velocity) override;
  [[nodiscard]] std::optional<OdometricPose> pose_at(double moment_s) const override { return poses_.at(moment_s); }
  [[nodiscard]] std::span<const Vec2> obstacles() const override { return seen_.points; }
  [[nodiscard]] std::optional<Measured> neighbour(RobotId robot) const override;
  [[nodiscard]] std::optional<Measured> target() const override { return target_; }
  [[nodiscard]] std::optional<double> last_pose_s() const override { return poses_.last_s(); }
  [[nodiscard]] int descriptor() const noexcept override { return descriptor_; }
  [[nodiscard]] bool lost() const noexcept override { return lost_; }

 private:
  void take(std::string_view line, double now_s);

  int descriptor_;
  bool lost_ = false;
  std::string begun_;  // a line whose end has not come
  PoseHistory poses_;
  Seen seen_;
  std::map<RobotId, Measured> near_;
  std::optional<Measured> target_;
};

// "tcp:ADDRESS:PORT", or the path of a serial device, which is set to 115200 baud, 8N1. Throws BaseError.
[[nodiscard]] std::unique_ptr<Driver> open_line_base(const std::string& name);

}  // namespace banyan::udp
