// SPDX-License-Identifier: MIT
// The one gate through which everything sensed passes before an algorithm sees it: a step is given Inputs, and nothing
// but the gate makes them. Lengths become multiples of C and times whole rounds (platform.hpp). What is not finite, or
// beyond wide limits that no working sensor exceeds, counts as not sensed; odometry that is not possible counts as no
// motion. No later code can meet a NaN or a metre.
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

inline constexpr float farthest_ranges = 10.0F;    // C: a neighbour, an obstacle, a way driven in one step
inline constexpr float farthest_place = 1000.0F;   // C: a target; wire.hpp writes places a little farther away
inline constexpr float largest_turn_rad = 1.0e3F;  // in one step; trig.hpp is exact up to 1e4
inline constexpr int longest_step_ticks = 36'000;
inline constexpr std::size_t most_obstacles = 64;  // that are looked at in one step; of more, the nearest each way

// What passed, and how much did not. Lives as long as the step: obstacles lie in it.
class Gate {
 public:
  Gate(const Senses& senses, const Platform& platform) noexcept;
  Gate(const Gate&) = delete;
  Gate& operator=(const Gate&) = delete;

  // Drops packets whose sender cannot be where, or when, it was measured to be; the others are as of now, in the
  // present frame and in C. In place; the order stays.
  template <class Heard> std::span<Heard> packets(std::span<Heard> heard, const Platform& platform) noexcept {
    const float longest_age_s = platform.tick_s * longest_step_ticks;
    const float per_second = 1.0F / platform.tick_s;
    std::size_t kept = 0;
    for (const Heard& h : heard) {
      const Vec2 position = h.position * per_metre_;
      if (!is_within(position, farthest_ranges) || !(h.age_s >= 0.0F && h.age_s <= longest_age_s)) {
        ++rejected_;
        continue;
      }
      Heard& passed = heard[kept++];
      if (&passed != &h) passed = h;  // mostly all pass, and stay where they are
      passed.position = h.age_s > 0.0F ? carried_to_now(position, h.age_s * per_second) : position;
      passed.age_s = 0.0F;
    }
    return heard.first(kept);
  }

  // The robot's own motion since its last step.
  [[nodiscard]] Carry carry() const noexcept { return {moved_, turn_rad_}; }
  [[nodiscard]] const Orders& orders() const noexcept { return orders_; }
  // The nearest point of each obstacle within reach of the proximity sensor, C.
  [[nodiscard]] std::span<const Vec2> obstacles() const noexcept { return obstacles_; }
  [[nodiscard]] const std::optional<Charge>& charge() const noexcept { return charge_; }
  // Rounds since the last step.
  [[nodiscard]] float elapsed() const noexcept { return elapsed_; }
  // The same as whole ones, at least one.
  [[nodiscard]] int elapsed_ticks() const noexcept { return elapsed_ticks_; }
  // Readings that did not pass.
  [[nodiscard]] std::uint32_t rejected() const noexcept { return rejected_; }

 private:
  // False for NaN and infinity too.
  static bool is_within(Vec2 v, float limit) noexcept { return squared_norm(v) <= limit * limit; }
  [[nodiscard]] Vec2 way_of_station(const Platform& platform) const noexcept;
  void admit_obstacles(std::span<const Vec2> obstacles) noexcept;
  // A position measured so many rounds ago, in the frame of then, as it is now in the present frame.
  [[nodiscard]] Vec2 carried_to_now(Vec2 position, float rounds) const noexcept;

  float per_metre_;
  Vec2 moved_;  // C, in the frame at the last step
  float turn_rad_ = 0.0F;
  float elapsed_ = 1.0F;
  int elapsed_ticks_ = 1;
  std::uint32_t rejected_ = 0;
  Orders orders_;
  std::optional<Charge> charge_;
  std::span<const Vec2> obstacles_;
  std::optional<std::array<Vec2, most_obstacles>> room_;  // for obstacles, where there are any
};

// The argument of every step: the packets that passed, and the rest. Lives as long as the step. `Heard` is an
// algorithm's own: {const Message* message; Vec2 position; float age_s}; what it is in is worked on.
template <class Heard> class Inputs : private Gate {
 public:
  Inputs(std::span<Heard> heard, const Senses& senses, const Platform& platform) noexcept
      : Gate(senses, platform), heard_(packets(heard, platform)) {}
  [[nodiscard]] std::span<Heard> heard() const noexcept { return heard_; }
  using Gate::carry;
  using Gate::charge;
  using Gate::elapsed;
  using Gate::elapsed_ticks;
  using Gate::obstacles;
  using Gate::orders;
  using Gate::rejected;

 private:
  std::span<Heard> heard_;
};

}  // namespace banyan
