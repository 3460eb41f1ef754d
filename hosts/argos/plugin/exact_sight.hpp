// SPDX-License-Identifier: MIT
// A range-and-bearing medium whose lines of sight are those of geometry. ARGoS' own looks from antenna to antenna; that
// of the Khepera IV stands exactly on top of the bodies that block it, so rounding decides (docs/argos.md). Here the
// line is a little lower. A pair is also tested once, from the robot that was made first, so runs repeat.
//
//   <banyan_exact_range_and_bearing id="rab" drop_m="0.005" />
#pragma once

#include <argos3/plugins/simulator/media/rab_medium.h>

#include <vector>

namespace banyan::argos {

class ExactSight final : public ::argos::CRABMedium {
 public:
  void Init(::argos::TConfigurationNode& node) override;
  void Update() override;

 private:
  [[nodiscard]] bool sees(const ::argos::CRABEquippedEntity& one, const ::argos::CRABEquippedEntity& other) const;

  double drop_m_ = 0.005;
  std::vector<::argos::CRABEquippedEntity*> robots_;
};

}  // namespace banyan::argos
