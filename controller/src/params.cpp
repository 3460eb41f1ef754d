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
