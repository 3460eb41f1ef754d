// SPDX-License-Identifier: MIT
// The one gate through which everything sensed passes before an algorithm sees it: a step is given Inputs,
// and nothing but the gate makes them. What is not finite, or beyond wide limits that no working sensor
// exceeds, counts as not sensed; odometry that is not possible counts as no motion. No later code can meet
// a NaN.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "banyan/controller/core/inputs.hpp"
#include "banyan/controller/core/platform.hpp"

namespace banyan {

inline constexpr float farthest_ranges = 10.0F;  // of C: a neighbour, an obstacle, a way driven in one step
inline constexpr float farthest_target_m = 1.0e6F;
inline constexpr float largest_turn_rad = 1.0e3F;  // in one step; trig.hpp is exact up to 1e4
inline constexpr float longest_step_s = 3600.0F;
inline constexpr std::size_t most_obstacles = 64;  // that are looked at in one step: the first

// What passed, and how much did not. Lives as long as the step: obstacles may lie in it.
class Gate {
 public:
  Gate(const Senses& senses, const Platform& platform) noexcept;
  Gate(const Gate&) = delete;
  Gate& operator=(const Gate&) = delete;

  // Drops packets whose sender cannot be where, or when, it was measured to be, in place; the order stays.
  template <class Heard> std::span<Heard> packets(std::span<Heard> heard, const Platform& platform) noexcept {
    const float limit_m = farthest_ranges * platform.communication_range_m;
    const auto is_possible = [limit_m](const Heard& h) {
      return is_within(h.position, limit_m) && h.age_s >= 0.0F && h.age_s <= longest_step_s;
    };
    std::size_t kept = 0;
    for (const Heard& h : heard) {
      if (!is_possible(h)) {
        ++rejected_;
        continue;
      }
      aged_ |= h.age_s > 0.0F;
      if (&h != &heard[kept]) heard[kept] = h;  // mostly all pass, and stay where they are
      ++kept;
    }
    return heard.first(kept);
  }

  // Of those that have passed, positions measured some time ago, in the frame of then, as they are now in the present
  // frame: what is left of the odometry, which is in the frame at the last step, is turned into the frame of the
  // packet.
  template <class Heard> void carry_to_now(std::span<Heard> heard, const Platform& platform) const noexcept {
    if (!aged_) return;
    const Odometry& odometry = senses_.odometry;
    const float elapsed_s = senses_.elapsed_s > 0.0F ? senses_.elapsed_s : platform.tick_s;
    for (Heard& h : heard) {
      if (!(h.age_s > 0.0F)) continue;
      const float share = std::min(h.age_s / elapsed_s, 1.0F);
      const Vec2 shift = rotate_back(unit_vector(odometry.turn_rad * (1.0F - share)),
                                     Vec2{odometry.forward_m, odometry.sideways_m} * share);
      h.position = Carry({shift.x, shift.y, odometry.turn_rad * share}).point(h.position);
      h.age_s = 0.0F;
    }
  }

  [[nodiscard]] const Senses& senses() const noexcept { return senses_; }
  // Whole ticks since the last step, at least one.
  [[nodiscard]] int elapsed_ticks() const noexcept { return elapsed_ticks_; }
  // Readings that did not pass.
  [[nodiscard]] std::uint32_t rejected() const noexcept { return rejected_; }

 private:
  // False for NaN and infinity too.
  static bool is_within(Vec2 v, float limit_m) noexcept { return squared_norm(v) <= limit_m * limit_m; }
  void admit_obstacles(float limit_m) noexcept;

  Senses senses_;
  int elapsed_ticks_ = 1;
  std::uint32_t rejected_ = 0;
  bool aged_ = false;                                          // some packet was measured before now
  std::optional<std::array<Vec2, most_obstacles>> obstacles_;  // those that passed, if some did not
};

// The argument of every step: the packets that passed, in the present frame, and the rest. Lives as long as the step.
// `Heard` is an algorithm's own: {const Message* message; Vec2 position; float age_s}. Packets that do not pass are
// dropped in place.
template <class Heard> class Inputs : private Gate {
 public:
  Inputs(std::span<Heard> heard, const Senses& senses, const Platform& platform) noexcept
      : Gate(senses, platform), heard_(packets(heard, platform)) {
    carry_to_now(heard_, platform);
  }
  [[nodiscard]] std::span<Heard> heard() const noexcept { return heard_; }
  using Gate::elapsed_ticks;
  using Gate::rejected;
  using Gate::senses;

 private:
  std::span<Heard> heard_;
};

}  // namespace banyan
