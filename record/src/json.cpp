// SPDX-License-Identifier: MIT
#include "banyan/record/json.hpp"

#include "cell.hpp"
#include "frame_json.hpp"
#include "message_json.hpp"

namespace banyan::record {
namespace {

template <class Write> std::string written(const Write& write) {
  Text text;
  write(text);
  return std::string(text.view());
}

}  // namespace

std::string setting_json(const Setting& setting) {
  return written([&](Text& out) { write_setting(out, setting); });
}
std::string targets_json(const Frame& frame) {
  return written([&](Text& out) { write_targets(out, frame); });
}
std::string metrics_json(const measure::Tick& tick) {
  return written([&](Text& out) { write_metrics(out, tick); });
}
std::string event_json(const RecordedEvent& event) {
  return written([&](Text& out) { write_event(out, event); });
}
std::string message_json(const Swarm& swarm, std::size_t robot) {
  return written([&](Text& out) { write_message(out, swarm, robot); });
}

std::string result_json(const measure::Run& run) {
  const RunRow row{{}, run, false};
  Text out;
  Text cell;
  out.put('{');
  for (const auto& column : result_columns()) {
    cell.clear();
    write_cell_csv(cell, column.cell(row), column.decimals);
    out.json_string(column.name);
    out.put(':');
    out.json_string(cell.view());
    out.put(',');
  }
  out.drop_last();
  out.put('}');
  return std::string(out.view());
}

}  // namespace banyan::record
