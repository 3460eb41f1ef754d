// SPDX-License-Identifier: MIT
// The commands that are programs of their own.
#include <filesystem>

#include "banyan/version.hpp"
#include "beside.hpp"
#include "commands.hpp"

namespace banyan::cli {
namespace {

// A program that a command is, and what it needs.
struct Beside {
  const char *command, *feature, *library, *packages;
};

std::string path_of(const Beside& part) {
  if (missing_features.find(part.feature) != std::string_view::npos)
    throw built_without(std::string("banyan ") + part.command, part.library, part.packages);
  const std::string name = std::string("banyan-") + part.command;
  const auto program = std::filesystem::path(own_program()).parent_path() / name;
  if (!std::filesystem::exists(program))
    throw CommandError(
        exit_lost, program.string() + " is not there; build the target banyan_" + part.command + ", or call ./banyan");
  return program.string();
}

}  // namespace

std::string robot_program() { return path_of({"robot", "fleets", "libsodium", "libsodium-dev"}); }
std::string ros2_program() {
  return path_of({"ros2", "ros2", "Cyclone DDS", "cyclonedds-dev, cyclonedds-tools and libsodium-dev"});
}
std::string tune_program() {
  return path_of({"tune", "tuning", "pagmo", "libpagmo-dev, libtbb-dev and libboost-serialization-dev"});
}

}  // namespace banyan::cli
