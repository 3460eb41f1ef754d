// SPDX-License-Identifier: MIT
// `banyan export` and `banyan draw`: tables and pictures from a recording.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "banyan/record/draw.hpp"
#include "banyan/record/export.hpp"
#include "banyan/record/recording.hpp"
#include "commands.hpp"
#include "raster.hpp"
#include "recordings.hpp"
#include "terminal.hpp"

namespace banyan::cli {

using namespace config;

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

namespace {

record::Existing existing(bool force) { return force ? record::Existing::replace : record::Existing::keep; }

// "svg" or "png": what was asked for, else by the ending of the file.
std::string picture_format(const DrawOptions& options) {
  if (!options.format.empty()) return options.format;
  const std::string ending = std::filesystem::path(options.output).extension();
  if (options.output == "-" || ending == ".svg" || ending.empty()) return "svg";
  if (ending == ".png") return "png";
  throw CommandError(exit_usage, options.output + ": \"" + ending +
                                     "\" is no picture that banyan draws; use .svg or .png, or --format");
}

record::PictureOptions chosen_look(const DrawOptions& options, bool png) {
  record::PictureOptions chosen;
  chosen.width_px = options.width_px;
  chosen.trail_s = options.trail_s;
  chosen.links = options.links;
  chosen.blocked_links = options.blocked;
  chosen.ids = options.ids;
  chosen.legend = options.legend;
  chosen.dark = options.dark;
  if (png) chosen.font = raster_font;
  return chosen;
}

}  // namespace

int export_command(const ExportOptions& options) {
  refuse_to_overwrite(options.output, options.force);
  if (options.from_s > options.to_s) throw CommandError(exit_usage, "--from is later than --to: nothing to export");
  auto recording = open_recording(options.recording);
  const auto told = recording.warnings();
  const record::TableOptions chosen{options.from_s, options.to_s, options.every};
  if (options.output == "-") {
    record::export_csv(
        recording, [](std::string_view piece) { record::write_all(STDOUT_FILENO, piece, "standard output"); }, chosen);
    tell_further_warnings(recording, options.recording, told);
    return exit_done;
  }
  const auto rows = record::export_csv(recording, options.output, existing(options.force), chosen);
  tell_further_warnings(recording, options.recording, told);
  complain("wrote " + grouped(static_cast<double>(rows)) + " rows to " + options.output);
  return exit_done;
}

int draw_command(const DrawOptions& options) {
  const bool png = picture_format(options) == "png";
  refuse_to_overwrite(options.output, options.force);
  auto recording = open_recording(options.recording);
  const auto told = recording.warnings();
  const double at_s = std::min(options.at_s, recording.end_s());
  if (std::isfinite(options.at_s) && options.at_s > recording.end_s() + 1e-9) {
    complain(format("the recording ends at %.6g s; drawing that moment", recording.end_s()));
  }
  std::string picture = record::draw_svg(recording, at_s, chosen_look(options, png));
  if (png) {
    const PixelSize size = size_of(picture);
    picture = png_of(rasterize(picture, size.width, size.height));
  }
  if (options.output == "-") record::write_all(STDOUT_FILENO, picture, "standard output");
  else record::write_file(options.output, picture, existing(options.force));
  tell_further_warnings(recording, options.recording, told);
  return exit_done;
}

}  // namespace banyan::cli
