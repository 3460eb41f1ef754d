// SPDX-License-Identifier: MIT
// The JSON messages of a recording (frame_json.hpp).
#include "frame_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <type_traits>

#include "banyan/record/json.hpp"
#include "cell.hpp"
#include "message_json.hpp"

namespace banyan::record {

using nlohmann::json;

namespace {

// One array of a frame: a number per robot. Whole numbers are exact in a double.
struct FrameField {
  std::string_view key;
  std::string_view meaning;
  int decimals;
  double minimum, maximum;
  double (*get)(const RobotFrame&);
  void (*set)(RobotFrame&, double);
  bool optional = false;  // left out where it is 0 for all robots
};

constexpr double far = 1e12;                      // m: beyond, a position is damage
constexpr double last_index = most_robots - 1.0;  // of a robot or a target
constexpr double most_of_event = 4294967294.0;

template <auto member> double get(const RobotFrame& robot) { return static_cast<double>(robot.*member); }
template <auto member> void set(RobotFrame& robot, double value) {
  robot.*member = static_cast<std::remove_reference_t<decltype(robot.*member)>>(value);
}
template <auto member>
constexpr FrameField whole(std::string_view key, double minimum, double maximum, std::string_view meaning) {
  return {key, meaning, 0, minimum, maximum, get<member>, set<member>};
}
template <auto member>
constexpr FrameField real(std::string_view key, int decimals, double minimum, double maximum,
                          std::string_view meaning) {
  return {key, meaning, decimals, minimum, maximum, get<member>, set<member>};
}

constexpr FrameField if_any(FrameField field) {
  field.optional = true;
  return field;
}

using R = RobotFrame;
constexpr std::array<FrameField, 20> of_robot{{
    {"x_m", "position", 4, -far, far, [](const R& r) { return r.position.x; },
     [](R& r, double v) { r.position.x = v; }},
    {"y_m", "position", 4, -far, far, [](const R& r) { return r.position.y; },
     [](R& r, double v) { r.position.y = v; }},
    real<&R::heading_rad>("heading_rad", 4, -7, 7, "heading, (-pi, pi]"),
    whole<&R::role>("role", 0, 3, "0 spare, 1 connector, 2 worker, 3 root"),
    whole<&R::phase>("phase", 0, 4, "0 init, 1 start_tree, 2 select_parent, 3 grow_tree, 4 select_root"),
    whole<&R::need>("need", 0, 2, "of the edge to the parent: 0 no_need, 1 need, 2 await"),
    whole<&R::spare_state>("spare_state", 0, 2, "of a spare: 0 wait, 1 extend_edge, 2 adjust_position"),
    whole<&R::alive>("alive", 0, 1, "0: dead"),
    whole<&R::connected>("connected", 0, 1, "1: alive and in the root's radio component"),
    whole<&R::epoch>("epoch", 0, 65535, "counts the trees"),
    real<&R::label_m>("label_m", 3, -1, far, "distance to the root along hops when the epoch began, -1: unknown"),
    whole<&R::depth>("depth", 0, 65535, "in the tree, root 1; 0: no path of tree edges to the root"),
    whole<&R::parent>("parent", -1, last_index, "robot index, -1: nobody"),
    whole<&R::old_parent>("old_parent", -1, last_index, "in the old tree while trees are switched, -1: nobody"),
    whole<&R::grant>("grant", -1, last_index, "the spare let into the edge to the parent, -1: nobody"),
    whole<&R::request>("request", -1, last_index, "the owner of the edge a spare wants to join, -1: nobody"),
    real<&R::want_m>("want_m", 3, 0, far, "largest remaining worker distance below"),
    whole<&R::target>("target", -1, last_index, "index of the target the robot serves, -1: none"),
    if_any(whole<&R::raised>("raised", 0, 1,
                             "where sight leaks, 1: the antenna looks over bodies; left out if none does")),
    if_any(real<&R::spent>("spent", 3, 0, 1,
                           "share of the battery that is used up; left out where all are full, or without batteries")),
}};

void key(Text& out, std::string_view name) {
  out.put('"');
  out.put(name);
  out.put("\":");
}

void write_stamp(Text& out, std::uint64_t tick, double time_s) {
  out.put("{\"tick\":");
  out.natural(tick);
  out.put(",\"time_s\":");
  out.fixed(time_s, 4);
}

template <class Items, class Put>
void array(Text& out, std::string_view name, const Items& items, const Put& put_item) {
  out.put(',');
  key(out, name);
  out.put('[');
  for (const auto& item : items) {
    put_item(item);
    out.put(',');
  }
  if (!items.empty()) out.drop_last();
  out.put(']');
}

void write_whole(Text& out, double value) { out.small_integer(static_cast<std::int64_t>(value)); }

[[noreturn]] void fail(std::string_view name, std::string_view what) {
  throw std::runtime_error("'" + std::string(name) + "' " + std::string(what));
}

const json& member(const json& object, std::string_view name) {
  const auto found = object.find(std::string(name));
  if (found == object.end()) fail(name, "is missing");
  return *found;
}

double number(const json& value, std::string_view name, double minimum, double maximum) {
  if (!value.is_number()) fail(name, "is not a number");
  const double v = value.get<double>();
  if (!(v >= minimum && v <= maximum)) fail(name, "is out of range");
  return v;
}

double number_of(const json& object, std::string_view name, double minimum, double maximum) {
  return number(member(object, name), name, minimum, maximum);
}

std::string text_of(const json& object, std::string_view name) {
  const json& value = member(object, name);
  if (!value.is_string()) fail(name, "is not a text");
  return value.get<std::string>();
}

bool flag_of(const json& object, std::string_view name) {
  const json& value = member(object, name);
  if (!value.is_boolean()) fail(name, "is not true or false");
  return value.get<bool>();
}

constexpr double most_ticks = 9007199254740992.0;  // 2^53: exact in JSON readers that use doubles

std::uint64_t count_of(const json& object, std::string_view name, double maximum = most_ticks) {
  const json& value = member(object, name);
  (void)number(value, name, 0.0, maximum);
  if (value.is_number_unsigned()) return value.get<std::uint64_t>();
  return static_cast<std::uint64_t>(number(value, name, 0.0, most_ticks));
}

json parse_object(std::string_view text) {
  json object = json::parse(text, nullptr, false);
  if (object.is_discarded() || !object.is_object()) throw std::runtime_error("is not a JSON object");
  return object;
}

const json& array_of(const json& object, std::string_view name, std::size_t size) {
  const json& values = member(object, name);
  if (!values.is_array()) fail(name, "is not an array");
  if (values.size() != size) fail(name, "has another length than 'x_m'");
  return values;
}

void write_point(Text& out, std::string_view name, Vec2 p) {
  key(out, name);
  out.put('[');
  out.shortest(p.x);
  out.put(',');
  out.shortest(p.y);
  out.put(']');
}

struct ObstacleWriter {
  Text& out;
  void operator()(const world::Disc& disc) const {
    out.put("{\"disc\":true,");
    write_point(out, "center_m", disc.center);
    out.put(",\"radius_m\":");
    out.shortest(disc.radius_m);
    out.put('}');
  }
  void operator()(const world::Box& box) const {
    out.put("{\"box\":true,");
    write_point(out, "center_m", box.center);
    out.put(',');
    write_point(out, "size_m", box.size);
    out.put(",\"angle_rad\":");
    out.shortest(box.angle_rad);
    out.put('}');
  }
  void operator()(const world::Wall& wall) const {
    out.put("{\"wall\":true,");
    write_point(out, "from_m", wall.from);
    out.put(',');
    write_point(out, "to_m", wall.to);
    out.put('}');
  }
  void operator()(const world::FloorMap& map) const {
    out.put("{\"map\":true,");
    write_point(out, "origin_m", map.origin);
    out.put(",\"resolution_m\":");
    out.shortest(map.cell_m);
    out.put(",\"angle_rad\":");
    out.shortest(map.angle_rad);
    out.put(",\"cells\":");
    out.json_string(map.cells->text());
    out.put('}');
  }
};

Vec2 point_of(const json& object, std::string_view name) {
  const json& p = member(object, name);
  if (!p.is_array() || p.size() != 2) fail(name, "is not a point");
  return {number(p[0], name, -far, far), number(p[1], name, -far, far)};
}

world::Obstacle read_obstacle(const json& o) {
  if (!o.is_object()) fail("obstacles", "holds something that is no object");
  if (o.contains("disc")) return world::Disc{point_of(o, "center_m"), number_of(o, "radius_m", 0.0, far)};
  if (o.contains("box")) {
    return world::Box{point_of(o, "center_m"), point_of(o, "size_m"), number_of(o, "angle_rad", -far, far)};
  }
  if (o.contains("wall")) return world::Wall{point_of(o, "from_m"), point_of(o, "to_m")};
  if (o.contains("map")) {
    world::FloorMap map;
    map.cell_m = number_of(o, "resolution_m", 1e-9, far);
    map.origin = point_of(o, "origin_m");
    map.angle_rad = number_of(o, "angle_rad", -far, far);
    const std::string text = text_of(o, "cells");
    if (world::CellGrid::text_fault(text)) fail("obstacles", "holds a map whose cells are none");
    map.cells = std::make_shared<const world::CellGrid>(world::CellGrid::from_text(text));
    return map;
  }
  fail("obstacles", "holds something unknown");
}

void schema_head(Text& out, std::string_view title, std::string_view description) {
  out.put("{\"title\":");
  out.json_string(title);
  out.put(",\"description\":");
  out.json_string(description);
  out.put(",\"type\":\"object\",\"properties\":{\"tick\":{\"type\":\"integer\"},\"time_s\":{\"type\":\"number\"}");
}

void schema_property(Text& out, std::string_view name, std::string_view type, std::string_view meaning) {
  out.put(',');
  out.json_string(name);
  out.put(":{\"type\":");
  out.json_string(type);
  out.put(",\"description\":");
  out.json_string(meaning);
  out.put('}');
}

void schema_array(Text& out, std::string_view name, std::string_view type, std::string_view meaning) {
  out.put(',');
  out.json_string(name);
  out.put(":{\"type\":\"array\",\"items\":{\"type\":");
  out.json_string(type);
  out.put("},\"description\":");
  out.json_string(meaning);
  out.put('}');
}

}  // namespace

std::uint64_t nanoseconds(double time_s) noexcept {
  return time_s > 0.0 ? static_cast<std::uint64_t>(std::min(time_s, 9e9) * 1e9 + 0.5) : 0;
}

std::span<const FrameColumn> frame_columns() noexcept {
  static constexpr auto columns = [] {
    std::array<FrameColumn, of_robot.size()> list{};
    for (std::size_t c = 0; c < of_robot.size(); ++c) list[c] = {of_robot[c].key, of_robot[c].meaning};
    return list;
  }();
  return columns;
}

void pack(const Frame& frame, std::vector<double>& into) {
  into.resize(of_robot.size() * frame.robots.size());
  double* at = into.data();
  for (const FrameField& field : of_robot)
    for (const RobotFrame& robot : frame.robots) *at++ = field.get(robot);
}

void write_frame(Text& out, const Frame& frame) {
  write_stamp(out, frame.tick, frame.time_s);
  for (const FrameField& field : of_robot) {
    const auto is_zero = [&](const RobotFrame& robot) { return field.get(robot) == 0.0; };
    if (field.optional && std::all_of(frame.robots.begin(), frame.robots.end(), is_zero)) continue;
    array(out, field.key, frame.robots, [&](const RobotFrame& robot) {
      const double value = field.get(robot);
      field.decimals == 0 ? write_whole(out, value) : out.fixed(value, field.decimals);
    });
  }
  out.put('}');
}

void write_messages(Text& out, std::uint64_t tick, double time_s, const MessageNumbers& messages) {
  write_stamp(out, tick, time_s);
  const std::size_t count = messages.fields.size();
  for (std::size_t f = 0; f < count; ++f) {
    const FieldInfo& field = messages.fields[f];
    if (!is_recorded(field)) continue;
    out.put(',');
    key(out, field.name);
    out.put('[');
    for (std::size_t at = f; at < messages.numbers.size(); at += count) {
      field.decimals == 0 ? write_whole(out, messages.numbers[at]) : out.fixed(messages.numbers[at], field.decimals);
      out.put(',');
    }
    if (!messages.empty()) out.drop_last();
    out.put(']');
  }
  out.put('}');
}

void read_frame(std::string_view text, Frame& frame) {
  const json object = parse_object(text);
  frame.tick = count_of(object, "tick");
  frame.time_s = number_of(object, "time_s", 0.0, 9e9);
  const json& first = member(object, "x_m");
  if (!first.is_array()) fail("x_m", "is not an array");
  frame.robots.assign(first.size(), {});
  for (const FrameField& field : of_robot) {
    if (field.optional && !object.contains(field.key)) continue;
    const json& values = array_of(object, field.key, frame.robots.size());
    for (std::size_t i = 0; i < frame.robots.size(); ++i) {
      field.set(frame.robots[i], number(values[i], field.key, field.minimum, field.maximum));
    }
  }
}

void write_targets(Text& out, const Frame& frame) {
  write_stamp(out, frame.tick, frame.time_s);
  array(out, "x_m", frame.targets, [&](const TargetFrame& t) { out.fixed(t.position.x, 4); });
  array(out, "y_m", frame.targets, [&](const TargetFrame& t) { out.fixed(t.position.y, 4); });
  array(out, "worker", frame.targets, [&](const TargetFrame& t) { out.integer(t.worker); });
  array(out, "active", frame.targets, [&](const TargetFrame& t) { out.put(t.active ? '1' : '0'); });
  out.put('}');
}

std::vector<TargetFrame> read_targets(std::string_view text) {
  const json object = parse_object(text);
  const json& x = member(object, "x_m");
  if (!x.is_array()) fail("x_m", "is not an array");
  const json& y = array_of(object, "y_m", x.size());
  const json& worker = array_of(object, "worker", x.size());
  const json& active = array_of(object, "active", x.size());
  std::vector<TargetFrame> targets;
  for (std::size_t k = 0; k < x.size(); ++k) {
    targets.push_back({{number(x[k], "x_m", -far, far), number(y[k], "y_m", -far, far)},
                       static_cast<std::int32_t>(number(worker[k], "worker", -1.0, last_index)),
                       number(active[k], "active", 0.0, 1.0) != 0.0});
  }
  return targets;
}

void write_metrics(Text& out, const measure::Tick& tick) {
  out.put('{');
  for (const auto& column : series_columns()) {
    key(out, column.name);
    write_cell_json(out, column.cell(tick), column.decimals);
    out.put(',');
  }
  out.drop_last();
  out.put('}');
}

measure::Tick read_metrics(std::string_view text) {
  const json o = parse_object(text);
  const auto count = [&](std::string_view name) { return static_cast<std::uint32_t>(count_of(o, name, 4294967295.0)); };
  measure::Tick t;
  t.tick = count_of(o, "tick");
  t.time_s = number_of(o, "time_s", 0.0, 9e9);
  t.alive = count("alive");
  t.roots = count("roots");
  t.workers = count("workers");
  t.connectors = count("connectors");
  t.spares = count("spares");
  t.committed = count("committed");
  t.edges = count("edges");
  t.broken_by_distance = count("broken_by_distance");
  t.broken_by_occlusion = count("broken_by_occlusion");
  t.broken_after_silence = count("broken_after_silence");
  t.components = count("components");
  t.components_by_distance = count("components_by_distance");
  t.fiedler_low = flag_of(o, "fiedler_low");
  t.fiedler_low_by_distance = flag_of(o, "fiedler_low_by_distance");
  t.fiedler = member(o, "fiedler").is_null() ? -1.0 : number_of(o, "fiedler", 0.0, far);
  t.worst_target_distance_m = number_of(o, "worst_target_distance_m", 0.0, far);
  t.targets_reached = count("targets_reached");
  return t;
}

void write_event(Text& out, const RecordedEvent& event) {
  write_stamp(out, event.tick, event.time_s);
  out.put(",\"kind\":");
  out.json_string(event.kind);
  out.put(",\"robot\":");
  out.integer(event.robot);
  out.put(",\"target\":");
  out.integer(event.target);
  out.put(",\"text\":");
  out.json_string(event.text);
  out.put('}');
}

RecordedEvent read_event(std::string_view text) {
  const json o = parse_object(text);
  RecordedEvent event;
  event.tick = count_of(o, "tick");
  event.time_s = number_of(o, "time_s", 0.0, 9e9);
  event.kind = text_of(o, "kind");
  event.robot = static_cast<std::int64_t>(number_of(o, "robot", -1.0, most_of_event));
  event.target = static_cast<std::int64_t>(number_of(o, "target", -1.0, most_of_event));
  event.text = text_of(o, "text");
  return event;
}

void write_setting(Text& out, const Setting& s) {
  const auto text = [&](std::string_view name, std::string_view value) {
    key(out, name);
    out.json_string(value);
    out.put(',');
  };
  const auto real = [&](std::string_view name, double value) {
    key(out, name);
    out.shortest(value);
    out.put(',');
  };
  out.put('{');
  text("name", s.name);
  text("algorithm", s.algorithm);
  text("reading", s.reading);
  key(out, "seed");
  out.natural(s.seed);
  out.put(',');
  real("tick_s", s.tick_s);
  real("radius_m", s.radius_m);
  real("range_m", s.range_m);
  key(out, "line_of_sight");
  out.put(s.line_of_sight ? "true," : "false,");
  real("sight_leak", s.sight_leak);
  key(out, "dead_bodies");
  out.put(s.dead_bodies ? "true," : "false,");
  real("target_tolerance_m", s.target_tolerance_m);
  real("time_limit_s", s.time_limit_s);
  if (!s.names.empty()) {
    key(out, "names");
    out.put('[');
    for (const std::string& name : s.names) {
      out.json_string(name);
      out.put(',');
    }
    out.drop_last();
    out.put("],");
  }
  key(out, "obstacles");
  out.put('[');
  for (const world::Obstacle& obstacle : s.obstacles) {
    std::visit(ObstacleWriter{out}, obstacle);
    out.put(',');
  }
  if (!s.obstacles.empty()) out.drop_last();
  out.put("]}");
}

Setting read_setting(std::string_view text) {
  const json o = parse_object(text);
  Setting s;
  s.name = text_of(o, "name");
  s.algorithm = text_of(o, "algorithm");
  s.reading = text_of(o, "reading");
  s.seed = count_of(o, "seed", 18446744073709551615.0);
  s.tick_s = number_of(o, "tick_s", 1e-9, far);
  s.radius_m = number_of(o, "radius_m", 0.0, far);
  s.range_m = number_of(o, "range_m", 0.0, far);
  s.line_of_sight = flag_of(o, "line_of_sight");
  s.sight_leak = number_of(o, "sight_leak", 0.0, 1.0);
  s.dead_bodies = flag_of(o, "dead_bodies");
  s.target_tolerance_m = number_of(o, "target_tolerance_m", 0.0, far);
  s.time_limit_s = number_of(o, "time_limit_s", 0.0, far);
  if (const auto names = o.find("names"); names != o.end()) {
    if (!names->is_array()) fail("names", "is not an array");
    for (const json& name : *names) {
      if (!name.is_string()) fail("names", "holds something that is no text");
      s.names.push_back(name.get<std::string>());
    }
  }
  const json& obstacles = member(o, "obstacles");
  if (!obstacles.is_array()) fail("obstacles", "is not an array");
  for (const json& obstacle : obstacles) s.obstacles.push_back(read_obstacle(obstacle));
  return s;
}

std::string frame_schema() {
  Text out;
  schema_head(out, "banyan.Frame",
              "All robots at one tick: arrays with one number per robot, in the order of their indices");
  for (const FrameField& field : of_robot) {
    schema_array(out, field.key, field.decimals == 0 ? "integer" : "number", field.meaning);
  }
  out.put("},\"required\":[\"tick\",\"time_s\"");
  for (const FrameField& field : of_robot) {
    if (field.optional) continue;
    out.put(',');
    out.json_string(field.key);
  }
  out.put("]}");
  return std::string(out.view());
}

std::string messages_schema(std::span<const FieldInfo> fields) {
  Text out;
  schema_head(out, "banyan.Messages",
              "What each robot broadcast last: arrays with one number per robot, in the order of their indices. "
              "What /banyan/frame says at the same time is not repeated");
  for (const FieldInfo& field : fields) {
    if (!is_recorded(field)) continue;
    schema_array(out, field.name, field.decimals == 0 ? "integer" : "number", field.meaning);
  }
  out.put("}}");
  return std::string(out.view());
}

std::string targets_schema() {
  Text out;
  schema_head(out, "banyan.Targets", "All targets; written at the start and whenever one changes");
  schema_array(out, "x_m", "number", "position");
  schema_array(out, "y_m", "number", "position");
  schema_array(out, "worker", "integer", "index of the robot first sent to the target, -1: nobody");
  schema_array(out, "active", "integer", "0: the target has been given up");
  out.put("},\"required\":[\"tick\",\"time_s\",\"x_m\",\"y_m\",\"worker\"]}");
  return std::string(out.view());
}

std::string metrics_schema() {
  Text out;
  out.put(
      "{\"title\":\"banyan.Metrics\",\"description\":\"Connectivity and progress at one tick, ground truth\","
      "\"type\":\"object\",\"properties\":{");
  for (const auto& column : series_columns()) {
    const Cell cell = column.cell({});
    out.json_string(column.name);
    out.put(":{\"type\":");
    if (std::holds_alternative<bool>(cell)) out.put("\"boolean\"");
    else if (std::holds_alternative<std::uint64_t>(cell)) out.put("\"integer\"");
    else if (std::holds_alternative<double>(cell)) out.put("\"number\"");
    else out.put("[\"number\",\"null\"]");
    out.put(",\"description\":");
    out.json_string(column.meaning);
    out.put("},");
  }
  out.drop_last();
  out.put("},\"required\":[");
  for (const auto& column : series_columns()) {
    out.json_string(column.name);
    out.put(',');
  }
  out.drop_last();
  out.put("]}");
  return std::string(out.view());
}

std::string setting_schema() {
  Text out;
  out.put(
      "{\"title\":\"banyan.Setting\",\"description\":\"What a picture needs beside a frame; written at the start "
      "and whenever it changes\",\"type\":\"object\",\"properties\":{\"name\":{\"type\":\"string\"}");
  schema_property(out, "algorithm", "string", "by its name in `banyan algorithms`");
  schema_property(out, "reading", "string", "literal or corrected");
  schema_property(out, "seed", "integer", "of the run");
  schema_property(out, "tick_s", "number", "length of a tick");
  schema_property(out, "radius_m", "number", "of a robot");
  schema_property(out, "range_m", "number", "of the radio");
  schema_property(out, "line_of_sight", "boolean", "whether a link needs one");
  schema_property(out, "sight_leak", "number",
                  "share of the lines of sight past one body over which packets get through");
  schema_property(out, "dead_bodies", "boolean", "whether the dead hide what is behind them");
  schema_property(out, "target_tolerance_m", "number", "distance at which a target is reached");
  schema_property(out, "time_limit_s", "number", "of the mission");
  schema_array(out, "names", "string", "of robots, in their order; left out where they have numbers alone");
  schema_array(out, "obstacles", "object", "discs, boxes, walls and maps");
  out.put("}}");
  return std::string(out.view());
}

std::string event_schema() {
  Text out;
  schema_head(out, "banyan.Event", "Something that happened between two ticks");
  schema_property(out, "kind", "string", "death, root, inserted, edges_broken, arrival, complete, ...");
  schema_property(out, "robot", "integer", "the robot it is about, -1: none");
  schema_property(out, "target", "integer", "the target it is about, -1: none");
  schema_property(out, "text", "string", "in words");
  out.put("},\"required\":[\"tick\",\"time_s\",\"kind\",\"robot\",\"target\",\"text\"]}");
  return std::string(out.view());
}

}  // namespace banyan::record
