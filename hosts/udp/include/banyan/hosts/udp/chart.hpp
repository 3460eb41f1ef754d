// SPDX-License-Identifier: MIT
// Where robots are, as far as they know it themselves: no tracker sees them. Each one tells its odometry and where it
// has measured others. Two that have measured each other know how they stand to each other, headings included; along
// such pairs all are placed, from one of them, the anchor, whose odometry is taken as true. Who is joined to the anchor
// by no pair goes on by its own odometry from where it was placed last.
//
// So the chart is in the frame of the anchor's odometry and drifts with it. Errors of bearings add up along the pairs.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "banyan/hosts/udp/messages.hpp"
#include "banyan/hosts/udp/pose_stream.hpp"

namespace banyan::udp {

class Chart {
 public:
  explicit Chart(std::size_t robots) : robots_(robots), poses_(robots) {}

  void take(std::size_t robot, const Account& account);
  // Once a tick. Accounts that are older than a few of them place nobody.
  void update();

  // Nothing for a robot that has never been placed. Stays where it is in memory.
  [[nodiscard]] std::span<const std::optional<TrackedPose>> poses() const noexcept { return poses_; }
  [[nodiscard]] std::vector<std::size_t> missing() const;
  // Where the target of that robot is, if it says that it has one.
  [[nodiscard]] std::optional<BasicVec2<double>> target_of(std::size_t robot) const;
  [[nodiscard]] std::size_t targets() const;  // how many robots say so

 private:
  struct Robot {
    std::optional<Account> account;  // the newest
    OdometricPose placed;            // its odometry when its pose was computed last
    unsigned age = 0;                // ticks since the account came
  };
  [[nodiscard]] bool is_fresh(std::size_t robot) const noexcept;
  [[nodiscard]] const Sighting* sighting(std::size_t from, std::size_t of) const noexcept;
  [[nodiscard]] std::optional<std::size_t> anchor() const noexcept;
  void reckon(std::size_t i);
  [[nodiscard]] std::optional<TrackedPose> seen_from(std::size_t from, std::size_t of) const;

  std::vector<Robot> robots_;
  std::vector<std::optional<TrackedPose>> poses_;
};

}  // namespace banyan::udp
