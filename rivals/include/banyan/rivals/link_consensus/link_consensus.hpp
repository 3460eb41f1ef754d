// SPDX-License-Identifier: MIT
// Link consensus: robots keep links, motion obeys the links that are kept, and a link is given up only when its two
// ends agree that a path of kept links remains (Zavlanos & Pappas 2008, Michael et al. 2009; local choice of links as
// Cornejo et al. 2009). docs/rivals.md has the equations and what the papers leave open.
#pragma once

#include <span>

#include "banyan/controller/core/output.hpp"
#include "banyan/rivals/link_consensus/params.hpp"
#include "banyan/rivals/link_consensus/state.hpp"

namespace banyan::rivals::link_consensus {

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
  using Params = link_consensus::Params;
  using State = link_consensus::State;
  using Message = link_consensus::Message;
  using Heard = link_consensus::Heard;
  static State initial(RobotId id, bool worker, bool root) { return initial_state(id, worker, root); }
  static Output<Message> step(const Params& p, State& s, std::span<Heard> heard, const Senses& senses) { return link_consensus::step(p, s, heard, senses); }
  static Report report(const State& s) { return link_consensus::report(s); }
  static void add_to(Digest& digest, const State& s) { link_consensus::add_to(digest, s); }
};

}  // namespace banyan::rivals::link_consensus
