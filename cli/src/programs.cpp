// SPDX-License-Identifier: MIT
// `banyan robot` and `banyan ros2`: programs of their own, which this one becomes.
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "commands.hpp"
#include "fleet_members.hpp"
#include "options.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

[[noreturn]] void become(std::string program, std::vector<std::string> arguments) {
  std::vector<char*> words{program.data()};
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  ::execv(program.c_str(), words.data());
  throw CommandError(exit_lost, program + ": " + std::strerror(errno));
}

// Options and help are the program's own.
void add_program(CLI::App& command, Action& action, std::string (*program)()) {
  command.prefix_command();
  command.set_help_flag();
  command.callback([&command, &action, program] {
    action = [&command, program]() -> int { become(program(), command.remaining()); };
  });
}

}  // namespace

void add_robot(CLI::App& command, Action& action) { add_program(command, action, robot_program); }
void add_ros2(CLI::App& command, Action& action) { add_program(command, action, ros2_program); }

}  // namespace banyan::cli
