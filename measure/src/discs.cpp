// SPDX-License-Identifier: MIT
// Every question is answered by trying the few points among which the answer must be: the nearest point of a convex
// region bounded by arcs is on an arc, and then straight towards its centre, or it is a corner.
#include "discs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace banyan::measure {

using world::Vec2;

Vec2 RangeDisc::nearest(Vec2 from) const noexcept {
  const double far = distance(center, from);
  return far <= radius ? from : center + (from - center) * (radius / far);
}

Points crossing(const RangeDisc& a, const RangeDisc& b) noexcept {
  const Vec2 way = b.center - a.center;
  const double far = norm(way);
  if (far > a.radius + b.radius + touch || far <= std::abs(a.radius - b.radius)) return {};
  const double along = (far * far + a.radius * a.radius - b.radius * b.radius) / (2.0 * far);
  const double aside = std::sqrt(std::max(0.0, a.radius * a.radius - along * along));
  const Vec2 ahead = way / far;
  const Vec2 middle = a.center + ahead * along, left{-ahead.y * aside, ahead.x * aside};
  return {{middle + left, middle - left}, 2};
}

CommonRegion::CommonRegion(std::vector<RangeDisc> discs) : discs_{std::move(discs)} {
  for (std::size_t i = 0; i < discs_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (const Vec2 p : crossing(discs_[i], discs_[j]))
        if (has(p)) corners_.push_back(p);
  // Without a corner there is one disc inside all others, or nothing.
  const auto inner = [this](const RangeDisc& d) { return has(d.center); };
  const auto least = std::min_element(discs_.begin(), discs_.end(),
                                      [](const RangeDisc& a, const RangeDisc& b) { return a.radius < b.radius; });
  empty_ = corners_.empty() && !inner(*least);
}

bool CommonRegion::has(Vec2 p) const noexcept {
  return std::all_of(discs_.begin(), discs_.end(), [p](const RangeDisc& d) { return d.has(p); });
}

Vec2 CommonRegion::nearest(Vec2 from) const noexcept {
  if (has(from)) return from;
  Vec2 best;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](Vec2 p) {
    const double d = distance(p, from);
    if (d < least) best = p, least = d;
  };
  for (const RangeDisc& disc : discs_) {
    const Vec2 p = disc.nearest(from);
    if (!disc.has(from) && has(p)) consider(p);
  }
  for (const Vec2 p : corners_) consider(p);
  return best;
}

Nearest nearest(const CommonRegion& a, const CommonRegion& b) {
  std::vector<RangeDisc> all = a.discs();
  all.insert(all.end(), b.discs().begin(), b.discs().end());
  if (const CommonRegion common(std::move(all)); !common.empty()) {
    const Vec2 p = common.nearest(common.discs().front().center);
    return {p, p};
  }
  Nearest best;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](Vec2 p, Vec2 q) {
    const double d = distance(p, q);
    if (d < least) best = {p, q}, least = d;
  };
  for (const Vec2 p : a.corners()) consider(p, b.nearest(p));
  for (const Vec2 q : b.corners()) consider(a.nearest(q), q);
  for (const RangeDisc& one : a.discs()) {
    for (const RangeDisc& other : b.discs()) {
      const Vec2 p = one.nearest(other.center), q = other.nearest(one.center);
      if (a.has(p) && b.has(q)) consider(p, q);
    }
  }
  return best;
}

// The circles that bound what is within `reach` of the cell.
static std::vector<RangeDisc> outline(const CommonRegion& cell, double reach) {
  std::vector<RangeDisc> circles;
  for (const RangeDisc& d : cell.discs()) circles.push_back({d.center, d.radius + reach});
  for (const Vec2 p : cell.corners()) circles.push_back({p, reach});
  return circles;
}

std::optional<Vec2> between(const RangeDisc& disc, const CommonRegion& a, double a_reach, const CommonRegion& b,
                            double b_reach) {
  const auto fits = [&](Vec2 p) {
    return disc.has(p) && distance(p, a.nearest(p)) <= a_reach + touch && distance(p, b.nearest(p)) <= b_reach + touch;
  };
  // Of the points between the cells the nearest to the disc's centre is that centre, the nearest one of those near a
  // single cell, or a corner of both outlines.
  if (fits(disc.center)) return disc.center;
  for (const auto& [cell, reach] : {std::pair{&a, a_reach}, std::pair{&b, b_reach}}) {
    const Vec2 p = RangeDisc{cell->nearest(disc.center), reach}.nearest(disc.center);
    if (fits(p)) return p;
  }
  const std::vector<RangeDisc> others = outline(b, b_reach);
  for (const RangeDisc& one : outline(a, a_reach))
    for (const RangeDisc& other : others)
      for (const Vec2 p : crossing(one, other))
        if (fits(p)) return p;
  return std::nullopt;
}

}  // namespace banyan::measure
