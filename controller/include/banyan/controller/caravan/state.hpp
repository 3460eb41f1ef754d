// SPDX-License-Identifier: MIT
// All that a robot of caravan remembers between two steps.
#pragma once

#include "banyan/controller/caravan/message.hpp"
#include "banyan/controller/core/neighbors.hpp"

namespace banyan::caravan {

struct Table : Neighbors {
  std::array<Standing, neighbor_capacity> standings{};
};

struct State : Message {
  bool is_worker = false;
  bool target_known = false;
  bool rests = false;              // its beat, so that another robot gets ahead
  std::uint16_t other_rounds = 0;  // for how long the old promise has stood beside the new one
  std::uint16_t rest_rounds = 0;
  std::uint16_t childless_rounds = 0;
  std::uint16_t call_silence = 0;  // since the count of the call advanced
  std::uint16_t unserved_rounds = 0;
  float expected_packets = 0.0F;   // that were to be heard of late, fading
  float missed_packets = 0.0F;     // and of them those that were not
  std::uint16_t loss_rounds = 0;   // for so long a robot that is there may be silent by chance; 0: no packets get lost
  std::uint8_t longest_silence = 0;  // that ended lately; 0: no packets get lost
  std::uint16_t round = 0;
  Vec2 target;  // C, own frame
  Tally tally;  // never read
  Table neighbors;

  void prefetch(std::size_t entries) const noexcept {
    neighbors.prefetch(entries);
    prefetch_lines(neighbors.standings.data(), std::min<std::size_t>(entries, neighbor_capacity) * sizeof(Standing));
  }
};

}  // namespace banyan::caravan
