// SPDX-License-Identifier: MIT
// What a robot remembers between two steps, and what the rooms of a step share.
#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "banyan/controller/core/gate.hpp"
#include "banyan/controller/core/neighbors.hpp"
#include "banyan/controller/core/search.hpp"
#include "banyan/controller/paper/message.hpp"
#include "banyan/controller/paper/params.hpp"

namespace banyan::paper {

// The neighbours, and what each of them said last.
struct Neighborhood : Neighbors {
  std::array<Message, neighbor_capacity> messages{};
};

// A plain value: copy it, compare it, hash it. Its first part is what a robot says of itself; q is in its own frame.
struct State : Message {
  bool is_worker = false, target_known = false, centroid_known = false;
  SpareState spare_state = SpareState::wait;
  RobotId reference = nobody;  // the robot a spare stays with, or follows to a need
  Vec2 target;                 // C, own frame: where I was sent to, carried along while it is not sensed
  Vec2 pull;                   // own frame: u_target, my own or from below
  Vec2 centroid;               // C, own frame: of SELECT ROOT
  // Ticks since then, or for so long
  std::uint16_t phase_ticks = 0, done_ticks = 0, label_wait_ticks = 0, search_ticks = 0, orphan_ticks = 0;
  std::uint16_t childless_ticks = 0, offer_ticks = 0, unserved_ticks = 0, grant_ticks = 0;
  std::uint16_t request_ticks = 0, ungranted_ticks = 0;
  Tally tally;  // the algorithm never reads it
  Neighborhood neighbors;
};

struct Growth;   // outwards or inwards
struct Reading;  // literal or corrected

// Robot i in a step. An index j or k is a place in the neighbour table, -1: nowhere.
struct Robot {
  const Growth& growth;
  const Reading& reading;
  const Params& params;
  State& self;
  std::span<const Vec2> obstacles;  // nearest point of each within the proximity sensor's reach, own frame, C
  int elapsed_ticks;                // since the last step
  Serial epoch = 0;                 // when the step began: select_root() may open the next
  int parent = -1, old_parent = -1;
  int hold = -1;    // without a parent: the neighbour that I stay with (row t)
  int caller = -1;  // the neighbour through which an unanswered need is nearest (row b)

  [[nodiscard]] int size() const noexcept { return self.neighbors.size(); }
  [[nodiscard]] int find(RobotId id) const noexcept { return self.neighbors.find(id); }
  [[nodiscard]] RobotId id(int k) const noexcept { return k < 0 ? nobody : self.neighbors.id(k); }
  [[nodiscard]] const Message& said(int k) const noexcept {
    return self.neighbors.messages[static_cast<std::size_t>(k)];
  }
  [[nodiscard]] Vec2 position(int k) const noexcept { return self.neighbors.position(k); }
  [[nodiscard]] float range(int k) const noexcept { return self.neighbors.range(k); }
  [[nodiscard]] bool alive(int k) const noexcept { return k >= 0 && self.neighbors.alive(k); }
  [[nodiscard]] bool heard_now(int k) const noexcept { return self.neighbors.age(k) == 0; }
  [[nodiscard]] bool is_root() const noexcept { return self.root.id == self.id; }
  [[nodiscard]] bool names_me(int k) const noexcept {
    return said(k).parent == self.id || said(k).old_parent == self.id;
  }
  // A robot that has not entered this epoch yet names its parent of the last one: an old child.
  [[nodiscard]] bool is_child(int k) const noexcept {
    return alive(k) && said(k).parent == self.id && said(k).epoch == epoch;
  }
  [[nodiscard]] bool has_child() const noexcept {
    return any([&](int k) { return is_child(k); });
  }
  [[nodiscard]] bool is_below(int k) const noexcept { return alive(k) && names_me(k); }
  [[nodiscard]] bool is_tree_neighbor(int k) const noexcept { return k == parent || k == old_parent || names_me(k); }
  // The parent or, while there is none, the old one.
  [[nodiscard]] int up() const noexcept { return self.parent != nobody ? parent : old_parent; }
  void set_parent(RobotId id) noexcept { self.parent = id, parent = find(id); }
  void set_old_parent(RobotId id) noexcept { self.old_parent = id, old_parent = find(id); }
  // To a count of ticks those since the last step; it stays at its largest value.
  void add_elapsed(std::uint16_t& ticks) const noexcept {
    ticks = static_cast<std::uint16_t>(std::min(ticks + elapsed_ticks, UINT16_MAX));
  }

  // The neighbour with the least measure, the first of several; -1 if there is none below `limit`.
  template <class Limit, class Measure> [[nodiscard]] int least(Limit limit, Measure measure) const noexcept {
    int best = -1;
    for (int k = 0; k < size(); ++k)
      if (const Limit m = measure(k); m < limit) limit = m, best = k;
    return best;
  }
  template <class Measure> [[nodiscard]] int least(Measure measure) const noexcept {
    return least(not_counted, measure);
  }
  template <class Is> [[nodiscard]] bool any(Is is) const noexcept {
    return least(2, [&](int k) { return is(k) ? 1 : 2; }) >= 0;
  }
  // Calls visit(k, old) for the children, then with `old` for the old children.
  template <class Visit> void for_each_below(Visit visit) const noexcept {
    for (const bool old : {false, true})
      for (int k = 0; k < size(); ++k)
        if (is_below(k) && is_child(k) != old) visit(k, old);
  }
};

}  // namespace banyan::paper
