// SPDX-License-Identifier: MIT
// A robot of caravan in one step: what it remembers, and what follows from that in this round.
#pragma once

#include "banyan/controller/caravan/params.hpp"
#include "banyan/controller/caravan/state.hpp"
#include "banyan/controller/core/gate.hpp"
#include "banyan/controller/core/search.hpp"

namespace banyan::caravan {

struct Heard {
  const Message* message;
  Vec2 position;
  float age_s;
};

struct Robot {
  const Params& params;
  State& self;
  std::span<const Vec2> obstacles;
  int elapsed_rounds;
  int parent = -1;  // their entries in the table
  int other = -1;
  Rows children{};  // robots of the tree that name me as their parent
  int child_count = 0;
  Rows tied{};  // all that name me as parent or old parent, or nobody

  [[nodiscard]] Table& table() noexcept { return self.neighbors; }
  [[nodiscard]] const Table& table() const noexcept { return self.neighbors; }
  [[nodiscard]] const Standing& said(int k) const noexcept {
    return self.neighbors.standings[static_cast<std::size_t>(k)];
  }
  [[nodiscard]] Vec2 position(int k) const noexcept { return self.neighbors.position(k); }
  [[nodiscard]] float range(int k) const noexcept { return self.neighbors.range(k); }
  [[nodiscard]] bool is_root() const noexcept { return self.root.id == self.id; }
  [[nodiscard]] bool is_tree(int k) const noexcept { return said(k).role != Role::spare; }
  // So long a robot that is there may be silent by chance.
  [[nodiscard]] int liveness() const noexcept { return whole(params.liveness_rounds); }
  void add_elapsed(std::uint16_t& rounds) const noexcept {
    rounds = static_cast<std::uint16_t>(std::min(rounds + elapsed_rounds, UINT16_MAX));
  }
};

}  // namespace banyan::caravan
