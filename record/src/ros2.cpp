// SPDX-License-Identifier: MIT
// A frame as messages of ROS 2 (ros2.hpp).
#include "banyan/record/ros2.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <utility>

#include "banyan/controller/core/trig.hpp"
#include "banyan/record/palette.hpp"

namespace banyan::record::ros2 {

namespace {

constexpr std::size_t encapsulation_bytes = 4;  // positions count from behind it

// --- Definitions, as common_interfaces, geometry2 and rcl_interfaces have them from Humble on, without comments.

constexpr std::string_view marker_definition = R"(int32 ARROW=0
int32 CUBE=1
int32 SPHERE=2
int32 CYLINDER=3
int32 LINE_STRIP=4
int32 LINE_LIST=5
int32 CUBE_LIST=6
int32 SPHERE_LIST=7
int32 POINTS=8
int32 TEXT_VIEW_FACING=9
int32 MESH_RESOURCE=10
int32 TRIANGLE_LIST=11
int32 ADD=0
int32 MODIFY=0
int32 DELETE=2
int32 DELETEALL=3
std_msgs/Header header
string ns
int32 id
int32 type
int32 action
geometry_msgs/Pose pose
geometry_msgs/Vector3 scale
std_msgs/ColorRGBA color
builtin_interfaces/Duration lifetime
bool frame_locked
geometry_msgs/Point[] points
std_msgs/ColorRGBA[] colors
string texture_resource
sensor_msgs/CompressedImage texture
visualization_msgs/UVCoordinate[] uv_coordinates
string text
string mesh_resource
visualization_msgs/MeshFile mesh_file
bool mesh_use_embedded_materials
)";

constexpr std::string_view log_definition = R"(byte DEBUG=10
byte INFO=20
byte WARN=30
byte ERROR=40
byte FATAL=50
builtin_interfaces/Time stamp
uint8 level
string name
string msg
string file
string function
uint32 line
)";

constexpr std::string_view map_definition = R"(std_msgs/Header header
nav_msgs/MapMetaData info
int8[] data
)";

constexpr std::string_view map_info_definition = R"(builtin_interfaces/Time map_load_time
float32 resolution
uint32 width
uint32 height
geometry_msgs/Pose origin
)";

struct Definition {
  std::string_view name, definition;
};
constexpr Definition time_part{"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"};
constexpr Definition duration_part{"builtin_interfaces/Duration", "int32 sec\nuint32 nanosec\n"};
constexpr Definition header_part{"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"};
constexpr Definition color_part{"std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n"};
constexpr Definition point_part{"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"};
constexpr Definition vector_part{"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"};
constexpr Definition quaternion_part{"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"};
constexpr Definition pose_part{"geometry_msgs/Pose",
                               "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"};
constexpr Definition transform_part{"geometry_msgs/Transform",
                                    "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"};
constexpr Definition stamped_part{"geometry_msgs/TransformStamped",
                                  "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"};
constexpr Definition marker_part{"visualization_msgs/Marker", marker_definition};
constexpr Definition texture_part{"sensor_msgs/CompressedImage",
                                  "std_msgs/Header header\nstring format\nuint8[] data\n"};
constexpr Definition corner_part{"visualization_msgs/UVCoordinate", "float32 u\nfloat32 v\n"};
constexpr Definition map_info_part{"nav_msgs/MapMetaData", map_info_definition};
constexpr Definition mesh_part{"visualization_msgs/MeshFile", "string filename\nuint8[] data\n"};

std::string with_parts(std::string_view definition, std::initializer_list<Definition> parts) {
  std::string all(definition);
  for (const Definition& part : parts) {
    all.append(80, '=').append("\nMSG: ").append(part.name).append("\n").append(part.definition);
  }
  return all;
}

// --- What several messages contain.

// Digits that nobody sees would be half the bytes of a chunk.
double rounded(double value, double steps) noexcept { return std::floor(value * steps + 0.5) / steps; }

// As fine as frames are, 0.1 mm and 0.1 mrad.
constexpr double steps_per_m = 16384.0, steps_of_turn = 65536.0;

// For pictures: 64 to 128 steps are a body's radius.
double picture_steps(double radius_m) noexcept {
  const int exponent = radius_m > 0.0 ? std::clamp(6 - std::ilogb(radius_m), 0, 30) : 14;
  return std::ldexp(1.0, exponent);
}

