// SPDX-License-Identifier: MIT
// What a swarm of each algorithm is made of (core/swarm_of.hpp).
#pragma once

#include "banyan/controller/convoy/convoy.hpp"
#include "banyan/controller/core/swarm_of.hpp"
#include "banyan/controller/healing/tick.hpp"
#include "banyan/controller/inwards.hpp"
#include "banyan/controller/outwards.hpp"

namespace banyan {

template <auto step_function>
struct LiteralSwarm {
  using Params = TreeParams;
  using State = TreeState;
  using Message = TreeMessage;
  using Heard = banyan::Heard;
  static State initial(RobotId id, bool worker, bool root) { return initial_tree_state(id, worker, root); }
  static auto step(const Params& p, State& s, std::span<Heard> heard, const Senses& senses) { return step_function(p, s, heard, senses); }
  static Report report(const State& s) { return tree_report(s); }
  static void add_to(Digest& digest, const State& s) { banyan::add_to(digest, s); }
};

template <auto step_function>
struct CorrectedSwarm {
  using Params = HealingParams;
  using State = HealingState;
  using Message = HealingMessage;
  using Heard = banyan::Heard;
  static State initial(RobotId id, bool worker, bool root) { return initial_healing_state(id, worker, root); }
  static auto step(const Params& p, State& s, std::span<Heard> heard, const Senses& senses) { return step_function(p, s, heard, senses); }
  static Report report(const State& s) { return healing_report(s); }
  static void add_to(Digest& digest, const State& s) { banyan::add_to(digest, s); }
};

struct ConvoySwarm {
  using Params = ConvoyParams;
  using State = ConvoyState;
  using Message = ConvoyMessage;
  using Heard = banyan::Heard;
  static State initial(RobotId id, bool worker, bool root) { return initial_convoy_state(id, worker, root); }
  static auto step(const Params& p, State& s, std::span<Heard> heard, const Senses& senses) { return convoy_step(p, s, heard, senses); }
  static Report report(const State& s) { return convoy_report(s); }
  static void add_to(Digest& digest, const State& s) { banyan::add_to(digest, s); }
};

struct PoweredConvoySwarm {
  using Params = ConvoyParams;
  using State = PoweredConvoyState;
  using Message = PoweredConvoyMessage;
  using Heard = banyan::Heard;
  static State initial(RobotId id, bool worker, bool root) {
    State state;
    static_cast<ConvoyState&>(state) = initial_convoy_state(id, worker, root);
    return state;
  }
  static auto step(const Params& p, State& s, std::span<Heard> heard, const Senses& senses) { return powered_convoy_step(p, s, heard, senses); }
  static Report report(const State& s) { return powered_report(s); }
  static void add_to(Digest& digest, const State& s) { banyan::add_to(digest, s); }
};

}  // namespace banyan
