// SPDX-License-Identifier: MIT
#include "beside.hpp"

#include <filesystem>

namespace banyan::cli {

std::string own_program() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

CommandError built_without(const std::string& what, const std::string& library, const std::string& packages) {
  return {exit_lost, what + " needs " + library + ", which this banyan was built without; install " + packages +
                         " and build again"};
}

}  // namespace banyan::cli
