// SPDX-License-Identifier: MIT
// What the rooms of the controller share during one step: parameters, state, and a survey of the
// neighbour table that is made once per tick so that no room has to search it again.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "banyan/controller/params.hpp"
#include "banyan/controller/state.hpp"

namespace banyan {

class Policy;

// Indices into the neighbour table, ascending.
struct IndexList {
  std::array<std::uint8_t, neighbor_capacity> items;  // the first `size` are valid
  std::uint8_t size = 0;
  void push(int k) noexcept { items[size++] = static_cast<std::uint8_t>(k); }
  [[nodiscard]] const std::uint8_t* begin() const noexcept { return items.data(); }
  [[nodiscard]] const std::uint8_t* end() const noexcept { return items.data() + size; }
};

struct Robot {
  Robot(const Params& params_, const Policy& policy_, State& self_, std::span<const Heard> heard_, const Vec2* target_,
        std::span<const Vec2> obstacles_ = {}) noexcept
      : params(params_), policy(policy_), self(self_), target(target_), heard(heard_), obstacles(obstacles_) {}

  const Params& params;
  const Policy& policy;
  State& self;
  const Vec2* target;          // own frame, m; null unless a worker
  std::span<const Heard> heard;
  std::span<const Vec2> obstacles;  // nearest point of each within the proximity sensor's reach, own frame, m

  // Survey (survey.hpp)
  int parent = -1;             // index of the parent in the table
  int old_parent = -1;
  IndexList children;          // living neighbours that name me as parent
  IndexList old_children;      // living neighbours that name me as old parent and not as parent
  std::uint8_t call_hops = nobody_calls;  // the smallest among living neighbours
  std::uint8_t useful_children = 0;  // living children (by parent or old parent) that are no spares

  [[nodiscard]] const Neighborhood& table() const noexcept { return self.neighbors; }
  [[nodiscard]] bool is_root() const noexcept { return self.root.id == self.id; }
  // I, and longer where packets are lost (healing.hpp).
  [[nodiscard]] int liveness_ticks() const noexcept {
    return std::max(params.ticks(params.liveness_period_s), static_cast<int>(self.liveness_ticks));
  }
  // How long a connector waits for a child; one that has just chosen it may not have been heard yet.
  [[nodiscard]] int patience_ticks() const noexcept {
    return std::max(params.ticks(params.connector_patience_s), static_cast<int>(self.liveness_ticks));
  }
  // Neighbour k is at the other end of an edge of mine, old or new.
  [[nodiscard]] bool is_tree_neighbor(int k) const noexcept {
    const Standing& m = table().message(k);
    return k == parent || k == old_parent || m.parent == self.id || m.old_parent == self.id;
  }
  // What my parent has said this tick; null if I did not hear it.
  [[nodiscard]] const Message* parent_message() const noexcept {
    if (self.parent == nobody) return nullptr;
    const auto it = std::find_if(heard.begin(), heard.end(), [&](const Heard& h) { return h.message->id == self.parent; });
    return it == heard.end() ? nullptr : it->message;
  }
  [[nodiscard]] bool parent_alive() const noexcept { return parent >= 0 && table().alive(parent); }
  [[nodiscard]] bool old_parent_alive() const noexcept { return old_parent >= 0 && table().alive(old_parent); }
};

}  // namespace banyan
