// SPDX-License-Identifier: MIT
// How convoy moves (docs/convoy.md, rules 2, 6, 7 and 8).
#include <algorithm>

#include "banyan/controller/convoy.hpp"
#include "banyan/controller/motion.hpp"
#include "banyan/controller/parent_selection.hpp"
#include "banyan/controller/sight.hpp"
#include "banyan/controller/spare_management.hpp"

namespace banyan {
namespace {

constexpr float compact_gain = 0.8F;   // a branch that has arrived slides together with this strength
constexpr float compact_width = 0.05F; // of C: with full strength so far from compact_distance

float ramp(float d, float start, float width) noexcept { return std::clamp((d - start) / width, 0.0F, 1.0F); }

bool is_tree_neighbor(const Robot& robot, int k) noexcept {
  if (k == robot.parent || k == robot.old_parent) return true;
  const Message& m = robot.table().message(k);
  return m.parent == robot.self.id || m.old_parent == robot.self.id;
}

// Children that still have to go on tow: in proportion to how far the edge is stretched. The root
// stays with the spares as long as it can: they are needed where its edges grow.
Vec2 tow(const Robot& robot) noexcept {
  const Params& p = robot.params;
  const Neighborhood& table = robot.table();
  const float c = p.communication_range_m;
  const float start_m = robot.is_root() ? p.safe_range_m : p.pull_start * c;
  Vec2 u;
  const auto add = [&](int k) {
    const Message& m = table.message(k);
    if (m.role == Role::spare || m.want_cm == 0 || up_of(m) != robot.self.id) return;
    u += unit(table.position(k)) * ramp(table.range(k), start_m, p.pull_width * c);
  };
  for (const int k : robot.children) add(k);
  for (const int k : robot.old_children) add(k);
  return u;
}

template <class Visit>
void for_each_edge(const Robot& robot, Visit visit) noexcept {
  const Neighborhood& table = robot.table();
  if (robot.parent >= 0) visit(robot.parent);
  else if (robot.old_parent >= 0) visit(robot.old_parent);
  for (const int k : robot.children)
    if (table.message(k).role != Role::spare) visit(k);
}

// Edges as strings under tension: a chain becomes straight, three chains meet at 120 degrees.
Vec2 tension(const Robot& robot) noexcept {
  const Params& p = robot.params;
  const float c = p.communication_range_m;
  Vec2 u;
  for_each_edge(robot, [&](int k) {
    u += unit(robot.table().position(k)) * ramp(robot.table().range(k), p.tension_start * c, p.tension_width * c);
  });
  return u * p.tension_gain;
}

// Somewhere near an edge waits in vain for a spare: long edges take slack from short ones.
Vec2 shared_slack(const Robot& robot) noexcept {
  constexpr int reach_hops = 8;
  const Params& p = robot.params;
  if (robot.self.call_hops > reach_hops) return {};
  const float start_m = p.pull_start * p.communication_range_m;
  Vec2 u;
  for_each_edge(robot, [&](int k) {
    u += unit(robot.table().position(k)) * ramp(robot.table().range(k), start_m, p.ideal_distance_m - start_m);
  });
  return u * p.slack_gain;
}

// Repulsion, from spares only when they are nearer still: they make room themselves.
Vec2 elbow_room(const Robot& robot) noexcept {
  const Params& p = robot.params;
  const Neighborhood& table = robot.table();
  Vec2 u;
  for (int k = 0; k < table.size(); ++k) {
    const float d = table.range(k);
    if (d >= p.avoidance_range_m || d <= 0.0F || !table.alive(k) || is_tree_neighbor(robot, k)) continue;
    const float a = table.message(k).role == Role::spare ? p.spare_avoidance * p.communication_range_m : p.avoidance_range_m;
    if (d < a) u += table.position(k) * (-p.avoidance_gain * (a / d - 1.0F) / d);
  }
  return u;
}

// Out of the line of sight of tree edges that are not mine, if I hear both ends.
Vec2 make_way(const Robot& robot, float width_m) noexcept {
  const Params& p = robot.params;
  const Neighborhood& table = robot.table();
  Vec2 u;
  for (int k = 0; k < table.size(); ++k) {
    const Message& m = table.message(k);
    if (m.parent == nobody || m.parent == robot.self.id || m.role == Role::spare || table.age(k) > 0 || k == robot.parent) continue;
    const int up = table.find(m.parent);
    if (up < 0) continue;
    const Vec2 a = table.position(k);
    const Vec2 b = table.position(up);
    const Vec2 near = nearest_on_segment(a, b);
    const float d = norm(near);
    if (d >= width_m) continue;
    const Vec2 along = unit(b - a);
    const Vec2 side = d > 1e-3F ? -near / d : Vec2{-along.y, along.x};
    u += side * std::min(width_m / std::max(d, 1e-3F) - 1.0F, 20.0F);
  }
  return u * p.corridor_gain;
}

Vec2 clamped(Vec2 u, float limit) noexcept {
  const float n = norm(u);
  return n > limit ? u * (limit / n) : u;
}

// The way along which I can save a robot: towards my parent; the root's is towards the nearest child
// that does nothing but pass it on.
int thrift_way(const Robot& robot) noexcept {
  if (!robot.is_root()) return robot.parent;
  const Neighborhood& table = robot.table();
  int best = -1;
  for (const int k : robot.children)
    if (table.message(k).role == Role::connector && (best < 0 || table.range(k) < table.range(best))) best = k;
  return best;
}

// Rule 9: a connector whose workers have arrived slides until its longest other edge is stretched. So
// the slack of a branch gathers at one end, where a robot becomes superfluous.
Vec2 compaction(const Robot& robot) noexcept {
  const Params& p = robot.params;
  const Neighborhood& table = robot.table();
  const float c = p.communication_range_m;
  const int way = thrift_way(robot);
  if (way < 0) return {};
  int longest = -1;
  for (const int k : robot.children)
    if (k != way && table.message(k).role != Role::spare && (longest < 0 || table.range(k) > table.range(longest))) longest = k;
  if (longest < 0) return robot.is_root() ? unit(table.position(way)) * compact_gain : Vec2{};
  const float slack = std::clamp((p.compact_distance - table.range(longest) / c) / compact_width, -1.0F, 1.0F);
  return (slack > 0.0F ? unit(table.position(way)) : -unit(table.position(longest))) * (slack * compact_gain);
}

}  // namespace

bool saves_robots(const Params& params) noexcept { return params.corrected() && params.merge_distance > 0.0F; }

bool has_arrived(const Robot& robot) noexcept {
  return saves_robots(robot.params) && robot.self.want_m == 0.0F && robot.self.subtree_workers > 0;
}

bool is_relay(const Robot& robot, int k) noexcept {
  const Message& m = robot.table().message(k);
  return saves_robots(robot.params) && m.role == Role::worker && m.want_cm == 0 && robot.self.want_m == 0.0F;
}

Vec2 towed_motion(const Robot& robot) noexcept {
  const Params& p = robot.params;
  const int up = robot.parent >= 0 ? robot.parent : robot.old_parent;
  if (up >= 0 && !robot.table().alive(up)) return unit(robot.table().position(up));
  if (up >= 0 && robot.table().range(up) > p.ideal_distance_m) return unit(robot.table().position(up));
  if (is_orphan(robot)) return up >= 0 && robot.table().range(up) > p.safe_range_m ? unit(robot.table().position(up)) : Vec2{};
  if (robot.self.is_worker) return robot.self.pull + elbow_room(robot);
  const Vec2 along = has_arrived(robot) ? compaction(robot) : clamped(tow(robot), 1.0F);
  return along + tension(robot) + shared_slack(robot) + elbow_room(robot) + make_way(robot, p.corridor_width * p.communication_range_m);
}

Vec2 waiting_motion(const Robot& robot) noexcept {
  const Params& p = robot.params;
  const float c = p.communication_range_m;
  const State& self = robot.self;
  Vec2 midpoint;
  if (self.spare_state == SpareState::extend_edge && edge_midpoint(robot, self.request, midpoint))
    return unit(midpoint) + elbow_room(robot) + make_way(robot, 2.0F * p.clearance * c);
  const int k = robot.table().find(self.parent != nobody ? self.parent : self.reference);
  const Vec2 reference = k >= 0 ? robot.table().position(k) : Vec2{};
  const float d = norm(reference);
  // On its way along a chain it may come nearer to the line of sight than while it waits.
  if (d > p.safe_range_m || (self.called && d > p.avoidance_range_m))
    return unit(reference) + elbow_room(robot) + make_way(robot, 2.0F * p.clearance * c);
  return elbow_room(robot) + make_way(robot, p.corridor_width * c);
}

}  // namespace banyan
