// SPDX-License-Identifier: MIT
// banyan-robot: a Robot with a socket, a clock and a base, until it is stopped.
#pragma once

#include "banyan/controller/core/algorithm.hpp"
#include "banyan/hosts/udp/robot_options.hpp"

namespace banyan::udp {

// Returns the exit code: 0 if the hub stopped it, 1 if its base went away, 128 + n after signal n. Whichever it was,
// the base has been told to stand still. Throws OptionError, KeyError, SocketError and BaseError before it starts.
[[nodiscard]] int run_robot(const RobotOptions& options, const AlgorithmList& algorithms);

}  // namespace banyan::udp
