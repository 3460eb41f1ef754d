// SPDX-License-Identifier: MIT
#include "banyan/controller/core/neighbors.hpp"

#include <algorithm>
#include <cstring>

#include "banyan/controller/core/edge_frame.hpp"
#include "banyan/controller/core/fixed_point.hpp"

namespace banyan {

void Neighbors::prefetch(std::size_t entries) const noexcept {
  constexpr std::size_t line = 64;
  entries = std::min<std::size_t>(entries, neighbor_capacity);
  const auto* from = reinterpret_cast<const char*>(this);
  const std::size_t bytes = offsetof(Neighbors, entries_) + entries * sizeof(Entry);
  for (std::size_t at = 0; at < bytes; at += line) __builtin_prefetch(from + at, 1);
}

int Neighbors::find(RobotId id) const noexcept {
  for (int k = 0; k < size_; ++k)
    if (entries_[k].id == id) return k;
  return -1;
}

void Neighbors::begin(const Carry& carry, int elapsed_ticks) noexcept {
  expected_ = missed_ = 0;
  hint_ = 0;
  elapsed_ticks_ = static_cast<std::int16_t>(std::min(elapsed_ticks, INT16_MAX));
  origin_ = carry.point({});
  for (int k = 0; k < size_; ++k) {
    Entry& entry = entries_[k];
    entry.before = entry.age == 0 ? carry.vector(entry.position) : Vec2{};
    if (entry.age == 0) ++expected_;
    entry.age = static_cast<std::uint16_t>(std::min(entry.age + elapsed_ticks_, UINT16_MAX));
  }
}

void Neighbors::end(const Carry& carry, int liveness_ticks, std::array<RobotId, 2> keep, std::span<const Column> columns) noexcept {
  liveness_ticks_ = static_cast<std::int16_t>(liveness_ticks);
  // Only the silent are dead-reckoned: who was heard just now has a fresh position.
  for (int k = 0; k < size_;) {
    Entry& entry = entries_[k];
    if (entry.age == elapsed_ticks_) ++missed_;  // it was heard in the tick before
    if (entry.age > liveness_ticks && entry.id != keep[0] && entry.id != keep[1]) {
      remove(k, columns);
      continue;
    }
    if (entry.age > 0) {
      entry.position = carry.point(entry.position);
      entry.range_m = norm(entry.position);
    }
    ++k;
  }
}

bool Neighbors::read_point(int k, std::int16_t x_cm, std::int16_t y_cm, Vec2& point) const noexcept {
  const Vec2 before = entries_[k].before;
  if (before == Vec2{}) return false;
  point = origin_ + from_edge_frame({metres(x_cm), metres(y_cm)}, before);
  return true;
}

int Neighbors::add() noexcept {
  entries_[size_] = {};
  return size_++;
}

void Neighbors::write(int k, const Arrival& arrival, std::span<const Column> columns) noexcept {
  Entry& entry = entries_[k];
  entry.position = arrival.position;
  entry.range_m = norm(arrival.position);
  entry.id = arrival.id;
  entry.age = 0;
  hint_ = static_cast<std::int16_t>(k + 1);
  for (const Column& c : columns)
    std::memcpy(static_cast<char*>(c.data) + static_cast<std::size_t>(k) * c.size, static_cast<const char*>(arrival.message) + c.offset, c.size);
}

void Neighbors::remove(int k, std::span<const Column> columns) noexcept {
  // Order is kept: it is the order in which packets arrive, which `hint_` relies on.
  std::move(entries_.begin() + k + 1, entries_.begin() + size_, entries_.begin() + k);
  for (const Column& c : columns) {
    char* const at = static_cast<char*>(c.data) + static_cast<std::size_t>(k) * c.size;
    std::memmove(at, at + c.size, static_cast<std::size_t>(size_ - 1 - k) * c.size);
  }
  --size_;
}

}  // namespace banyan
