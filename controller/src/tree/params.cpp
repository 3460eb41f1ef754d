// SPDX-License-Identifier: MIT
#include "banyan/controller/tree/params.hpp"

namespace banyan {
namespace {

// A row for each parameter.
// clang-format off
constexpr Parameter<TreeParams> of_tree[] = {
    {{"safe_range_m", "S", "m", "beyond it a robot no longer moves away from its parent",
      "Lower it for a radio that loses links early; targets are then reached later.", "Table I", 0.05F, 100.0F,
      Scaling::mission}, &TreeParams::safe_range_m},
    {{"avoidance_range_m", "A", "m", "robots that are not tree neighbours repel each other within it",
      "About three body diameters. Larger keeps lines of sight open and takes more room.", "Table I", 0.0F, 100.0F,
      Scaling::mission}, &TreeParams::avoidance_range_m},
    {{"ideal_distance_m", "delta", "m", "ideal length of a tree edge, and the emergency range",
      "As near to C as the radio is reliable: longer edges take fewer robots and break sooner.", "Table I", 0.05F,
      100.0F, Scaling::mission}, &TreeParams::ideal_distance_m},
    {{"interaction_gain", "epsilon", "", "gain of the force between parent and child",
      "Most users need not change it; too small, and springs no longer hold the tree against the targets' pull.",
      "Table I", 0.0F, 1000.0F}, &TreeParams::interaction_gain},
    {{"target_gain", "tau", "", "magnitude of the attraction to a target",
      "Larger is faster; the springs must still hold. The largest single effect on the time to deploy.", "Table I",
      0.0F, 1.9F}, &TreeParams::target_gain},
    {{"reconfiguration_period_s", "R", "s", "time between two reconstructions of the tree",
      "Shorter adapts sooner to targets that move; each reconstruction costs about two seconds of progress.",
      "Table I", 1.0F, 3600.0F}, &TreeParams::reconfiguration_period_s},
    {{"liveness_period_s", "I", "s", "a neighbour not heard for longer counts as gone",
      "At least five ticks. Packet loss is allowed for on top of it where robots heal.", "Table I", 0.1F, 60.0F},
      &TreeParams::liveness_period_s},
    {{"recruitment_distance_m", "E", "m", "a tree edge longer than this asks for a spare",
      "Shorter asks sooner and ends with more robots.", "Table I", 0.01F, 100.0F, Scaling::mission},
      &TreeParams::recruitment_distance_m},
    {{"insertion_distance_m", "J", "m", "a spare this near to an edge's midpoint joins the edge",
      "Larger lets spares join sooner, with a bend in the chain.", "Table I", 0.001F, 10.0F, Scaling::mission},
      &TreeParams::insertion_distance_m},
    {{"avoidance_gain", "", "", "gain of the repulsion within A", "Raise it if bodies touch.", "protocol 9", 0.0F,
      100.0F}, &TreeParams::avoidance_gain},
    {{"parent_margin_m", "", "m", "a parent is chosen at most delta minus this away (corrected)",
      "The way that both ends drive in a few ticks; raise it with faster robots.", "protocol 2, row 4", 0.0F, 10.0F},
      &TreeParams::parent_margin_m},
    {{"guard_rate_per_s", "", "1/s", "each end may lengthen an edge at (delta - d)/2 times this (corrected)",
      "Below 1 / tick. Lower is safer with latency and noise, and slower near delta.", "protocol 2, row 4", 0.01F,
      10.0F}, &TreeParams::guard_rate_per_s},
    {{"barrier_timeout_s", "", "s", "START TREE and SELECT PARENT wait no longer than this",
      "More than a message takes to the farthest robot and back; longer only for very long chains.", "protocol 4",
      0.5F, 600.0F}, &TreeParams::barrier_timeout_s},
    {{"handover_timeout_s", "", "s", "an offer of the root token unanswered for this long is taken back",
      "Most users need not change it.", "protocol 8", 0.2F, 60.0F}, &TreeParams::handover_timeout_s},
    {{"insertion_timeout_s", "", "s", "a spare on its way to an edge gives up after this",
      "Longer for slow robots.", "protocol 7", 1.0F, 600.0F}, &TreeParams::insertion_timeout_s},
    {{"connector_patience_s", "", "s", "a connector without a child turns spare after this",
      "More than I. Longer keeps robots in the tree that are not needed.", "protocol 3", 0.1F, 600.0F},
      &TreeParams::connector_patience_s},
    {{"centroid_margin_m", "", "m", "a better root is nearer to the centroid by more than this",
      "Raise it if the root moves to and fro with noisy ranges.", "protocol 8", 0.0F, 10.0F},
      &TreeParams::centroid_margin_m},
    {{"arrival_distance_m", "", "m",
      "a worker's pull fades in proportion within this; the mission's target tolerance unless set",
      "Leave it to the mission.", "protocol 9", 0.01F, 10.0F}, &TreeParams::arrival_distance_m},
    {{"call_after_s", "", "s", "a need unanswered for this long calls spares from afar (corrected)",
      "Shorter brings spares sooner, and more of them than the edge takes; longer where the radio loses many packets.",
      "protocol 7", 0.1F, 600.0F}, &TreeParams::call_after_s},
};
// clang-format on

}  // namespace

std::span<const Parameter<TreeParams>> tree_parameters() noexcept { return of_tree; }

std::string_view tree_fault(const TreeParams& params) noexcept {
  if (!(params.reconfiguration_period_s / params.tick_s < 65535.0F))
    return "reconfiguration_period_s (R) must be below 65535 ticks";
  if (!(params.avoidance_range_m < params.recruitment_distance_m))
    return "avoidance_range_m (A) must be below recruitment_distance_m (E)";
  if (!(params.recruitment_distance_m < params.safe_range_m))
    return "recruitment_distance_m (E) must be below safe_range_m (S)";
  if (!(params.safe_range_m < params.ideal_distance_m))
    return "safe_range_m (S) must be below ideal_distance_m (delta)";
  if (!(params.ideal_distance_m <= params.communication_range_m))
    return "ideal_distance_m (delta) must not exceed the radio range C";
  return {};
}

}  // namespace banyan
