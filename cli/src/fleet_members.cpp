// SPDX-License-Identifier: MIT
#include "fleet_members.hpp"

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/hosts/udp/envelope.hpp"
#include "banyan/hosts/udp/fleet.hpp"
#include "banyan/hosts/udp/journal.hpp"
#include "banyan/hosts/udp/key.hpp"
#include "banyan/hosts/udp/option_error.hpp"
#include "banyan/hosts/udp/socket.hpp"
#include "shipped.hpp"
#include "terminal.hpp"

namespace banyan::cli {

config::Configuration load_fleet(const std::string& scenario, const std::vector<config::Override>& overrides) {
  auto loaded = config::load_configuration(itself_or_shipped(scenario, "scenarios"), algorithms(), overrides);
  print_problems(loaded.problems);
  if (!loaded.ok()) throw CommandError(exit_usage, "nothing was started");
  if (loaded.configuration.scenario.clocks.asynchronous)
    complain("clocks.asynchronous is left out: these robots have clocks of their own");
  if (loaded.configuration.scenario.battery.on())
    throw CommandError(exit_usage,
                       "battery: nobody tells a robot that is a process its charge yet; nothing was started");
  if (const std::size_t robots = world::robot_count(loaded.configuration.scenario); robots > udp::most_fleet_robots)
    throw CommandError(exit_usage, "swarm.robots: is " + std::to_string(robots) + "; a fleet has at most " +
                                       std::to_string(udp::most_fleet_robots) + "; nothing was started");
  loaded.configuration.scenario.clocks = {};
  return loaded.configuration;
}

udp::Roster roster_of(const std::string& names, std::size_t room, const world::Scenario& scenario) {
  const std::size_t robots = world::robot_count(scenario);
  if (names.empty()) return udp::Roster(robots, room);
  udp::Roster roster(names, room);
  if (roster.size() != robots)
    throw CommandError(exit_usage, "--names has " + plural(roster.size(), "name") + ", the scenario " +
                                       plural(robots, "robot") +
                                       "; change the names or --set swarm.robots=" + std::to_string(roster.size()));
  return roster;
}

udp::RobotOptions robot_options(const world::Scenario& scenario, udp::NodeId id) {
  udp::RobotOptions options;
  options.id = id;
  options.algorithm = scenario.mission.algorithm;
  options.setup = world::setup_of(scenario);
  options.setup.history = 1;  // of packets that the robot itself delays
  return options;
}

int with_fleet_errors(const std::function<int()>& command) {
  try {
    return command();
  } catch (const udp::KeyError& error) {
    throw CommandError(exit_usage, error.what());
  } catch (const udp::OptionError& error) {
    throw CommandError(exit_usage, error.what());
  } catch (const udp::SocketError& error) {
    throw CommandError(exit_lost, error.what());
  } catch (const udp::HubJournalError& error) {
    throw CommandError(exit_lost, error.what());
  } catch (const udp::FleetError& error) { throw CommandError(exit_lost, error.what()); }
}

}  // namespace banyan::cli
