// SPDX-License-Identifier: MIT
#include "banyan/world/radio.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "banyan/world/obstacles.hpp"

namespace banyan::world {
namespace {

constexpr std::size_t few_cells = 15;   // so few, and scanning everybody beats the grid
constexpr float far_away = 1e30F;

}  // namespace

Radio::Radio(const Scenario& scenario, std::size_t robots)
    : range_m_(scenario.radio.range_m),
      radius_m_(scenario.robot.radius_m),
      near_m_(2.0 * scenario.robot.radius_m + 4.0 * scenario.robot.wheel_limit_m_s * scenario.tick_s + 0.01),
      line_of_sight_(scenario.radio.line_of_sight),
      dead_vanish_(!scenario.robot.dead_bodies),
      obstacles_(scenario.obstacles),
      offsets_(robots + 1, 0),
      fill_(robots, 0),
      blocked_offsets_(robots + 1, 0) {}

void Radio::update(std::span<const Vec2> positions, std::span<const std::uint8_t> alive, Executor& executor) {
  if (scratch_.size() < static_cast<std::size_t>(executor.threads())) scratch_.resize(static_cast<std::size_t>(executor.threads()));
  build_grid(positions);
  for (Scratch& s : scratch_) {
    s.links.clear();
    s.blocked.clear();
    s.blocker.clear();
    s.near.clear();
  }
  executor.parallel_for(positions.size(), [&](std::size_t begin, std::size_t end, int worker) {
    Scratch& s = scratch_[static_cast<std::size_t>(worker)];
    for (std::size_t i = begin; i < end; ++i) scan(i, positions, alive, s);
  });
  merge(positions.size());
}

// Counting sort of the robots into cells. The number of cells stays below 4 N, so that a wide, thin
// swarm costs no more memory than a dense one: the cells grow instead.
void Radio::build_grid(std::span<const Vec2> positions) {
  Vec2 low = positions[0];
  Vec2 high = positions[0];
  for (const Vec2 p : positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  origin_ = low;
  cell_m_ = std::max(range_m_, near_m_);
  const double limit = 4.0 * static_cast<double>(positions.size()) + 16.0;
  while (((high.x - low.x) / cell_m_ + 1.0) * ((high.y - low.y) / cell_m_ + 1.0) > limit) cell_m_ *= 2.0;
  columns_ = static_cast<std::size_t>((high.x - low.x) / cell_m_) + 1;
  rows_ = static_cast<std::size_t>((high.y - low.y) / cell_m_) + 1;
  use_grid_ = columns_ * rows_ > few_cells;
  if (!use_grid_) return;

  cell_of_.resize(positions.size());
  sorted_.resize(positions.size());
  sorted_position_.resize(positions.size());
  cell_start_.assign(columns_ * rows_ + 1, 0);
  const double per_m = 1.0 / cell_m_;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    // Rounding may put the outermost robot one cell too far.
    const std::size_t column = std::min(static_cast<std::size_t>((positions[i].x - low.x) * per_m), columns_ - 1);
    const std::size_t row = std::min(static_cast<std::size_t>((positions[i].y - low.y) * per_m), rows_ - 1);
    cell_of_[i] = static_cast<std::uint32_t>(row * columns_ + column);
    ++cell_start_[cell_of_[i] + 1];
  }
  for (std::size_t c = 1; c < cell_start_.size(); ++c) cell_start_[c] += cell_start_[c - 1];
  for (std::size_t i = positions.size(); i-- > 0;) {
    const std::uint32_t at = --cell_start_[cell_of_[i] + 1];
    sorted_[at] = static_cast<std::uint32_t>(i);
    sorted_position_[at] = positions[i];
  }
  // The loop has moved every start one cell up: cell c now begins at cell_start_[c + 1].
}

void Radio::forget(std::uint32_t i) {
  std::erase_if(near_, [i](const Pair& pair) { return pair.first == i || pair.second == i; });
}

// Everybody within range of robot i who is still there, ascending.
void Radio::gather(std::size_t i, std::span<const Vec2> positions, std::span<const std::uint8_t> alive, Scratch& s) const {
  const double reach = std::max(range_m_, near_m_);
  const double reach2 = reach * reach;
  const Vec2 here = positions[i];
  std::size_t size = 0;
  const auto reserve = [&](std::size_t more) {
    if (s.index.size() >= size + more + chunk) return;
    const std::size_t capacity = 2 * (size + more) + chunk;
    s.index.resize(capacity);
    for (auto* v : {&s.dx, &s.dy, &s.d2}) v->resize(capacity);
    for (auto* v : {&s.x, &s.y}) v->resize(capacity);
  };
  // Written unconditionally and kept by advancing: no branch for the processor to guess.
  const auto consider = [&](std::size_t j, Vec2 there) {
    s.index[size] = static_cast<std::uint32_t>(j);
    size += static_cast<std::size_t>(squared_norm(there - here) < reach2) & static_cast<std::size_t>(j != i);
  };
  if (use_grid_) {
    const std::size_t row = cell_of_[i] / columns_;
    const std::size_t column = cell_of_[i] % columns_;
    const std::size_t first = column > 0 ? column - 1 : 0;
    const std::size_t last = std::min(column + 1, columns_ - 1);
    for (std::size_t r = row > 0 ? row - 1 : 0; r <= std::min(row + 1, rows_ - 1); ++r) {
      const std::size_t begin = cell_start_[r * columns_ + first + 1];
      const std::size_t end_cell = r * columns_ + last + 2;
      const std::size_t end = end_cell < cell_start_.size() ? cell_start_[end_cell] : positions.size();
      reserve(end - begin);
      for (std::size_t at = begin; at < end; ++at) consider(sorted_[at], sorted_position_[at]);
    }
  } else {
    reserve(positions.size());
    for (std::size_t j = 0; j < positions.size(); ++j) consider(j, positions[j]);
  }
  if (dead_vanish_) {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < size; ++k) {
      s.index[kept] = s.index[k];
      kept += alive[s.index[k]] != 0 ? 1 : 0;
    }
    size = kept;
  }
  s.size = size;
  // The grid hands out neighbours cell by cell.
  if (use_grid_) std::sort(s.index.begin(), s.index.begin() + static_cast<std::ptrdiff_t>(size));
  for (std::size_t k = 0; k < size; ++k) {
    const Vec2 d = positions[s.index[k]] - here;
    s.dx[k] = d.x;
    s.dy[k] = d.y;
    s.d2[k] = squared_norm(d);
    s.x[k] = static_cast<float>(d.x);
    s.y[k] = static_cast<float>(d.y);
  }
  std::fill_n(s.x.begin() + static_cast<std::ptrdiff_t>(size), chunk, far_away);
  std::fill_n(s.y.begin() + static_cast<std::ptrdiff_t>(size), chunk, far_away);
}

