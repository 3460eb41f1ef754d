// SPDX-License-Identifier: MIT
// `banyan draw`: a picture of a moment of a recording.
#include "banyan/record/draw.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "commands.hpp"
#include "options.hpp"
#include "raster.hpp"
#include "recordings.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

struct DrawOptions {
  std::string recording;
  std::string output = "-";
  std::string format;                                     // "svg" or "png"; "": by the ending of `output`
  double at_s = std::numeric_limits<double>::infinity();  // the end
  double trail_s = 10.0;
  double width_px = 1000.0;
  bool links = true;
  bool blocked = false;
  bool ids = false;
  bool legend = true;
  bool dark = false;
  bool force = false;
};

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

}  // namespace

void add_draw(CLI::App& command, CommandAction& action) {
  auto options = std::make_shared<DrawOptions>();
  command.footer(
      "Examples:\n"
      "  banyan draw out/three-targets-convoy-1/run.mcap --at 30 -o frame.svg\n"
      "  banyan draw run.mcap --at 30 --width 1600 --dark -o frame.png\n"
      "  banyan draw run.mcap --ids --trail 0 > end.svg");
  command.add_option("recording", options->recording, "a run.mcap")->required()->type_name("FILE");
  command.add_option("--at", options->at_s, "the moment, s; default the end")->type_name("S")->check(moment());
  command.add_option("-o,--output", options->output, "file to write (.svg or .png), default standard output")
      ->type_name("FILE");
  command.add_option("--format", options->format, "format, whatever the file's extension; default svg")
      ->type_name("svg|png")
      ->check(CLI::IsMember({"svg", "png"}).description(""));
  command.add_option("--trail", options->trail_s, "how far back trails go, s; default 10")
      ->type_name("S")
      ->check(moment());
  command.add_option("--width", options->width_px, "width in pixels, default 1000")
      ->type_name("PX")
      ->check(number_within(200.0, 20000.0));  // as record::PictureOptions has it
  add_look(command, *options);
  command.add_flag("-f,--force", options->force, "replace the file if it exists");
  command.callback([options, &action] { action = [options] { return draw_command(*options); }; });
}

}  // namespace banyan::cli
