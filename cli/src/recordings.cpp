// SPDX-License-Identifier: MIT
#include "recordings.hpp"

#include <algorithm>
#include <filesystem>

#include "terminal.hpp"

namespace banyan::cli {

record::Recording open_recording(const std::string& path) {
  record::Recording recording(path);
  tell_further_warnings(recording, path, {});
  if (recording.frames() == 0) throw CommandError(exit_lost, path + ": the recording holds no frames");
  return recording;
}

void tell_further_warnings(const record::Recording& recording, const std::string& path,
                           const std::vector<std::string>& told) {
  for (const auto& warning : recording.warnings())
    if (std::find(told.begin(), told.end(), warning) == told.end()) complain(path + ": warning: " + warning);
}

void refuse_to_overwrite(const std::string& output, bool force) {
  std::error_code ignored;
  if (output != "-" && std::filesystem::is_directory(output, ignored))
    throw CommandError(exit_usage, output + " is a directory; give the name of a file");
  if (output == "-" || force || !std::filesystem::is_regular_file(output, ignored)) return;
  throw CommandError(exit_usage, output + " exists; add --force to replace it");
}

record::Existing existing(bool force) { return force ? record::Existing::replace : record::Existing::keep; }

}  // namespace banyan::cli