// A body between the robot and its neighbour `target`, or nobody_blocks. Single precision, four at a
// time, leaves out who is clearly beside the line; the exact test decides on the rest.
std::uint32_t Radio::find_blocker(Scratch& s, std::size_t target) const noexcept {
  const Vec2 d{s.dx[target], s.dy[target]};
  const double d2 = s.d2[target];
  const auto length = static_cast<float>(std::sqrt(d2));
  const float ux = s.x[target] / length;
  const float uy = s.y[target] / length;
  const float beside = static_cast<float>(radius_m_) + 1e-4F * (length + 1.0F);   // far above the rounding
  const float aside = std::exchange(s.x[target], far_away);                        // the target itself is not in the way
  std::uint32_t by = nobody_blocks;
  for (std::size_t begin = 0; begin < s.size && by == nobody_blocks; begin += chunk) {
    const float* x = s.x.data() + begin;
    const float* y = s.y.data() + begin;
    int any = 0;
    for (std::size_t k = 0; k < chunk; ++k) {
      const float across = std::fabs(x[k] * uy - y[k] * ux);
      const float along = x[k] * ux + y[k] * uy;
      any |= static_cast<int>(across < beside) & static_cast<int>(along > -1e-3F) & static_cast<int>(along < length + 1e-3F);
    }
    if (any == 0) continue;
    const std::size_t end = std::min(begin + chunk, s.size);
    for (std::size_t k = begin; k < end && by == nobody_blocks; ++k)
      if (k != target && disc_blocks({s.dx[k], s.dy[k]}, d, d2, radius_m_)) by = s.index[k];
  }
  s.x[target] = aside;
  return by;
}

