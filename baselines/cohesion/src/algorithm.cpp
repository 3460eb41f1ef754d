// SPDX-License-Identifier: MIT
#include "banyan/baselines/common/algorithm.hpp"
#include "banyan/baselines/cohesion/cohesion.hpp"

namespace banyan::baselines::cohesion {

const Algorithm& algorithm() noexcept {
  static constexpr AlgorithmOf<Robots> described({
      .name = "cohesion",
      .summary = "holds together like a liquid with a tense boundary, which leaders drag into a Steiner tree",
      .bind = bind<Params, parameters>,
      .fault = fault,
  });
  return described;
}

}  // namespace banyan::baselines::cohesion
