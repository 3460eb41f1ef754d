// SPDX-License-Identifier: MIT
#include "banyan/rivals/link_consensus/params.hpp"

namespace banyan::rivals::link_consensus {
namespace {

constexpr Parameter<Params> of_link_consensus[] = {
    {{"add_distance", "r", "C", "link consensus: robots nearer than this may make a link",
      "Below nominate_distance, so that a link just given up is not made anew.", "link consensus", 0.05F, 1.0F,
      Scaling::range},
     &Params::add_distance_m},
    {{"nominate_distance", "", "C", "link consensus: a link longer than this is proposed to be given up",
      "Shorter gives up more links and sooner; longer leaves more of them to hold the network back.", "link consensus",
      0.05F, 1.0F, Scaling::range},
     &Params::nominate_distance_m},
    {{"link_gain", "", "", "link consensus: gain of the potential along a kept link",
      "Smaller lets a target's pull stretch links nearer to their limit.", "link consensus", 0.0F, 10.0F},
     &Params::link_gain},
    {{"root_silence_s", "", "s", "link consensus: silence of the root after which another robot takes its place",
      "More than news takes to come through the longest chain.", "link consensus", 0.5F, 600.0F},
     &Params::root_silence_s},
};

}  // namespace

std::span<const Parameter<Params>> parameters() noexcept { return of_link_consensus; }

std::string_view fault(const Params& params) noexcept {
  if (!(params.add_distance_m < params.nominate_distance_m)) return "add_distance must be below nominate_distance";
  if (!(params.nominate_distance_m < params.longest_link_m)) return "nominate_distance must be below longest_link";
  if (!(params.root_silence_s / params.tick_s < 65000.0F)) return "root_silence_s must be below 65000 ticks";
  return {};
}

}  // namespace banyan::rivals::link_consensus
