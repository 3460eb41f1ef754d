// SPDX-License-Identifier: MIT
#include "maps.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>

#include "banyan/config/table_reader.hpp"
#include "banyan/world/cell_grid.hpp"
#include "picture.hpp"
#include "yaml.hpp"

namespace banyan::config {
namespace {

using world::CellGrid;

constexpr std::size_t largest_picture = std::size_t{64} << 20;
constexpr std::size_t longest_cells = std::size_t{4}
                                      << 20;  // a file with them is read again, and read_text_file() allows 8

[[noreturn]] void fail(const std::string& path, int line, std::string text) {
  throw DocumentError({{std::make_shared<const std::string>(path), line}, "", std::move(text)});
}

// What a file of a map says.
struct MapText {
  std::string cells;
  std::optional<double> resolution_m;
  std::optional<world::Vec2> origin;
  std::optional<double> angle_rad;
};

// ---- Pictures ----

// How ROS makes cells of pixels: map_server of Navigation 2.
enum class Mode : std::uint8_t { trinary, scale, raw };
struct PixelReading {
  Mode mode = Mode::trinary;
  bool negate = false;
  double occupied_above = 0.65;
};

bool is_occupied(const PictureSamples& pixels, std::size_t pixel, const PixelReading& reading) {
  const std::uint8_t* sample = pixels.samples.data() + pixel * pixels.channels;
  const std::size_t colors = pixels.channels - (pixels.has_alpha() ? 1 : 0);
  if (reading.mode == Mode::scale && pixels.has_alpha() && sample[colors] < 255) return false;  // unknown
  // In the mode trinary the alpha counts like a colour.
  const std::size_t counted = reading.mode == Mode::trinary ? pixels.channels : colors;
  int sum = 0;
  for (std::size_t k = 0; k < counted; ++k) sum += sample[k];
  const double shade = static_cast<double>(sum) / (255.0 * static_cast<double>(counted));
  if (reading.mode == Mode::raw) return std::floor(shade * 255.0 + 0.5) == 100.0;
  return (reading.negate ? shade : 1.0 - shade) > reading.occupied_above;
}

std::string cells_of_picture(const std::string& path, const PixelReading& reading) {
  const std::variant<PictureSamples, std::string> read =
      read_picture(read_file(path, largest_picture), CellGrid::most_cells);
  if (const auto* fault = std::get_if<std::string>(&read)) fail(path, 0, *fault);
  const auto& pixels = std::get<PictureSamples>(read);
  std::vector<std::uint8_t> occupied(pixels.width * pixels.height);
  for (std::size_t row = 0; row < pixels.height; ++row)
    for (std::size_t column = 0; column < pixels.width; ++column)
      occupied[(pixels.height - 1 - row) * pixels.width + column] =
          is_occupied(pixels, row * pixels.width + column, reading) ? 1 : 0;
  return CellGrid(pixels.width, pixels.height, occupied).text();
}

// ---- ROS ----

// Where what a file names is.
std::string beside(const std::string& file, const std::string& name) {
  return (std::filesystem::path(file).parent_path() / name).string();
}

MapText read_ros_map(const std::string& path, std::vector<Problem>& problems) {
  const Node root = parse_yaml(path, read_text_file(path));
  if (root.table() == nullptr) fail(path, root.place.line, "a map of ROS is a table of keys, not " + root.describe());
  std::vector<Problem> found;
  TableReader table(root, "", found);
  MapText map;
  PixelReading reading;
  for (const char* key : {"image", "resolution", "origin"}) table.require(key);
  const std::string picture = table.text("image");
  map.resolution_m = table.number("resolution", Range{0.0, 1e8, true});
  if (const Node* origin = table.list("origin")) {
    std::vector<double> numbers;
    for (const Node& item : *origin->array())
      if (const auto* number = std::get_if<double>(&item.value)) numbers.push_back(*number);
    const bool sound = numbers.size() == origin->array()->size() && numbers.size() >= 2 && numbers.size() <= 3 &&
                       std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::abs(x) <= 1e8; });
    if (!sound) table.report("origin", "must be [x, y, yaw] in m and rad, not " + origin->describe());
    else map.origin = world::Vec2{numbers[0], numbers[1]};
    if (sound && numbers.size() == 3) map.angle_rad = std::remainder(numbers[2], 2.0 * 3.14159265358979323846);
  }
  if (const Node* negate = table.any("negate")) {
    const auto* truth = std::get_if<bool>(&negate->value);
    const auto* number = std::get_if<double>(&negate->value);
    if (truth == nullptr && (number == nullptr || (*number != 0.0 && *number != 1.0)))
      table.report("negate", "must be 0 or 1, not " + negate->describe());
    else reading.negate = truth != nullptr ? *truth : *number != 0.0;
  }
  reading.mode = static_cast<Mode>(table.choice("mode", {"trinary", "scale", "raw"}, 0));
  reading.occupied_above = table.number("occupied_thresh", reading.occupied_above, Range{0.0, 1.0});
  if (table.number("free_thresh", 0.0, Range{0.0, 1.0}) > reading.occupied_above)
    table.report("free_thresh", "must not be above occupied_thresh");
  const std::size_t faults = found.size();
  table.finish();
  for (std::size_t k = 0; k < found.size(); ++k) found[k].warning = k >= faults;  // ROS reads no other keys
  problems.insert(problems.end(), found.begin(), found.end());
  if (faults == 0) map.cells = cells_of_picture(beside(path, picture), reading);
  return map;
}

