// SPDX-License-Identifier: MIT
// Counters that wrap (epochs, root tokens, sequence numbers, heartbeats): serial numbers of 16 bits,
// compared as in RFC 1982. Of two numbers the one is newer that is ahead by less than half the range.
//
// The one rule for silence: a robot that has heard nothing of a counter for half its range of ticks cannot tell old
// from new any more, and takes anything it hears as newer (`is_news`). Epochs and root tokens do not count ticks, so
// is_newer() does for them: epochs advance once in R and at elections, tokens when the root changes.
// Three rules about counts of ticks do without it, since nothing is lost there: join_edge (a robot so far behind has no
// label that could fall back), remember_corners (it keeps the place where it last heard the tree) and settle_rivalry (a
// rival that is ignored hears my count and resigns, or is believed as soon as its own gets ahead).
// test/serial_numbers_test.cpp finds counters that are compared as plain numbers.
#pragma once

#include <cstdint>

namespace banyan {

using Serial = std::uint16_t;

// The number `by` after `a`, or before it; past the last one it goes on at 0.
constexpr Serial advanced(Serial a, int by = 1) noexcept { return static_cast<Serial>(a + by); }

inline constexpr int serial_half_range = 32768;

// By how much `a` is ahead of `b`: in [-32768, 32767], negative if it is behind.
constexpr int ahead_by(Serial a, Serial b) noexcept { return static_cast<std::int16_t>(static_cast<Serial>(a - b)); }

constexpr bool is_newer(Serial a, Serial b) noexcept { return ahead_by(a, b) > 0; }

// Whether `heard` is newer than `known`, which was last renewed `silence_ticks` ago.
constexpr bool is_news(Serial heard, Serial known, int silence_ticks) noexcept {
  return is_newer(heard, known) || (silence_ticks >= serial_half_range && heard != known);
}

}  // namespace banyan
