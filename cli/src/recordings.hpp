// SPDX-License-Identifier: MIT
// What the commands that read a recording have in common.
#pragma once

#include <string>

#include "banyan/record/recording.hpp"

namespace banyan::cli {

// Tells its warnings. Throws record::FileError if it cannot be read, CommandError if it holds no frame.
[[nodiscard]] record::Recording open_recording(const std::string& path);

// Throws CommandError (exit_usage) if `output` is a file and not `force`.
void refuse_to_overwrite(const std::string& output, bool force);

}  // namespace banyan::cli
