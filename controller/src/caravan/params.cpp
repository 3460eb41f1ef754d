// SPDX-License-Identifier: MIT
// The parameters.
#include "banyan/controller/caravan/params.hpp"

namespace banyan::caravan {
namespace {

// clang-format off
constexpr Parameter<Params> rows[] = {
    {{"longest_edge", "G", "C", "no link that matters outgrows it",
      "Shorter is safer where positions are old or noisy, and takes more robots.", "caravan", 0.5F, 1.0F},
     &Params::longest_edge},
    {{"need_distance", "", "C", "a longer edge is worth a spare",
      "Shorter takes more robots sooner.", "caravan", 0.2F, 0.95F},
     &Params::need_distance},
    {{"pull_start", "", "C", "a child farther than this tows its parent",
      "Shorter follows more closely.", "caravan", 0.0F, 1.0F},
     &Params::pull_start},
    {{"post_distance", "", "C", "a longer edge that waits for a spare is a post",
      "Shorter calls more spares from afar.", "caravan", 0.1F, 0.95F},
     &Params::post_distance},
    {{"pull_width", "", "C", "full strength so much later",
      "Wider is smoother, and lags.", "caravan", 0.001F, 1.0F},
     &Params::pull_width},
    {{"tension_gain", "", "v_max", "edges are strings of this strength",
      "Larger straightens chains sooner.", "caravan", 0.0F, 10.0F},
     &Params::tension_gain},
    {{"robot_cost", "", "C", "a robot more in the tree costs as much as a way so much longer",
      "Larger saves robots, and time is lost.", "caravan", 0.0F, 5.0F},
     &Params::robot_cost},
    {{"hysteresis", "", "C", "a new parent has to be so much cheaper",
      "Smaller changes parents more often.", "caravan", 0.0F, 2.0F},
     &Params::hysteresis},
    {{"clearance", "", "C", "a robot nearer than this to an edge may hide it",
      "Larger keeps more lines of sight free, and takes more room.", "caravan", 0.0F, 1.0F, true},
     &Params::clearance},
    {{"room", "", "C", "spares keep so far from others",
      "Larger opens a crowd sooner.", "caravan", 0.0F, 0.5F, true},
     &Params::room},
    {{"liveness_rounds", "I", "rounds", "a robot silent for longer counts as gone",
      "Longer where packets get lost.", "caravan", 1.0F, 600.0F},
     &Params::liveness_rounds},
    {{"pursue_drives", "", "drives", "the ends of a torn edge look for each other for so long",
      "Longer where ways are long.", "caravan", 0.0F, 100.0F},
     &Params::pursue_drives},
    {{"takeover_rounds", "", "rounds", "a holder silent for so long beyond 2 I is replaced",
      "Longer where news is slow.", "caravan", 0.0F, 10000.0F},
     &Params::takeover_rounds},
    {{"takeover_spread", "", "rounds/C", "so much later for each C from its place",
      "Longer, and fewer robots claim at once.", "caravan", 0.0F, 1000.0F},
     &Params::takeover_spread},
    {{"retreat_rounds", "", "rounds", "the root silent for so long beyond 2 I: all go where it was",
      "Longer where the radio fails for a while.", "caravan", 0.0F, 10000.0F},
     &Params::retreat_rounds},
    {{"relieve_below", "", "", "batteries: a robot of the tree with less charge asks to be relieved",
      "Enough for the wait and the way.", "caravan", 0.0F, 1.0F},
     &Params::relieve_below},
    {{"charge_below", "", "", "batteries: a spare with less charge joins no edge, and goes to be charged",
      "Above relieve_below. Larger keeps spares full and makes more trips.", "caravan", 0.0F, 1.0F},
     &Params::charge_below},
    {{"guard_rate", "", "1/drive", "how soon links are kept from growing",
      "Larger uses more of their length.", "caravan", 0.1F, 100.0F},
     &Params::guard_rate},
    {{"arrival_distance", "", "C", "a worker so near to its target is there; the mission's target tolerance unless set",
      "Leave it to the mission.", "caravan", 0.005F, 5.0F},
     &Params::arrival_distance},
    {{"give_up_drives", "", "drives", "a worker that waits for spares in vain for so long puts its target off",
      "Longer where spares come from afar.", "caravan", 0.0F, 100.0F},
     &Params::give_up_drives},
    {{"retry_drives", "", "drives", "a target that was put off is tried again after so long",
      "Shorter where robots come later.", "caravan", 0.0F, 100.0F},
     &Params::retry_drives},
    {{"call_after_rounds", "", "rounds", "an edge calls spares from afar after waiting so long",
      "Longer keeps spares where they are.", "caravan", 1.0F, 6000.0F},
     &Params::call_after_rounds},
};
// clang-format on

}  // namespace

std::span<const Parameter<Params>> parameters() noexcept { return rows; }

std::string_view fault(const Params& p) noexcept {
  if (p.need_distance >= p.longest_edge)
    return "need_distance must be below longest_edge (G), else no edge would ever be worth a spare";
  if (p.pull_start >= p.longest_edge)
    return "pull_start must be below longest_edge (G), else a child would never tow its parent";
  return {};
}

}  // namespace banyan::caravan
