// SPDX-License-Identifier: MIT
// One frame as an SVG picture (draw.hpp). Many small things of one kind share one path element,
// which keeps a picture of 1,000 robots below a megabyte.
#include "banyan/record/draw.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>

#include "banyan/controller/core/trig.hpp"
#include "banyan/record/file.hpp"
#include "banyan/record/palette.hpp"
#include "banyan/record/recording.hpp"
#include "text.hpp"

namespace banyan::record {

namespace {

constexpr double margin_px = 24.0;
constexpr double title_px = 62.0;
constexpr double panel_px = 232.0;      // beside a map in a picture of given size, where that suits it better
constexpr double em_per_letter = 0.54;  // of DejaVu Sans, the widest of the fonts to be expected
constexpr double legend_row_px = 22.0;
constexpr double smallest_robot_px = 3.4;   // radius; smaller ones could not be told apart in print
constexpr double smallest_spare_px = 2.2;   // of hundreds, which must not hide the tree
constexpr Vec2 zoom_one_px{1280.0, 720.0};  // a picture of given size whose text is as large as elsewhere;
constexpr double smallest_zoom = 0.7;       // it goes with the picture, down to what can be read
constexpr double tallest = 1.25;            // height / width of the map at most
constexpr double trail_step_s = 0.5;
constexpr double most_m = 1e6;  // beyond, a position is damage and would hide the rest

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

struct ExtentOfObstacle {
  PictureExtent& extent;
  void operator()(const world::Disc& disc) const { extent.add(disc.center, disc.radius_m); }
  void operator()(const world::Box& box) const {
    for (const Vec2 corner : corners(box)) extent.add(corner);
  }
  void operator()(const world::Wall& wall) const {
    extent.add(wall.from);
    extent.add(wall.to);
  }
};

// The colours other than those of roles: the background, and what must stand out from it.
struct Theme {
  std::string_view paper, ink, faint_ink, target_ink, outline;
  Color tree, link, obstacle;
  std::string_view trail_opacity;
};
constexpr Theme light{.paper = "#ffffff",
                      .ink = "#000000",
                      .faint_ink = "#444444",
                      .target_ink = "#8f3f6d",
                      .outline = "#1a1a1a",
                      .tree = palette::tree,
                      .link = palette::link,
                      .obstacle = palette::obstacle,
                      .trail_opacity = " stroke-opacity=\"0.45\""};
constexpr Theme dark{.paper = "#12161c",
                     .ink = "#f2f2f2",
                     .faint_ink = "#aab2bd",
                     .target_ink = "#e7a9cd",
                     .outline = "#05070a",
                     .tree = {0xE8, 0xE8, 0xE8, "#e8e8e8"},
                     .link = {0x47, 0x50, 0x5C, "#47505c"},
                     .obstacle = {0x6E, 0x69, 0x62, "#6e6962"},
                     .trail_opacity = " stroke-opacity=\"0.65\""};

// The layout: the map fills its box as far as its shape allows.
struct PictureLayout {
  bool panel = false;   // title and legend in a column at the left, else above and below
  Vec2 low, high;       // the box of the map, px, y downwards
  double height = 0.0;  // of the picture
  double scale = 0.0;   // px / m
};

struct LegendEntry {
  std::function<void(Vec2)> symbol;
  std::string words;
  bool shown = true;  // else its place stays empty
};

PictureExtent extent_of(const Setting& setting, const Frame& frame, const Trails& trails) {
  PictureExtent extent;
  for (const RobotFrame& robot : frame.robots) extent.add(robot.position, setting.radius_m);
  for (const TargetFrame& target : frame.targets) extent.add(target.position, setting.target_tolerance_m);
  for (const auto& trail : trails) {
    for (const Vec2 p : trail) extent.add(p);
  }
  for (const world::Obstacle& obstacle : setting.obstacles) std::visit(ExtentOfObstacle{extent}, obstacle);
  extent.at_least(setting.range_m);
  return extent;
}

class Picture {
 public:
  Picture(const Setting& setting, const Frame& frame, const Trails& trails, const PictureOptions& options)
      : setting_(setting),
        frame_(frame),
        trails_(trails),
        options_(options),
        extent_(extent_of(setting, frame, trails)),
        theme_(options.dark ? dark : light) {
    if (options.view) {
      extent_.low = options.view->low;
      extent_.high = options.view->high;
      extent_.at_least(setting.range_m);
    }
    size_.x = std::round(std::clamp(options.width_px, 200.0, 20000.0));  // whole pixels, or its edges blur
    if (options.height_px > 0.0) {
      size_.y = std::round(std::clamp(options.height_px, 150.0, 20000.0));
      zoom_ = std::max(smallest_zoom, std::min(size_.x / zoom_one_px.x, size_.y / zoom_one_px.y));
    }
    width_ = size_.x / zoom_;
    links_ = radio_links(setting, frame);
    old_edges_ = std::any_of(frame.robots.begin(), frame.robots.end(), [this](const RobotFrame& r) {
      return r.alive && r.role != Role::spare && valid(r.old_parent);
    });
    broken_edges_ = any_broken_edge();
    arrange();
    robot_px_ = std::max(setting.radius_m * layout_.scale, smallest_robot_px);
  }

