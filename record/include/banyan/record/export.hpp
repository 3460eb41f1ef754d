// SPDX-License-Identifier: MIT
// A recording as one tidy CSV, a row per recorded tick and robot, or as a bag of ROS 2.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>

#include "banyan/record/file.hpp"
#include "banyan/record/recording.hpp"

namespace banyan::record {

struct ExportOptions {
  double from_s = 0.0;
  double to_s = std::numeric_limits<double>::infinity();
  std::size_t every = 1;  // every nth recorded frame
};

// Gets the table in pieces of some 64 KiB, header first.
using WritePiece = std::function<void(std::string_view)>;

// Columns: tick,time_s,robot,x_m,y_m,heading_rad,role,phase,parent,old_parent,alive,connected,target.
// Roles and phases by name, alive and connected as 0 or 1, nobody as an empty field. Returns rows.
std::uint64_t export_csv(Recording& recording, const WritePiece& write, const ExportOptions& options = {});
std::uint64_t export_csv(Recording& recording, const std::string& path, Existing existing = Existing::keep,
                         const ExportOptions& options = {});

// An MCAP file with nothing but messages of ROS 2 (ros2.hpp), which `ros2 bag play` wants: it refuses a recording
// because of the JSON in it. Markers and transforms of every chosen frame, and the log from from_s to to_s. Made of
// frames and events alone, so older recordings will do, and those that were cut short. Returns messages. Throws
// FileError.
std::uint64_t export_bag(Recording& recording, const std::string& path, Existing existing = Existing::keep,
                         const ExportOptions& options = {});

}  // namespace banyan::record
