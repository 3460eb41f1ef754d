// SPDX-License-Identifier: MIT
// A robot of the tree that heals: the same step, with more to know.
#pragma once

#include <algorithm>

#include "banyan/controller/healing/params.hpp"
#include "banyan/controller/healing/state.hpp"
#include "obstacles/bypass.hpp"
#include "tree/robot.hpp"

namespace banyan {

// And of the root's heartbeat. What is said of the targets is looked at in full (takeover.cpp): something of it is
// nearly always new.
struct KnownOfHealing : KnownOfTree {
  KnownOfHealing(const HealingState& self, int elapsed_ticks) noexcept
      : KnownOfTree(self),
        heartbeat(self.heartbeat),
        silence_ticks(self.silence_ticks + elapsed_ticks),
        has_heart(self.heart == self.root) {}
  [[nodiscard]] bool lacks(const HealingMessage& m) const noexcept {
    return m.told == id || m.id == root.id || !has_heart || is_news(m.heartbeat, heartbeat, silence_ticks);
  }
  Serial heartbeat;
  int silence_ticks;
  bool has_heart;
};

struct HealingRobot : TreeRobot {
  HealingRobot(const HealingParams& params_, HealingState& self_, const Inputs<Heard>& inputs,
               Workspace& space) noexcept
      : TreeRobot(params_, self_, inputs, space), params(params_), self(self_), held(self_.hold) {
    take_patience();
  }

  void take_patience() noexcept;  // what follows from the lost packets

  const HealingParams& params;  // the same objects as the tree's
  HealingState& self;
  int gap = -1;       // index of a deaf neighbour that nothing ties me to (mutual.cpp)
  int tie_ticks = 0;  // for so long a silent neighbour may be there and depend on me (tie.hpp); 0: no packets get lost
  RobotId held;       // the hold of the last step
  bool target_strays = false;      // it is not where it would be if it stood still and my wheels had not slipped
  bool passes_targets_on = false;  // robots hand their targets over to others again and again
};

// A neighbour silent for longer will be forgotten within two ticks, or at the next step where steps are longer: this
// is the last moment at which its message can be read.
[[nodiscard]] inline int fading_ticks(const HealingRobot& robot) noexcept {
  constexpr int notice_ticks = 2;  // before it is forgotten
  return robot.liveness_ticks() - std::max(notice_ticks, robot.elapsed_ticks);
}
[[nodiscard]] inline bool fades(const HealingRobot& robot, int k) noexcept {
  return robot.table().age(k) > fading_ticks(robot);
}

[[nodiscard]] inline Vec2 bypass(const HealingRobot& robot, Vec2 goal) noexcept {
  return bypass(robot, robot.self.detour, goal);
}

// What a healing robot hears is what healing robots say.
inline const HealingMessage& healing_message(const TreeMessage& m) noexcept {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-static-cast-downcast): a swarm has one algorithm
  return static_cast<const HealingMessage&>(m);
}
inline const HealingMessage& said(const Heard& h) noexcept { return healing_message(*h.message); }

// A packet is news if something in it is.
inline void push_news(HealingRobot& robot, const KnownOfHealing& known, Heard& h) noexcept {
  const bool of_tree = known.KnownOfTree::lacks(said(h));
  robot.is_tree_news |= of_tree;
  if (of_tree || known.lacks(said(h))) robot.news.push(h);
}

}  // namespace banyan
