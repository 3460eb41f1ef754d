// SPDX-License-Identifier: MIT
// All that a robot of caravan remembers between two steps.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "banyan/controller/caravan/message.hpp"
#include "banyan/controller/core/neighbors.hpp"
#include "banyan/controller/core/search.hpp"
#include "banyan/controller/obstacles/state.hpp"

namespace banyan::caravan {

struct Table : Neighbors {
  std::array<Statement, neighbor_capacity> statements{};
};

// The root's token, or a target's: a name, a holder, a count and a place.
struct Token {
  RobotId name = nobody;
  RobotId holder = nobody;
  Serial beat = 0;
  std::uint16_t age = 0;  // rounds since its count advanced
  Vec2 place;             // C, own frame
  bool located = false;   // I know the place
  bool reached = false;
  bool charging = false;    // one is charged there
  std::uint8_t urgent = 0;  // for so many rounds it is told out of turn
};
inline constexpr std::size_t most_tokens = 65;

inline constexpr std::size_t most_corners = 8;

struct State : Message {
  Root newest;          // that I have heard of; my place in the order may still be that of an older one
  float level = -1.0F;  // of a full battery; below 0: it has none
  bool was_charged = false;
  bool seeks_charge = false;
  RobotId serves = nobody;  // the target that I hold, by its name
  bool was_sent = false;
  bool unfit = false;              // it came no nearer to a target although nothing held it back
  float nearest = not_counted;     // C: so near to its target it has come
  float effort = 0.0F;             // and so far it should have come since, C
  std::uint16_t stuck_rounds = 0;  // and for so long
  std::uint8_t token_count = 1;
  std::uint8_t turn = 0;  // which token is told next
  std::uint8_t urgent_turn = 0;
  std::array<Token, most_tokens> tokens{};  // the first `token_count`; the root's is the first
  bool rests = false;                       // its beat, so that another robot gets ahead
  std::uint16_t other_rounds = 0;           // for how long the old promise has stood beside the new one
  std::uint16_t rest_rounds = 0;
  std::uint16_t childless_rounds = 0;
  RobotId left = nobody;  // the parent that I had before; it may not know yet
  Call ended;             // the call that ended last: no older count of its source counts for a while
  std::uint16_t ended_rounds = 0;
  std::uint8_t post_count = 0;     // of my own posts, a round at a time
  std::uint16_t call_silence = 0;  // since the count of the call advanced
  std::uint16_t unserved_rounds = 0;
  float expected_packets = 0.0F;  // that were to be heard of late, fading
  float missed_packets = 0.0F;    // and of them those that were not
  std::uint16_t loss_rounds = 0;  // for so long a robot that is there may be silent by chance; 0: no packets get lost
  std::uint8_t assumed_silence = 0;  // packets get lost: so long a promise may have to last, less as time goes by
  std::uint16_t round = 0;
  std::uint16_t since_start = 0;
  std::array<Vec2, most_corners> corners{};  // points of obstacles that were passed; the first `corner_count`
  std::uint8_t corner_count = 0;
  Detour detour;  // the way round an obstacle
  Tally tally;    // never read
  Table neighbors;

  [[nodiscard]] std::span<Token> known() noexcept { return {tokens.data(), token_count}; }
  [[nodiscard]] std::span<const Token> known() const noexcept { return {tokens.data(), token_count}; }
  // Where my target is; null: I have none, or do not know.
  [[nodiscard]] const Vec2* target() const noexcept {
    if (serves == nobody) return nullptr;
    for (const Token& t : known())
      if (t.name == serves) return t.located ? &t.place : nullptr;
    return nullptr;
  }

  void prefetch(std::size_t entries) const noexcept {
    neighbors.prefetch(entries);
    prefetch_lines(neighbors.statements.data(), std::min<std::size_t>(entries, neighbor_capacity) * sizeof(Statement));
  }
};

}  // namespace banyan::caravan
