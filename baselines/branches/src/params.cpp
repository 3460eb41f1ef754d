// SPDX-License-Identifier: MIT
#include "banyan/baselines/branches/params.hpp"

namespace banyan::baselines::branches {
namespace {

constexpr Parameter<Params> of_branches[] = {
    {{"separation_distance", "", "C",
      "branches: a leader farther than this from the last connector leaves another behind",
      "Larger needs fewer connectors, with less room to react.", "branches", 0.05F, 1.0F},
     &Params::separation},
    {{"joining_distance", "", "C",
      "branches: the last connector stops being one if the one before is nearer to the leader than this",
      "Below separation_distance.", "branches", 0.05F, 1.0F},
     &Params::joining},
    {{"connector_spacing", "", "C", "branches: beyond it a link pulls more strongly",
      "Between separation_distance and longest_link.", "branches", 0.05F, 1.0F},
     &Params::spacing},
    {{"flock_distance", "", "C", "branches: how far apart the robots of a team keep",
      "About three body diameters or more.", "branches", 0.01F, 1.0F},
     &Params::flock},
    {{"change_rounds", "", "rounds", "branches: a change of the network that is not made by then is undone",
      "More than a question and its answer take. Longer where packets are lost.", "branches", 1.0F, 600.0F},
     &Params::change_rounds},
    {{"pause_rounds", "", "rounds", "branches: least time between two changes with the same robot in the middle",
      "At least four.", "branches", 1.0F, 600.0F},
     &Params::pause_rounds},
    {{"transfer_rounds", "", "rounds", "branches: a leader sends a follower to another team at most this often",
      "Shorter helps a team sooner, and sends more than it needs.", "branches", 1.0F, 6000.0F},
     &Params::transfer_rounds},
    {{"join_patience_drives", "", "drives", "branches: a connector without a way to the root gives up after this long",
      "More than it takes others to come.", "branches", 0.1F, 30.0F},
     &Params::join_patience_drives},
};

}  // namespace

std::span<const Parameter<Params>> parameters() noexcept { return of_branches; }

std::string_view fault(const Params& params) noexcept {
  if (!(params.joining < params.separation))
    return "joining_distance must be below separation_distance, else a connector just left behind would join again";
  if (!(params.separation < params.longest_link))
    return "separation_distance must be below longest_link, else a leader would never leave a connector behind";
  if (!(params.spacing < params.longest_link))
    return "connector_spacing must be below longest_link, else no link would ever pull more strongly";
  return {};
}

}  // namespace banyan::baselines::branches
