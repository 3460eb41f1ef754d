// SPDX-License-Identifier: MIT
// One frame as an SVG picture (draw.hpp): a title, the map, a legend. Robots refer to a symbol for their role, and many
// lines of one kind share a path, which keeps a picture of 1,000 robots below a megabyte.
#include "banyan/record/draw.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <utility>

#include "banyan/controller/core/trig.hpp"
#include "banyan/record/palette.hpp"
#include "banyan/record/recording.hpp"
#include "banyan/world/obstacles.hpp"
#include "text.hpp"

namespace banyan::record {

namespace {

constexpr double margin_px = 24.0;
constexpr double title_px = 62.0;
constexpr Vec2 legend_px{118.0, 22.0};     // of an entry
constexpr double letter_px = 7.6;          // of 14 px in DejaVu Sans, the widest of the fonts to be expected
constexpr double smallest_robot_px = 3.4;  // radius; smaller ones could not be told apart in print
constexpr double smallest_spare_px = 2.2;  // of hundreds, which must not hide the tree
constexpr double legend_robot_px = 5.5;
constexpr Vec2 zoom_one_px{1280.0, 720.0};  // a picture of given size whose text is as large as elsewhere;
constexpr double smallest_zoom = 0.7;       // it goes with the picture, down to what can be read
constexpr double tallest = 1.25;            // height / width of the map at most
constexpr double most_m = 1e6;              // beyond, a position is damage and would hide the rest
// Lines that cross within one path cost a renderer far more than separate paths on top of each other.
constexpr std::size_t lines_per_path = 50;

struct PictureExtent {
  Vec2 low{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  Vec2 high{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};

  void add(Vec2 p, double around = 0.0) {
    if (!(std::fabs(p.x) < most_m && std::fabs(p.y) < most_m)) return;
    low = {std::min(low.x, p.x - around), std::min(low.y, p.y - around)};
    high = {std::max(high.x, p.x + around), std::max(high.y, p.y + around)};
  }
  void at_least(double size) {
    if (low.x > high.x) low = high = {};
    const Vec2 grow{std::max(0.0, size - (high.x - low.x)) / 2.0, std::max(0.0, size - (high.y - low.y)) / 2.0};
    low -= grow;
    high += grow;
  }
};

std::array<Vec2, 4> corners(const world::Box& box) {
  const Vec2 turn = unit_vector(box.angle_rad);
  const Vec2 h = box.size / 2.0;
  return {box.center + rotate(turn, Vec2{h.x, h.y}), box.center + rotate(turn, Vec2{-h.x, h.y}),
          box.center + rotate(turn, Vec2{-h.x, -h.y}), box.center + rotate(turn, Vec2{h.x, -h.y})};
}

std::array<Vec2, 4> corners(const world::FloorMap& map) {
  const world::CellFrame frame(map);
  const auto w = static_cast<double>(map.cells->columns()), h = static_cast<double>(map.cells->rows());
  return {frame.in_metres({0.0, 0.0}), frame.in_metres({w, 0.0}), frame.in_metres({w, h}), frame.in_metres({0.0, h})};
}

PictureExtent extent_of(const Setting& setting, const Frame& frame, const Trails& trails) {
  PictureExtent extent;
  for (const RobotFrame& robot : frame.robots) extent.add(robot.position, setting.radius_m);
  for (const TargetFrame& target : frame.targets) extent.add(target.position, setting.target_tolerance_m);
  for (const auto& trail : trails)
    for (const Vec2 p : trail) extent.add(p);
  for (const world::Obstacle& obstacle : setting.obstacles) {
    if (const auto* disc = std::get_if<world::Disc>(&obstacle)) extent.add(disc->center, disc->radius_m);
    if (const auto* box = std::get_if<world::Box>(&obstacle))
      for (const Vec2 corner : corners(*box)) extent.add(corner);
    if (const auto* wall = std::get_if<world::Wall>(&obstacle))
      for (const Vec2 end : {wall->from, wall->to}) extent.add(end);
    if (const auto* map = std::get_if<world::FloorMap>(&obstacle))
      for (const Vec2 corner : corners(*map)) extent.add(corner);
  }
  extent.at_least(setting.range_m);
  return extent;
}

// The largest of 1, 2, 5 times a power of ten that is not above `most`.
double nice_length(double most) {
  double unit = 1e-3;
  while (unit * 10.0 <= most) unit *= 10.0;
  return most >= 5.0 * unit ? 5.0 * unit : most >= 2.0 * unit ? 2.0 * unit : unit;
}

std::string in_decimals(double value, int decimals) {
  Text text;
  text.fixed(value, decimals);
  return std::string(text.view());
}

// SVG text from its parts: strings as they are, numbers in hundredths, points as two of them.
class Svg {
 public:
  template <class... Parts> void add(const Parts&... parts) { (part(parts), ...); }
  // Words that may hold anything.
  void escaped(std::string_view words) { out_.xml(words); }
  [[nodiscard]] std::string_view view() const { return out_.view(); }

