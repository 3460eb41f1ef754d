// SPDX-License-Identifier: MIT
// `banyan film`: a recording as a film. Frames are read once to know what must fit into the picture and
// once to draw it; at no time are more in memory than are being drawn.
#include <signal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <filesystem>
#include <functional>
#include <future>
#include <optional>
#include <thread>

#include "banyan/record/draw.hpp"
#include "commands.hpp"
#include "ffmpeg.hpp"
#include "options.hpp"
#include "raster.hpp"
#include "recordings.hpp"
#include "terminal.hpp"

namespace banyan::cli {

namespace {

struct FilmOptions {
  std::string recording;
  std::string output;
  int fps = 0;         // 0: 30, of a GIF 15
  double speed = 0.0;  // seconds of the run in a second of the film; 0: chosen (film.cpp)
  double from_s = 0.0;
  double to_s = std::numeric_limits<double>::infinity();
  int width = 0, height = 0;  // px, even; 0: 1280 x 720, of a GIF 720 x 450
  double trail_s = 5.0;
  bool links = true;
  bool blocked = false;
  bool ids = false;
  bool legend = true;
  bool dark = false;
  bool quiet = false;
  bool force = false;
};

constexpr double hold_s = 1.0;          // the last frame stays, so that the end can be seen
constexpr double film_length_s = 20.0;  // what the speed is chosen for
constexpr double gif_length_s = 12.0;

// Which moments of the recording are shown, and how fast.
struct Cut {
  double from_s = 0.0, to_s = 0.0;
  double speed = 1.0;  // seconds of the run in a second of the film
  int fps = 30;
  std::size_t stride = 1;  // recorded frames per frame that is read: no more than are shown
  double trail_s = 0.0;

  [[nodiscard]] double step_s() const { return speed / fps; }
  [[nodiscard]] std::size_t moving() const {
    return 1 + static_cast<std::size_t>(std::floor((to_s - from_s) / step_s() + 1e-6));
  }
  [[nodiscard]] std::size_t held() const { return static_cast<std::size_t>(std::lround(hold_s * fps)); }
  [[nodiscard]] std::size_t frames() const { return moving() + held(); }
  [[nodiscard]] double time_s(std::size_t k) const {
    return std::min(from_s + static_cast<double>(k) * step_s(), to_s);
  }
};

// The slowest speed at which the film is not too long.
double chosen_speed(double length_s, double wanted_s) {
  constexpr std::array<double, 15> speeds{1, 2, 3, 4, 5, 6, 8, 10, 12, 16, 20, 24, 32, 48, 64};
  const auto fits = std::find_if(speeds.begin(), speeds.end(), [&](double s) { return length_s / s <= wanted_s; });
  return fits == speeds.end() ? speeds.back() : *fits;
}

Cut make_cut(const record::Recording& recording, const FilmOptions& options, bool gif) {
  Cut cut;
  cut.from_s = std::max(options.from_s, recording.start_s());
  cut.to_s = std::min(options.to_s, recording.end_s());
  if (cut.from_s > cut.to_s) {
    const std::string wanted = std::isfinite(options.to_s)
                                   ? format("from %.6g s to %.6g s", options.from_s, options.to_s)
                                   : format("from %.6g s on", options.from_s);
    throw CommandError(exit_usage, format("nothing to show %s: the recording has %.6g s to %.6g s", wanted.c_str(),
                                          recording.start_s(), recording.end_s()));
  }
  cut.fps = options.fps > 0 ? options.fps : gif ? 15 : 30;
  cut.speed =
      options.speed > 0.0 ? options.speed : chosen_speed(cut.to_s - cut.from_s, gif ? gif_length_s : film_length_s);
  cut.trail_s = options.trail_s;
  const auto intervals = static_cast<double>(std::max<std::size_t>(recording.frames(), 2) - 1);
  const double recorded_s = (recording.end_s() - recording.start_s()) / intervals;
  if (recorded_s > 0.0)
    cut.stride = static_cast<std::size_t>(std::max(1.0, std::floor(cut.step_s() / recorded_s + 1e-6)));
  return cut;
}

// The frames of the film in order, including those before its start that its trails need, and the one at
// its end. `visit` returns false to stop.
void read_frames(record::Recording& recording, const Cut& cut, const std::function<bool(const record::Frame&)>& visit) {
  const double before_s = std::max(recording.start_s(), cut.from_s - cut.trail_s);
  const double begin_s = recording.frame_at(before_s).time_s;
  double last_s = -1.0;
  bool wanted = true;
  recording.for_each(
      [&](const record::Frame& frame) {
        last_s = frame.time_s;
        return wanted = visit(frame);
      },
      begin_s, cut.to_s, cut.stride);
  if (!wanted || last_s >= cut.to_s) return;
  // The end may lie between two recorded frames, or on one that the stride has left out.
  record::Frame end = recording.frame_at(cut.to_s);
  if (end.time_s <= last_s) return;
  visit(end);
}

// Everything that is shown at any time, so that the picture stands still.
record::Viewport whole_view(record::Recording& recording, const Cut& cut) {
  std::optional<record::Viewport> view;
  read_frames(recording, cut, [&](const record::Frame& frame) {
    const record::Viewport here = record::view_of(recording.setting_at(frame.time_s), frame);
    view = view ? record::joined(*view, here) : here;
    return stop_signal() == 0;
  });
  return view.value_or(record::Viewport{});
}

// Frames are drawn by several threads and reach ffmpeg in their order.
class Studio {
 public:
  Studio(Ffmpeg& ffmpeg, const record::PictureOptions& look) : ffmpeg_(ffmpeg), look_(look) {}

