// SPDX-License-Identifier: MIT
#include "banyan/controller/params.hpp"

namespace banyan {
namespace {

constexpr ParameterInfo table[] = {
    {"safe_range_m", "S", "m", "beyond it a robot no longer moves away from its parent", "Table I", 0.05F, 100.0F, &Params::safe_range_m},
    {"avoidance_range_m", "A", "m", "robots that are no tree neighbours repel each other within it", "Table I", 0.0F, 100.0F, &Params::avoidance_range_m},
    {"ideal_distance_m", "delta", "m", "ideal length of a tree edge, and the emergency range", "Table I", 0.05F, 100.0F, &Params::ideal_distance_m},
    {"interaction_gain", "epsilon", "", "gain of the force between parent and child", "Table I", 0.0F, 1000.0F, &Params::interaction_gain},
    {"target_gain", "tau", "", "magnitude of the attraction to a target", "Table I", 0.0F, 1.9F, &Params::target_gain},
    {"reconfiguration_period_s", "R", "s", "time between two reconstructions of the tree", "Table I", 1.0F, 3600.0F, &Params::reconfiguration_period_s},
    {"liveness_period_s", "I", "s", "a neighbour not heard for longer is taken as gone", "Table I", 0.1F, 60.0F, &Params::liveness_period_s},
    {"recruitment_distance_m", "E", "m", "a tree edge longer than this asks for a spare", "Table I", 0.01F, 100.0F, &Params::recruitment_distance_m},
    {"insertion_distance_m", "J", "m", "a spare this near to an edge's midpoint joins the edge", "Table I", 0.001F, 10.0F, &Params::insertion_distance_m},
    {"avoidance_gain", "", "", "gain of the repulsion within A", "protocol 9", 0.0F, 100.0F, &Params::avoidance_gain},
    {"parent_margin_m", "", "m", "a parent is chosen at most delta minus this away (corrected)", "protocol 2, row 4", 0.0F, 10.0F, &Params::parent_margin_m},
    {"guard_rate_per_s", "", "1/s", "each end may lengthen an edge at (delta - d)/2 times this (corrected)", "protocol 2, row 4", 0.01F, 10.0F, &Params::guard_rate_per_s},
    {"barrier_timeout_s", "", "s", "START TREE and SELECT PARENT wait no longer", "protocol 4", 0.5F, 600.0F, &Params::barrier_timeout_s},
    {"handover_timeout_s", "", "s", "an offer of the root token unanswered for so long is taken back", "protocol 8", 0.2F, 60.0F, &Params::handover_timeout_s},
    {"insertion_timeout_s", "", "s", "a spare on its way to an edge gives up after this", "protocol 7", 1.0F, 600.0F, &Params::insertion_timeout_s},
    {"connector_patience_s", "", "s", "a connector without child turns spare after this", "protocol 3", 0.1F, 600.0F, &Params::connector_patience_s},
    {"centroid_margin_m", "", "m", "a better root is nearer to the centroid by more than this", "protocol 8", 0.0F, 10.0F, &Params::centroid_margin_m},
    {"arrival_distance_m", "", "m", "a worker's pull fades in proportion within this; the mission's target tolerance unless set", "protocol 9", 0.01F, 10.0F, &Params::arrival_distance_m},
    {"pull_start", "", "C", "convoy: a child farther than this pulls its parent along", "convoy 2", 0.0F, 1.0F, &Params::pull_start},
    {"pull_width", "", "C", "convoy: the pull has full strength so much beyond pull_start", "convoy 2", 0.001F, 1.0F, &Params::pull_width},
    {"tension_gain", "", "", "convoy: tree edges pull like strings with this strength", "convoy 2", 0.0F, 10.0F, &Params::tension_gain},
    {"tension_start", "", "C", "convoy: shorter edges have no tension", "convoy 2", 0.0F, 1.0F, &Params::tension_start},
    {"tension_width", "", "C", "convoy: tension has full strength so much beyond tension_start", "convoy 2", 0.001F, 1.0F, &Params::tension_width},
    {"slack_gain", "", "", "convoy: the edges of a chain share their slack with this strength", "convoy 8", 0.0F, 10.0F, &Params::slack_gain},
    {"first_edge", "", "C", "convoy: parents are chosen this near while there is a choice", "convoy 1", 0.01F, 1.0F, &Params::first_edge},
    {"clearance", "", "C", "convoy: a robot this near to a segment counts as blocking it", "convoy 1", 0.0F, 1.0F, &Params::clearance},
    {"corridor_width", "", "C", "convoy: robots this near to a tree edge move away from it", "convoy 6", 0.0F, 1.0F, &Params::corridor_width},
    {"corridor_gain", "", "", "convoy: strength of moving out of a corridor", "convoy 6", 0.0F, 10.0F, &Params::corridor_gain},
    {"join_margin", "", "C", "convoy: a spare joins an edge if both ends are nearer than delta minus this", "convoy 4", 0.0F, 1.0F, &Params::join_margin},
    {"shortest_split", "", "C", "convoy: edges shorter than this are not split", "convoy 4", 0.0F, 1.0F, &Params::shortest_split},
    {"call_distance", "", "C", "convoy: a longer edge whose need nobody answers calls spares from afar", "convoy 7", 0.0F, 1.0F, &Params::call_distance},
    {"release_distance", "", "C", "convoy: a grandparent nearer than this becomes the parent", "convoy 5", 0.0F, 1.0F, &Params::release_distance},
    {"spare_avoidance", "", "C", "convoy: spares repel within this", "convoy 2", 0.0F, 1.0F, &Params::spare_avoidance},
    {"merge_distance", "", "C", "convoy: longest edge made to save a robot once all below have arrived", "convoy 9", 0.0F, 1.0F, &Params::merge_distance},
    {"compact_distance", "", "C", "convoy: chains that have arrived stretch their edges to this", "convoy 9", 0.0F, 1.0F, &Params::compact_distance},
    {"plan_after_s", "", "s", "convoy: so long after all have arrived chains from target to target are planned; 0: never", "convoy 11", 0.0F, 600.0F, &Params::plan_after_s},
    {"healing", "", "", "1: the living take the place of the dead (corrected); 0: nobody does", "protocol 12", 0.0F, 1.0F, &Params::healing},
    {"claim_radius", "", "C", "healing: who is this near to where the root fell silent may become root", "protocol 12", 0.01F, 10.0F, &Params::claim_radius},
    {"claim_after_s", "", "s", "healing: silence of the root, beyond 2 I, before it is replaced", "protocol 12", 0.0F, 600.0F, &Params::claim_after_s},
    {"claim_spread_s_m", "", "s/m", "healing: and so much longer per metre from where the root was", "protocol 12", 0.0F, 100.0F, &Params::claim_spread_s_m},
    {"retreat_after_s", "", "s", "healing: silence of the root before all drive to where it was", "protocol 12", 0.5F, 600.0F, &Params::retreat_after_s},
    {"succession_after_s", "", "s", "healing: silence of a worker, beyond 2 I, before it is replaced", "protocol 12", 0.0F, 600.0F, &Params::succession_after_s},
    {"succession_spread_s_m", "", "s/m", "healing: and so much longer per metre from its target", "protocol 12", 0.0F, 100.0F, &Params::succession_spread_s_m},
    {"largest_loss", "", "", "healing: I grows with the share of packets lost, up to this share", "protocol 12", 0.0F, 0.99F, &Params::largest_loss},
    {"communication_range_m", "C", "m", "radio range", "protocol 2, row 8", 0.05F, 100.0F, &Params::communication_range_m},
    {"tick_s", "", "s", "control period", "protocol 9", 0.01F, 1.0F, &Params::tick_s},
    {"speed_gain_m_s", "K", "m/s", "speed per unit of the control law", "protocol 2, row 9", 0.001F, 10.0F, &Params::speed_gain_m_s},
    {"wheel_limit_m_s", "", "m/s", "largest speed of a wheel", "protocol 2, row 9", 0.001F, 10.0F, &Params::wheel_limit_m_s},
    {"wheel_distance_m", "", "m", "distance between the wheels", "Khepera IV", 0.01F, 2.0F, &Params::wheel_distance_m},
};

}  // namespace

std::span<const ParameterInfo> parameter_table() noexcept { return table; }

std::string_view fault(const Params& params) noexcept {
  for (const ParameterInfo& info : table) {
    const float value = params.*info.member;
    if (!(value >= info.minimum && value <= info.maximum)) return info.key;  // NaN fails too
  }
  if (!(params.reconfiguration_period_s / params.tick_s < 65535.0F)) return "reconfiguration_period_s (R) must be below 65535 ticks";
  if (!(params.avoidance_range_m < params.recruitment_distance_m)) return "avoidance_range_m (A) must be below recruitment_distance_m (E)";
  if (!(params.recruitment_distance_m < params.safe_range_m)) return "recruitment_distance_m (E) must be below safe_range_m (S)";
  if (!(params.safe_range_m < params.ideal_distance_m)) return "safe_range_m (S) must be below ideal_distance_m (delta)";
  if (!(params.ideal_distance_m <= params.communication_range_m)) return "ideal_distance_m (delta) must not exceed the radio range C";
  return {};
}

}  // namespace banyan
