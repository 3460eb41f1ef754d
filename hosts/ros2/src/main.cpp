// SPDX-License-Identifier: MIT
// banyan-ros2: robots and tracker of ROS 2 for banyan hub and banyan-robot, and missions for ROS 2. A program of its
// own, so that nothing else needs DDS.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "banyan/controller/core/printable.hpp"
#include "banyan/hosts/ros2/bridge.hpp"
#include "banyan/hosts/ros2/swarm.hpp"

int main(int argc, char** argv) {
  using namespace banyan;
  constexpr int bad_usage = 2, failed = 1;
  try {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    for (const std::string& argument : arguments) {
      if (argument != "--help" && argument != "-h") continue;
      std::fputs(ros2::usage().c_str(), stdout);
      return 0;
    }
    const ros2::Environment environment = [](const char* name) -> const char* { return std::getenv(name); };
    const ros2::Options options = ros2::parse_options(arguments, environment);
    return options.swarm >= 0 ? ros2::show_swarm(options) : ros2::run_bridge(options);
  } catch (const udp::OptionError& error) {
    std::fprintf(stderr, "banyan-ros2: %s\n", printable_lines(error.what()).c_str());
    return bad_usage;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "banyan-ros2: %s\n", printable_lines(error.what()).c_str());
    return failed;
  }
}
