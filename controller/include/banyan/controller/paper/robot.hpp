// SPDX-License-Identifier: MIT
// What the rooms of a step share.
#pragma once

#include <algorithm>
#include <utility>

#include "banyan/controller/core/gate.hpp"
#include "banyan/controller/core/search.hpp"
#include "banyan/controller/paper/params.hpp"
#include "banyan/controller/paper/state.hpp"

namespace banyan::paper {

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
  bool is_station = false;          // somebody else moves it, and it keeps what it holds
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
