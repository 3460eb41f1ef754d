// SPDX-License-Identifier: MIT
// What a robot of branch repositioning broadcasts (docs/baselines.md).
#pragma once

#include <array>
#include <cstdint>

#include "banyan/controller/core/wire.hpp"

namespace banyan::baselines::branches {

inline constexpr std::size_t most_links = 8;  // of a robot
using Ids = std::array<RobotId, most_links>;
constexpr Ids no_ids() noexcept {
  Ids ids{};
  ids.fill(nobody);
  return ids;
}

inline constexpr std::uint8_t unknown_age = 255;

// A change of the network: one end of a link of the robot in the middle leaves it for another of its neighbours.
enum Stage : std::uint8_t { no_change, offered, made, undone };

struct Message {
  static constexpr std::uint8_t blocks = 0;
  RobotId id = nobody;
  bool leader = false;
  bool connector = false;                 // neither: a follower
  Ids links = no_ids();                   // kept
  RobotId parent = nobody;                // that link which leads to the root
  std::uint8_t joined_age = unknown_age;  // ticks since the root said, over links, that it is there
  std::uint8_t stage = no_change;         // of the change that it makes,
  RobotId leaves = nobody;                // in which this robot leaves it
  RobotId joins = nobody;                 // for this one
  RobotId held_by = nobody;               // whose change it takes part in
  RobotId calls = nobody;                 // a follower, to become a connector
  RobotId team = nobody;                  // its leader,
  std::uint8_t team_age = unknown_age;    // from so many ticks ago
  RobotId needy = nobody;                 // a leader that lacks
  std::uint8_t needed = 0;                // so many followers,
  std::uint8_t needy_age = unknown_age;   // from so many ticks ago
  RobotId sends = nobody;                 // of a leader: a follower that is to go to that team
  RobotId root = nobody;                  // the robot that calls itself so,
  std::uint8_t root_age = 0;              // from so many ticks ago

  friend bool operator==(const Message&, const Message&) = default;
};

template <class Visitor, class M> constexpr void visit_all(Visitor& visit, M& m) noexcept {
  visit.flag("leader", "sent to a target", m.leader);
  visit.flag("connector", "part of the network; neither: a follower", m.connector);
  visit.robot("id", "of the sender", m.id);
  constexpr const char* links[] = {"link_1", "link_2", "link_3", "link_4", "link_5", "link_6", "link_7", "link_8"};
  for (std::size_t i = 0; i < most_links; ++i)
    visit.robot(links[i], "the other end of a kept link, -1: none", m.links[i]);
  visit.robot("parent", "the link that leads to the root, -1: none", m.parent);
  visit.number("joined_age", "ticks since the root was heard of over links", m.joined_age);
  visit.number("stage", "of the change that it makes: 0 none, 1 offered, 2 made, 3 undone", m.stage);
  visit.robot("leaves", "the robot that leaves it in that change", m.leaves);
  visit.robot("joins", "the robot that that one joins", m.joins);
  visit.robot("held_by", "the robot in whose change it takes part, -1: none", m.held_by);
  visit.robot("calls", "a follower that is to become a connector, -1: none", m.calls);
  visit.robot("team", "the leader of its team, -1: none", m.team);
  visit.number("team_age", "ticks since that was heard of", m.team_age);
  visit.robot("needy", "a leader without enough followers, -1: none is known", m.needy);
  visit.number("needed", "so many it lacks", m.needed);
  visit.number("needy_age", "ticks since that said so", m.needy_age);
  visit.robot("sends", "a follower that is to go there, -1: none", m.sends);
  visit.robot("root", "the robot that calls itself so, -1: none is known", m.root);
  visit.number("root_age", "ticks since that said so", m.root_age);
}
template <class Visitor> constexpr void visit_fields(Visitor& visit, Message& m) noexcept { visit_all(visit, m); }
template <class Visitor> constexpr void visit_fields(Visitor& visit, const Message& m) noexcept { visit_all(visit, m); }

}  // namespace banyan::baselines::branches
