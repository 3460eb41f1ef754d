// SPDX-License-Identifier: MIT
#include "shipped.hpp"

#include <cstdlib>

#include "terminal.hpp"

namespace banyan::cli {

namespace fs = std::filesystem;

fs::path installed(const char* name) {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored).parent_path().parent_path() / "share" / "banyan" / name;
}

std::string shipped_scenarios() {
  std::error_code ignored;
  const fs::path beside = installed("scenarios");
  return fs::is_directory(beside, ignored) ? beside.string() : BANYAN_SCENARIOS_FOLDER;
}

std::string shipped_page() {
  const fs::path folder = is_set("BANYAN_PAGE") ? fs::path(std::getenv("BANYAN_PAGE")) : installed("viewer");
  std::error_code ignored;
  return fs::is_regular_file(folder / "index.html", ignored) ? folder.string() : "";
}

std::string itself_or_shipped(const std::string& file, const char* kind) {
  std::error_code ignored;
  if (file.empty() || file == "-" || fs::path(file).is_absolute() || fs::exists(file, ignored)) return file;
  const fs::path folder = fs::path(shipped_scenarios()).parent_path();
  for (const fs::path& there : {folder / file, folder / kind / file, folder / kind / (file + ".toml")})
    if (fs::is_regular_file(there, ignored)) return there.string();
  return file;
}

std::string shipped_figures() {
  std::error_code ignored;
  const fs::path beside = installed("figures.py");
  return fs::is_regular_file(beside, ignored) ? beside.string() : BANYAN_FIGURES_SCRIPT;
}

}  // namespace banyan::cli
