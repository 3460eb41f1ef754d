// SPDX-License-Identifier: MIT
// The one list. An algorithm is a folder of its own, and here its include and its entry.
#include "banyan/algorithms/algorithms.hpp"

#include "banyan/baselines/branches/branches.hpp"
#include "banyan/baselines/chains/chains.hpp"
#include "banyan/baselines/cohesion/cohesion.hpp"
#include "banyan/baselines/fiedler/fiedler.hpp"
#include "banyan/baselines/link_consensus/link_consensus.hpp"
#include "banyan/baselines/mst/mst.hpp"

namespace banyan {

const AlgorithmList& algorithms() noexcept {
  static const AlgorithmList all(
      {
          &outwards(),
          &inwards(),
          &convoy(),
          &caravan_algorithm(),
          &baselines::link_consensus::algorithm(),
          &baselines::mst::algorithm(),
          &baselines::fiedler::algorithm(),
          &baselines::cohesion::algorithm(),
          &baselines::chains::algorithm(),
          &baselines::branches::algorithm(),
      },
      convoy().name());
  return all;
}

}  // namespace banyan
