// SPDX-License-Identifier: MIT
// The messages of a recording one by one, for who shows a run that nobody records: frames as numbers,
// the rest as the JSON that a recording has (docs/file-formats.md).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/controller/core/swarm.hpp"
#include "banyan/measure/metrics.hpp"
#include "banyan/record/frame.hpp"
#include "banyan/record/recording.hpp"

namespace banyan::record {

// An array of /banyan/frame.
struct FrameColumn {
  std::string_view name;  // with its unit: "x_m"
  std::string_view meaning;
};
[[nodiscard]] std::span<const FrameColumn> frame_columns() noexcept;  // in the order of a recording

// Replaces `into` by frame_columns() one after the other, a number per robot in each: robot i's column
// c is into[c * robots + i]. Nobody and unknown are -1. Not rounded, as a recording's are.
void pack(const Frame& frame, std::vector<double>& into);

[[nodiscard]] std::string setting_json(const Setting& setting);
[[nodiscard]] std::string targets_json(const Frame& frame);
[[nodiscard]] std::string metrics_json(const measure::Tick& tick);
[[nodiscard]] std::string event_json(const RecordedEvent& event);
// What a robot broadcast last: all fields of its message; role, phase and need by name.
[[nodiscard]] std::string message_json(const Swarm& swarm, std::size_t robot);
// The columns of the run table that tell how it went, as {"column": "text"}: what a recording's
// banyan.result holds.
[[nodiscard]] std::string result_json(const measure::Run& run);

}  // namespace banyan::record