void put_xyz(CdrWriter& out, double x, double y, double z) {
  out.real(x);
  out.real(y);
  out.real(z);
}

void put_turn(CdrWriter& out, double angle_rad) {  // about z
  const Vec2 half = unit_vector(angle_rad / 2.0);
  out.real(0.0);
  out.real(0.0);
  out.real(rounded(half.y, steps_of_turn));
  out.real(rounded(half.x, steps_of_turn));
}

void put_color(CdrWriter& out, const Color& c, float alpha) {
  for (const std::uint8_t part : {c.red, c.green, c.blue}) out.real(static_cast<float>(part) / 255.0F);
  out.real(alpha);
}

void put_header(CdrWriter& out, const Stamp& stamp) {
  out.time(stamp.nanoseconds);
  out.string(stamp.map);
}

// --- Markers.

enum class MarkerKind : std::int32_t { cube = 1, cylinder = 3, line_list = 5, sphere_list = 7, text = 9 };
enum class MarkerAction : std::int32_t { add = 0, delete_all = 3 };

struct MarkerSize {
  double x = 0.0, y = 0.0, z = 0.0;  // m
};

struct MarkerLooks {
  std::string_view layer;
  MarkerKind shape = MarkerKind::cube;
  Vec2 position;
  double z = 0.0, angle_rad = 0.0;
  MarkerSize scale;
  Color color = palette::tree;
  float alpha = 1.0F;
  std::string_view text;
};

// Robots are from 1 cm to metres wide, and reach from 10 cm to 1 km: what there is to see grows with them.
struct Dimensions {
  explicit Dimensions(const Setting& setting)
      : body_height(0.85 * setting.radius_m),
        wall_height(2.0 * setting.radius_m),
        wall_thickness(0.4 * setting.radius_m),
        edge_thickness(std::max(setting.radius_m / 3.0, setting.range_m / 200.0)),
        letter_height(setting.range_m / 8.0) {}
  double body_height, wall_height, wall_thickness, edge_thickness, letter_height;  // m
};

struct PointWriter {
  CdrWriter& out;
  double steps;  // per m
  void point(Vec2 p, double z) const { put_xyz(out, rounded(p.x, steps), rounded(p.y, steps), z); }
  void segment(Vec2 a, Vec2 b, double z) const {
    point(a, z);
    point(b, z);
  }
};

class MarkerWriter {
 public:
  MarkerWriter(CdrWriter& out, const Stamp& stamp, double radius_m)
      : out_(out), stamp_(stamp), points_{out, picture_steps(radius_m)}, array_(out.sequence()) {}

  void delete_all() {
    head(0, {}, MarkerAction::delete_all);
    lists_without_points();
    tail("");
  }
  void one(std::size_t id, const MarkerLooks& looks) {
    head(id, looks, MarkerAction::add);
    lists_without_points();
    tail(looks.text);
  }
  // A list without points is no marker: RViz complains of one.
  template <class Points> void list(const MarkerLooks& looks, const Points& put_points) {
    list(looks, put_points, [](CdrWriter&) { return std::uint32_t{0}; });
  }
  template <class Points, class Colors>
  void list(const MarkerLooks& looks, const Points& put_points, const Colors& put_colors) {
    const std::size_t before = out_.size();
    head(0, looks, MarkerAction::add);
    const std::size_t points = out_.sequence();
    const std::uint32_t number = put_points(points_);
    if (number == 0) {
      out_.cut(before);
      --count_;
      return;
    }
    out_.set_length(points, number);
    const std::size_t colors = out_.sequence();
    out_.set_length(colors, put_colors(out_));
    tail("");
  }
  void finish() { out_.set_length(array_, count_); }

