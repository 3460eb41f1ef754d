// SPDX-License-Identifier: MIT
// From a figure to its three files (figure.hpp).
#include "banyan/study/figure.hpp"

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "figure_scripts.hpp"
#include "gnuplot.hpp"

namespace banyan::study {

namespace {

namespace fs = std::filesystem;
constexpr std::string_view end_of_svg = "</svg>", end_of_png = "IEND\xAE\x42\x60\x82";

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
  const std::string svg = picture(drawn + ".svg", end_of_svg), png = picture(drawn + ".png", end_of_png);
  record::write_file(stem + ".svg", svg, record::Existing::replace);
  record::write_file(stem + ".png", png, record::Existing::replace);
}

}  // namespace

void draw(const BoxFigure& figure, const std::string& stem) { draw_files(figure, stem); }
void draw(const CurveFigure& figure, const std::string& stem) { draw_files(figure, stem); }

}  // namespace banyan::study