// ---- MovingAI ----

// A line of the text, cut off from it.
std::string_view cut_line(std::string_view& text) {
  const auto end = std::min(text.find('\n'), text.size());
  std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
  return line;
}

std::string read_moving_ai(const std::string& path) {
  const std::string whole = read_text_file(path);
  std::string_view text = whole;
  if (!cut_line(text).starts_with("type ")) fail(path, 1, "a map of MovingAI begins with \"type octile\"");
  const auto size = [&](const char* name, int line) {
    std::string_view words = cut_line(text);
    const std::string start = std::string(name) + " ";
    std::size_t number = 0;
    if (!words.starts_with(start) || words.size() <= start.size() || words.size() > start.size() + 8)
      fail(path, line, "must be \"" + start + "\" and a number of cells");
    for (const char c : words.substr(start.size())) {
      if (c < '0' || c > '9') fail(path, line, "must be \"" + start + "\" and a number of cells");
      number = 10 * number + static_cast<std::size_t>(c - '0');
    }
    return number;
  };
  const std::size_t rows = size("height", 2), columns = size("width", 3);
  if (cut_line(text) != "map") fail(path, 4, "must be \"map\"");
  if (rows == 0 || columns == 0 || columns > CellGrid::most_cells || rows > CellGrid::most_cells / columns)
    fail(path, 2,
         "has " + std::to_string(columns) + " x " + std::to_string(rows) + " cells; 1 to " +
             std::to_string(CellGrid::most_cells) + " are possible, as of 4096 x 4096");
  constexpr std::string_view free = ".GS", blocked = "@OTW";
  std::vector<std::uint8_t> occupied(rows * columns);
  for (std::size_t row = 0; row < rows; ++row) {
    const std::string_view line = cut_line(text);
    const int number = static_cast<int>(row) + 5;
    if (line.size() != columns)
      fail(path, number, "has " + std::to_string(line.size()) + " cells; line 3 says " + std::to_string(columns));
    for (std::size_t column = 0; column < columns; ++column) {
      const char c = line[column];
      if (free.find(c) == std::string_view::npos && blocked.find(c) == std::string_view::npos)
        fail(path, number, "has a '" + std::string(1, c) + "'; free are . G S, occupied @ O T W");
      occupied[(rows - 1 - row) * columns + column] = free.find(c) == std::string_view::npos ? 1 : 0;
    }
  }
  return CellGrid(columns, rows, occupied).text();
}

// ---- In the tree ----

bool is_ros_map(std::string_view path) { return path.ends_with(".yaml") || path.ends_with(".yml"); }

MapText read_map(const std::string& path, std::vector<Problem>& problems) {
  MapText map;
  if (is_ros_map(path)) map = read_ros_map(path, problems);
  else if (path.ends_with(".map")) map.cells = read_moving_ai(path);
  else map.cells = cells_of_picture(path, {});
  if (map.cells.size() > longest_cells)
    fail(path, 0,
         "has so ragged walls that they take " + std::to_string(map.cells.size() >> 20) +
             " MiB as text; at most 4 are possible: give it fewer cells");
  return map;
}

