// SPDX-License-Identifier: MIT
// What every baseline needs to be an Algorithm, for its src/algorithm.cpp. For hosts.
#pragma once

#include <vector>

#include "banyan/baselines/common/params.hpp"
#include "banyan/controller/core/algorithm_of.hpp"
#include "banyan/controller/core/speed_parameter.hpp"

namespace banyan::baselines {

// The table: the rows that all baselines have, those that own_parameters() lists, and the speed.
template <class Params, auto own_parameters> [[nodiscard]] std::vector<BoundParameter> bind(Params& params) {
  return bind_all(params, common_parameters<Params>, own_parameters(), speed_parameter<Params>);
}

}  // namespace banyan::baselines
