// SPDX-License-Identifier: MIT
// What can be kept of a run: one table of formats. The keys of [output], the options of `banyan run`, its summary and
// what a study keeps follow from it. A further format is a file in record/src/outputs/, two lines here, one in CMake.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>

namespace banyan::record {

class Sink;          // sink.hpp
struct SinkOptions;  // outputs.hpp

struct OutputFormat {
  std::string_view key;   // of [output], one word, true or false; "": every run has it, but not those of a study
  bool by_default;        // what the key is where it is not given
  std::string_view file;  // in the directory of the run
  std::string_view what;  // a phrase: "the recording"
  // Makes the file, or sees to it that it can be made later. Throws FileError.
  std::unique_ptr<Sink> (*open)(const std::string& path, const SinkOptions& options);
};

[[nodiscard]] std::unique_ptr<Sink> open_recording(const std::string& path, const SinkOptions& options);
[[nodiscard]] std::unique_ptr<Sink> open_row(const std::string& path, const SinkOptions& options);
[[nodiscard]] std::unique_ptr<Sink> open_result(const std::string& path, const SinkOptions& options);
[[nodiscard]] std::unique_ptr<Sink> open_series(const std::string& path, const SinkOptions& options);

inline constexpr OutputFormat output_formats[] = {
    {"record", true, "run.mcap", "the recording", open_recording},
    {"", true, "run.csv", "the result as one row", open_row},
    {"", true, "run.json", "the same with the whole configuration", open_result},
    {"series", false, "series.csv", "a row of metrics per tick", open_series},
};

// [output] of a scenario. Never changes what happens in a run.
struct OutputSettings {
  std::array<bool, std::size(output_formats)> wanted = defaults();  // the formats with a key, by position
  bool results = true;                                              // those without one
  std::uint32_t record_every = 1;                                   // ticks, of the recording
  bool messages = true;                                             // in it: what each robot broadcast
  bool live = false;                                                // can be watched while it is written

  // By key; throws std::out_of_range for what is none.
  [[nodiscard]] bool& operator[](std::string_view key);
  [[nodiscard]] bool operator[](std::string_view key) const;
  [[nodiscard]] bool wants(const OutputFormat& format) const;
  [[nodiscard]] bool any() const noexcept;  // of those with a key

 private:
  static constexpr std::array<bool, std::size(output_formats)> defaults() {
    std::array<bool, std::size(output_formats)> all{};
    for (std::size_t k = 0; k < all.size(); ++k)
      all[k] = !output_formats[k].key.empty() && output_formats[k].by_default;
    return all;
  }
};

}  // namespace banyan::record
