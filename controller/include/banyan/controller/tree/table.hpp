// SPDX-License-Identifier: MIT
// The neighbour table with what each neighbour said of the tree, and the sets of neighbours that spares ask for again
// and again. Few messages change a set, so they are kept up to date as packets are filed.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "banyan/controller/core/neighbors.hpp"
#include "banyan/controller/tree/message.hpp"

namespace banyan {

// A neighbour deaf for longer does not hear me. One that has heard me may be deaf to me for a while because packets get
// lost; one that never has counts from the second number, and has the time between that an answer takes with latency.
inline constexpr std::uint8_t deaf_after_ticks = 120;
inline constexpr std::uint8_t never_heard_ticks = 110;  // from here one counts that has never heard me

struct TreeTable : Neighbors {
  Rows members;  // of the tree: no spares
  Rows nearest;  // the fewest hops away from the rooted tree, least_hops
  Rows below;    // name me as parent or old parent
  Rows untied;   // have neither, and no hold but me
  Rows deaf;     // for longer than deaf_after_ticks
  std::uint8_t least_hops = unreachable;
  std::array<TreeStanding, neighbor_capacity> standings{};
  // For how long the neighbour has not heard me, although I hear it; 0: it does (healing/mutual.cpp).
  std::array<std::uint8_t, neighbor_capacity> deaf_ticks{};

  [[nodiscard]] const TreeStanding& message(int k) const noexcept { return standings[static_cast<std::size_t>(k)]; }

  // Neighbour k says this to robot `me`, for the first time or again.
  void keep(int k, const TreeStanding& said, RobotId me, bool is_new) noexcept {
    TreeStanding& kept = standings[static_cast<std::size_t>(k)];
    if (is_new || static_cast<const TreeTies&>(said) != kept) sort(k, said, me);
    kept = said;
  }
  void set_deaf(int k, int ticks) noexcept {
    deaf_ticks[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(std::min(ticks, UINT8_MAX));
    deaf.set(k, ticks > deaf_after_ticks);
  }
  // Entry k, which remove_next() has removed.
  void forget(int k) noexcept;

  void prefetch(std::size_t entries) const noexcept;

 private:
  void sort(int k, const TreeTies& said, RobotId me) noexcept;  // into the sets
  void find_nearest() noexcept;
};

}  // namespace banyan
