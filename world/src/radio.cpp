// SPDX-License-Identifier: MIT
#include "banyan/world/radio.hpp"

#include <algorithm>
#include <cmath>

#include "banyan/world/obstacles.hpp"

namespace banyan::world {
namespace {

constexpr std::size_t all_pairs_limit = 128;   // up to here scanning everybody beats the grid
constexpr std::size_t few_neighbors = 12;      // up to here testing every body beats the sectors

// A monotone stand-in for the angle of v, in [0, 4), without trigonometry. Its slope against the
// angle is between 1/2 and 1, so an angular half-width bounds its own.
float pseudo_angle(Vec2 v) noexcept {
  const auto x = static_cast<float>(v.x);
  const auto y = static_cast<float>(v.y);
  const float sum = std::fabs(x) + std::fabs(y);
  if (sum == 0.0F) return 0.0F;
  const float p = x / sum;   // 1 .. -1
  return y >= 0.0F ? 1.0F - p : 3.0F + p;
}

}  // namespace

Radio::Radio(const Scenario& scenario, std::size_t robots)
    : range_m_(scenario.radio.range_m),
      radius_m_(scenario.robot.radius_m),
      near_m_(2.0 * scenario.robot.radius_m + 4.0 * scenario.robot.wheel_limit_m_s * scenario.tick_s + 0.01),
      line_of_sight_(scenario.radio.line_of_sight),
      obstacles_(scenario.obstacles),
      use_grid_(robots > all_pairs_limit),
      offsets_(robots + 1, 0),
      fill_(robots, 0) {}

void Radio::update(std::span<const Vec2> positions, std::span<const std::uint8_t> alive, Executor& executor) {
  if (scratch_.size() < static_cast<std::size_t>(executor.threads())) scratch_.resize(static_cast<std::size_t>(executor.threads()));
  if (use_grid_) build_grid(positions);
  for (Scratch& s : scratch_) {
    s.links.clear();
    s.blocked.clear();
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
  for (std::size_t i = positions.size(); i-- > 0;) {  // backwards: ascending within each cell
    const std::uint32_t at = --cell_start_[cell_of_[i] + 1];
    sorted_[at] = static_cast<std::uint32_t>(i);
    sorted_position_[at] = positions[i];
  }
  // The loop has moved every start one cell up: cell c now begins at cell_start_[c + 1].
}

// Everybody within range of robot i; with line of sight off only those after it.
void Radio::gather(std::size_t i, std::span<const Vec2> positions, Scratch& s) const {
  const double reach = std::max(range_m_, near_m_);
  const double reach2 = reach * reach;
  const Vec2 here = positions[i];
  s.neighbors.clear();
  const auto consider = [&](std::uint32_t j, Vec2 there) {
    const Vec2 d = there - here;
    const double d2 = squared_norm(d);
    if (d2 < reach2 && j != i) s.neighbors.push_back({d, d2, j});
  };
  if (!use_grid_) {
    for (std::size_t j = line_of_sight_ ? 0 : i + 1; j < positions.size(); ++j) consider(static_cast<std::uint32_t>(j), positions[j]);
    return;
  }
  const std::size_t row = cell_of_[i] / columns_;
  const std::size_t column = cell_of_[i] % columns_;
  const std::size_t first = column > 0 ? column - 1 : 0;
  const std::size_t last = std::min(column + 1, columns_ - 1);
  const std::size_t total = positions.size();
  for (std::size_t r = row > 0 ? row - 1 : 0; r <= std::min(row + 1, rows_ - 1); ++r) {
    const std::size_t end_cell = r * columns_ + last + 2;
    const std::size_t end = end_cell < cell_start_.size() ? cell_start_[end_cell] : total;
    for (std::size_t at = cell_start_[r * columns_ + first + 1]; at < end; ++at)
      if (line_of_sight_ || sorted_[at] > i) consider(sorted_[at], sorted_position_[at]);
  }
  std::sort(s.neighbors.begin(), s.neighbors.end(), [](const Neighbor& a, const Neighbor& b) { return a.index < b.index; });
}

// Files every body under the sectors of the circle that its disc may cover, generously: sectors
// only narrow down who is tested, the exact test decides.
void Radio::cast_shadows(Scratch& s) const {
  s.head.fill(-1);
  s.shadows.clear();
  s.bearing.resize(s.neighbors.size());
  constexpr float per_unit = sectors / 4.0F;
  const auto radius = static_cast<float>(radius_m_);
  for (std::size_t k = 0; k < s.neighbors.size(); ++k) {
    const float bearing = pseudo_angle(s.neighbors[k].d);
    s.bearing[k] = bearing;
    // asin(x) <= 1.05 x for x <= 1/2; discs that overlap the robot may cover any direction.
    const float ratio = radius / std::sqrt(static_cast<float>(s.neighbors[k].d2));
    const float half = ratio <= 0.5F ? 1.05F * ratio + 1e-4F : 2.0F;
    const int from = static_cast<int>(std::floor((bearing - half) * per_unit));
    const int to = std::min(static_cast<int>(std::floor((bearing + half) * per_unit)), from + sectors - 1);
    for (int sector = from; sector <= to; ++sector) {
      std::int32_t& head = s.head[static_cast<std::size_t>(sector & (sectors - 1))];
      s.shadows.push_back({static_cast<std::uint32_t>(k), head});
      head = static_cast<std::int32_t>(s.shadows.size()) - 1;
    }
  }
}

bool Radio::shadowed(const Scratch& s, std::size_t target) const noexcept {
  const Neighbor& t = s.neighbors[target];
  if (s.neighbors.size() <= few_neighbors) {
    for (std::size_t k = 0; k < s.neighbors.size(); ++k)
      if (k != target && disc_blocks(s.neighbors[k].d, t.d, t.d2, radius_m_)) return true;
    return false;
  }
  const auto sector = static_cast<std::size_t>(s.bearing[target] * (sectors / 4.0F)) & (sectors - 1);
  for (std::int32_t at = s.head[sector]; at >= 0; at = s.shadows[static_cast<std::size_t>(at)].next) {
    const std::uint32_t k = s.shadows[static_cast<std::size_t>(at)].neighbor;
    if (k != target && disc_blocks(s.neighbors[k].d, t.d, t.d2, radius_m_)) return true;
  }
  return false;
}

// Decides every pair (i, j > i), so that each is decided once and from the same end.
void Radio::scan(std::size_t i, std::span<const Vec2> positions, std::span<const std::uint8_t> alive, Scratch& s) const {
  gather(i, positions, s);
  if (line_of_sight_ && s.neighbors.size() > few_neighbors) cast_shadows(s);
  s.obstacles.clear();
  if (line_of_sight_)
    for (const Obstacle& obstacle : obstacles_)
      if (clearance(obstacle, positions[i]) < range_m_) s.obstacles.push_back(&obstacle);

  const auto self = static_cast<std::uint32_t>(i);
  for (std::size_t k = 0; k < s.neighbors.size(); ++k) {
    const Neighbor& n = s.neighbors[k];
    if (n.index <= self) continue;
    if (n.d2 < near_m_ * near_m_) s.near.emplace_back(self, n.index);
    if (n.d2 >= range_m_ * range_m_ || alive[i] == 0 || alive[n.index] == 0) continue;
    const auto in_the_way = [&](const Obstacle* o) { return blocks(*o, positions[i], positions[n.index]); };
    const bool blocked = line_of_sight_ && (shadowed(s, k) || std::any_of(s.obstacles.begin(), s.obstacles.end(), in_the_way));
    (blocked ? s.blocked : s.links).emplace_back(self, n.index);
  }
}

// Pairs of all threads, in order, into compressed rows that are ascending at both ends.
void Radio::merge(std::size_t robots) {
  blocked_.clear();
  near_.clear();
  std::fill(offsets_.begin(), offsets_.end(), 0U);
  std::size_t pairs = 0;
  for (const Scratch& s : scratch_) {
    blocked_.insert(blocked_.end(), s.blocked.begin(), s.blocked.end());
    near_.insert(near_.end(), s.near.begin(), s.near.end());
    for (const auto& [i, j] : s.links) {
      ++offsets_[i + 1];
      ++offsets_[j + 1];
    }
    pairs += s.links.size();
  }
  for (std::size_t i = 0; i < robots; ++i) {
    offsets_[i + 1] += offsets_[i];
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
                      bytes(fill_) + bytes(links_) + bytes(blocked_) + bytes(near_);
  for (const Scratch& s : scratch_) total += bytes(s.neighbors) + bytes(s.shadows) + bytes(s.links) + bytes(s.blocked) + bytes(s.near);
  return total;
}

}  // namespace banyan::world
