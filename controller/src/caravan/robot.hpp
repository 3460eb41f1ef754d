// SPDX-License-Identifier: MIT
// A robot of caravan in one step: what it remembers, and what follows from that in this round.
#pragma once

#include <algorithm>
#include <span>

#include "banyan/controller/caravan/params.hpp"
#include "banyan/controller/caravan/state.hpp"
#include "banyan/controller/core/gate.hpp"
#include "banyan/controller/core/search.hpp"

namespace banyan::caravan {

struct Robot {
  const Params& params;
  State& self;
  std::span<const Vec2> obstacles;
  int elapsed_rounds;
  Carry carry;
  std::span<Heard> heard;
  bool is_station = false;  // somebody else moves it, and it keeps what it holds
  int parent = -1;          // their entries in the table
  int other = -1;
  Rows children{};  // robots of the tree that name me as their parent
  int child_count = 0;
  int caller = -1;  // of a spare: the neighbour through which the nearest post is reached

  [[nodiscard]] Table& table() noexcept { return self.neighbors; }
  [[nodiscard]] const Table& table() const noexcept { return self.neighbors; }
  [[nodiscard]] const Statement& said(int k) const noexcept {
    return self.neighbors.statements[static_cast<std::size_t>(k)];
  }
  [[nodiscard]] Vec2 position(int k) const noexcept { return self.neighbors.position(k); }
  [[nodiscard]] float range(int k) const noexcept { return self.neighbors.range(k); }
  // An edge's length, as if one path were enough: with k paths all neighbours of a robot are to hear each other.
  [[nodiscard]] float stretched(float d) const noexcept { return d * static_cast<float>(params.link_redundancy); }
  // The other way: how long an edge may be where that length would do for one path.
  [[nodiscard]] float shortened(float d) const noexcept { return d / static_cast<float>(params.link_redundancy); }
  [[nodiscard]] bool is_root() const noexcept { return self.newest.id == self.id; }
  [[nodiscard]] bool is_tree(int k) const noexcept { return said(k).role != Role::spare; }
  // An edge of the tree joins neighbour k and me.
  [[nodiscard]] bool is_edge(int k) const noexcept {
    return self.role != Role::spare && is_tree(k) && (self.neighbors.id(k) == self.parent || said(k).parent == self.id);
  }
  // Two clocks for silence. By chance a robot that is there is silent for so long once in a hundred thousand times;
  // packets may also get lost many in a row. Beyond that it is not believed any more, and is replaced.
  [[nodiscard]] int liveness() const noexcept { return std::max<int>(whole(params.liveness_rounds), self.loss_rounds); }
  // For so long I stay near a silent robot to which I have promised it.
  [[nodiscard]] int lease() const noexcept { return std::max<int>(liveness(), 2 * self.assumed_silence); }
  // And in the tree, where the other end may have gone to look for me, or is to be met where it died.
  [[nodiscard]] int tree_lease() const noexcept { return std::max(lease(), params.rounds(params.pursue_drives)); }
  // A silence that lost packets do not explain: something stands between us.
  [[nodiscard]] int hidden_after() const noexcept { return std::max(2, self.loss_rounds * 3 / 5); }
  [[nodiscard]] bool is_lost(int k) const noexcept { return self.neighbors.age(k) > liveness(); }
  // A worker at either end of the edge to my parent, or below me, still has to go on; or it is too long for k paths.
  [[nodiscard]] bool is_wanted() const noexcept {
    return self.want > 0 || (parent >= 0 && said(parent).role == Role::worker && said(parent).want > 0) ||
           (params.link_redundancy > 1 && parent >= 0 && stretched(range(parent)) > params.longest_edge);
  }
  // Neighbour k, as I am its child, has no other one.
  [[nodiscard]] bool serves_only_me(int k) const noexcept {
    return said(k).role == Role::connector && said(k).children <= 1;
  }
  void add_elapsed(std::uint16_t& rounds) const noexcept {
    rounds = static_cast<std::uint16_t>(std::min(rounds + elapsed_rounds, UINT16_MAX));
  }
};

}  // namespace banyan::caravan
