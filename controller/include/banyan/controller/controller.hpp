// SPDX-License-Identifier: MIT
// The robot's program: one pure function per tick. Start reading here; controller.cpp strings the
// rooms together in the order of the paper's Fig. 1. Comments say "protocol N" for section N of
// docs/protocol.md, and "paper Sec. N" or "Alg. N" for the paper itself.
#pragma once

#include <span>

#include "banyan/controller/message.hpp"
#include "banyan/controller/params.hpp"
#include "banyan/controller/policy.hpp"
#include "banyan/controller/state.hpp"

namespace banyan {

// What the motors shall do until the next step, in the body frame. A differential robot is never
// given `sideways_m_s`; its two wheels never exceed Params::wheel_limit_m_s.
struct Velocity {
  float forward_m_s = 0.0F;
  float sideways_m_s = 0.0F;
  float turn_rad_s = 0.0F;
};

struct Output {
  Message message;  // to broadcast
  Velocity velocity;
};

// A robot before its first step. Exactly one robot of a swarm starts as root; workers must be
// told so because they alone get a target vector (paper Sec. III-B assigns both beforehand).
[[nodiscard]] State initial_state(RobotId id, bool worker, bool root) noexcept;

// One tick. `heard`: every packet received since the last step, any order, duplicates allowed
// (the last counts). `target`: from me to my target in my body frame, m; null unless a worker.
// `obstacles`: the nearest point of each obstacle within reach of the proximity sensor, body frame, m.
// Changes `state` only; allocates nothing; same arguments, same result on every machine.
[[nodiscard]] Output step(const Params& params, const Policy& policy, State& state, std::span<const Heard> heard,
                          const Odometry& odometry, const Vec2* target, std::span<const Vec2> obstacles = {}) noexcept;

}  // namespace banyan
