// SPDX-License-Identifier: MIT
// A robot of a grown tree that watches its root, for the tests of healing.
#pragma once

#include <cmath>
#include <cstdint>

#include "bench.hpp"

namespace banyan {

inline constexpr RobotId root_id = 9;
inline constexpr float very_long_drives = 30.0F;

// A robot of a grown tree with its root in sight; the root counts ticks.
struct Watch {
  ConvoyBench bench = grown<Convoy>();
  std::uint16_t count = 100;
  explicit Watch(Vec2 root = {0.25F, 0.0F}) {
    bench.params.give_up_after_drives = very_long_drives;  // it stands still whatever it wants
    bench.state.label = static_cast<std::uint16_t>(std::lround(norm(root) * per_range));
    auto& m = bench.put(root_id, root);
    m.role = Role::root;
    m.depth = 1;
    m.tree_hops = 0;
    m.label = 0;
    m.committed = true;
  }
  void hear_root(int ticks, const Odometry& odometry = {}) {
    for (int k = 0; k < ticks; ++k) {
      bench.say(root_id).heartbeat = count++;
      bench.step(odometry);
    }
  }
  // The neighbour serves a target at `target` (my frame) and counts `beat`.
  void tell_of_target(RobotId sender, Vec2 at, Vec2 target, RobotId serves, std::uint16_t beat) {
    auto& m = bench.put(sender, at);
    m.root = bench.state.root;
    const Vec2 v = rotate_back(unit(-at), target);
    m.told = bench.state.id;
    m.task_serves = serves;
    m.task_holder = serves;
    m.task_beat = beat;
    m.task_x = Coordinate::of(v.x);
    m.task_y = Coordinate::of(v.y);
  }
};

}  // namespace banyan