 private:
  void part(std::string_view text) { out_.put(text); }
  void part(double number) { out_.fixed(number, 2); }
  void part(std::integral auto number) { out_.integer(static_cast<std::int64_t>(number)); }
  void part(Vec2 p) { add(p.x, " ", p.y); }
  Text out_;
};

struct Stroke {
  std::string_view color;
  double width_px;
  std::string_view more = {};  // attributes
};
constexpr std::string_view round_ends = R"( stroke-linecap="round" stroke-linejoin="round")";

class Picture {
 public:
  Picture(const Setting& setting, const Frame& frame, const Trails& trails, const PictureOptions& options)
      : setting_(setting),
        frame_(frame),
        trails_(trails),
        options_(options),
        theme_(options.dark ? palette::dark : palette::light),
        links_(radio_links(setting, frame)),
        extent_(extent_of(setting, frame, trails)) {
    if (options.view) {
      extent_.low = options.view->low;
      extent_.high = options.view->high;
      extent_.at_least(setting.range_m);
    }
    make_legend();
    lay_out();
  }

  std::string svg() {
    out_.add(R"(<svg xmlns="http://www.w3.org/2000/svg" width=")", size_.x, R"(" height=")", size_.y,
             R"(" viewBox="0 0 )", size_ / zoom_, R"(" font-family=")", options_.font,
             "\">\n<rect width=\"100%\" height=\"100%\" fill=\"", theme_.paper, "\"/>\n");
    symbols();
    title();
    scale_bar();
    obstacles();
    radio();
    trails();
    targets();
    // A robot that took over from a dead one may stand where that one is. Of headings, only the tips are seen; spares
    // are below the tree, and the other roles on top.
    robots("dead", [](const RobotFrame& r) { return !r.alive; });
    headings();
    robots(Role::spare);
    trees();
    for (const Role role : {Role::connector, Role::worker, Role::root}) robots(role);
    labels();
    legend();
    out_.add("</svg>\n");
    return std::string(out_.view());
  }