 private:
  void head(std::size_t id, const MarkerLooks& looks, MarkerAction action) {
    ++count_;
    put_header(out_, stamp_);
    out_.string(looks.layer);
    out_.natural(static_cast<std::uint32_t>(id));
    out_.whole(static_cast<std::int32_t>(looks.shape));
    out_.whole(static_cast<std::int32_t>(action));
    put_xyz(out_, looks.position.x, looks.position.y, looks.z);
    put_turn(out_, looks.angle_rad);
    put_xyz(out_, looks.scale.x, looks.scale.y, looks.scale.z);
    put_color(out_, looks.color, looks.alpha);
    out_.time(0);   // lifetime: until it is deleted
    out_.octet(0);  // frame_locked
  }
  void lists_without_points() {
    out_.natural(0);  // points
    out_.natural(0);  // colors
  }
  void tail(std::string_view text) {
    out_.string("");  // texture_resource
    out_.time(0);     // texture: its header,
    out_.string("");
    out_.string("");  // format
    out_.natural(0);  // and data
    out_.natural(0);  // uv_coordinates
    out_.string(text);
    out_.string("");  // mesh_resource
    out_.string("");  // mesh_file: its name
    out_.natural(0);  // and data
    out_.octet(0);    // mesh_use_embedded_materials
  }

  CdrWriter& out_;
  const Stamp& stamp_;
  PointWriter points_;
  std::size_t array_;
  std::uint32_t count_ = 0;
};

MarkerLooks lines(std::string_view layer, const Color& color, double thickness_m) {
  MarkerLooks looks;
  looks.layer = layer;
  looks.shape = MarkerKind::line_list;
  looks.scale.x = thickness_m;
  looks.color = color;
  return looks;
}

// --- What there is to see. Edges lie below the tops of bodies.

void mark_robots(MarkerWriter& markers, const Setting& setting, const Frame& frame) {
  const double height = Dimensions(setting).body_height;
  const auto number = static_cast<std::uint32_t>(frame.robots.size());
  MarkerLooks bodies;
  bodies.layer = "robots";
  bodies.shape = MarkerKind::sphere_list;
  bodies.scale = {2.0 * setting.radius_m, 2.0 * setting.radius_m, height};
  markers.list(
      bodies,
      [&](const PointWriter& points) {
        for (const RobotFrame& r : frame.robots) points.point(r.position, height / 2.0);
        return number;
      },
      [&](CdrWriter& out) {
        for (const RobotFrame& r : frame.robots) put_color(out, color_of(r.role, r.alive), 1.0F);
        return number;
      });
  markers.list(lines("headings", palette::tree, setting.radius_m / 4.0), [&](const PointWriter& points) {
    for (const RobotFrame& r : frame.robots) {
      points.segment(r.position, r.position + setting.radius_m * unit_vector(r.heading_rad), height);
    }
    return 2 * number;
  });
}

void mark_trees(MarkerWriter& markers, const Setting& setting, const Frame& frame) {
  const Dimensions size(setting);
  const auto edges = [&](std::string_view layer, const Color& color, std::int32_t RobotFrame::*to, double z) {
    markers.list(lines(layer, color, size.edge_thickness), [&](const PointWriter& points) {
      std::uint32_t number = 0;
      for (const RobotFrame& r : frame.robots) {
        const std::int32_t parent = r.*to;
        if (!r.alive || parent < 0 || static_cast<std::size_t>(parent) >= frame.robots.size()) continue;
        points.segment(r.position, frame.robots[static_cast<std::size_t>(parent)].position, z);
        number += 2;
      }
      return number;
    });
  };
  edges("old_tree", palette::old_tree, &RobotFrame::old_parent, size.body_height / 3.0);
  edges("tree", palette::tree, &RobotFrame::parent, size.body_height / 2.0);
}

void mark_links(MarkerWriter& markers, const Setting& setting, const Frame& frame, const RadioLinks& links) {
  const Dimensions size(setting);
  markers.list(lines("links", palette::link, size.edge_thickness / 3.0), [&](const PointWriter& points) {
    for (const auto& [i, j] : links.open) {
      points.segment(frame.robots[i].position, frame.robots[j].position, size.body_height / 6.0);
    }
    return static_cast<std::uint32_t>(2 * links.open.size());
  });
}

void mark_targets(MarkerWriter& markers, const Setting& setting, const Frame& frame) {
  const Dimensions size(setting);
  MarkerLooks disc;
  disc.layer = "targets";
  disc.shape = MarkerKind::cylinder;
  disc.scale = {2.0 * setting.target_tolerance_m, 2.0 * setting.target_tolerance_m, size.body_height / 10.0};
  disc.z = disc.scale.z / 2.0;
  disc.color = palette::target;
  disc.alpha = 0.5F;
  MarkerLooks name;
  name.layer = "target_names";
  name.shape = MarkerKind::text;
  name.scale.z = size.letter_height;
  name.z = 1.5 * size.letter_height;
  name.color = palette::target;
  for (std::size_t k = 0; k < frame.targets.size(); ++k) {
    if (!frame.targets[k].active) continue;
    const std::string text = "T" + std::to_string(k);
    disc.position = name.position = frame.targets[k].position;
    name.text = text;
    markers.one(k, disc);
    markers.one(k, name);
  }
}

