// SPDX-License-Identifier: MIT
// What the commands that read a recording have in common.
#pragma once

#include <string>
#include <vector>

#include "banyan/record/file.hpp"
#include "banyan/record/recording.hpp"

namespace banyan::cli {

// Prints its warnings. Throws record::FileError if it cannot be read, CommandError if it holds no frame.
[[nodiscard]] record::Recording open_recording(const std::string& path);

// Prints the warnings that are new since opening: a damaged chunk is noticed only when it is read.
void tell_further_warnings(const record::Recording& recording, const std::string& path,
                           const std::vector<std::string>& told);

// Throws CommandError (exit_usage) if `output` is a file and not `force`, or can never be one.
void refuse_to_overwrite(const std::string& output, bool force);
[[nodiscard]] record::Existing existing(bool force);

}  // namespace banyan::cli
