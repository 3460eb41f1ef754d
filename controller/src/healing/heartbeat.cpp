// SPDX-License-Identifier: MIT
#include <algorithm>

#include "healing/healing.hpp"
#include "healing/tie.hpp"
#include "tree/epoch.hpp"

namespace banyan {
namespace {

void beat(HealingRobot& robot) noexcept {
  HealingState& self = robot.self;
  self.heart = self.root;
  ++self.heartbeat;
  // No robot hears it: root_at stays where the others were last (retreat.cpp).
  if (self.root_known && hears_nobody(robot)) return robot.add_elapsed(self.silence_ticks);
  self.silence_ticks = 0;
  self.root_at = {};
  self.root_known = true;
}

// The largest count of the newest root. Messages of robots that do not know that root yet are ignored.
void hear_heartbeat(HealingRobot& robot) noexcept {
  HealingState& self = robot.self;
  robot.add_elapsed(self.silence_ticks);
  for (const Heard& h : robot.news) {
    const HealingMessage& m = said(h);
    if (m.root != self.root) continue;
    if (self.heart == self.root && !is_news(m.heartbeat, self.heartbeat, self.silence_ticks)) continue;
    self.heart = self.root;
    self.heartbeat = m.heartbeat;
    self.root_size = m.root_size;
    if (self.usual_silence > 0)
      self.usual_silence = static_cast<std::uint8_t>(
          std::clamp<int>(self.silence_ticks - robot.elapsed_ticks, self.usual_silence, longest_silence_ticks));
    self.silence_ticks = 0;
  }
}

// From the root itself, else from a robot nearly as near to it as I am or nearer, as its count shows.
void locate_root(HealingRobot& robot) noexcept {
  constexpr int stale_ticks = 1;  // a count farther behind mine is old news
  HealingState& self = robot.self;
  for (const Heard& h : robot.news) {
    const HealingMessage& m = said(h);
    if (m.root != self.root) continue;
    if (m.id == m.root.id) {
      self.root_at = h.position;
      self.root_known = true;
      return;
    }
    // Once the root is silent, copies of copies would only drift.
    if (m.told != self.id || !m.root_told || ahead_by(m.heartbeat, self.heartbeat) < -stale_ticks) continue;
    if (self.root_known && self.silence_ticks > robot.liveness_ticks()) continue;
    Vec2 point;
    if (!robot.read_point(h, m.root_x, m.root_y, point)) continue;
    self.root_at = point;
    self.root_known = true;
  }
}

// The root's heartbeat has stopped, and I am near where it was.
bool outlives_root(const HealingRobot& robot) noexcept {
  const HealingParams& p = robot.params;
  const float away = norm(robot.self.root_at);
  if (away > p.claim_radius) return false;
  return robot.self.silence_ticks >
         2 * robot.liveness_ticks() + whole(p.claim_after_rounds + p.claim_spread_rounds * away);
}

// No root has ever been heard: it died too early. The robot with the smallest id among its neighbours becomes root.
// Several robots far from each other may claim; one token wins.
bool misses_first_root(const HealingRobot& robot) noexcept {
  constexpr int first_root_ticks = 200;  // by then the first token has travelled 200 hops
  // In a thin start where packets get lost, part of the network may have to be fetched first. And among few neighbours,
  // as in a line whose bodies hide all others, the token has one way, on which each burst of loss holds it up.
  constexpr int fetched_later = 3;  // times as long
  constexpr int few_ways = 4;       // neighbours
  const TreeTable& table = robot.table();
  const bool is_slow = is_thin(robot.self) || table.size() <= few_ways;
  const int patience_ticks = first_root_ticks * (is_slow ? fetched_later : 1);
  if (robot.self.silence_ticks <= patience_ticks || hears_nobody(robot)) return false;
  for (int k = 0; k < table.size(); ++k)
    if (table.alive(k) && table.message(k).role != Role::worker && table.id(k) < robot.self.id) return false;
  return true;
}

}  // namespace

bool hears_nobody(const HealingRobot& robot) noexcept {
  const TreeTable& table = robot.table();
  for (int k = 0; k < table.size(); ++k)
    if (table.alive(k)) return false;
  return true;
}

void follow_heartbeat(HealingRobot& robot) noexcept {
  if (!robot.params.heals()) return;
  if (robot.is_root()) return beat(robot);
  hear_heartbeat(robot);
  locate_root(robot);
}

void claim_root(HealingRobot& robot) noexcept {
  HealingState& self = robot.self;
  if (!robot.params.heals() || robot.is_root() || self.is_worker) return;
  if (self.root_known ? !outlives_root(robot) : !misses_first_root(robot)) return;
  self.root = {advanced(self.root.sequence), self.id};
  self.root_size = 0;  // no robot has been counted yet: a fragment that still has a root keeps it
  self.role = Role::root;
  enter(robot, advanced(self.epoch), Phase::start_tree);
  beat(robot);
  ++self.tally.elections;
}

}  // namespace banyan
