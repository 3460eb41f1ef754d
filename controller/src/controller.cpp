// SPDX-License-Identifier: MIT
#include "banyan/controller/controller.hpp"

#include <algorithm>

#include "banyan/controller/bypass.hpp"
#include "banyan/controller/census.hpp"
#include "banyan/controller/edge_frame.hpp"
#include "banyan/controller/epoch.hpp"
#include "banyan/controller/healing.hpp"
#include "banyan/controller/label.hpp"
#include "banyan/controller/motion.hpp"
#include "banyan/controller/parent_selection.hpp"
#include "banyan/controller/policy.hpp"
#include "banyan/controller/root_selection.hpp"
#include "banyan/controller/spare_management.hpp"
#include "banyan/controller/survey.hpp"

namespace banyan {
namespace {

// Whoever is drawn back on the way round would never get as near to the goal as it was, and circle for
// ever: what it has to reach to be round grows with the way that it drives.
void carry_detour(Detour& detour, const Carry& carry) noexcept {
  constexpr float modesty = 0.25F;
  for (Vec2* v : {&detour.contact, &detour.origin, &detour.goal}) *v = carry.point(*v);
  detour.leave_m += modesty * norm(carry.shift);
}

// What is remembered as a vector moves with the robot's own frame.
void carry_memory(State& self, const Carry& carry) noexcept {
  if (self.centroid_known) self.centroid = carry.point(self.centroid);
  self.root_at = carry.point(self.root_at);
  self.stub = carry.point(self.stub);
  for (int k = 0; k < self.task_count; ++k) self.tasks[k].target = carry.point(self.tasks[k].target);
  ++self.turn;
  if (self.detour.side != 0) carry_detour(self.detour, carry);
  self.seen_from = carry.point(self.seen_from);
  for (int k = 0; k < self.landmarks.size; ++k) {
    Vec2& point = self.landmarks.points[static_cast<std::size_t>(k)];
    point = carry.point(point);
  }
}

Message compose(const Robot& robot) noexcept {
  const State& self = robot.self;
  Message m;
  m.id = self.id;
  m.role = self.role;
  m.phase = self.phase;
  m.need = self.need;
  m.serves = self.serves;
  m.flood_done = self.flood_done;
  m.committed = self.committed;
  m.pinned = self.pinned;
  m.parent_silent = self.parent != nobody && !robot.parent_alive();
  m.epoch = self.epoch;
  m.root = self.root;
  m.root_size = self.root_size;
  m.label_cm = self.label_cm;
  m.pulse = self.pulse;
  m.depth = self.depth;
  m.tree_hops = self.tree_hops;
  m.parent = self.parent;
  m.old_parent = self.old_parent;
  m.flood_parent = self.flood_parent;
  m.flood_robots = self.flood_robots;
  m.flood_workers = self.flood_workers;
  m.subtree = self.subtree;
  m.subtree_workers = self.subtree_workers;
  m.count = self.count;
  m.grant = self.grant;
  m.request = self.request;
  m.inserted_child = self.inserted_child;
  m.warned = self.warned;
  m.call_hops = self.call_hops;
  m.child_count = robot.useful_children;
  m.above = self.above;
  m.below = self.below;
  m.want_cm = to_fixed<std::uint16_t>(self.want_m, per_cm);
  const int up = self.parent != nobody ? robot.parent : robot.old_parent;
  if (up >= 0) {
    const Vec2 addressee = robot.table().position(up);
    const Vec2 pull = to_edge_frame(self.pull, addressee);
    m.q = to_edge_frame(self.q, addressee);
    m.pull_x = to_fixed<std::int16_t>(pull.x, pull_unit);
    m.pull_y = to_fixed<std::int16_t>(pull.y, pull_unit);
    Vec2 hinge;
    if (find_hinge(robot, hinge)) {
      hinge = to_edge_frame(hinge - addressee, addressee);
      m.hinge_x_cm = to_fixed<std::int16_t>(hinge.x, per_cm);
      m.hinge_y_cm = to_fixed<std::int16_t>(hinge.y, per_cm);
    }
  }
  const int heir = self.new_root == nobody ? -1 : robot.table().find(self.new_root);
  if (heir >= 0) {
    const Vec2 addressee = robot.table().position(heir);
    const Vec2 centroid = to_edge_frame(self.centroid - addressee, addressee);
    m.new_root = self.new_root;
    m.centroid_x_cm = to_fixed<std::int16_t>(centroid.x, per_cm);
    m.centroid_y_cm = to_fixed<std::int16_t>(centroid.y, per_cm);
  }
  tell(robot, m);
  return m;
}

}  // namespace

State initial_state(RobotId id, bool worker, bool root) noexcept {
  State state;
  state.id = id;
  state.is_worker = worker;
  state.role = root ? Role::root : worker ? Role::worker : Role::spare;
  if (worker) state.serves = id;
  if (root) state.root = {1, id};
  return state;
}

Output step(const Params& params, const Policy& policy, State& state, std::span<const Heard> heard,
            const Odometry& odometry, const Vec2* target, std::span<const Vec2> obstacles) noexcept {
  Robot robot(params, policy, state, heard, target, obstacles);
  const Carry carry(odometry);
  carry_memory(state, carry);
  state.neighbors.update(heard, carry, robot.liveness_ticks(), state.id, {state.parent, state.old_parent});

  estimate_loss(robot);   // how long neighbours may be silent
  listen(robot);          // the largest epoch, phase and root token heard
  accept_offer(robot);    // Select Root, the heir's side
  follow_heartbeat(robot);  // is there a root at all,
  claim_root(robot);        // and if not, am I the one to be it?
  mind_tasks(robot);        // does every target have its worker?
  survey(robot);          // who are my parent and children
  remember_obstacles(robot);
  mind_stub(robot);       // has the last below me died?
  update_role(robot);
  advance(robot);         // the root's barriers
  update_label(robot);    // Start Tree
  select_parent(robot);   // Select Parent, repair
  policy.tend_tree(robot);  // shortcuts that a policy takes meanwhile
  take_census(robot);     // Alg. 1 and 2
  select_root(robot);     // Select Root, the root's side
  manage_spares(robot);   // Grow Tree
  const Velocity velocity = move(robot);
  return {compose(robot), velocity};
}

}  // namespace banyan
