// SPDX-License-Identifier: MIT
// The house's source files.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

// Those below `folder`, in order.
inline std::vector<std::filesystem::path> sources(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  static constexpr std::array<std::string_view, 4> endings = {".hpp", ".h", ".cpp", ".cc"};
  std::vector<fs::path> found;
  if (!fs::exists(folder)) return found;
  for (fs::recursive_directory_iterator entry(folder), end; entry != end; ++entry) {
    const std::string name = entry->path().filename().string();
    if (entry->is_directory() && (name == "node_modules" || name == "build")) entry.disable_recursion_pending();
    else if (std::ranges::find(endings, entry->path().extension().string()) != endings.end())
      found.push_back(entry->path());
  }
  std::ranges::sort(found);
  return found;
}
