// SPDX-License-Identifier: MIT
// The paper's two algorithms, each as printed and as corrected: one tick of one robot. Begin with step.cpp.
#pragma once

#include "banyan/controller/core/output.hpp"
#include "banyan/controller/paper/corrections.hpp"

namespace banyan::paper {

// `inputs`: every packet received since the last step, in any order, duplicates allowed (the last counts); what they
// are in is worked on. Changes `state` only; allocates nothing; same arguments, same result on every machine.
[[nodiscard]] Output<Message> step(const Growth& growth, const Reading& reading, const Params& params, State& state,
                                   const Inputs<Heard>& inputs) noexcept;

// What core/swarm_of.hpp wants to know of an algorithm.
template <const Growth& growth, const Reading& reading> struct Of {
  using Params = paper::Params;
  using State = paper::State;
  using Message = paper::Message;
  using Heard = paper::Heard;
  static State initial(RobotId id, bool worker, bool root) noexcept { return paper::initial(id, worker, root); }
  static Output<Message> step(const Params& params, State& state, const Inputs<Heard>& inputs) noexcept {
    return paper::step(growth, reading, params, state, inputs);
  }
  static Report report(const State& state) noexcept { return paper::report(state); }
  static void add_to(Digest& digest, const State& state) noexcept { paper::add_to(digest, state); }
};

}  // namespace banyan::paper