  std::string svg();

 private:
  // Screen coordinates: y points down.
  [[nodiscard]] Vec2 screen(Vec2 p) const {
    return {origin_.x + (p.x - extent_.low.x) * layout_.scale, origin_.y + (extent_.high.y - p.y) * layout_.scale};
  }
  [[nodiscard]] double symbol_px(Role role) const {
    return role == Role::spare ? std::max(setting_.radius_m * layout_.scale, smallest_spare_px) : robot_px_;
  }
  [[nodiscard]] bool valid(std::int32_t i) const {
    return i >= 0 && static_cast<std::size_t>(i) < frame_.robots.size();
  }
  [[nodiscard]] bool linked(std::size_t i, std::int32_t j) const {
    const auto a = static_cast<std::uint32_t>(i);
    const auto b = static_cast<std::uint32_t>(j);
    return std::binary_search(links_.open.begin(), links_.open.end(), std::pair{std::min(a, b), std::max(a, b)});
  }

  void number(double v) { out_.fixed(v, 2); }
  void attribute(std::string_view name, double v) {
    out_.put(' ');
    out_.put(name);
    out_.put("=\"");
    number(v);
    out_.put('"');
  }
  void attribute(std::string_view name, std::string_view v) {
    out_.put(' ');
    out_.put(name);
    out_.put("=\"");
    out_.xml(v);
    out_.put('"');
  }
  void move_to(Vec2 p, char command) {
    out_.put(command);
    number(p.x);
    out_.put(' ');
    number(p.y);
  }
  void segment(Vec2 a, Vec2 b) {
    move_to(screen(a), 'M');
    move_to(screen(b), 'L');
  }
  template <class Fill> void path(const Color& color, double width_px, const Fill& fill, std::string_view more = {}) {
    out_.put("<path fill=\"none\"");
    attribute("stroke", color.hex);
    attribute("stroke-width", width_px);
    out_.put(more);
    out_.put(" d=\"");
    fill();
    out_.put("\"/>\n");
  }
  void text(Vec2 at, double size_px, std::string_view words, std::string_view color, std::string_view more) {
    out_.put("<text");
    attribute("x", at.x);
    attribute("y", at.y);
    attribute("font-size", size_px);
    attribute("fill", color);
    out_.put(more);
    out_.put('>');
    out_.xml(words);
    out_.put("</text>\n");
  }

  [[nodiscard]] bool any_broken_edge() const;
  [[nodiscard]] PictureLayout strips() const;
  [[nodiscard]] PictureLayout panel() const;
  void arrange();
  [[nodiscard]] std::vector<std::string> facts() const;
  void title();
  void panel_title();
  void obstacles();
  void radio();
  void trails();
  void targets();
  template <class Which> void edges(std::int32_t RobotFrame::*to, const Which& which);
  void trees();
  void headings();
  void dead();
  void robots(std::initializer_list<Role> roles);
  void robot_symbol(Vec2 at, Role role, bool alive, double radius_px);
  void ids();
  void add_roles();
  void add_line(const Color& color, double width_px, std::string_view more, std::string words, bool shown = true);
  void add_lines();
  void add_what_may_come();
  [[nodiscard]] double width_of(const LegendEntry& entry) const;
  [[nodiscard]] std::size_t legend_rows() const;
  void legend();
  void scale_bar();