void erase_key(Node::Table& table, std::string_view name) {
  std::erase_if(table, [&](const Node::Member& member) { return member.name == name; });
}

// Where the scenario does not say it.
void add(Node::Table& table, const char* name, Node value) {
  const bool given = std::any_of(table.begin(), table.end(), [&](const auto& member) { return member.name == name; });
  if (!given) table.push_back({name, std::move(value)});
}

void put_cells(Node::Table& obstacle, const std::string& key, std::vector<Problem>& problems) {
  const auto at = std::find_if(obstacle.begin(), obstacle.end(), [](const auto& m) { return m.name == "file"; });
  const Node file = std::move(at->value);
  obstacle.erase(at);
  MapText map;
  map.cells = ".";  // stands in for what cannot be read, so that the rest can be checked
  const auto cells = std::find_if(obstacle.begin(), obstacle.end(), [](const auto& m) { return m.name == "cells"; });
  if (file.string() == nullptr) {
    problems.push_back({file.place, key, "must be the name of a file in quotes, not " + file.describe()});
  } else if (cells != obstacle.end() && cells->value.place.from_file() == file.place.from_file()) {
    problems.push_back({file.place, key, "give file or cells, not both"});
  } else if (cells != obstacle.end() && !cells->value.place.from_file()) {
    return;  // an option gives other cells
  } else {
    const bool relative = file.place.from_file() && std::filesystem::path(*file.string()).is_relative();
    const std::string path = relative ? beside(*file.place.origin, *file.string()) : *file.string();
    try {
      map = read_map(path, problems);
    } catch (const DocumentError& e) {
      Problem problem = e.problem;
      if (!problem.place.from_file()) problem = {file.place, key, path + ": " + problem.text};
      problems.push_back(std::move(problem));
    }
    if (map.cells.empty()) map.cells = ".";
    if (is_ros_map(path) && !map.resolution_m) map.resolution_m = 1.0;
  }
  erase_key(obstacle, "cells");
  const Place& place = file.place;
  if (map.resolution_m) add(obstacle, "resolution_m", {*map.resolution_m, place});
  if (map.origin) add(obstacle, "origin_m", {Node::Array{{map.origin->x, place}, {map.origin->y, place}}, place});
  if (map.angle_rad) add(obstacle, "angle_deg", {world::exact_degrees(*map.angle_rad), place});
  add(obstacle, "cells", {map.cells, place});
}

// The short form.
void move_to_obstacles(Node& root, std::vector<Problem>& problems) {
  const Node* given = root.find("map");
  if (given == nullptr) return;
  const Node map = *given;
  erase_key(*root.table(), "map");
  if (map.string() == nullptr) {
    problems.push_back({map.place, "map", "must be the name of a file in quotes, not " + map.describe()});
    return;
  }
  if (!is_ros_map(*map.string())) {
    problems.push_back({map.place, "map",
                        world::the_text(*map.string()) +
                            " is no YAML of ROS, and other maps have no scale: write [[obstacles]] with kind = "
                            "\"map\", file and resolution_m"});
    return;
  }
  if (root.find("obstacles") == nullptr) root.table()->push_back({"obstacles", {Node::Array{}, map.place}});
  Node::Array* obstacles = root.find("obstacles")->array();
  if (obstacles == nullptr) return;  // the reader says so
  obstacles->push_back({Node::Table{{"kind", {std::string("map"), map.place}}, {"file", map}}, map.place});
}

}  // namespace

void put_maps(Node& root, std::vector<Problem>& problems) {
  move_to_obstacles(root, problems);
  Node* obstacles = root.find("obstacles");
  if (obstacles == nullptr || obstacles->array() == nullptr) return;
  for (std::size_t i = 0; i < obstacles->array()->size(); ++i) {
    Node& obstacle = (*obstacles->array())[i];
    const Node* kind = obstacle.find("kind");
    const bool is_map = kind != nullptr && kind->string() != nullptr && *kind->string() == "map";
    if (is_map && obstacle.find("file") != nullptr)
      put_cells(*obstacle.table(), "obstacles[" + std::to_string(i) + "].file", problems);
  }
}

}  // namespace banyan::config
