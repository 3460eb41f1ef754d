// SPDX-License-Identifier: MIT
// From a figure to its four files (figure.hpp).
#include "banyan/study/figure.hpp"

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "figure_scripts.hpp"
#include "gnuplot.hpp"

namespace banyan::study {

namespace {

namespace fs = std::filesystem;
// The pictures, and how a complete one ends.
constexpr std::pair<std::string_view, std::string_view> pictures[] = {
    {".svg", "</svg>"}, {".pdf", "%%EOF"}, {".png", "IEND\xAE\x42\x60\x82"}};

// gnuplot draws here; its pictures reach their place whole or not at all.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code error;
    std::string name = (fs::absolute(fs::temp_directory_path(error), error) / "banyan-figure-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw record::FileError(name, "cannot create a temporary folder", errno);
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::string& path() const noexcept { return path_; }

 private:
  std::string path_;
};

// gnuplot does not report a full disk: so its output must have the end of a complete picture.
std::string picture(const std::string& path, std::string_view end) {
  std::string bytes;
  try {
    const record::InputFile file(path);
    if (!file.read(0, file.size(), bytes)) bytes.clear();
  } catch (const record::FileError&) {
    throw FigureError("gnuplot did not draw " + fs::path(path).filename().string());
  }
  if (bytes.find(end, bytes.size() - std::min<std::size_t>(bytes.size(), 32)) == std::string::npos) {
    throw FigureError("gnuplot left half of " + fs::path(path).filename().string() + "; is the disk full?");
  }
  return bytes;
}

template <typename Figure> void draw_files(const Figure& figure, const std::string& stem) {
  const std::string name = fs::path(stem).filename().string();
  if (name.empty()) throw record::FileError(stem, "is a folder, not the name of a figure");
  const std::string script = stem + ".gp";
  record::write_file(script, script_of(figure, name), record::Existing::replace);
  const TemporaryFolder folder;
  const std::string drawn = folder.path() + "/figure";
  run_gnuplot(script, drawn);
  std::vector<std::string> whole;
  for (const auto& [ending, end] : pictures) whole.push_back(picture(drawn + std::string(ending), end));
  for (std::size_t i = 0; i < whole.size(); ++i)
    record::write_file(stem + std::string(pictures[i].first), whole[i], record::Existing::replace);
}

}  // namespace

void draw(const BoxFigure& figure, const std::string& stem) { draw_files(figure, stem); }
void draw(const CurveFigure& figure, const std::string& stem) { draw_files(figure, stem); }

}  // namespace banyan::study
