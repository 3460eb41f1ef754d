// SPDX-License-Identifier: MIT
// A recording as one tidy CSV, or as a bag (export.hpp).
#include "banyan/record/export.hpp"

#include <algorithm>

#include "banyan/record/ros2.hpp"
#include "frame_json.hpp"
#include "text.hpp"

namespace banyan::record {

namespace {

constexpr std::string_view header =
    "tick,time_s,robot,x_m,y_m,heading_rad,role,phase,parent,old_parent,alive,connected,target\n";
constexpr std::size_t piece_bytes = std::size_t{1} << 16;

void put_index(Text& out, std::int32_t index) {
  out.put(',');
  if (index >= 0) out.integer(index);
}

void put_robot(Text& out, const Frame& frame, std::size_t i) {
  const RobotFrame& robot = frame.robots[i];
  out.natural(frame.tick);
  out.put(',');
  out.fixed(frame.time_s, 4);
  out.put(',');
  out.natural(i);
  for (const double value : {robot.position.x, robot.position.y, robot.heading_rad}) {
    out.put(',');
    out.fixed(value, 4);
  }
  out.put(',');
  out.put(name_of(robot.role));
  out.put(',');
  out.put(name_of(robot.phase));
  put_index(out, robot.parent);
  put_index(out, robot.old_parent);
  out.put(robot.alive ? ",1" : ",0");
  out.put(robot.connected ? ",1" : ",0");
  put_index(out, robot.target);
  out.put('\n');
}

}  // namespace

std::uint64_t export_csv(Recording& recording, const WritePiece& write, const ExportOptions& options) {
  Text out;
  out.put(header);
  std::uint64_t rows = 0;
  recording.for_each(
      [&](const Frame& frame) {
        for (std::size_t i = 0; i < frame.robots.size(); ++i) {
          put_robot(out, frame, i);
          ++rows;
          if (out.size() < piece_bytes) continue;
          write(out.view());
          out.clear();
        }
        return true;
      },
      options.from_s, options.to_s, options.every);
  if (out.size() > 0) write(out.view());
  return rows;
}

std::uint64_t export_csv(Recording& recording, const std::string& path, Existing existing,
                         const ExportOptions& options) {
  OutputFile file(path, existing);
  const std::uint64_t rows = export_csv(
      recording, [&](std::string_view piece) { file.write(piece); }, options);
  file.commit();
  return rows;
}

std::uint64_t export_bag(Recording& recording, const std::string& path, Existing existing,
                         const ExportOptions& options) {
  OutputFile file(path, existing);
  mcap::Writer bag(file, {"ros2", "banyan " + recording.provenance().version});
  const auto markers = ros2::add_channel(bag, ros2::markers_topic, ros2::markers_type());
  const auto transforms = ros2::add_channel(bag, ros2::transforms_topic, ros2::transforms_type());
  const auto log = ros2::add_channel(bag, ros2::log_topic, ros2::log_type());
  ros2::CdrWriter cdr;
  ros2::MapTopics maps;
  std::uint64_t messages = 0;
  const auto put = [&](std::uint16_t channel, const ros2::Stamp& stamp) {
    bag.message(channel, stamp.nanoseconds, cdr.view());
    ++messages;
  };
  const std::vector<RecordedEvent> events = recording.events();
  std::size_t told = 0;
  const auto tell_until = [&](double time_s) {
    for (; told < events.size() && events[told].time_s <= time_s; ++told) {
      if (events[told].time_s < options.from_s) continue;
      const ros2::Stamp stamp{.nanoseconds = nanoseconds(events[told].time_s)};
      write_log(cdr, stamp, events[told]);
      put(log, stamp);
    }
  };
  recording.for_each(
      [&](const Frame& frame) {
        tell_until(frame.time_s);
        const ros2::Stamp stamp{.nanoseconds = nanoseconds(frame.time_s)};
        const Setting& setting = recording.setting_at(frame.time_s);
        messages += maps.write(bag, cdr, stamp, setting);
        const RadioLinks links = radio_links(setting, frame);
        write_markers(cdr, stamp, setting, frame, &links);
        put(markers, stamp);
        write_transforms(cdr, stamp, frame);
        put(transforms, stamp);
        return true;
      },
      options.from_s, options.to_s, options.every);
  tell_until(options.to_s);
  bag.finish();
  file.commit();
  return messages;
}

}  // namespace banyan::record
