// SPDX-License-Identifier: MIT
// What a scenario means for the processes that play it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "banyan/config/config.hpp"
#include "banyan/hosts/udp/robot_options.hpp"
#include "banyan/hosts/udp/roster.hpp"

namespace banyan::cli {

// The configuration of a fleet: its robots have real clocks, so simulated ones are left out, with a warning.
[[nodiscard]] config::Configuration load_fleet(const std::string& scenario,
                                               const std::vector<config::Override>& overrides);

// Of --names, "": ids from 0; as many as the scenario's robots, and room for more.
[[nodiscard]] udp::Roster roster_of(const std::string& names, std::size_t room, const world::Scenario& scenario);

// The options of the robot with that id, without hub and key.
[[nodiscard]] udp::RobotOptions robot_options(const world::Scenario& scenario, udp::NodeId id);

// From here on what can go wrong with keys, sockets and processes is a CommandError.
int with_fleet_errors(const std::function<int()>& command);

}  // namespace banyan::cli
