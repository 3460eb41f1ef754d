// SPDX-License-Identifier: MIT
#include "in_reach.hpp"

#include <algorithm>
#include <cstddef>

namespace banyan::soak {
namespace {

using world::Vec2;

constexpr std::size_t none = static_cast<std::size_t>(-1);

class RobotPerTarget {
 public:
  RobotPerTarget(const std::vector<Vec2>& robots, const std::vector<Vec2>& targets, double way_m)
      : robots_{robots}, targets_{targets}, way_m_{way_m}, goes_to_(robots.size(), none) {}

  // Finds a robot for this target, where need be by sending others elsewhere.
  [[nodiscard]] bool serve(std::size_t target) {
    asked_.assign(robots_.size(), false);
    return augment(target);
  }

 private:
  bool augment(std::size_t target) {
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      if (asked_[i] || norm(robots_[i] - targets_[target]) > way_m_) continue;
      asked_[i] = true;
      if (goes_to_[i] != none && !augment(goes_to_[i])) continue;
      goes_to_[i] = target;
      return true;
    }
    return false;
  }

  const std::vector<Vec2>& robots_;
  const std::vector<Vec2>& targets_;
  double way_m_;
  std::vector<std::size_t> goes_to_;
  std::vector<bool> asked_;
};

}  // namespace

bool all_in_reach(const std::vector<Vec2>& robots, const std::vector<Vec2>& targets, double way_m) {
  RobotPerTarget matching(robots, targets, way_m);
  for (std::size_t k = 0; k < targets.size(); ++k)
    if (!matching.serve(k)) return false;
  return true;
}

}  // namespace banyan::soak
