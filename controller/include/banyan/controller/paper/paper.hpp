// SPDX-License-Identifier: MIT
// The paper's two algorithms, each as printed and as corrected.
#pragma once

#include "banyan/controller/core/digest.hpp"
#include "banyan/controller/core/gate.hpp"
#include "banyan/controller/core/output.hpp"
#include "banyan/controller/paper/params.hpp"
#include "banyan/controller/paper/state.hpp"

namespace banyan::paper {

struct Growth;  // how the tree grows
extern const Growth outwards;
extern const Growth inwards;
struct Reading;  // how the paper is read: as printed, or as corrected
extern const Reading literal;
extern const Reading corrected;

[[nodiscard]] State initial(RobotId id, bool worker, bool root) noexcept;
// `inputs`: every packet received since the last step, in any order, duplicates allowed (the last counts); what they
// are in is worked on. Changes `state` only; allocates nothing; same arguments, same result on every machine.
[[nodiscard]] Output<Message> step(const Growth& growth, const Reading& reading, const Params& params, State& state,
                                   const Inputs<Heard>& inputs) noexcept;
[[nodiscard]] Report report(const State& state) noexcept;
void add_to(Digest& digest, const State& state) noexcept;  // every field that can influence a later step

}  // namespace banyan::paper
