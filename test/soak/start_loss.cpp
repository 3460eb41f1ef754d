// SPDX-License-Identifier: MIT
#include "start_loss.hpp"

#include <cmath>

namespace banyan::soak {
namespace {

using world::RadioModel;

// Zuniga & Krishnamachari (2004), frames of 100 bytes.
constexpr double bits = 800.0;
constexpr double bandwidth_ratio = 1.28;

double lost_frames(double noise_ratio) {
  return 1.0 - std::pow(1.0 - 0.5 * std::exp(-noise_ratio / bandwidth_ratio), bits);
}

double noise_ratio_of(double lost) {
  return -bandwidth_ratio * std::log(2.0 * (1.0 - std::pow(1.0 - lost, 1.0 / bits)));
}

// The mean over a normal shadowing, by sums at even distances: exact enough for a smooth curve.
double lost_by_path(const RadioModel& radio, double length_m) {
  constexpr int steps = 40;
  constexpr double width = 4.0;  // standard deviations
  const double gain_db = 10.0 * radio.path_loss_exponent * std::log10(radio.range_m / length_m);
  const double edge_noise_ratio = noise_ratio_of(radio.edge_loss);
  double lost = 0.0, weights = 0.0;
  for (int k = -steps; k <= steps; ++k) {
    const double x = width * k / steps;
    const double weight = std::exp(-0.5 * x * x);
    const double decibels = gain_db + radio.shadowing_db * x;
    lost += weight * lost_frames(edge_noise_ratio * std::pow(10.0, 0.1 * decibels));
    weights += weight;
  }
  return lost / weights;
}

}  // namespace

double mean_loss(const RadioModel& radio, double length_m) {
  double lost = 0.0;
  if (radio.model == RadioModel::Model::path_loss) lost = lost_by_path(radio, length_m);
  if (radio.model == RadioModel::Model::one_way) lost = 0.5 * radio.one_way_share;  // one direction of such a pair
  return 1.0 - (1.0 - radio.loss) * (1.0 - lost);
}

double mean_loss(const RadioModel& radio, const std::vector<double>& lengths_m) {
  double sum = 0.0;
  for (const double length_m : lengths_m) sum += mean_loss(radio, length_m);
  return lengths_m.empty() ? 0.0 : sum / static_cast<double>(lengths_m.size());
}

}  // namespace banyan::soak
