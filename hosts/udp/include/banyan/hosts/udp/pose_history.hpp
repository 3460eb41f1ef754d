// SPDX-License-Identifier: MIT
// Where a base has said that it is, for the last second: what was measured a moment ago is put where the robot was
// then.
#pragma once

#include <deque>
#include <optional>

#include "banyan/hosts/udp/messages.hpp"

namespace banyan::udp {

class PoseHistory {
 public:
  void take(const OdometricPose& pose, double now_s) {
    poses_.push_back({now_s, pose});
    while (poses_.size() > 1 && poses_.front().s < now_s - remembered_s) poses_.pop_front();
  }
  // The newest of that moment; before the first, the origin.
  [[nodiscard]] OdometricPose at(double moment_s) const {
    OdometricPose pose = poses_.empty() ? OdometricPose{} : poses_.front().pose;
    for (const Moment& moment : poses_)
      if (moment.s <= moment_s) pose = moment.pose;
    return pose;
  }
  [[nodiscard]] std::optional<double> last_s() const {
    if (poses_.empty()) return std::nullopt;
    return poses_.back().s;
  }

 private:
  static constexpr double remembered_s = 1.0;
  struct Moment {
    double s = 0.0;
    OdometricPose pose;
  };
  std::deque<Moment> poses_;
};

}  // namespace banyan::udp
