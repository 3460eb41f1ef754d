// SPDX-License-Identifier: MIT
// What a robot of caravan broadcasts each round (docs/caravan.md). No field has two meanings.
#pragma once

#include "banyan/controller/core/edge_frame.hpp"
#include "banyan/controller/core/report.hpp"
#include "banyan/controller/core/wire.hpp"

namespace banyan::caravan {

// Of two roots that robots believe in, the one with the newer number is right.
struct Root {
  Serial sequence = 0;
  RobotId id = nobody;  // nobody: none is known

  friend bool operator==(const Root&, const Root&) = default;
};
using banyan::is_newer;
constexpr bool is_newer(Root a, Root b) noexcept {
  if (a.id == nobody || b.id == nobody) return a.id != nobody && b.id == nobody;
  return a.sequence != b.sequence ? banyan::is_newer(a.sequence, b.sequence) : a.id > b.id;
}

// The nearest open post, as far as a robot has heard (principle 3).
struct Call {
  RobotId source = nobody;  // the robot that advertises it; nobody: there is none
  std::uint8_t count = 0;   // of that robot, a round at a time
  std::uint8_t hops = 0;    // from it

  friend bool operator==(const Call&, const Call&) = default;
};

// What neighbours remember of a robot.
struct Statement {
  Role role = Role::spare;
  bool pinned = false;      // a corner is about to cut the edge to its parent, and somebody below has to go on
  bool leaving = false;     // it runs low, and has to be relieved; a spare: it has too little charge to join
  RobotId parent = nobody;  // the upper end of the link that ties it to the others
  RobotId other = nobody;   // the parent that it had, until that promise has ended
  Root root;
  Serial beat = 0;            // its place in the order: the root's count of rounds, less one a hop at least
  std::uint16_t label = 0;    // length of its way to the root, C / 256
  std::uint16_t want = 0;     // the largest remaining way of a worker below, C / 256
  std::uint8_t hops = 0;      // over spares to a robot of the tree
  std::uint8_t children = 0;  // of the tree
  Call call;

  friend bool operator==(const Statement&, const Statement&) = default;
};

// The name of the root's token; a target's is the robot first sent there.
inline constexpr RobotId root_name = 0xFFFE;
// The holder of a target that is put off until robots suffice.
inline constexpr RobotId put_off = 0xFFFE;
// And of one whose holder died or left it: the nearest spare takes it.
inline constexpr RobotId vacant = 0xFFFD;

// A token as a message tells of it, one in turn (principle 5).
struct TokenNews {
  RobotId name = nobody;    // nobody: none is known
  RobotId holder = nobody;  // nobody: it has been given up; or put_off, or vacant
  Serial beat = 0;          // the holder's count of rounds
  bool reached = false;     // the holder is there
  bool charging = false;    // the place is one to be charged at
  RobotId told = nobody;    // the neighbour that is told the place
  Coordinate x;             // the place - that neighbour, in the frame of the edge to it
  Coordinate y;

  friend bool operator==(const TokenNews&, const TokenNews&) = default;
};

struct Message : Statement {
  static constexpr std::uint8_t blocks = 0;
  RobotId id = nobody;
  TokenNews token;
  Coordinate corner_x;  // the corner nearest to my edge - my parent, in the frame of the edge to it; 0, 0: none
  Coordinate corner_y;

  friend bool operator==(const Message&, const Message&) = default;
};

template <class Visitor, class M> constexpr void visit_all(Visitor& visit, M& m) noexcept {
  visit.choice("role", "0 spare, 1 connector, 2 worker, 3 root", m.role, 2, Role::root);
  visit.flag("pinned", "1: a corner is about to cut the edge to the parent", m.pinned);
  visit.flag("leaving", "1: it has to be relieved; a spare: it has too little charge to join", m.leaving);
  visit.robot("id", "of the sender", m.id);
  visit.robot("parent", "the upper end of the link that ties it to the others, -1: none", m.parent);
  visit.robot("other", "the parent that it had, until that promise has ended, -1: none", m.other);
  visit.number("root_sequence", "of the root's token, modulo 65536; 0: no root is known", m.root.sequence);
  visit.robot("root", "the robot that holds that token, -1: none is known", m.root.id);
  visit.number("beat", "its place in the order: the root's count of rounds, less one a hop at least", m.beat);
  visit.scaled("label", "length of its way to the root, C", m.label, per_range);
  visit.scaled("want", "largest remaining way of a worker below, C", m.want, per_range);
  visit.number("hops", "over spares to a robot of the tree", m.hops);
  visit.number("children", "of the tree", m.children);
  visit.robot("call", "the robot that advertises the nearest open post, -1: none", m.call.source);
  visit.number("call_count", "of that robot, modulo 256", m.call.count);
  visit.number("call_hops", "from that robot", m.call.hops);
  visit.flag("token_reached", "1: the holder of `token` is at its place", m.token.reached);
  visit.flag("token_charging", "1: the place of `token` is one to be charged at", m.token.charging);
  visit.robot("token", "a token in turn: a target, by the robot first sent there, or 65534: the root; -1: none",
              m.token.name);
  visit.robot("token_holder", "the robot that holds it, -1: given up, 65533: vacant, 65534: put off for want of robots",
              m.token.holder);
  visit.number("token_beat", "the holder's count of rounds, modulo 65536", m.token.beat);
  visit.robot("told", "the neighbour that is told its place, -1: nobody", m.token.told);
  visit.coordinate("token_x", "the place relative to `told`, along the edge from the sender to it", m.token.x);
  visit.coordinate("token_y", "the same, to the left of that edge", m.token.y);
  visit.coordinate("corner_x", "the corner nearest to the edge to the parent, relative to the parent, along that edge",
                   m.corner_x);
  visit.coordinate("corner_y", "the same, to the left of that edge; 0, 0: none is near", m.corner_y);
}
template <class Visitor> constexpr void visit_fields(Visitor& visit, Message& m) noexcept { visit_all(visit, m); }
template <class Visitor> constexpr void visit_fields(Visitor& visit, const Message& m) noexcept { visit_all(visit, m); }

struct Heard {
  const Message* message;
  Vec2 position;
  float age_s = 0.0F;
  Vec2 before{};  // where it was a round ago, in my frame of then; zero: it was not heard then
};

}  // namespace banyan::caravan
