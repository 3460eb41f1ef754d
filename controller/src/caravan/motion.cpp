// SPDX-License-Identifier: MIT
// A robot has one goal, which follows from its role, and one filter.
#include <iterator>

#include "caravan/rules.hpp"

namespace banyan::caravan {
namespace {

bool is_worker(const Robot& robot) noexcept { return robot.self.role == Role::worker; }

constexpr float tension_start = 0.15F;  // C; full at twice as much
constexpr float pinned_start = 0.125F;
constexpr float narrow = 0.05F;        // in which something begins or ends: a pull, the last bit to a place
constexpr float at_place = 0.2F;       // where several meet: none goes nearer
constexpr float follow_spare = 0.75F;  // a spare stays so near to its parent
constexpr float sight_width = 0.35F;   // C: robots that stand keep so far from the edges of others
constexpr float follow_tree = 0.5F;

float ramp(float d, float start, float width) noexcept { return std::clamp((d - start) / width, 0.0F, 1.0F); }

// Towards a place, round obstacles; slower over the last bit.
Vec2 towards(Robot& robot, Vec2 place) noexcept {
  constexpr float last_bit = 0.15F;  // straight, as near as obstacles allow: a dead worker may lie there
  if (robot.self.role == Role::worker && norm(place) < last_bit) return clamped(place / narrow, 1.0F);
  return bypass({robot.obstacles, robot.params.body_radius, robot.self.id}, robot.self.detour, place) *
         std::min(1.0F, norm(place) / narrow);
}

// A connector follows the children that still have to go on.
Vec2 tow(const Robot& robot) noexcept {
  const Params& p = robot.params;
  int towing = 0;
  robot.children.for_each([&](int k) { towing += robot.said(k).want > 0 ? 1 : 0; });
  const float start = towing > 1 ? p.need_distance : p.pull_start;
  Vec2 u;
  robot.children.for_each([&](int k) {
    const Statement& m = robot.said(k);
    // A child at a corner needs its parent there before it can go round.
    if (m.want > 0)
      u += unit(robot.position(k)) * (m.pinned ? ramp(robot.range(k), pinned_start, narrow)
                                               : ramp(robot.stretched(robot.range(k)), start, p.pull_width));
  });
  return clamped(u, 1.0F);
}

// Comes nearer to one neighbour until the edge to another is stretched: so the slack of a chain gathers at one end.
Vec2 gather(const Robot& robot, int to, int kept) noexcept {
  constexpr float taut = 0.91F;  // C
  if (to < 0 || kept < 0) return {};
  // Where robots are relieved, one beside another has to reach as far.
  const State& self = robot.self;
  const float good = self.level < 0.0F || self.want > 0 ? taut : robot.params.need_distance;
  const float slack = std::clamp((good - robot.stretched(robot.range(kept))) / narrow, -1.0F, 1.0F);
  return unit(robot.position(slack > 0.0F ? to : kept)) * (2.0F * std::abs(slack));
}

// While a post waits in vain slack gathers where it calls; once all below have arrived at the inner end, where a robot
// becomes superfluous.
Vec2 gather_slack(const Robot& robot) noexcept {
  const Call& call = robot.self.call;
  int calling = -1;
  int longest = -1;
  robot.children.for_each([&](int k) {
    const Call& c = robot.said(k).call;
    if (call.source != nobody && c.source == call.source && c.hops <= call.hops) calling = k;
    if (longest < 0 || robot.range(k) > robot.range(longest)) longest = k;
  });
  if (calling < 0) return robot.self.want > 0 ? Vec2{} : gather(robot, robot.parent, longest);
  const int source = robot.table().find(call.source);  // whose parent I am to become
  return gather(robot, source >= 0 ? source : calling, robot.parent);
}

// Edges are taut strings: chains become straight, and three meet at 120 degrees.
Vec2 tension(const Robot& robot) noexcept {
  Vec2 u;
  const auto draw = [&](int k) { u += unit(robot.position(k)) * ramp(robot.range(k), tension_start, tension_start); };
  if (robot.parent >= 0) draw(robot.parent);
  robot.children.for_each(draw);
  return u * robot.params.tension_gain;
}

// Room for others: spares and robots of the tree that are near, and the lines of sight of their edges.
Vec2 make_room(const Robot& robot, float width) noexcept {
  constexpr float gain = 0.5F;
  constexpr float of_tree = 1.3F;  // times as much room
  const Params& p = robot.params;
  const Table& table = robot.table();
  Vec2 u;
  const auto push = [&](Vec2 near, float reach, Vec2 aside) {
    const float d = norm(near);
    if (d < reach) u += (d > 1e-4F ? near / -d : aside) * (gain * (reach / std::max(d, 1e-4F) - 1.0F));
  };
  for (int k = 0; k < table.size(); ++k) {
    if (robot.is_lost(k)) continue;
    const Statement& m = robot.said(k);
    const bool linked = k == robot.parent || m.parent == robot.self.id;
    const bool both_workers = is_worker(robot) && m.role == Role::worker;  // they may meet head-on at a wall
    if (!linked || !robot.is_tree(k) || robot.self.role == Role::spare || both_workers)
      push(table.position(k), m.role == Role::spare ? p.room : of_tree * p.room, {});
    if (!p.line_of_sight || width <= 0.0F || !robot.is_tree(k) || k == robot.parent || m.parent == robot.self.id)
      continue;
    const int up = table.find(m.parent);
    if (up < 0 || robot.children.has(up)) continue;
    const Vec2 along = unit(table.position(up) - table.position(k));
    push(nearest_on_segment(table.position(k), table.position(up)), width, left_of(along));
  }
  // With k paths my neighbours in the tree are to hear each other past me.
  if (p.line_of_sight && p.link_redundancy > 1 && robot.self.role != Role::spare) {
    Rows mine = robot.children;
    if (robot.parent >= 0) mine.set(robot.parent, true);
    mine.for_each([&](int i) {
      mine.for_each([&](int k) {
        const Vec2 along = unit(robot.position(k) - robot.position(i));
        if (i < k) push(nearest_on_segment(robot.position(i), robot.position(k)), sight_width, left_of(along));
      });
    });
  }
  return u;
}

// ---- The goals ----

bool has_lost_parent(const Robot& robot) noexcept { return robot.parent >= 0 && robot.is_lost(robot.parent); }
bool is_towed(const Robot& robot) noexcept { return robot.self.role != Role::spare && robot.self.want > 0; }
bool has_arrived(const Robot& robot) noexcept { return robot.self.role != Role::spare; }

// Where all are far apart and packets get lost, somebody whom it has not heard yet may depend on it.
bool is_thin(const Robot& robot) noexcept {
  const Table& table = robot.table();
  for (int k = 0; k < table.size(); ++k)
    if (table.range(k) <= follow_tree) return false;
  return true;
}
bool awaits_the_unheard(const Robot& robot) noexcept {
  constexpr int rounds = 100;
  return robot.self.assumed_silence > 0 && robot.self.since_start < rounds && is_thin(robot);
}

bool is_to_be_charged(const Robot& robot) noexcept { return charging_place(robot) != nullptr; }

bool is_called(const Robot& robot) noexcept { return robot.caller >= 0; }

bool always(const Robot& /*robot*/) noexcept { return true; }

Vec2 stay(Robot& /*robot*/) noexcept { return {}; }

Vec2 to_root(Robot& robot) noexcept {
  const Vec2 place = robot.parent >= 0 ? robot.position(robot.parent) : robot.self.tokens[0].place;
  return norm(place) > at_place ? towards(robot, place) : Vec2{};
}

Vec2 to_parent(Robot& robot) noexcept { return towards(robot, robot.position(robot.parent)); }

Vec2 to_target(Robot& robot) noexcept {
  const Vec2* const target = robot.self.target();
  return target != nullptr && robot.parent >= 0 ? towards(robot, *target) : Vec2{};
}

// Round obstacles, if there are any; and under tension.
Vec2 drawn(Robot& robot, Vec2 pull) noexcept {
  if (!robot.obstacles.empty() && !(pull == Vec2{})) pull = towards(robot, pull) * norm(pull);
  return pull + tension(robot);
}
Vec2 after_children(Robot& robot) noexcept { return drawn(robot, tow(robot)) + gather_slack(robot); }
Vec2 close_up(Robot& robot) noexcept { return drawn(robot, gather_slack(robot)); }

Vec2 to_charging_place(Robot& robot) noexcept {
  const Vec2 place = charging_place(robot)->place;
  return norm(place) > at_place ? towards(robot, place) : Vec2{};
}

// Into the edge, if it hears both ends; else up to the one that passed the call on, or runs low.
Vec2 to_post(Robot& robot) noexcept {
  const int k = robot.caller;
  const Vec2 at = robot.position(k);
  const Statement& m = robot.said(k);
  const int up = robot.is_tree(k) ? robot.table().find(m.parent) : -1;
  const bool calls = m.call.source == robot.table().id(k);
  Vec2 place = at;
  if (up >= 0 && calls && !m.leaving) place = at + (robot.position(up) - at) * 0.5F;
  return towards(robot, place);
}

Vec2 near_parent(Robot& robot) noexcept {
  if (robot.parent < 0) return {};
  const float reach = robot.is_tree(robot.parent) ? follow_tree : follow_spare;
  return to_parent(robot) * ramp(robot.range(robot.parent), reach, robot.params.pull_width);
}

// How far a robot keeps from the lines of sight of others: not at all, out of the way, or well away.
enum class Room : unsigned char { none, passing, wide };

struct Goal {
  const char* name;
  bool (*applies)(const Robot&) noexcept;
  Vec2 (*motion)(Robot&) noexcept;
  Room room;
};

// The first that applies.
constexpr Goal goals[] = {
    {"the parent is silent: to where it was", has_lost_parent, to_parent, Room::passing},
    {"the root is silent: after the parent, or to where the root was", is_cut_off, to_root, Room::none},
    {"a worker: to its target", is_worker, to_target, Room::none},
    {"towed: after the children that have to go on", is_towed, after_children, Room::wide},
    {"arrived: gather the slack of the chain", has_arrived, close_up, Room::wide},
    {"a thin start: stay, somebody unheard may depend on me", awaits_the_unheard, stay, Room::wide},
    {"low on charge: to be charged", is_to_be_charged, to_charging_place, Room::wide},
    {"called: to the nearest post", is_called, to_post, Room::wide},
    {"a spare: stay near the parent", always, near_parent, Room::wide},
};

}  // namespace

Vec2 goal(Robot& robot) noexcept {
  const Params& p = robot.params;
  const Goal& first = *first_of(std::begin(goals), std::end(goals), [&](const Goal& g) { return g.applies(robot); });
  const Vec2 way = first.motion(robot);
  // A spare under way passes nearer than one that stands.
  const bool passes = first.room == Room::passing || (robot.self.role == Role::spare && norm(way) > 0.0F);
  return way + make_room(robot, first.room == Room::none ? 0.0F : passes ? 2.0F * p.clearance : sight_width);
}

void limit_motion(const Robot& robot, Guard& guard) noexcept {
  keep_off({robot.obstacles, robot.params.body_radius, robot.self.id}, robot.params.guard_rate, guard);
  keep_sight(robot, guard);
  const Params& p = robot.params;
  const Table& table = robot.table();
  const float touching = 2.1F * p.body_radius;
  for (int k = 0; k < table.size(); ++k) {
    const float d = table.range(k);
    // With k paths an edge of the tree has a k-th of the length, unless it is longer already.
    const float end =
        robot.is_edge(k) ? std::max(robot.shortened(p.longest_edge), std::min(d, p.longest_edge)) : p.longest_edge;
    // A half-plane that allows full speed is not worth asking for.
    const bool is_free = table.age(k) <= robot.hidden_after() && 0.5F * (end - d) * p.guard_rate >= 1.0F;
    if (!is_free && is_promised(robot, k))
      guard.add(table.position(k), end - table.spread() - strayed(robot, k), p.guard_rate);
    // Nobody pushes: who is pushed does not notice, and is wrong about places from then on.
    if (table.age(k) == 0 && d < touching + narrow && d > 0.0F)
      guard.add_limit(table.position(k) / d, std::max(0.0F, d - touching) * p.guard_rate);
  }
}

}  // namespace banyan::caravan
