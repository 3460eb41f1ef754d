// SPDX-License-Identifier: MIT
#include "banyan/rivals/branches/params.hpp"

namespace banyan::rivals::branches {
namespace {

constexpr Parameter<Params> of_branches[] = {
    {{"separation_distance", "", "C",
      "branches: a leader farther than this from the last connector leaves another behind",
      "Larger needs fewer connectors, with less room to react.", "branches", 0.05F, 1.0F, Scaling::range},
     &Params::separation_m},
    {{"joining_distance", "", "C",
      "branches: the last connector stops being one if the one before is nearer to the leader than this",
      "Below separation_distance.", "branches", 0.05F, 1.0F, Scaling::range},
     &Params::joining_m},
    {{"connector_spacing", "", "C", "branches: beyond it a link pulls more strongly",
      "Between separation_distance and longest_link.", "branches", 0.05F, 1.0F, Scaling::range},
     &Params::spacing_m},
    {{"flock_distance", "", "C", "branches: how far apart the robots of a team keep",
      "About three body diameters or more.", "branches", 0.01F, 1.0F, Scaling::range},
     &Params::flock_m},
    {{"change_timeout_s", "", "s", "branches: a change of the network that is not made by then is undone",
      "More than a question and its answer take. Longer where packets are lost.", "branches", 0.1F, 60.0F},
     &Params::change_timeout_s},
    {{"change_pause_s", "", "s", "branches: least time between two changes with the same robot in the middle",
      "At least four ticks.", "branches", 0.1F, 60.0F},
     &Params::change_pause_s},
    {{"transfer_interval_s", "", "s", "branches: a leader sends a follower to another team at most this often",
      "Shorter helps a team sooner, and sends more than it needs.", "branches", 0.1F, 600.0F},
     &Params::transfer_interval_s},
    {{"join_patience_s", "", "s", "branches: a connector without a way to the root gives up after this long",
      "More than it takes others to come.", "branches", 0.1F, 600.0F},
     &Params::join_patience_s},
};

}  // namespace

std::span<const Parameter<Params>> parameters() noexcept { return of_branches; }

std::string_view fault(const Params& params) noexcept {
  if (!(params.joining_m < params.separation_m)) return "joining_distance must be below separation_distance";
  if (!(params.separation_m < params.longest_link_m)) return "separation_distance must be below longest_link";
  if (!(params.spacing_m < params.longest_link_m)) return "connector_spacing must be below longest_link";
  if (!(params.transfer_interval_s / params.tick_s < 65535.0F)) return "transfer_interval_s must be below 65535 ticks";
  if (!(params.join_patience_s / params.tick_s < 65535.0F)) return "join_patience_s must be below 65535 ticks";
  return {};
}

}  // namespace banyan::rivals::branches
