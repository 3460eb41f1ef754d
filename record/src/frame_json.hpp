// SPDX-License-Identifier: MIT
// The JSON messages of a recording: written by hand for speed, read back with a library that handles
// every kind of broken input. One table of fields serves writing, reading and the schema.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "banyan/measure/metrics.hpp"
#include "banyan/record/frame.hpp"
#include "banyan/record/recording.hpp"
#include "message_json.hpp"
#include "text.hpp"

namespace banyan::record {

inline constexpr std::string_view recording_format_version = "1";

void write_frame(Text& out, const Frame& frame);  // without the targets
// An array per field that is_recorded(), a number per robot.
void write_messages(Text& out, std::uint64_t tick, double time_s, const MessageNumbers& messages);
void write_targets(Text& out, const Frame& frame);
void write_metrics(Text& out, const measure::Tick& tick);
void write_event(Text& out, const RecordedEvent& event);
void write_setting(Text& out, const Setting& setting);

// Throw std::runtime_error with what is wrong. A frame's targets are left alone.
void read_frame(std::string_view text, Frame& frame);
[[nodiscard]] std::vector<TargetFrame> read_targets(std::string_view text);
[[nodiscard]] measure::Tick read_metrics(std::string_view text);
[[nodiscard]] RecordedEvent read_event(std::string_view text);
[[nodiscard]] Setting read_setting(std::string_view text);

// JSON Schemas of the above.
[[nodiscard]] std::string frame_schema();
[[nodiscard]] std::string messages_schema(std::span<const FieldInfo> fields);
[[nodiscard]] std::string targets_schema();
[[nodiscard]] std::string metrics_schema();
[[nodiscard]] std::string event_schema();
[[nodiscard]] std::string setting_schema();

[[nodiscard]] std::uint64_t nanoseconds(double time_s) noexcept;

}  // namespace banyan::record
