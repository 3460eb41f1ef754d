// SPDX-License-Identifier: MIT
#include "losses.hpp"

#include <algorithm>
#include <cmath>

namespace banyan::world {
namespace {

// Zuniga & Krishnamachari (2004): a radio with non-coherent FSK receives a frame of f bytes at a signal to
// noise ratio g with probability (1 - exp(-g / 1.28) / 2)^(8 f).
constexpr double bandwidth_ratio = 1.28;
constexpr double frame_bits = 8.0 * 100.0;
constexpr double decibel = 0.23025850929940456840;  // ln 10 / 10
constexpr double nearest = 5e-4;                    // of the range: the signal rises no more than to there

double frame_reception(double noise_ratio) noexcept {
  const double bit = 1.0 - 0.5 * deterministic_exp(-noise_ratio / bandwidth_ratio);
  return deterministic_exp(frame_bits * deterministic_log(bit));
}
// The signal to noise ratio at which this share of frames, in (0, 1), is received.
double noise_ratio_for(double reception) noexcept {
  const double bit = deterministic_exp(deterministic_log(reception) / frame_bits);
  return -bandwidth_ratio * deterministic_log(2.0 * (1.0 - bit));
}

}  // namespace

Losses::Losses(const Scenario& s)
    : seed_{s.seed},
      radio_{s.radio},
      moment_s_{s.clocks.asynchronous ? s.tick_s / s.clocks.substeps : s.tick_s},
      edge_noise_ratio_{noise_ratio_for(1.0 - s.radio.edge_loss)} {}

bool Losses::lost_without_disc(std::uint64_t receiver, std::uint64_t sender, std::uint64_t moment, double distance_m,
                               double loss) const noexcept {
  if (radio_.model == RadioModel::Model::bursts) return in_burst(receiver, sender, moment, loss);
  if (is_deaf(receiver, sender)) return true;
  if (lost_by_chance(receiver, sender, moment, loss)) return true;
  return radio_.model == RadioModel::Model::path_loss &&
         to_uniform(bits(seed_, Purpose::path_loss, receiver, sender, moment)) >=
             reception(std::min(receiver, sender), std::max(receiver, sender), moment, distance_m);
}

// Gilbert (1960): good periods without losses and bad ones in which every packet is lost. Such a chain of two
// states forgets its past at random moments, at each with the same probability, and is then bad with its mean share.
// So its state is what was drawn at the last such moment; that is searched backwards, and no state is stored.
bool Losses::in_burst(std::uint64_t receiver, std::uint64_t sender, std::uint64_t moment, double loss) const noexcept {
  if (loss <= 0.0 || loss >= 1.0) return loss >= 1.0;
  const double forgets = std::min(1.0, moment_s_ / radio_.burst_s / (1.0 - loss));
  std::uint64_t t = moment;
  while (t > 0 && to_uniform(bits(seed_, Purpose::burst_end, receiver, sender, t)) >= forgets) --t;
  return to_uniform(bits(seed_, Purpose::loss, receiver, sender, t)) < loss;
}

// Log-distance path loss: 10 n log10(C / d) dB more than at distance C.
double Losses::reception(std::uint64_t a, std::uint64_t b, std::uint64_t moment, double distance_m) const noexcept {
  const double nearness = radio_.range_m / std::max(distance_m, nearest * radio_.range_m);
  const double gain = radio_.path_loss_exponent * deterministic_log(nearness) + decibel * shadowing_db(a, b, moment);
  return frame_reception(edge_noise_ratio_ * deterministic_exp(std::clamp(gain, -50.0, 50.0)));
}

// Normal at every moment, the same in both directions. Draws are one decorrelation time apart; in between it
// moves from one draw to the next at constant variance.
double Losses::shadowing_db(std::uint64_t a, std::uint64_t b, std::uint64_t moment) const noexcept {
  if (radio_.shadowing_db == 0.0) return 0.0;
  const auto drawn = [&](std::uint64_t k) { return to_normal(bits(seed_, Purpose::shadowing, a, b, k)); };
  if (radio_.shadowing_s == 0.0) return radio_.shadowing_db * drawn(0);
  const double turns = static_cast<double>(moment) * moment_s_ / std::max(radio_.shadowing_s, moment_s_);
  const auto last = static_cast<std::uint64_t>(turns);
  const double share = turns - static_cast<double>(last);
  const double mixed = (1.0 - share) * drawn(last) + share * drawn(last + 1);
  return radio_.shadowing_db * mixed / std::sqrt((1.0 - share) * (1.0 - share) + share * share);
}

// For a pair with one deaf direction the draw also decides which one.
bool Losses::is_drawn_deaf(std::uint64_t receiver, std::uint64_t sender) const noexcept {
  const std::uint64_t drawn = bits(seed_, Purpose::one_way, std::min(receiver, sender), std::max(receiver, sender));
  return to_uniform(drawn) < radio_.one_way_share && ((drawn & 1U) != 0) == (receiver < sender);
}

}  // namespace banyan::world
