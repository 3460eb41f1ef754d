// SPDX-License-Identifier: MIT
// A base that speaks lines of text over TCP or a serial port, so that thirty lines of program on its side are enough
// (hosts/udp/examples/base.py). Numbers are decimal, separated by single spaces, lengths in m, angles in rad.
//
//   robot to base   drive FORWARD SIDEWAYS TURN    velocities, m/s and rad/s, once a step; until the next such line
//   base to robot   pose X Y TURN                  odometry since the base was switched on; at least ten times a second
//                   seen X Y [X Y ...]             obstacle points, x forward, y to the left; replaces the last; "seen": none
//
// A base that hears nothing for half a second must stop by itself: the wire may break.
#pragma once

#include <deque>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "banyan/hosts/udp/driver.hpp"

namespace banyan::udp {

class BaseError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Seen {
  std::vector<Vec2> points;  // at most most_seen
};
// One line without its end; nothing if it is none of a base.
[[nodiscard]] std::optional<std::variant<OdometricPose, Seen>> parse_base_line(std::string_view line);
[[nodiscard]] std::string drive_line(const Velocity& velocity);

class LineBase final : public Driver {
 public:
  // Takes over the descriptor, which must not block.
  explicit LineBase(int descriptor) noexcept : descriptor_(descriptor) {}
  ~LineBase() override;
  LineBase(const LineBase&) = delete;
  LineBase& operator=(const LineBase&) = delete;

  void listen(double now_s) override;
  void drive(const Velocity& velocity) override;
  [[nodiscard]] std::optional<OdometricPose> pose_at(double moment_s) const override;  // the origin before the first
  [[nodiscard]] std::span<const Vec2> obstacles() const override { return seen_.points; }
  [[nodiscard]] int descriptor() const noexcept override { return descriptor_; }
  [[nodiscard]] bool lost() const noexcept override { return lost_; }

 private:
  void take(std::string_view line, double now_s);

  struct Moment {
    double s = 0.0;
    OdometricPose pose;
  };
  int descriptor_;
  bool lost_ = false;
  std::string begun_;            // a line whose end has not come
  std::deque<Moment> poses_;     // of the last second
  Seen seen_;
};

// "tcp:ADDRESS:PORT", or the path of a serial device, which is set to 115200 baud, 8N1. Throws BaseError.
[[nodiscard]] std::unique_ptr<Driver> open_line_base(const std::string& name);

}  // namespace banyan::udp