MarkerLooks looks_of(const world::Disc& disc, const Dimensions& size) {
  MarkerLooks looks;
  looks.shape = MarkerKind::cylinder;
  looks.position = disc.center;
  looks.scale = {2.0 * disc.radius_m, 2.0 * disc.radius_m, size.wall_height};
  return looks;
}
MarkerLooks looks_of(const world::Box& box, const Dimensions& size) {
  MarkerLooks looks;
  looks.position = box.center;
  looks.angle_rad = box.angle_rad;
  looks.scale = {box.size.x, box.size.y, size.wall_height};
  return looks;
}
MarkerLooks looks_of(const world::Wall& wall, const Dimensions& size) {
  MarkerLooks looks;
  looks.position = 0.5 * (wall.from + wall.to);
  looks.angle_rad = angle_of(wall.to - wall.from);
  looks.scale = {distance(wall.from, wall.to), size.wall_thickness, size.wall_height};
  return looks;
}

// A grid of its own: write_map().
MarkerLooks looks_of(const world::FloorMap& /*map*/, const Dimensions& /*size*/) { return {}; }

void mark_obstacles(MarkerWriter& markers, const Setting& setting) {
  const Dimensions size(setting);
  for (std::size_t k = 0; k < setting.obstacles.size(); ++k) {
    if (std::holds_alternative<world::FloorMap>(setting.obstacles[k])) continue;
    MarkerLooks looks =
        std::visit([&](const auto& obstacle) { return looks_of(obstacle, size); }, setting.obstacles[k]);
    looks.layer = "obstacles";
    looks.z = size.wall_height / 2.0;
    looks.color = palette::obstacle;
    markers.one(k, looks);
  }
}

// {} of a pattern replaced by the robot's index.
void name_body(std::string& name, std::string_view pattern, std::size_t robot) {
  const std::string number = std::to_string(robot);
  name = pattern;
  for (std::size_t at = name.find("{}"); at != std::string::npos; at = name.find("{}", at + number.size()))
    name.replace(at, 2, number);
}

}  // namespace

void CdrWriter::clear() { bytes_.assign({0, 1, 0, 0}); }  // CDR_LE, no options

template <class Unsigned> void CdrWriter::put(Unsigned value) {
  constexpr std::size_t size = sizeof(Unsigned);
  const std::size_t over = (bytes_.size() - encapsulation_bytes) % size;
  char bytes[2 * size] = {};
  for (std::size_t k = 0; k < size; ++k) bytes[size + k] = static_cast<char>(value >> (8 * k));
  const std::size_t padding = over == 0 ? 0 : size - over;
  bytes_.append(bytes + size - padding, size + padding);
}

void CdrWriter::natural(std::uint32_t value) { put(value); }
void CdrWriter::real(float value) { put(std::bit_cast<std::uint32_t>(value)); }
void CdrWriter::real(double value) { put(std::bit_cast<std::uint64_t>(value)); }

void CdrWriter::string(std::string_view text) {
  put(static_cast<std::uint32_t>(text.size() + 1));
  bytes_.append(text);
  bytes_.push_back('\0');
}

void CdrWriter::time(std::uint64_t nanoseconds) {
  constexpr std::uint64_t second = 1000000000;
  put(static_cast<std::uint32_t>(nanoseconds / second));
  put(static_cast<std::uint32_t>(nanoseconds % second));
}

std::size_t CdrWriter::sequence() {
  put(std::uint32_t{0});
  return bytes_.size() - sizeof(std::uint32_t);
}

void CdrWriter::set_length(std::size_t sequence, std::uint32_t length) noexcept {
  for (std::size_t k = 0; k < sizeof length; ++k) bytes_[sequence + k] = static_cast<char>(length >> (8 * k));
}

MessageType markers_type() {
  return {"visualization_msgs/msg/MarkerArray",
          with_parts("visualization_msgs/Marker[] markers\n",
                     {marker_part, header_part, time_part, duration_part, pose_part, point_part, quaternion_part,
                      vector_part, color_part, texture_part, corner_part, mesh_part})};
}

