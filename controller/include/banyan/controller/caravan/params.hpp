// SPDX-License-Identifier: MIT
// What a designer sets (docs/caravan.md).
#pragma once

#include <span>
#include <string_view>

#include "banyan/controller/core/parameter.hpp"
#include "banyan/controller/core/platform.hpp"

namespace banyan::caravan {

struct Params : Machine {
  int link_redundancy = 1;       // the mission's k: edges have a k-th of their length, and every k-th robot is heard
  float longest_edge = 0.95F;    // G: no link that matters outgrows it
  float need_distance = 0.825F;  // a longer edge is worth a spare
  float pull_start = 0.675F;     // a child farther than this tows its parent
  float post_distance = 0.90F;   // a longer edge that waits for a spare is a post
  float pull_width = 0.1F;       // and pulls with full strength so much later
  float tension_gain = 0.4F;
  float robot_cost = 1.0F;        // a robot more in the tree costs as much as a way so much longer
  float hysteresis = 0.2F;        // a new parent has to be so much cheaper
  float clearance = 0.08F;        // a robot nearer than this to an edge may hide it
  float room = 0.14F;             // all keep so far from spares, and a little farther from robots of the tree
  float liveness_rounds = 5.0F;   // I
  float pursue_drives = 1.2F;     // the ends of a torn edge look for each other for so long
  float takeover_rounds = 15.0F;  // a holder silent for so long beyond 2 I is replaced
  float takeover_spread = 10.0F;  // rounds more per C from its place
  float retreat_rounds = 25.0F;   // the root silent for so long beyond 2 I: all go where it was
  float guard_rate = 30.0F;
  float call_after_rounds = 20.0F;
  float give_up_drives = 4.0F;    // of waiting for spares in vain, once and again the nearer the target is
  float retry_drives = 12.0F;     // a target that was put off is tried again after so long
  float relieve_below = 0.35F;    // of a full battery: a robot of the tree with less asks to be relieved
  float charge_below = 0.75F;     // a spare with less joins no edge, and goes to be charged
  float arrival_distance = 0.1F;  // the mission's tolerance
  float speed_gain = 1.0F;
};

[[nodiscard]] std::span<const Parameter<Params>> parameters() noexcept;
[[nodiscard]] std::string_view fault(const Params& params) noexcept;

}  // namespace banyan::caravan
