// SPDX-License-Identifier: MIT
#include "banyan/controller/convoy/params.hpp"

#include <algorithm>

#include "tree/robot.hpp"

namespace banyan {
namespace {

constexpr Parameter<ConvoyParams> of_convoy[] = {
    {{"pull_start", "", "C", "convoy: a child farther away than this pulls its parent along",
      "Smaller keeps chains slack; larger stretches edges before the next robot moves.", "convoy, towing", 0.0F, 1.0F},
     &ConvoyParams::pull_start},
    {{"pull_width", "", "C", "convoy: the pull reaches full strength this far beyond pull_start",
      "Smaller is stiffer: faster, and less smooth with noise.", "convoy, towing", 0.001F, 1.0F},
     &ConvoyParams::pull_width},
    {{"tension_gain", "", "", "convoy: tree edges pull like strings with this strength",
      "Larger straightens chains sooner and holds workers back.", "convoy, towing", 0.0F, 10.0F},
     &ConvoyParams::tension_gain},
    {{"tension_start", "", "C", "convoy: edges shorter than this have no tension", "Most users need not change it.",
      "convoy, towing", 0.0F, 1.0F},
     &ConvoyParams::tension_start},
    {{"tension_width", "", "C", "convoy: tension reaches full strength this far beyond tension_start",
      "Most users need not change it.", "convoy, towing", 0.001F, 1.0F},
     &ConvoyParams::tension_width},
    {{"slack_gain", "", "", "convoy: the edges of a chain share their slack with this strength",
      "Matters only while robots are short.", "convoy, towing", 0.0F, 10.0F},
     &ConvoyParams::slack_gain},
    {{"first_edge", "", "C", "convoy: parents nearer than this are preferred",
      "Above the distance between neighbours at the start.", "convoy, the parent", 0.01F, 1.0F},
     &ConvoyParams::first_edge},
    {{"clearance", "", "C", "convoy: a robot this near to a segment counts as blocking it",
      "More than a body's radius; larger loses fewer lines of sight and finds fewer parents.", "convoy, the parent",
      0.0F, 1.0F, true},
     &ConvoyParams::clearance},
    {{"corridor_width", "", "C", "convoy: robots this near to a tree edge move away from it",
      "Larger keeps lines of sight open in crowds and takes room.", "convoy, lines of sight", 0.0F, 1.0F},
     &ConvoyParams::corridor_width},
    {{"corridor_gain", "", "", "convoy: strength of moving out of a corridor", "Most users need not change it.",
      "convoy, lines of sight", 0.0F, 10.0F},
     &ConvoyParams::corridor_gain},
    {{"join_margin", "", "C", "convoy: a spare joins an edge if both ends are nearer than delta minus this",
      "More with latency, noise or loss.", "convoy, spares and insertion", 0.0F, 1.0F},
     &ConvoyParams::join_margin},
    {{"shortest_split", "", "C", "convoy: edges shorter than this are not split", "Larger ends with fewer robots.",
      "convoy, spares and insertion", 0.0F, 1.0F},
     &ConvoyParams::shortest_split},
    {{"call_distance", "", "C", "convoy: an edge longer than this whose need no spare answers calls spares from afar",
      "Smaller calls sooner, and spares crowd the chain.", "convoy, calls", 0.0F, 1.0F},
     &ConvoyParams::call_distance},
    {{"release_distance", "", "C", "convoy: a grandparent nearer than this becomes the parent",
      "Below pull_start plus pull_width, or robots are released and inserted by turns.", "convoy, the parent", 0.0F,
      1.0F},
     &ConvoyParams::release_distance},
    {{"spare_avoidance", "", "C", "convoy: spares repel other robots within this", "About two body diameters.",
      "convoy, towing", 0.0F, 1.0F, true},
     &ConvoyParams::spare_avoidance},
    {{"merge_distance", "", "C",
      "convoy: longest edge that is made to save a robot once all workers below have arrived",
      "0 saves none. Larger saves more, and leaves less margin for noise.", "convoy, fewer robots", 0.0F, 1.0F},
     &ConvoyParams::merge_distance},
    {{"compact_distance", "", "C", "convoy: chains that have arrived stretch their edges to this",
      "Below delta and merge_distance.", "convoy, fewer robots", 0.0F, 1.0F},
     &ConvoyParams::compact_distance},
    {{"plan_after_drives", "", "drives",
      "convoy: time from the arrival of all workers to the planning of chains from target to target; 0: never",
      "0 where targets drive: a plan is for targets that stay.", "convoy, chains", 0.0F, 60.0F},
     &ConvoyParams::plan_after_drives},
    {{"shed_after_drives", "", "drives",
      "convoy: if edges lack spares and no worker makes progress for this long, the swarm gives a target up; 0: never",
      "Above the time in which robots come from far away; smaller gives targets up that might be reached.",
      "convoy, too few robots", 0.0F, 60.0F},
     &ConvoyParams::shed_after_drives},
    {{"thrift", "", "",
      "convoy: how much saving robots matters compared with saving time once workers have arrived: longer edges, and "
      "above 0 plans from the leaves inwards",
      "0 while targets change. Larger ends with fewer robots, later, and leaves less margin for noise.",
      "convoy, thrift", 0.0F, 1.0F},
     &ConvoyParams::thrift},
    {{"companion_distance", "", "C",
      "convoy: how far beside its robot a companion stands, with mission.link_redundancy above 1",
      "Above spare_avoidance and clearance; larger makes the links past that robot longer. 0: there are no companions.",
      "lasting", 0.0F, 0.5F, true},
     &ConvoyParams::companion_distance},
};

}  // namespace

std::span<const Parameter<ConvoyParams>> convoy_parameters() noexcept { return of_convoy; }

std::string_view convoy_fault(const ConvoyParams& params) noexcept {
  if (!(params.pull_start < params.ideal_distance))
    return "pull_start must be below ideal_distance (delta), else a child would never pull its parent along";
  if (const std::string_view text = power_fault(params); !text.empty()) return text;
  if (!(params.join_margin < params.ideal_distance))
    return "join_margin must be below ideal_distance (delta), else no spare would be near enough to join an edge";
  // Also for those who choose a shorter delta and leave the rest as it is.
  const float longest = std::max(params.ideal_distance, longest_link);
  if (!(params.compact_distance < longest))
    return "compact_distance must be below ideal_distance (delta), else chains would stretch until their edges break";
  if (!(params.merge_distance <= longest))
    return "merge_distance must not exceed ideal_distance (delta), else robots would be saved by edges that break";
  if (!(params.release_distance <= longest))
    return "release_distance must not exceed ideal_distance (delta), else robots would be released onto edges that "
           "break";
  if (!(params.shortest_split < longest))
    return "shortest_split must be below ideal_distance (delta), else no edge is long enough to be split";
  return {};
}

}  // namespace banyan