MessageType transforms_type() {
  return {"tf2_msgs/msg/TFMessage",
          with_parts("geometry_msgs/TransformStamped[] transforms\n",
                     {stamped_part, header_part, time_part, transform_part, vector_part, quaternion_part})};
}

MessageType map_type() {
  return {"nav_msgs/msg/OccupancyGrid",
          with_parts(map_definition, {header_part, time_part, map_info_part, pose_part, point_part, quaternion_part})};
}

MessageType log_type() { return {"rcl_interfaces/msg/Log", with_parts(log_definition, {time_part})}; }

std::uint16_t add_channel(mcap::Writer& file, std::string_view topic, MessageType type, mcap::ChunkGroup group) {
  const std::uint16_t schema = file.add_schema(std::string(type.name), "ros2msg", std::move(type.definition));
  return file.add_channel(schema, std::string(topic), "cdr", {}, group);
}

void write_transforms(CdrWriter& out, const Stamp& stamp, const Frame& frame) {
  out.clear();
  out.natural(static_cast<std::uint32_t>(frame.robots.size()));
  std::string body;
  for (std::size_t i = 0; i < frame.robots.size(); ++i) {
    const RobotFrame& robot = frame.robots[i];
    put_header(out, stamp);
    name_body(body, stamp.body, i);
    out.string(body);
    put_xyz(out, rounded(robot.position.x, steps_per_m), rounded(robot.position.y, steps_per_m), 0.0);
    put_turn(out, robot.heading_rad);
  }
}

void write_markers(CdrWriter& out, const Stamp& stamp, const Setting& setting, const Frame& frame,
                   const RadioLinks* links) {
  out.clear();
  MarkerWriter markers(out, stamp, setting.radius_m);
  markers.delete_all();
  mark_robots(markers, setting, frame);
  mark_trees(markers, setting, frame);
  if (links != nullptr) mark_links(markers, setting, frame, *links);
  mark_targets(markers, setting, frame);
  mark_obstacles(markers, setting);
  markers.finish();
}

void write_map(CdrWriter& out, const Stamp& stamp, const world::FloorMap& map) {
  constexpr std::uint8_t free = 0, occupied = 100;
  const world::CellGrid& cells = *map.cells;
  out.clear();
  put_header(out, stamp);
  out.time(stamp.nanoseconds);
  out.real(static_cast<float>(map.cell_m));
  out.natural(static_cast<std::uint32_t>(cells.columns()));
  out.natural(static_cast<std::uint32_t>(cells.rows()));
  put_xyz(out, map.origin.x, map.origin.y, 0.0);
  put_turn(out, map.angle_rad);
  out.natural(static_cast<std::uint32_t>(cells.columns() * cells.rows()));
  for (std::size_t row = 0; row < cells.rows(); ++row)
    for (std::size_t column = 0; column < cells.columns(); ++column)
      out.octet(cells.occupied(static_cast<std::int64_t>(column), static_cast<std::int64_t>(row)) ? occupied : free);
}

std::uint64_t MapTopics::write(mcap::Writer& file, CdrWriter& out, const Stamp& stamp, const Setting& setting,
                               mcap::ChunkGroup group) {
  std::uint64_t messages = 0;
  std::size_t index = 0;
  for (const world::Obstacle& obstacle : setting.obstacles) {
    const auto* map = std::get_if<world::FloorMap>(&obstacle);
    if (map == nullptr) continue;
    const std::size_t k = index++;
    if (k == channels_.size()) {
      const std::string topic = std::string(map_topic) + (k == 0 ? "" : "_" + std::to_string(k + 1));
      channels_.push_back(add_channel(file, topic, map_type(), group));
      last_.emplace_back();
    }
    if (last_[k] == *map) continue;
    last_[k] = *map;
    write_map(out, stamp, *map);
    file.message(channels_[k], stamp.nanoseconds, out.view());
    ++messages;
  }
  return messages;
}

