// SPDX-License-Identifier: MIT
#include "banyan/controller/neighborhood.hpp"

#include <algorithm>

#include "banyan/controller/edge_frame.hpp"
#include "banyan/controller/trig.hpp"

namespace banyan {

Carry::Carry(const Odometry& odometry) noexcept
    : shift{odometry.forward_m, odometry.sideways_m}, rotation(unit_vector(odometry.turn_rad)) {}

void Neighborhood::prefetch(std::size_t entries) const noexcept {
  constexpr std::size_t line = 64;
  const auto fetch = [](const void* from, std::size_t bytes) {
    for (std::size_t at = 0; at < bytes; at += line) __builtin_prefetch(static_cast<const char*>(from) + at, 1);
  };
  entries = std::min<std::size_t>(entries, neighbor_capacity);
  fetch(&size_, sizeof size_);
  fetch(entries_.data(), entries * sizeof entries_[0]);
  fetch(messages_.data(), entries * sizeof messages_[0]);
}

int Neighborhood::find(RobotId id) const noexcept {
  for (int k = 0; k < size_; ++k)
    if (entries_[k].id == id) return k;
  return -1;
}

void Neighborhood::update(std::span<const Heard> heard, const Carry& carry, int liveness_ticks, RobotId self,
                          std::array<RobotId, 2> keep) noexcept {
  liveness_ticks_ = static_cast<std::int16_t>(liveness_ticks);
  expected_ = missed_ = 0;
  origin_ = carry.point({});
  for (int k = 0; k < size_; ++k) {
    entries_[k].before = entries_[k].age == 0 ? carry.vector(entries_[k].position) : Vec2{};
    if (entries_[k].age == 0) ++expected_;
    if (entries_[k].age < UINT16_MAX) ++entries_[k].age;
  }
  int hint = 0;
  for (const Heard& h : heard) file(h, hint, self, keep);
  // Only the silent are dead-reckoned: whoever was heard just now has a fresh position.
  for (int k = 0; k < size_;) {
    Entry& entry = entries_[k];
    if (entry.age == 1) ++missed_;
    if (entry.age > liveness_ticks && entry.id != keep[0] && entry.id != keep[1]) {
      remove(k);
      continue;
    }
    if (entry.age > 0) {
      entry.position = carry.point(entry.position);
      entry.range_m = norm(entry.position);
    }
    ++k;
  }
}

bool Neighborhood::read_point(int k, std::int16_t x_cm, std::int16_t y_cm, Vec2& point) const noexcept {
  const Vec2 before = entries_[k].before;
  if (before == Vec2{}) return false;
  point = origin_ + from_edge_frame({static_cast<float>(x_cm) * 0.01F, static_cast<float>(y_cm) * 0.01F}, before);
  return true;
}

void Neighborhood::file(const Heard& heard, int& hint, RobotId self, std::array<RobotId, 2> keep) noexcept {
  const RobotId id = heard.message->id;
  // A position that is not finite is a fault of the sensor: as if nothing had been heard.
  if (id == self || id == nobody || !(squared_norm(heard.position) < 1e12F)) return;
  // Packets tend to arrive in the order of the last tick: try the slot after the last match first.
  int k = hint < size_ && entries_[hint].id == id ? hint : find(id);
  if (k >= 0) {
    const Vec2 before = entries_[k].before;
    write(k, heard);
    entries_[k].before = before;
    hint = k + 1;
    return;
  }
  if (size_ < neighbor_capacity) {
    write(size_++, heard);
    return;
  }
  const auto names_me = [&](const Standing& m) { return m.parent == self || m.old_parent == self; };
  const auto kept = [&](const Standing& m) { return m.id == keep[0] || m.id == keep[1] || names_me(m); };
  int farthest = -1;
  for (int j = 0; j < size_; ++j)
    if (!kept(messages_[j]) && (farthest < 0 || range(j) > range(farthest))) farthest = j;
  if (farthest < 0 || (!kept(*heard.message) && norm(heard.position) >= range(farthest))) return;
  write(farthest, heard);
}

void Neighborhood::write(int k, const Heard& heard) noexcept {
  messages_[k] = static_cast<const Standing&>(*heard.message);  // tidings are done with in this tick
  entries_[k] = {heard.position, norm(heard.position), heard.message->id, 0, {}};
}

void Neighborhood::remove(int k) noexcept {
  // Order is kept: it is the order in which packets arrive, which `hint` relies on.
  const auto close = [&](auto& a) { std::move(a.begin() + k + 1, a.begin() + size_, a.begin() + k); };
  close(entries_);
  close(messages_);
  --size_;
}

}  // namespace banyan
