// SPDX-License-Identifier: MIT
// Which links exist. New ones are those of the relative neighbourhood graph (Toussaint 1980): no third robot is nearer
// to both ends. It needs only the neighbours' positions and contains the Euclidean minimum spanning tree, so that it
// is connected wherever the radio graph is: the local choice of Cornejo et al. 2009.
#include <algorithm>

#include "rooms.hpp"

namespace banyan::baselines::link_consensus {
namespace {

constexpr int offer_steps = 10;        // an offer that is not taken up is withdrawn
constexpr float room_to_move = 0.97F;  // of the longest link: a new link must not be too long at once

void drop_lost(Robot& robot) noexcept {
  State& self = robot.self;
  const Table<Message>& table = robot.table();
  for (int l = self.links.size() - 1; l >= 0; --l) {
    Link& link = self.links[l];
    const int k = table.find(link.to);
    const bool answered = k >= 0 && lists(table.message(k), self.id);
    if (answered) {
      if (link.repairs) ++self.tally.repairs;
      link.kept = true;
      link.repairs = false;
    } else if (k < 0 || link.kept) {  // silent for long, or given up by the other end
      self.links.remove(l);
    } else {
      if (++link.offered_steps > offer_steps) self.links.remove(l);
    }
  }
  const int k = self.given_up == nobody ? -1 : table.find(self.given_up);
  if (k < 0 || !lists(table.message(k), self.id)) self.given_up = nobody;
}

// No third robot is nearer to both ends.
bool is_relative_neighbor(const Robot& robot, int k) noexcept {
  const Table<Message>& table = robot.table();
  const float d = table.range(k);
  for (int j = 0; j < table.size(); ++j)
    if (j != k && table.range(j) < d && distance(table.position(j), table.position(k)) < d) return false;
  return true;
}

// The sender of m is joined to a root and I am not, or to a better root than mine.
bool stands_better(const Robot& robot, const Message& m) noexcept {
  const State& self = robot.self;
  if (m.way == not_rooted) return false;
  if (self.way == not_rooted) return self.silent_ticks > alone_ticks;
  return m.root < self.root;
}

// An offer is taken up if the link is short, or if it joins a robot that is cut off, or two roots.
bool takes_up(const Robot& robot, int k) noexcept {
  const Message& m = robot.table().message(k);
  const State& self = robot.self;
  const bool joins = m.way == not_rooted || self.way == not_rooted || m.root != self.root;
  return robot.table().range(k) < (joins ? room_to_move * robot.params.longest_link : robot.params.add_distance);
}

bool wants(const Robot& robot, int k) noexcept {
  if (lists(robot.table().message(k), robot.self.id)) return takes_up(robot, k);
  return robot.table().range(k) < robot.params.add_distance && is_relative_neighbor(robot, k);
}

// A robot that is cut off offers a link to the nearest robot that is not; -1: none.
int way_back(const Robot& robot) noexcept {
  const Table<Message>& table = robot.table();
  int nearest = -1;
  for (int k = 0; k < table.size(); ++k) {
    if (table.age(k) > 0 || !(table.range(k) < room_to_move * robot.params.longest_link) ||
        !stands_better(robot, table.message(k)))
      continue;
    if (nearest < 0 || table.range(k) < table.range(nearest)) nearest = k;
  }
  return nearest;
}

void offer(State& self, RobotId id, bool repairs) noexcept {
  if (id != self.given_up && self.links.find(id) < 0) self.links.offer(id, repairs);
}

}  // namespace

bool is_detoured(const Robot& robot, int k) noexcept {
  const Table<Message>& table = robot.table();
  const float d = table.range(k);
  for (int j = 0; j < table.size(); ++j) {
    if (j == k || !(table.range(j) < d) || !(distance(table.position(j), table.position(k)) < d)) continue;
    if (robot.self.links.keeps(table.id(j)) && lists(table.message(j), table.id(k))) return true;
  }
  return false;
}

void renew_links(Robot& robot) noexcept {
  State& self = robot.self;
  drop_lost(robot);
  for (int k = 0; k < robot.table().size(); ++k)
    if (robot.table().age(k) == 0 && wants(robot, k)) offer(self, robot.table().id(k), false);
  if (const int back = way_back(robot); back >= 0) offer(self, robot.table().id(back), true);
}

}  // namespace banyan::baselines::link_consensus
