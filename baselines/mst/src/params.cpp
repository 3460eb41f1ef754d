// SPDX-License-Identifier: MIT
#include "banyan/baselines/mst/params.hpp"

namespace banyan::baselines::mst {
namespace {

constexpr Parameter<Params> of_mst[] = {
    {{"trigger_distance", "", "C", "mst: a tree edge longer than this asks for a new tree",
      "Shorter asks more often: the tree fits better, and constructions hold the robots up.", "mst", 0.05F, 1.0F},
     &Params::trigger_distance},
    {{"least_period_rounds", "", "rounds", "mst: time between two trees", "More than a construction takes.", "mst",
      10.0F, 36000.0F},
     &Params::least_period_rounds},
    {{"countdown_rounds", "", "rounds", "mst: from the first word of a new tree to its construction",
      "More than news takes through the whole network, so that all measure their links at the same time; at most 255 "
      "ticks.",
      "mst", 1.0F, 250.0F},
     &Params::countdown_rounds},
    {{"build_rounds", "", "rounds", "mst: a construction that takes longer is begun anew",
      "More than log2 N rounds through the longest chain.", "mst", 10.0F, 36000.0F},
     &Params::build_rounds},
    {{"consensus_gain", "", "1/C",
      "mst: a robot without a target goes to the mean of its tree neighbours, this much of v_max per C",
      "Larger follows more closely and comes to rest later.", "mst", 0.0F, 100.0F},
     &Params::consensus_gain},
};

}  // namespace

std::span<const Parameter<Params>> parameters() noexcept { return of_mst; }

std::string_view fault(const Params& params) noexcept {
  if (!(params.trigger_distance < params.longest_link))
    return "trigger_distance must be below longest_link, else no edge would ever ask for a new tree";
  if (!(params.countdown_rounds < params.least_period_rounds))
    return "countdown_rounds must be below least_period_rounds, else the next tree would be due before this one is "
           "begun";
  return {};
}

}  // namespace banyan::baselines::mst
