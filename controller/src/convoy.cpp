// SPDX-License-Identifier: MIT
// Convoy (docs/convoy.md), our own: the inwards tree, but towed by the workers instead of pushed by
// springs. Slack gathers near the root, where the spares are, and a spare joins an edge at once.
#include "banyan/controller/convoy.hpp"

#include <algorithm>

#include "banyan/controller/bypass.hpp"
#include "banyan/controller/parent_selection.hpp"
#include "banyan/controller/plan.hpp"
#include "banyan/controller/policies.hpp"
#include "banyan/controller/shortcut.hpp"
#include "banyan/controller/sight.hpp"

namespace banyan {
namespace {

constexpr int silence_ticks = 2;      // a parent silent for so long counts as hidden
constexpr float tight = 0.6F;         // of `clearance`: enough for who stands in the way and clears it by joining

class Convoy final : public Policy {
 public:
  constexpr Convoy() = default;
  [[nodiscard]] std::string_view name() const noexcept override { return "convoy"; }
  [[nodiscard]] std::string_view summary() const noexcept override {
    return "a sparse tree that its workers tow; spares join near the root, without travelling";
  }
  // Lengths for C = 2 m. There is nothing printed to be read in two ways.
  [[nodiscard]] Params defaults(Reading) const noexcept override {
    Params p = inwards().defaults(Reading::corrected);
    p.ideal_distance_m = 1.90F;        // G: no edge outgrows it
    p.safe_range_m = 1.80F;            // the root and junctions are towed only beyond it
    p.recruitment_distance_m = 1.65F;  // a longer edge asks for a spare
    p.avoidance_range_m = 0.36F;
    p.target_gain = 1.0F;
    p.guard_rate_per_s = 2.0F;
    p.connector_patience_s = 1.0F;
    return p;
  }
  [[nodiscard]] bool scales_with_range() const noexcept override { return true; }

  [[nodiscard]] bool may_join(const Robot& robot) const noexcept override { return inwards().may_join(robot); }
  [[nodiscard]] bool accepts(const Robot&, int) const noexcept override { return true; }
  [[nodiscard]] bool prefers(const Robot& robot, int a, int b) const noexcept override;
  [[nodiscard]] bool tree_complete(const Robot& robot) const noexcept override { return inwards().tree_complete(robot); }
  [[nodiscard]] bool leaves_branch(const Robot& robot) const noexcept override { return robot.children.size == 0; }

