// SPDX-License-Identifier: MIT
#include "banyan/algorithms/paper_algorithm.hpp"

#include "banyan/algorithms/algorithms.hpp"

namespace banyan {

const Algorithm& outwards() noexcept {
  static constexpr PaperAlgorithmOf<paper::outwards> algorithm(
      "outwards", "grows a spanning tree from the root over all robots, then prunes branches without worker",
      paper::outwards_column);
  return algorithm;
}

const Algorithm& inwards() noexcept {
  static constexpr PaperAlgorithmOf<paper::inwards> algorithm(
      "inwards", "grows a sparse tree from the workers towards the root; only robots that are needed join",
      paper::inwards_column);
  return algorithm;
}

}  // namespace banyan
