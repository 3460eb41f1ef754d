// SPDX-License-Identifier: MIT
// A swarm of one robot that says what a test wants it to say.
#pragma once

#include <memory>
#include <span>

#include "banyan/controller/core/output.hpp"
#include "banyan/controller/core/platform.hpp"
#include "banyan/controller/core/swarm_of.hpp"

namespace banyan::record::test {

template <class SomeMessage> struct Saying {
  struct Params : Machine {
    SomeMessage words;
  };
  struct State {
    RobotId id;
  };
  using Message = SomeMessage;
  struct Heard {
    const Message* message;
    banyan::Vec2 position;
    float age_s;
  };
  struct Member {
    RobotId id = 0;
    bool worker = false;
    bool root = true;
  };
  static State initial(RobotId id, bool, bool) { return {id}; }
  static Output<Message> step(const Params& params, State&, const Inputs<Heard>&) { return {params.words, {}}; }
  static Report report(const State&) { return {}; }
  static void add_to(Digest& digest, const State& state) { digest.add(state.id); }
};

template <class Message> std::unique_ptr<Swarm> saying(const Message& words) {
  using Speaker = Saying<Message>;
  typename Speaker::Params params;
  params.words = words;
  auto swarm = std::make_unique<SwarmOf<Speaker>>(params, Platform{}, std::vector<typename Speaker::Member>(1), 1);
  const Sensed nothing;
  Velocity command;
  Report report;
  swarm->step(0, {&nothing, 1}, {&command, 1}, {&report, 1});
  swarm->advance();
  return swarm;
}

}  // namespace banyan::record::test
