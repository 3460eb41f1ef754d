// SPDX-License-Identifier: MIT
#include "banyan/controller/convoy/convoy.hpp"

#include <algorithm>

#include "banyan/controller/core/edge_frame.hpp"
#include "convoy/companions.hpp"
#include "convoy/folding.hpp"
#include "convoy/handing_on.hpp"
#include "convoy/plan.hpp"
#include "convoy/shortcut.hpp"
#include "convoy/towing.hpp"
#include "healing/healing.hpp"
#include "healing/hold.hpp"
#include "healing/link_guard.hpp"
#include "healing/tick.hpp"
#include "healing/tie.hpp"
#include "tree/census.hpp"
#include "tree/label.hpp"
#include "tree/motion.hpp"
#include "tree/parent_selection.hpp"
#include "tree/root_selection.hpp"
#include "tree/spare_management.hpp"
#include "tree/tree_index.hpp"

namespace banyan {
namespace {

constexpr int silence_ticks = 2;      // a parent silent for so long counts as hidden
constexpr float asks_sooner = 2.0F;   // times the spread of ranges: so much earlier an edge asks for spares and calls
constexpr float tight = 0.6F;         // of `clearance`: enough for a spare in the way, since joining the edge clears it
constexpr float rests_within = 0.4F;  // of the tolerance: a worker so near to its target need not come nearer
constexpr float late = 2.0F;          // times `call_after_rounds`: until then an edge that is towed late may shorten

// ---- Select Parent: branches grow from the workers, as in inwards, by short edges in sight ----

// An edge of the last tree, in either direction.
bool was_edge(const ConvoyRobot& robot, int k) noexcept {
  return k == robot.old_parent || robot.table().message(k).old_parent == robot.self.id;
}

// On batteries: it is about to be charged, or on its way, and would have to be relieved at once.
bool is_drained_spare(const ConvoyRobot& robot, int k) noexcept {
  return robot.power != nullptr && robot.table().message(k).role == Role::spare && !is_charged(*robot.power, k);
}

// Once all workers below have arrived, the tree keeps its edges, also to a robot that has to leave: it is relieved
// where it stands. Otherwise short first edges come first, then edges that need no spare, then the nearest. A link that
// may soon be blocked counts as a long one, one worse as longer yet.
struct Preference {
  // Of C, and no edge is longer: one of these outweighs any difference of lengths.
  static constexpr float costs_leaving = 4.0F;
  static constexpr float costs_risk = 5.0F;      // to be hidden soon
  static constexpr float costs_drained = 8.0F;   // has too little charge
  static constexpr float costs_blocked = 10.0F;  // a robot stands in the way
  int rank;
  float key;
  Preference(const ConvoyRobot& robot, int k) noexcept {
    const ConvoyParams& p = robot.params;
    if (prunes(p) && robot.self.want == 0.0F && was_edge(robot, k)) {
      rank = -1;
      key = static_cast<float>(robot.table().message(k).label);
      return;
    }
    float range = robot.table().range(k);
    if (!sees_clearly(robot, k, p.clearance))
      range += sees_clearly(robot, k, narrow * p.clearance) ? costs_risk : costs_blocked;
    if (is_leaving(robot, k)) range += costs_leaving;
    if (is_drained_spare(robot, k)) range += costs_drained;
    if (robot.table().message(k).role == Role::worker) range += 1.0F;  // rather a robot that is not leaving
    rank = range <= p.first_edge ? 0 : range <= p.recruitment_distance ? 1 : 2;
    key = rank < 2 ? static_cast<float>(robot.table().message(k).label) : range;
  }
};

bool is_better_parent(const ConvoyRobot& robot, int a, int b) noexcept {
  const Preference pa(robot, a);
  const Preference pb(robot, b);
  return pa.rank != pb.rank ? pa.rank < pb.rank : pa.key < pb.key;
}

// ---- Grow Tree: which edges get a spare, and when ----

// My parent is a worker, which cannot be towed, and my target is out of reach from where it goes.
bool is_anchored(const ConvoyRobot& robot) noexcept {
  if (robot.table().message(robot.parent).role != Role::worker || robot.self.want == 0.0F) return false;
  if (robot.target != nullptr) return !reaches_target_from(robot, robot.parent);
  return stands_at_target(robot, robot.parent) &&
         robot.self.want > robot.params.ideal_distance - robot.table().range(robot.parent);
}

// The root and junctions are towed late (towing.cpp), so their edges may stay just short of call_distance and slow.
bool is_held_by_junction(const ConvoyRobot& robot) noexcept {
  const ConvoyParams& p = robot.params;
  const bool junction =
      robot.table().message(robot.parent).role == Role::root || robot.convoy_of(robot.parent).child_count > 1;
  return junction && robot.table().range(robot.parent) > p.recruitment_distance &&
         robot.self.unserved_ticks > whole(late * p.call_after_rounds);
}

// On batteries: my edge wants a spare that takes my place, or one that gives slack to a relief.
bool asks_for_relief(const ConvoyRobot& robot) noexcept {
  return robot.power != nullptr && (wants_relief(*robot.power) || is_stuck(*robot.power));
}

float asks_from(const ConvoyRobot& robot) noexcept {
  return robot.is_station ? station_asks_from : robot.params.recruitment_distance;
}

// The need is not passed up the tree: a chain that is towed brings its slack to where the spares are by itself.
bool needs_spare(const ConvoyRobot& robot) noexcept {
  if (robot.parent < 0) return false;
  if (asks_for_relief(robot) || wants_fold(robot)) return true;
  const float d = robot.table().range(robot.parent);
  const bool hidden = robot.table().age(robot.parent) > std::max(silence_ticks, usual_silence_ticks(robot));
  // A connector may have been made a worker: then it is the parent that has to go on.
  const TreeStanding& parent = robot.table().message(robot.parent);
  const bool wanted = robot.self.want > 0.0F || is_held_back(robot) || (parent.role == Role::worker && parent.want > 0);
  return (d > asks_from(robot) - asks_sooner * robot.table().spread() && wanted) ||
         ((hidden || robot.self.corners.pinned || is_anchored(robot)) && d > robot.params.shortest_split);
}

// Only when the edge is about to hold the workers back; among obstacles sooner, since spares are slow there.
bool may_call(const ConvoyRobot& robot) noexcept {
  if (asks_for_relief(robot)) return true;
  if (is_planned(robot.self)) return false;  // spares would come along the chains and be in the way
  const ConvoyParams& p = robot.params;
  const bool early = robot.self.corners.landmarks.size > 0 || robot.is_station;
  const float from = early ? asks_from(robot) : p.call_distance;
  if (robot.parent < 0) return false;
  if (wants_fold(robot) && robot.table().age(robot.parent) <= silence_ticks) return false;  // keep_company() does
  return robot.self.corners.pinned || is_anchored(robot) || is_held_by_junction(robot) ||
         robot.table().range(robot.parent) > from - asks_sooner * robot.table().spread();
}

bool may_insert(const ConvoyRobot& robot, int owner, int parent) noexcept {
  const ConvoyParams& p = robot.params;
  const TreeTable& table = robot.table();
  const float reach = p.ideal_distance - p.join_margin;
  const float clearance = p.clearance;
  if (is_leaving(robot, owner))
    return may_relieve(*robot.power, owner, parent, [&](int k) { return sees_clearly(robot, k, tight * clearance); });
  if (table.range(owner) >= reach || table.range(parent) >= reach || !robot.is_sure(parent) ||
      robot.may_be_deaf(parent) || is_off_middle(robot, owner, parent))
    return false;
  const bool in_the_way = distance_to_segment(Vec2{}, table.position(owner), table.position(parent)) < clearance;
  const float room = in_the_way ? tight * clearance : clearance;
  return sees_clearly(robot, owner, room) && sees_clearly(robot, parent, room);
}

// Not while the workers make progress: the tree is repaired meanwhile, and a new one has its cost. And later while
// spares are on their way to an edge, which they would lose.
bool may_reconstruct(const ConvoyRobot& robot) noexcept {
  if (!robot.is_root()) return false;
  if (is_leaving(robot) && !is_planned(robot.self)) return true;
  // Companions would have to change places. While branches change their parents, a root may have no worker for a tick.
  if (has_companions(robot.params) && (has_arrived(robot) || has_settled(robot))) return false;
  constexpr float patience_drives = 0.5F;         // without progress,
  constexpr float called_patience_drives = 1.5F;  // and while an edge calls
  const bool called = robot.self.call_hops != nobody_calls;
  const bool begun = is_planned(robot.self) || robot.self.plan_steps < robot.self.plan_levels;
  return robot.self.stalled_ticks > robot.params.rounds(called ? called_patience_drives : patience_drives) && !begun;
}

// Once all workers have arrived, a spare that became root would be one more robot in the tree.
bool may_inherit(const ConvoyRobot& robot, int k) noexcept {
  if (robot.power != nullptr && !may_inherit_root(*robot.power, k)) return false;
  if (is_leaving(robot)) return true;
  return !prunes(robot.params) || robot.self.want > 0.0F || robot.table().message(k).role != Role::spare;
}

// ---- The start and the end of a tick ----

void carry_memory(ConvoyState& self, const Carry& carry) noexcept {
  carry_memory(static_cast<HealingState&>(self), carry);
  carry_corners(self.corners, carry);
}

void write_convoy(const ConvoyRobot& robot, ConvoyMessage& m) noexcept {
  const ConvoyState& self = robot.self;
  const int spoken_of = write_healing(robot, m);
  if (spoken_of >= 0) m.task_host = self.hosts[static_cast<std::size_t>(spoken_of)];
  m.pinned = self.corners.pinned;
  m.warned = self.warned;
  m.child_count = robot.useful_children;
  m.above = self.above;
  m.below = self.role == Role::spare ? self.accompanies : self.below;
  if (robot.up() < 0) return;
  const Vec2 parent = robot.table().position(robot.up());
  if (Vec2 pull; passes_pull_on(robot, pull)) write_in_edge_frame(pull, parent, pull_unit, m.pull_x, m.pull_y);
  if (Vec2 hinge; find_hinge(robot, self.corners, hinge))
    write_in_edge_frame(hinge - parent, parent, m.hinge_x, m.hinge_y);
}

}  // namespace

// What a robot may have on a chip, with and without batteries (docs/limits.md).
static constexpr std::size_t most_state_bytes = 9728;
static_assert(sizeof(ConvoyState) <= most_state_bytes);
static_assert(sizeof(PoweredConvoyState) <= most_state_bytes);

ConvoyParams convoy_defaults() noexcept {
  ConvoyParams p;
  p.ideal_distance = 0.95F;         // G: no edge outgrows it
  p.safe_range = 0.90F;             // the root and junctions are towed only beyond it
  p.recruitment_distance = 0.825F;  // a longer edge asks for a spare
  p.avoidance_range = 0.18F;
  p.target_gain = 1.0F;
  p.reconfiguration_drives = 4.4F;
  p.liveness_rounds = 5.0F;
  p.guard_rate = 20.0F;
  p.connector_rounds = 10.0F;
  return p;
}

// A robot beside another reaches as far as that one only if edges have some slack. And chains from target to target
// would make the ways to a charging place longer.
ConvoyParams with_room_for_relief(ConvoyParams params) noexcept {
  params.merge_distance = std::min(params.merge_distance, params.relief_edge);
  params.compact_distance = std::min(params.compact_distance, params.relief_edge);
  params.thrift = 0.0F;  // it would stretch them again
  params.plan_after_drives = 0.0F;
  return params;
}

ConvoyState initial_convoy_state(RobotId id, bool worker, bool root) noexcept {
  return begun<ConvoyState>(id, worker, root);
}

PoweredConvoyState initial_powered_state(RobotId id, bool worker, bool root) noexcept {
  return begun<PoweredConvoyState>(id, worker, root);
}

void begin_tick(ConvoyRobot& robot, const Inputs<Heard>& inputs) noexcept {
  carry_memory(robot.self, robot.carry);
  ConvoyState& self = robot.self;
  file_heard(robot);
  const KnownOfHealing known(self, robot.elapsed_ticks);
  for (Heard& h : robot.heard) {
    const ConvoyMessage& m = convoy_message(*h.message);
    push_news(robot, known, h);
    if (h.place < 0) continue;
    const auto k = static_cast<std::size_t>(h.place);
    self.healing_standings[k] = static_cast<const HealingStanding&>(m);
    if (!names_another(robot, h)) note_hears(robot, h);
    self.corners.standings[k] = static_cast<const CornerStanding&>(m);
    self.convoy_standings[k] = static_cast<const ConvoyStanding&>(m);
    if (robot.power != nullptr) robot.power->power.standings[k] = static_cast<const PowerStanding&>(powered_message(m));
  }
  forget_silent(
      robot, [&](int k) { return may_be_tied(robot, k) || stands_in_for(robot, k); },
      [&](int k, int size) {
        close_gap(self.healing_standings, k, size);
        close_gap(self.corners.standings, k, size);
        close_gap(self.convoy_standings, k, size);
        if (robot.power != nullptr) close_gap(robot.power->power.standings, k, size);
      });
  follow_orders(robot, inputs.orders());
}

// One tick of one robot, with a battery or without. Returns what the motors are to do.
static Motion tick(ConvoyRobot& robot, const Inputs<Heard>& inputs, ConvoyMessage& message) noexcept {
  const ConvoyParams& params = robot.params;
  ConvoyState& state = robot.self;
  begin_tick(robot, inputs);
  if (robot.power != nullptr) hand_over_target(*robot.power);
  estimate_loss(robot);           // how long neighbours may be silent
  listen_among_fragments(robot);  // the largest epoch, phase and root token heard
  accept_offered_root(robot);     // Select Root, the heir's side
  follow_heartbeat(robot);        // is there a root at all,
  claim_root(robot);              // and if not, should I become it?
  watch_tasks(robot);             // does every target have its worker?
  index_neighbors(robot);         // who are my parent and children
  remember_corners(robot, state.corners);
  watch_branch(robot);  // has the last robot below me died?
  update_role(robot);
  advance_and_count(robot, state.subtree_workers >= state.flood_workers,
                    may_reconstruct(robot));                                    // the root's barriers
  update_label(robot);                                                          // Start Tree
  select_parent(robot, {.may_join = state.is_worker || is_named_parent(robot),  // Select Parent, repair
                        .prefers = [&](int a, int b) { return is_better_parent(robot, a, b); }});
  if (robot.power != nullptr) {
    watch_charge(*robot.power, inputs.charge(), inputs.orders());  // must I be relieved?
    watch_relief(*robot.power);                                    // whom do I relieve?
  }
  heed_live_calls(robot);    // for a second path
  take_part_in_plan(robot);  // chains from target to target
  take_shortcuts(robot);     // what changes between reconstructions
  state.corners.pinned = is_pinned(robot, state.corners, params.pull_start);
  // A worker lags behind a moving target: the tree must follow before the worker is out of tolerance.
  take_census(robot, rests_within * params.arrival_distance, own_want(robot));  // Alg. 1 and 2
  select_root(
      robot, [&](int k) { return may_inherit(robot, k); }, is_leaving(robot));  // Select Root, the root's side
  find_hold(robot);  // what ties me to the others while I have no parent
  manage_spares(robot, {.needs_spare = [&] { return needs_spare(robot); },  // Grow Tree
                        .may_call = [&] { return may_call(robot); },
                        .count_waiting = [&](bool unserved) { count_waiting(robot, unserved, is_left_waiting(robot)); },
                        .may_insert = [&](int owner, int parent) { return may_insert(robot, owner, parent); }});
  keep_company(robot);  // mission.link_redundancy
  if (robot.power != nullptr) {
    if (asks_for_relief(robot)) call_for_relief(*robot.power);
    tend_battery(*robot.power);
    if (robot.power->power.travels) state.accompanies = nobody;  // another spare takes its place
  }
  note_start(robot);  // have I few neighbours, all of them far away?
  find_gap(robot);    // is a part of the network there that does not hear me?
  const bool regroups = is_left_waiting(robot);
  const bool retreats = is_retreating(robot, regroups);
  Vec2 u;
  if (!closes_gap(robot, u) && !awaits_others(robot, u))
    u = retreats                    ? retreat_motion(robot, regroups)
        : state.role == Role::spare ? waiting_motion(robot)
                                    : towed_motion(robot);
  Guard guard;
  guard_edges(robot, retreats, guard);
  guard_links(robot, retreats, guard);
  keep_off(robot, guard);  // obstacles
  keep_sight(robot, state.corners, guard);
  push_nobody(robot, guard);
  float pace = robot.power != nullptr ? give_way(*robot.power, params.clearance, guard) : 1.0F;
  if (retreats) pace = 1.0F;

  write_convoy(robot, message);
  const Vec2 v = allowed(pace < 1.0F ? clamped(u, 1.0F) * pace : u, guard, params);
  watch_progress(robot, retreats, v);  // does the worker make progress?
  Motion motion = drive(v, guard, params);
  if (pace < 1.0F) motion.turn *= std::min(1.0F, norm(v));
  return motion;
}

Output<ConvoyMessage> convoy_step(const ConvoyParams& params, ConvoyState& state,
                                  const Inputs<Heard>& inputs) noexcept {
  Workspace space(inputs);
  ConvoyRobot robot(params, state, inputs, space);
  Output<ConvoyMessage> output;
  output.motion = tick(robot, inputs, output.message);
  return output;
}

Report convoy_report(const ConvoyState& s) noexcept {
  Report report = healing_report(s);
  if (s.role == Role::spare) report.kept[0] = s.accompanies;
  return report;
}

Output<PoweredConvoyMessage> powered_convoy_step(const ConvoyParams& params, PoweredConvoyState& state,
                                                 const Inputs<Heard>& inputs) noexcept {
  Workspace space(inputs);
  ConvoyRobot robot(params, state, inputs, space);
  const auto child_count = [&](int k) { return int{robot.convoy_of(k).child_count}; };
  PowerRobot power{robot, state.power, params, child_count};
  robot.power = &power;
  robot.passes_targets_on = true;
  Output<PoweredConvoyMessage> output;
  output.motion = tick(robot, inputs, output.message);
  static_cast<PowerStanding&>(output.message) = state.power.said;
  return output;
}

Report powered_report(const PoweredConvoyState& state) noexcept {
  Report report = convoy_report(state);
  report.leaves = state.power.said.leaving;
  report.seeks_charge = state.power.seeks;
  report.relieves = state.power.said.relieves;
  return report;
}

void add_to(Digest& digest, const ConvoyState& state) noexcept {
  add_to(digest, static_cast<const HealingState&>(state));
  const auto add = [&](const auto& field) { digest.add(field); };
  visit_convoy_state(add, state);
}

void add_to(Digest& digest, const PoweredConvoyState& state) noexcept {
  add_to(digest, static_cast<const ConvoyState&>(state));
  const auto add = [&](const auto& field) { digest.add(field); };
  visit_power_state(add, state.power, state.neighbors.size());
}

void add_to(Digest& digest, const ConvoyMessage& message) noexcept {
  FieldDigest visit{digest};
  visit_fields(visit, message);
}

}  // namespace banyan
