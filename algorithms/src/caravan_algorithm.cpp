// SPDX-License-Identifier: MIT
#include "banyan/algorithms/algorithms.hpp"
#include "banyan/algorithms/swarms.hpp"
#include "banyan/controller/core/algorithm_of.hpp"
#include "banyan/controller/core/speed_parameter.hpp"

namespace banyan {
namespace {

std::vector<BoundParameter> bind(caravan::Params& params) {
  return bind_all(params, caravan::parameters(), speed_parameter<caravan::Params>);
}

}  // namespace

const Algorithm& caravan_algorithm() noexcept {
  static constexpr AlgorithmOf<CaravanSwarm> algorithm({
      .name = "caravan",
      .summary = "one tree over all robots, towed by its workers: a promise, a cost, a post, a filter",
      .bind = bind,
      .fault = caravan::fault,
  });
  return algorithm;
}

}  // namespace banyan
