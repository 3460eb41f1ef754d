// SPDX-License-Identifier: MIT
// How many hops a robot is from a large boundary, and how deep the swarm is at most within as many hops of there: so
// thick it is. Where it is thick, the boundary is drawn in.
#include <algorithm>

#include "rooms.hpp"

namespace banyan::baselines::cohesion {
namespace {

constexpr int deepest = 64;       // a larger depth is none: there is no boundary any more
constexpr float renewal = 0.02F;  // of the lasting thickness, a step
constexpr int thin = 1;           // so thick the swarm may be

// No third robot in the circle over the link (Gabriel & Sokal 1969): hops that do not jump over robots.
bool is_hop(const Surroundings& around, int k) noexcept {
  const Vec2 middle = around.place(k) * 0.5F;
  const float radius = squared_norm(middle);
  for (int j = 0; j < around.size; ++j)
    if (j != k && squared_norm(around.place(j) - middle) < radius) return false;
  return true;
}

}  // namespace

Thickness find_thickness(const Robot& robot, const Boundary& boundary) noexcept {
  std::array<bool, neighbor_capacity> hop;
  for (int k = 0; k < robot.around.size; ++k) hop[static_cast<std::size_t>(k)] = is_hop(robot.around, k);
  Thickness found;
  int depth = boundary.is_large() ? 0 : deepest;
  for (int k = 0; k < robot.around.size && depth > 0; ++k)
    if (hop[static_cast<std::size_t>(k)]) depth = std::min(depth, robot.message(k).depth + 1);
  if (depth < deepest) found.depth = static_cast<std::uint8_t>(depth);
  found.thickness = found.depth;
  for (int k = 0; k < robot.around.size; ++k) {
    const Message& m = robot.message(k);
    if (!hop[static_cast<std::size_t>(k)] || m.thickness == unknown_depth || m.hops > m.thickness) continue;
    const bool is_more = found.thickness == unknown_depth || m.thickness > found.thickness;
    const bool is_nearer = m.thickness == found.thickness && m.hops < found.hops;
    if (!is_more && !is_nearer) continue;
    found.thickness = m.thickness;
    found.hops = static_cast<std::uint8_t>(m.hops + 1);
    found.towards = k;
  }
  return found;
}

// (7)
Vec2 contraction(Robot& robot, const Boundary& boundary, const Thickness& found) noexcept {
  const float now = found.thickness == unknown_depth ? 0.0F : static_cast<float>(found.thickness);
  robot.self.lasting_thickness += renewal * (now - robot.self.lasting_thickness);
  if (!boundary.is_large() || found.towards < 0 || found.thickness <= thin) return {};
  return robot.around.place(found.towards) * (robot.params.thickness_gain * robot.self.lasting_thickness);
}

}  // namespace banyan::baselines::cohesion
