// SPDX-License-Identifier: MIT
// What a robot of convoy broadcasts in addition (docs/convoy.md).
#pragma once

#include "banyan/controller/healing/message.hpp"
#include "banyan/controller/obstacles/state.hpp"
#include "banyan/controller/power/message.hpp"

namespace banyan {

struct ConvoyStanding {
  std::uint8_t child_count = 0;  // living children that are not spares
  RobotId below = nobody;        // the only worker below me, by its target; nobody: there are branches.
                                 // Of a spare: the robot that it accompanies (convoy/companions.hpp)

  friend bool operator==(const ConvoyStanding&, const ConvoyStanding&) = default;
};

struct ConvoyNews {
  RobotId warned = nobody;     // the child whose line of sight to me is about to be cut, perhaps unseen by it
  RobotId above = nobody;      // the next worker above me in the tree, by its target (plan.cpp)
  RobotId task_host = nobody;  // the root's plan: at which target the branch of `task` is to begin; nobody: none

  friend bool operator==(const ConvoyNews&, const ConvoyNews&) = default;
};

struct ConvoyMessage : HealingMessage, CornerStanding, ConvoyStanding, ConvoyNews {
  static constexpr std::uint8_t blocks = HealingMessage::blocks | block::obstacles | block::convoy;
  friend bool operator==(const ConvoyMessage&, const ConvoyMessage&) = default;
};

// Of robots with batteries.
struct PoweredConvoyMessage : ConvoyMessage, PowerStanding {
  static constexpr std::uint8_t further_blocks = block::power;
  friend bool operator==(const PoweredConvoyMessage&, const PoweredConvoyMessage&) = default;
};

// The convoy block, field by field (wire.hpp).
template <class Visitor, class M> constexpr void visit_convoy_block(Visitor& visit, M& m) noexcept {
  visit.robot("warned", "the child whose line of sight to the sender is about to be cut, -1: nobody", m.warned);
  visit.robot("task_host", "at which target the branch of `task` is to begin, -1: no plan", m.task_host);
  visit.number("child_count", "living children that are not spares", m.child_count);
  visit.robot("above", "next worker above in the tree, by its target, -1: none", m.above);
  visit.robot("below",
              "the only worker below, by its target, -1: none or branches; of a spare, the robot that it accompanies",
              m.below);
}

template <class Visitor> constexpr void visit_fields(Visitor& visit, ConvoyMessage& m) noexcept {
  visit_fields(visit, static_cast<HealingMessage&>(m)), visit_corner_block(visit, m), visit_convoy_block(visit, m);
}
template <class Visitor> constexpr void visit_fields(Visitor& visit, const ConvoyMessage& m) noexcept {
  visit_fields(visit, static_cast<const HealingMessage&>(m)), visit_corner_block(visit, m),
      visit_convoy_block(visit, m);
}
template <class Visitor> constexpr void visit_fields(Visitor& visit, PoweredConvoyMessage& m) noexcept {
  visit_fields(visit, static_cast<ConvoyMessage&>(m)), visit_power_block(visit, m);
}
template <class Visitor> constexpr void visit_fields(Visitor& visit, const PoweredConvoyMessage& m) noexcept {
  visit_fields(visit, static_cast<const ConvoyMessage&>(m)), visit_power_block(visit, m);
}

}  // namespace banyan
