// SPDX-License-Identifier: MIT
// A recording as one tidy CSV (export.hpp).
#include "banyan/record/export.hpp"

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

std::uint64_t export_csv(Recording& recording, const WritePiece& write, const TableOptions& options) {
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
                         const TableOptions& options) {
  OutputFile file(path, existing);
  const std::uint64_t rows = export_csv(
      recording, [&](std::string_view piece) { file.write(piece); }, options);
  file.commit();
  return rows;
}

}  // namespace banyan::record
