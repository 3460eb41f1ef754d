// SPDX-License-Identifier: MIT
// Where the files are that come with the program.
#pragma once

#include <filesystem>
#include <string>

namespace banyan::cli {

// "share/banyan/NAME" of the installation that this program belongs to.
[[nodiscard]] std::filesystem::path installed(const char* name);

// Banyan's own scenarios: the installed ones, in a clone those of the clone.
[[nodiscard]] std::string shipped_scenarios();

// The folder of the web viewer as it was built: BANYAN_PAGE, or the installed one; "" if it is not there.
[[nodiscard]] std::string shipped_page();

// What draws figures: the installed figures.py, in a clone that of the clone.
[[nodiscard]] std::string shipped_figures();

}  // namespace banyan::cli
