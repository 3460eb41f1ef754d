// SPDX-License-Identifier: MIT
// Robots of a rival as a test moves them: who is near hears, packets are lost by draw, and what the links come to is
// counted from outside.
#pragma once

#include <cstdint>
#include <functional>
#include <numeric>
#include <vector>

#include "banyan/controller/core/inputs.hpp"
#include "banyan/controller/core/trig.hpp"

namespace banyan::rivals {

// A random stream of the test's own (Lehmer 1951).
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : state_((seed + 1) * 48271U % 2147483647U) {
    for (int k = 0; k < 8; ++k) (*this)();
  }
  double operator()() {
    state_ = state_ * 48271U % 2147483647U;
    return static_cast<double>(state_) / 2147483647.0;
  }
  double operator()(double low, double high) { return low + (high - low) * (*this)(); }

 private:
  std::uint64_t state_;
};

class Components {
 public:
  explicit Components(std::size_t n) : up_(n) { std::iota(up_.begin(), up_.end(), std::size_t{0}); }
  std::size_t find(std::size_t i) {
    while (up_[i] != i) i = up_[i] = up_[up_[i]];
    return i;
  }
  bool join(std::size_t a, std::size_t b) {
    a = find(a), b = find(b);
    up_[a] = b;
    return a != b;
  }
  [[nodiscard]] std::size_t count() {
    std::size_t parts = 0;
    for (std::size_t i = 0; i < up_.size(); ++i) parts += find(i) == i ? 1 : 0;
    return parts;
  }

 private:
  std::vector<std::size_t> up_;
};

// R: Robots of a rival (core/swarm_of.hpp). They turn as they like and do not move by themselves.
template <class R>
struct Net {
  typename R::Params params;
  std::vector<Vec2> at;
  std::vector<Vec2> facing;
  std::vector<typename R::State> states;
  std::vector<typename R::Message> said;
  std::function<bool(std::size_t, std::size_t)> hidden = [](std::size_t, std::size_t) { return false; };
  double loss = 0.0;
  std::vector<Orders> orders;  // nobody is sent unless it says so
  Draw draw;

  Net(typename R::Params p, std::vector<Vec2> positions, std::uint64_t seed) : params(p), at(std::move(positions)), draw(seed) {
    for (std::size_t i = 0; i < at.size(); ++i) {
      states.push_back(R::initial(static_cast<RobotId>(i), false, i == 0));
      orders.emplace_back();
      facing.push_back(unit_vector(static_cast<float>(draw(-3.0, 3.0))));
      said.push_back({});
      said.back().id = static_cast<RobotId>(i);
    }
  }
  [[nodiscard]] bool hears(std::size_t i, std::size_t j) const {
    return i != j && distance(at[i], at[j]) < params.communication_range_m && !hidden(i, j);
  }
  // All have been moved by `ways` since the last tick.
  void tick(const std::vector<Vec2>& ways = {}) {
    const std::vector<typename R::Message> last = said;
    for (std::size_t i = 0; i < at.size(); ++i)
      if (!ways.empty()) at[i] += ways[i];
    for (std::size_t i = 0; i < at.size(); ++i) {
      std::vector<typename R::Heard> heard;
      for (std::size_t j = 0; j < at.size(); ++j)
        if (hears(i, j) && draw() >= loss) heard.push_back({&last[j], rotate_back(facing[i], at[j] - at[i])});
      Senses senses;
      senses.orders = orders[i];
      if (!ways.empty()) {
        const Vec2 way = rotate_back(facing[i], ways[i]);
        senses.odometry = {way.x, way.y, 0.0F};
      }
      said[i] = R::step(params, states[i], heard, senses).message;
    }
  }
  [[nodiscard]] std::size_t radio_parts() const {
    Components parts(at.size());
    for (std::size_t i = 0; i < at.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (hears(i, j)) parts.join(i, j);
    return parts.count();
  }
};

// Places in a square that are one network by links no longer than `reach_m`.
inline std::vector<Vec2> connected_places(std::size_t n, double side_m, double reach_m, Draw& draw) {
  std::vector<Vec2> places{{0.0F, 0.0F}};
  while (places.size() < n) {
    const Vec2 p{static_cast<float>(draw(-0.5 * side_m, 0.5 * side_m)), static_cast<float>(draw(-0.5 * side_m, 0.5 * side_m))};
    bool near = false, too_near = false;
    for (const Vec2 q : places) {
      near = near || distance(p, q) < static_cast<float>(reach_m);
      too_near = too_near || distance(p, q) < 0.15F;
    }
    if (near && !too_near) places.push_back(p);
  }
  return places;
}

}  // namespace banyan::rivals
