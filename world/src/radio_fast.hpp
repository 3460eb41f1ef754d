// SPDX-License-Identifier: MIT
// The radio as it runs: what no motion can have changed is not looked at again (radio_fast.cpp says how).
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "banyan/world/radio.hpp"
#include "banyan/world/ragged_array.hpp"
#include "banyan/world/sight.hpp"

namespace banyan::world {

class Radio::Fast {
 public:
  Fast(const Scenario& scenario, std::size_t robots);

  // As Radio's functions of these names.
  void update(std::span<const Vec2> positions, std::span<const std::uint8_t> alive,
              std::span<const std::uint8_t> raised, Executor& executor);
  void occlude(bool on, std::span<const Obstacle> obstacles);
  void forget(std::uint32_t i);
  [[nodiscard]] std::span<const std::uint32_t> links(std::size_t i) const noexcept { return links_.of(i); }
  [[nodiscard]] NearPairs near() const noexcept { return near_; }
  [[nodiscard]] std::vector<std::pair<std::uint32_t, std::uint32_t>> blocked() const;
  [[nodiscard]] std::size_t memory_bytes() const noexcept;

 private:
  using Couple = std::pair<std::uint32_t, std::uint32_t>;
  // A way in small units, rounded up. It wraps: only differences count.
  using Way = std::uint32_t;
  static constexpr Way units_per_reach = 1U << 20;
  static constexpr std::uint32_t last_index = (1U << 28) - 1;
  static constexpr std::size_t chunk = 8;  // of neighbours that are looked at together
  static constexpr std::size_t lanes = 4;  // of pairs that are tested together

  // What was found out about robot i and another, j > i.
  struct Pair {
    std::uint32_t other : 28 = 0;
    // Neither linked nor blocked: out of range, or dead. Both: bodies are in the way, but antennas look over them.
    std::uint32_t linked : 1 = 0, blocked : 1 = 0, near : 1 = 0;
    std::uint32_t lively : 1 = 0;  // which of two clocks `until` is by
    std::uint32_t witness = 0;     // the body in the way, or if none is the one that is nearest to it; or nobody_
    Way until = 0;                 // by the clock of all around: until then no other body changes anything
  };
  // Its first four bytes: the other and the flags.
  [[nodiscard]] static std::int32_t word_of(const Pair& pair) noexcept {
    std::int32_t word = 0;
    std::memcpy(&word, &pair, sizeof word);
    return word;
  }
  // A position in single precision.
  struct Place {
    float x, y;
  };
  using FourWhole = std::int32_t __attribute__((vector_size(16)));
  // How a pair has changed: 1 linked or near, -1 no longer, 0 unchanged.
  struct Change {
    Couple couple;
    int link, near;
  };
  // The row of a robot: all robots within reach when it was written.
  struct Row {
    bool known = false;
    Way written = 0;  // by the clock of the row
    Way seen = 0;     // by its fast clock: when its pairs were looked at last
  };
  struct Scratch {                     // one per thread
    std::vector<std::uint32_t> index;  // all robots within reach of a robot, ascending; the first `size` are valid
    std::size_t size = 0;
    std::vector<Pair> old;                   // a row before it was written anew
    std::vector<float> x, y;                 // from a robot to each of its row, world frame, padded to whole chunks
    std::vector<const Obstacle*> obstacles;  // near it
    std::vector<Change> changes;             // in this update
    bool rebuild = false;                    // they are not all that has changed
    bool no_room = false;                    // some row needs more
  };
  // A robot and its row, while it is looked at.
  struct Site {
    std::size_t i;
    Vec2 here;
    std::span<const Vec2> positions;
    std::span<const std::uint32_t> lower;
    std::span<Pair> pairs;
    Scratch& s;
    bool looked = false;  // s.x, s.y and s.obstacles are those of this robot
  };
  // Whether a body is in the way, and which. If none is: the nearest one, and how far all others are from being in the
  // way.
  struct View {
    bool blocked;
    std::uint32_t witness;
    float others_m;
  };
  // In single precision; and so near to a limit a doubt is left.
  struct Limits {
    float range_m2, near_m2, radius_m2;
    float area_m2;  // of a product of two lengths
    float edge_m4;  // of the square of one, where a body only just blocks
  };

