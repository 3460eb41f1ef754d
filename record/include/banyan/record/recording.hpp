// SPDX-License-Identifier: MIT
// A run as one MCAP file: what happened at every tick, who asked for it and how it ended. Opens in
// Foxglove, Lichtblick and Rerun; the channels are described in docs/file-formats.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/measure/metrics.hpp"
#include "banyan/record/file.hpp"
#include "banyan/record/frame.hpp"

namespace banyan::record {

// Where a result comes from; written into every output.
struct Provenance {
  std::string config_json;  // the whole configuration, as one JSON object
  std::string version;
  std::string git;  // commit id, "" if unknown
  std::uint64_t seed = 0;
};

struct RecorderOptions {
  std::uint32_t every_ticks = 1;  // frames and messages; metrics and events are kept at every tick
  bool messages = true;           // what each robot broadcast, at every recorded frame of a world
  double scene_period_s = 0.5;    // 0: no /markers and /tf; stretched in proportion above 1000 robots
  int compression_level = 1;      // zstd
  std::size_t chunk_bytes = 1 << 20;
  bool live = false;  // chunks end with every second of the wall clock: for those who read it while it grows
  Existing existing = Existing::keep;
};

// Writes `path`.part and renames it in finish(). If finish() is never reached the .part stays and
// is readable up to the last complete chunk. All functions throw FileError.
class Recorder {
 public:
  Recorder(std::string path, Provenance provenance, RecorderOptions options = {});
  Recorder(Recorder&&) noexcept;
  Recorder& operator=(Recorder&&) noexcept;
  ~Recorder();

  // Once per tick, in order; also once before the first step if the start is to be seen. The setting
  // is looked at every time: what changes in it is kept. Without a world there are no messages.
  void frame(const world::World& world, const measure::Tick& tick);
  void frame(const Setting& setting, const Frame& frame, const measure::Tick& tick);
  // A remark in /banyan/events at the time of the last frame ("interrupt", "stopped by the user").
  void event(std::string_view kind, std::string_view text);
  // Writes the last frame if `every_ticks` left it out, the result and the index; the file gets
  // its name. An interrupted run is a valid recording that says so.
  void finish(const measure::Run& run, bool interrupted = false);

  [[nodiscard]] std::uint64_t bytes() const noexcept;  // of the file so far
  [[nodiscard]] const std::string& path() const noexcept;
  [[nodiscard]] const std::string& part_path() const noexcept;  // what stays if it is never finished

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

struct RecordedEvent {
  std::uint64_t tick = 0;
  double time_s = 0.0;
  std::string kind;
  std::int64_t robot = -1;
  std::int64_t target = -1;
  std::string text;
};

// Reads a recording, also one that was cut short. Throws FileError for what cannot be read as one
// ("not an MCAP file", "no /banyan/frame channel"); damage that can be skipped is a warning.
class Recording {
 public:
  explicit Recording(const std::string& path);
  Recording(Recording&&) noexcept;
  Recording& operator=(Recording&&) noexcept;
  ~Recording();

  [[nodiscard]] const std::string& path() const noexcept;
  [[nodiscard]] const std::vector<std::string>& warnings() const;
  [[nodiscard]] const Provenance& provenance() const noexcept;
  [[nodiscard]] const Setting& setting() const noexcept;  // at the start
  // The one that holds at `time_s`. Valid as long as this recording, as is setting().
  [[nodiscard]] const Setting& setting_at(double time_s) const noexcept;
  // The run's result by column name (table.hpp), plus "interrupted"; empty if it was cut short.
  [[nodiscard]] const std::map<std::string, std::string>& result() const noexcept;

  [[nodiscard]] std::size_t frames() const noexcept;
  [[nodiscard]] double start_s() const noexcept;  // of the first and last frame; 0 without any
  [[nodiscard]] double end_s() const noexcept;

  // The last frame at or before `time_s`, the first one if there is none. Throws without frames.
  [[nodiscard]] Frame frame_at(double time_s);
  // Frames in [from_s, to_s] in order, every nth; `visit` returns false to stop.
  void for_each(const std::function<bool(const Frame&)>& visit, double from_s = 0.0,
                double to_s = std::numeric_limits<double>::infinity(), std::size_t every = 1);
  [[nodiscard]] std::vector<measure::Tick> metrics();
  [[nodiscard]] std::vector<RecordedEvent> events();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace banyan::record
