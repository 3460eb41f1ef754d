// SPDX-License-Identifier: MIT
// What other programs say of where robots are, and whether it can be believed. Poses of ROS 2 are in space; here they
// are laid on the floor. What is refused is counted by its reason, and the last pose stays.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "banyan/hosts/udp/pose_stream.hpp"

namespace banyan::ros2 {

struct Quaternion {
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
};
struct StampedPose {
  std::int64_t stamp_ns = 0;  // since 1970, or since a simulation began
  std::string frame;
  double x_m = 0.0, y_m = 0.0;
  Quaternion rotation;
};

enum class Refusal : std::uint8_t { not_finite, no_rotation, tilted, far_away, other_frame, too_old, early, overtaken };
constexpr std::size_t refusals = 8;
[[nodiscard]] const char* name_of(Refusal refusal) noexcept;  // "1 pose was ..."

// The turn about the vertical axis.
[[nodiscard]] double heading_of(const Quaternion& q) noexcept;

class Sightings {
 public:
  // `frame` "": that of each robot's first pose. `max_age_s` 0: stamps are not compared with the clock.
  Sightings(std::size_t robots, const std::string& frame, double max_age_s)
      : frames_(robots, frame), last_ns_(robots), max_age_s_(max_age_s) {}

  // Of the robot at that place of the list. Nothing: it was refused, by the reason in `why`.
  [[nodiscard]] std::optional<udp::TrackedPose> take(std::size_t place, const StampedPose& sighting,
                                                     std::int64_t now_ns, Refusal& why);
  [[nodiscard]] std::uint64_t taken() const noexcept { return taken_; }
  [[nodiscard]] const std::array<std::uint64_t, refusals>& refused() const noexcept { return refused_; }
  [[nodiscard]] bool has_seen(std::size_t place) const noexcept { return last_ns_[place].has_value(); }
  [[nodiscard]] const std::string& frame(std::size_t place) const noexcept { return frames_[place]; }

 private:
  [[nodiscard]] std::optional<Refusal> fault(std::size_t place, const StampedPose& sighting, std::int64_t now_ns) const;

  std::vector<std::string> frames_;
  std::vector<std::optional<std::int64_t>> last_ns_;
  double max_age_s_;
  std::uint64_t taken_ = 0;
  std::array<std::uint64_t, refusals> refused_{};
};

}  // namespace banyan::ros2
