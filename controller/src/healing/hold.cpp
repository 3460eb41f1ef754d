// SPDX-License-Identifier: MIT
#include "healing/hold.hpp"

#include <limits>

#include "tree/parent_selection.hpp"

namespace banyan {
namespace {

// A spare's hops to the tree, -1 in the tree itself; a branch that has lost its root comes last.
int hops_to_tree(const TreeStanding& m) noexcept {
  if (m.role == Role::spare) return m.tree_hops;
  return m.depth != invalid_depth ? -1 : unreachable;
}

constexpr float hop_cost = 4.0F;           // a hop to the tree
constexpr float costs_too_long = 8192.0F;  // and more with each C
constexpr float costs_length = 1024.0F;    // a C
constexpr float costs_no_root = 4096.0F;   // of one without a way to the root
constexpr float costs_strained = 2048.0F;  // 255 hops cost half of it
constexpr float costs_change = 2.0F;       // half a hop
constexpr float costs_change_far = 10.0F;  // a hundredth of C

// How bad neighbour k would be as hold: each term outweighs all that follow. A branch that has lost its root is the
// last choice, however near. The present hold is kept while it is as good as another: a robot that changes its hold
// every tick gets nowhere. Of links that are too long the shortest is drawn in, however many hops away.
float cost(const HealingRobot& robot, int k, int hops) noexcept {
  constexpr float strained = 0.85F;  // of C: beyond, the guard slows both ends down
  const float range = robot.table().range(k);
  const bool another = hops >= 0 && robot.table().id(k) != robot.self.hold;
  if (range > longest_link)
    return costs_too_long + costs_length * range + (another ? costs_change_far : 0.0F) +
           static_cast<float>(hops) / unreachable;
  return (hops == unreachable || robot.may_be_deaf(k) ? costs_no_root : 0.0F) +
         (range > strained ? costs_strained : 0.0F) + hop_cost * static_cast<float>(hops) +
         (another ? costs_change : 0.0F) + range;
}

// The best neighbour that is ahead of me, -1 if there is none; `wish` is the best one, whether or not it is ahead. Most
// robots find it among those of the tree that are near, or among those from which the tree is nearest, so these are
// looked at first.
int best_hold(const HealingRobot& robot, int& wish) noexcept {
  const TreeTable& table = robot.table();
  int hold = -1;
  float hold_cost = std::numeric_limits<float>::max();
  float wish_cost = hold_cost;
  const auto consider = [&](int k) {
    const TreeStanding& m = table.message(k);
    if (!(table.id(k) == robot.held ? robot.is_linked(k) : robot.is_sure(k)) || m.epoch != robot.self.epoch ||
        is_untied(m))
      return;
    const int hops = hops_to_tree(m);
    if (hop_cost * static_cast<float>(hops) >= hold_cost) return;  // nor is it a better wish
    const bool ahead = is_ahead(robot, k);
    // A robot farther from the tree than I am may depend on me: it would never get ahead.
    if (!ahead && hops >= robot.self.tree_hops) return;
    const float c = cost(robot, k, hops);
    if (c < wish_cost) wish = k, wish_cost = c;
    if (ahead && c < hold_cost) hold = k, hold_cost = c;
  };
  float others = 0.0F;  // that have not been looked at cost at least so much
  for (const Rows* const rows : {&table.members, &table.nearest, &table.all()}) {
    if (rows == &table.all())
      hold_cost = wish_cost = std::numeric_limits<float>::max();  // of those that cost as much the first
    rows->for_each(consider);
    if (hold_cost < others) break;
    others = hop_cost * static_cast<float>(table.least_hops + 1);
  }
  return hold;
}

}  // namespace

void find_hold(HealingRobot& robot) noexcept {
  HealingState& self = robot.self;
  const TreeTable& table = robot.table();
  robot.hold = -1;
  if (!robot.is_root() && robot.up() < 0) {
    int wish = -1;
    robot.hold = best_hold(robot, wish);
    // Until the flood of a new epoch has arrived, the last epoch's hold will do. A robot with children keeps it until
    // that epoch's tree is dropped: by the new labels a robot that depends on me through them may be ahead.
    const bool relied_on = self.phase < Phase::grow_tree && robot.children.size + robot.old_children.size > 0;
    if (const bool unlabelled = self.label == unknown_label; unlabelled || relied_on) {
      const int last = table.find(self.hold);
      if (last >= 0 && robot.is_linked(last)) robot.hold = last;
      else if (unlabelled) robot.hold = -1;
    }
    // A spare adopts the sequence number of the hold it would like best, which is ahead of it then, like the rest
    // of the tree. A spare that is about to join an edge stays behind.
    if (wish >= 0 && self.role == Role::spare && self.phase >= Phase::grow_tree && self.request == nobody)
      keep_up(robot, wish);
  }
  self.hold = robot.hold < 0 ? nobody : table.id(robot.hold);
}

}  // namespace banyan
