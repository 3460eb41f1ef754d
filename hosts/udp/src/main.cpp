// SPDX-License-Identifier: MIT
// banyan-robot: one robot of a fleet. The program of a robot's computer; needs libsodium, CLI11 and nothing else of
// ours but the controller.
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/controller/core/printable.hpp"
#include "banyan/hosts/udp/robot_process.hpp"

int main(int argc, char** argv) {
  using namespace banyan::udp;
  constexpr int bad_usage = 2, failed = 1;
  try {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    for (const std::string& argument : arguments) {
      if (argument != "--help" && argument != "-h") continue;
      std::fputs(robot_usage().c_str(), stdout);
      return 0;
    }
    return run_robot(parse_robot_options(arguments), banyan::algorithms());
  } catch (const OptionError& error) {
    std::fprintf(stderr, "banyan-robot: %s\n", banyan::printable_lines(error.what()).c_str());
    return bad_usage;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "banyan-robot: %s\n", banyan::printable_lines(error.what()).c_str());
    return failed;
  }
}
