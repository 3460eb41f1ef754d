// SPDX-License-Identifier: MIT
// How convoy moves (docs/convoy.md).
#include <algorithm>

#include "banyan/controller/core/edge_frame.hpp"
#include "banyan/controller/core/search.hpp"
#include "convoy/companions.hpp"
#include "convoy/folding.hpp"
#include "convoy/handing_on.hpp"
#include "convoy/plan.hpp"
#include "convoy/shortcut.hpp"
#include "convoy/towing.hpp"
#include "healing/healing.hpp"
#include "obstacles/bypass.hpp"
#include "obstacles/sight.hpp"
#include "tree/motion.hpp"
#include "tree/parent_selection.hpp"
#include "tree/spare_management.hpp"

namespace banyan {
namespace {

constexpr float compact_gain = 0.8F;    // the strength with which a branch that has arrived contracts
constexpr float compact_width = 0.05F;  // of C: full strength when so far from compact_distance
constexpr float wide = 2.0F;           // of `clearance`: robots under way pass each other and lines of sight so far off
constexpr float follow_spare = 0.25F;  // of C: how far it stays behind a spare that leads it to the tree
constexpr float follow_tree = 0.5F;    // and behind a robot of the tree
constexpr float called_follow_spare = 0.6F;  // the same while it is called elsewhere
constexpr float called_follow_tree = 0.75F;
constexpr float called_follow_thin = 0.9F;  // where no crowd is, and packets get lost
constexpr float pinned_start = 0.125F;      // of C: from here on a child at a corner tows,
constexpr float pinned_width = 0.05F;       // and with full strength so much farther away
constexpr float up_start = 0.025F;          // beside a junction that is handed on
constexpr float up_width = 0.10F;

constexpr float tows_sooner = 4.0F;        // times the spread of ranges
constexpr float as_good_as_there = 0.95F;  // of arrival_distance
constexpr int slack_reach_hops = 8;        // so far from an edge that waits in vain robots give up slack
constexpr int silent_ticks = 2;            // a robot silent for longer is out of sight

// Somewhere near, an edge waits in vain for a spare.
bool is_short_of_robots(const ConvoyRobot& robot) noexcept { return robot.self.call_hops <= slack_reach_hops; }

// Neighbour k stands at its target, and robots below it in the tree still have to go on.
bool tows_past(const ConvoyRobot& robot, int k) noexcept {
  const float want = from_fixed(robot.table().message(k).want);
  return robot.convoy_of(k).child_count > 0 && want > robot.params.arrival_distance && stands_at_target(robot, k);
}

// The pull that neighbour k has sent me, its parent.
Vec2 pull_of(const ConvoyRobot& robot, int k) noexcept {
  const TreeStanding& m = robot.table().message(k);
  return from_edge_frame({static_cast<float>(m.pull_x) / pull_unit, static_cast<float>(m.pull_y) / pull_unit},
                         robot.table().position(k));
}

// The chain below me has slack, and I am a junction of a large swarm: my parent is near, or has come up to me.
bool has_slack_below(const ConvoyRobot& robot) noexcept {
  constexpr float near_parent = 0.5F;  // of C
  const float near = near_parent;
  return has_far_spares(robot) && robot.parent >= 0 && robot.table().range(robot.parent) < near;
}

// Children that still have to go on tow me, in proportion to how far the edge is stretched. The root and
// junctions stay with the spares as long as they can: there their edges grow and are split.
Vec2 tow(const ConvoyRobot& robot) noexcept {
  const ConvoyParams& p = robot.params;
  const TreeTable& table = robot.table();
  // While spares are short, a child that is almost there does not tow: the slack is left to others.
  const auto least =
      is_short_of_robots(robot) ? static_cast<int>(as_good_as_there * p.arrival_distance * per_range) : 0;
  const auto tows = [&](int k) {
    const TreeStanding& m = table.message(k);
    return m.role != Role::spare && m.want > least && up_of(m) == robot.self.id;
  };
  int count = 0;
  for (const IndexList* below : {&robot.children, &robot.old_children})
    for (const int k : *below) count += tows(k) ? 1 : 0;
  // Noise makes the guard hold a child back now and then: its parent comes along sooner.
  const bool stays = robot.is_root() || (count > 1 && !has_slack_below(robot));
  const float start = (stays ? p.safe_range : p.pull_start) - tows_sooner * table.spread();
  Vec2 u;
  const auto add = [&](int k) {
    if (!tows(k)) return;
    // The child of a worker at its target tows me past that worker: there it can take me as its parent.
    if (tows_past(robot, k)) {
      u += pull_of(robot, k);
      return;
    }
    if (count == 1 && has_far_spares(robot) && is_held_by_branches(robot, k)) {
      const Vec2 way = place_beside(robot, k);
      u += unit(way) * std::max(ramp(norm(way), up_start, up_width), ramp(table.range(k), start, p.pull_width));
      return;
    }
    // A child at a corner needs its parent there before it can go round.
    const float weight = robot.corner_of(k).pinned ? ramp(table.range(k), pinned_start, pinned_width)
                                                   : ramp(table.range(k), start, p.pull_width);
    u += unit(table.position(k)) * weight;
  };
  for (const IndexList* below : {&robot.children, &robot.old_children})
    for (const int k : *below) add(k);
  return u;
}

// Edges as strings, each drawn the harder the longer it is.
Vec2 strings(const ConvoyRobot& robot, float start, float width) noexcept {
  const TreeTable& table = robot.table();
  Vec2 u;
  const auto draw = [&](int k) { u += unit(table.position(k)) * ramp(table.range(k), start, width); };
  if (robot.parent >= 0) draw(robot.parent);
  else if (robot.old_parent >= 0) draw(robot.old_parent);
  for (const int k : robot.children)
    if (table.message(k).role != Role::spare) draw(k);
  return u;
}

// Under tension a chain becomes straight, and three chains meet at 120 degrees.
Vec2 tension(const ConvoyRobot& robot) noexcept {
  const ConvoyParams& p = robot.params;
  return strings(robot, p.tension_start, p.tension_width) * p.tension_gain;
}

// In a large swarm: I am on my way past child k or up to it, and my other edges are not to hold me back.
bool goes_to_child(const ConvoyRobot& robot) noexcept {
  constexpr float on_the_way = 0.5F;  // of C: some worker below has still so far to go
  return has_far_spares(robot) && robot.self.want > on_the_way && banyan::any_of(robot.children, [&](int k) {
           return robot.table().message(k).role != Role::spare &&
                  (tows_past(robot, k) || is_held_by_branches(robot, k));
         });
}

// While spares are short, long edges take slack from short ones.
Vec2 shared_slack(const ConvoyRobot& robot) noexcept {
  const ConvoyParams& p = robot.params;
  if (!is_short_of_robots(robot) || goes_to_child(robot)) return {};
  return strings(robot, p.pull_start, p.ideal_distance - p.pull_start) * p.slack_gain;
}

// From spares only at a smaller distance, since they make room themselves.
Vec2 repulsion(const ConvoyRobot& robot) noexcept {
  const ConvoyParams& p = robot.params;
  const TreeTable& table = robot.table();
  Vec2 u;
  for (int k = 0; k < table.size(); ++k) {
    const float d = table.range(k);
    if (d >= p.avoidance_range || d <= same_spot || !table.alive(k) || robot.is_tree_neighbor(k)) continue;
    const float a = table.message(k).role == Role::spare ? p.spare_avoidance : p.avoidance_range;
    if (d < a) u += table.position(k) * (-p.avoidance_gain * (a / d - 1.0F) / d);
  }
  return u;
}

// Calls visit(a, b) for tree edges, and old ones during a reconstruction, that are not mine and whose ends I know.
template <class Visit> void for_each_other_edge(const ConvoyRobot& robot, Visit visit) noexcept {
  const TreeTable& table = robot.table();
  table.members.for_each([&](int k) {
    if (!table.alive(k)) return;
    const TreeStanding& m = table.message(k);
    const auto visit_edge = [&](RobotId parent) {
      if (parent == nobody || parent == robot.self.id) return;
      if (const int up = table.find(parent); up >= 0) visit(table.position(k), table.position(up));
    };
    if (k != robot.parent) visit_edge(m.parent);
    if (k != robot.old_parent && m.old_parent != m.parent) visit_edge(m.old_parent);
  });
}

// Moves out of the lines of sight of these edges.
Vec2 make_way(const ConvoyRobot& robot, float width) noexcept {
  static constexpr float either_side = 5e-4F;
  Vec2 u;
  for_each_other_edge(robot, [&](Vec2 a, Vec2 b) {
    const Vec2 near = nearest_on_segment(a, b);
    const float d = norm(near);
    if (d >= width) return;
    const Vec2 along = unit(b - a);
    const Vec2 side = d > either_side ? -near / d : Vec2{-along.y, along.x};
    u += side * push_off_line(d, width);
  });
  return u * robot.params.corridor_gain + clear_folds(robot, width);
}

// On that way, as far as others and the lines of sight of edges let it.
Vec2 pushed_off(const ConvoyRobot& robot, Vec2 way, float width) noexcept {
  return way + repulsion(robot) + make_way(robot, width);
}

// The course of a spare that is needed elsewhere. If others push it back so hard that it almost stops, the push is
// turned sideways, to the side to which it is pushed already; among obstacles bypass() chooses the side.
Vec2 past(const ConvoyRobot& robot, Vec2 way, float width) noexcept {
  constexpr float stopped = 0.7F;  // of its speed, against it
  const Vec2 apart = repulsion(robot);
  const Vec2 out = make_way(robot, width);
  const float against = -dot(way, apart + out);
  if (against < stopped || robot.self.corners.landmarks.size > 0) return way + apart + out;
  const Vec2 left = left_of(way);
  const float aside = dot(left, apart + out);
  return way + left * (aside + (aside < 0.0F ? -against : against));
}

// My parent, then my children; -1: none, or a spare.
int tree_neighbor(const ConvoyRobot& robot, int n) noexcept {
  if (n == 0) return robot.parent;
  const int k = robot.children.items[static_cast<std::size_t>(n - 1)];
  return robot.table().message(k).role == Role::spare ? -1 : k;
}

// With thrift: a junction goes to each of its tree neighbours in turn, since the robot that can be saved may be on any
// branch. To a child only while no robot is near its edges, which might be drawn across that robot.
int junction_way(const ConvoyRobot& robot) noexcept {
  constexpr float turn_drives = 1.2F;  // to each of them
  const ConvoyParams& p = robot.params;
  int turn = robot.self.phase_ticks / p.rounds(turn_drives) % (robot.useful_children + 1);
  int way = robot.parent;
  for (int n = 0; n <= robot.children.size; ++n) {
    const int k = tree_neighbor(robot, n);
    if (k < 0) continue;
    if (p.line_of_sight && !sees_clearly(robot, k, wide * p.clearance)) return robot.parent;
    if (turn-- == 0) way = k;
  }
  return way;
}

// The neighbour to move towards so that a robot can be saved: my parent; for the root the nearest child
// that is a connector.
int pruning_way(const ConvoyRobot& robot) noexcept {
  if (!robot.is_root()) {
    const bool in_turn = robot.params.thrift > 0.0F && robot.useful_children > 1 && robot.parent >= 0;
    return in_turn ? junction_way(robot) : robot.parent;
  }
  const TreeTable& table = robot.table();
  int best = -1;
  for (const int k : robot.children)
    if (table.message(k).role == Role::connector && (best < 0 || table.range(k) < table.range(best))) best = k;
  return best;
}

// With thrift: it goes on along the circles on which its other edges stay stretched, instead of stopping there.
Vec2 sliding(const ConvoyRobot& robot, int way) noexcept {
  const ConvoyParams& p = robot.params;
  const TreeTable& table = robot.table();
  Vec2 u = unit(table.position(way));
  // Twice, since drawing nearer to one of them may lead away from another.
  for (int round = 0; round < 2; ++round)
    for (int n = 0; n <= robot.children.size; ++n) {
      const int k = tree_neighbor(robot, n);
      if (k < 0 || k == way) continue;
      const float slack = std::clamp((thrifty(p, p.compact_distance) - table.range(k)) / compact_width, -1.0F, 1.0F);
      const Vec2 away = -unit(table.position(k));
      if (const float too_fast = dot(u, away) - slack; too_fast > 0.0F) u += away * -too_fast;
    }
  return u * compact_gain;
}

// Rule 9: a connector whose workers have arrived moves until its longest other edge is stretched. So the
// slack of a branch gathers at one end, where a robot becomes superfluous. Not with more targets than a robot
// remembers: if a robot of so large a tree dies, its neighbours soon meet again only if their edges are not stretched.
// In a large swarm the slack is wanted all the same, since spares are minutes away.
Vec2 compaction(const ConvoyRobot& robot) noexcept {
  if (robot.self.forgets && !is_counted_large(robot)) return {};
  const ConvoyParams& p = robot.params;
  const TreeTable& table = robot.table();
  const int way = pruning_way(robot);
  if (way < 0) return {};
  int longest = -1;
  for (const int k : robot.children)
    if (k != way && table.message(k).role != Role::spare && (longest < 0 || table.range(k) > table.range(longest)))
      longest = k;
  if (longest < 0) return robot.is_root() ? unit(table.position(way)) * compact_gain : Vec2{};
  if (p.thrift > 0.0F) return sliding(robot, way);
  const float slack = std::clamp((p.compact_distance - table.range(longest)) / compact_width, -1.0F, 1.0F);
  return (slack > 0.0F ? unit(table.position(way)) : -unit(table.position(longest))) * (slack * compact_gain);
}

// Among obstacles a tree neighbour that falls silent has gone behind one: the child drives back to where it last
// heard its parent, and the parent waits meanwhile.
bool lost_sight(const ConvoyRobot& robot, int up) noexcept {
  const TreeTable& table = robot.table();
  if (!robot.params.line_of_sight || robot.self.corners.landmarks.size == 0) return false;
  if (up >= 0 && table.alive(up) && table.age(up) >= silent_ticks) return true;
  if (robot.self.childless_ticks > 0) return true;
  return banyan::any_of(robot.children,
                        [&](int k) { return table.message(k).role != Role::spare && table.age(k) >= silent_ticks; });
}

// A worker's pull, or along the obstacle in its way.
Vec2 pull_past_obstacles(const ConvoyRobot& robot) noexcept {
  const Vec2 pull = robot.self.pull;
  const float goal = robot.target != nullptr ? norm(*robot.target) : robot.self.want;
  // The last bit straight, as near as obstacles allow: a dead worker may lie on its successor's target. But if that
  // is in vain, there is a wall in between.
  constexpr float last_bit = 0.15F;  // of C
  constexpr int in_vain = 50;        // ticks at an obstacle
  if (goal < last_bit && robot.self.progress.vain_ticks < in_vain) return pull;
  return bypass(robot, unit(pull) * goal) * norm(pull);
}

// While the tree is reconstructed, a lost line of sight cannot be repaired. If all workers have arrived,
// there is no hurry either: it is best that no robot moves.
bool holds_still(const ConvoyRobot& robot) noexcept {
  if (robot.self.phase != Phase::start_tree && robot.self.phase != Phase::select_parent) return false;
  if (robot.self.want > 0.0F) return false;
  const TreeTable& table = robot.table();
  for (int k = 0; k < table.size(); ++k)
    if (table.message(k).want > 0) return false;
  return true;
}

// A worker without a parent goes as far as its hold allows, which draws it back in proportion to the distance: turning
// back at a fixed distance would oscillate for ever. While it hears no neighbour it only turns on the spot.
Vec2 before_tree(const ConvoyRobot& robot) noexcept {
  constexpr float turning = 0.001F;   // so slow that it only turns
  constexpr float hold_width = 0.1F;  // of C
  const ConvoyParams& p = robot.params;
  if (robot.self.phase >= Phase::grow_tree || !robot.self.is_worker) return repulsion(robot);
  if (robot.table().size() == 0) return robot.self.pull * turning;
  const Vec2 on = pull_past_obstacles(robot) + repulsion(robot);
  if (robot.hold < 0) return on;
  const float back = ramp(robot.table().range(robot.hold), p.recruitment_distance - 0.5F * hold_width, hold_width);
  return on * (1.0F - back) + unit(robot.table().position(robot.hold)) * back;
}

// The neighbour that a spare stays near.
int followed_by(const ConvoyRobot& robot) noexcept {
  const ConvoyState& self = robot.self;
  const TreeTable& table = robot.table();
  // In a crowd, a called spare might wait for others to move while the tree goes away.
  if (const int home = self.called && robot.hold >= 0 ? table.find(nearest_reference(robot)) : -1; home >= 0) {
    const float home_c = is_thin(self)                             ? called_follow_thin
                         : table.message(home).role == Role::spare ? called_follow_spare
                                                                   : called_follow_tree;
    if (table.range(home) > home_c) return home;
  }
  return table.find(self.parent != nobody ? self.parent : self.reference);
}

// Round neighbour k, away from that robot's own parent, if that is known: there the edge that calls begins.
Vec2 way_round(const ConvoyRobot& robot, int k) noexcept {
  const TreeTable& table = robot.table();
  const Vec2 reference = table.position(k);
  const Vec2 round = left_of(reference);
  const int up = robot.self.corners.landmarks.size > 0 ? -1 : table.find(up_of(table.message(k)));
  return up >= 0 && dot(round, reference - table.position(up)) < 0.0F ? -round : round;
}

}  // namespace

bool passes_pull_on(const ConvoyRobot& robot, Vec2& pull) noexcept {
  const ConvoyState& self = robot.self;
  if (!self.is_worker || robot.target == nullptr || norm(*robot.target) >= robot.params.arrival_distance) return false;
  const TreeTable& table = robot.table();
  int best = -1;
  for (const int k : robot.children)
    if (table.message(k).role != Role::spare && table.message(k).want > (best < 0 ? 0 : table.message(best).want))
      best = k;
  if (best < 0) return false;
  pull = pull_of(robot, best);
  return true;
}

bool prunes(const ConvoyParams& params) noexcept { return params.merge_distance > 0.0F; }

bool has_arrived(const ConvoyRobot& robot) noexcept {
  return prunes(robot.params) && robot.self.want == 0.0F && robot.self.subtree_workers > 0;
}

bool is_relay(const ConvoyRobot& robot, int k) noexcept {
  const TreeStanding& m = robot.table().message(k);
  return prunes(robot.params) && m.role == Role::worker && m.want == 0 && robot.self.want == 0.0F;
}

// A point beside the first robot of the tree that stands in the way of a spare to `goal`, on the side on which the way
// passes it; else `goal`. Straight on, the spare would be pushed back, and lose sight of the robot that it is to
// relieve.
static Vec2 past_bodies(const ConvoyRobot& robot, Vec2 goal) noexcept {
  const TreeTable& table = robot.table();
  const float room = wide * robot.params.clearance;
  int first = -1;
  Vec2 side;
  table.members.for_each([&](int k) {
    const Vec2 at = table.position(k);
    const Vec2 off = nearest_on_segment(-at, goal - at);
    if (!table.alive(k) || norm(off) >= room || distance(at, goal) < room ||
        (first >= 0 && table.range(k) >= table.range(first)))
      return;
    first = k;
    side = norm(off) > same_spot ? unit(off) : left_of(unit(goal));
  });
  return first < 0 ? goal : table.position(first) + side * (2.0F * room);
}

// Beside the robot that is relieved, or as it makes room; slower over the last decimetre.
static bool relief_motion(const ConvoyRobot& robot, Vec2& u) noexcept {
  constexpr float last_bit = 0.05F;
  Vec2 spot;
  if (robot.power == nullptr || !find_relief_spot(*robot.power, spot)) return false;
  u = clamped((robot.self.role == Role::spare ? past_bodies(robot, spot) : spot) / last_bit, 1.0F);
  return true;
}

Vec2 towed_motion(const ConvoyRobot& robot) noexcept {
  const ConvoyParams& p = robot.params;
  const int up = robot.parent >= 0 ? robot.parent : robot.old_parent;
  constexpr float back = 0.01F;  // so near it stands where it saw the other
  if (lost_sight(robot, up))
    return norm(robot.self.corners.seen_from) > back ? unit(robot.self.corners.seen_from) : Vec2{};
  if (up >= 0 && !robot.is_linked(up)) return bypass(robot, robot.table().position(up));
  if (up >= 0 && robot.table().range(up) > p.ideal_distance) return unit(robot.table().position(up));
  if (is_orphan(robot))
    return up >= 0 && robot.table().range(up) > p.safe_range ? unit(robot.table().position(up)) : Vec2{};
  // The first tree takes time to build, and a target may be added in mid-mission: a worker does not go without a tree.
  if (up < 0 && !robot.is_root()) return before_tree(robot);
  if (Vec2 u; relief_motion(robot, u)) return holds_still(robot) ? Vec2{} : u;
  // At its target a worker may give way a little, if that lets another one reach its own; this fades out
  // before the target is out of tolerance.
  constexpr float fading = 0.1F;
  const float give = std::clamp((as_good_as_there * p.target_gain - norm(robot.self.pull)) / fading, 0.0F, 1.0F);
  // A successor hurries: the tree stands there already. It has been told where its target is and may be wrong by a
  // hand, and the dead worker may lie there: so it gets as near as it can, and pushes nobody (link_guard.hpp).
  const bool succeeds = goes_by_memory(robot.self) && robot.power == nullptr;
  if (robot.self.is_worker)
    return pull_past_obstacles(robot) * (succeeds ? 1.0F : worker_pace(p)) + clamped(shared_slack(robot), give) +
           (succeeds ? Vec2{} : repulsion(robot));
  if (robot.carries_on) return bypass(robot, robot.self.lost_child) + repulsion(robot);
  if (holds_still(robot)) return {};
  if (Vec2 way; steps_aside(robot, way)) return way + repulsion(robot);
  if (folds(robot))
    return pushed_off(robot, folding_motion(robot), wide * p.clearance) + clear_sight(robot, robot.self.corners);
  const Vec2 along = robot.self.lead_to != nobody ? lead(robot)
                     : has_arrived(robot)         ? compaction(robot)
                                                  : clamped(tow(robot), 1.0F);
  return pushed_off(robot, along + tension(robot) + shared_slack(robot), p.corridor_width) +
         clear_sight(robot, robot.self.corners);
}

Vec2 waiting_motion(const ConvoyRobot& robot) noexcept {
  const ConvoyParams& p = robot.params;
  const ConvoyState& self = robot.self;
  if (Vec2 u; relief_motion(robot, u)) {
    // Pushed back by two robots and the edge between them, it would wait there until the leaver has run down.
    constexpr float hesitates_drives = 0.8F;
    return self.request_ticks > p.rounds(hesitates_drives) ? u : past(robot, u, wide * p.clearance);
  }
  Vec2 midpoint;
  if (self.spare_state == SpareState::extend_edge && edge_midpoint(robot, self.request, midpoint))
    return past(robot, bypass(robot, midpoint), wide * p.clearance);
  if (const int of = robot.table().find(self.accompanies); of >= 0)
    return past(robot, companion_motion(robot, of), companion_width(robot, of));
  // On batteries spares travel all the time: one that a reconstruction has stopped between two robots gets out of
  // there.
  if (holds_still(robot)) return robot.power != nullptr ? make_way(robot, p.clearance) : Vec2{};
  // A charged robot makes room at the place. One that needs it drives through the crowd: the others step aside.
  if (Vec2 away; robot.power != nullptr && leaves_place(*robot.power, away))
    return pushed_off(robot, away, p.corridor_width);
  if (robot.power != nullptr && is_at_place(*robot.power))
    return repulsion(robot) + make_way(robot, wide * p.clearance);
  const int k = followed_by(robot);
  const Vec2 reference = k >= 0 ? robot.table().position(k) : Vec2{};
  const float d = norm(reference);
  // Sight can be lost at any distance: the spare follows in good time, and earlier still if a spare leads it.
  const bool led = k >= 0 && robot.table().message(k).role == Role::spare;
  const float reach = led ? follow_spare : follow_tree;
  // A spare under way along a chain may come nearer to lines of sight than one that waits.
  const float width = wide * p.clearance;
  if (robot.power != nullptr && robot.power->power.travels) {
    // If it is there, and hears nobody nearer to the place, that robot hides them: it goes round it.
    const Vec2 way = robot.power->power.way;
    return past(robot, bypass(robot, norm(way) < p.avoidance_range ? left_of(unit(way)) : way), width);
  }
  if (self.called && d > p.avoidance_range) return past(robot, bypass(robot, reference), width);
  if (d > reach) return pushed_off(robot, bypass(robot, reference), wide * p.clearance);
  // It is there, but cannot hear the edge that calls, hidden or too far: it goes round the robot that passed on the
  // call. Not where many edges meet: spares wait on the far side, too, and it would only cross lines of sight.
  constexpr int few_children = 3;
  const bool roomy = self.corners.landmarks.size > 0 || (k >= 0 && robot.convoy_of(k).child_count <= few_children);
  if (self.called && roomy && d > 0.0F) return pushed_off(robot, bypass(robot, way_round(robot, k)), width);
  return repulsion(robot) + make_way(robot, p.corridor_width);
}

}  // namespace banyan
