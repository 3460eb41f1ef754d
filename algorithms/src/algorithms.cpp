// SPDX-License-Identifier: MIT
// The one list. An algorithm is a folder of its own, and here its include and its entry.
#include "banyan/algorithms/algorithms.hpp"

#include "banyan/rivals/branches/branches.hpp"
#include "banyan/rivals/chains/chains.hpp"
#include "banyan/rivals/cohesion/cohesion.hpp"
#include "banyan/rivals/fiedler/fiedler.hpp"
#include "banyan/rivals/link_consensus/link_consensus.hpp"
#include "banyan/rivals/mst/mst.hpp"

namespace banyan {

const AlgorithmList& algorithms() noexcept {
  static const AlgorithmList all(
      {
          &outwards(),
          &inwards(),
          &convoy(),
          &caravan_algorithm(),
          &rivals::link_consensus::algorithm(),
          &rivals::mst::algorithm(),
          &rivals::fiedler::algorithm(),
          &rivals::cohesion::algorithm(),
          &rivals::chains::algorithm(),
          &rivals::branches::algorithm(),
      },
      convoy().name());
  return all;
}

}  // namespace banyan