  // Behind a target that drives a worker lags: its tree must come along before it has lost it.
  [[nodiscard]] float rest_distance(const Params& params) const noexcept override { return 0.4F * params.arrival_distance_m; }
  [[nodiscard]] bool needs_spare(const Robot& robot) const noexcept override;
  [[nodiscard]] bool workers_relay() const noexcept override { return true; }
  // Not while the workers get on: the tree mends itself meanwhile, and a new one is not free.
  [[nodiscard]] bool reconstructs(const Robot& robot) const noexcept override {
    constexpr float patience_s = 5.0F;
    return robot.self.stalled_ticks > robot.params.ticks(patience_s) && !is_planned(robot.self);
  }
  // Only when the edge is about to hold the workers back; among obstacles spares come slowly, and sooner.
  [[nodiscard]] bool may_call(const Robot& robot) const noexcept override {
    if (is_planned(robot.self)) return false;  // they would come along the chains, and in the way
    const Params& p = robot.params;
    const float from_m = robot.self.landmarks.size > 0 ? p.recruitment_distance_m : p.call_distance * p.communication_range_m;
    return robot.parent >= 0 && (robot.self.pinned || robot.table().range(robot.parent) > from_m);
  }
  [[nodiscard]] bool may_insert(const Robot& robot, int owner, int parent) const noexcept override;
  // Once all have arrived, a spare as root would be a robot more.
  [[nodiscard]] bool may_inherit(const Robot& robot, int k) const noexcept override {
    return !saves_robots(robot.params) || robot.self.want_m > 0.0F || robot.table().message(k).role != Role::spare;
  }
  void tend_tree(Robot& robot) const noexcept override {
    take_part_in_plan(robot);
    take_shortcuts(robot);
    robot.self.pinned = is_pinned(robot);
  }
  [[nodiscard]] Vec2 tree_motion(const Robot& robot) const noexcept override { return towed_motion(robot); }
  [[nodiscard]] Vec2 spare_motion(const Robot& robot) const noexcept override { return waiting_motion(robot); }
  void limit_motion(const Robot& robot, Guard& guard) const noexcept override { keep_sight(robot, guard); }
};

// An edge of the last tree, in either direction.
bool was_edge(const Robot& robot, int k) noexcept {
  return k == robot.old_parent || robot.table().message(k).old_parent == robot.self.id;
}

// Once all below have arrived the tree stays what it has become. Else short first edges, then such as
// need no spare, then the nearest; one that soon may be blocked is as good as far, one that is farther still.
struct Preference {
  int rank;
  float key;
  Preference(const Robot& robot, int k) noexcept {
    const Params& p = robot.params;
    const float c = p.communication_range_m;
    if (saves_robots(p) && robot.self.want_m == 0.0F && robot.self.epoch > 1 && was_edge(robot, k)) {
      rank = -1;
      key = static_cast<float>(robot.table().message(k).label_cm);
      return;
    }
    float range_m = robot.table().range(k);
    if (!sees_clearly(robot, k, p.clearance * c)) range_m += sees_clearly(robot, k, narrow * p.clearance * c) ? 5.0F * c : 10.0F * c;
    if (robot.table().message(k).role == Role::worker) range_m += c;  // rather somebody who goes nowhere
    rank = range_m <= p.first_edge * c ? 0 : range_m <= p.recruitment_distance_m ? 1 : 2;
    key = rank < 2 ? static_cast<float>(robot.table().message(k).label_cm) : range_m;
  }
};

bool Convoy::prefers(const Robot& robot, int a, int b) const noexcept {
  const Preference pa(robot, a);
  const Preference pb(robot, b);
  return pa.rank != pb.rank ? pa.rank < pb.rank : pa.key < pb.key;
}

// Not passed on upwards: towed, the chain brings its slack to where the spares are by itself.
bool Convoy::needs_spare(const Robot& robot) const noexcept {
  if (robot.parent < 0) return false;
  const float d = robot.table().range(robot.parent);
  const bool hidden = robot.table().age(robot.parent) > std::max(silence_ticks, usual_silence_ticks(robot));
  // A connector may have been made a worker: then it is the parent that has to go on.
  const Standing& parent = robot.table().message(robot.parent);
  const bool wanted = robot.self.want_m > 0.0F || is_held_back(robot) || (parent.role == Role::worker && parent.want_cm > 0);
  return (d > robot.params.recruitment_distance_m && wanted) ||
         ((hidden || robot.self.pinned) && d > robot.params.shortest_split * robot.params.communication_range_m);
}

bool Convoy::may_insert(const Robot& robot, int owner, int parent) const noexcept {
  const Params& p = robot.params;
  const Neighborhood& table = robot.table();
  const float reach_m = p.ideal_distance_m - p.join_margin * p.communication_range_m;
  const float clearance_m = p.clearance * p.communication_range_m;
  if (table.range(owner) >= reach_m || table.range(parent) >= reach_m) return false;
  const bool in_the_way = norm(nearest_on_segment(table.position(owner), table.position(parent))) < clearance_m;
  const float room_m = in_the_way ? tight * clearance_m : clearance_m;
  return sees_clearly(robot, owner, room_m) && sees_clearly(robot, parent, room_m);
}

}  // namespace

const Policy& convoy() noexcept {
  static constexpr Convoy policy;
  return policy;
}

}  // namespace banyan
