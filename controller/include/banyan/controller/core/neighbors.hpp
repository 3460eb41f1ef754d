// SPDX-License-Identifier: MIT
// The neighbour table: which robots have been heard, when, and where they are relative to me (protocol 1).
// All of it is in the robot's own frame. What neighbours said is kept beside it, in one array
// per block of their messages: an algorithm has the arrays that it uses, and keeps them in step with the
// table by what file() and remove_next() return.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "banyan/controller/core/function_ref.hpp"
#include "banyan/controller/core/inputs.hpp"
#include "banyan/controller/core/position_filter.hpp"
#include "banyan/controller/core/rows.hpp"

namespace banyan {

// A hint to the processor that `bytes` from `from` on are needed soon; for simulations of many robots.
inline void prefetch_lines(const void* from, std::size_t bytes) noexcept {
  constexpr std::uintptr_t line = 64;
  const auto begin = reinterpret_cast<std::uintptr_t>(from);
  const auto* const first = static_cast<const char*>(from) - begin % line;
  for (std::size_t at = 0; at < bytes + begin % line; at += line) __builtin_prefetch(first + at, 1);
}

// Moves the elements of one such array.
template <class T> constexpr void close_gap(std::array<T, neighbor_capacity>& array, int k, int size) noexcept {
  std::move(array.begin() + k + 1, array.begin() + size, array.begin() + k);
}

class Neighbors {
 public:
  // One tick: begin(), file() or else enter() for each packet in any order (of several of one sender the last
  // counts), then remove_next() until there is nothing to remove.
  // `way`: the longest that a neighbour drives in a tick, if measurements are to be filtered; else 0.
  void begin(int elapsed_ticks, float way) noexcept;
  // The index of the sender; -1 if it is new. `before`: where it was a tick ago, in the frame of then; left alone
  // if it was not heard then, or has been filed in this tick already.
  int file(RobotId id, Vec2 position, Vec2& before, const Carry& carry) noexcept {
    const int k = next_rank_ < size_ && ids_[by_id_[next_rank_]] == id ? by_id_[next_rank_++] : find_next(id);
    if (k < 0) return k;
    if (ages_[k] == elapsed_ticks_) before = positions_[k];
    else returned_ = std::max(returned_, static_cast<std::int16_t>(ages_[k]));
    put(k, k < watched_ && ages_[k] > 0 ? filtered(k, carry.point(positions_[k]), position) : position);
    return k;
  }
  // The index of a new sender; -1 if there is no room for it. When more robots are heard than the table holds,
  // those that must not be lost stay (`must`: the sender; `ties(k)`: entry k), and of the others the nearest.
  int enter(RobotId id, Vec2 position, bool must, FunctionRef<bool(int)> ties) noexcept;
  // From entry `from` on: removes the first that is older than `liveness_ticks`, unless `keeps(k)`: its silence
  // matters, and it counts as alive for `kept_ticks` if that is longer; those behind it move up by one. Its index; -1
  // if there is none.
  int remove_next(int from, const Carry& carry, int liveness_ticks, FunctionRef<bool(int)> keeps,
                  int kept_ticks = 0) noexcept;

  // About `entries` entries are needed soon.
  void prefetch(std::size_t entries) const noexcept;

  [[nodiscard]] int size() const noexcept { return size_; }
  // Index of `id` in [0, size), or -1. O(log size).
  [[nodiscard]] int find(RobotId id) const noexcept;
  // Of those heard within the last `ticks` the smallest id above `id`, else the smallest: round and round. Nobody if
  // there is none.
  [[nodiscard]] RobotId next_heard(RobotId id, int ticks) const noexcept;
  [[nodiscard]] RobotId id(int k) const noexcept { return ids_[k]; }
  [[nodiscard]] Vec2 position(int k) const noexcept { return positions_[k]; }  // C, body frame
  // C; where ranges are noisy, one standard deviation more than the distance of position(k): it may be that far away.
  [[nodiscard]] float range(int k) const noexcept { return ranges_[k]; }
  [[nodiscard]] const PositionFilter& filter() const noexcept { return filter_; }
  [[nodiscard]] float spread() const noexcept { return filter_.spread(); }
  [[nodiscard]] int measurements(int k) const noexcept {
    return measurements_[k];
  }                                                                 // that its position is made of, up to 255
  [[nodiscard]] int age(int k) const noexcept { return ages_[k]; }  // ticks, 0: heard now
  // Of those heard in the tick before: how many they were, and how many were not heard in this one.
  [[nodiscard]] int expected() const noexcept { return expected_; }
  [[nodiscard]] int missed() const noexcept { return missed_; }
  // The longest silence, in ticks, that ended in this step; 0 if all that were heard had been heard a tick ago.
  [[nodiscard]] int returned() const noexcept { return returned_; }
  // Heard within the liveness period; only a kept, silent neighbour is not.
  [[nodiscard]] bool alive(int k) const noexcept { return ages_[k] <= liveness_ticks_; }
  [[nodiscard]] const Rows& all() const noexcept { return all_; }

 private:
  [[nodiscard]] int rank_of(RobotId id, int among) const noexcept;
  int find_next(RobotId id) noexcept;
  void put(int k, Vec2 position) noexcept {
    positions_[k] = position;
    ranges_[k] = norm(position) + filter_.spread();
    ages_[k] = 0;
  }
  [[nodiscard, gnu::noinline]] Vec2 filtered(int k, Vec2 predicted, Vec2 measured) noexcept;
  void leave(int k) noexcept;
  int evict(Vec2 position, bool must, FunctionRef<bool(int)> ties) noexcept;
  void remove(int k) noexcept;

  template <class T> using Array = std::array<T, neighbor_capacity>;
  std::int16_t size_ = 0;
  std::int16_t next_rank_ = 0;  // behind the packet filed last: from many hosts they come in the order of ids
  std::int16_t liveness_ticks_ = 0;
  std::int16_t expected_ = 0;
  std::int16_t missed_ = 0;
  std::int16_t elapsed_ticks_ = 1;
  std::int16_t returned_ = 0;
  std::int16_t watched_ = 0;  // so many of the first entries are compared with where they were expected
  Rows all_;                  // [0, size)
  PositionFilter filter_;
  Array<Vec2> positions_{};  // first, with the ranges: a chip loads floats from at most 1,020 bytes away
  Array<float> ranges_{};
  Array<RobotId> ids_{};
  Array<std::uint8_t> by_id_{};  // indices, ascending by id
  Array<std::uint8_t> measurements_{};
  Array<std::uint16_t> ages_{};
};

}  // namespace banyan
