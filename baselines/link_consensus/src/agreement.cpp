// SPDX-License-Identifier: MIT
// How a link is given up. Its owner, the end with the smaller id, makes a bid, which travels over kept links, but not
// over the link itself. A robot that vouches for it vouches for no other and gives up no link until its lease has run
// out. If the bid reaches the other end, a path of robots that vouch for it joins the two: the other agrees, the owner
// hears that directly and gives up the link. No link of that path can be given up before the lease ends, so the kept
// graph stays connected, whatever is agreed elsewhere at the same time and whatever packets are lost.
#include <algorithm>
#include <optional>

#include "banyan/controller/core/fixed_point.hpp"
#include "rooms.hpp"

namespace banyan::baselines::link_consensus {
namespace {

constexpr int detour_reach = 2;        // through a common neighbour
constexpr int first_reach = 8;         // where there is none
constexpr int longest_reach = 32;      // for the second attempt
constexpr int lease_slack_steps = 10;  // a lease lasts twice the reach and so many steps longer,
constexpr int commit_margin = 4;       // and the owner acts on it only before its last quarter, since clocks may differ
constexpr int longest_lease_ticks = 20000;  // so that three times as many fit into 16 bits
constexpr int rest_ticks = 20;              // after a round of bids that all failed

Bid received(const Message& m) noexcept {
  Bid bid = m.bid;
  if (bid.owner == nobody || bid.reach == 0 || bid.lease_ticks <= 1) return {};
  --bid.reach;
  --bid.lease_ticks;
  return bid;
}

bool is_more_urgent(const Bid& a, const Bid& b) noexcept {
  if (a.owner == nobody || b.owner == nobody) return b.owner == nobody && a.owner != nobody;
  if (a.length != b.length) return a.length > b.length;
  return a.owner != b.owner ? a.owner < b.owner : a.other < b.other;
}

void release(State& self) noexcept {
  self.last_bid = self.bid;
  self.bid = {};
  self.agrees = false;
}

// My bid found no path in time: either there is none, or some robot on it vouched for another bid. Owners rest for
// different times, so that their bids do not collide again.
void note_failure(State& self) noexcept {
  self.rest_ticks = static_cast<std::uint16_t>((self.id * 7919U + self.serial * 104729U) % (3U * self.own_lease_ticks));
  self.insists = !self.insists;
  if (!self.insists) self.tried = self.bid.length;
}

void age(Robot& robot) noexcept {
  State& self = robot.self;
  self.rest_ticks = static_cast<std::uint16_t>(std::max(0, self.rest_ticks - robot.elapsed_ticks));
  if (self.bid.owner == nobody) return;
  self.bid.lease_ticks = static_cast<std::uint16_t>(std::max(0, self.bid.lease_ticks - robot.elapsed_ticks));
  if (self.bid.lease_ticks > 0) return;
  if (self.bid.owner == self.id) note_failure(self);
  release(self);
}

// The other end vouches for my bid and agrees.
void settle(Robot& robot) noexcept {
  State& self = robot.self;
  const int k = robot.table().find(self.bid.other);
  if (k < 0 || commit_margin * self.bid.lease_ticks <= self.own_lease_ticks) return;
  const Message& m = robot.table().message(k);
  if (!m.agrees || !is_same(m.bid, self.bid)) return;
  const int l = self.links.find(self.bid.other);
  if (l >= 0) self.links.remove(l);
  self.given_up = self.bid.other;
  self.insists = false;
  self.tried = 0xFFFF;
  release(self);
}

// The best link to give up: longer than nominate_distance, or with a detour through a robot nearer to both ends. Not
// one on a shortest path to the root, mine or the other end's: it may be the only one, and every cycle has other links.
// None as long as one that has been tried in vain, or longer, until all shorter ones have been tried.
Bid nominate(Robot& robot) noexcept {
  State& self = robot.self;
  const Table<Message>& table = robot.table();
  Bid best;
  for (int l = 0; l < self.links.size(); ++l) {
    const Link& link = self.links[l];
    const int k = table.find(link.to);
    if (!link.kept || k < 0 || link.to < self.id || link.to == self.parent || table.message(k).parent == self.id)
      continue;
    const auto length = to_fixed<std::uint16_t>(table.range(k), per_range);
    if (length >= self.tried) continue;
    if (table.range(k) < robot.params.nominate_distance && !is_detoured(robot, k)) continue;
    const int reach = self.insists ? longest_reach : is_detoured(robot, k) ? detour_reach : first_reach;
    const Bid bid{self.id, link.to, length, 0, static_cast<std::uint8_t>(reach), 0};
    if (is_more_urgent(bid, best)) best = bid;
  }
  if (best.owner == nobody && self.tried != 0xFFFF) {
    self.tried = 0xFFFF;
    self.rest_ticks = rest_ticks;
  }
  return best;
}

// The bid will travel one hop in each step.
void open_bid(Robot& robot, Bid bid) noexcept {
  State& self = robot.self;
  bid.serial = ++self.serial;
  self.own_lease_ticks =
      static_cast<std::uint16_t>(std::min((2 * bid.reach + lease_slack_steps) * robot.step_ticks, longest_lease_ticks));
  bid.lease_ticks = self.own_lease_ticks;
  self.bid = bid;
}

}  // namespace

bool is_open(const Robot& robot, int k) noexcept {
  const State& self = robot.self;
  const Message& m = robot.table().message(k);
  return is_kept(robot, k) && !(m.bid.owner == self.id && m.bid.other == m.id) &&
         !(m.bid.owner == m.id && m.bid.other == self.id);
}

void agree(Robot& robot) noexcept {
  State& self = robot.self;
  age(robot);
  if (self.bid.owner == self.id) settle(robot);
  if (self.bid.owner != nobody || self.given_up != nobody) return;
  Bid best;
  for (int k = 0; k < robot.table().size(); ++k) {
    if (robot.table().age(k) > 0 || !is_open(robot, k)) continue;
    const Bid bid = received(robot.table().message(k));
    if (bid.owner != self.id && !is_same(bid, self.last_bid) && is_more_urgent(bid, best)) best = bid;
  }
  const Bid own = self.rest_ticks == 0 ? nominate(robot) : Bid{};
  if (is_more_urgent(own, best)) open_bid(robot, own);
  else self.bid = best;
  self.agrees = self.bid.other == self.id && self.links.keeps(self.bid.owner);
}

}  // namespace banyan::baselines::link_consensus