 private:
  // Screen coordinates: y points down.
  [[nodiscard]] Vec2 screen(Vec2 p) const {
    return {origin_.x + (p.x - extent_.low.x) * scale_, origin_.y + (extent_.high.y - p.y) * scale_};
  }
  [[nodiscard]] double robot_px(Role role) const {
    return std::max(setting_.radius_m * scale_, role == Role::spare ? smallest_spare_px : smallest_robot_px);
  }
  [[nodiscard]] double target_px() const {
    return std::max(setting_.target_tolerance_m * scale_, robot_px(Role::worker) + 3.0);
  }
  [[nodiscard]] bool is_robot(std::int32_t i) const {
    return i >= 0 && static_cast<std::size_t>(i) < frame_.robots.size();
  }
  [[nodiscard]] bool is_linked(std::size_t i, std::int32_t j) const {
    const auto a = static_cast<std::uint32_t>(i);
    const auto b = static_cast<std::uint32_t>(j);
    return std::binary_search(links_.open.begin(), links_.open.end(), std::pair{std::min(a, b), std::max(a, b)});
  }
  // The edges of a tree whose robots have, or lack, a link.
  [[nodiscard]] std::vector<std::pair<Vec2, Vec2>> edges(std::int32_t RobotFrame::*to, bool linked) const {
    std::vector<std::pair<Vec2, Vec2>> list;
    for (std::size_t i = 0; i < frame_.robots.size(); ++i) {
      const RobotFrame& robot = frame_.robots[i];
      const std::int32_t j = robot.*to;
      if (!robot.alive || robot.role == Role::spare || !is_robot(j) || is_linked(i, j) != linked) continue;
      list.emplace_back(robot.position, frame_.robots[static_cast<std::size_t>(j)].position);
    }
    return list;
  }
  [[nodiscard]] std::vector<std::pair<Vec2, Vec2>> broken_edges() const {
    auto list = edges(&RobotFrame::parent, false);
    const auto old = edges(&RobotFrame::old_parent, false);
    list.insert(list.end(), old.begin(), old.end());
    return list;
  }

  void begin_path(const Stroke& s) {
    out_.add(R"(<path fill="none" stroke=")", s.color, R"(" stroke-width=")", s.width_px, "\"", s.more, " d=\"");
  }
  void end_path() { out_.add("\"/>\n"); }
  // Lines between points of the world.
  void lines(const Stroke& stroke, const std::vector<std::pair<Vec2, Vec2>>& list, std::size_t per_path) {
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (k % per_path == 0) begin_path(stroke);
      out_.add("M", screen(list[k].first), "L", screen(list[k].second));
      if (k + 1 == list.size() || (k + 1) % per_path == 0) end_path();
    }
  }
  void polyline(const auto& points, std::string_view end = {}) {
    std::string_view command = "M";
    for (const Vec2 p : points) out_.add(std::exchange(command, "L"), screen(p));
    out_.add(end);
  }
  void text(Vec2 at, double size_px, std::string_view color, std::string_view words, std::string_view more = {}) {
    out_.add("<text x=\"", at.x, "\" y=\"", at.y, "\" font-size=\"", size_px, "\" fill=\"", color, "\"", more, ">");
    out_.escaped(words);
    out_.add("</text>\n");
  }
  void circle(Vec2 at, double radius, std::string_view fill, std::string_view more = {}) {
    out_.add("<circle cx=\"", at.x, "\" cy=\"", at.y, "\" r=\"", radius, "\" fill=\"", fill, "\"", more, "/>");
  }

  void make_legend();
  void lay_out();
  void symbols();
  void title();
  void scale_bar();
  void obstacles();
  void cells(const world::FloorMap& map);
  void radio();
  void trails();
  void target(Vec2 at, double radius);
  void targets();
  void robots(std::string_view symbol, const auto& which) {
    for (const RobotFrame& robot : frame_.robots) {
      if (!which(robot)) continue;
      const Vec2 at = screen(robot.position);
      out_.add("<use href=\"#", symbol, look_, "\" x=\"", at.x, "\" y=\"", at.y, "\"/>\n");
    }
  }
  void robots(Role role) {
    robots(name_of(role), [role](const RobotFrame& r) { return r.alive && r.role == role; });
  }
  void headings();
  void trees();
  void labels();
  void legend();

  struct LegendEntry {
    std::string symbol;  // of a robot, or "target"; or else
    Stroke stroke;       // of a line
    std::string words;
  };

