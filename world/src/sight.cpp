// SPDX-License-Identifier: MIT
#include "banyan/world/sight.hpp"

#include <utility>

#include "banyan/world/obstacles.hpp"

namespace banyan::world {

bool in_range(const Scene& scene, std::size_t i, std::size_t j) noexcept {
  return scene.alive[i] != 0 && scene.alive[j] != 0 &&
         squared_norm(scene.positions[j] - scene.positions[i]) < scene.range_m * scene.range_m;
}

std::optional<Blocker> blocker(const Scene& scene, std::size_t i, std::size_t j) noexcept {
  if (j < i) std::swap(i, j);
  const Vec2 here = scene.positions[i];
  const Vec2 d = scene.positions[j] - here;
  const double d2 = squared_norm(d);
  for (std::size_t k = 0; k < scene.positions.size(); ++k) {
    if (k == i || k == j || (scene.alive[k] == 0 && !scene.dead_bodies)) continue;
    const Vec2 body = scene.positions[k] - here;
    if (!disc_blocks(body, d, d2, scene.radius_m)) continue;
    const std::size_t nearer = 2.0 * dot(body, d) < d2 ? i : j;
    if (scene.raised.empty() || scene.raised[nearer] == 0) return Blocker{false, k};
  }
  for (std::size_t k = 0; k < scene.obstacles.size(); ++k)
    if (blocks(scene.obstacles[k], here, scene.positions[j])) return Blocker{true, k};
  return std::nullopt;
}

bool hears(const Scene& scene, std::size_t i, std::size_t j) noexcept {
  return in_range(scene, i, j) && !(scene.line_of_sight && blocker(scene, i, j));
}

}  // namespace banyan::world
