// SPDX-License-Identifier: MIT
// Which robots are in range and sight of each other, computed from positions alone: by school geometry, over
// all pairs, with no code of the world or measure/. A cut by less than a millimetre does not count.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "banyan/world/world.hpp"

namespace banyan::soak {

class SightCheck {
 public:
  explicit SightCheck(const world::World& world) : world_{world} {}

  [[nodiscard]] bool in_range(std::size_t i, std::size_t j) const noexcept;
  // Clearly hidden: a body or an obstacle is in the way.
  [[nodiscard]] bool hidden(std::size_t i, std::size_t j) const noexcept;
  [[nodiscard]] double range_m() const noexcept { return world_.scenario().radio.range_m; }

  // m, of all pairs in range, and in sight if the radio needs it.
  [[nodiscard]] std::vector<double> link_lengths_m() const;
  // Components of the robots that `counts` marks, over pairs in range, and in sight if `with_sight`.
  [[nodiscard]] std::size_t components(const std::vector<bool>& counts, bool with_sight) const;
  // Over pairs within `longest_m`, and in sight if the radio needs it.
  [[nodiscard]] std::size_t components_within(const std::vector<bool>& counts, double longest_m) const;
  // Over pairs in range, and in sight if the radio needs it, of which both hear each other (radio.model = "one_way").
  [[nodiscard]] std::size_t components_both_ways(const std::vector<bool>& counts) const;

 private:
  // In sight, if the radio needs it.
  [[nodiscard]] bool radio_reaches(std::size_t i, std::size_t j) const noexcept;
  template <class Linked>
  [[nodiscard]] std::size_t components_over(const std::vector<bool>& counts, Linked linked) const;

  const world::World& world_;
};

}  // namespace banyan::soak
