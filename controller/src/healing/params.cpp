// SPDX-License-Identifier: MIT
#include "banyan/controller/healing/params.hpp"

namespace banyan {
namespace {

constexpr Parameter<HealingParams> of_healing[] = {
    {{"healing", "", "", "1: living robots take the place of dead ones; 0: they do not",
      "0 to see what the algorithm does alone.", "protocol 12", 0.0F, 1.0F},
     &HealingParams::healing},
    {{"claim_radius", "", "C", "healing: a robot this near to where the root fell silent may become root",
      "Larger finds an heir in a thin crowd; too large, and two may claim at once.", "protocol 12", 0.01F, 0.5F},
     &HealingParams::claim_radius},
    {{"claim_after_rounds", "", "rounds", "healing: silence of the root, beyond 2 I, before it is replaced",
      "Longer where the radio falls silent now and then.", "protocol 12", 0.0F, 6000.0F},
     &HealingParams::claim_after_rounds},
    {{"claim_spread_rounds", "", "rounds/C", "healing: additional silence per C from where the root was",
      "More than a message takes for that way, so that the first claim is heard.", "protocol 12", 0.0F, 2000.0F},
     &HealingParams::claim_spread_rounds},
    {{"retreat_after_rounds", "", "rounds",
      "healing: silence of the root, beyond 2 I, before all robots drive to where it was",
      "More than an election takes.", "protocol 12", 5.0F, 6000.0F},
     &HealingParams::retreat_after_rounds},
    {{"succession_after_rounds", "", "rounds", "healing: silence of a worker, beyond 2 I, before it is replaced",
      "More than its count takes to spread; longer where the radio falls silent now and then.", "protocol 12", 0.0F,
      6000.0F},
     &HealingParams::succession_after_rounds},
    {{"succession_spread_rounds", "", "rounds/C", "healing: additional silence per C from its target",
      "Above 0, so that the nearest spare goes.", "protocol 12", 0.0F, 2000.0F},
     &HealingParams::succession_spread_rounds},
    {{"largest_loss", "", "", "healing: I grows with the share of packets lost, up to this share",
      "Lower it to notice deaths sooner with a radio that loses many packets.", "protocol 12", 0.0F, 0.99F},
     &HealingParams::largest_loss},
    {{"pursue_for_drives", "", "drives",
      "healing: longest time for which a connector drives to where its last child fell silent",
      "0: the branch is given up at once. Longer finds what is farther away, and keeps robots busy meanwhile.",
      "protocol 12", 0.0F, 60.0F},
     &HealingParams::pursue_for_drives},
    {{"give_up_after_drives", "", "drives",
      "healing: a worker that drives this long at full speed towards its target and gets no nearer leaves it to "
      "others; near obstacles, or if the target itself moves, eighteen times as long",
      "Shorter where spares are at hand; longer where workers are often held up.", "protocol 12", 0.1F, 30.0F},
     &HealingParams::give_up_after_drives},
    {{"regroup_after_drives", "", "drives",
      "healing: a robot that hears no other for this long looks for the others; in convoy, a worker that waits this "
      "long in vain for a spare drives home and sets out anew",
      "Longer where spares have far to come; shorter gives up branches that would have been reached.", "protocol 12",
      0.1F, 60.0F},
     &HealingParams::regroup_after_drives},
};

}  // namespace

std::span<const Parameter<HealingParams>> healing_parameters() noexcept { return of_healing; }

std::string_view healing_fault(const HealingParams& params) noexcept {
  if (!(params.parent_margin < params.ideal_distance))
    return "parent_margin must be below ideal_distance (delta), else no robot is near enough to be a parent";
  if (!(2.0F * params.claim_radius < 1.0F))
    return "claim_radius must be below 0.5 C, else two robots that do not hear each other could become root";
  if (!(patience_hindered * params.give_up_after_drives * params.rounds_per_drive < 65535.0F))
    return "give_up_after_drives must be below 3,640 rounds, else robots cannot count it: near obstacles it is "
           "eighteen times "
           "as long";
  return {};
}

}  // namespace banyan
