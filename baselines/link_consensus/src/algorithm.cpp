// SPDX-License-Identifier: MIT
#include "banyan/baselines/common/algorithm.hpp"
#include "banyan/baselines/link_consensus/link_consensus.hpp"

namespace banyan::baselines::link_consensus {

const Algorithm& algorithm() noexcept {
  static constexpr AlgorithmOf<Robots> described({
      .name = "link-consensus",
      .summary = "keeps radio links, and gives one up when its ends agree that a detour remains",
      .bind = bind<Params, parameters>,
      .fault = fault,
  });
  return described;
}

}  // namespace banyan::baselines::link_consensus
