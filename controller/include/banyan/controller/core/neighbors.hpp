// SPDX-License-Identifier: MIT
// The neighbour table: who has been heard, when, and where it is relative to me (protocol 1). Nothing
// here is known in any frame but the robot's own. What neighbours said is kept beside it, in one array
// per block of their messages (`Column`): an algorithm has the arrays that it uses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "banyan/controller/core/inputs.hpp"

namespace banyan {

inline constexpr int neighbor_capacity = 96;

// Where the table keeps a block of each neighbour's last message: an array of neighbor_capacity elements
// of `size` bytes, copied from `offset` bytes behind the begin of a message.
struct Column {
  void* data;
  std::uint16_t size;
  std::uint16_t offset;
};

// Where a block, a base of a message type, lies in it.
template <class Block, class Message>
std::uint16_t block_offset() noexcept {
  static constexpr Message message{};
  return static_cast<std::uint16_t>(reinterpret_cast<const char*>(static_cast<const Block*>(&message)) -
                                    reinterpret_cast<const char*>(&message));
}

class Neighbors {
 public:
  // A packet as the table sees it; `message` lives as long as the call.
  struct Arrival {
    RobotId id;
    Vec2 position;
    const void* message;
    bool ties;                // a tree neighbour: never dropped for want of room
  };

  // One tick: begin, file() for each packet in any order (of several of one sender the last counts), end.
  // Entries older than `liveness_ticks` go at the end, except `keep` (neighbours whose silence matters).
  void begin(const Carry& carry, int elapsed_ticks) noexcept;
  // When more robots are heard than the table holds, those that tie or are in `keep` stay, and of the
  // others the nearest; `ties(k)` says it of an entry.
  template <class Ties>
  void file(const Arrival& arrival, std::array<RobotId, 2> keep, std::span<const Column> columns, Ties ties) noexcept {
    int k = hint_ < size_ && entries_[hint_].id == arrival.id ? hint_ : find(arrival.id);
    if (k < 0) k = size_ < neighbor_capacity ? add() : evict(arrival, keep, ties);
    if (k >= 0) write(k, arrival, columns);
  }
  void end(const Carry& carry, int liveness_ticks, std::array<RobotId, 2> keep, std::span<const Column> columns) noexcept;

  // A hint to the processor that about `entries` entries are needed soon; for simulations of many.
  void prefetch(std::size_t entries) const noexcept;

  [[nodiscard]] int size() const noexcept { return size_; }
  // Index of `id` in [0, size), or -1. O(size).
  [[nodiscard]] int find(RobotId id) const noexcept;
  [[nodiscard]] RobotId id(int k) const noexcept { return entries_[k].id; }
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
  // Heard within the liveness period; only a kept, silent neighbour is not.
  [[nodiscard]] bool alive(int k) const noexcept { return entries_[k].age <= liveness_ticks_; }

 private:
  int add() noexcept;
  template <class Ties>
  int evict(const Arrival& arrival, std::array<RobotId, 2> keep, Ties ties) noexcept {
    const auto kept = [&](int j) { return entries_[j].id == keep[0] || entries_[j].id == keep[1] || ties(j); };
    int farthest = -1;
    for (int j = 0; j < size_; ++j)
      if (!kept(j) && (farthest < 0 || range(j) > range(farthest))) farthest = j;
    const bool must = arrival.ties || arrival.id == keep[0] || arrival.id == keep[1];
    if (farthest < 0 || (!must && norm(arrival.position) >= range(farthest))) return -1;
    entries_[farthest] = {};
    return farthest;
  }
  void write(int k, const Arrival& arrival, std::span<const Column> columns) noexcept;
  void remove(int k, std::span<const Column> columns) noexcept;

  struct Entry {
    Vec2 position;
    float range_m = 0.0F;
    RobotId id = nobody;
    std::uint16_t age = 0;
    Vec2 before;  // where it was a tick ago, in the present frame but from where I was then; 0: not heard then
  };
  Vec2 origin_;  // where I was a tick ago
  std::int16_t size_ = 0;
  std::int16_t hint_ = 0;  // packets tend to arrive in the order of the last tick: the slot after the last match
  std::int16_t liveness_ticks_ = 0;
  std::int16_t expected_ = 0;
  std::int16_t missed_ = 0;
  std::int16_t elapsed_ticks_ = 1;
  std::array<Entry, neighbor_capacity> entries_{};
};

}  // namespace banyan
