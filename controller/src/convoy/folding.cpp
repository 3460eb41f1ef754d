// SPDX-License-Identifier: MIT
#include "convoy/folding.hpp"

#include <algorithm>

#include "banyan/controller/core/search.hpp"
#include "convoy/companions.hpp"
#include "convoy/towing.hpp"

namespace banyan {
namespace {

constexpr float taut_below = 0.04F;   // of C: so much shorter than the longest folded edge one begins to draw a parent
constexpr float taut_width = 0.08F;   // of C: and so much longer it does with all its strength
constexpr float gives_below = 0.02F;  // of C: the same for the edge to one's own parent,
constexpr float gives_width = 0.5F;   // of the longest folded edge: which gives way to the others
constexpr float off_middle = 0.02F;   // of C: a robot that joins may be so much farther away than a folded edge is long
constexpr float sideways = 0.5F;      // the pace of a robot that does not hear its grandparent,
constexpr float slower = 3.0F;        // times slower if that is the next but one: it is hidden more often
constexpr int unheard_ticks = 3;      // silent for longer it does not hear it
constexpr float search_drives = 0.4F;   // to one side, then to the other
constexpr float pushes_through = 6.0F;  // between a line and the edges beside it: through the line

// I do not hear my grandparent or, with k = 3, its parent, although the edges there are short: somebody stands between
// us. To one side for some time, then to the other.
Vec2 look_past(const ConvoyRobot& robot, Vec2 up) noexcept {
  const ConvoyState& self = robot.self;
  const TreeTable& table = robot.table();
  int over = robot.parent;
  for (int hop = 1; hop < robot.params.link_redundancy; ++hop) {
    const TreeStanding& m = table.message(over);
    if (m.parent == nobody || m.need != Need::no_need) return {};
    over = table.find(m.parent);
    if (over >= 0 && table.age(over) <= unheard_ticks) continue;
    const bool left = (self.phase_ticks / robot.params.rounds(search_drives) + self.id) % 2 == 0;
    const float pace = hop > 1 ? sideways / slower : sideways;
    return left_of(up) * (left ? pace : -pace);
  }
  return {};
}

}  // namespace

bool may_fold(const ConvoyRobot& robot) noexcept {
  const ConvoyParams& p = robot.params;
  return has_companions(p) && p.line_of_sight && p.thrift <= 0.0F && !robot.self.forgets && robot.power == nullptr &&
         !robot.self.too_few_to_fold;
}

bool folds(const ConvoyRobot& robot) noexcept {
  return may_fold(robot) && prunes(robot.params) && robot.self.subtree_workers > 0 && robot.self.want < folds_from &&
         robot.self.call_hops >= companion_call;
}

float folded_edge(const ConvoyParams& params) noexcept {
  return folded_reach / static_cast<float>(params.link_redundancy);
}

bool wants_fold(const ConvoyRobot& robot) noexcept {
  if (!folds(robot) || (robot.self.is_worker && robot.self.want > 0.0F)) return false;
  const TreeTable& table = robot.table();
  return table.range(robot.parent) > folded_edge(robot.params) || table.age(robot.parent) > unheard_ticks;
}

bool is_off_middle(const ConvoyRobot& robot, int owner, int parent) noexcept {
  const TreeTable& table = robot.table();
  const ConvoyParams& p = robot.params;
  const float edge = distance(table.position(owner), table.position(parent));
  if (!may_fold(robot) || is_under_way(table.message(owner)) || edge > folded_reach) return false;
  return std::max(table.range(owner), table.range(parent)) > std::max(0.5F * edge, folded_edge(p)) + off_middle;
}

bool leads_travelling(const ConvoyRobot& robot, int k) noexcept {
  const TreeStanding& m = robot.table().message(k);
  return may_fold(robot) && m.role == Role::worker && m.want > 0 && up_of(m) != nobody &&
         robot.convoy_of(k).child_count == 0;
}

Vec2 folding_motion(const ConvoyRobot& robot) noexcept {
  const float edge = folded_edge(robot.params);
  const TreeTable& table = robot.table();
  Vec2 u;
  for (const int k : robot.children)
    if (table.message(k).role != Role::spare)
      u += unit(table.position(k)) * ramp(table.range(k), edge - taut_below, taut_width);
  if (robot.parent < 0 || robot.self.want > 0.0F) return u;  // the last bit of the way it is towed
  const Vec2 up = unit(table.position(robot.parent));
  return u + up * ramp(table.range(robot.parent), edge - gives_below, gives_width * edge) + look_past(robot, up);
}

Vec2 clear_folds(const ConvoyRobot& robot, float width) noexcept {
  Vec2 u;
  if (!may_fold(robot)) return u;
  const TreeTable& table = robot.table();
  table.members.for_each([&](int k) {
    const TreeStanding& m = table.message(k);
    if (!table.alive(k) || is_under_way(m) || m.parent == robot.self.id) return;
    const int middle = table.find(m.parent);
    const int over = middle < 0 ? -1 : table.find(table.message(middle).parent);
    if (over < 0) return;
    const Vec2 a = table.position(k);
    const Vec2 b = table.position(over);
    if (distance(a, b) > 1.0F) return;
    const Vec2 along = unit(b - a);
    const Vec2 mid = table.position(middle);
    Vec2 out = left_of(along);
    if (dot(out, mid - a) > 0.0F) out = -out;
    const float beyond = -dot(out, a);
    const float on = -dot(along, a);
    if (beyond > width || on < 0.0F || on > distance(a, b)) return;
    // In the triangle of the three the edges would push it back: it crosses the line.
    if (beyond > 0.0F) u += out * push_off_line(beyond, width);
    else if (cross(mid - a, -a) * cross(mid - b, -b) < 0.0F && beyond > dot(out, mid - a)) u += out * pushes_through;
  });
  return u * robot.params.corridor_gain;
}

}  // namespace banyan
