// SPDX-License-Identifier: MIT
#include "convoy/companions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "banyan/controller/core/search.hpp"
#include "banyan/controller/core/trig.hpp"
#include "convoy/folding.hpp"
#include "convoy/towing.hpp"
#include "healing/healing.hpp"
#include "obstacles/bypass.hpp"
#include "tree/label.hpp"

namespace banyan {
namespace {

constexpr float short_for_drives = 1.0F;  // an edge in need has called for so long: its tree comes before companions
constexpr int call_reach_hops_each = 40;  // of calls by edges, and of those for companions
constexpr int lacks_after_ticks = 3;      // it may just not have heard its companion
constexpr int stand_in = 3;    // times the silence after which a robot counts as dead: so long its companion stays
constexpr float aside = 1.3F;  // of `clearance`: so far out of a line a robot steps that is in the way
// Of `clearance`: how near to edges a companion in its place comes, since it may have to cross.
constexpr float edge_room = 1.4F;
constexpr int places = 12;              // around the robot of the tree
constexpr float bridged = 0.75F;        // of C: two tree neighbours of a robot so near to each other do without it,
constexpr float bridged_on_way = 0.4F;  // and for some time to come while a worker below still has to travel
constexpr float reach = 0.97F;          // of C: a companion relies on no longer link
constexpr float unheard_at = 0.9F;      // of C: so far away a tree neighbour that is not heard is supposed to be
constexpr float hides = 0.6F;           // of `clearance`: a robot so near to a link hides it
constexpr float near_place = 0.05F;     // of C: within it the companion slows down
constexpr float keeps_off = 0.8F;       // of companion_distance: nearer it is driven away from the robot of the tree
constexpr float from_afar = 2.0F;       // times companion_distance: farther it is still on its way
constexpr float least_range = 0.025F;   // no robots are nearer to each other
constexpr float even = 0.5F;            // of companion_distance: of two companions none is the nearer by less
// Of a length by which a place is better: the way there, so that it does not change its mind.
constexpr float costs_way = 0.15F;
constexpr float costs_hidden = 0.5F;  // of C: what a hidden neighbour weighs against the distance of others
constexpr float costs_crowd = 0.25F;  // of C: likewise a robot at that place, or an edge through it

float bridged_reach(const ConvoyRobot& robot) noexcept { return may_fold(robot) ? folded_reach : bridged; }

// Two robots at a and b hear each other without the one at `middle`, whose body stays where it is, even if it dies.
bool hear_each_other(const ConvoyRobot& robot, Vec2 middle, Vec2 a, Vec2 b, bool travels) noexcept {
  if (robot.params.line_of_sight && distance_to_segment(middle, a, b) < hides * robot.params.clearance) return false;
  const float on_way = bridged_on_way;
  return distance(a, b) <= (travels ? on_way : bridged_reach(robot));
}

// Where the tree neighbours of a robot are.
struct EdgeEnds {
  std::array<Vec2, neighbor_capacity + 1> at;
  std::size_t size = 0;
  void add(Vec2 end) noexcept { at[size++] = end; }
  [[nodiscard]] std::span<const Vec2> all() const noexcept { return std::span(at).first(size); }
};

// The tree neighbours of robot `of` that I know, where `up` is its parent.
EdgeEnds known_ends(const ConvoyRobot& robot, RobotId of, RobotId up) noexcept {
  const TreeTable& table = robot.table();
  EdgeEnds ends;
  for (int k = 0; k < table.size(); ++k) {
    if (!table.alive(k)) continue;
    const TreeStanding& m = table.message(k);
    if (table.id(k) == up || (m.role != Role::spare && up_of(m) == of)) ends.add(table.position(k));
  }
  return ends;
}

EdgeEnds known_ends_around(const ConvoyRobot& robot, int of) noexcept {
  return known_ends(robot, robot.table().id(of), up_of(robot.table().message(of)));
}

// Some of these are joined to others of them by the robot at `middle` alone. A tree of links that do without it is
// grown from the first.
bool holds_together(const ConvoyRobot& robot, Vec2 middle, std::span<const Vec2> ends, bool travels) noexcept {
  std::array<bool, neighbor_capacity + 1> joined{};
  if (!ends.empty()) joined[0] = true;
  for (std::size_t round = 1; round < ends.size(); ++round) {
    bool grown = false;
    for (std::size_t i = 0; i < ends.size() && !grown; ++i)
      for (std::size_t j = 0; joined[i] && j < ends.size() && !grown; ++j)
        if (!joined[j] && hear_each_other(robot, middle, ends[i], ends[j], travels)) joined[j] = grown = true;
    if (!grown) return true;
  }
  return false;
}

bool is_free(const TreeStanding& m) noexcept { return m.role == Role::spare && m.parent == nobody; }

bool accompanies(const ConvoyRobot& robot, int j, RobotId of) noexcept {
  const TreeTable& table = robot.table();
  return table.alive(j) && table.message(j).role == Role::spare && robot.convoy_of(j).below == of;
}

// Of the companions of neighbour k, those that stay rather than I: they are much nearer to it or, where that decides
// nothing, have smaller ids.
int count_before_me(const ConvoyRobot& robot, int k) noexcept {
  const TreeTable& table = robot.table();
  const float even_length = even * robot.params.companion_distance;
  int count = 0;
  for (int j = 0; j < table.size(); ++j) {
    if (!accompanies(robot, j, table.id(k))) continue;
    const float behind = table.range(k) - distance(table.position(j), table.position(k));
    if (behind > even_length || (behind > -even_length && table.id(j) < robot.self.id)) ++count;
  }
  return count;
}

int wanted_companions(const ConvoyRobot& robot) noexcept { return robot.params.link_redundancy - 1; }

// While a worker below it still travels, neighbour k has one more than it needs: a reserve that comes along, for robots
// that need one when the other spares are far behind. Where robots hide edges, reserves would.
int welcome_companions(const ConvoyRobot& robot, int k) noexcept {
  const bool reserve = robot.table().message(k).want > 0 && !robot.params.line_of_sight;
  return wanted_companions(robot) + (reserve ? 1 : 0);
}

// Neighbour k says that it lacks companions. Where robots hide others, only it can know.
bool says_it_lacks(const ConvoyRobot& robot, int k) noexcept {
  const TreeStanding& m = robot.table().message(k);
  return m.role != Role::spare && m.request == robot.table().id(k);
}

// Of the spares that I hear, one that is free or stands beside robot `of` is nearer to neighbour k: it will go there,
// or take another one soon.
bool another_is_nearer(const ConvoyRobot& robot, int k, RobotId of) noexcept {
  const TreeTable& table = robot.table();
  for (int j = 0; j < table.size(); ++j) {
    if (!table.alive(j) || !is_free(table.message(j))) continue;
    if (distance(table.position(j), table.position(k)) >= table.range(k)) continue;
    const RobotId beside = robot.convoy_of(j).below;
    if (beside == nobody || beside == of) return true;
  }
  return false;
}

// A child of the robot beside which I stand lacks a companion, and no spare is nearer: I go there. My place is filled
// in the same way, and so on towards the root, where the spares are; all of them drive at once.
RobotId farther_out(const ConvoyRobot& robot) noexcept {
  const TreeTable& table = robot.table();
  const int best = least_of(table.size(), not_counted, [&](int k) {
    const bool lacks = table.alive(k) && up_of(table.message(k)) == robot.self.accompanies && says_it_lacks(robot, k);
    const bool mine = lacks && count_companions(robot, table.id(k)) < wanted_companions(robot);
    return mine && !another_is_nearer(robot, k, robot.self.accompanies) ? table.range(k) : not_counted;
  });
  return best < 0 ? robot.self.accompanies : table.id(best);
}

// The nearest robot that lacks companions; those that have called for long take anybody.
RobotId nearest_alone(const ConvoyRobot& robot) noexcept {
  const TreeTable& table = robot.table();
  int best = -1;
  for (int k = 0; k < table.size(); ++k) {
    if (best >= 0 && table.range(k) >= table.range(best)) continue;
    if (!table.alive(k) || !needs_companion(robot, k) ||
        count_companions(robot, table.id(k)) >= welcome_companions(robot, k))
      continue;
    if (table.message(k).call_hops == companion_call || !another_is_nearer(robot, k, nobody)) best = k;
  }
  return best < 0 ? nobody : table.id(best);
}

// An edge in need calls, and no spare has come: what follows is about the ticks of that.
void follow_call(ConvoyRobot& robot) noexcept {
  ConvoyState& self = robot.self;
  if (robot.call_hops >= companion_call || !self.called) self.alone_ticks = 0;
  else robot.add_elapsed(self.alone_ticks);
}

// A companion joins an edge in need only if no other spare does: the edge has begun to call. Edges that fold it joins
// at once.
void leave_edge_to_others(ConvoyRobot& robot) noexcept {
  ConvoyState& self = robot.self;
  if (self.accompanies == nobody || self.request == nobody) return;
  const int owner = robot.table().find(self.request);
  if (owner >= 0 &&
      (robot.table().message(owner).call_hops == 0 || (may_fold(robot) && !is_under_way(robot.table().message(owner)))))
    return;
  self.request = nobody;
  self.spare_state = SpareState::wait;
}

void choose_whom(ConvoyRobot& robot) noexcept {
  ConvoyState& self = robot.self;
  const TreeTable& table = robot.table();
  follow_call(robot);
  const bool busy = self.parent != nobody || self.spare_state == SpareState::extend_edge;
  if (busy || self.alone_ticks > robot.params.rounds(short_for_drives)) {
    self.accompanies = nobody;
    return;
  }
  if (self.accompanies != nobody) {
    const int k = table.find(self.accompanies);
    const auto is_wanted = [&] {
      return needs_companion(robot, k) && count_before_me(robot, k) < welcome_companions(robot, k);
    };
    const bool stays = k >= 0 && (table.alive(k) ? is_wanted() : stands_in_for(robot, k));
    if (!stays) self.accompanies = nobody;
  }
  if (self.request == nobody) self.accompanies = self.accompanies == nobody ? nearest_alone(robot) : farther_out(robot);
  leave_edge_to_others(robot);
  // One spare goes where a companion is missed far away; a crowd would be in the way there.
  const int way = robot.call_hops < companion_call ? -1 : table.find(self.reference);
  if (self.called && way >= 0 && another_is_nearer(robot, way, nobody)) self.called = false;
}

bool depends_on_me(const ConvoyRobot& robot) noexcept {
  const int up = robot.is_root() ? -1 : robot.up();
  const EdgeEnds ends = known_ends(robot, robot.self.id, up < 0 ? nobody : robot.table().id(up));
  return holds_together(robot, Vec2{}, ends.all(), robot.self.want > 0.0F);
}

// I am the worker at the end of a branch that travels and is going to fold (leads_travelling).
bool leads(const ConvoyRobot& robot) noexcept {
  return may_fold(robot) && robot.self.is_worker && robot.self.want > 0.0F && robot.parent >= 0 &&
         robot.useful_children == 0;
}

void call(ConvoyRobot& robot) noexcept {
  ConvoyState& self = robot.self;
  const bool needs = depends_on_me(robot) || leads(robot);
  const bool lacks = needs && count_companions(robot, self.id) < wanted_companions(robot);
  const bool alone = lacks || (robot.parent >= 0 && wants_fold(robot));
  // Where a branch folds, spares go by this alone: robots of the tree hide others from them.
  if (needs && self.want < folds_from && may_fold(robot)) self.request = self.id;
  if (!alone) self.alone_ticks = 0;
  else robot.add_elapsed(self.alone_ticks);
  if (!alone || self.phase != Phase::grow_tree) return;
  if (lacks && self.alone_ticks > lacks_after_ticks) self.request = self.id;
  if (self.alone_ticks > whole(robot.params.call_after_rounds))
    self.call_hops = std::min(self.call_hops, companion_call);
}

int degree_of(const ConvoyRobot& robot, int k) noexcept {
  return robot.convoy_of(k).child_count + (up_of(robot.table().message(k)) != nobody ? 1 : 0);
}

// In which direction from the robot at `center` a tree neighbour is that I do not hear: opposite to the others or,
// where robots hide nothing, as near to that as is out of my reach.
Vec2 unheard_direction(const ConvoyRobot& robot, Vec2 center, Vec2 opposite) noexcept {
  if (robot.params.line_of_sight) return opposite;
  const float far = unheard_at;
  const float d = std::max(norm(center), least_range);
  const Vec2 me = -center / d;
  // The cosine of the angle to me from which on it is out of reach.
  const float nearest = std::max((far * far + d * d - 1.0F) / (2.0F * far * d), -1.0F);
  const float along = dot(opposite, me);
  if (along <= nearest) return opposite;
  const Vec2 side = cross(me, opposite) < 0.0F ? -left_of(me) : left_of(me);
  return me * nearest + side * std::sqrt(1.0F - nearest * nearest);
}

// The tree neighbours of neighbour `of`.
EdgeEnds ends_around(const ConvoyRobot& robot, int of) noexcept {
  const Vec2 center = robot.table().position(of);
  EdgeEnds ends = known_ends_around(robot, of);
  Vec2 sum;
  for (const Vec2 end : ends.all()) sum += unit(end - center);
  if (static_cast<int>(ends.size) < degree_of(robot, of) && sum != Vec2{})
    ends.add(center + unheard_direction(robot, center, -unit(sum)) * unheard_at);
  return ends;
}

// What is in the way at that place, and of links from it to the ends. m.
float obstruction_of(const ConvoyRobot& robot, const EdgeEnds& ends, int of, Vec2 place) noexcept {
  const ConvoyParams& p = robot.params;
  const TreeTable& table = robot.table();
  float count = 0.0F;
  for (int k = 0; k < table.size(); ++k) {
    if (!table.alive(k)) continue;
    const Vec2 at = table.position(k);
    if (k != of && distance(place, at) < p.spare_avoidance) count += costs_crowd;
    // It is to hide no edge.
    const TreeStanding& m = table.message(k);
    const int up = m.role == Role::spare ? -1 : table.find(up_of(m));
    if (up >= 0 && distance_to_segment(place, at, table.position(up)) < p.clearance) count += costs_crowd;
    if (up >= 0 && p.line_of_sight && crosses(place, at, table.position(up))) count += costs_crowd;
    if (!p.line_of_sight) continue;
    for (const Vec2 end : ends.all())
      if (at != end && distance_to_segment(at, place, end) < hides * p.clearance) count += costs_hidden;
  }
  return count;
}

// How bad that place is. m.
float cost_of(const ConvoyRobot& robot, const EdgeEnds& ends, int of, Vec2 place) noexcept {
  float longest = 0.0F;
  for (const Vec2 end : ends.all()) longest = std::max(longest, distance(place, end));
  return longest + (longest > reach ? 1.0F : 0.0F) + costs_way * norm(place) + obstruction_of(robot, ends, of, place);
}

}  // namespace

bool needs_companion(const ConvoyRobot& robot, int k) noexcept {
  const TreeTable& table = robot.table();
  const TreeStanding& m = table.message(k);
  if (m.role == Role::spare) return false;
  const int degree = degree_of(robot, k);
  if (leads_travelling(robot, k)) return true;
  if (degree < 2) return false;
  if (may_fold(robot) && !is_under_way(m)) return says_it_lacks(robot, k);
  const EdgeEnds ends = known_ends_around(robot, k);
  const bool knows_all = static_cast<int>(ends.size) + (up_of(m) == robot.self.id ? 1 : 0) >= degree;
  return !knows_all || holds_together(robot, table.position(k), ends.all(), m.want > 0);
}

int count_companions(const ConvoyRobot& robot, RobotId of) noexcept {
  int count = 0;
  for (int j = 0; j < robot.table().size(); ++j)
    if (accompanies(robot, j, of)) ++count;
  return count;
}

void heed_live_calls(ConvoyRobot& robot) noexcept {
  if (!has_companions(robot.params) || !robot.params.line_of_sight) return;
  robot.call_hops = live_call_hops(robot.table(), [](std::uint8_t) { return true; });
}

void keep_company(ConvoyRobot& robot) noexcept {
  if (!has_companions(robot.params)) return;
  // The hops of a call that is over count up. It is to die out before it hides others, or looks like one of them.
  const std::uint8_t hops = robot.self.call_hops;
  if ((hops < companion_call ? hops : hops - companion_call) > call_reach_hops_each)
    robot.self.call_hops = nobody_calls;
  if (robot.self.role == Role::spare) return choose_whom(robot);
  robot.self.accompanies = nobody;
  call(robot);
}

bool stands_in_for(const ConvoyRobot& robot, int k) noexcept {
  if (robot.params.line_of_sight) return false;  // it may only be hidden
  return robot.table().id(k) == robot.self.accompanies && robot.table().age(k) <= stand_in * robot.liveness_ticks();
}

bool steps_aside(const ConvoyRobot& robot, Vec2& way) noexcept {
  const ConvoyParams& p = robot.params;
  const TreeTable& table = robot.table();
  const bool saves = p.thrift > 0.0F;  // robots, rather than companions
  if ((!saves && (!has_companions(p) || !p.line_of_sight)) || !has_arrived(robot)) return false;
  if (robot.self.role != Role::connector || robot.useful_children != 1 || robot.parent < 0) return false;
  const auto* const child = first_of(robot.children, [&](int k) { return table.message(k).role != Role::spare; });
  if (child == robot.children.end()) return false;
  const Vec2 from = table.position(*child);
  const Vec2 to = table.position(robot.parent);
  const Vec2 near = nearest_on_segment(from, to);
  const float reach = saves ? thrifty(p, p.merge_distance) : folded_reach;
  if (distance(from, to) > reach || norm(near) > aside * p.clearance) return false;
  const Vec2 left = left_of(unit(to - from));
  constexpr float pace = 0.7F;  // of its speed
  way = (dot(near, left) > 0.0F ? -left : left) * pace;
  return true;
}

float companion_width(const ConvoyRobot& robot, int of) noexcept {
  const ConvoyParams& p = robot.params;
  if (!p.line_of_sight) return 0.0F;
  constexpr float under_way = 2.0F;  // of `clearance`
  return (robot.table().range(of) > from_afar * p.companion_distance ? under_way : edge_room) * p.clearance;
}

Vec2 companion_motion(const ConvoyRobot& robot, int of) noexcept {
  const ConvoyParams& p = robot.params;
  const TreeTable& table = robot.table();
  const Vec2 center = table.position(of);
  const EdgeEnds ends = ends_around(robot, of);
  const Vec2 axis = ends.size > 0 ? unit(ends.at[0] - center) : unit(-center);
  Vec2 best;
  float least = not_counted;
  constexpr float turn = 2.0F * pi<float> / static_cast<float>(places);
  const Vec2 step = unit_vector(turn);
  Vec2 direction = left_of(axis);
  for (int k = 0; k < places; ++k, direction = rotate(step, direction)) {
    const Vec2 place = center + direction * p.companion_distance;
    const float cost = cost_of(robot, ends, of, place);
    if (cost >= least) continue;
    least = cost;
    best = place;
  }
  const float d = norm(best);
  const float slow = std::min(1.0F, d / near_place);
  // Not through the robot itself.
  const float room = keeps_off * p.companion_distance;
  const Vec2 off =
      table.range(of) < room ? -unit(center) * (room / std::max(table.range(of), least_range) - 1.0F) : Vec2{};
  return bypass(robot, best) * slow + off;
}

}  // namespace banyan
