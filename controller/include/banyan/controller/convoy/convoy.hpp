// SPDX-License-Identifier: MIT
// Convoy (docs/convoy.md), our own: the tree of inwards, but towed by the workers instead of pushed by
// springs. Gaps open near the root, where the spares are, and a spare joins an edge at once.
#pragma once

#include "banyan/controller/convoy/params.hpp"
#include "banyan/controller/convoy/state.hpp"
#include "banyan/controller/core/digest.hpp"
#include "banyan/controller/core/gate.hpp"
#include "banyan/controller/core/output.hpp"

namespace banyan {

// There is only one reading.
[[nodiscard]] ConvoyParams convoy_defaults() noexcept;

[[nodiscard]] ConvoyState initial_convoy_state(RobotId id, bool worker, bool root) noexcept;

// One tick of one robot.
[[nodiscard]] Output<ConvoyMessage> convoy_step(const ConvoyParams& params, ConvoyState& state,
                                                const Inputs<Heard>& inputs) noexcept;

// The same for robots that run on batteries (docs/lasting.md): their messages have one block more.
[[nodiscard]] ConvoyParams with_room_for_relief(ConvoyParams params) noexcept;
[[nodiscard]] PoweredConvoyState initial_powered_state(RobotId id, bool worker, bool root) noexcept;
[[nodiscard]] Output<PoweredConvoyMessage> powered_convoy_step(const ConvoyParams& params, PoweredConvoyState& state,
                                                               const Inputs<Heard>& inputs) noexcept;
[[nodiscard]] Report powered_report(const PoweredConvoyState& state) noexcept;
void add_to(Digest& digest, const PoweredConvoyState& state) noexcept;

[[nodiscard]] Report convoy_report(const ConvoyState& state) noexcept;
void add_to(Digest& digest, const ConvoyState& state) noexcept;
void add_to(Digest& digest, const ConvoyMessage& message) noexcept;

}  // namespace banyan
