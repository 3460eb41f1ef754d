// SPDX-License-Identifier: MIT
// One frame as an SVG picture: robots by role, both trees, radio links, targets, trails.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "banyan/record/frame.hpp"

namespace banyan::record {

class Recording;

struct DrawOptions {
  double width_px = 1000.0;
  double trail_s = 10.0;       // how far back trails go; 0: none. Recordings only
  bool links = true;
  bool blocked_links = false;  // in range, but no line of sight
  bool ids = false;            // robot numbers
  bool legend = true;
};

// Where each robot has been, oldest first: one path per robot, empty for none.
using Trails = std::vector<std::vector<Vec2>>;

[[nodiscard]] std::string draw_svg(const Setting& setting, const Frame& frame, const Trails& trails = {},
                                   const DrawOptions& options = {});
// The last frame at or before `time_s`.
[[nodiscard]] std::string draw_svg(Recording& recording, double time_s, const DrawOptions& options = {});

// Pairs i < j that are in range, both alive, and have or lack a line of sight.
struct Links {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open, blocked;
};
[[nodiscard]] Links radio_links(const Setting& setting, const Frame& frame);

}  // namespace banyan::record
