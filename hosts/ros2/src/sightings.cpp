// SPDX-License-Identifier: MIT
#include "banyan/hosts/ros2/sightings.hpp"

#include <cmath>

namespace banyan::ros2 {
namespace {

constexpr double norm_tolerance = 0.01;             // programs round, and some write 0.707
constexpr double least_upright = 0.7;               // cosine of some 45 degrees
constexpr std::int64_t restart_ns = 1'000'000'000;  // a simulation's clock that goes back by more has begun anew

double norm_of(const Quaternion& q) noexcept { return std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w); }

}  // namespace

const char* name_of(Refusal refusal) noexcept {
  switch (refusal) {
    case Refusal::not_finite: return "not finite";
    case Refusal::no_rotation: return "of a quaternion that is no rotation";
    case Refusal::tilted: return "tilted by more than 45 degrees";
    case Refusal::far_away: return "farther than 100 km from the origin";
    case Refusal::other_frame: return "of another frame";
    case Refusal::too_old: return "too old";
    case Refusal::early: return "from the future";
    case Refusal::overtaken: return "not newer than the last";
  }
  return "";
}

double heading_of(const Quaternion& q) noexcept {
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
}

std::optional<Refusal> Sightings::fault(std::size_t place, const StampedPose& sighting, std::int64_t now_ns) const {
  const Quaternion& q = sighting.rotation;
  const double norm = norm_of(q);
  if (!std::isfinite(sighting.x_m) || !std::isfinite(sighting.y_m) || !std::isfinite(norm)) return Refusal::not_finite;
  if (std::fabs(norm - 1.0) > norm_tolerance) return Refusal::no_rotation;
  if (1.0 - 2.0 * (q.x * q.x + q.y * q.y) < least_upright) return Refusal::tilted;
  if (!udp::is_sound({{sighting.x_m, sighting.y_m}, 0.0})) return Refusal::far_away;
  if (!frames_[place].empty() && sighting.frame != frames_[place]) return Refusal::other_frame;
  const double age_s = 1e-9 * static_cast<double>(now_ns - sighting.stamp_ns);
  if (max_age_s_ > 0.0 && age_s > max_age_s_) return Refusal::too_old;
  if (max_age_s_ > 0.0 && age_s < -max_age_s_) return Refusal::early;
  if (!last_ns_[place] || sighting.stamp_ns > *last_ns_[place]) return std::nullopt;
  if (max_age_s_ == 0.0 && *last_ns_[place] - sighting.stamp_ns > restart_ns) return std::nullopt;
  return Refusal::overtaken;
}

std::optional<udp::TrackedPose> Sightings::take(std::size_t place, const StampedPose& sighting, std::int64_t now_ns,
                                                Refusal& why) {
  if (const auto refusal = fault(place, sighting, now_ns)) {
    why = *refusal;
    ++refused_.at(static_cast<std::size_t>(why));
    return std::nullopt;
  }
  if (frames_[place].empty()) frames_[place] = sighting.frame;
  last_ns_[place] = sighting.stamp_ns;
  ++taken_;
  return udp::TrackedPose{{sighting.x_m, sighting.y_m}, heading_of(sighting.rotation)};
}

}  // namespace banyan::ros2
