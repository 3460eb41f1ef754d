// SPDX-License-Identifier: MIT
// "The current root compares its position and the position of its neighbors to the centroid estimate [...]. If the
// current root is the closest to the centroid, it remains the root and restarts a new tree loop. Otherwise, it
// designates a new root and sends the centroid vector and the angle to the new root. When the new root receives this
// message, it sends an acknowledgement message to the old root, and then it expresses the centroid in its own reference
// frame. The process is repeated until the root is the closest robot to the centroid estimate." (paper Sec. III-C)
#include "banyan/controller/core/edge_frame.hpp"
#include "banyan/controller/paper/rules.hpp"

namespace banyan::paper {
namespace {

// "compares its position and the position of its neighbors to the centroid estimate": closer by a margin, so that the
// token does not go to and fro; no worker. The two will have an edge (row t), so it must not be about to leave.
int closest_to_centroid(const Robot& robot) noexcept {
  constexpr float margin = 0.025F;  // C
  const float reach = robot.reading.keeps_links ? 0.95F : 1.0F;
  const State& self = robot.self;
  const float limit = norm(self.centroid) - margin;
  return least_of(robot.size(), limit, [&](int k) {
    const Message& m = robot.said(k);
    const bool may = robot.heard_now(k) && m.role != Role::worker && m.epoch == self.epoch && robot.range(k) <= reach;
    return may ? distance(robot.position(k), self.centroid) : limit;
  });
}

}  // namespace

// "sends an acknowledgement message to the old root, and then it expresses the centroid in its own reference frame":
// the new root's side. That all robots hear of its token is the acknowledgement.
void accept_offer(Robot& robot) noexcept {
  State& self = robot.self;
  for (int k = 0; k < robot.size(); ++k) {
    const Message& m = robot.said(k);
    const RootToken offered{advanced(m.root.sequence), self.id};
    if (!robot.heard_now(k) || m.new_root != self.id || m.root.id != m.id) continue;
    if (self.is_worker || !newer(offered, self.root)) continue;
    self.root = offered;
    self.centroid = from_edge_frame({m.centroid_x.value(), m.centroid_y.value()}, robot.position(k));
    self.centroid_known = true;
    self.new_root = nobody;
    if (self.parent != nobody) robot.set_old_parent(self.parent);  // an edge of the tree until GROW TREE
    robot.set_parent(nobody);
    ++self.tally.handovers;
  }
}

// The edge to the new root connects all robots below the old one to it: until they have parents of the new epoch, they
// know no other way (row t). The new root may have passed its token on already.
void end_offer(Robot& robot, Serial held) noexcept {
  State& self = robot.self;
  const bool taken = self.new_root != nobody && (self.root.id == self.new_root || self.root.sequence != advanced(held));
  if (robot.reading.keeps_links && taken && self.parent == nobody && robot.find(self.new_root) >= 0)
    robot.set_old_parent(self.new_root);
  self.new_root = nobody;
}

// "If the current root is the closest to the centroid, it remains the root and restarts a new tree loop. Otherwise, it
// designates a new root"
void select_root(Robot& robot) noexcept {
  constexpr int handover_ticks = 20;  // an offer that nobody has acknowledged by then is taken back
  State& self = robot.self;
  if (!robot.is_root() || self.phase != Phase::select_root) return;
  if (!self.centroid_known) self.centroid = self.q;
  if (robot.is_station) self.centroid = {};  // no robot is nearer to it
  self.centroid_known = true;
  if (self.new_root != nobody) {
    robot.add_elapsed(self.offer_ticks);
    if (self.offer_ticks <= std::max(handover_ticks, whole(robot.params.liveness_rounds))) return;
    self.root.sequence = advanced(self.root.sequence, 2);  // beats an acceptance that was not heard
  } else if (const int k = closest_to_centroid(robot); k >= 0) {
    self.new_root = robot.said(k).id;
    self.offer_ticks = 0;
    return;
  }
  enter(robot, advanced(self.epoch), Phase::start_tree);
}

}  // namespace banyan::paper
