// SPDX-License-Identifier: MIT
// Films are made by ffmpeg, a program of its own: it gets raw pixels through a pipe and writes one file.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "raster.hpp"

namespace banyan::cli {

enum class FilmKind { mp4, webm, gif };

// By the ending of the file. Throws CommandError (exit_usage) with the allowed ones.
[[nodiscard]] FilmKind film_kind(const std::string& output);

// A film that is being written, under `output` + ".part" until finish(). Without that the part is removed
// and ffmpeg ended, whatever happens.
class Ffmpeg {
 public:
  // Throws CommandError: ffmpeg is not installed, or cannot be started. `replace`: an existing `output`.
  Ffmpeg(std::string output, int width, int height, int fps, bool replace);
  Ffmpeg(const Ffmpeg&) = delete;
  Ffmpeg& operator=(const Ffmpeg&) = delete;
  ~Ffmpeg();

  // A frame of the size given; waits while ffmpeg is busy. Throws CommandError (exit_lost) with the last
  // lines of ffmpeg if it has given up.
  void write(const Pixels& frame);
  // Waits for ffmpeg and gives the file its name. Throws as write(), and if the file cannot be named.
  // False if a stop signal came before the film was whole; it is then gone.
  [[nodiscard]] bool finish();

 private:
  void start(const std::vector<std::string>& arguments);
  void close_pipe() noexcept;
  void rename_part();
  [[noreturn]] void fail(int status);

  std::string output_, part_;
  bool replace_;
  pid_t child_ = -1;
  int pipe_ = -1;
  int log_ = -1;  // ffmpeg's messages, in memory
};

}  // namespace banyan::cli