void write_odometry(CdrWriter& out, const Stamp& stamp, std::size_t robot, const RobotFrame& now,
                    const RobotFrame& before, double elapsed_s) {
  constexpr int covariances = 36;
  const auto put_zeros = [&](int count) {
    for (int k = 0; k < count; ++k) out.real(0.0);
  };
  std::string body;
  name_body(body, stamp.body, robot);
  Vec2 velocity;
  double turn_rad_s = 0.0;
  if (elapsed_s > 0.0) {
    const Vec2 ahead = unit_vector(now.heading_rad), moved = (1.0 / elapsed_s) * (now.position - before.position);
    velocity = {dot(moved, ahead), cross(ahead, moved)};
    turn_rad_s = std::remainder(now.heading_rad - before.heading_rad, 2.0 * std::numbers::pi) / elapsed_s;
  }
  out.clear();
  put_header(out, stamp);
  out.string(body);
  put_xyz(out, now.position.x, now.position.y, 0.0);
  put_turn(out, now.heading_rad);
  put_zeros(covariances);
  put_xyz(out, velocity.x, velocity.y, 0.0);
  put_xyz(out, 0.0, 0.0, turn_rad_s);
  put_zeros(covariances);
}

void write_clock(CdrWriter& out, const Stamp& stamp) {
  out.clear();
  out.time(stamp.nanoseconds);
}

std::vector<Diagnosis> diagnose(const measure::Tick& tick, std::size_t robots) {
  using Level = Diagnosis::Level;
  const auto number = [](std::size_t value) { return std::to_string(value); };
  const std::size_t broken = tick.broken_by_distance + tick.broken_by_occlusion + tick.broken_by_death;
  const std::size_t dead = robots - std::min<std::size_t>(robots, tick.alive);
  const std::string held = number(tick.targets_reached) + " of " + number(tick.active_targets) + " targets held";
  std::vector<Diagnosis> parts{{Level::ok, "banyan: mission", tick.complete() ? "complete" : held, {}},
                               {Level::ok, "banyan: network", "in one part", {}},
                               {Level::ok, "banyan: robots", "all alive", {}}};
  Diagnosis &mission = parts[0], &network = parts[1], &bodies = parts[2];
  mission.values = {{"complete", tick.complete() ? "true" : "false"},
                    {"targets", number(tick.active_targets)},
                    {"targets held", number(tick.targets_reached)}};
  if (tick.components > 1) {
    network.level = Level::error;
    network.message = "in " + number(tick.components) + " parts";
  } else if (broken > 0) {
    network.level = Level::warning;
    network.message = number(broken) + (broken == 1 ? " broken edge" : " broken edges");
  }
  network.values = {
      {"parts", number(tick.components)}, {"edges", number(tick.edges)}, {"broken edges", number(broken)}};
  if (tick.alive == 0) {
    bodies.level = Level::error;
    bodies.message = "none alive";
  } else if (dead > 0 || tick.roots > 1) {
    bodies.level = Level::warning;
    bodies.message = dead > 0 ? number(dead) + " of " + number(robots) + " dead" : number(tick.roots) + " roots";
  }
  bodies.values = {
      {"robots", number(robots)},        {"alive", number(tick.alive)},           {"roots", number(tick.roots)},
      {"workers", number(tick.workers)}, {"connectors", number(tick.connectors)}, {"spares", number(tick.spares)}};
  return parts;
}

void write_diagnostics(CdrWriter& out, const Stamp& stamp, std::span<const Diagnosis> parts) {
  out.clear();
  out.time(stamp.nanoseconds);
  out.string("");  // frame_id
  out.natural(static_cast<std::uint32_t>(parts.size()));
  for (const Diagnosis& part : parts) {
    out.octet(static_cast<std::uint8_t>(part.level));
    out.string(part.name);
    out.string(part.message);
    out.string("");  // hardware_id
    out.natural(static_cast<std::uint32_t>(part.values.size()));
    for (const auto& [key, value] : part.values) {
      out.string(key);
      out.string(value);
    }
  }
}

void write_log(CdrWriter& out, const Stamp& stamp, const RecordedEvent& event) {
  constexpr std::uint8_t info = 20, warning = 30;
  const bool bad =
      event.kind == "death" || event.kind == "split" || event.kind == "edges_broken" || event.kind == "refused";
  out.clear();
  out.time(stamp.nanoseconds);
  out.octet(bad ? warning : info);
  out.string("banyan." + event.kind);
  out.string(event.text);
  out.string("");  // file,
  out.string("");  // function,
  out.natural(0);  // line
}

}  // namespace banyan::record::ros2
