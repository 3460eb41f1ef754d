// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/chart.hpp"

#include <algorithm>
#include <cmath>

namespace banyan::udp {
namespace {

using Point = BasicVec2<double>;

constexpr unsigned fresh_ticks = 3;

Point turned(Point p, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return {c * p.x - s * p.y, s * p.x + c * p.y};
}
Point wide(Vec2 p) { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }
double direction(Point p) { return std::atan2(p.y, p.x); }

Point outside(const TrackedPose& pose, Vec2 in_body) { return pose.position + turned(wide(in_body), pose.heading_rad); }

}  // namespace

void Chart::take(std::size_t robot, const Account& account) {
  robots_[robot].account = account;
  robots_[robot].age = 0;
}

bool Chart::is_fresh(std::size_t robot) const noexcept {
  return robots_[robot].account && robots_[robot].age <= fresh_ticks;
}

const Sighting* Chart::sighting(std::size_t from, std::size_t of) const noexcept {
  if (!is_fresh(from)) return nullptr;
  const auto& list = robots_[from].account->seen;
  const auto at = std::find_if(list.begin(), list.end(), [&](const Sighting& s) { return s.robot == of; });
  return at == list.end() ? nullptr : &*at;
}

// The first that has just spoken and has a place; at the very beginning the first that speaks, and it is where it says.
std::optional<std::size_t> Chart::anchor() const noexcept {
  const auto first = [&](unsigned age, bool placed) -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < robots_.size(); ++i)
      if (robots_[i].account && robots_[i].age <= age && (poses_[i] || !placed)) return i;
    return std::nullopt;
  };
  if (const auto now = first(1, true)) return now;
  if (const auto lately = first(fresh_ticks, true)) return lately;
  return first(fresh_ticks, false);
}

// By its wheels, from where it was placed last.
void Chart::reckon(std::size_t i) {
  Robot& robot = robots_[i];
  if (!poses_[i] || !robot.account) return;
  const OdometricPose& now = robot.account->odometry;
  const Point shift = turned(wide(robot.placed.inside(now.position)), poses_[i]->heading_rad);
  poses_[i] = {
      poses_[i]->position + shift,
      std::remainder(poses_[i]->heading_rad + static_cast<double>(now.turn_rad - robot.placed.turn_rad), 2.0 * M_PI)};
  robot.placed = now;
}

std::optional<TrackedPose> Chart::seen_from(std::size_t from, std::size_t of) const {
  const Sighting* there = sighting(from, of);
  const Sighting* back = sighting(of, from);
  if (there == nullptr || back == nullptr) return std::nullopt;
  const Point position = outside(*poses_[from], there->position);
  const double heading = direction(poses_[from]->position - position) - direction(wide(back->position));
  return TrackedPose{position, std::remainder(heading, 2.0 * M_PI)};
}

void Chart::update() {
  for (Robot& robot : robots_) ++robot.age;
  for (std::size_t i = 0; i < robots_.size(); ++i) reckon(i);
  const auto first = anchor();
  if (!first) return;
  const OdometricPose& start = robots_[*first].account->odometry;
  if (!poses_[*first]) poses_[*first] = {wide(start.position), static_cast<double>(start.turn_rad)};
  std::vector<std::size_t> reached{*first};
  std::vector<bool> is_reached(robots_.size(), false);
  is_reached[*first] = true;
  for (std::size_t next = 0; next < reached.size(); ++next) {
    for (std::size_t j = 0; j < robots_.size(); ++j) {
      if (is_reached[j]) continue;
      const auto pose = seen_from(reached[next], j);
      if (!pose) continue;
      poses_[j] = pose;
      is_reached[j] = true;
      reached.push_back(j);
    }
  }
  for (const std::size_t i : reached) robots_[i].placed = robots_[i].account->odometry;
}

std::vector<std::size_t> Chart::missing() const {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < poses_.size(); ++i)
    if (!poses_[i]) list.push_back(i);
  return list;
}

std::optional<BasicVec2<double>> Chart::target_of(std::size_t robot) const {
  const auto& account = robots_[robot].account;
  if (!is_fresh(robot) || !account->target || !poses_[robot]) return std::nullopt;
  return outside(*poses_[robot], *account->target);
}

std::size_t Chart::targets() const {
  std::size_t count = 0;
  for (std::size_t robot = 0; robot < robots_.size(); ++robot) count += target_of(robot) ? 1U : 0U;
  return count;
}

}  // namespace banyan::udp
