// SPDX-License-Identifier: MIT
// My charge, whether I have to leave the tree, and, for spares, the way to a charging place.
#include <algorithm>
#include <utility>

#include "healing/healing.hpp"
#include "power/power.hpp"

namespace banyan {
namespace {

constexpr float full_charge = 0.98F;          // of a battery
constexpr float level_unit = 254.0F;          // a full battery in a message
constexpr float charge_smoothing = 0.1F;      // per step, of a measured charge
constexpr std::uint8_t farthest_place = 250;  // hops: so far the way is told
constexpr float at_place = 0.2F;              // of C, from the robot that keeps the place
constexpr float in_slot = 0.3F;               // while it is charged
constexpr float per_hop = 0.05F;              // of a full battery
constexpr int near_hops = 2;                  // up to here a place costs nothing,
constexpr int farther_hops = 6;               // and at most so many more count
constexpr float way_per_hop = 0.02F;          // of a full battery: what the way takes
constexpr int most_hops_counted = 12;         // farther places count as this far
constexpr int waits_within = 2;               // hops of a place: there charged spares wait
constexpr float leaves_sooner = 0.35F;        // of a full battery, at most
constexpr std::uint8_t calls_end = 60;        // hops
constexpr int turns = 16;
constexpr float urgent_level = 0.5F;  // a robot with less is let through to the place
constexpr float place_room = 0.4F;    // of C: kept free round it by those that are charged

void measure_charge(PowerRobot& me, const std::optional<Charge>& charge, const Orders& orders) noexcept {
  PowerState& power = me.power;
  power.charging = charge && charge->charging;
  power.was_charged |= power.charging;
  if (charge) {
    const float level = charge->level;
    power.level = power.level < 0.0F ? level : power.level + (level - power.level) * charge_smoothing;
    power.said.level = static_cast<std::uint8_t>(power.level * level_unit + 0.5F);
  }
  // A successor is not told that its target is a charging place: it notices.
  const HealingState& self = me.robot.self;
  power.keeps_place =
      self.is_worker && (power.keeps_place || power.charging || (orders.charging_place && self.serves == self.id));
}

// Hops from robot to robot, as for calls (protocol 7): the keeper of a place counts 0.
void follow_places(PowerRobot& me) noexcept {
  const HealingRobot& robot = me.robot;
  const TreeTable& table = robot.table();
  const bool there =
      me.power.keeps_place && robot.target != nullptr && norm(*robot.target) <= robot.params.arrival_distance;
  std::uint8_t hops = no_place;
  for (int k = 0; k < table.size() && !there; ++k)
    if (table.alive(k)) hops = std::min(hops, me.standing(k).place_hops);
  me.power.said.place_hops = there                   ? std::uint8_t{0}
                             : hops < farthest_place ? static_cast<std::uint8_t>(hops + 1)
                                                     : no_place;
}

// Spares followed calls that had ended to nowhere for minutes. So only what has just been heard counts, and no call
// goes farther than a relief may be.
void listen_for_calls(PowerRobot& me) noexcept {
  me.robot.call_hops =
      live_call_hops(me.robot.table(), [](std::uint8_t hops) { return hops < calls_end || hops >= companion_call; });
}

int hops_counted(const PowerRobot& me) noexcept { return std::min<int>(me.power.said.place_hops, most_hops_counted); }

// What a robot of the tree needs while it waits to be relieved, and for its way to the place.
float least_charge(const PowerRobot& me) noexcept {
  return me.params.relieve_below + way_per_hop * static_cast<float>(hops_counted(me));
}

// All have started full, and are not to leave at once. Who has been charged since then has a turn of its own.
float leave_below(const PowerRobot& me) noexcept {
  constexpr unsigned spread = 37;  // so that ids next to each other are far apart
  constexpr float margin = 0.05F;
  const float least = least_charge(me);
  if (me.power.was_charged) return least;
  const auto turn = static_cast<float>(me.robot.self.id * spread % turns) / static_cast<float>(turns);
  return std::min(least + leaves_sooner * turn, std::max(least, me.params.ready_above - margin));
}

// It stays decided until the robot is a spare, or has been charged where it is.
void decide_to_leave(PowerRobot& me) noexcept {
  PowerState& power = me.power;
  const bool in_tree = me.robot.self.role != Role::spare;
  const bool low = power.level >= 0.0F && power.level < leave_below(me) && !power.charging && !power.keeps_place;
  power.said.leaving = in_tree && (power.said.leaving ? power.level < full_charge && !power.keeps_place : low);
  // The farther the place, the less often: the way itself takes charge.
  const float hops = static_cast<float>(std::clamp<int>(power.said.place_hops - near_hops, 0, farther_hops));
  const float below = std::max(me.params.charge_below - per_hop * hops, me.params.relieve_below);
  const bool wants = power.level >= 0.0F && power.level < (power.seeks ? full_charge : below);
  power.seeks = !in_tree && wants;
  // One that has set out may use up on its way what it would not need there: turning back would be in vain.
  constexpr float margin = 0.05F;
  const bool under_way = !in_tree && (me.robot.self.called || me.robot.self.request != nobody);
  power.ready =
      power.level >= (under_way ? std::min(least_charge(me) + margin, me.params.ready_above) : me.params.ready_above);
}

// How far the place is through neighbour k, in half hops: spares move themselves.
int half_hops(const PowerRobot& me, int k) noexcept {
  const std::uint8_t hops = me.standing(k).place_hops;
  return hops > farthest_place / 2 ? no_place : 2 * hops + (me.is_spare(k) ? 1 : 0);
}

// The nearest of the neighbours through which a charging place is nearest; -1: no way known.
int way_to_place(const PowerRobot& me) noexcept {
  const TreeTable& table = me.robot.table();
  int best = -1;
  for (int k = 0; k < table.size(); ++k) {
    if (!table.alive(k) || half_hops(me, k) == no_place) continue;
    const auto key = [&](int n) { return std::pair(half_hops(me, n), table.range(n)); };
    if (best < 0 || key(k) < key(best)) best = k;
  }
  return best;
}

// Bodies hide the robots ahead again and again. A robot that turned to another one each time would get nowhere. So it
// drives to where the one that it has chosen was, until it is there or hears one that is nearer to the place.
void choose_way(PowerRobot& me) noexcept {
  constexpr float reached = 0.18F;  // of C
  constexpr float patience_drives = 1.0F;
  PowerState& power = me.power;
  const HealingRobot& robot = me.robot;
  const TreeTable& table = robot.table();
  const int k = way_to_place(me);
  robot.add_elapsed(power.way_ticks);
  const int now = table.find(power.way_id);
  if (now >= 0 && table.age(now) == 0) {
    power.way = table.position(now);
    if (half_hops(me, now) > power.way_hops) power.way_id = nobody;
  }
  const bool there = norm(power.way) < reached && power.way_hops > 0;
  if (k >= 0 && (power.way_id == nobody || there || power.way_ticks > robot.params.rounds(patience_drives) ||
                 half_hops(me, k) < power.way_hops)) {
    power.way = table.position(k);
    power.way_hops = static_cast<std::uint8_t>(half_hops(me, k));
    power.way_id = table.id(k);
    power.way_ticks = 0;
  }
}

// Neighbour k is a spare that could go in my stead: charged, free, and it hears the call.
bool may_go(const PowerRobot& me, int k) noexcept {
  const TreeTable& table = me.robot.table();
  const TreeStanding& m = table.message(k);
  return table.alive(k) && me.is_spare(k) && m.parent == nobody && m.request == nobody &&
         m.call_hops <= me.robot.call_hops + 1 && is_charged(me, k);
}

// A crowd on its way to one call wastes charge and hides edges: only the nearest that I know of goes.
bool leaves_call_to_others(const PowerRobot& me) noexcept {
  const TreeTable& table = me.robot.table();
  const int way = table.find(me.robot.self.reference);
  for (int k = 0; way >= 0 && k < table.size(); ++k)
    if (may_go(me, k) && distance(table.position(k), table.position(way)) < table.range(way)) return true;
  return false;
}

// Where it is useful: near a place it stays full until it is called.
void wait_near_place(PowerRobot& me) noexcept {
  const int k = me.power.said.place_hops > waits_within ? way_to_place(me) : -1;
  if (k < 0) return;
  me.robot.self.reference = me.robot.table().id(k);
  me.robot.self.called = true;
}

// I wait for a slot, and a spare near me needs one more.
bool lets_through(const PowerRobot& me) noexcept {
  const TreeTable& table = me.robot.table();
  if (me.power.charging || me.power.level < urgent_level) return false;
  for (int k = 0; k < table.size(); ++k)
    if (me.is_spare(k) && table.alive(k) && static_cast<float>(me.standing(k).level) < urgent_level * level_unit &&
        table.range(k) < place_room)
      return true;
  return false;
}

}  // namespace

void watch_charge(PowerRobot& me, const std::optional<Charge>& charge, const Orders& orders) noexcept {
  measure_charge(me, charge, orders);
  me.power.way = me.robot.carry.point(me.power.way);
  follow_places(me);
  listen_for_calls(me);
  decide_to_leave(me);
}

void tend_battery(PowerRobot& me) noexcept {
  TreeState& self = me.robot.self;
  me.power.travels = false;
  if (!me.power.seeks) me.power.way_id = nobody;
  if (self.role != Role::spare || self.parent != nobody || me.power.level < 0.0F) return;
  if (!me.power.ready) {
    self.request = nobody;
    self.called = false;
    self.spare_state = SpareState::adjust_position;
  }
  if (self.called && leaves_call_to_others(me)) self.called = false;
  if (self.request != nobody || self.called) return;
  if (!me.power.seeks) return wait_near_place(me);
  choose_way(me);
  if (me.power.way_id == nobody) return;
  self.reference = me.power.way_id;
  me.power.travels = self.called = !is_at_place(me);
}

void call_for_relief(PowerRobot& me) noexcept {
  constexpr float urgent_at = 0.1F;         // of a full battery
  constexpr float hops_of_battery = 20.0F;  // a full one can wait as if it were so much farther away
  TreeState& self = me.robot.self;
  if (self.call_hops != 0) return;
  const float waits = (me.power.level - urgent_at) * hops_of_battery - static_cast<float>(hops_counted(me));
  const int hops = relief_call + static_cast<int>(std::max(0.0F, waits));
  self.call_hops = static_cast<std::uint8_t>(std::min(hops, me.robot.call_hops + 1));
}

bool leaves_place(const PowerRobot& me, Vec2& away) noexcept {
  const TreeTable& table = me.robot.table();
  const float room = place_room;
  if ((me.power.seeks && !lets_through(me)) || (me.robot.self.called && !me.power.travels) ||
      me.robot.self.request != nobody)
    return false;
  for (int k = 0; k < table.size(); ++k) {
    if (!table.alive(k) || me.standing(k).place_hops != 0 || table.range(k) >= room) continue;
    away = unit(table.position(k)) * -1.0F;
    return true;
  }
  return false;
}

bool is_charged(const PowerRobot& me, int k) noexcept {
  const std::uint8_t level = me.standing(k).level;
  return level != 0xFF && !me.standing(k).leaving && static_cast<float>(level) >= me.params.ready_above * level_unit;
}

bool may_inherit_root(const PowerRobot& me, int k) noexcept {
  constexpr float urgent = 0.38F;  // of a full battery
  constexpr float more = 0.06F;
  constexpr float spare_charge = 0.3F;
  if (is_charged(me, k)) return true;
  const PowerStanding& other = me.standing(k);
  if (other.level == 0xFF) return false;
  const float level = static_cast<float>(other.level) / level_unit;
  if (me.power.said.leaving) return me.power.level <= urgent && level >= me.power.level + more;
  return !other.leaving && level >= me.params.relieve_below + spare_charge;
}

bool is_at_place(const PowerRobot& me) noexcept {
  const PowerState& power = me.power;
  return power.seeks && power.way_id != nobody && power.way_hops == 0 &&
         norm(power.way) <= (power.charging ? in_slot : at_place);
}

}  // namespace banyan
