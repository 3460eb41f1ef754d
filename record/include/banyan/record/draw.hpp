// SPDX-License-Identifier: MIT
// One frame as an SVG picture: robots by role, both trees, radio links, targets, trails.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "banyan/record/frame.hpp"

namespace banyan::record {

class Recording;

// A part of the plane, m.
struct Viewport {
  Vec2 low, high;
};
// Everything that a picture of this would show, at least as wide and high as the radio reaches.
[[nodiscard]] Viewport view_of(const Setting& setting, const Frame& frame);
// What holds both.
[[nodiscard]] Viewport joined(const Viewport& a, const Viewport& b) noexcept;

struct PictureOptions {
  double width_px = 1000.0;      // 200 to 20000
  double height_px = 0.0;        // 0: as high as the map needs; else exactly that, 150 to 20000
  std::optional<Viewport> view;  // what is shown; default view_of(), with the trails
  double trail_s = 10.0;         // how far back trails go; 0: none. Recordings only
  bool links = true;
  bool blocked_links = false;  // in range, but no line of sight
  bool ids = false;            // robot numbers
  bool legend = true;
  bool dark = false;    // light on dark
  bool steady = false;  // for films: nothing but the world moves; what may come has its place
  std::string_view font = "Helvetica, Arial, sans-serif";  // a list of families, as in CSS
};

// Where each robot has been, oldest first: one path per robot, empty for none.
using Trails = std::vector<std::vector<Vec2>>;

// Remembers the last `length_s` seconds of a run, for its trails.
class TrailLog {
 public:
  explicit TrailLog(double length_s) : length_s_(length_s) {}
  void add(const Frame& frame);                         // in order of time; a sample each half second is kept
  [[nodiscard]] Trails trails(const Frame& end) const;  // that end at its robots; `end` not earlier than what came last

 private:
  struct Sample {
    double time_s;
    std::vector<Vec2> positions;
  };
  double length_s_;
  std::deque<Sample> samples_;
};

[[nodiscard]] std::string draw_svg(const Setting& setting, const Frame& frame, const Trails& trails = {},
                                   const PictureOptions& options = {});
// The last frame at or before `time_s`.
[[nodiscard]] std::string draw_svg(Recording& recording, double time_s, const PictureOptions& options = {});

// Pairs i < j that are in range, both alive, and have or lack a line of sight.
struct RadioLinks {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open, blocked;
};
[[nodiscard]] RadioLinks radio_links(const Setting& setting, const Frame& frame);

}  // namespace banyan::record
