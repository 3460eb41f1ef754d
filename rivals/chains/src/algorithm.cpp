// SPDX-License-Identifier: MIT
#include "banyan/rivals/common/algorithm.hpp"
#include "banyan/rivals/chains/chains.hpp"

namespace banyan::rivals::chains {

const Algorithm& algorithm() noexcept {
  static constexpr AlgorithmOf<Robots> described({
      .name = "chains",
      .summary = "joins each worker to a base by chains of relays, which free robots enter at the base",
      .bind = bind<Params, parameters>,
      .fault = fault,
  });
  return described;
}

}  // namespace banyan::rivals::chains
