// SPDX-License-Identifier: MIT
// A frame as messages of ROS 2, which Foxglove, Lichtblick, RViz, PlotJuggler and Rerun show: in recordings, in bags
// (export.hpp), and wherever else bytes in CDR go. Needs nothing of ROS.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "banyan/measure/tick.hpp"
#include "banyan/record/draw.hpp"
#include "banyan/record/frame.hpp"
#include "banyan/record/mcap.hpp"
#include "banyan/record/recording.hpp"

namespace banyan::record::ros2 {

// Writes one message after the other as CDR of the first version (XCDR1), little endian, with the header of four bytes
// that says so. Keeps its memory.
class CdrWriter {
 public:
  CdrWriter() { clear(); }
  void clear();
  [[nodiscard]] std::string_view view() const noexcept { return bytes_; }

  // Numbers are padded to a multiple of their size, as CDR wants it.
  void octet(std::uint8_t value) { bytes_.push_back(static_cast<char>(value)); }
  void whole(std::int32_t value) { natural(static_cast<std::uint32_t>(value)); }
  void natural(std::uint32_t value);
  void real(float value);
  void real(double value);
  void string(std::string_view text);  // UTF-8 without zeros
  void time(std::uint64_t nanoseconds);

  // A sequence whose length is known when it has been written: natural(0) and then its elements.
  [[nodiscard]] std::size_t sequence();
  void set_length(std::size_t sequence, std::uint32_t length) noexcept;
  // Takes back what has been written since size() was this.
  [[nodiscard]] std::size_t size() const noexcept { return bytes_.size(); }
  void cut(std::size_t size) { bytes_.resize(size); }

 private:
  template <class Unsigned> void put(Unsigned value);

  std::string bytes_;
};

struct MessageType {
  std::string_view name;   // "tf2_msgs/msg/TFMessage"
  std::string definition;  // its .msg and those it contains, as in MCAP's schema encoding "ros2msg"
};
[[nodiscard]] MessageType markers_type();     // visualization_msgs/msg/MarkerArray
[[nodiscard]] MessageType transforms_type();  // tf2_msgs/msg/TFMessage
[[nodiscard]] MessageType log_type();         // rcl_interfaces/msg/Log
[[nodiscard]] MessageType map_type();         // nav_msgs/msg/OccupancyGrid

inline constexpr std::string_view markers_topic = "/markers", transforms_topic = "/tf", log_topic = "/rosout",
                                  map_topic = "/map";

[[nodiscard]] std::uint16_t add_channel(mcap::Writer& file, std::string_view topic, MessageType type,
                                        mcap::ChunkGroup group = 0);

// When a message is from, and the names of coordinate frames in it.
struct Stamp {
  std::uint64_t nanoseconds = 0;
  std::string_view map = "map";
  std::string_view body = "robot_{}/base_link";  // {}: the robot's index
};

// Where each robot is in the map, to 0.1 mm and 0.1 mrad; the dead, too. One message for all, so they are in step.
void write_transforms(CdrWriter& out, const Stamp& stamp, const Frame& frame);

// Everything there is to see, after a marker that deletes all there was before; so a viewer may jump to any message.
// Layers are namespaces: robots, headings, tree, old_tree, targets, target_names, obstacles without maps, and links if
// there are any. Points of lists are rounded to a 64th of a body's radius or less.
void write_markers(CdrWriter& out, const Stamp& stamp, const Setting& setting, const Frame& frame,
                   const RadioLinks* links = nullptr);

// Its cells, 0 free and 100 occupied; the lowest row first.
void write_map(CdrWriter& out, const Stamp& stamp, const world::FloorMap& map);

// The maps of a setting on /map, and on /map_2 and so on if there are several: each when there is one, and again when
// it has changed, since viewers keep the last.
class MapTopics {
 public:
  // Returns how many messages this made.
  std::uint64_t write(mcap::Writer& file, CdrWriter& out, const Stamp& stamp, const Setting& setting,
                      mcap::ChunkGroup group = 0);

 private:
  std::vector<std::uint16_t> channels_;
  std::vector<world::FloorMap> last_;
};

// Where a robot is in the map, and how it has moved since `before`, in its own frame; `elapsed_s` 0: it stands still.
// Exact, so all covariances are 0.
void write_odometry(CdrWriter& out, const Stamp& stamp, std::size_t robot, const RobotFrame& now,
                    const RobotFrame& before, double elapsed_s);

void write_clock(CdrWriter& out, const Stamp& stamp);  // rosgraph_msgs/msg/Clock

// A part of a mission, as rqt_robot_monitor and Foxglove list them.
struct Diagnosis {
  enum class Level : std::uint8_t { ok = 0, warning = 1, error = 2 };
  Level level = Level::ok;
  std::string name, message;
  std::vector<std::pair<std::string, std::string>> values;
};
// Of the mission, the network and the robots, in this order. An error is a network in several parts, or without a
// living robot.
[[nodiscard]] std::vector<Diagnosis> diagnose(const measure::Tick& tick, std::size_t robots);
void write_diagnostics(CdrWriter& out, const Stamp& stamp,
                       std::span<const Diagnosis> parts);  // diagnostic_msgs/msg/DiagnosticArray

// Deaths, splits, broken edges and what was refused are warnings. The name is that of the event after "banyan.".
void write_log(CdrWriter& out, const Stamp& stamp, const RecordedEvent& event);

}  // namespace banyan::record::ros2
