// SPDX-License-Identifier: MIT
#include "banyan/controller/inwards.hpp"

#include "banyan/controller/healing/healing.hpp"
#include "banyan/controller/healing/hold.hpp"
#include "banyan/controller/healing/link_guard.hpp"
#include "banyan/controller/healing/tick.hpp"
#include "banyan/controller/tree/census.hpp"
#include "banyan/controller/tree/epoch.hpp"
#include "banyan/controller/tree/label.hpp"
#include "banyan/controller/tree/motion.hpp"
#include "banyan/controller/tree/parent_selection.hpp"
#include "banyan/controller/tree/root_selection.hpp"
#include "banyan/controller/tree/spare_management.hpp"
#include "banyan/controller/tree/tree_index.hpp"

namespace banyan {
namespace {

bool may_join_inwards(const TreeRobot& robot) noexcept { return robot.self.is_worker || is_named_parent(robot); }

bool all_workers_counted(const TreeRobot& robot) noexcept { return robot.self.subtree_workers >= robot.self.flood_workers; }

// SELECT PARENT: the candidate with the smallest distance to the root; corrected: within S if there is one.
void select_inner_parent(TreeRobot& robot) noexcept {
  const TreeTable& table = robot.table();
  const auto is_safe = [&](int k) { return robot.reading.prefers_safe_parent && table.range(k) <= robot.params.safe_range_m; };
  select_parent(robot, {.may_join = may_join_inwards(robot),
                        .workers_relay = false,
                        .accepts = [](int) { return true; },
                        .prefers = [&](int a, int b) {
                          return is_safe(a) != is_safe(b) ? is_safe(a) : table.message(a).label_cm < table.message(b).label_cm;
                        }});
}

}  // namespace

HealingParams inwards_defaults() noexcept {
  HealingParams p;
  p.safe_range_m = 1.3525581F;
  p.avoidance_range_m = 0.4099F;
  p.ideal_distance_m = 1.540841F;
  p.interaction_gain = 10.0F;
  p.target_gain = 0.2539F;
  p.reconfiguration_period_s = 44.0F;
  p.liveness_period_s = 0.5F;
  p.recruitment_distance_m = 1.321353F;
  p.insertion_distance_m = 0.066395F;
  return p;
}

Output<TreeMessage> inwards_literal_step(const TreeParams& params, TreeState& state, const Inputs<Heard>& inputs) noexcept {
  TreeRobot robot(params, literal_reading, state, inputs);
  begin_tick(robot, inputs);
  listen(robot);                                       // the largest epoch, phase and root token heard
  accept_offer(robot);                                 // Select Root, the heir's side
  index_neighbors(robot);                              // who are my parent and children
  update_role(robot);
  advance(robot, all_workers_counted(robot));                // the root's barriers
  update_label(robot);                                 // Start Tree
  select_inner_parent(robot);                          // Select Parent, repair
  take_census(robot, params.arrival_distance_m);       // Alg. 1 and 2
  select_root(robot, [](int) { return true; });        // Select Root, the root's side
  manage_spares(robot, {.needs_spare = [&] { return is_stretched(robot) || child_in_need(robot); },   // Grow Tree
                        .may_call = [] { return false; },
                        .count_waiting = [&](bool unserved) { count_unserved(robot, unserved); },
                        .may_insert = [&](int owner, int parent) { return is_at_midpoint(robot, owner, parent); }});
  const Vec2 u = state.role == Role::spare ? attendance_motion(robot) : spring_motion(robot);

  Output<TreeMessage> output;
  write_tree(robot, output.message);
  output.velocity = move(u, Guard{}, params);
  return output;
}

Output<HealingMessage> inwards_step(const HealingParams& params, HealingState& state, const Inputs<Heard>& inputs) noexcept {
  HealingRobot robot(params, state, inputs);
  begin_tick(robot, inputs);
  estimate_loss(robot);                                // how long neighbours may be silent
  listen_among_fragments(robot);
  accept_offered_root(robot);                          // Select Root, the heir's side
  follow_heartbeat(robot);                             // is there a root at all,
  claim_root(robot);                                   // and if not, should I become it?
  watch_tasks(robot);                                  // does every target have its worker?
  index_neighbors(robot);
  watch_branch(robot);                                 // has the last robot below me died?
  update_role(robot);
  advance_and_count(robot, all_workers_counted(robot));      // the root's barriers
  update_label(robot);                                 // Start Tree
  select_inner_parent(robot);                          // Select Parent, repair
  take_census(robot, params.arrival_distance_m, own_want_m(robot));
  select_root(robot, [](int) { return true; });        // Select Root, the root's side
  find_hold(robot);                                    // what ties me to the others while I have no parent
  manage_spares(robot, {.needs_spare = [&] { return is_stretched(robot) || child_in_need(robot); },   // Grow Tree
                        .may_call = [] { return true; },
                        .count_waiting = [&](bool unserved) { count_waiting(robot, unserved, false); },
                        .may_insert = [&](int owner, int parent) { return is_at_midpoint(robot, owner, parent); }});
  const bool retreats = is_retreating(robot, false);
  const Vec2 u = retreats ? retreat_motion(robot, false, false) : state.role == Role::spare ? attendance_motion(robot) : spring_motion(robot);
  Guard guard;
  guard_edges(robot, retreats, guard);
  guard_links(robot, retreats, guard);
  keep_off(robot, guard);                              // obstacles

  Output<HealingMessage> output;
  write_healing(robot, output.message);
  const Vec2 v = allowed(u, guard, params);
  watch_progress(robot, retreats, v);                  // does the worker make progress?
  output.velocity = drive(v, guard, params);
  return output;
}

}  // namespace banyan
