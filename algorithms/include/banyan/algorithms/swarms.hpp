// SPDX-License-Identifier: MIT
// What a swarm of each algorithm is made of (core/swarm_of.hpp).
#pragma once

#include "banyan/controller/caravan/caravan.hpp"
#include "banyan/controller/convoy/convoy.hpp"
#include "banyan/controller/core/swarm_of.hpp"
#include "banyan/controller/paper/paper.hpp"

namespace banyan {

// How SwarmOf finds the functions of an algorithm of the tree.
template <class Params_, class State_, class Message_, auto initial_state, auto step_function, auto report_of>
struct TreeSwarm {
  using Params = Params_;
  using State = State_;
  using Message = Message_;
  using Heard = banyan::Heard;
  static State initial(RobotId id, bool worker, bool root) { return initial_state(id, worker, root); }
  static auto step(const Params& p, State& s, const Inputs<Heard>& inputs) { return step_function(p, s, inputs); }
  static Report report(const State& s) { return report_of(s); }
  static void add_to(Digest& digest, const State& s) { banyan::add_to(digest, s); }
};

// One of the paper's.
template <const paper::Growth& growth, const paper::Reading& reading> struct PaperSwarm {
  using Params = paper::Params;
  using State = paper::State;
  using Message = paper::Message;
  using Heard = paper::Heard;
  static State initial(RobotId id, bool worker, bool root) { return paper::initial(id, worker, root); }
  static auto step(const Params& params, State& state, const Inputs<Heard>& inputs) {
    return paper::step(growth, reading, params, state, inputs);
  }
  static Report report(const State& state) { return paper::report(state); }
  static void add_to(Digest& digest, const State& state) { paper::add_to(digest, state); }
};

struct CaravanSwarm {
  using Params = caravan::Params;
  using State = caravan::State;
  using Message = caravan::Message;
  using Heard = caravan::Heard;
  static State initial(RobotId id, bool worker, bool root) { return caravan::initial(id, worker, root); }
  static auto step(const Params& params, State& state, const Inputs<Heard>& inputs) {
    return caravan::step(params, state, inputs);
  }
  static Report report(const State& state) { return caravan::report(state); }
  static void add_to(Digest& digest, const State& state) { caravan::add_to(digest, state); }
};

using ConvoySwarm =
    TreeSwarm<ConvoyParams, ConvoyState, ConvoyMessage, initial_convoy_state, convoy_step, convoy_report>;
using PoweredConvoySwarm = TreeSwarm<ConvoyParams, PoweredConvoyState, PoweredConvoyMessage, initial_powered_state,
                                     powered_convoy_step, powered_report>;

}  // namespace banyan
