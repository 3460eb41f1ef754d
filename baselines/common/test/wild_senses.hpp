// SPDX-License-Identifier: MIT
// A step of any baseline with everything sensed wrong at once.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "net.hpp"

namespace banyan::baselines {

// Robot 0 hears `wild`, from places that cannot be and from one that can, and robot 2. `after` each step it may be
// looked at, and the message changed.
template <class R>
void expect_finite_motion(
    const Net<R>& net, typename R::Message wild, int steps,
    const std::function<void(const typename R::State&, typename R::Message&, int)>& after = nullptr) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), infinite, -infinite, 0.0F, 1e30F}) {
    typename R::State s = net.states[0];
    const std::array obstacles{Vec2{bad, 0.1F}, Vec2{0, 0}};
    Senses senses;
    senses.odometry = {bad, 0, bad};
    senses.orders = {true, Vec2{bad, 0}};
    senses.obstacles = obstacles;
    senses.elapsed_s = bad;
    for (int t = 0; t < steps; ++t) {
      std::vector<typename R::Heard> heard{{&wild, {bad, 0}, bad}, {&net.said[2], {0, 0}}, {&wild, {0.5F, 0}}};
      const Motion v = R::step(net.params, s, {heard, senses, net.platform}).motion;
      ASSERT_TRUE(std::isfinite(v.forward) && std::isfinite(v.turn)) << bad;
      if (after) after(s, wild, t);
    }
  }
}

}  // namespace banyan::baselines
