// SPDX-License-Identifier: MIT
// A robot of the tree that has to leave is relieved by the one above it, which comes to stand beside it.
#include <algorithm>
#include <utility>

#include "banyan/controller/core/search.hpp"
#include "healing/healing.hpp"
#include "power/power.hpp"

namespace banyan {
namespace {

constexpr float in_place = 0.05F;        // of C: near enough to its spot
constexpr float slack_below = 0.6F;      // of C: an edge this short has slack
constexpr float beside = 0.12F;          // of C: how far from the robot that it relieves a spare takes its place
constexpr float relief_reach = 0.2F;     // of C: from there it may
constexpr float longest_taken = 0.925F;  // of C: longest edge that a reliever takes on
constexpr float side_by_side = 1.2F;     // of the radius: two robots at one target
constexpr float surely_there = 0.9F;     // of the tolerance

// A neighbour that leaves and has me as parent, in whose place I am or will be.
int relieved(const PowerRobot& me) noexcept {
  const TreeTable& table = me.robot.table();
  const int k = table.find(me.power.said.relieves);
  return k >= 0 && table.alive(k) && me.standing(k).leaving ? k : -1;
}

// My parent takes my place.
bool has_reliever(const PowerRobot& me) noexcept {
  return me.robot.parent_alive() && me.standing(me.robot.parent).relieves == me.robot.self.id;
}

// Another robot takes my parent's place.
bool is_parent_relieved(const PowerRobot& me) noexcept {
  const int k = me.robot.parent;
  return k >= 0 && me.standing(k).leaving && has_reliever(me, k);
}

// Of two robots of an edge that have to leave, the lower one goes first unless the upper one is clearly emptier: a
// place that both left at once would be empty. If it were always the emptier one, two with equal charge would take
// turns to ask, and no call would last long enough to be heard.
bool is_first(const PowerRobot& me, int k) noexcept {
  constexpr int clearly = 20;  // of 254
  const PowerStanding& other = me.standing(k);
  if (!other.leaving || !me.robot.table().alive(k)) return true;
  return k == me.robot.parent ? me.power.said.level <= other.level + clearly
                              : me.power.said.level + clearly < other.level;
}

// It has a child that I do not hear: it hides it from me.
bool hides_child(const PowerRobot& me, int leaver) noexcept {
  const TreeTable& table = me.robot.table();
  const RobotId id = table.id(leaver);
  int heard = 0;
  for (int k = 0; k < table.size(); ++k) {
    const TreeStanding& m = table.message(k);
    if (table.age(k) <= 1 && m.role != Role::spare && (m.parent == id || m.old_parent == id)) ++heard;
  }
  return heard < me.child_count(leaver);
}

// The robot that leaves beside which I am to stand: above it, or as the spare that its edge has let in; -1: none.
int leaver_of(const PowerRobot& me) noexcept {
  const HealingRobot& robot = me.robot;
  int k = relieved(me);
  if (k < 0 && robot.self.role == Role::spare && robot.self.spare_state == SpareState::extend_edge &&
      robot.self.request != nobody)
    k = robot.table().find(robot.self.request);
  return k >= 0 && me.standing(k).leaving ? k : -1;
}

// A child that I do not hear is right behind the robot that leaves, seen from here. That is remembered for a while: if
// it were behind it from wherever I go, every spot that I come near would seem a bad one, and I would go to and fro.
void remember_unseen_child(PowerRobot& me) noexcept {
  constexpr float remembered_drives = 0.5F;  // so long it is remembered
  PowerState& power = me.power;
  const int k = leaver_of(me);
  if (k < 0 || !hides_child(me, k)) {
    power.unseen = {};
    power.unseen_ticks = 0;
    return;
  }
  power.unseen = me.robot.carry.point(power.unseen);
  if (power.unseen_ticks == 0 || power.unseen_ticks > me.robot.params.rounds(remembered_drives)) {
    const Vec2 at = me.robot.table().position(k);
    power.unseen = at + unit(at);
    power.unseen_ticks = 0;
  }
  me.robot.add_elapsed(power.unseen_ticks);
}

// A robot right above one that leaves, and with more charge, takes its place, however it came there: a spare that
// joined for it, or a robot that happens to be there. Nothing has to be remembered over a reconstruction.
void choose_relieved(PowerRobot& me) noexcept {
  constexpr float kept_within = 1.5F;  // times relief_reach
  const HealingRobot& robot = me.robot;
  const TreeTable& table = robot.table();
  PowerStanding& said = me.power.said;
  const RobotId before = std::exchange(said.relieves, nobody);
  if (robot.self.role == Role::spare || robot.self.is_worker || said.leaving || said.level == 0xFF) return;
  float best_length = relief_reach;
  for (int k = 0; k < table.size(); ++k) {
    const TreeStanding& m = table.message(k);
    const PowerStanding& other = me.standing(k);
    const bool child = up_of(m) == robot.self.id || table.id(k) == robot.self.inserted_child;
    if (!table.alive(k) || !child || !other.leaving || m.role == Role::spare || said.level <= other.level) continue;
    if (m.role == Role::worker && robot.is_root()) continue;
    const float range = table.id(k) == before ? table.range(k) / kept_within : table.range(k);
    if (range > best_length) continue;
    best_length = range;
    said.relieves = table.id(k);
  }
  // Not while somebody drives through one of my edges.
  if (before != nobody) return;
  for (int k = 0; k < table.size(); ++k)
    if (robot.is_tree_neighbor(k) && table.age(k) > 0) said.relieves = nobody;
}

// Its children may change to me only once I stand still.
void settle_in(PowerRobot& me) noexcept {
  PowerStanding& said = me.power.said;
  Vec2 spot;
  const bool there = said.relieves != nobody && find_relief_spot(me, spot) && norm(spot) <= in_place &&
                     !hides_child(me, me.robot.table().find(said.relieves));
  said.in_place = said.relieves != nobody && (said.in_place || there);
  if (said.relieves != nobody || is_parent_relieved(me)) me.robot.add_elapsed(me.power.stuck_ticks);
  else me.power.stuck_ticks = 0;
}

// A worker names its heir once that robot stands at the target, too.
void choose_heir(PowerRobot& me) noexcept {
  const HealingRobot& robot = me.robot;
  PowerStanding& said = me.power.said;
  said.heir = nobody;
  if (!said.leaving || !robot.self.is_worker || robot.target == nullptr || !has_reliever(me) ||
      robot.table().age(robot.parent) > 0)
    return;
  const float off = distance(robot.table().position(robot.parent), *robot.target);
  if (off <= surely_there * robot.params.arrival_distance) said.heir = robot.self.parent;
}

// Of the spots round the robot that leaves, the one from which the farthest of its tree neighbours is nearest, among
// those from where it hides none of them, and rather on my side of its edges: to cross one is to hide it for a moment.
Vec2 spot_beside(const PowerRobot& me, int leaver) noexcept {
  const TreeTable& table = me.robot.table();
  const Vec2 at = table.position(leaver);
  const RobotId id = table.id(leaver);
  // While it is mine already, its former parent is my parent.
  const RobotId above =
      table.message(leaver).parent == me.robot.self.id ? me.robot.self.parent : table.message(leaver).parent;
  const int parent = table.find(above);
  const Vec2 axis =
      parent >= 0 && distance(table.position(parent), at) > 0.0F ? unit(table.position(parent) - at) : Vec2{1.0F, 0.0F};
  const float room_apart = beside;
  const bool hides = me.power.unseen_ticks > 0;
  constexpr int spots = 8;  // around it, a diagonal apart
  constexpr float diagonal = 0.70710678F;
  constexpr float costs_crossing = 0.5F;
  constexpr float costs_travel = 0.1F;   // of the way there: of spots as good, the nearer
  constexpr float hidden_behind = 0.6F;  // of the distance to it: its body is so near to the line of sight
  Vec2 best = at;
  float best_cost = not_counted;
  Vec2 off = left_of(axis) * room_apart;
  for (int turn = 0; turn < spots; ++turn, off = (off + left_of(off)) * diagonal) {
    float farthest = 0.0F;
    float hidden = 0.0F;
    const auto look_at = [&](int k) {
      const Vec2 other = table.position(k) - at;
      farthest = std::max(farthest, distance(off, other));
      if (crosses(at + off, at - other, at + other)) hidden += costs_crossing;
      if (distance_to_segment(Vec2{}, off, other) < hidden_behind * room_apart) hidden += 1.0F;
    };
    if (parent >= 0) look_at(parent);
    if (hides && distance_to_segment(Vec2{}, off, me.power.unseen - at) < hidden_behind * room_apart) hidden += 1.0F;
    for (int k = 0; k < table.size(); ++k)  // its children, and those that have changed to me already
      if (k != leaver && !me.is_spare(k) &&
          (up_of(table.message(k)) == id || up_of(table.message(k)) == me.robot.self.id))
        look_at(k);
    const float cost = farthest + hidden + costs_travel * norm(at + off);
    if (cost < best_cost) best = at + off, best_cost = cost;
  }
  return best;
}

}  // namespace

bool has_reliever(const PowerRobot& me, int k) noexcept {
  const int up = me.robot.table().find(up_of(me.robot.table().message(k)));
  return up >= 0 && me.standing(up).relieves == me.robot.table().id(k);
}

void watch_relief(PowerRobot& me) noexcept {
  choose_relieved(me);
  remember_unseen_child(me);
  settle_in(me);
  choose_heir(me);
}

void hand_over_target(PowerRobot& me) noexcept {
  HealingRobot& robot = me.robot;
  const TreeTable& table = robot.table();
  const auto served_target = [&](int k) { return robot.self.healing_standings[static_cast<std::size_t>(k)].serves; };
  if (robot.self.is_worker) {
    const int k = table.find(me.power.said.heir);
    if (k >= 0 && table.age(k) == 0 && table.message(k).role == Role::worker && served_target(k) == robot.self.serves)
      yield_task(robot, table.id(k));
    return;
  }
  const int k = table.find(me.power.said.relieves);
  if (k >= 0 && table.age(k) == 0 && me.standing(k).heir == robot.self.id && table.message(k).role == Role::worker)
    inherit_task(robot, served_target(k));
}

bool is_relieved(const PowerRobot& me) noexcept {
  return me.power.said.leaving && has_reliever(me) && me.robot.table().age(me.robot.parent) <= 1;
}

bool wants_relief(const PowerRobot& me) noexcept {
  const HealingRobot& robot = me.robot;
  if (!me.power.said.leaving || robot.parent < 0 || has_reliever(me)) return false;
  return is_first(me, robot.parent) && banyan::all_of(robot.children, [&](int k) { return is_first(me, k); });
}

bool may_relieve(const PowerRobot& me, int leaver, int parent, FunctionRef<bool(int)> in_sight) noexcept {
  const TreeTable& table = me.robot.table();
  if (hides_child(me, leaver) || table.range(leaver) > relief_reach || table.range(parent) > longest_taken ||
      !in_sight(parent))
    return false;
  for (int k = 0; k < table.size(); ++k)
    if (table.message(k).parent == table.id(leaver) && !me.is_spare(k) &&
        (table.range(k) > longest_taken || !in_sight(k)))
      return false;
  return true;
}

bool is_stuck(const PowerRobot& me) noexcept {
  constexpr float patience_drives = 0.6F;  // so long it waits beside the leaver
  const HealingRobot& robot = me.robot;
  return me.power.stuck_ticks > robot.params.rounds(patience_drives) && robot.parent >= 0 &&
         robot.table().range(robot.parent) > slack_below;
}

int successor_of_parent(const PowerRobot& me, FunctionRef<bool(int)> may_be_parent) noexcept {
  const HealingRobot& robot = me.robot;
  if (!is_parent_relieved(me)) return -1;
  const int k = robot.table().find(up_of(robot.table().message(robot.parent)));
  return me.standing(k).in_place && may_be_parent(k) ? k : -1;
}

bool find_relief_spot(const PowerRobot& me, Vec2& spot) noexcept {
  HealingRobot& robot = me.robot;
  const TreeTable& table = robot.table();
  const float room_apart = side_by_side * robot.params.body_radius;
  if (has_reliever(me) && me.power.said.leaving) {
    if (!robot.self.is_worker || robot.target == nullptr) return spot = {}, true;
    return spot = *robot.target - unit(table.position(robot.parent)) * room_apart, true;
  }
  const int k = leaver_of(me);
  if (k < 0) return false;
  const Task* task = find_task(robot.self, robot.self.healing_standings[static_cast<std::size_t>(k)].serves);
  const bool at_target = table.message(k).role == Role::worker && task != nullptr && !task->unlocated;
  spot = at_target && robot.self.role != Role::spare ? task->target - unit(table.position(k)) * room_apart
                                                     : spot_beside(me, k);
  return true;
}

}  // namespace banyan
