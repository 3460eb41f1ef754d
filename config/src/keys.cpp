// SPDX-License-Identifier: MIT
#include "banyan/config/keys.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

namespace banyan::config {
namespace {

using OutputKey = world::Key<record::OutputSettings>;

// Of the recording; they follow its switch.
constexpr OutputKey recording_rows[] = {
    {"output.record_every",
     world::of<&record::OutputSettings::record_every>,
     "ticks",
     {1.0, 1e6},
     "record the robots only every this many ticks; metrics at every tick"},
    {"output.messages",
     world::of<&record::OutputSettings::messages>,
     "",
     {},
     "record what each robot broadcast, as well as where it was"},
    {"output.live",
     world::of<&record::OutputSettings::live>,
     "",
     {},
     "end a chunk of the recording every second, so that it can be watched while it is written"},
};

template <std::size_t format> bool* wanted(record::OutputSettings& output) noexcept { return &output.wanted[format]; }

// A switch for each format of record/'s table that has a key. Keys refer to texts: both are made once.
template <std::size_t... format> std::vector<OutputKey> output_rows(std::index_sequence<format...>) {
  static std::array<std::pair<std::string, std::string>, sizeof...(format)> texts;
  const world::Access<record::OutputSettings> switches[] = {world::by<wanted<format>>...};
  std::vector<OutputKey> rows;
  for (std::size_t k = 0; k < texts.size(); ++k) {
    const record::OutputFormat& of = record::output_formats[k];
    if (of.key.empty()) continue;
    auto& [path, meaning] = texts[k];
    path = "output." + std::string(of.key);
    meaning = "write " + std::string(of.file) + ", " + std::string(of.what);
    rows.push_back({path, switches[k], "", {}, meaning});
    if (of.key == "record") rows.insert(rows.end(), std::begin(recording_rows), std::end(recording_rows));
  }
  return rows;
}

}  // namespace

std::span<const OutputKey> output_keys() noexcept {
  static const auto rows = output_rows(std::make_index_sequence<std::size(record::output_formats)>());
  return rows;
}

std::span<const world::Section> sections() noexcept {
  static const std::vector<world::Section> all = [] {
    const auto scenario = world::scenario_sections();
    std::vector<world::Section> list(scenario.begin(), scenario.end());
    list.push_back({"output", "What `banyan run` keeps. It never changes what happens."});
    return list;
  }();
  return all;
}

const world::Section* find_section(std::string_view path) noexcept {
  const auto all = sections();
  const auto found = std::find_if(all.begin(), all.end(), [&](const world::Section& s) { return s.path == path; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace banyan::config
