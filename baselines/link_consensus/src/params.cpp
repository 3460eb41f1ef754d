// SPDX-License-Identifier: MIT
#include "banyan/baselines/link_consensus/params.hpp"

namespace banyan::baselines::link_consensus {
namespace {

constexpr Parameter<Params> of_link_consensus[] = {
    {{"add_distance", "r", "C", "link consensus: robots nearer than this may make a link",
      "Below nominate_distance, so that a link just given up is not made anew.", "link consensus", 0.05F, 1.0F},
     &Params::add_distance},
    {{"nominate_distance", "", "C", "link consensus: a link longer than this is proposed to be given up",
      "Shorter gives up more links and sooner; longer leaves more of them to hold the network back.", "link consensus",
      0.05F, 1.0F},
     &Params::nominate_distance},
    {{"link_gain", "", "", "link consensus: gain of the potential along a kept link",
      "Smaller lets a target's pull stretch links nearer to their limit.", "link consensus", 0.0F, 10.0F},
     &Params::link_gain},
    {{"root_silence_rounds", "", "rounds",
      "link consensus: silence of the root after which another robot takes its place",
      "More than news takes to come through the longest chain.", "link consensus", 5.0F, 6000.0F},
     &Params::root_silence_rounds},
};

}  // namespace

std::span<const Parameter<Params>> parameters() noexcept { return of_link_consensus; }

std::string_view fault(const Params& params) noexcept {
  if (!(params.add_distance < params.nominate_distance))
    return "add_distance must be below nominate_distance, else a link just given up would be made anew";
  if (!(params.nominate_distance < params.longest_link))
    return "nominate_distance must be below longest_link, else no link would be given up before it holds the network "
           "back";
  return {};
}

}  // namespace banyan::baselines::link_consensus
