// SPDX-License-Identifier: MIT
#include "banyan/controller/paper.hpp"

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

Output<TreeMessage> literal_step(const Growth& growth, const TreeParams& params, TreeState& state,
                                 const Inputs<Heard>& inputs) noexcept {
  Workspace space(inputs);
  TreeRobot robot(params, literal_reading, state, inputs, space);
  begin_tick(robot, inputs);
  listen(robot);           // the largest epoch, phase and root token heard
  accept_offer(robot);     // Select Root, the heir's side
  index_neighbors(robot);  // who are my parent and children
  update_role(robot);
  advance(robot, growth.all_counted(robot));      // the root's barriers
  update_label(robot);                            // Start Tree
  growth.select_parent(robot);                    // Select Parent, repair
  take_census(robot, params.arrival_distance);  // Alg. 1 and 2
  select_root(robot, [](int) { return true; });   // Select Root, the root's side
  manage_spares(robot, {.needs_spare = [&] { return is_stretched(robot) || child_in_need(robot); },  // Grow Tree
                        .may_call = [] { return false; },
                        .count_waiting = [&](bool unserved) { count_unserved(robot, unserved); },
                        .may_insert = [&](int owner, int parent) { return is_at_midpoint(robot, owner, parent); }});
  const Vec2 u = state.role == Role::spare ? attendance_motion(robot) : spring_motion(robot);

  Output<TreeMessage> output;
  write_tree(robot, output.message);
  Guard none;
  output.motion = drive(allowed(u, none, params), none, params);
  return output;
}

Output<HealingMessage> corrected_step(const Growth& growth, const HealingParams& params, HealingState& state,
                                      const Inputs<Heard>& inputs) noexcept {
  Workspace space(inputs);
  HealingRobot robot(params, state, inputs, space);
  begin_tick(robot, inputs);
  estimate_loss(robot);  // how long neighbours may be silent
  listen_among_fragments(robot);
  accept_offered_root(robot);  // Select Root, the heir's side
  follow_heartbeat(robot);     // is there a root at all,
  claim_root(robot);           // and if not, should I become it?
  watch_tasks(robot);          // does every target have its worker?
  index_neighbors(robot);
  watch_branch(robot);  // has the last robot below me died?
  update_role(robot);
  advance_and_count(robot, growth.all_counted(robot));  // the root's barriers
  update_label(robot);                                  // Start Tree
  growth.select_parent(robot);                          // Select Parent, repair
  take_census(robot, params.arrival_distance, own_want(robot));
  select_root(robot, [](int) { return true; });  // Select Root, the root's side
  find_hold(robot);                              // what ties me to the others while I have no parent
  manage_spares(robot, {.needs_spare = [&] { return is_stretched(robot) || child_in_need(robot); },  // Grow Tree
                        .may_call = [] { return true; },
                        .count_waiting = [&](bool unserved) { count_waiting(robot, unserved, false); },
                        .may_insert = [&](int owner, int parent) { return is_at_midpoint(robot, owner, parent); }});
  const bool retreats = is_retreating(robot, false);
  const Vec2 u = retreats                    ? retreat_motion(robot, false, false)
                 : state.role == Role::spare ? attendance_motion(robot)
                                             : spring_motion(robot);
  Guard guard;
  guard_edges(robot, retreats, guard);
  guard_links(robot, retreats, guard);
  keep_off(robot, guard);  // obstacles

  Output<HealingMessage> output;
  write_healing(robot, output.message);
  const Vec2 v = allowed(u, guard, params);
  watch_progress(robot, retreats, v);  // does the worker make progress?
  output.motion = drive(v, guard, params);
  return output;
}

}  // namespace banyan
