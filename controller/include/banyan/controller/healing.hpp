// SPDX-License-Identifier: MIT
// Healing (protocol 12): any robot may die at any moment, the root included, and nobody is told. The
// root and the workers count ticks, everybody passes on the largest counts heard, and where the root
// and the targets are: whoever falls silent is replaced by somebody who knows what to do.
#pragma once

#include "banyan/controller/controller.hpp"
#include "banyan/controller/robot.hpp"

namespace banyan {

// ---- loss.cpp: how long a neighbour may be silent ----

// Estimates the share of packets that are lost from those heard the tick before, and makes I so long
// that a living neighbour is silent for it once in 10^5 times.
void estimate_loss(Robot& robot) noexcept;

// ---- heartbeat.cpp: is there a root, and where? ----

void follow_heartbeat(Robot& robot) noexcept;
// Near to where the root fell silent: makes itself root and opens an epoch.
void claim_root(Robot& robot) noexcept;

// ---- succession.cpp: does every target have its worker? ----

// Learns of targets and their workers, gives up a target that is served by somebody with precedence,
// takes over one whose worker has fallen silent.
void mind_tasks(Robot& robot) noexcept;
// By its first worker; null if I know of no such target.
[[nodiscard]] Task* find_task(State& self, RobotId serves) noexcept;

// ---- stub.cpp: the end of a torn branch ----

// Notes that the only robot that hung on this connector has fallen silent for good. It stays in the
// tree and goes where that one was, as a worker would, to meet whoever hung on it.
void mind_stub(Robot& robot) noexcept;
[[nodiscard]] bool is_stub(const Robot& robot) noexcept;

// ---- retreat.cpp: back to where the others must be ----

// A worker whose edge has waited in vain for a spare: the branch that it hangs on does not reach. It
// drives home, hangs itself on whoever is nearest to the root, and sets out anew from there.
[[nodiscard]] bool is_regrouping(const Robot& robot) noexcept;
// The ticks that its edge has waited, or would have while it is on its way.
void count_waiting(Robot& robot, bool unserved) noexcept;
// No root has been heard of for long.
[[nodiscard]] bool is_retreating(const Robot& robot) noexcept;
// Towards where the root was, in units of speed_gain.
[[nodiscard]] Vec2 retreat_motion(const Robot& robot) noexcept;

// ---- What of it is broadcast ----

// The counts, and in turn what one neighbour is to know of root and targets.
void tell(const Robot& robot, Message& message) noexcept;

}  // namespace banyan