  const Setting& setting_;
  const Frame& frame_;
  const Trails& trails_;
  const PictureOptions& options_;
  const palette::Theme& theme_;
  RadioLinks links_;
  PictureExtent extent_;
  std::vector<LegendEntry> legend_;
  double zoom_ = 1.0;   // everything is laid out as for a picture smaller by this
  Vec2 size_{};         // of the picture, px; whole, or its edges blur
  Vec2 origin_{};       // of the map's upper left corner
  double scale_ = 1.0;  // px / m
  double width_ = 0.0, legend_y_ = 0.0;
  std::size_t legend_columns_ = 1;
  std::string look_;  // in the ids of symbols: several pictures may stand in one web page
  Svg out_;
};

// In a film, which is steady, everything that may come has its place from the start.
void Picture::make_legend() {
  std::array<std::size_t, 4> count{};
  std::size_t dead = 0;
  for (const RobotFrame& robot : frame_.robots) ++(robot.alive ? count[static_cast<std::size_t>(robot.role)] : dead);
  for (const Role role : {Role::root, Role::worker, Role::connector, Role::spare}) {
    const std::string name(name_of(role));
    legend_.push_back({name, {}, name + " " + std::to_string(count[static_cast<std::size_t>(role)])});
  }
  if (dead > 0 || options_.steady) legend_.push_back({"dead", {}, "dead " + std::to_string(dead)});
  const auto line = [this](const Stroke& stroke, std::string words, bool is_there) {
    if (is_there || options_.steady) legend_.push_back({"", stroke, std::move(words)});
  };
  if (!frame_.targets.empty()) legend_.push_back({"target", {}, "target"});
  line({theme_.tree, 3.0}, "tree", true);
  if (options_.links) line({theme_.link, 1.2}, "radio link", !links_.open.empty());
  if (options_.blocked_links)
    line({theme_.blocked, 1.2, R"( stroke-dasharray="2 3")"}, "occluded", !links_.blocked.empty());
  const bool trails = std::any_of(trails_.begin(), trails_.end(), [](const auto& t) { return t.size() > 1; });
  if (options_.trail_s > 0.0)
    line({theme_.connector, 2.5, theme_.trail}, "trail, " + in_decimals(options_.trail_s, 0) + " s", trails);
  line({theme_.old_tree, 2.5, R"( stroke-dasharray="6 4")"}, "old tree", !edges(&RobotFrame::old_parent, true).empty());
  line({theme_.broken, 3.0, R"( stroke-dasharray="2 3")"}, "broken edge", !broken_edges().empty());
}

// The map fills the room between title and legend as far as its shape allows.
void Picture::lay_out() {
  size_.x = std::round(std::clamp(options_.width_px, 200.0, 20000.0));
  const bool is_given = options_.height_px > 0.0;
  if (is_given) {
    size_.y = std::round(std::clamp(options_.height_px, 150.0, 20000.0));
    zoom_ = std::max(smallest_zoom, std::min(size_.x / zoom_one_px.x, size_.y / zoom_one_px.y));
  }
  width_ = size_.x / zoom_;
  const Vec2 world = extent_.high - extent_.low;
  const double room = width_ - 2.0 * margin_px;
  legend_columns_ = std::clamp<std::size_t>(static_cast<std::size_t>(room / legend_px.x), 1, legend_.size());
  const std::size_t rows = options_.legend ? (legend_.size() + legend_columns_ - 1) / legend_columns_ : 0;
  const double below = 0.5 * margin_px + legend_px.y * static_cast<double>(rows);
  const double top = title_px + (is_given ? 0.6 : 1.0) * margin_px;
  double height = tallest * room;
  if (is_given) height = std::max(10.0, size_.y / zoom_ - top - below);
  scale_ = std::min(room / world.x, height / world.y);
  if (!is_given) {
    height = world.y * scale_;
    size_.y = std::ceil(top + height + below + 0.5 * margin_px);
  }
  origin_ = Vec2{margin_px, top} + 0.5 * (Vec2{room, height} - scale_ * world);
  legend_y_ = size_.y / zoom_ - below + 0.5 * legend_px.y;
}

// Besides its colour each role has a mark of its own, for grey prints: the root a ring, a worker a white dot, a dead
// robot a cross.
void Picture::symbols() {
  look_ = "-" + in_decimals(100.0 * robot_px(Role::worker), 0) + (options_.dark ? "-dark" : "");
  out_.add("<defs>\n");
  const auto cross = [this](double arm, const Stroke& stroke) {
    begin_path(stroke);
    out_.add("M", Vec2{-arm, -arm}, "L", Vec2{arm, arm}, "M", Vec2{-arm, arm}, "L", Vec2{arm, -arm}, "\"/>");
  };
  for (const Role role : {Role::root, Role::worker, Role::connector, Role::spare}) {
    const double radius = robot_px(role);
    const std::string width = " stroke-width=\"" + in_decimals(std::min(1.0, 0.18 * radius), 2) + "\"";
    const std::string ring = " stroke=\"" + std::string(color_of(role).hex) + "\" stroke-width=\"" +
                             in_decimals(std::max(1.2, 0.25 * radius), 2) + "\"";
    out_.add("<g id=\"", name_of(role), look_, "\">");
    if (role == Role::root) circle({}, 1.6 * radius, "none", ring);
    circle({}, radius, color_of(role).hex, " stroke=\"" + std::string(theme_.outline) + "\"" + width);
    if (role == Role::worker) circle({}, 0.38 * radius, "#ffffff");
    out_.add("</g>\n");
  }
  out_.add("<g id=\"dead", look_, "\">");
  circle({}, robot_px(Role::connector), theme_.dead);
  cross(0.6 * robot_px(Role::connector), {"#ffffff", 1.2});
  out_.add("</g>\n</defs>\n");
}

// What does not fit beside the scale is left out, from the end.
void Picture::title() {
  const auto committed = std::count_if(frame_.robots.begin(), frame_.robots.end(),
                                       [](const RobotFrame& r) { return r.alive && r.role != Role::spare; });
  const std::string facts[] = {
      setting_.algorithm + (setting_.reading.empty() ? "" : ", " + setting_.reading),
      "t = " + in_decimals(frame_.time_s, 1) + " s",
      std::to_string(committed) + " of " + std::to_string(frame_.robots.size()) + " committed",
      "range " + in_decimals(setting_.range_m, 2) + " m" + (setting_.line_of_sight ? ", occlusion" : "")};
  const double room = 0.78 * (width_ - 2.0 * margin_px) - 12.0;
  std::string words;
  for (const std::string& fact : facts) {
    const std::string longer = words.empty() ? fact : words + "\u2002·\u2002" + fact;
    const auto letters =
        std::count_if(longer.begin(), longer.end(), [](char c) { return (c & 0xC0) != 0x80; });  // UTF-8
    if (!words.empty() && letter_px * static_cast<double>(letters) > room) break;
    words = longer;
  }
  out_.add("<text x=\"", margin_px, "\" y=\"28\" font-size=\"19\" font-weight=\"bold\" fill=\"", theme_.ink, "\">");
  out_.escaped(setting_.name.empty() ? "Banyan" : setting_.name);
  out_.add(R"(<tspan dx="12" font-size="14" font-weight="normal" fill=")", theme_.faint_ink, "\">seed ",
           std::to_string(setting_.seed), "</tspan></text>\n");
  text({margin_px, 50.0}, 14.0, theme_.faint_ink, words);
}

