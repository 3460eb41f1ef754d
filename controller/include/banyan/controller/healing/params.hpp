// SPDX-License-Identifier: MIT
// What a designer sets about healing after deaths.
#pragma once

#include "banyan/controller/tree/params.hpp"

namespace banyan {

struct HealingParams : TreeParams {
  float healing = 1.0F;                    // 0: dead robots are not replaced
  float claim_radius = 0.45F;              // a robot nearer than this to where the root fell silent may become root
  float claim_after_rounds = 5.0F;         // without heartbeat, beyond 2 I
  float claim_spread_rounds = 20.0F;       // additional silence per C from that place, so that one robot claims first
  float retreat_after_rounds = 25.0F;      // without heartbeat, beyond 2 I: all drive to where the root was
  float succession_after_rounds = 30.0F;   // without a sign of a target's worker, beyond 2 I
  float succession_spread_rounds = 10.0F;  // additional silence per C from the target
  float pursue_for_drives = 1.2F;          // a connector whose last child fell silent looks for it
  float regroup_after_drives = 4.0F;       // a worker waits this long for a spare, then drives home and sets out anew
  float give_up_after_drives = 1.0F;       // a worker that drives this long in vain leaves its target to others
  float largest_loss = 0.9F;               // liveness adapts to the share of packets lost, up to this

  [[nodiscard]] bool heals() const noexcept { return healing > 0.5F; }
};

// Near obstacles a worker gives up after so many times give_up_after_drives: the way round may be long, and the target
// may drive away.
inline constexpr int patience_hindered = 18;

[[nodiscard]] std::span<const Parameter<HealingParams>> healing_parameters() noexcept;

// Besides tree_fault(): there may be parents, robots that may become root hear each other, and what a worker drives in
// vain near obstacles can be counted in 16 bits.
[[nodiscard]] std::string_view healing_fault(const HealingParams& params) noexcept;

}  // namespace banyan
