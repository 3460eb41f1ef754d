// SPDX-License-Identifier: MIT
// What a robot of Fiedler control broadcasts (docs/baselines.md).
#pragma once

#include <cstdint>

#include "banyan/controller/core/report.hpp"
#include "banyan/controller/core/wire.hpp"

namespace banyan::baselines::fiedler {

inline constexpr float largest_real = 1e4F;  // no number in a message is larger
inline constexpr float per_weight = 512.0F;  // units of a weighted degree in a message

// A proportional-integral average consensus estimator: `value` converges to the mean of all robots' inputs.
struct Average {
  float value = 0.0F;
  float integral = 0.0F;

  friend bool operator==(const Average&, const Average&) = default;
};

struct Message {
  static constexpr std::uint8_t blocks = 0;
  RobotId id = nobody;
  float component = 0.0F;            // x, of the Fiedler vector
  Average mean;                      // of x
  Average square;                    // of (x - mean)^2
  Average product;                   // of (x - mean) (L x)
  float lambda = 0.0F;               // its estimate of lambda_2; only for observers
  std::uint8_t links = 0;            // how many it has
  std::uint16_t largest_degree = 0;  // the largest weighted degree that it knows of,
  std::uint8_t degree_age = 0;       // from so many ticks ago
  RobotId root = nobody;             // the robot that it believes to be root,
  std::uint8_t root_age = 0;         // from so many ticks ago

  friend bool operator==(const Message&, const Message&) = default;
};

template <class Visitor, class M> constexpr void visit_all(Visitor& visit, M& m) noexcept {
  visit.robot("id", "of the sender", m.id);
  visit.real("component", "of the Fiedler vector, not normalised", m.component, largest_real);
  visit.real("mean", "of all components, as estimated", m.mean.value, largest_real);
  visit.real("mean_integral", "of the differences between neighbours' estimates of it", m.mean.integral, largest_real);
  visit.real("square", "mean of all (component - mean)^2, as estimated", m.square.value, largest_real);
  visit.real("square_integral", "of the differences between neighbours' estimates of it", m.square.integral,
             largest_real);
  visit.real("product", "mean of all (component - mean) times (Laplacian times components), as estimated",
             m.product.value, largest_real);
  visit.real("product_integral", "of the differences between neighbours' estimates of it", m.product.integral,
             largest_real);
  visit.real("lambda", "algebraic connectivity, as estimated: product / square", m.lambda, largest_real);
  visit.number("links", "how many the sender has", m.links);
  visit.scaled("largest_degree", "the largest weighted degree of any robot", m.largest_degree, per_weight);
  visit.number("degree_age", "ticks since that was so", m.degree_age);
  visit.robot("root", "the robot that it believes to be root, -1: nobody", m.root);
  visit.number("root_age", "ticks since that said so", m.root_age);
}
template <class Visitor> constexpr void visit_fields(Visitor& visit, Message& m) noexcept { visit_all(visit, m); }
template <class Visitor> constexpr void visit_fields(Visitor& visit, const Message& m) noexcept { visit_all(visit, m); }

}  // namespace banyan::baselines::fiedler
