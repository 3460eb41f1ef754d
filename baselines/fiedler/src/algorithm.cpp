// SPDX-License-Identifier: MIT
#include "banyan/baselines/common/algorithm.hpp"
#include "banyan/baselines/fiedler/fiedler.hpp"

namespace banyan::baselines::fiedler {

const Algorithm& algorithm() noexcept {
  static constexpr AlgorithmOf<Robots> described({
      .name = "fiedler",
      .summary = "estimates the algebraic connectivity of the network, and moves up its gradient",
      .bind = bind<Params, parameters>,
      .fault = fault,
  });
  return described;
}

}  // namespace banyan::baselines::fiedler
