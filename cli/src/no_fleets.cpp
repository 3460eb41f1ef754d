// SPDX-License-Identifier: MIT
// Stands in for the commands of robots as processes where there is no libsodium.
#include <CLI/CLI.hpp>

#include "beside.hpp"
#include "commands.hpp"

namespace banyan::cli {
namespace {

[[noreturn]] void refuse(const CLI::App& command) {
  throw built_without("banyan " + command.get_name(), "libsodium", "libsodium-dev");
}

}  // namespace

void add_fleet(CLI::App& command, CommandAction& /*action*/) { refuse(command); }
void add_hub(CLI::App& command, CommandAction& /*action*/) { refuse(command); }
void add_listen(CLI::App& command, CommandAction& /*action*/) { refuse(command); }

}  // namespace banyan::cli
