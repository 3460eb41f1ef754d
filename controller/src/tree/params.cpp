// SPDX-License-Identifier: MIT
#include "banyan/controller/tree/params.hpp"

namespace banyan {
namespace {

// A row for each parameter.
// clang-format off
constexpr Parameter<TreeParams> of_tree[] = {
    {{"safe_range", "S", "C", "beyond it a robot no longer moves away from its parent",
      "Lower it for a radio that loses links early; targets are then reached later.", "Table I", 0.025F, 1.0F},
     &TreeParams::safe_range},
    {{"avoidance_range", "A", "C", "robots that are not tree neighbours repel each other within it",
      "About three body diameters. Larger keeps lines of sight open and takes more room.", "Table I", 0.0F, 1.0F},
     &TreeParams::avoidance_range},
    {{"ideal_distance", "delta", "C", "ideal length of a tree edge, and the emergency range",
      "As near to 1 as the radio is reliable: longer edges take fewer robots and break sooner.", "Table I", 0.025F,
      1.0F}, &TreeParams::ideal_distance},
    {{"target_gain", "tau", "", "magnitude of the attraction to a target",
      "Larger is faster; the springs must still hold. The largest single effect on the time to deploy.", "Table I",
      0.0F, 1.9F}, &TreeParams::target_gain},
    {{"reconfiguration_drives", "R", "drives", "time between two reconstructions of the tree",
      "Shorter adapts sooner to targets that move; each reconstruction costs about 20 rounds of progress.",
      "Table I", 0.1F, 360.0F}, &TreeParams::reconfiguration_drives},
    {{"liveness_rounds", "I", "rounds", "a neighbour not heard for longer counts as gone",
      "At least five. Packet loss is allowed for on top of it where robots heal.", "Table I", 1.0F, 600.0F},
      &TreeParams::liveness_rounds},
    {{"recruitment_distance", "E", "C", "a tree edge longer than this asks for a spare",
      "Shorter asks sooner and ends with more robots.", "Table I", 0.005F, 1.0F}, &TreeParams::recruitment_distance},
    {{"avoidance_gain", "", "", "gain of the repulsion within A", "Raise it if bodies touch.", "protocol 9", 0.0F,
      100.0F}, &TreeParams::avoidance_gain},
    {{"parent_margin", "", "C", "a parent is chosen at most delta minus this away",
      "The way that both ends drive in a few rounds.", "protocol 2, row 4", 0.0F, 1.0F}, &TreeParams::parent_margin},
    {{"guard_rate", "", "1/drive", "each end may lengthen an edge at (delta - d)/2 times this",
      "Below a quarter of the rounds per drive. Lower is safer with latency and noise, and slower near delta.",
      "protocol 2, row 4", 0.1F, 100.0F}, &TreeParams::guard_rate},
    {{"barrier_rounds", "", "rounds", "START TREE and SELECT PARENT wait no longer than this",
      "More than a message takes to the farthest robot and back; longer only for very long chains.", "protocol 4",
      5.0F, 6000.0F}, &TreeParams::barrier_rounds},
    {{"handover_rounds", "", "rounds", "an offer of the root token unanswered for this long is taken back",
      "Most users need not change it.", "protocol 8", 2.0F, 600.0F}, &TreeParams::handover_rounds},
    {{"insertion_drives", "", "drives", "a spare on its way to an edge gives up after this",
      "Longer where spares are often held up.", "protocol 7", 0.1F, 60.0F}, &TreeParams::insertion_drives},
    {{"connector_rounds", "", "rounds", "a connector without a child turns spare after this",
      "More than I. Longer keeps robots in the tree that are not needed.", "protocol 3", 1.0F, 6000.0F},
      &TreeParams::connector_rounds},
    {{"centroid_margin", "", "C", "a better root is nearer to the centroid by more than this",
      "Raise it if the root moves to and fro with noisy ranges.", "protocol 8", 0.0F, 5.0F},
      &TreeParams::centroid_margin},
    {{"arrival_distance", "", "C",
      "a worker's pull fades in proportion within this; the mission's target tolerance unless set",
      "Leave it to the mission.", "protocol 5", 0.005F, 5.0F}, &TreeParams::arrival_distance},
    {{"call_after_rounds", "", "rounds", "a need unanswered for this long calls spares from afar",
      "Shorter brings spares sooner, and more of them than the edge takes; longer where the radio loses many packets.",
      "protocol 7", 1.0F, 6000.0F}, &TreeParams::call_after_rounds},
};
// clang-format on

}  // namespace

std::span<const Parameter<TreeParams>> tree_parameters() noexcept { return of_tree; }

std::string_view tree_fault(const TreeParams& params) noexcept {
  if (!(params.avoidance_range < params.recruitment_distance))
    return "avoidance_range (A) must be below recruitment_distance (E), else an edge's ends would push away the spare "
           "that "
           "it asks for";
  if (!(params.recruitment_distance < params.safe_range))
    return "recruitment_distance (E) must be below safe_range (S), else an edge would stop growing before it asks for "
           "a "
           "spare";
  if (!(params.safe_range < params.ideal_distance))
    return "safe_range (S) must be below ideal_distance (delta), else a robot would still move away from its parent "
           "where "
           "the edge is in danger";
  if (!(params.ideal_distance <= 1.0F))
    return "ideal_distance (delta) must not exceed the radio range, 1 C: beyond it robots do not hear each other";
  return {};
}

}  // namespace banyan
