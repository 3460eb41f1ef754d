// SPDX-License-Identifier: MIT
// The parts of a step of cohesive control, in their order. Numbers in formulas of docs/baselines.md.
#pragma once

#include <array>

#include "banyan/baselines/cohesion/cohesion.hpp"

namespace banyan::baselines::cohesion {

// The longest link in the authors' program. Forces are computed in its units, so their numbers keep their meaning.
inline constexpr float source_range = 1.2F;

// A point among the robots as the step needs it, looked at once.
struct Surroundings {
  std::array<Vec2, neighbor_capacity> places;         // of neighbours, in units of the authors
  std::array<float, neighbor_capacity> bearings;      // rad, counter-clockwise
  std::array<Vec2, neighbor_capacity> frames;         // turn what a neighbour says into my frame; zero: cannot tell
  std::array<std::uint8_t, neighbor_capacity> order;  // counter-clockwise
  int size;

  Surroundings(const Params& params, const State& self) noexcept;
  [[nodiscard]] Vec2 place(int k) const noexcept { return places[static_cast<std::size_t>(k)]; }
  [[nodiscard]] Vec2 frame(int k) const noexcept { return frames[static_cast<std::size_t>(k)]; }
  // The i-th counter-clockwise, from any i >= 0.
  [[nodiscard]] int next(int i) const noexcept { return order[static_cast<std::size_t>(i % size)]; }
  // From the i-th to the one after it, in [0, 2 pi]; to the only one there is: 2 pi.
  [[nodiscard]] float gap(int i) const noexcept;
};

// A robot within its step.
struct Robot {
  const Params& params;
  State& self;
  Surroundings around{params, self};

  [[nodiscard]] const Table<Message>& table() const noexcept { return self.neighbors; }
  [[nodiscard]] const Message& message(int k) const noexcept { return self.neighbors.message(k); }
};

// boundary.cpp: where there is nothing of the swarm between two neighbours.
struct Sector {
  int right, left;  // neighbours
  float angle;      // counter-clockwise from right to left
  Mean right_mean, left_mean;

  [[nodiscard]] float mean() const noexcept;  // angle along the boundary: less than pi around a hole
};
inline constexpr int most_sectors = 8;  // more than six there are not, unless neighbours are far beyond the radio
struct Boundary {
  bool candidate = false;
  bool matching = false;
  int size = 0;
  std::array<Sector, most_sectors> sectors;  // the widest first

  [[nodiscard]] bool is_boundary() const noexcept { return size > 0; }
  [[nodiscard]] bool is_large()
      const noexcept;  // part of one that is nearly straight: long, and not that of a small hole
  void add(const Sector& sector) noexcept;
};
[[nodiscard]] Boundary find_boundary(const Robot& robot) noexcept;
[[nodiscard]] Vec2 boundary_tension(const Robot& robot, const Boundary& boundary) noexcept;

// thickness.cpp: how thick the swarm is here, and where it is thickest.
struct Thickness {
  std::uint8_t depth = unknown_depth;
  std::uint8_t thickness = unknown_depth;
  std::uint8_t hops = 0;
  int towards = -1;  // the neighbour by whom I know

  friend bool operator==(const Thickness&, const Thickness&) = default;
};
[[nodiscard]] Thickness find_thickness(const Robot& robot, const Boundary& boundary) noexcept;
[[nodiscard]] Vec2 contraction(Robot& robot, const Boundary& boundary, const Thickness& found) noexcept;

// leaders.cpp: which leaders are near, how they move, whether one needs help. `velocity`: mine, by K.
struct Leaders {
  std::array<SaidLeader, most_leaders> said{};  // the nearest first
  std::array<int, most_leaders> towards{};      // the neighbour by whom I know; -1: I am it
  int size = 0;
};
[[nodiscard]] Leaders find_leaders(const Robot& robot, Vec2 velocity) noexcept;
[[nodiscard]] Vec2 leaders_pull(const Robot& robot, const Leaders& leaders) noexcept;
[[nodiscard]] Guard wait_for_nearest(const Robot& robot) noexcept;  // a leader does not leave its nearest neighbour
struct Help {
  std::uint8_t said = 0;
  Vec2 pull;
};
[[nodiscard]] Help find_help(const Robot& robot) noexcept;

// spacing.cpp: how far apart neighbours should be, and how many on an area.
[[nodiscard]] Vec2 lattice_force(const Robot& robot, Vec2 velocity) noexcept;
struct Density {
  std::uint8_t said = 0;
  Vec2 force;
};
[[nodiscard]] Density find_density(const Robot& robot, const Boundary& boundary) noexcept;

}  // namespace banyan::baselines::cohesion
