// SPDX-License-Identifier: MIT
// Fiedler control: robots estimate the algebraic connectivity lambda_2 of the network and the eigenvector that belongs
// to it by power iteration, and move up its gradient (Yang et al. 2010, Sabattini et al. 2013). docs/rivals.md has the
// equations and what the papers leave open.
#pragma once

#include <span>

#include "banyan/controller/core/output.hpp"
#include "banyan/rivals/fiedler/params.hpp"
#include "banyan/rivals/fiedler/state.hpp"

namespace banyan::rivals::fiedler {

struct Heard {
  const Message* message;
  Vec2 position;
  float age_s = 0.0F;
};

[[nodiscard]] State initial_state(RobotId id, bool worker, bool root) noexcept;
[[nodiscard]] Output<Message> step(const Params& params, State& state, std::span<Heard> heard, const Senses& sensed) noexcept;
[[nodiscard]] Report report(const State& state) noexcept;
void add_to(Digest& digest, const State& state) noexcept;

// Where a robot would go for a larger lambda_2: (5) of docs/rivals.md. In its own frame, in 1 / m.
[[nodiscard]] Vec2 connectivity_gradient(const Params& params, const State& state) noexcept;

// For core/swarm_of.hpp.
struct Robots {
  using Params = fiedler::Params;
  using State = fiedler::State;
  using Message = fiedler::Message;
  using Heard = fiedler::Heard;
  static State initial(RobotId id, bool worker, bool root) { return initial_state(id, worker, root); }
  static Output<Message> step(const Params& p, State& s, std::span<Heard> heard, const Senses& senses) { return fiedler::step(p, s, heard, senses); }
  static Report report(const State& s) { return fiedler::report(s); }
  static void add_to(Digest& digest, const State& s) { fiedler::add_to(digest, s); }
};

}  // namespace banyan::rivals::fiedler