void Picture::scale_bar() {
  const double length_m = nice_length(0.22 * (width_ - 2.0 * margin_px) / scale_);
  const double right = width_ - margin_px;
  const double left = right - length_m * scale_;
  const double y = title_px - 12.0;
  begin_path({theme_.tree, 1.6});
  out_.add("M", Vec2{left, y - 4.0}, "v8m0-4H", right, "m0-4v8");
  end_path();
  Text words;
  words.shortest(length_m);
  words.put(" m");
  text({(left + right) / 2.0, y - 8.0}, 13.0, theme_.ink, words.view(), " text-anchor=\"middle\"");
}

void Picture::obstacles() {
  for (const world::Obstacle& obstacle : setting_.obstacles) {
    if (const auto* disc = std::get_if<world::Disc>(&obstacle)) {
      circle(screen(disc->center), disc->radius_m * scale_, theme_.obstacle);
    } else if (const auto* box = std::get_if<world::Box>(&obstacle)) {
      out_.add("<path fill=\"", theme_.obstacle, "\" d=\"");
      polyline(corners(*box), "Z\"/>\n");
    } else if (const auto* wall = std::get_if<world::Wall>(&obstacle)) {
      lines({theme_.obstacle, 4.0, round_ends}, {{wall->from, wall->to}}, 1);
    } else if (const auto* map = std::get_if<world::FloorMap>(&obstacle)) {
      cells(*map);
    }
  }
}

