// SPDX-License-Identifier: MIT
// What robots run on (docs/model.md, Batteries): charge that sinks by what they do, and the slots of charging places.
// Nothing here is known to the robots; World::Impl::sense tells each its own charge.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "banyan/controller/core/digest.hpp"
#include "banyan/controller/core/inputs.hpp"
#include "banyan/world/scenario.hpp"

namespace banyan::world {

class Batteries {
 public:
  Batteries(const Scenario& scenario, std::size_t robots);

  [[nodiscard]] bool on() const noexcept { return model_.on(); }
  // `seconds` of this motion go by: first the slots are given out, then charge flows. Returns how many of the living
  // are empty now.
  std::size_t pass(double seconds, std::span<const Velocity> moving, std::span<const Vec2> positions,
                   std::span<const std::uint8_t> alive);

  // Robot i has the charge with which it began.
  void renew(std::size_t i) noexcept {
    if (on()) levels_[i] = first_levels_[i];
  }

  // It has a full one, and so takes no slot from others.
  void fill(std::size_t i) noexcept {
    if (on()) levels_[i] = 1.0;
  }

  // Shares of a full battery, per robot; empty if there are no batteries.
  [[nodiscard]] std::span<const double> levels() const noexcept { return levels_; }
  // Per robot the place that charges it, -1: none; empty if there are no batteries.
  [[nodiscard]] std::span<const std::int32_t> places() const noexcept { return places_; }
  void add_to(Digest& digest) const noexcept;

 private:
  void give_slots(std::span<const Vec2> positions, std::span<const std::uint8_t> alive);
  [[nodiscard]] double drawn_per_s(const Velocity& motion) const noexcept;

  Battery model_;
  bool holonomic_ = false;
  double reach_m_ = 0.0;
  double wheel_distance_m_ = 0.0;
  double wheel_limit_m_s_ = 0.0;
  std::vector<double> levels_, first_levels_;
  std::vector<std::int32_t> places_;
};

}  // namespace banyan::world
