// SPDX-License-Identifier: MIT
// Robots of a baseline as a test moves them: who is near hears, packets are lost by draw, and what the links come to is
// counted from outside.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "banyan/controller/core/inputs.hpp"
#include "banyan/controller/core/trig.hpp"
#include "test_platform.hpp"

namespace banyan::baselines {

// BANYAN_LONG=1 asks for long searches.
inline bool long_search() {
  const char* value = std::getenv("BANYAN_LONG");
  return value != nullptr && std::string(value) != "0" && *value != '\0';
}

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

// R: Robots of a baseline (core/swarm_of.hpp). They turn as they like and do not move by themselves. Places are in
// metres, which are C unless a test says otherwise.
template <class R> struct Net {
  typename R::Params params;
  Platform platform = test_platform;
  std::vector<Vec2> at;
  std::vector<Vec2> facing;
  std::vector<typename R::State> states;
  std::vector<typename R::Message> said;
  std::function<bool(std::size_t, std::size_t)> hidden = [](std::size_t, std::size_t) { return false; };
  double loss = 0.0;
  std::vector<Orders> orders;  // nobody is sent unless it says so
  std::vector<double> period;  // ticks between the steps of each robot; none: each steps at every tick
  std::size_t latency = 1;     // ticks until a message is heard
  double noise_m = 0.0;        // of a measured position, at most, in x and y
  Draw draw;
  // Since each robot's last step, by its number; and what was said in ticks before, the last first
  std::vector<Vec2> driven;
  std::vector<double> stepped;
  std::vector<std::map<std::size_t, typename R::Message>> inbox;
  std::vector<std::vector<typename R::Message>> said_before;
  std::size_t ticks = 0;

  Net(typename R::Params p, std::vector<Vec2> positions, std::uint64_t seed)
      : params(p), at(std::move(positions)), draw(seed) {
    for (std::size_t i = 0; i < at.size(); ++i) {
      states.push_back(R::initial(static_cast<RobotId>(i), false, i == 0));
      orders.emplace_back();
      facing.push_back(unit_vector(static_cast<float>(draw(-3.0, 3.0))));
      driven.push_back({});
      stepped.push_back(0.0);
      inbox.emplace_back();
      said.push_back({});
      said.back().id = static_cast<RobotId>(i);
    }
  }
  [[nodiscard]] bool hears(std::size_t i, std::size_t j) const {
    return i != j && distance(at[i], at[j]) < platform.communication_range_m && !hidden(i, j);
  }
  // All have been moved by `ways` since the last tick.
  void tick(const std::vector<Vec2>& ways = {}) {
    said_before.insert(said_before.begin(), said);
    said_before.resize(std::min(said_before.size(), latency));
    const std::vector<typename R::Message>& last = said_before.back();
    ++ticks;
    for (std::size_t i = 0; i < at.size(); ++i)
      if (!ways.empty()) at[i] += ways[i];
    for (std::size_t i = 0; i < at.size(); ++i) {
      std::map<std::size_t, typename R::Message>& waiting = inbox[i];
      for (std::size_t j = 0; j < at.size(); ++j)
        if (hears(i, j) && draw() >= loss) waiting[j] = last[j];
      if (!ways.empty()) driven[i] += ways[i];
      const double every = period.empty() ? 1.0 : period[i];
      if (static_cast<double>(ticks) - stepped[i] < every - 1e-6) continue;
      std::vector<typename R::Heard> heard;
      heard.reserve(waiting.size());
      for (const auto& [j, message] : waiting)
        heard.push_back({&message, rotate_back(facing[i], at[j] - at[i] + noise())});
      Senses senses;
      senses.orders = orders[i];
      const Vec2 way = rotate_back(facing[i], driven[i]);
      senses.odometry = {way.x, way.y, 0.0F};
      if (!period.empty()) senses.elapsed_s = static_cast<float>(every) * platform.tick_s;
      said[i] = R::step(params, states[i], {heard, senses, platform}).message;
      stepped[i] += every;
      driven[i] = {};
      waiting.clear();
    }
  }
  Vec2 noise() {
    if (noise_m <= 0.0) return {};
    const auto x = static_cast<float>(draw(-noise_m, noise_m));
    return {x, static_cast<float>(draw(-noise_m, noise_m))};
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
    const Vec2 p{static_cast<float>(draw(-0.5 * side_m, 0.5 * side_m)),
                 static_cast<float>(draw(-0.5 * side_m, 0.5 * side_m))};
    bool near = false, too_near = false;
    for (const Vec2 q : places) {
      near = near || distance(p, q) < static_cast<float>(reach_m);
      too_near = too_near || distance(p, q) < 0.075F;
    }
    if (near && !too_near) places.push_back(p);
  }
  return places;
}

}  // namespace banyan::baselines
