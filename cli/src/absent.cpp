// SPDX-License-Identifier: MIT
// In the place of the commands that the small program (target banyan_first) is built without.
// ./banyan knows which they are and then builds the whole one.
#include "commands.hpp"
#include "options.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

[[noreturn]] void absent(const std::string& command) {
  throw CommandError(exit_lost, "this program was built without the command " + command +
                                    "; build the target banyan_cli, or call ./banyan");
}

}  // namespace

void add_argos(CLI::App& command, CommandAction& /*action*/) { absent(command.get_name()); }
void add_collect(CLI::App& command, CommandAction& /*action*/) { absent(command.get_name()); }
void add_doctor(CLI::App& command, CommandAction& /*action*/) { absent(command.get_name()); }
void add_film(CLI::App& command, CommandAction& /*action*/) { absent(command.get_name()); }
void add_fleet(CLI::App& command, CommandAction& /*action*/) { absent(command.get_name()); }
void add_hub(CLI::App& command, CommandAction& /*action*/) { absent(command.get_name()); }
void add_listen(CLI::App& command, CommandAction& /*action*/) { absent(command.get_name()); }
void add_study(CLI::App& command, CommandAction& /*action*/) { absent(command.get_name()); }
void add_view(CLI::App& command, CommandAction& /*action*/) { absent(command.get_name()); }

}  // namespace banyan::cli
