// SPDX-License-Identifier: MIT
// A recording as one tidy CSV: a row per recorded tick and robot.
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

struct TableOptions {
  double from_s = 0.0;
  double to_s = std::numeric_limits<double>::infinity();
  std::size_t every = 1;  // every nth recorded frame
};

// Gets the table in pieces of some 64 KiB, header first.
using WritePiece = std::function<void(std::string_view)>;

// Columns: tick,time_s,robot,x_m,y_m,heading_rad,role,phase,parent,old_parent,alive,connected,target.
// Roles and phases by name, alive and connected as 0 or 1, nobody as an empty field. Returns rows.
std::uint64_t export_csv(Recording& recording, const WritePiece& write, const TableOptions& options = {});
std::uint64_t export_csv(Recording& recording, const std::string& path, Existing existing = Existing::keep,
                         const TableOptions& options = {});

}  // namespace banyan::record