  // Waits for the oldest while enough are being drawn.
  void draw(const record::Setting& setting, record::Frame frame, record::Trails trails) {
    if (drawing_.size() >= threads_) take();
    drawing_.push_back(
        std::async(std::launch::async, [this, setting, frame = std::move(frame), trails = std::move(trails)] {
          return rasterize(record::draw_svg(setting, frame, trails, look_), static_cast<int>(look_.width_px),
                           static_cast<int>(look_.height_px));
        }));
  }
  // Everything that is being drawn, then the last frame `times` more.
  void finish(std::size_t times) {
    while (!drawing_.empty()) take();
    for (std::size_t k = 0; k < times && stop_signal() == 0; ++k) ffmpeg_.write(last_);
  }

 private:
  void take() {
    last_ = drawing_.front().get();
    drawing_.pop_front();
    ffmpeg_.write(last_);
  }

  Ffmpeg& ffmpeg_;
  const record::PictureOptions& look_;
  Pixels last_;
  std::deque<std::future<Pixels>> drawing_;
  // ffmpeg needs one too, but never for long.
  std::size_t threads_ = std::clamp(std::thread::hardware_concurrency(), 1U, 16U);
};

record::PictureOptions look_of(const FilmOptions& options, bool gif) {
  record::PictureOptions look;
  look.width_px = options.width > 0 ? options.width : gif ? 720 : 1280;
  look.height_px = options.height > 0 ? options.height : gif ? 450 : 720;
  look.trail_s = options.trail_s;
  look.links = options.links;
  look.blocked_links = options.blocked;
  look.ids = options.ids;
  look.legend = options.legend;
  look.dark = options.dark;
  look.steady = true;
  look.font = raster_font;
  return look;
}

// Draws every moment of the cut, each between the two recorded frames around it.
void shoot(record::Recording& recording, const Cut& cut, Studio& studio, ProgressLine& progress) {
  record::TrailLog log(cut.trail_s);
  std::optional<record::Frame> earlier;
  std::size_t next = 0;
  const auto draw_until = [&](const record::Frame& later) {
    for (; next < cut.moving() && cut.time_s(next) <= later.time_s + 1e-9 && stop_signal() == 0; ++next) {
      record::Frame now = record::between(earlier ? *earlier : later, later, cut.time_s(next));
      auto trails = log.trails(now);
      const record::Setting& setting = recording.setting_at(now.time_s);
      studio.draw(setting, std::move(now), std::move(trails));
      constexpr std::size_t warm = 10;  // before, the time of a frame says little about that of the others
      if (next < warm || !progress.due()) continue;
      const double done = static_cast<double>(next) / static_cast<double>(cut.frames());
      progress.show(done,
                    format("frame %zu of %zu, %.0f frames/s", next, cut.frames(),
                           static_cast<double>(next) / progress.elapsed_s()),
                    false);
    }
  };
  read_frames(recording, cut, [&](const record::Frame& frame) {
    draw_until(frame);
    log.add(frame);
    earlier = frame;
    return stop_signal() == 0;
  });
  // Moments later than the last recorded frame show that one.
  if (earlier && next < cut.moving() && stop_signal() == 0) {
    record::Frame last = *earlier;
    last.time_s = cut.to_s;
    draw_until(last);
  }
  studio.finish(cut.held());
}

int stopped() {
  complain(format("stopped by %s; there is no film", stop_signal_name()));
  return exit_signal + stop_signal();
}

int film_command(const FilmOptions& options) {
  const bool gif = film_kind(options.output) == FilmKind::gif;
  refuse_to_overwrite(options.output, options.force);
  auto recording = open_recording(options.recording);
  const auto told = recording.warnings();
  const Cut cut = make_cut(recording, options, gif);
  record::PictureOptions look = look_of(options, gif);
  catch_stop_signals();
  ProgressLine progress(!options.quiet);
  Ffmpeg ffmpeg(options.output, static_cast<int>(look.width_px), static_cast<int>(look.height_px), cut.fps,
                options.force);
  const std::size_t frames = cut.frames();
  const double length_s = static_cast<double>(frames) / cut.fps;
  if (!options.quiet) {
    complain(format("%.6g s to %.6g s at %.3gx: %.1f s of film, %zu frames of %.0f x %.0f", cut.from_s, cut.to_s,
                    cut.speed, length_s, frames, look.width_px, look.height_px));
  }
  look.view = whole_view(recording, cut);
  if (stop_signal() != 0) return stopped();
  {
    Studio studio(ffmpeg, look);
    shoot(recording, cut, studio, progress);
  }
  if (stop_signal() != 0 || !ffmpeg.finish()) return stopped();
  progress.clear();
  tell_further_warnings(recording, options.recording, told);
  if (!options.quiet) {
    complain(format("wrote %s, %s KB, %.0f frames/s", options.output.c_str(),
                    grouped(static_cast<double>(std::filesystem::file_size(options.output)) / 1000.0).c_str(),
                    static_cast<double>(frames) / progress.elapsed_s()));
  }
  return exit_done;
}

// Pixels of a film: its encoders take pairs of them.
CLI::Validator even_size(int least, int most) {
  return {[=](const std::string& text) {
            int value = 0;
            const bool fits =
                CLI::detail::lexical_cast(text, value) && value >= least && value <= most && value % 2 == 0;
            return fits ? std::string()
                        : "must be an even number of " + std::to_string(least) + " to " + std::to_string(most) +
                              ", not \"" + text + "\"";
          },
          ""};
}

}  // namespace

void add_film(CLI::App& command, CommandAction& action) {
  auto options = std::make_shared<FilmOptions>();
  command.footer(
      "Made by ffmpeg. MP4 plays everywhere, WebM in browsers, GIF in a README. Without --speed the film\n"
      "is at most 20 s long (a GIF 12 s), 1 to 64 times as fast as the run; the last frame stays for a\n"
      "second. The view stays the same throughout the film.\n\n"
      "Examples:\n"
      "  banyan film out/three-targets-convoy-1/run.mcap -o three.mp4\n"
      "  banyan film run.mcap -o slow.mp4 --from 10 --to 20 --speed 1 --ids\n"
      "  banyan film run.mcap -o readme.gif --width 640 --height 400 --dark");
  command.add_option("recording", options->recording, "a run.mcap")->required()->type_name("FILE");
  command.add_option("-o,--output", options->output, "file to write: .mp4, .webm or .gif")
      ->required()
      ->type_name("FILE");
  command.add_option("--fps", options->fps, "frames a second; default 30, for a GIF 15")
      ->type_name("N")
      ->check(whole_within(1, 120));
  command.add_option("--speed", options->speed, "seconds of the run in a second of the film, 0.1 to 64")
      ->type_name("X")
      ->check(number_within(0.1, 64.0));
  command.add_option("--from", options->from_s, "first moment, s")->type_name("S")->check(moment());
  command.add_option("--to", options->to_s, "last moment, s")->type_name("S")->check(moment());
  command.add_option("--width", options->width, "width in pixels; default 1280, for a GIF 720")
      ->type_name("PX")
      ->check(even_size(200, 7680));
  command.add_option("--height", options->height, "height in pixels; default 720, for a GIF 450")
      ->type_name("PX")
      ->check(even_size(150, 4320));
  command.add_option("--trail", options->trail_s, "how far back trails go, s; default 5")
      ->type_name("S")
      ->check(moment());
  add_look(command, *options);
  command.add_flag("-q,--quiet", options->quiet, "no progress and no summary; warnings and errors only");
  command.add_flag("-f,--force", options->force, "replace the file if it exists");
  command.callback([options, &action] { action = [options] { return film_command(*options); }; });
}

}  // namespace banyan::cli
