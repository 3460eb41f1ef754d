// SPDX-License-Identifier: MIT
// MST preservation: a minimum spanning tree of the radio graph, found by the robots themselves, is kept, and built anew
// when one of its edges gets long (Aragues et al. 2014, Soleymani et al. 2015). docs/rivals.md has the equations and
// what the papers leave open.
#pragma once

#include <span>

#include "banyan/controller/core/output.hpp"
#include "banyan/rivals/mst/params.hpp"
#include "banyan/rivals/mst/state.hpp"

namespace banyan::rivals::mst {

struct Heard {
  const Message* message;
  Vec2 position;
  float age_s = 0.0F;
};

[[nodiscard]] State initial_state(RobotId id, bool worker, bool root) noexcept;
[[nodiscard]] Output<Message> step(const Params& params, State& state, std::span<Heard> heard, const Senses& sensed) noexcept;
[[nodiscard]] Report report(const State& state) noexcept;
void add_to(Digest& digest, const State& state) noexcept;

// For core/swarm_of.hpp.
struct Robots {
  using Params = mst::Params;
  using State = mst::State;
  using Message = mst::Message;
  using Heard = mst::Heard;
  static State initial(RobotId id, bool worker, bool root) { return initial_state(id, worker, root); }
  static Output<Message> step(const Params& p, State& s, std::span<Heard> heard, const Senses& senses) { return mst::step(p, s, heard, senses); }
  static Report report(const State& s) { return mst::report(s); }
  static void add_to(Digest& digest, const State& s) { mst::add_to(digest, s); }
};

}  // namespace banyan::rivals::mst
