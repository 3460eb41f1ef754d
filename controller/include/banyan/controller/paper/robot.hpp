// SPDX-License-Identifier: MIT
// What the rooms of a step share: robot i, whom it hears, and where its parent and children are in the neighbour table.
// An index k or j is a place in that table, -1: nowhere.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "banyan/controller/core/gate.hpp"
#include "banyan/controller/paper/params.hpp"
#include "banyan/controller/paper/state.hpp"

namespace banyan::paper {

struct Growth;   // outwards or inwards (select_parent.hpp)
struct Reading;  // literal or corrected (corrections.hpp)

struct Indices {
  std::array<std::uint8_t, neighbor_capacity> items;  // ascending; the first `size` are valid
  std::uint8_t size = 0;
  void push(int k) noexcept { items[size++] = static_cast<std::uint8_t>(k); }
  [[nodiscard]] const std::uint8_t* begin() const noexcept { return items.data(); }
  [[nodiscard]] const std::uint8_t* end() const noexcept { return items.data() + size; }
};

struct Robot {
  const Growth& growth;
  const Reading& reading;
  const Params& params;
  State& self;
  std::span<const Vec2> obstacles;  // nearest point of each within the proximity sensor's reach, own frame, C
  int elapsed_ticks;                // since the last step
  int parent = -1;
  int old_parent = -1;
  int hold = -1;            // without a parent: the neighbour that I stay with (row t)
  int caller = -1;          // a spare: the neighbour through which an unanswered need is nearest (row b)
  int useful_children = 0;  // of both trees, that are no spares
  Indices children{};       // name me as parent
  Indices old_children{};   // name me as parent of the old tree

  [[nodiscard]] const Table& table() const noexcept { return self.neighbors; }
  [[nodiscard]] int neighbors() const noexcept { return self.neighbors.size(); }
  [[nodiscard]] const Message& said(int k) const noexcept {
    return self.neighbors.messages[static_cast<std::size_t>(k)];
  }
  [[nodiscard]] Vec2 position(int k) const noexcept { return self.neighbors.position(k); }
  [[nodiscard]] float range(int k) const noexcept { return self.neighbors.range(k); }
  [[nodiscard]] bool alive(int k) const noexcept { return k >= 0 && self.neighbors.alive(k); }
  [[nodiscard]] bool is_root() const noexcept { return self.root.id == self.id; }
  // The addressee of q and pull.
  [[nodiscard]] int up() const noexcept { return self.parent != nobody ? parent : old_parent; }
  [[nodiscard]] bool is_tree_neighbor(int k) const noexcept {
    const Message& m = said(k);
    return k == parent || k == old_parent || m.parent == self.id || m.old_parent == self.id;
  }
  void set_parent(RobotId id) noexcept { self.parent = id, parent = self.neighbors.find(id); }
  void set_old_parent(RobotId id) noexcept { self.old_parent = id, old_parent = self.neighbors.find(id); }
  // To a count of ticks: those since the last step. It stays at its largest value.
  void add_elapsed(std::uint16_t& ticks) const noexcept {
    ticks = static_cast<std::uint16_t>(std::min(ticks + elapsed_ticks, UINT16_MAX));
  }
};

}  // namespace banyan::paper
