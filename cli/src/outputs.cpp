// SPDX-License-Identifier: MIT
#include "outputs.hpp"

#include <filesystem>
#include <system_error>

#include "terminal.hpp"

namespace banyan::cli {

using namespace config;
namespace {

namespace fs = std::filesystem;

std::vector<std::string> results_in(const fs::path& directory) {
  std::vector<std::string> found;
  std::error_code ignored;
  for (const auto& format : record::output_formats) {
    if (fs::exists(fs::symlink_status(directory / format.file, ignored))) found.emplace_back(format.file);
  }
  return found;
}

std::string default_directory(const world::Scenario& scenario) {
  return "out/" + scenario.name + "-" + scenario.mission.algorithm + "-" + std::to_string(scenario.seed);
}

}  // namespace

bool make_directory(const std::string& directory) {
  std::error_code error;
  const bool created = fs::create_directories(directory, error);
  if (error)
    throw CommandError(exit_lost,
                       directory + ": cannot be created: " + error.message() + "; choose another place with --out DIR");
  return created;
}

RunOutputs::RunOutputs(const Configuration& configuration, const std::string& out, bool force)
    : directory_(out.empty() ? default_directory(configuration.scenario) : out),
      existing_(force ? record::Existing::replace : record::Existing::keep) {
  if (out.empty() && !force) {
    // Making the directory is what claims it: two runs at once get two directories.
    const std::string first = directory_;
    for (int n = 2; !(created_ = make_directory(directory_)) && n <= 10000; ++n)
      directory_ = first + "." + std::to_string(n);
    if (!created_) throw CommandError(exit_lost, first + ": 10000 runs of this kind exist; use --out DIR");
    return;
  }
  while (directory_.size() > 1 && directory_.ends_with('/')) directory_.pop_back();
  std::error_code ignored;
  if (fs::exists(directory_, ignored) && !fs::is_directory(directory_, ignored)) {
    throw CommandError(exit_usage, directory_ + " exists and is no directory; --out needs one");
  }
  if (const auto found = results_in(directory_); !found.empty() && !force) {
    std::string list;
    for (const auto& file : found) list += (list.empty() ? "" : ", ") + file;
    throw CommandError(exit_usage, directory_ + " already holds results (" + list +
                                       "); add --force to replace them, or choose another --out DIR");
  }
  created_ = make_directory(directory_);
}

std::string RunOutputs::path(const record::OutputFormat& format) const {
  return directory_ + "/" + std::string(format.file);
}

void RunOutputs::remove_leftovers(const record::OutputSettings& wanted) const {
  std::error_code ignored;
  for (const auto& format : record::output_formats) {
    if (!wanted.wants(format)) fs::remove(path(format), ignored);
  }
}

void RunOutputs::abandon() const noexcept {
  std::error_code ignored;
  if (created_) fs::remove(directory_, ignored);  // fails, as it should, when something is in it
}

}  // namespace banyan::cli
