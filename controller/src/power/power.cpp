// SPDX-License-Identifier: MIT
#include "banyan/controller/power/power.hpp"

#include <algorithm>
#include <utility>

#include "banyan/controller/healing/healing.hpp"

namespace banyan {
namespace {

constexpr float full_charge = 0.98F;
constexpr float level_unit = 254.0F;
constexpr float charge_smoothing = 0.1F;      // per step, of a measured charge
constexpr std::uint8_t farthest_place = 250;
constexpr float at_place = 0.2F;       // of C, from the robot that keeps the place
constexpr float in_place = 0.05F;      // of C: near enough to its spot
constexpr float slack_below = 0.6F;    // of C: an edge this short has slack
constexpr float per_hop = 0.05F;       // of a full battery
constexpr int near_hops = 2;
constexpr int most_hops_counted = 6;
constexpr int inner_depth = 3;         // of the tree: from there a spare is soon at every branch
constexpr float way_to_edge = 0.15F;   // of a full battery: so much a spare may spend on its way
constexpr float urgent_level = 0.5F;   // whoever has less is let through to the place
constexpr float place_room = 0.4F;     // of C: kept free round it by those that are charged
constexpr float beside = 0.12F;        // of C: how far from the robot that it relieves a spare takes its place
constexpr float relief_reach = 0.2F;    // of C: from there it may
constexpr float longest_taken = 0.925F;        // of C: longest edge that a reliever takes on
constexpr float side_by_side = 0.8F;   // of the distance between the wheels: two robots at one target
constexpr float surely_there = 0.9F;   // of the tolerance

bool is_spare(const PowerRobot& me, int k) noexcept { return me.robot.table().message(k).role == Role::spare; }

// A neighbour that leaves and has me as parent, in whose place I am or will be.
int relieved(const PowerRobot& me) noexcept {
  const TreeTable& table = me.robot.table();
  const int k = me.power.said.relieves == nobody ? -1 : table.find(me.power.said.relieves);
  return k >= 0 && table.alive(k) && me.standing(k).leaving ? k : -1;
}

// My parent takes my place.
bool has_reliever(const PowerRobot& me) noexcept {
  return me.robot.parent_alive() && me.standing(me.robot.parent).relieves == me.robot.self.id;
}

// Another robot takes my parent's place.
bool is_parent_relieved(const PowerRobot& me) noexcept {
  const TreeTable& table = me.robot.table();
  const RobotId above = table.message(me.robot.parent).parent;
  const int k = above == nobody ? -1 : table.find(above);
  return k >= 0 && me.standing(k).relieves == me.robot.self.parent;
}

void measure_charge(PowerRobot& me, const Senses& senses) noexcept {
  PowerState& power = me.power;
  power.charging = senses.charge && senses.charge->charging;
  if (senses.charge) {
    const float level = senses.charge->level;
    power.level = power.level < 0.0F ? level : power.level + (level - power.level) * charge_smoothing;
    power.said.level = static_cast<std::uint8_t>(power.level * level_unit + 0.5F);
  }
  // A successor is not told that its target is a charging place: it notices.
  const HealingState& self = me.robot.self;
  power.keeps_place = self.is_worker && (power.keeps_place || power.charging || (senses.orders.charging_place && self.serves == self.id));
}

// Hops from robot to robot, as for calls (protocol 7): the keeper of a place counts 0.
void follow_places(PowerRobot& me) noexcept {
  const HealingRobot& robot = me.robot;
  const TreeTable& table = robot.table();
  const bool there = me.power.keeps_place && robot.target != nullptr && norm(*robot.target) <= robot.params.arrival_distance_m;
  std::uint8_t hops = no_place;
  for (int k = 0; k < table.size() && !there; ++k)
    if (table.alive(k)) hops = std::min(hops, me.standing(k).place_hops);
  me.power.said.place_hops = there ? std::uint8_t{0} : hops < farthest_place ? static_cast<std::uint8_t>(hops + 1) : no_place;
}

// It stays decided until the robot is a spare, or has been charged where it is.
void decide_to_leave(PowerRobot& me) noexcept {
  PowerState& power = me.power;
  const bool in_tree = me.robot.self.role != Role::spare;
  const bool low = power.level >= 0.0F && power.level < me.params.relieve_below && !power.charging && !power.keeps_place;
  power.said.leaving = in_tree && (power.said.leaving ? power.level < full_charge && !power.keeps_place : low);
  // The farther the place, the less often: the way itself takes charge.
  const float hops = static_cast<float>(std::clamp<int>(power.said.place_hops - near_hops, 0, most_hops_counted));
  const float below = std::max(me.params.charge_below - per_hop * hops, me.params.relieve_below);
  const bool wants = power.level >= 0.0F && power.level < (power.seeks ? full_charge : below);
  power.seeks = !in_tree && wants;
  power.ready = power.level >= me.params.ready_above - (power.ready ? way_to_edge : 0.0F);
}

// Whoever stands right above a robot that leaves, and has more charge, takes its place, however it came there: a spare
// that joined for it, or the robot that happens to be there. Nothing has to be remembered over a reconstruction.
void choose_relieved(PowerRobot& me) noexcept {
  constexpr float kept_within = 1.5F;  // times relief_reach
  const HealingRobot& robot = me.robot;
  const TreeTable& table = robot.table();
  PowerStanding& said = me.power.said;
  const RobotId before = std::exchange(said.relieves, nobody);
  if (robot.self.role == Role::spare || robot.self.is_worker || said.leaving || said.level == 0xFF) return;
  float best_m = relief_reach * robot.params.communication_range_m;
  for (int k = 0; k < table.size(); ++k) {
    const TreeStanding& m = table.message(k);
    const PowerStanding& other = me.standing(k);
    const bool child = up_of(m) == robot.self.id || table.id(k) == robot.self.inserted_child;
    if (!table.alive(k) || !child || !other.leaving || m.role == Role::spare || said.level <= other.level) continue;
    if (m.role == Role::worker && robot.is_root()) continue;
    const float range_m = table.id(k) == before ? table.range(k) / kept_within : table.range(k);
    if (range_m > best_m) continue;
    best_m = range_m;
    said.relieves = table.id(k);
  }
}

// A worker names its heir once that robot stands at the target, too.
void choose_heir(PowerRobot& me) noexcept {
  const HealingRobot& robot = me.robot;
  PowerStanding& said = me.power.said;
  said.heir = nobody;
  if (!said.leaving || !robot.self.is_worker || robot.target == nullptr || !has_reliever(me) || robot.table().age(robot.parent) > 0) return;
  const float off_m = distance(robot.table().position(robot.parent), *robot.target);
  if (off_m <= surely_there * robot.params.arrival_distance_m) said.heir = robot.self.parent;
}

// Of robots next to each other that have to leave, the emptier one goes first: a place that two robots of an edge
// leave at once would be empty.
bool is_first(const PowerRobot& me, int k) noexcept {
  const PowerStanding& other = me.standing(k);
  if (!other.leaving || !me.robot.table().alive(k)) return true;
  return me.power.said.level != other.level ? me.power.said.level < other.level : me.robot.self.id < me.robot.table().id(k);
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

// Of the spots round the robot that leaves, the one from which the farthest of its tree neighbours is nearest, among those
// from where it hides none of them.
Vec2 spot_beside(const PowerRobot& me, int leaver) noexcept {
  const TreeTable& table = me.robot.table();
  const Vec2 at = table.position(leaver);
  const RobotId id = table.id(leaver);
  // While it is mine already, its former parent is my parent.
  const RobotId above = table.message(leaver).parent == me.robot.self.id ? me.robot.self.parent : table.message(leaver).parent;
  const int parent = above == nobody ? -1 : table.find(above);
  const Vec2 axis = parent >= 0 && distance(table.position(parent), at) > 0.0F ? unit(table.position(parent) - at) : Vec2{1.0F, 0.0F};
  const float range_m = me.robot.params.communication_range_m;
  const float apart_m = beside * range_m;
  const bool hides = hides_child(me, leaver);
  constexpr float diagonal = 0.70710678F;
  constexpr float hidden_behind = 0.6F;  // of the distance to it: its body is so near to the line of sight
  constexpr Vec2 directions[] = {{0.0F, 1.0F}, {0.0F, -1.0F}, {diagonal, diagonal}, {diagonal, -diagonal}, {-diagonal, diagonal}, {-diagonal, -diagonal}, {1.0F, 0.0F}, {-1.0F, 0.0F}};
  Vec2 best = at;
  float best_cost = 1e9F;
  for (const Vec2 d : directions) {
    const Vec2 off = (axis * d.x + left_of(axis) * d.y) * apart_m;
    float farthest_m = 0.0F;
    float hidden_m = 0.0F;
    const auto look_at = [&](int k) {
      const Vec2 other = table.position(k) - at;
      farthest_m = std::max(farthest_m, distance(off, other));
      if (norm(nearest_on_segment(off, other)) < hidden_behind * apart_m) hidden_m += range_m;
    };
    if (parent >= 0) look_at(parent);
    // A child that I do not hear is right behind it, seen from here.
    if (hides && norm(nearest_on_segment(off, unit(at) * range_m)) < hidden_behind * apart_m) hidden_m += range_m;
    for (int k = 0; k < table.size(); ++k)  // its children, and those that have changed to me already
      if (k != leaver && !is_spare(me, k) && (table.message(k).parent == id || up_of(table.message(k)) == me.robot.self.id)) look_at(k);
    const float cost = farthest_m + hidden_m + 0.1F * norm(at + off);
    if (cost < best_cost) best = at + off, best_cost = cost;
  }
  return best;
}

// The nearest of the neighbours through which a charging place is nearest; -1: no way known.
int way_to_place(const PowerRobot& me) noexcept {
  const TreeTable& table = me.robot.table();
  int best = -1;
  for (int k = 0; k < table.size(); ++k) {
    if (!table.alive(k) || me.standing(k).place_hops > farthest_place) continue;
    const auto key = [&](int n) { return std::pair(me.standing(n).place_hops, table.range(n)); };
    if (best < 0 || key(k) < key(best)) best = k;
  }
  return best;
}

// Where it is useful: where the branches meet.
void wait_near_root(PowerRobot& me) noexcept {
  const TreeTable& table = me.robot.table();
  int best = -1;
  for (int k = 0; k < table.size(); ++k) {
    const TreeStanding& m = table.message(k);
    if (!table.alive(k) || m.role == Role::spare || m.depth == invalid_depth) continue;
    if (best < 0 || m.depth < table.message(best).depth) best = k;
  }
  if (best < 0 || table.message(best).depth <= inner_depth) return;
  me.robot.self.reference = table.id(best);
  me.robot.self.called = true;
}

// I wait for a slot, and a spare near me needs one more.
bool lets_through(const PowerRobot& me) noexcept {
  const TreeTable& table = me.robot.table();
  if (me.power.charging || me.power.level < urgent_level) return false;
  for (int k = 0; k < table.size(); ++k)
    if (is_spare(me, k) && table.alive(k) && static_cast<float>(me.standing(k).level) < urgent_level * level_unit && table.range(k) < place_room * me.robot.params.communication_range_m) return true;
  return false;
}

}  // namespace

void hand_over_target(PowerRobot& me) noexcept {
  HealingRobot& robot = me.robot;
  const TreeTable& table = robot.table();
  const auto served_target = [&](int k) { return robot.self.healing_standings[static_cast<std::size_t>(k)].serves; };
  if (robot.self.is_worker) {
    const int k = me.power.said.heir == nobody ? -1 : table.find(me.power.said.heir);
    if (k >= 0 && table.age(k) == 0 && table.message(k).role == Role::worker && served_target(k) == robot.self.serves) yield_task(robot, table.id(k));
    return;
  }
  const int k = me.power.said.relieves == nobody ? -1 : table.find(me.power.said.relieves);
  if (k >= 0 && table.age(k) == 0 && me.standing(k).heir == robot.self.id && table.message(k).role == Role::worker) inherit_task(robot, served_target(k));
}

bool is_relieved(const PowerRobot& me) noexcept { return me.power.said.leaving && has_reliever(me) && me.robot.table().age(me.robot.parent) <= 1; }

// Its children may change to me only once I stand still.
void settle_in(PowerRobot& me) noexcept {
  PowerStanding& said = me.power.said;
  Vec2 spot;
  const bool there = said.relieves != nobody && find_relief_spot(me, spot) && norm(spot) <= in_place * me.robot.params.communication_range_m &&
                     !hides_child(me, me.robot.table().find(said.relieves));
  said.in_place = said.relieves != nobody && (said.in_place || there);
  const bool waits = me.robot.parent >= 0 && me.standing(me.robot.parent).leaving && is_parent_relieved(me);
  if (said.relieves != nobody || waits) me.robot.add_elapsed(me.power.stuck_ticks);
  else me.power.stuck_ticks = 0;
}

void watch_charge(PowerRobot& me, const Senses& senses) noexcept {
  measure_charge(me, senses);
  follow_places(me);
  decide_to_leave(me);
  choose_relieved(me);
  settle_in(me);
  choose_heir(me);
}

bool wants_relief(const PowerRobot& me) noexcept {
  const HealingRobot& robot = me.robot;
  if (!me.power.said.leaving || robot.parent < 0 || has_reliever(me)) return false;
  return is_first(me, robot.parent) && std::all_of(robot.children.begin(), robot.children.end(), [&](int k) { return is_first(me, k); });
}

bool may_relieve(const PowerRobot& me, int leaver, int parent, FunctionRef<bool(int)> in_sight) noexcept {
  const TreeTable& table = me.robot.table();
  const float c = me.robot.params.communication_range_m;
  if (hides_child(me, leaver) || table.range(leaver) > relief_reach * c || table.range(parent) > longest_taken * c || !in_sight(parent)) return false;
  for (int k = 0; k < table.size(); ++k)
    if (table.message(k).parent == table.id(leaver) && !is_spare(me, k) && (table.range(k) > longest_taken * c || !in_sight(k))) return false;
  return true;
}

bool is_stuck(const PowerRobot& me) noexcept {
  constexpr float patience_s = 6.0F;
  const HealingRobot& robot = me.robot;
  return me.power.stuck_ticks > robot.params.ticks(patience_s) && robot.parent >= 0 && robot.table().range(robot.parent) > slack_below * robot.params.communication_range_m;
}

int successor_of_parent(const PowerRobot& me, FunctionRef<bool(int)> may_be_parent) noexcept {
  const HealingRobot& robot = me.robot;
  if (robot.parent < 0 || !me.standing(robot.parent).leaving || !is_parent_relieved(me)) return -1;
  const int k = robot.table().find(robot.table().message(robot.parent).parent);
  return me.standing(k).in_place && may_be_parent(k) ? k : -1;
}

bool find_relief_spot(const PowerRobot& me, Vec2& spot) noexcept {
  HealingRobot& robot = me.robot;
  const TreeTable& table = robot.table();
  const float apart_m = side_by_side * robot.params.wheel_distance_m;
  if (has_reliever(me) && me.power.said.leaving) {
    if (!robot.self.is_worker || robot.target == nullptr) return spot = {}, true;
    return spot = *robot.target - unit(table.position(robot.parent)) * apart_m, true;
  }
  int k = relieved(me);
  if (k < 0 && robot.self.role == Role::spare && robot.self.spare_state == SpareState::extend_edge && robot.self.request != nobody)
    k = table.find(robot.self.request);
  if (k < 0 || !me.standing(k).leaving) return false;
  const Task* task = find_task(robot.self, robot.self.healing_standings[static_cast<std::size_t>(k)].serves);
  const bool at_target = table.message(k).role == Role::worker && task != nullptr && !task->unlocated;
  spot = at_target && robot.self.role != Role::spare ? task->target - unit(table.position(k)) * apart_m : spot_beside(me, k);
  return true;
}

void tend_battery(PowerRobot& me) noexcept {
  TreeState& self = me.robot.self;
  me.power.travels = false;
  if (self.role != Role::spare || self.parent != nobody || me.power.level < 0.0F) return;
  if (!me.power.ready) {
    self.request = nobody;
    self.called = false;
    self.spare_state = SpareState::adjust_position;
  }
  if (self.request != nobody || self.called) return;
  if (!me.power.seeks) return wait_near_root(me);
  const int k = way_to_place(me);
  if (k < 0) return;
  self.reference = me.robot.table().id(k);
  me.power.travels = self.called = !is_at_place(me);
}

bool leaves_place(const PowerRobot& me, Vec2& away) noexcept {
  const TreeTable& table = me.robot.table();
  const float room_m = place_room * me.robot.params.communication_range_m;
  if ((me.power.seeks && !lets_through(me)) || (me.robot.self.called && !me.power.travels) || me.robot.self.request != nobody) return false;
  for (int k = 0; k < table.size(); ++k) {
    if (!table.alive(k) || me.standing(k).place_hops != 0 || table.range(k) >= room_m) continue;
    away = unit(table.position(k)) * -1.0F;
    return true;
  }
  return false;
}

bool is_charged(const PowerRobot& me, int k) noexcept {
  const std::uint8_t level = me.standing(k).level;
  return level != 0xFF && !me.standing(k).leaving && static_cast<float>(level) >= me.params.ready_above * level_unit;
}

bool is_at_place(const PowerRobot& me) noexcept {
  const int k = me.robot.table().find(me.robot.self.reference);
  return me.power.seeks && k >= 0 && me.standing(k).place_hops == 0 && me.robot.table().range(k) <= at_place * me.robot.params.communication_range_m;
}

}  // namespace banyan