// Decides every pair (i, j > i), so that each is decided once and from the same end.
void Radio::scan(std::size_t i, std::span<const Vec2> positions, std::span<const std::uint8_t> alive, Scratch& s) const {
  if (dead_vanish_ && alive[i] == 0) return;
  gather(i, positions, alive, s);
  s.obstacles.clear();
  if (line_of_sight_)
    for (const Obstacle& obstacle : obstacles_)
      if (clearance(obstacle, positions[i]) < range_m_) s.obstacles.push_back(&obstacle);

  const auto self = static_cast<std::uint32_t>(i);
  std::size_t last = blocked_offsets_[i];   // walks along the pairs of i that were blocked in the last tick
  const std::size_t last_end = blocked_offsets_[i + 1];
  std::size_t k = static_cast<std::size_t>(std::upper_bound(s.index.begin(), s.index.begin() + static_cast<std::ptrdiff_t>(s.size), self) - s.index.begin());
  for (; k < s.size; ++k) {
    const std::uint32_t other = s.index[k];
    const Pair pair{self, other};
    if (s.d2[k] < near_m_ * near_m_) s.near.push_back(pair);
    if (s.d2[k] >= range_m_ * range_m_ || alive[i] == 0 || alive[other] == 0) continue;
    if (!line_of_sight_) {
      s.links.push_back(pair);
      continue;
    }
    // Who blocked a pair a tick ago mostly still does.
    while (last < last_end && blocked_[last].second < other) ++last;
    std::uint32_t by = last < last_end && blocked_[last].second == other ? blocker_[last] : nobody_blocks;
    if (by != nobody_blocks && dead_vanish_ && alive[by] == 0) by = nobody_blocks;
    if (by == nobody_blocks || !disc_blocks(positions[by] - positions[i], {s.dx[k], s.dy[k]}, s.d2[k], radius_m_)) by = find_blocker(s, k);
    const auto in_the_way = [&](const Obstacle* o) { return blocks(*o, positions[i], positions[other]); };
    if (by == nobody_blocks && std::none_of(s.obstacles.begin(), s.obstacles.end(), in_the_way)) {
      s.links.push_back(pair);
    } else {
      s.blocked.push_back(pair);
      s.blocker.push_back(by);
    }
  }
}

// Pairs of all threads, in order, into compressed rows that are ascending at both ends.
namespace {

// insert() into an emptied vector takes exactly what it needs, and every new record would be an
// allocation.
template <class T>
void append(std::vector<T>& all, const std::vector<T>& part) {
  const std::size_t size = all.size() + part.size();
  if (size > all.capacity()) all.reserve(size + size / 4);
  all.insert(all.end(), part.begin(), part.end());
}

}  // namespace

void Radio::merge(std::size_t robots) {
  blocked_.clear();
  blocker_.clear();
  near_.clear();
  std::fill(offsets_.begin(), offsets_.end(), 0U);
  std::fill(blocked_offsets_.begin(), blocked_offsets_.end(), 0U);
  std::size_t pairs = 0;
  for (const Scratch& s : scratch_) {
    append(blocked_, s.blocked);
    append(blocker_, s.blocker);
    append(near_, s.near);
    for (const auto& [i, j] : s.links) {
      ++offsets_[i + 1];
      ++offsets_[j + 1];
    }
    pairs += s.links.size();
  }
  for (const auto& [i, j] : blocked_) ++blocked_offsets_[i + 1];
  for (std::size_t i = 0; i < robots; ++i) {
    offsets_[i + 1] += offsets_[i];
    blocked_offsets_[i + 1] += blocked_offsets_[i];
    fill_[i] = offsets_[i];
  }
  links_.resize(2 * pairs);
  for (const Scratch& s : scratch_)
    for (const auto& [i, j] : s.links) {
      links_[fill_[i]++] = j;
      links_[fill_[j]++] = i;
    }
}

std::size_t Radio::memory_bytes() const noexcept {
  const auto bytes = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t total = bytes(cell_of_) + bytes(cell_start_) + bytes(sorted_) + bytes(sorted_position_) + bytes(offsets_) +
                      bytes(fill_) + bytes(links_) + bytes(blocked_) + bytes(near_) + bytes(blocker_) + bytes(blocked_offsets_);
  for (const Scratch& s : scratch_) total += bytes(s.dx) + bytes(s.dy) + bytes(s.d2) + bytes(s.index) + bytes(s.x) + bytes(s.y) + bytes(s.blocker) + bytes(s.links) + bytes(s.blocked) + bytes(s.near);
  return total;
}

}  // namespace banyan::world
