// SPDX-License-Identifier: MIT
#include "ffmpeg.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <thread>
#include <utility>

#include "banyan/record/file.hpp"
#include "terminal.hpp"

namespace banyan::cli {

namespace {

namespace fs = std::filesystem;

// The pictures have few colours and sharp edges. yuv420p and +faststart: every player and page can show
// the film, and start before it is loaded.
std::vector<std::string> encoder(FilmKind kind) {
  const std::string video = "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p";
  std::vector<std::string> list;
  switch (kind) {
    case FilmKind::mp4:
      list = {"-vf",   video,       "-c:v", "libx264", "-preset",   "fast",
              "-tune", "animation", "-crf", "20",      "-movflags", "+faststart"};
      break;
    case FilmKind::webm:
      list = {"-vf", video,       "-c:v", "libvpx-vp9", "-crf", "30",      "-b:v",
              "0",   "-deadline", "good", "-cpu-used",  "4",    "-row-mt", "1"};
      break;
    case FilmKind::gif:
      // One palette for the whole film, and no dithering: flat colours stay flat, and small.
      return {"-filter_complex",
              "[0:v]split[a][b];[a]palettegen=max_colors=128[p];[b][p]paletteuse=dither=none:diff_mode=rectangle",
              "-loop",
              "0",
              "-f",
              "gif"};
  }
  for (const char* option : {"-colorspace", "-color_primaries", "-color_trc"})
    list.insert(list.end(), {option, "bt709"});
  list.insert(list.end(), {"-f", kind == FilmKind::mp4 ? "mp4" : "webm"});
  return list;
}

std::string last_lines(int log) {
  std::string text;
  std::array<char, 4096> piece;
  for (off_t at = 0;;) {
    const ssize_t got = ::pread(log, piece.data(), piece.size(), at);
    if (got <= 0) break;
    text.append(piece.data(), static_cast<std::size_t>(got));
    at += got;
  }
  while (text.ends_with('\n')) text.pop_back();
  std::size_t from = text.size();
  for (int line = 0; line < 5 && from != std::string::npos && from > 0; ++line) from = text.rfind('\n', from - 1);
  if (from != std::string::npos && from > 0 && from < text.size()) text.erase(0, from + 1);
  return text;
}

}  // namespace

FilmKind film_kind(const std::string& output) {
  const std::string ending = fs::path(output).extension();
  if (ending == ".mp4") return FilmKind::mp4;
  if (ending == ".webm") return FilmKind::webm;
  if (ending == ".gif") return FilmKind::gif;
  throw CommandError(exit_usage, output + ": the ending of a film must be .mp4, .webm or .gif");
}

Ffmpeg::Ffmpeg(std::string output, int width, int height, int fps, bool replace)
    : output_(std::move(output)), part_(output_ + ".part"), replace_(replace) {
  std::vector<std::string> arguments{"ffmpeg",
                                     "-hide_banner",
                                     "-loglevel",
                                     "error",
                                     "-y",
                                     "-f",
                                     "rawvideo",
                                     "-pixel_format",
                                     "bgra",
                                     "-video_size",
                                     std::to_string(width) + "x" + std::to_string(height),
                                     "-framerate",
                                     std::to_string(fps),
                                     "-i",
                                     "pipe:0",
                                     "-an"};
  const auto more = encoder(film_kind(output_));
  arguments.insert(arguments.end(), more.begin(), more.end());
  // Not an option and not a protocol ("a:b.mp4"), whatever the name looks like.
  arguments.push_back("file:" + part_);
  start(arguments);
}

void Ffmpeg::start(const std::vector<std::string>& arguments) {
  ::signal(SIGPIPE, SIG_IGN);  // an ffmpeg that gives up is then an error of write()
  ::signal(SIGCHLD, SIG_DFL);  // if inherited as ignored, we could not learn how ffmpeg ended
  std::array<int, 2> ends{-1, -1};
  log_ = ::memfd_create("ffmpeg", MFD_CLOEXEC);
  if (log_ < 0 || ::pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw CommandError(exit_lost, std::string("ffmpeg cannot be started: ") + std::strerror(errno));
  }
  pipe_ = ends[1];
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  ::posix_spawn_file_actions_adddup2(&files, ends[0], STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, log_, STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&files, log_, STDERR_FILENO);
  // In a process group of its own: Ctrl-C goes to us, and we end ffmpeg.
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const int error = ::posix_spawnp(&child_, "ffmpeg", &files, &attributes, argv.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&files);
  ::close(ends[0]);
  if (error == 0) return;
  child_ = -1;
  close_pipe();
  ::close(std::exchange(log_, -1));
  throw CommandError(exit_lost, error == ENOENT
                                    ? "films are made by ffmpeg, which is not installed (Debian's package: ffmpeg)"
                                    : std::string("ffmpeg cannot be started: ") + std::strerror(error));
}

Ffmpeg::~Ffmpeg() {
  if (child_ > 0) {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
  close_pipe();
  if (log_ >= 0) ::close(log_);
  ::unlink(part_.c_str());
}

void Ffmpeg::close_pipe() noexcept {
  if (pipe_ >= 0) ::close(std::exchange(pipe_, -1));
}

void Ffmpeg::write(const Pixels& frame) {
  const std::string_view bytes(reinterpret_cast<const char*>(frame.bgra.data()), frame.bgra.size());
  try {
    record::write_all(pipe_, bytes, "ffmpeg");
  } catch (const record::FileError& error) {
    if (error.error_number() != EPIPE) throw;
    int status = 0;
    while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {}
    child_ = -1;
    fail(status);
  }
}

bool Ffmpeg::finish() {
  close_pipe();
  // Asked again and again, because a signal that comes just before a wait would not end it.
  int status = 0;
  for (;;) {
    const pid_t ended = ::waitpid(child_, &status, WNOHANG);
    if (ended == child_) break;
    if (ended < 0 && errno != EINTR)
      throw CommandError(exit_lost, output_ + ": the exit status of ffmpeg cannot be read: " + std::strerror(errno));
    if (stop_signal() != 0) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  child_ = -1;
  if (status != 0) fail(status);
  rename_part();
  return true;
}

void Ffmpeg::rename_part() {
  // link(), unlike rename(), refuses to replace a file that has appeared meanwhile.
  if (!replace_ && ::link(part_.c_str(), output_.c_str()) == 0) return;
  if (!replace_ && errno == EEXIST)
    throw CommandError(exit_lost, output_ + " has appeared meanwhile; add --force to replace it");
  if (::rename(part_.c_str(), output_.c_str()) != 0)
    throw record::FileError(output_, "cannot rename from " + part_, errno);
}

void Ffmpeg::fail(int status) {
  const std::string said = last_lines(log_);
  std::string text = output_ + ": ffmpeg has given up";
  if (WIFSIGNALED(status)) text += " (signal " + std::to_string(WTERMSIG(status)) + ")";
  if (WIFEXITED(status) && WEXITSTATUS(status) != 0) text += " (exit code " + std::to_string(WEXITSTATUS(status)) + ")";
  throw CommandError(exit_lost, said.empty() ? text : text + "; the last that it said:\n" + said);
}

}  // namespace banyan::cli
