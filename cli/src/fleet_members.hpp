// SPDX-License-Identifier: MIT
// What a scenario means for the processes that play it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "banyan/config/config.hpp"
#include "banyan/hosts/udp/robot_options.hpp"

namespace banyan::cli {

// The configuration of a fleet: its robots have real clocks, so simulated ones are left out, with a warning.
[[nodiscard]] config::Configuration load_fleet(const std::string& scenario,
                                               const std::vector<config::Override>& overrides);

// The options of robot i, without hub and key.
[[nodiscard]] udp::RobotOptions robot_options(const world::Scenario& scenario, std::size_t i);

// From here on what can go wrong with keys, sockets and processes is a CommandError.
int with_fleet_errors(const std::function<int()>& command);

}  // namespace banyan::cli
