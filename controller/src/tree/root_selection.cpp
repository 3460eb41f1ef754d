// SPDX-License-Identifier: MIT
#include "tree/root_selection.hpp"

#include <algorithm>

#include "banyan/controller/core/edge_frame.hpp"
#include "banyan/controller/core/search.hpp"
#include "tree/epoch.hpp"

namespace banyan {
namespace {

// A neighbour heard in this tick, not a worker, nearer to the centroid than the root by a margin. The two will have
// an edge (hand_over), so it must not be about to leave. A root that has to go takes the nearest.
int better_root(const TreeRobot& robot, FunctionRef<bool(int)> may_inherit, bool leaves) noexcept {
  const TreeState& self = robot.self;
  const TreeTable& table = robot.table();
  const Vec2 place = leaves ? Vec2{} : self.centroid;
  const float limit = leaves ? longest_link : norm(place) - robot.params.centroid_margin;
  return least_of(table.size(), limit, [&](int k) {
    const TreeStanding& m = table.message(k);
    const bool may = table.age(k) == 0 && m.role != Role::worker && m.epoch == self.epoch &&
                     table.range(k) <= longest_link && may_inherit(k);
    return may ? distance(table.position(k), place) : limit;
  });
}

}  // namespace

// The successor's gossip is the acknowledgement. The edge to it connects all robots below me to the new root: until
// they have parents of the new epoch, they know no other way.
void hand_over(TreeRobot& robot, Serial held) noexcept {
  TreeState& self = robot.self;
  // The heir has taken the token, and may have passed it on already; or a rival has one of the same number.
  const bool taken = self.new_root != nobody && (self.root.id == self.new_root || self.root.sequence != advanced(held));
  const int heir = taken ? robot.table().find(self.new_root) : -1;
  if (heir >= 0 && self.parent == nobody) robot.set_old_parent(heir);
  self.new_root = nobody;
}

const TreeMessage* accept_offer(TreeRobot& robot) noexcept {
  TreeState& self = robot.self;
  const TreeMessage* accepted = nullptr;
  if (self.is_worker) return accepted;
  for (const Heard& h : robot.news_of_tree()) {
    const TreeMessage& m = *h.message;
    if (m.new_root != self.id || m.root.id != m.id) continue;
    const RootToken offered{advanced(m.root.sequence), self.id};
    if (!newer(offered, self.root)) continue;
    self.root = offered;
    accepted = &m;
    self.centroid = from_edge_frame({m.centroid_x.value(), m.centroid_y.value()}, h.position);
    self.centroid_known = true;
    self.new_root = nobody;
    robot.retire_parent();  // their edge stays an edge of the tree until GROW TREE (protocol 8)
    ++self.tally.handovers;
  }
  return accepted;
}

void select_root(TreeRobot& robot, FunctionRef<bool(int)> may_inherit, bool leaves) noexcept {
  TreeState& self = robot.self;
  if (!robot.is_root()) {
    self.new_root = nobody;
    return;
  }
  if (self.phase != Phase::select_root) return;
  if (!self.centroid_known) self.centroid = self.q;
  if (robot.is_station) self.centroid = {};  // no robot is nearer to it
  self.centroid_known = true;
  if (self.new_root != nobody) {
    robot.add_elapsed(self.offer_ticks);
    if (self.offer_ticks <= std::max(whole(robot.params.handover_rounds), robot.liveness_ticks())) return;
    self.root.sequence = advanced(self.root.sequence, 2);  // beats an acceptance not heard
    self.new_root = nobody;
    return enter(robot, advanced(self.epoch), Phase::start_tree);
  }
  const int k = better_root(robot, may_inherit, leaves);
  if (k < 0) return enter(robot, advanced(self.epoch), Phase::start_tree);
  self.new_root = robot.table().id(k);
  self.offer_ticks = 0;
}

}  // namespace banyan
