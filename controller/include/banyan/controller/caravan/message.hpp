// SPDX-License-Identifier: MIT
// What a robot of caravan broadcasts each round (docs/caravan.md). No field has two meanings.
#pragma once

#include "banyan/controller/core/edge_frame.hpp"
#include "banyan/controller/core/report.hpp"
#include "banyan/controller/core/wire.hpp"

namespace banyan::caravan {

// Of two roots that robots believe in, the one with the newer number is right.
struct Root {
  Serial number = 0;
  RobotId id = nobody;  // nobody: none is known

  friend bool operator==(const Root&, const Root&) = default;
};
using banyan::is_newer;
constexpr bool is_newer(Root a, Root b) noexcept {
  if (a.id == nobody || b.id == nobody) return a.id != nobody && b.id == nobody;
  return a.number != b.number ? banyan::is_newer(a.number, b.number) : a.id > b.id;
}

// The nearest open post, as far as a robot has heard (principle 3).
struct Call {
  RobotId source = nobody;  // the robot that advertises it; nobody: there is none
  std::uint8_t count = 0;   // of that robot, a round at a time
  std::uint8_t hops = 0;    // from it

  friend bool operator==(const Call&, const Call&) = default;
};

// What neighbours remember of a robot.
struct Standing {
  Role role = Role::spare;
  RobotId parent = nobody;  // the upper end of the link that ties it to the others
  RobotId other = nobody;   // the parent that it had, until that promise has ended
  Root root;
  Serial beat = 0;            // its place in the order: the root's count of rounds, less one a hop at least
  std::uint16_t label = 0;    // length of its way to the root, C / 256
  std::uint16_t want = 0;     // the largest remaining way of a worker below, C / 256
  std::uint8_t hops = 0;      // over spares to a robot of the tree
  std::uint8_t children = 0;  // of the tree
  Call call;

  friend bool operator==(const Standing&, const Standing&) = default;
};

struct Message : Standing {
  static constexpr std::uint8_t blocks = 0;
  RobotId id = nobody;

  friend bool operator==(const Message&, const Message&) = default;
};

template <class Visitor, class M> constexpr void visit_all(Visitor& visit, M& m) noexcept {
  visit.choice("role", "0 spare, 1 connector, 2 worker, 3 root", m.role, 2, Role::root);
  visit.robot("id", "of the sender", m.id);
  visit.robot("parent", "the upper end of the link that ties it to the others, -1: none", m.parent);
  visit.robot("other", "the parent that it had, until that promise has ended, -1: none", m.other);
  visit.number("root_number", "of the root's token, modulo 65536; 0: no root is known", m.root.number);
  visit.robot("root", "the robot that holds that token, -1: none is known", m.root.id);
  visit.number("beat", "its place in the order: the root's count of rounds, less one a hop at least", m.beat);
  visit.scaled("label", "length of its way to the root, C", m.label, per_range);
  visit.scaled("want", "largest remaining way of a worker below, C", m.want, per_range);
  visit.number("hops", "over spares to a robot of the tree", m.hops);
  visit.number("children", "of the tree", m.children);
  visit.robot("call", "the robot that advertises the nearest open post, -1: none", m.call.source);
  visit.number("call_count", "of that robot, modulo 256", m.call.count);
  visit.number("call_hops", "from that robot", m.call.hops);
}
template <class Visitor> constexpr void visit_fields(Visitor& visit, Message& m) noexcept { visit_all(visit, m); }
template <class Visitor> constexpr void visit_fields(Visitor& visit, const Message& m) noexcept { visit_all(visit, m); }

}  // namespace banyan::caravan
