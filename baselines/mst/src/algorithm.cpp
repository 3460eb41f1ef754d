// SPDX-License-Identifier: MIT
#include "banyan/baselines/common/algorithm.hpp"
#include "banyan/baselines/mst/mst.hpp"

namespace banyan::baselines::mst {

const Algorithm& algorithm() noexcept {
  static constexpr AlgorithmOf<Robots> described({
      .name = "mst",
      .summary = "keeps a minimum spanning tree of all robots, and builds a new one when an edge gets long",
      .bind = bind<Params, parameters>,
      .fault = fault,
  });
  return described;
}

}  // namespace banyan::baselines::mst