  const Setting& setting_;
  const Frame& frame_;
  const Trails& trails_;
  const PictureOptions& options_;
  PictureExtent extent_;
  const Theme& theme_;
  PictureLayout layout_;
  Vec2 origin_{};      // px, of the map's upper left corner
  Vec2 size_{};        // of the picture, px
  double zoom_ = 1.0;  // everything is laid out as for a picture smaller by this
  double width_ = 0.0, robot_px_ = 0.0;
  RadioLinks links_;
  bool old_edges_ = false, broken_edges_ = false;
  std::vector<LegendEntry> legend_;
  Text out_;
};

std::string in_decimals(double value, int decimals) {
  Text text;
  text.fixed(value, decimals);
  return std::string(text.view());
}

// The largest of 1, 2, 5 times a power of ten that is not above `most`.
double nice_length(double most) {
  double unit = 1e-3;
  while (unit * 10.0 <= most) unit *= 10.0;
  return most >= 5.0 * unit ? 5.0 * unit : most >= 2.0 * unit ? 2.0 * unit : unit;
}

bool Picture::any_broken_edge() const {
  for (std::size_t i = 0; i < frame_.robots.size(); ++i) {
    const RobotFrame& robot = frame_.robots[i];
    if (!robot.alive || robot.role == Role::spare) continue;
    if (valid(robot.parent) && !linked(i, robot.parent)) return true;
    if (valid(robot.old_parent) && !linked(i, robot.old_parent)) return true;
  }
  return false;
}

PictureLayout Picture::strips() const {
  const Vec2 size = extent_.high - extent_.low;
  const double legend_px = options_.legend ? legend_row_px * static_cast<double>(legend_rows()) : 0.0;
  PictureLayout layout;
  layout.low = {margin_px, title_px + margin_px};
  layout.high.x = width_ - margin_px;
  const double inner = layout.high.x - layout.low.x;
  if (options_.height_px > 0.0) {
    layout.height = size_.y / zoom_;
    layout.low.y = title_px + 10.0;
    layout.high.y = std::max(layout.low.y + 10.0, layout.height - legend_px - 16.0);
    layout.scale = std::min(inner / size.x, (layout.high.y - layout.low.y) / size.y);
  } else {
    layout.scale = std::min(inner / size.x, tallest * inner / size.y);
    layout.high.y = layout.low.y + size.y * layout.scale;
    layout.height = std::ceil(layout.high.y + margin_px + (options_.legend ? legend_px + 6.0 : 0.0));
  }
  return layout;
}

PictureLayout Picture::panel() const {
  const Vec2 size = extent_.high - extent_.low;
  PictureLayout layout;
  layout.panel = true;
  layout.height = size_.y / zoom_;
  layout.low = {panel_px, 26.0};
  layout.high = {std::max(panel_px + 10.0, width_ - 26.0), layout.height - 26.0};
  layout.scale = std::min((layout.high.x - layout.low.x) / size.x, (layout.high.y - layout.low.y) / size.y);
  return layout;
}

constexpr double panel_legend_px = 176.0;  // where it begins

void Picture::arrange() {
  add_roles();
  add_lines();
  add_what_may_come();
  layout_ = strips();
  // A square world in a wide picture is larger beside its title than under it.
  const double column_px = panel_legend_px + legend_row_px * static_cast<double>(legend_.size()) + 50.0;
  if (options_.height_px > 0.0 && options_.legend) {
    const PictureLayout beside = panel();
    if (beside.scale > layout_.scale && column_px <= beside.height) layout_ = beside;
  }
  const Vec2 room = layout_.high - layout_.low - layout_.scale * (extent_.high - extent_.low);
  origin_ = layout_.low + 0.5 * room;
}

std::vector<std::string> Picture::facts() const {
  const auto committed = std::count_if(frame_.robots.begin(), frame_.robots.end(),
                                       [](const RobotFrame& r) { return r.alive && r.role != Role::spare; });
  return {setting_.algorithm + (setting_.reading.empty() ? "" : ", " + setting_.reading),
          "t = " + in_decimals(frame_.time_s, 1) + " s",
          std::to_string(committed) + " of " + std::to_string(frame_.robots.size()) + " committed",
          "range " + in_decimals(setting_.range_m, 2) + " m" + (setting_.line_of_sight ? ", line of sight" : "")};
}

// What does not fit beside the scale is left out, from the end.
void Picture::title() {
  const std::string name = setting_.name.empty() ? "Banyan" : setting_.name;
  constexpr double size_px = 14.0;
  constexpr std::string_view gap = "\u2002·\u2002";  // spaces that XML does not run together
  constexpr std::size_t gap_letters = 3;
  double left = width_ - 2.0 * margin_px - 0.22 * (width_ - 2.0 * margin_px) - 12.0;
  std::string words;
  for (const std::string& fact : facts()) {
    left -= em_per_letter * size_px * static_cast<double>(fact.size() + (words.empty() ? 0 : gap_letters));
    if (left < 0.0 && !words.empty()) break;
    words += (words.empty() ? "" : std::string(gap)) + fact;
  }
  out_.put("<text");
  attribute("x", margin_px);
  attribute("y", 28.0);
  attribute("font-size", 19.0);
  attribute("fill", theme_.ink);
  out_.put(" font-weight=\"bold\">");
  out_.xml(name);
  out_.put("<tspan dx=\"12\" font-weight=\"normal\"");
  attribute("font-size", size_px);
  attribute("fill", theme_.faint_ink);
  out_.put(">seed ");
  out_.natural(setting_.seed);
  out_.put("</tspan></text>\n");
  text({margin_px, 50.0}, size_px, words, theme_.faint_ink, {});
}

void Picture::panel_title() {
  const std::string name = setting_.name.empty() ? "Banyan" : setting_.name;
  const double room = panel_px - margin_px;
  const double letters = static_cast<double>(std::max<std::size_t>(name.size(), 1));
  text({margin_px, 42.0}, std::clamp(room / (1.15 * em_per_letter * letters), 10.0, 20.0), name, theme_.ink,
       " font-weight=\"bold\"");
  const auto all = facts();
  const std::string seed = " · seed " + std::to_string(setting_.seed);
  text({margin_px, 64.0}, 13.0, all[0] + (seed.size() < 16 ? seed : ""), theme_.faint_ink, {});
  text({margin_px, 106.0}, 26.0, in_decimals(frame_.time_s, 1) + " s", theme_.ink, {});
  text({margin_px, 130.0}, 13.0, all[2], theme_.faint_ink, {});
  text({margin_px, 148.0}, 13.0, all[3], theme_.faint_ink, {});
}

void Picture::obstacles() {
  for (const world::Obstacle& obstacle : setting_.obstacles) {
    if (const auto* disc = std::get_if<world::Disc>(&obstacle)) {
      const Vec2 at = screen(disc->center);
      out_.put("<circle");
      attribute("cx", at.x);
      attribute("cy", at.y);
      attribute("r", disc->radius_m * layout_.scale);
      attribute("fill", theme_.obstacle.hex);
      out_.put("/>\n");
    } else if (const auto* box = std::get_if<world::Box>(&obstacle)) {
      out_.put("<path");
      attribute("fill", theme_.obstacle.hex);
      out_.put(" d=\"");
      char command = 'M';
      for (const Vec2 corner : corners(*box)) {
        move_to(screen(corner), command);
        command = 'L';
      }
      out_.put("Z\"/>\n");
    } else if (const auto* wall = std::get_if<world::Wall>(&obstacle)) {
      path(
          theme_.obstacle, 4.0, [&] { segment(wall->from, wall->to); }, " stroke-linecap=\"round\"");
    }
  }
}

void Picture::radio() {
  // In pieces: lines that cross within one path cost a renderer far more than separate paths on top of each other.
  constexpr std::size_t piece = 50;
  const auto draw = [this](const Color& color, double width_px, const auto& list, std::string_view more) {
    for (std::size_t first = 0; first < list.size(); first += piece) {
      path(
          color, width_px,
          [&] {
            for (std::size_t k = first; k < std::min(first + piece, list.size()); ++k) {
              segment(frame_.robots[list[k].first].position, frame_.robots[list[k].second].position);
            }
          },
          more);
    }
  };
  // If all robots hear each other, links would cover everything else: the more there are, the finer.
  const double robots = std::max(1.0, static_cast<double>(frame_.robots.size()));
  const double per_robot = static_cast<double>(links_.open.size()) / robots;
  const double width = per_robot > 20.0 ? 0.25 : per_robot > 8.0 ? 0.5 : 0.8;
  if (options_.links) draw(theme_.link, width, links_.open, {});
  if (options_.blocked_links) draw(palette::blocked, width, links_.blocked, " stroke-dasharray=\"2 3\"");
}

void Picture::trails() {
  for (std::size_t i = 0; i < trails_.size() && i < frame_.robots.size(); ++i) {
    if (trails_[i].size() < 2) continue;
    const RobotFrame& robot = frame_.robots[i];
    const Color& color = robot.role == Role::spare ? palette::trail : color_of(robot.role, robot.alive);
    path(
        color, std::max(1.0, 0.35 * robot_px_),
        [&] {
          char command = 'M';
          for (const Vec2 p : trails_[i]) {
            move_to(screen(p), command);
            command = 'L';
          }
        },
        std::string(theme_.trail_opacity) + " stroke-linejoin=\"round\" stroke-linecap=\"round\"");
  }
}

void Picture::targets() {
  for (const TargetFrame& target : frame_.targets) {
    const Vec2 at = screen(target.position);
    const double radius = std::max(setting_.target_tolerance_m * layout_.scale, robot_px_ + 3.0);
    out_.put("<circle");
    attribute("cx", at.x);
    attribute("cy", at.y);
    attribute("r", radius);
    if (!target.active) {  // given up: only where it was
      attribute("fill", "none");
      attribute("stroke", palette::target.hex);
      attribute("stroke-width", 1.0);
      attribute("stroke-opacity", 0.5);
      out_.put(" stroke-dasharray=\"2 4\"/>\n");
      continue;
    }
    attribute("fill", palette::target.hex);
    attribute("fill-opacity", 0.18);
    attribute("stroke", palette::target.hex);
    attribute("stroke-width", 2.0);
    out_.put("/>\n");
    path(palette::target, 1.5, [&] {
      const double arm = std::min(radius, 6.0);
      move_to(at - Vec2{arm, 0.0}, 'M');
      move_to(at + Vec2{arm, 0.0}, 'L');
      move_to(at - Vec2{0.0, arm}, 'M');
      move_to(at + Vec2{0.0, arm}, 'L');
    });
  }
}

template <class Which> void Picture::edges(std::int32_t RobotFrame::*to, const Which& which) {
  for (std::size_t i = 0; i < frame_.robots.size(); ++i) {
    const RobotFrame& robot = frame_.robots[i];
    const std::int32_t j = robot.*to;
    if (!robot.alive || robot.role == Role::spare || !valid(j) || !which(linked(i, j))) continue;
    segment(robot.position, frame_.robots[static_cast<std::size_t>(j)].position);
  }
}

void Picture::trees() {
  const double width = std::clamp(0.5 * robot_px_, 1.4, 3.2);
  const auto open = [](bool is_linked) { return is_linked; };
  const auto broken = [](bool is_linked) { return !is_linked; };
  path(
      theme_.tree, width, [&] { edges(&RobotFrame::parent, open); }, " stroke-linecap=\"round\"");
  path(
      palette::old_tree, 0.8 * width, [&] { edges(&RobotFrame::old_parent, open); }, " stroke-dasharray=\"6 4\"");
  path(
      palette::root, width,
      [&] {
        edges(&RobotFrame::parent, broken);
        edges(&RobotFrame::old_parent, broken);
      },
      " stroke-dasharray=\"2 3\"");
}

// Besides its colour each role has a mark of its own, for grey prints: the root a ring, a worker a
// white dot, a dead robot a cross.
void Picture::robot_symbol(Vec2 at, Role role, bool alive, double radius_px) {
  const Color& color = color_of(role, alive);
  const auto circle = [&](double radius, std::string_view fill, std::string_view stroke, double width) {
    out_.put("<circle");
    attribute("cx", at.x);
    attribute("cy", at.y);
    attribute("r", radius);
    attribute("fill", fill);
    if (width > 0.0) {
      attribute("stroke", stroke);
      attribute("stroke-width", width);
    }
    out_.put("/>");
  };
  if (alive && role == Role::root) circle(1.6 * radius_px, "none", color.hex, std::max(1.2, 0.25 * radius_px));
  circle(radius_px, color.hex, theme_.outline, std::min(1.0, 0.18 * radius_px));
  if (alive && role == Role::worker) circle(0.38 * radius_px, "#ffffff", "", 0.0);
  if (!alive) {
    const double arm = 0.6 * radius_px;
    out_.put("<path stroke=\"#ffffff\" stroke-width=\"1.2\" d=\"");
    move_to(at + Vec2{-arm, -arm}, 'M');
    move_to(at + Vec2{arm, arm}, 'L');
    move_to(at + Vec2{-arm, arm}, 'M');
    move_to(at + Vec2{arm, -arm}, 'L');
    out_.put("\"/>");
  }
}

void Picture::headings() {
  path(
      theme_.tree, std::clamp(0.3 * robot_px_, 0.8, 2.0),
      [&] {
        for (const RobotFrame& robot : frame_.robots) {
          if (!robot.alive) continue;
          const Vec2 at = screen(robot.position);
          const Vec2 ahead = unit_vector(robot.heading_rad);
          move_to(at, 'M');
          move_to(at + 1.7 * symbol_px(robot.role) * Vec2{ahead.x, -ahead.y}, 'L');
        }
      },
      " stroke-linecap=\"round\"");
}

// Below everything: a robot that took over from a dead one may stand where that one is.
void Picture::dead() {
  for (const RobotFrame& robot : frame_.robots) {
    if (robot.alive) continue;
    robot_symbol(screen(robot.position), robot.role, false, symbol_px(robot.role));
    out_.put('\n');
  }
}

void Picture::robots(std::initializer_list<Role> roles) {
  for (const Role role : roles) {
    for (const RobotFrame& robot : frame_.robots) {
      if (robot.role != role || !robot.alive) continue;
      robot_symbol(screen(robot.position), robot.role, robot.alive, symbol_px(role));
      out_.put('\n');
    }
  }
}

void Picture::ids() {
  const double size = std::clamp(1.6 * robot_px_, 8.0, 13.0);
  const std::string halo = " stroke=\"" + std::string(theme_.paper) +
                           "\" stroke-width=\"3\" stroke-linejoin=\"round\" paint-order=\"stroke\"";
  for (std::size_t k = 0; k < frame_.targets.size(); ++k) {
    const Vec2 at = screen(frame_.targets[k].position);
    const double away = std::max(setting_.target_tolerance_m * layout_.scale, robot_px_ + 3.0) * 0.75 + 3.0;
    // Towards the middle of the picture, so that a label never leaves it.
    const bool right = at.x < width_ - 4.0 * margin_px;
    std::string label("T");
    label += std::to_string(k);
    text(at + Vec2{right ? away : -away, -away}, 15.0, label,
         frame_.targets[k].active ? theme_.target_ink : theme_.faint_ink,
         " font-weight=\"bold\"" + halo + (right ? "" : " text-anchor=\"end\""));
  }
  if (!options_.ids) return;
  for (std::size_t i = 0; i < frame_.robots.size(); ++i) {
    text(screen(frame_.robots[i].position) + Vec2{1.2 * robot_px_, 1.2 * robot_px_ + 0.5 * size}, size,
         std::to_string(i), theme_.ink, halo);
  }
}

void Picture::add_roles() {
  std::array<std::size_t, 4> count{};
  for (const RobotFrame& robot : frame_.robots) {
    if (robot.alive) ++count[static_cast<std::size_t>(robot.role)];
  }
  for (const Role role : {Role::root, Role::worker, Role::connector, Role::spare}) {
    legend_.push_back({[this, role](Vec2 at) { robot_symbol(at, role, true, 5.5); },
                       std::string(name_of(role)) + " " + std::to_string(count[static_cast<std::size_t>(role)])});
  }
}

void Picture::add_line(const Color& color, double width_px, std::string_view more, std::string words, bool shown) {
  legend_.push_back({[this, color, width_px, more](Vec2 at) {
                       path(
                           color, width_px,
                           [&] {
                             move_to(at - Vec2{12.0, 0.0}, 'M');
                             move_to(at + Vec2{12.0, 0.0}, 'L');
                           },
                           more);
                     },
                     std::move(words), shown});
}

void Picture::add_lines() {
  add_line(theme_.tree, 3.0, "", "tree");
  if (options_.links && (options_.steady || !links_.open.empty())) add_line(theme_.link, 1.2, "", "radio link");
  const bool trails = std::any_of(trails_.begin(), trails_.end(), [](const auto& t) { return t.size() > 1; });
  if (trails || (options_.steady && options_.trail_s > 0.0)) {
    add_line(palette::connector, 2.5, theme_.trail_opacity, "trail, " + in_decimals(options_.trail_s, 0) + " s");
  }
  if (frame_.targets.empty()) return;
  legend_.push_back({[this](Vec2 at) {
                       out_.put("<circle");
                       attribute("cx", at.x);
                       attribute("cy", at.y);
                       attribute("r", 7.0);
                       attribute("fill", palette::target.hex);
                       attribute("fill-opacity", 0.18);
                       attribute("stroke", palette::target.hex);
                       attribute("stroke-width", 2.0);
                       out_.put("/>");
                     },
                     "target, tolerance"});
}

// At the end, so that places which are still empty are no gaps.
void Picture::add_what_may_come() {
  const auto wanted = [this](bool shown) { return shown || options_.steady; };
  if (wanted(old_edges_)) add_line(palette::old_tree, 2.5, " stroke-dasharray=\"6 4\"", "old tree", old_edges_);
  if (wanted(broken_edges_)) add_line(palette::root, 3.0, " stroke-dasharray=\"2 3\"", "broken edge", broken_edges_);
  const bool blocked = !links_.blocked.empty();
  if (options_.blocked_links && wanted(blocked)) {
    add_line(palette::blocked, 1.2, " stroke-dasharray=\"2 3\"", "no line of sight", blocked);
  }
  const auto dead =
      std::count_if(frame_.robots.begin(), frame_.robots.end(), [](const RobotFrame& r) { return !r.alive; });
  if (!wanted(dead > 0)) return;
  legend_.push_back(
      {[this](Vec2 at) { robot_symbol(at, Role::spare, false, 5.5); }, "dead " + std::to_string(dead), dead > 0});
}

// In a film a count may gain a digit: nothing may jump then.
double Picture::width_of(const LegendEntry& entry) const {
  std::size_t letters = entry.words.size();
  const std::size_t digits = std::to_string(frame_.robots.size()).size();
  const std::size_t space = entry.words.find_last_not_of("0123456789");
  if (options_.steady && space != std::string::npos && space + 1 < letters) letters = space + 1 + digits;
  return 44.0 + 13.0 * em_per_letter * static_cast<double>(letters);
}

std::size_t Picture::legend_rows() const {
  std::size_t rows = 1;
  double x = margin_px;
  for (const LegendEntry& entry : legend_) {
    const double width = width_of(entry);
    if (x > margin_px && x + width > width_ - margin_px + 14.0) {
      x = margin_px;
      ++rows;
    }
    x += width;
  }
  return rows;
}

void Picture::legend() {
  if (!options_.legend) return;
  const double rows_px = legend_row_px * static_cast<double>(legend_rows());
  Vec2 at{margin_px, layout_.panel ? panel_legend_px + 11.0 : layout_.height - rows_px - 6.0 + 11.0};
  for (const LegendEntry& entry : legend_) {
    const double width = width_of(entry);
    if (!layout_.panel && at.x > margin_px && at.x + width > width_ - margin_px + 14.0) {
      at = {margin_px, at.y + legend_row_px};
    }
    if (entry.shown) {
      entry.symbol(at + Vec2{12.0, 0.0});
      text(at + Vec2{30.0, 4.5}, 13.0, entry.words, theme_.ink, {});
    }
    if (layout_.panel) at.y += legend_row_px;
    else at.x += width;
  }
}

void Picture::scale_bar() {
  const double room_px = layout_.panel ? panel_px - 3.0 * margin_px : 0.22 * (width_ - 2.0 * margin_px);
  const double length_m = nice_length(room_px / layout_.scale);
  const double length_px = length_m * layout_.scale;
  const double right = layout_.panel ? margin_px + length_px : width_ - margin_px;
  const double y = layout_.panel ? layout_.height - margin_px : title_px - 12.0;
  path(theme_.tree, 1.6, [&] {
    move_to({right - length_px, y - 4.0}, 'M');
    move_to({right - length_px, y + 4.0}, 'L');
    move_to({right - length_px, y}, 'M');
    move_to({right, y}, 'L');
    move_to({right, y - 4.0}, 'M');
    move_to({right, y + 4.0}, 'L');
  });
  Text words;
  words.shortest(length_m);
  words.put(" m");
  text({right - length_px / 2.0, y - 8.0}, 13.0, words.view(), theme_.ink, " text-anchor=\"middle\"");
}

std::string Picture::svg() {
  out_.put("<svg xmlns=\"http://www.w3.org/2000/svg\"");
  attribute("width", size_.x);
  attribute("height", options_.height_px > 0.0 ? size_.y : layout_.height);
  out_.put(" viewBox=\"0 0 ");
  number(width_);
  out_.put(' ');
  number(layout_.height);
  out_.put('"');
  attribute("font-family", options_.font);
  out_.put(">\n<rect width=\"100%\" height=\"100%\"");
  attribute("fill", theme_.paper);
  out_.put("/>\n");
  layout_.panel ? panel_title() : title();
  scale_bar();
  obstacles();
  radio();
  trails();
  targets();
  dead();
  // Headings below the bodies, so that only their tips are seen; spares below the tree, and the
  // other roles on top.
  headings();
  robots({Role::spare});
  trees();
  robots({Role::connector, Role::worker, Role::root});
  ids();
  legend();
  out_.put("</svg>\n");
  return std::string(out_.view());
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

void TrailLog::add(const Frame& frame) {
  if (!(length_s_ > 0.0)) return;
  if (!samples_.empty() && frame.time_s + 1e-9 < samples_.back().time_s + trail_step_s) return;
  Sample sample{frame.time_s, {}};
  for (const RobotFrame& robot : frame.robots) sample.positions.push_back(robot.position);
  samples_.push_back(std::move(sample));
  // One that is too old stays: the oldest end of a trail lies between it and the next.
  while (samples_.size() > 2 && samples_[1].time_s < frame.time_s - length_s_) samples_.pop_front();
}

Trails TrailLog::trails(const Frame& end) const {
  Trails trails(end.robots.size());
  const auto add = [&](std::size_t i, Vec2 p) {
    if (trails[i].empty() || !(trails[i].back() == p)) trails[i].push_back(p);
  };
  const double begin_s = end.time_s - length_s_;
  for (std::size_t k = 0; k < samples_.size(); ++k) {
    const Sample& sample = samples_[k];
    if (sample.time_s < begin_s && (k + 1 == samples_.size() || samples_[k + 1].time_s <= begin_s)) continue;
    for (std::size_t i = 0; i < std::min(sample.positions.size(), trails.size()); ++i) {
      Vec2 p = sample.positions[i];
      if (sample.time_s < begin_s && i < samples_[k + 1].positions.size()) {
        const double share = (begin_s - sample.time_s) / (samples_[k + 1].time_s - sample.time_s);
        p += share * (samples_[k + 1].positions[i] - p);
      }
      add(i, p);
    }
  }
  for (std::size_t i = 0; i < trails.size(); ++i) {
    if (!trails[i].empty()) add(i, end.robots[i].position);
  }
  return trails;
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