// Rectangles as large as runs of equal rows are, in one path. Without smoothed edges, which would leave seams.
void Picture::cells(const world::FloorMap& map) {
  const world::CellFrame frame(map);
  out_.add("<path fill=\"", theme_.obstacle, "\" shape-rendering=\"crispEdges\" d=\"");
  map.cells->each_block([&](Vec2 low, Vec2 high) {
    const std::array<Vec2, 4> block{frame.in_metres(low), frame.in_metres({high.x, low.y}), frame.in_metres(high),
                                    frame.in_metres({low.x, high.y})};
    for (std::size_t k = 0; k < block.size(); ++k) out_.add(k == 0 ? "M" : "L", screen(block[k]));
    out_.add("Z");
  });
  out_.add("\"/>\n");
}

void Picture::radio() {
  // If all robots hear each other, links would cover everything else: the more there are, the finer.
  const double per_robot =
      static_cast<double>(links_.open.size()) / static_cast<double>(std::max<std::size_t>(1, frame_.robots.size()));
  const double width = per_robot > 20.0 ? 0.25 : per_robot > 8.0 ? 0.5 : 0.8;
  const auto draw = [&](const Stroke& stroke, const auto& pairs) {
    std::vector<std::pair<Vec2, Vec2>> list;
    list.reserve(pairs.size());
    for (const auto& [i, j] : pairs) list.emplace_back(frame_.robots[i].position, frame_.robots[j].position);
    lines(stroke, list, lines_per_path);
  };
  if (options_.links) draw({theme_.link, width}, links_.open);
  if (options_.blocked_links) draw({theme_.blocked, width, R"( stroke-dasharray="2 3")"}, links_.blocked);
}

void Picture::trails() {
  const std::string more = std::string(theme_.trail) + std::string(round_ends);
  for (std::size_t i = 0; i < trails_.size() && i < frame_.robots.size(); ++i) {
    if (trails_[i].size() < 2) continue;
    const RobotFrame& robot = frame_.robots[i];
    const std::string_view color = !robot.alive                ? theme_.dead
                                   : robot.role == Role::spare ? theme_.spare_trail
                                                               : color_of(robot.role).hex;
    begin_path({color, std::max(1.0, 0.35 * robot_px(Role::worker)), more});
    polyline(trails_[i]);
    end_path();
  }
}

void Picture::target(Vec2 at, double radius) {
  circle(at, radius, theme_.target,
         R"( fill-opacity="0.18" stroke-width="2" stroke=")" + std::string(theme_.target) + "\"");
  const double arm = std::min(radius, 6.0);
  begin_path({theme_.target, 1.5});
  out_.add("M", at - Vec2{arm, 0.0}, "h", 2.0 * arm, "m", Vec2{-arm, -arm}, "v", 2.0 * arm);
  end_path();
}

void Picture::targets() {
  for (const TargetFrame& one : frame_.targets) {
    if (one.active) target(screen(one.position), target_px());
    else  // given up: only where it was
      circle(screen(one.position), target_px(), "none",
             R"( stroke-opacity="0.5" stroke-dasharray="2 4" stroke=")" + std::string(theme_.target) + "\"");
  }
}

void Picture::headings() {
  begin_path({theme_.tree, std::clamp(0.3 * robot_px(Role::worker), 0.8, 2.0), round_ends});
  for (const RobotFrame& robot : frame_.robots) {
    if (!robot.alive) continue;
    const Vec2 ahead = 1.7 * robot_px(robot.role) * Vec2{unit_vector(robot.heading_rad)};
    out_.add("M", screen(robot.position), "l", Vec2{ahead.x, -ahead.y});
  }
  end_path();
}

