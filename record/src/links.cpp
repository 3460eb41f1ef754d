// SPDX-License-Identifier: MIT
// Radio links from positions alone, as a picture needs them: a sweep over x (draw.hpp).
#include <algorithm>
#include <numeric>

#include "banyan/record/draw.hpp"
#include "banyan/world/obstacles.hpp"
#include "sight.hpp"

namespace banyan::record {

namespace {

class Sweep {
 public:
  Sweep(const Setting& setting, const Frame& frame) : setting_(setting), robots_(frame.robots) {
    order_.resize(robots_.size());
    std::iota(order_.begin(), order_.end(), std::uint32_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) { return x(a) < x(b); });
  }

  RadioLinks links() const {
    RadioLinks links;
    for (std::size_t p = 0; p < order_.size(); ++p) {
      const std::uint32_t a = order_[p];
      if (!robots_[a].alive) continue;
      for (std::size_t q = p + 1; q < order_.size() && x(order_[q]) - x(a) < setting_.range_m; ++q) {
        const std::uint32_t b = order_[q];
        if (!robots_[b].alive || !(distance(at(a), at(b)) < setting_.range_m)) continue;
        const bool blocked = setting_.line_of_sight && is_blocked(p, q);
        (blocked ? links.blocked : links.open).emplace_back(std::min(a, b), std::max(a, b));
      }
    }
    std::sort(links.open.begin(), links.open.end());
    std::sort(links.blocked.begin(), links.blocked.end());
    return links;
  }

 private:
  [[nodiscard]] Vec2 at(std::uint32_t i) const { return robots_[i].position; }
  [[nodiscard]] double x(std::uint32_t i) const { return robots_[i].position.x; }

  // Bodies and obstacles. Only robots whose x lies within the pair's, widened by
  // a radius, can be in the way; `p` and `q` are places in the order.
  [[nodiscard]] bool is_blocked(std::size_t p, std::size_t q) const {
    const Vec2 a = at(order_[p]);
    const Vec2 b = at(order_[q]);
    const double radius = setting_.radius_m;
    std::size_t first = p;
    while (first > 0 && x(order_[first - 1]) > a.x - radius) --first;
    for (std::size_t k = first; k < order_.size() && x(order_[k]) < b.x + radius; ++k) {
      if (k != p && k != q && hides(setting_, robots_[order_[k]], robots_[order_[p]], robots_[order_[q]])) return true;
    }
    return std::any_of(setting_.obstacles.begin(), setting_.obstacles.end(),
                       [&](const world::Obstacle& obstacle) { return world::blocks(obstacle, a, b); });
  }

  const Setting& setting_;
  const std::vector<RobotFrame>& robots_;
  std::vector<std::uint32_t> order_;  // by x
};

}  // namespace

RadioLinks radio_links(const Setting& setting, const Frame& frame) { return Sweep(setting, frame).links(); }

}  // namespace banyan::record
