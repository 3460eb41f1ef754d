// SPDX-License-Identifier: MIT
// No source of link consensus has a root. Here the mission names one, and it decides only two things: which robots
// need a new link (those that no path of kept links joins to it) and which links may be proposed (those on no
// robot's shortest path to it). The root counts ticks, and the count spreads over kept links. Where it has stopped
// for long, the robots elect another root, the one with the smallest id.
#include <algorithm>

#include "rooms.hpp"

namespace banyan::baselines::link_consensus {
namespace {

constexpr int beat_slack = 16;     // a count so far behind the newest still counts as fresh: it took a longer path
constexpr int long_link_cost = 8;  // how many hops longer a path may be to avoid a link that may be proposed

// Old counts of a root that has fallen silent are ignored, by the rule for every counter here (serial.hpp).
bool names_a_root(const State& self, const Message& m) noexcept {
  const bool lost = m.root == self.lost_root && !is_news(m.beat, self.lost_beat, self.lost_ticks);
  return m.root != nobody && m.way != not_rooted && !lost && m.root != self.id;
}

void forget_root(State& self) noexcept {
  self.lost_root = self.root;
  self.lost_beat = self.beat;
  self.lost_ticks = self.silent_ticks;
  self.root = nobody;
  self.way = not_rooted;
  self.parent = nobody;
}

// The robot with the smallest id is the first to take a lost root's place; the others give it time to be heard.
bool is_first(const Robot& robot) noexcept {
  for (int k = 0; k < robot.table().size(); ++k)
    if (robot.table().id(k) < robot.self.id && is_kept(robot, k)) return false;
  return true;
}

int grown(int ticks, const Robot& robot) noexcept { return std::min(ticks + robot.elapsed_ticks, 0xFFFF); }

// The better of two roots has the smaller id.
RobotId best_root(const Robot& robot) noexcept {
  RobotId best = robot.self.root;
  for (int k = 0; k < robot.table().size(); ++k) {
    const Message& m = robot.table().message(k);
    if (m.root < best && names_a_root(robot.self, m) && is_kept(robot, k)) best = m.root;
  }
  return best;
}

void take_path(Robot& robot) noexcept {
  State& self = robot.self;
  const Table<Message>& table = robot.table();
  const auto tells = [&](int k) {
    return table.message(k).root == self.root && names_a_root(self, table.message(k)) && is_kept(robot, k);
  };
  Serial newest = self.beat;
  for (int k = 0; k < table.size(); ++k)
    if (tells(k) && is_newer(table.message(k).beat, newest)) newest = table.message(k).beat;
  if (newest != self.beat) self.silent_ticks = 0;
  self.beat = newest;
  int up = -1;
  const auto way = [&](int k) {
    const bool is_long = table.range(k) > robot.params.nominate_distance;
    return std::min<int>(table.message(k).way + (is_long ? long_link_cost : 1), not_rooted - 1);
  };
  for (int k = 0; k < table.size(); ++k) {
    if (!tells(k) || ahead_by(table.message(k).beat, newest) < -beat_slack) continue;
    const bool stays = up >= 0 && way(k) == way(up) && table.id(k) == self.parent;
    if (up < 0 || way(k) < way(up) || stays) up = k;
  }
  self.parent = up >= 0 ? table.id(up) : nobody;
  self.way = up >= 0 ? static_cast<std::uint16_t>(way(up)) : not_rooted;
}

}  // namespace

void follow_root(Robot& robot) noexcept {
  State& self = robot.self;
  const int patience = whole(robot.params.root_silence_rounds);
  self.lost_ticks = static_cast<std::uint16_t>(grown(self.lost_ticks, robot));
  const RobotId best = best_root(robot);
  if (best != self.root) {
    self.root = best;
    self.silent_ticks = 0;
    for (int k = 0; k < robot.table().size(); ++k)
      if (robot.table().message(k).root == best) self.beat = robot.table().message(k).beat;
  }
  if (self.root == self.id) {
    ++self.beat;
    self.way = 0;
    self.parent = nobody;
    return;
  }
  self.silent_ticks = static_cast<std::uint16_t>(grown(self.silent_ticks, robot));
  if (self.root != nobody) take_path(robot);
  if (self.root != nobody && self.silent_ticks > patience) forget_root(self);
  if (self.root != nobody || self.assignment.sent || self.links.size() == 0) return;
  if (self.silent_ticks > patience + (is_first(robot) ? 0 : alone_ticks)) {
    self.root = self.id;
    self.silent_ticks = 0;
    ++self.tally.elections;
  }
}

}  // namespace banyan::baselines::link_consensus
