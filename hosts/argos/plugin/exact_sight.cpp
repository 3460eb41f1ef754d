// SPDX-License-Identifier: MIT
#include "exact_sight.hpp"

#include <argos3/core/simulator/entity/composable_entity.h>
#include <argos3/core/simulator/entity/embodied_entity.h>
#include <argos3/core/simulator/physics_engine/physics_engine.h>
#include <argos3/core/simulator/space/space.h>

#include <algorithm>
#include <string_view>

#include "banyan/world/names.hpp"
#include "simulator.hpp"

namespace banyan::argos {

using namespace ::argos;

void ExactSight::Init(TConfigurationNode& node) {
  constexpr std::string_view known[] = {"id", "drop_m", "index", "grid_size"};
  for (const Attribute& attribute : attributes_of_node(node))
    if (std::find(std::begin(known), std::end(known), attribute.name) == std::end(known))
      THROW_ARGOSEXCEPTION(place_in_experiment(node) << ": <banyan_exact_range_and_bearing>: " << attribute.name
                                                     << " is unknown; allowed: " << world::alternatives(known));
  CRABMedium::Init(node);
  GetNodeAttributeOrDefault(node, "drop_m", drop_m_, drop_m_);
  if (!(drop_m_ > 0.0 && drop_m_ < 0.05))
    THROW_ARGOSEXCEPTION(place_in_experiment(node) << ": drop_m must be above 0 and below 0.05, not " << drop_m_);
}

// Whether nothing but the two bodies is on the line.
bool ExactSight::sees(const CRABEquippedEntity& one, const CRABEquippedEntity& other) const {
  const CVector3 drop(0.0, 0.0, drop_m_);
  const CRay3 line(one.GetPosition() - drop, other.GetPosition() - drop);
  SEmbodiedEntityIntersectionItem nearest;
  auto& body = const_cast<CRABEquippedEntity&>(one).GetEntityBody();
  return !GetClosestEmbodiedEntityIntersectedByRay(nearest, line, body) ||
         nearest.IntersectedEntity == &const_cast<CRABEquippedEntity&>(other).GetEntityBody();
}

void ExactSight::Update() {
  robots_.clear();
  for (auto& [index, heard] : m_tRoutingTable) {
    heard.clear();
    robots_.push_back(dynamic_cast<CRABEquippedEntity*>(GetSpace().GetEntityVector()[static_cast<std::size_t>(index)]));
  }
  std::sort(robots_.begin(), robots_.end(), [](const auto* a, const auto* b) { return a->GetIndex() < b->GetIndex(); });
  for (std::size_t a = 0; a < robots_.size(); ++a) {
    for (std::size_t b = a + 1; b < robots_.size(); ++b) {
      CRABEquippedEntity &one = *robots_[a], &other = *robots_[b];
      const double distance_m = Distance(one.GetPosition(), other.GetPosition());
      if (distance_m >= std::max(one.GetRange(), other.GetRange()) || one.GetMsgSize() != other.GetMsgSize() ||
          !sees(one, other))
        continue;
      if (distance_m < other.GetRange()) m_tRoutingTable[one.GetIndex()].insert(&other);
      if (distance_m < one.GetRange()) m_tRoutingTable[other.GetIndex()].insert(&one);
    }
  }
}

}  // namespace banyan::argos

using BanyanExactSight = banyan::argos::ExactSight;
REGISTER_MEDIUM(BanyanExactSight, "banyan_exact_range_and_bearing", "the authors of Banyan", "1.0",
                "Range and bearing whose lines of sight are exact.",
                "As range_and_bearing with check_occlusions, but lines of sight run a little below the\n"
                "antennas (drop_m, default 0.005), so that a body as high as the antennas blocks them\n"
                "always, not now and then, and runs repeat.\n\n"
                "<banyan_exact_range_and_bearing id=\"rab\" />",
                "Usable")
