// SPDX-License-Identifier: MIT
// In the place of the commands that the small program (target banyan_first) is built without.
// ./banyan knows which they are and then builds the whole one.
#include "commands.hpp"
#include "options.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

void absent(CLI::App& command, Action& action) {
  command.prefix_command();
  command.set_help_flag();
  command.callback([&command, &action] {
    action = [&command]() -> int {
      throw CommandError(exit_lost, "this program was built without the command " + command.get_name() +
                                        "; build the target banyan_cli, or call ./banyan");
    };
  });
}

}  // namespace

void add_argos(CLI::App& command, Action& action) { absent(command, action); }
void add_collect(CLI::App& command, Action& action) { absent(command, action); }
void add_film(CLI::App& command, Action& action) { absent(command, action); }
void add_fleet(CLI::App& command, Action& action) { absent(command, action); }
void add_hub(CLI::App& command, Action& action) { absent(command, action); }
void add_listen(CLI::App& command, Action& action) { absent(command, action); }
void add_robot(CLI::App& command, Action& action) { absent(command, action); }
void add_ros2(CLI::App& command, Action& action) { absent(command, action); }
void add_soak(CLI::App& command, Action& action) { absent(command, action); }
void add_study(CLI::App& command, Action& action) { absent(command, action); }
void add_tune(CLI::App& command, Action& action) { absent(command, action); }
void add_view(CLI::App& command, Action& action) { absent(command, action); }

}  // namespace banyan::cli
