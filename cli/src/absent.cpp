// SPDX-License-Identifier: MIT
// In the place of the commands that the small program (target banyan_first) is built without.
// ./banyan knows which they are and then builds the whole one.
#include "commands.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

[[noreturn]] int absent(const char* command) {
  throw CommandError(exit_lost, std::string("this program was built without the command ") + command +
                                    "; build the target banyan_cli, or call ./banyan");
}

}  // namespace

int film_command(const FilmOptions& /*options*/) { absent("film"); }
int view_command(const ViewOptions& /*options*/) { absent("view"); }
int tune_command(const TuneOptions& /*options*/) { absent("tune"); }
int study_command(const StudyOptions& /*options*/) { absent("study"); }
int soak_command(const SoakOptions& /*options*/) { absent("soak"); }
int hub_command(const HubOptions& /*options*/) { absent("hub"); }
int robot_command(const std::vector<std::string>& /*arguments*/) { absent("robot"); }
int argos_command(const ArgosOptions& /*options*/) { absent("argos"); }
int ros2_command(const std::vector<std::string>& /*arguments*/) { absent("ros2"); }
int listen_command(const ListenOptions& /*options*/) { absent("listen"); }
int fleet_command(const FleetOptions& /*options*/) { absent("fleet"); }
int collect_command(const CollectOptions& /*options*/) { absent("collect"); }

}  // namespace banyan::cli
