// SPDX-License-Identifier: MIT
// What all baselines share: the arguments of a step, how a step begins, and how a Swarm finds their functions.
// What the step does is their own.
#pragma once

#include <span>

#include "banyan/baselines/common/params.hpp"
#include "banyan/controller/core/digest.hpp"
#include "banyan/controller/core/gate.hpp"
#include "banyan/controller/core/output.hpp"
#include "banyan/controller/core/report.hpp"

namespace banyan {
class Algorithm;  // controller/core/algorithm.hpp; a robot needs none
}

namespace banyan::baselines {

template <class Message> struct HeardOf {
  const Message* message;
  Vec2 position;
  float age_s = 0.0F;
};

// The beginning of a step: packets are filed and orders are followed.
// Those of which `ties(id)` is true stay in a full table.
template <class State, class Message, class Ties>
void begin_step(const BaselineParams& params, State& state, const Inputs<HeardOf<Message>>& inputs,
                const Ties& ties) noexcept {
  state.tally.rejected += inputs.rejected();
  const Carry carry = inputs.carry();
  state.neighbors.renew(state.id, inputs.heard(), carry, inputs.elapsed_ticks(), whole(params.liveness_rounds), params,
                        ties);
  state.assignment.follow(inputs.orders(), carry);
}

// The State with which a robot begins, so far as it is the same for all baselines.
template <class State> [[nodiscard]] State state_at_start(RobotId id, bool worker, bool root) noexcept {
  State state;
  state.id = id;
  state.assignment.sent = worker;
  if (root) state.root = id;
  return state;
}

// What all baselines report. One that keeps no links has no more to say; the others add their parent and links.
template <class State> [[nodiscard]] Report report_without_links(const State& s) noexcept {
  return {.role = s.assignment.sent ? Role::worker
                  : s.root == s.id  ? Role::root
                                    : Role::connector,
          .serves = s.assignment.sent ? s.id : nobody,
          .root = s.root,
          .want = s.assignment.away(),
          .tally = s.tally};
}

// The four functions of an algorithm, for core/swarm_of.hpp.
template <class P, class S, class M, auto initial_state, auto step_of, auto report_of, auto add> struct RobotsOf {
  using Params = P;
  using State = S;
  using Message = M;
  using Heard = HeardOf<M>;
  static State initial(RobotId id, bool worker, bool root) { return initial_state(id, worker, root); }
  static Output<Message> step(const Params& params, State& state, const Inputs<Heard>& inputs) {
    return step_of(params, state, inputs);
  }
  static Report report(const State& state) { return report_of(state); }
  static void add_to(Digest& digest, const State& state) { add(digest, state); }
};

}  // namespace banyan::baselines