void Picture::trees() {
  const double width = std::clamp(0.5 * robot_px(Role::worker), 1.4, 3.2);
  lines({theme_.tree, width, round_ends}, edges(&RobotFrame::parent, true), lines_per_path);
  lines({theme_.old_tree, 0.8 * width, R"( stroke-dasharray="6 4")"}, edges(&RobotFrame::old_parent, true),
        lines_per_path);
  lines({theme_.broken, width, R"( stroke-dasharray="2 3")"}, broken_edges(), lines_per_path);
}

// Names of targets and, if wanted, of robots; they stand out from what is below.
void Picture::labels() {
  out_.add("<g stroke=\"", theme_.paper, R"(" stroke-width="3" stroke-linejoin="round" paint-order="stroke">)", "\n");
  const double away = 0.75 * target_px() + 3.0;
  for (std::size_t k = 0; k < frame_.targets.size(); ++k) {
    const Vec2 at = screen(frame_.targets[k].position);
    const bool is_right = at.x < width_ - 4.0 * margin_px;  // or else to the left: no label leaves the picture
    text(at + Vec2{is_right ? away : -away, -away}, 15.0,
         frame_.targets[k].active ? theme_.target_ink : theme_.faint_ink, "T" + std::to_string(k),
         is_right ? " font-weight=\"bold\"" : R"( font-weight="bold" text-anchor="end")");
  }
  const double radius = robot_px(Role::worker);
  const double size = std::clamp(1.6 * radius, 8.0, 13.0);
  for (std::size_t i = 0; options_.ids && i < frame_.robots.size(); ++i)
    text(screen(frame_.robots[i].position) + Vec2{1.2 * radius, 1.2 * radius + 0.5 * size}, size, theme_.ink,
         std::to_string(i));
  out_.add("</g>\n");
}

void Picture::legend() {
  for (std::size_t k = 0; options_.legend && k < legend_.size(); ++k) {
    const LegendEntry& entry = legend_[k];
    const std::size_t row = k / legend_columns_;
    const Vec2 at{margin_px + legend_px.x * static_cast<double>(k - row * legend_columns_),
                  legend_y_ + legend_px.y * static_cast<double>(row)};
    if (entry.symbol.empty()) {
      begin_path(entry.stroke);
      out_.add("M", at, "h24");
      end_path();
    } else if (entry.symbol == "target") {
      target(at + Vec2{12.0, 0.0}, 7.0);
    } else {
      const double radius = robot_px(entry.symbol == "spare" ? Role::spare : Role::worker);
      out_.add("<use href=\"#", entry.symbol, look_, "\" transform=\"translate(", at + Vec2{12.0, 0.0}, ") scale(",
               legend_robot_px / radius, ")\"/>\n");
    }
    text(at + Vec2{30.0, 4.5}, 13.0, theme_.ink, entry.words);
  }
}

}  // namespace

Viewport view_of(const Setting& setting, const Frame& frame) {
  const PictureExtent extent = extent_of(setting, frame, {});
  return {extent.low, extent.high};
}

Viewport joined(const Viewport& a, const Viewport& b) noexcept {
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}

std::string draw_svg(const Setting& setting, const Frame& frame, const Trails& trails, const PictureOptions& options) {
  return Picture(setting, frame, trails, options).svg();
}

std::string draw_svg(Recording& recording, double time_s, const PictureOptions& options) {
  const Frame frame = recording.frame_at(time_s);
  TrailLog log(options.trail_s);
  if (options.trail_s > 0.0) {
    recording.for_each(
        [&](const Frame& earlier) {
          log.add(earlier);
          return true;
        },
        std::max(0.0, frame.time_s - options.trail_s), frame.time_s);
  }
  return draw_svg(recording.setting_at(frame.time_s), frame, log.trails(frame), options);
}

}  // namespace banyan::record
