// SPDX-License-Identifier: MIT
// The neighbour table: who has been heard, what they said, and where they are relative to me
// (protocol 1). Nothing here is known in any frame but the robot's own.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "banyan/controller/message.hpp"

namespace banyan {

// One received packet: its content and where its sender is in the receiver's body frame
// (x forward, y left; m), from range and bearing. `message` lives as long as the call.
struct Heard {
  const Message* message;
  Vec2 position;
};

// The robot's own motion since its last step, in the body frame it had then: a differential robot
// leaves `sideways_m` zero, a holonomic one may leave `turn_rad` zero.
struct Odometry {
  float forward_m = 0.0F;
  float sideways_m = 0.0F;
  float turn_rad = 0.0F;
};

// A point or vector remembered over ticks, carried along by own odometry every tick.
struct Carry {
  Vec2 shift;     // m
  Vec2 rotation;  // (cos, sin) of the turn
  explicit Carry(const Odometry& odometry) noexcept;
  [[nodiscard]] Vec2 point(Vec2 p) const noexcept { return rotate_back(rotation, p - shift); }
  [[nodiscard]] Vec2 vector(Vec2 v) const noexcept { return rotate_back(rotation, v); }
};

inline constexpr int neighbor_capacity = 96;

class Neighborhood {
 public:
  // Moves what is remembered, ages it, then files what was heard this tick. Entries older than
  // `liveness_ticks` go, except `keep` (tree neighbours whose silence matters). When more robots
  // are heard than the table holds, tree neighbours (`keep`, and all who name `self` as parent or
  // old parent) stay and of the others the nearest.
  void update(std::span<const Heard> heard, const Carry& carry, int liveness_ticks, RobotId self,
              std::array<RobotId, 2> keep) noexcept;

  // A hint to the processor that about `entries` entries are needed soon; for simulations of many.
  void prefetch(std::size_t entries) const noexcept;

  [[nodiscard]] int size() const noexcept { return size_; }
  // Index of `id` in [0, size), or -1. O(size), a linear scan of 16-bit ids.
  [[nodiscard]] int find(RobotId id) const noexcept;
  [[nodiscard]] RobotId id(int k) const noexcept { return entries_[k].id; }
  [[nodiscard]] const Standing& message(int k) const noexcept { return messages_[k]; }
  [[nodiscard]] Vec2 position(int k) const noexcept { return entries_[k].position; }  // m, body frame
  [[nodiscard]] float range(int k) const noexcept { return entries_[k].range_m; }      // m
  [[nodiscard]] int age(int k) const noexcept { return entries_[k].age; }            // ticks, 0: heard now
  // A point, relative to me, that neighbour k has written for me in its edge frame (cm). False if it
  // was not heard in the tick before: what it wrote then holds for where both were then, and over a
  // distance a bearing that is a tick old makes an error of decimetres.
  [[nodiscard]] bool read_point(int k, std::int16_t x_cm, std::int16_t y_cm, Vec2& point) const noexcept;
  // Of those heard in the tick before: how many they were, and how many were not heard in this one.
  [[nodiscard]] int expected() const noexcept { return expected_; }
  [[nodiscard]] int missed() const noexcept { return missed_; }
  // Heard within the liveness period; only a kept, silent tree neighbour is not.
  [[nodiscard]] bool alive(int k) const noexcept { return entries_[k].age <= liveness_ticks_; }

 private:
  void file(const Heard& heard, int& hint, RobotId self, std::array<RobotId, 2> keep) noexcept;
  void write(int k, const Heard& heard) noexcept;
  void remove(int k) noexcept;

  struct Entry {
    Vec2 position;
    float range_m;
    RobotId id;
    std::uint16_t age;
    Vec2 before;  // where it was a tick ago, in the present frame but from where I was then; 0: not heard then
  };
  Vec2 origin_;  // where I was a tick ago
  std::int16_t size_ = 0;
  std::int16_t liveness_ticks_ = 0;
  std::int16_t expected_ = 0;
  std::int16_t missed_ = 0;
  std::array<Entry, neighbor_capacity> entries_{};
  alignas(64) std::array<Standing, neighbor_capacity> messages_{};
};

}  // namespace banyan
