// SPDX-License-Identifier: MIT
// What a robot of link consensus broadcasts (docs/baselines.md).
#pragma once

#include <algorithm>
#include <cstdint>

#include "banyan/controller/core/report.hpp"
#include "banyan/controller/core/wire.hpp"

namespace banyan::baselines::link_consensus {

inline constexpr std::uint16_t not_rooted = 0xFFFF;  // as a way to the root: there is none over kept links

// To give up the link between two robots: the owner proposes, the other agrees.
struct Bid {
  RobotId owner = nobody;  // nobody: there is none
  RobotId other = nobody;
  std::uint16_t length = 0;       // the longest link is the most urgent
  std::uint8_t serial = 0;        // the owner's bids are numbered
  std::uint8_t reach = 0;         // hops that it may still travel
  std::uint16_t lease_ticks = 0;  // for so long robots that vouch for it vouch for no other

  friend bool operator==(const Bid&, const Bid&) = default;
};
constexpr bool is_same(const Bid& a, const Bid& b) noexcept {
  return a.owner == b.owner && a.serial == b.serial && a.other == b.other;
}

struct Message {
  static constexpr std::uint8_t blocks = 0;
  RobotId id = nobody;
  RobotId root = nobody;           // the robot that it believes to be root
  Serial beat = 0;                 // that robot's count of ticks
  std::uint16_t way = not_rooted;  // over kept links to it: 1 a link, more for a long one
  RobotId parent = nobody;         // the next robot on that way
  KeptLinks links = no_links();    // kept, or offered to be
  Bid bid;                         // what it vouches for
  bool agrees = false;             // it is the other end of the link of that bid

  friend bool operator==(const Message&, const Message&) = default;
};

template <class Visitor, class M> constexpr void visit_all(Visitor& visit, M& m) noexcept {
  visit.flag("agrees", "to give up the link of the bid that it vouches for", m.agrees);
  visit.robot("id", "of the sender", m.id);
  visit.robot("root", "the robot that it believes to be root, -1: nobody", m.root);
  visit.number("beat", "that robot's count of ticks", m.beat);
  visit.known("way", "over kept links to the root, 1 for each and more for a long one, -1: none", m.way);
  visit.robot("parent", "the next robot on that way, -1: nobody", m.parent);
  constexpr const char* names[] = {"link_1", "link_2", "link_3", "link_4",  "link_5",  "link_6",
                                   "link_7", "link_8", "link_9", "link_10", "link_11", "link_12"};
  static_assert(std::size(names) == most_kept_links);
  for (std::size_t k = 0; k < most_kept_links; ++k)
    visit.robot(names[k], "the other end of a link that it keeps or offers, -1: none", m.links[k]);
  visit.robot("bid_owner", "the robot that proposes to give up a link, -1: nobody", m.bid.owner);
  visit.robot("bid_other", "to whom the link is, -1: nobody", m.bid.other);
  visit.scaled("bid_length", "length of that link", m.bid.length, per_range);
  visit.number("bid_serial", "number of the bid among its owner's", m.bid.serial);
  visit.number("bid_reach", "hops that the bid may go on", m.bid.reach);
  visit.number("bid_lease_ticks", "for so long the sender vouches for no other bid", m.bid.lease_ticks);
}
template <class Visitor> constexpr void visit_fields(Visitor& visit, Message& m) noexcept { visit_all(visit, m); }
template <class Visitor> constexpr void visit_fields(Visitor& visit, const Message& m) noexcept { visit_all(visit, m); }

constexpr bool lists(const Message& m, RobotId id) noexcept {
  return std::find(m.links.begin(), m.links.end(), id) != m.links.end();
}

}  // namespace banyan::baselines::link_consensus
