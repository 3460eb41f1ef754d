// SPDX-License-Identifier: MIT
// Where a run's files go; makes sure that no existing file gets lost.
#pragma once

#include <string>
#include <vector>

#include "banyan/config/config.hpp"
#include "banyan/record/outputs.hpp"

namespace banyan::cli {

// With the directories above it; true if it was not there before. Throws CommandError.
bool make_directory(const std::string& directory);

class RunOutputs {
 public:
  // Makes sure that the run may write before it starts. With `out` empty the directory is
  // out/<name>-<algorithm>-<seed>, with ".2", ".3" ... appended while one is taken and not `force`.
  // A given directory that holds results is an error unless `force`.
  RunOutputs(const config::Configuration& configuration, const std::string& out, bool force);

  [[nodiscard]] const std::string& directory() const noexcept { return directory_; }
  [[nodiscard]] record::Existing existing() const noexcept { return existing_; }
  [[nodiscard]] std::string path(const record::OutputFormat& format) const;

  // With force: removes files of the earlier run that this one was not to write, so that what lies
  // together belongs together.
  void remove_leftovers(const record::OutputSettings& wanted) const;
  // Removes the directory if it was made for this run and is still empty.
  void abandon() const noexcept;

 private:
  std::string directory_;
  record::Existing existing_;
  bool created_ = false;
};

}  // namespace banyan::cli
