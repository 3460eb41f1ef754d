// SPDX-License-Identifier: MIT
#include "banyan/baselines/common/algorithm.hpp"
#include "banyan/baselines/branches/branches.hpp"

namespace banyan::baselines::branches {

const Algorithm& algorithm() noexcept {
  static constexpr AlgorithmOf<Robots> described({
      .name = "branches",
      .summary = "teams leave connectors behind them, and branches move to nearer connectors to shorten the network",
      .bind = bind<Params, parameters>,
      .fault = fault,
  });
  return described;
}

}  // namespace banyan::baselines::branches