  [[nodiscard]] Way clock(std::size_t i) const noexcept { return path_[i] + around_[i]; }
  // Of all around robot i and another: either bounds how far a body and the line of sight approach each other.
  [[nodiscard]] Way clock_of_all(std::size_t i, const Pair& pair) const noexcept {
    return around_[i] + (pair.lively != 0 ? around_[i] : path_[i] + path_[pair.other]);
  }
  // None, or less: the clock has run out.
  [[nodiscard]] std::int32_t way_left(std::size_t i, const Pair& pair) const noexcept {
    return static_cast<std::int32_t>(pair.until - clock_of_all(i, pair));
  }
  // So far that clocks may go on: they are up to one unit too slow per robot, and rounding is far less.
  [[nodiscard]] Way way(double m) const noexcept { return static_cast<Way>(std::max(0.0, m * units_per_m_ - 4.0)); }
  // Obstacles that are farther beyond the range are in no line of sight before robots have moved so far.
  [[nodiscard]] double beyond_range_m() const noexcept { return 0.25 * range_m_; }
  [[nodiscard]] Way fast_clock(std::size_t i) const noexcept { return path_[i] + 2 * around_[i]; }

  [[nodiscard]] bool follow(std::span<const Vec2> positions, std::span<const std::uint8_t> alive);
  [[nodiscard]] bool raise(std::span<const std::uint8_t> raised);
  void lay_grid(std::span<const Vec2> positions);
  void note_places(std::span<const Vec2> positions, Vec2 low, Vec2 high);
  void spread_motion();
  void sort_into_cells();
  void gather(std::size_t i, std::span<const Vec2> positions, Scratch& s) const;
  [[nodiscard]] bool write_row(std::size_t i, std::span<const Vec2> positions, Scratch& s);
  void make_room(std::span<const Vec2> positions);
  void refresh(std::size_t i, std::span<const Vec2> positions, Scratch& s);
  static void note(std::size_t i, const Pair& before, const Pair& now, Scratch& s);
  void decide(Site& site, Pair& pair) const;
  [[nodiscard]] FourWhole doubtful(const Site& site, std::size_t begin) const noexcept;
  [[nodiscard]] bool still_holds(const Site& site, const Pair& pair) const noexcept;
  [[nodiscard]] double judge_sight(Site& site, Pair& pair, Vec2 d, double d2) const;
  void look_at_moving(Site& site) const;
  void look_at_all(Site& site) const;
  void look_around(Site& site) const;
  void look_over(std::size_t i, std::span<const Vec2> positions, Scratch& s);
  [[nodiscard]] bool looks_over(const Site& site, const Pair& pair) const;
  [[nodiscard]] View look(const Site& site, const Pair& pair, Vec2 d, double length_m) const noexcept;
  void apply_changes();
  void merge();

  double range_m_;
  double radius_m_;
  double near_m_;
  double reach_m_;  // how far a row reaches
  double units_per_m_;
  Way skin_;   // a row is written anew once its clock has gone on so far; to the end of
  Way valid_;  // this it misses no robot that matters
  bool line_of_sight_;
  bool leaky_;
  bool dead_vanish_;
  std::vector<Obstacle> obstacles_;

  // As of the last update.
  std::vector<Vec2> last_;
  std::vector<std::uint8_t> alive_;
  std::vector<std::uint8_t> raised_;  // by robot; empty unless sight leaks
  bool all_anew_ = true;              // every pair is to be decided again: sight or obstacles have changed

  std::uint32_t nobody_;       // the index after the last robot's; is far away, and never moves
  std::vector<Way> path_;      // how far each robot has moved,
  std::vector<Way> step_;      // and in the last update
  std::vector<Way> around_;    // the farthest move of any robot within its reach, summed over ticks
  std::vector<Place> places_;  // relative to the middle of the swarm
  float rounding_m_ = 0.0F;    // of the difference of two places, at most
  Limits limits_{};
  std::vector<Row> rows_;
  RaggedArray<std::uint32_t> lower_;    // of each row those with a smaller index,
  RaggedArray<Pair, lanes - 1> pairs_;  // and those with a larger one; ascending

  // Grid of cells at least as wide as the reach, robots sorted by cell (counting sort).
  double cell_m_ = 1.0;
  std::size_t columns_ = 1, lines_ = 1;
  bool use_grid_ = false;  // not while the swarm covers a few cells only
  std::vector<std::uint32_t> cell_of_, cell_start_, sorted_;
  std::vector<Way> motion_, across_;  // the farthest move in each cell in this tick; in three cells side by side

  std::vector<Scratch> scratch_;
  RaggedArray<std::uint32_t> links_;  // ascending
  std::vector<std::uint32_t> count_;  // of links, while they are laid out anew
  std::vector<Couple> near_;
};

}  // namespace banyan::world
