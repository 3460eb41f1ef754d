// SPDX-License-Identifier: MIT
#include "banyan/rivals/mst/params.hpp"

namespace banyan::rivals::mst {
namespace {

constexpr Parameter<Params> of_mst[] = {
    {{"trigger_distance", "", "C", "mst: a tree edge longer than this asks for a new tree",
      "Shorter asks more often: the tree fits better, and constructions hold the robots up.", "mst", 0.05F, 1.0F,
      Scaling::range},
     &Params::trigger_distance_m},
    {{"least_period_s", "", "s", "mst: time between two trees", "More than a construction takes.", "mst", 1.0F,
      3600.0F},
     &Params::least_period_s},
    {{"countdown_s", "", "s", "mst: from the first word of a new tree to its construction",
      "More than news takes through the whole network, so that all measure their links at the same time; at most 255 "
      "ticks.",
      "mst", 0.1F, 25.0F},
     &Params::countdown_s},
    {{"build_timeout_s", "", "s", "mst: a construction that takes longer is begun anew",
      "More than log2 N rounds through the longest chain.", "mst", 1.0F, 3600.0F},
     &Params::build_timeout_s},
    {{"consensus_gain", "", "1/m",
      "mst: a robot without a target goes to the mean of its tree neighbours, this much per metre",
      "Larger follows more closely and comes to rest later.", "mst", 0.0F, 100.0F},
     &Params::consensus_gain},
};

}  // namespace

std::span<const Parameter<Params>> parameters() noexcept { return of_mst; }

std::string_view fault(const Params& params) noexcept {
  if (!(params.trigger_distance_m < params.longest_link_m)) return "trigger_distance must be below longest_link";
  if (!(params.countdown_s / params.tick_s <= 255.0F)) return "countdown_s must not exceed 255 ticks";
  if (!(params.countdown_s < params.least_period_s)) return "countdown_s must be below least_period_s";
  if (!(params.build_timeout_s / params.tick_s < 65535.0F)) return "build_timeout_s must be below 65535 ticks";
  if (!(params.least_period_s / params.tick_s < 65535.0F)) return "least_period_s must be below 65535 ticks";
  return {};
}

}  // namespace banyan::rivals::mst
