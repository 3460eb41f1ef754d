// SPDX-License-Identifier: MIT
#include "banyan/baselines/common/algorithm.hpp"
#include "banyan/baselines/chains/chains.hpp"

namespace banyan::baselines::chains {

const Algorithm& algorithm() noexcept {
  static constexpr AlgorithmOf<Robots> described({
      .name = "chains",
      .summary = "joins each worker to a base by chains of relays, which free robots enter at the base",
      .bind = bind<Params, parameters>,
      .fault = fault,
  });
  return described;
}

}  // namespace banyan::baselines::chains
