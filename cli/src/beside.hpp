// SPDX-License-Identifier: MIT
// This program, and the programs beside it.
#pragma once

#include <string>

#include "terminal.hpp"

namespace banyan::cli {

// This program.
[[nodiscard]] std::string own_program();

// "banyan tune needs pagmo, which this banyan was built without; install libpagmo-dev and build again".
[[nodiscard]] CommandError built_without(const std::string& what, const std::string& library,
                                         const std::string& packages);

}  // namespace banyan::cli
