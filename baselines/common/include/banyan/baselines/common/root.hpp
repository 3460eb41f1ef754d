// SPDX-License-Identifier: MIT
// The robot that metrics take as root where a source has none: its id spreads with an age, and is forgotten unless its
// owner goes on saying it.
#pragma once

#include <algorithm>
#include <cstdint>

#include "banyan/baselines/common/table.hpp"
#include "banyan/controller/core/report.hpp"

namespace banyan::baselines {

inline constexpr int news_ticks = 64;  // news that are older are none; so many hops may be between two robots

// How old the news of neighbour k are by now.
template <class Message> int age_now(int said, const Table<Message>& table, int k) noexcept {
  return said + 1 + table.age(k);
}

struct KnownRoot {
  RobotId root = nobody;
  std::uint8_t root_age = 0;
  std::uint8_t rootless_ticks = 0;

  // The smallest id among those that call themselves root; where there is none, a robot that is no worker calls
  // itself so.
  template <class Message>
  void follow_root(RobotId me, bool worker, const Table<Message>& table, int elapsed_ticks, Tally& tally) noexcept {
    RobotId best = root == me && !worker ? me : nobody;
    int best_age = 0;
    for (int k = 0; k < table.size(); ++k) {
      const Message& m = table.message(k);
      const int age = age_now(m.root_age, table, k);
      if (m.root == nobody || m.root == me || age > news_ticks) continue;
      if (m.root > best || (m.root == best && age >= best_age)) continue;
      best = m.root;
      best_age = age;
    }
    rootless_ticks = static_cast<std::uint8_t>(best == nobody ? std::min(rootless_ticks + elapsed_ticks, 255) : 0);
    if (rootless_ticks > news_ticks && !worker) {
      best = me;
      ++tally.elections;
    }
    root = best;
    root_age = static_cast<std::uint8_t>(best_age);
  }
};

}  // namespace banyan::baselines
