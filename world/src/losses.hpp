// SPDX-License-Identifier: MIT
// Which packets do not arrive, among those that fly within range and sight: the models of radio.model
// (docs/model.md). Every answer is a function of the scenario, the pair and the moment; nothing is kept
// between ticks, so neither threads nor order matter.
#pragma once

#include <cstdint>

#include "banyan/world/random.hpp"
#include "banyan/world/scenario.hpp"

namespace banyan::world {

class Losses {
 public:
  // A moment is a tick or, with clocks, a substep.
  explicit Losses(const Scenario& scenario);

  // Nothing is lost by `loss` as it is now.
  [[nodiscard]] bool none(double loss) const noexcept {
    return radio_.model == RadioModel::Model::disc && !(loss > 0.0);
  }
  // `way`: from receiver to sender; `loss`: radio.loss as it is now.
  [[nodiscard]] bool lost(std::uint64_t receiver, std::uint64_t sender, std::uint64_t moment, Vec2 way,
                          double loss) const noexcept {
    if (radio_.model != RadioModel::Model::disc) return lost_without_disc(receiver, sender, moment, norm(way), loss);
    return lost_by_chance(receiver, sender, moment, loss);
  }
  // The receiver hears nothing that the sender says, however near it is.
  [[nodiscard]] bool is_deaf(std::uint64_t receiver, std::uint64_t sender) const noexcept {
    return radio_.model == RadioModel::Model::one_way && is_drawn_deaf(receiver, sender);
  }

 private:
  [[nodiscard]] bool lost_by_chance(std::uint64_t receiver, std::uint64_t sender, std::uint64_t moment,
                                    double loss) const noexcept {
    return loss > 0.0 && to_uniform(bits(seed_, Purpose::loss, receiver, sender, moment)) < loss;
  }
  [[nodiscard]] bool lost_without_disc(std::uint64_t receiver, std::uint64_t sender, std::uint64_t moment,
                                       double distance_m, double loss) const noexcept;
  [[nodiscard]] bool in_burst(std::uint64_t receiver, std::uint64_t sender, std::uint64_t moment,
                              double loss) const noexcept;
  [[nodiscard]] double reception(std::uint64_t a, std::uint64_t b, std::uint64_t moment,
                                 double distance_m) const noexcept;
  [[nodiscard]] double shadowing_db(std::uint64_t a, std::uint64_t b, std::uint64_t moment) const noexcept;
  [[nodiscard]] bool is_drawn_deaf(std::uint64_t receiver, std::uint64_t sender) const noexcept;

  std::uint64_t seed_;
  RadioModel radio_;
  double moment_s_;
  double edge_noise_ratio_;  // signal to noise at distance C without shadowing
};

}  // namespace banyan::world
