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

// The file itself if it is there, else the one that comes with the program and is meant by it: "three-targets",
// "scenarios/three-targets.toml"; `kind` is the folder, scenarios or studies.
[[nodiscard]] std::string itself_or_shipped(const std::string& file, const char* kind);

// What draws figures: the installed figures.py, in a clone that of the clone.
[[nodiscard]] std::string shipped_figures();

}  // namespace banyan::cli
