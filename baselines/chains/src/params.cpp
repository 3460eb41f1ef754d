// SPDX-License-Identifier: MIT
#include "banyan/baselines/chains/params.hpp"

namespace banyan::baselines::chains {
namespace {

constexpr Parameter<Params> of_chains[] = {
    {{"safe_distance", "", "C", "chains: SAFE, a robot goes on only while its parent is nearer than this",
      "Larger needs fewer relays, with less room to react.", "chains", 0.05F, 1.0F},
     &Params::safe_distance},
    {{"critical_distance", "", "C", "chains: CRITICAL, a robot whose parent is farther goes back to it",
      "Between safe_distance and longest_link.", "chains", 0.05F, 1.0F},
     &Params::critical_distance},
    {{"chains_per_target", "", "", "chains: this many chains join each worker to the base",
      "With two or more a worker stays connected when a relay dies; each takes as many relays.", "chains", 1.0F,
      static_cast<float>(most_chains)},
     &Params::chains_per_target},
    {{"request_rounds", "", "rounds", "chains: a free robot that does not answer for this long is no longer asked",
      "More than a question and its answer take.", "chains", 1.0F, 600.0F},
     &Params::request_rounds},
    {{"ignore_rounds", "", "rounds", "chains: a robot that did not answer is not asked again for this long",
      "More than it takes others to join.", "chains", 0.0F, 6000.0F},
     &Params::ignore_rounds},
    {{"gap_patience_drives", "", "drives",
      "chains: a relay in the place of a dead one waits this long for the rest of the chain",
      "More than the rest takes to come back.", "chains", 0.1F, 30.0F},
     &Params::gap_patience_drives},
    {{"free_spacing", "", "C", "chains: how far apart free robots stand around the base",
      "Nearer robots are found sooner, and hide one another.", "chains", 0.01F, 1.0F},
     &Params::free_spacing},
    {{"side_offset", "", "C", "chains: how far apart the chains of one worker arrive at it",
      "More than two body diameters.", "chains", 0.0F, 5.0F},
     &Params::side_offset},
};

}  // namespace

std::span<const Parameter<Params>> parameters() noexcept { return of_chains; }

std::string_view fault(const Params& params) noexcept {
  if (!(params.safe_distance < params.critical_distance))
    return "safe_distance must be below critical_distance, else a robot would go on and go back at the same distance";
  if (!(params.critical_distance < params.longest_link))
    return "critical_distance must be below longest_link, else no robot would go back before its link is lost";
  return {};
}

}  // namespace banyan::baselines::chains
