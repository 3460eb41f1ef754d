// SPDX-License-Identifier: MIT
// Who can hear whom: links by range and exact line of sight, all pairs, every tick.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "banyan/world/bodies.hpp"
#include "banyan/world/scenario.hpp"
#include "banyan/world/threads.hpp"

namespace banyan::world {

// A link i-j exists while both live, |p_i - p_j| < C, and - with line of sight - the open segment
// between the centres meets no obstacle and no body but their own: |p_k - segment| >= radius for
// every other robot k beside the segment, dead ones included unless they vanish. Exactly symmetric: each pair is decided once.
class Radio {
 public:
  Radio(const Scenario& scenario, std::size_t robots);

  // Finds links, blocked pairs and near pairs at the given poses. O(N + pairs in range) time.
  void update(std::span<const Vec2> positions, std::span<const std::uint8_t> alive, Executor& executor);

  // From the next update on these block, and blocking counts or not.
  void set_obstacles(std::span<const Obstacle> obstacles) { obstacles_.assign(obstacles.begin(), obstacles.end()); }
  void set_line_of_sight(bool on) noexcept { line_of_sight_ = on; }

  // Robot i has vanished since the last update: it is near to nobody.
  void forget(std::uint32_t i);

  [[nodiscard]] std::span<const std::uint32_t> links(std::size_t i) const noexcept {
    return {links_.data() + offsets_[i], links_.data() + offsets_[i + 1]};
  }
  [[nodiscard]] std::span<const std::pair<std::uint32_t, std::uint32_t>> blocked() const noexcept { return blocked_; }
  [[nodiscard]] NearPairs near() const noexcept { return near_; }
  [[nodiscard]] std::span<const std::uint32_t> offsets() const noexcept { return offsets_; }
  [[nodiscard]] std::size_t memory_bytes() const noexcept;

  // Whether a disc of `radius` at `k` blocks the segment from the origin to `d`: nearer than radius
  // to its interior. The one predicate that decides, here and in the brute-force test.
  [[nodiscard]] static bool disc_blocks(Vec2 k, Vec2 d, double d2, double radius) noexcept {
    const double along = dot(k, d);
    if (along <= 0.0 || along >= d2) return false;
    const double across = cross(k, d);
    return across * across < radius * radius * d2;
  }

 private:
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  static constexpr std::uint32_t nobody_blocks = 0xFFFFFFFF;
  static constexpr std::size_t chunk = 16;   // of neighbours that are looked at together
  struct Scratch {    // one per thread; the first `size` of each array are valid
    std::size_t size = 0;
    std::vector<std::uint32_t> index;    // everybody in range of the robot being scanned, ascending
    std::vector<double> dx, dy, d2;      // from it, world frame
    std::vector<float> x, y;             // dx, dy in single precision, padded to whole chunks
    std::vector<const Obstacle*> obstacles;   // near the robot
    std::vector<Pair> links, blocked, near;
    std::vector<std::uint32_t> blocker;       // of each blocked pair
  };

  void build_grid(std::span<const Vec2> positions);
  void scan(std::size_t i, std::span<const Vec2> positions, std::span<const std::uint8_t> alive, Scratch& s) const;
  void gather(std::size_t i, std::span<const Vec2> positions, std::span<const std::uint8_t> alive, Scratch& s) const;
  [[nodiscard]] std::uint32_t find_blocker(Scratch& s, std::size_t target) const noexcept;
  void merge(std::size_t robots);

  double range_m_;
  double radius_m_;
  double near_m_;
  bool line_of_sight_;
  bool dead_vanish_;
  std::vector<Obstacle> obstacles_;

  // Grid of cells at least C wide, robots sorted by cell (counting sort). Not used while the swarm covers a few cells only.
  Vec2 origin_{};
  double cell_m_ = 1.0;
  std::size_t columns_ = 1, rows_ = 1;
  bool use_grid_ = false;
  std::vector<std::uint32_t> cell_of_, cell_start_, sorted_;
  std::vector<Vec2> sorted_position_;

  std::vector<Scratch> scratch_;
  std::vector<std::uint32_t> offsets_, fill_, links_;  // compressed rows
  std::vector<Pair> blocked_, near_;
  std::vector<std::uint32_t> blocker_;           // of each blocked pair: a body, or nobody_blocks for an obstacle
  std::vector<std::uint32_t> blocked_offsets_;   // blocked_ by first robot
};

}  // namespace banyan::world
