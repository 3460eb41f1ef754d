// SPDX-License-Identifier: MIT
#include "banyan/controller/core/neighbors.hpp"
#include "banyan/controller/core/search.hpp"

namespace banyan {
namespace {

constexpr int witnesses = 16;  // entries from which the noise is learnt: one sensor measures them all
constexpr int sentries = 1;    // entries from which noise is noticed at first

}  // namespace

void Neighbors::prefetch(std::size_t entries) const noexcept {
  entries = std::min<std::size_t>(entries, neighbor_capacity);
  const auto fetch = [&](const auto& array) { prefetch_lines(array.data(), entries * sizeof array[0]); };
  prefetch_lines(this, static_cast<std::size_t>(reinterpret_cast<const char*>(positions_.data()) -
                                                reinterpret_cast<const char*>(this)));
  fetch(ids_);
  fetch(by_id_);
  fetch(measurements_);
  fetch(ages_);
  fetch(ranges_);
  fetch(positions_);
}

// How many of the first `among` in by_id_ have a smaller id.
int Neighbors::rank_of(RobotId id, int among) const noexcept {
  int rank = 0;
  while (among > 0) {  // no branch that depends on ids: it could not be predicted
    const int half = (among + 1) / 2;
    rank += ids_[by_id_[rank + half - 1]] < id ? half : 0;
    among -= half;
  }
  return rank;
}

int Neighbors::find(RobotId id) const noexcept {
  if (id == nobody) return -1;  // often asked
  const int rank = rank_of(id, size_);
  return rank < size_ && ids_[by_id_[rank]] == id ? by_id_[rank] : -1;
}

RobotId Neighbors::next_heard(RobotId id, int ticks) const noexcept {
  int rank = rank_of(static_cast<RobotId>(id + 1), size_);
  for (int left = size_; left > 0; --left, ++rank) {
    if (rank >= size_) rank = 0;
    if (const int k = by_id_[rank]; ages_[k] <= ticks) return ids_[k];
  }
  return nobody;
}

// Like find(), but walks on from the last entry found if that is near.
int Neighbors::find_next(RobotId id) noexcept {
  int rank = next_rank_;
  if (rank > 0 && ids_[by_id_[rank - 1]] >= id) rank = rank_of(id, size_);
  while (rank < size_ && ids_[by_id_[rank]] < id) ++rank;
  const bool found = rank < size_ && ids_[by_id_[rank]] == id;
  next_rank_ = static_cast<std::int16_t>(rank + (found ? 1 : 0));
  return found ? by_id_[rank] : -1;
}

// Takes entry k out of the order by id, so that it can be another robot's.
void Neighbors::leave(int k) noexcept {
  const auto end = by_id_.begin() + size_;
  const auto at = first_of(by_id_.begin(), end, [&](int entry) { return entry == k; });
  std::move(at + 1, end, at);
}

void Neighbors::begin(int elapsed_ticks, float way) noexcept {
  filter_.begin(way);
  watched_ = static_cast<std::int16_t>(!filter_.is_on() ? 0 : filter_.has_seen_noise() ? neighbor_capacity : sentries);
  elapsed_ticks_ = static_cast<std::int16_t>(std::min(elapsed_ticks, INT16_MAX));
  next_rank_ = 0;
  missed_ = returned_ = 0;
  const auto passed = static_cast<std::uint16_t>(elapsed_ticks_);
  const auto oldest = static_cast<std::uint16_t>(UINT16_MAX - passed);
  std::uint16_t expected = 0;
  for (int k = 0, size = size_; k < size; ++k) {
    expected = static_cast<std::uint16_t>(expected + (ages_[k] == 0 ? 1 : 0));
    ages_[k] = static_cast<std::uint16_t>(std::min(ages_[k], oldest) + passed);
  }
  expected_ = static_cast<std::int16_t>(expected);
}

int Neighbors::enter(RobotId id, Vec2 position, bool must, FunctionRef<bool(int)> ties) noexcept {
  const int k = size_ < neighbor_capacity ? size_++ : evict(position, must, ties);
  if (k < 0) return k;
  all_.set(k, true);
  const auto at = by_id_.begin() + rank_of(id, size_ - 1);
  std::move_backward(at, by_id_.begin() + size_ - 1, by_id_.begin() + size_);
  *at = static_cast<std::uint8_t>(k);
  next_rank_ = static_cast<std::int16_t>(at - by_id_.begin() + 1);
  ids_[k] = id;
  measurements_[k] = 1;
  put(k, position);
  return k;
}

Vec2 Neighbors::filtered(int k, Vec2 predicted, Vec2 measured) noexcept {
  if (k < witnesses && ages_[k] == elapsed_ticks_) filter_.learn(predicted, measured, elapsed_ticks_);
  const Vec2 position = filter_.fuse(predicted, measured, ages_[k], measurements_[k]);
  measurements_[k] = static_cast<std::uint8_t>(std::min(measurements_[k] + 1, UINT8_MAX));
  return position;
}

int Neighbors::evict(Vec2 position, bool must, FunctionRef<bool(int)> ties) noexcept {
  int farthest = -1;
  for (int j = 0; j < size_; ++j)
    if (!ties(j) && (farthest < 0 || range(j) > range(farthest))) farthest = j;
  if (farthest < 0 || (!must && norm(position) + filter_.spread() >= range(farthest))) return -1;
  leave(farthest);
  return farthest;
}

// Only silent neighbours are dead-reckoned: one heard just now has a fresh position.
int Neighbors::remove_next(int from, const Carry& carry, int liveness_ticks, FunctionRef<bool(int)> keeps,
                           int kept_ticks) noexcept {
  liveness_ticks_ = static_cast<std::int16_t>(std::max(liveness_ticks, kept_ticks));
  for (int k = from, size = size_; k < size; ++k) {
    if (ages_[k] == 0) continue;
    if (ages_[k] == elapsed_ticks_) ++missed_;  // it was heard in the tick before
    if (ages_[k] > liveness_ticks && !keeps(k)) {
      remove(k);
      return k;
    }
    const Vec2 position = carry.point(positions_[k]);
    positions_[k] = position;
    ranges_[k] = norm(position) + filter_.spread();
  }
  return -1;
}

// Keeps the order: entries stand in the order in which they were first heard.
void Neighbors::remove(int k) noexcept {
  leave(k);
  for (int rank = 0; rank < size_ - 1; ++rank)
    if (by_id_[rank] > k) --by_id_[rank];
  close_gap(ids_, k, size_);
  close_gap(measurements_, k, size_);
  close_gap(ages_, k, size_);
  close_gap(ranges_, k, size_);
  close_gap(positions_, k, size_);
  all_.set(--size_, false);
}

}  // namespace banyan
