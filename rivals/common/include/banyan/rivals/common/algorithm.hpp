// SPDX-License-Identifier: MIT
// What every rival needs to be an Algorithm, for its src/algorithm.cpp. For hosts.
#pragma once

#include <vector>

#include "banyan/controller/core/algorithm_of.hpp"
#include "banyan/controller/core/speed_parameter.hpp"
#include "banyan/rivals/common/params.hpp"

namespace banyan::rivals {

// The table: the rows that all rivals have, those that own_parameters() lists, and the speed.
template <class Params, auto own_parameters> [[nodiscard]] std::vector<BoundParameter> bind(Params& params) {
  return bind_all(params, common_parameters<Params>, own_parameters(), speed_parameter<Params>);
}

}  // namespace banyan::rivals
