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

#include "banyan/controller/trig.hpp"
#include "banyan/record/file.hpp"
#include "banyan/record/palette.hpp"
#include "banyan/record/recording.hpp"
#include "text.hpp"

namespace banyan::record {

namespace {

constexpr double margin_px = 24.0;
constexpr double title_px = 62.0;
constexpr double legend_row_px = 22.0;
constexpr double smallest_robot_px = 3.4;   // radius; smaller ones could not be told apart in print
constexpr double smallest_spare_px = 2.2;   // of hundreds, which must not hide the tree
constexpr double smallest_view_m = 2.0;
constexpr double tallest = 1.25;            // height / width of the map at most
constexpr double trail_step_s = 0.5;
constexpr double most_m = 1e6;              // beyond, a position is damage and would hide the rest

struct Extent {
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
  Extent& extent;
  void operator()(const world::Disc& disc) const { extent.add(disc.center, disc.radius_m); }
  void operator()(const world::Box& box) const {
    for (const Vec2 corner : corners(box)) extent.add(corner);
  }
  void operator()(const world::Wall& wall) const {
    extent.add(wall.from);
    extent.add(wall.to);
  }
};

Extent extent_of(const Setting& setting, const Frame& frame, const Trails& trails) {
  Extent extent;
  for (const RobotFrame& robot : frame.robots) extent.add(robot.position, setting.radius_m);
  for (const TargetFrame& target : frame.targets) extent.add(target.position, setting.target_tolerance_m);
  for (const auto& trail : trails) {
    for (const Vec2 p : trail) extent.add(p);
  }
  for (const world::Obstacle& obstacle : setting.obstacles) std::visit(ExtentOfObstacle{extent}, obstacle);
  extent.at_least(smallest_view_m);
  return extent;
}

class Picture {
 public:
  Picture(const Setting& setting, const Frame& frame, const Trails& trails, const DrawOptions& options)
      : setting_(setting), frame_(frame), trails_(trails), options_(options),
        extent_(extent_of(setting, frame, trails)) {
    const Vec2 size = extent_.high - extent_.low;
    width_ = std::clamp(options.width_px, 200.0, 20000.0);
    const double inner = width_ - 2.0 * margin_px;
    scale_ = std::min(inner / size.x, tallest * inner / size.y);
    map_height_ = size.y * scale_;
    left_ = (width_ - size.x * scale_) / 2.0;
    robot_px_ = std::max(setting.radius_m * scale_, smallest_robot_px);
    links_ = radio_links(setting, frame);
  }

  std::string svg();

 private:
  // Screen coordinates: y points down.
  [[nodiscard]] Vec2 screen(Vec2 p) const {
    return {left_ + (p.x - extent_.low.x) * scale_, title_px + margin_px + (extent_.high.y - p.y) * scale_};
  }
  [[nodiscard]] double symbol_px(Role role) const {
    return role == Role::spare ? std::max(setting_.radius_m * scale_, smallest_spare_px) : robot_px_;
  }
  [[nodiscard]] double map_bottom() const { return title_px + 2.0 * margin_px + map_height_; }
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
  template <class Fill>
  void path(const Color& color, double width_px, const Fill& fill, std::string_view more = {}) {
    out_.put("<path fill=\"none\"");
    attribute("stroke", color.hex);
    attribute("stroke-width", width_px);
    out_.put(more);
    out_.put(" d=\"");
    fill();
    out_.put("\"/>\n");
  }
  void text(Vec2 at, double size_px, std::string_view words, std::string_view more = {}) {
    out_.put("<text");
    attribute("x", at.x);
    attribute("y", at.y);
    attribute("font-size", size_px);
    out_.put(more);
    out_.put('>');
    out_.xml(words);
    out_.put("</text>\n");
  }

  void title();
  void obstacles();
  void radio();
  void trails();
  void targets();
  template <class Which>
  void edges(std::int32_t RobotFrame::*to, const Which& which);
  void trees();
  void headings();
  void robots(std::initializer_list<Role> roles);
  void robot_symbol(Vec2 at, Role role, bool alive, double radius_px);
  void ids();
  void legend();
  void legend_entries();
  void legend_symbol(const std::function<void(Vec2)>& symbol, const std::string& words);
  void scale_bar();

  const Setting& setting_;
  const Frame& frame_;
  const Trails& trails_;
  const DrawOptions& options_;
  Extent extent_;
  double width_ = 0.0, scale_ = 0.0, map_height_ = 0.0, left_ = 0.0, robot_px_ = 0.0;
  Links links_;
  bool old_edges_ = false, broken_edges_ = false;
  Vec2 legend_at_{};
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

void Picture::title() {
  const std::string name = setting_.name.empty() ? "Banyan" : setting_.name;
  text({margin_px, 28.0}, 19.0, name, " font-weight=\"bold\"");
  std::string words = setting_.algorithm + (setting_.reading.empty() ? "" : ", " + setting_.reading);
  words += "   ·   t = " + in_decimals(frame_.time_s, 1) + " s   ·   " + std::to_string(frame_.robots.size()) +
           " robots   ·   range " + in_decimals(setting_.range_m, 2) + " m";
  words += setting_.line_of_sight ? ", line of sight" : "";
  words += "   ·   seed " + std::to_string(setting_.seed);
  text({margin_px, 50.0}, 14.0, words, " fill=\"#444444\"");
}

void Picture::obstacles() {
  for (const world::Obstacle& obstacle : setting_.obstacles) {
    if (const auto* disc = std::get_if<world::Disc>(&obstacle)) {
      const Vec2 at = screen(disc->center);
      out_.put("<circle");
      attribute("cx", at.x);
      attribute("cy", at.y);
      attribute("r", disc->radius_m * scale_);
      attribute("fill", palette::obstacle.hex);
      out_.put("/>\n");
    } else if (const auto* box = std::get_if<world::Box>(&obstacle)) {
      out_.put("<path");
      attribute("fill", palette::obstacle.hex);
      out_.put(" d=\"");
      char command = 'M';
      for (const Vec2 corner : corners(*box)) {
        move_to(screen(corner), command);
        command = 'L';
      }
      out_.put("Z\"/>\n");
    } else if (const auto* wall = std::get_if<world::Wall>(&obstacle)) {
      path(palette::obstacle, 4.0, [&] { segment(wall->from, wall->to); }, " stroke-linecap=\"round\"");
    }
  }
}

void Picture::radio() {
  const auto pairs = [&](const auto& list) {
    return [&, this] {
      for (const auto& [i, j] : list) segment(frame_.robots[i].position, frame_.robots[j].position);
    };
  };
  // Where everybody hears everybody, links would cover all else: the more there are, the finer.
  const double robots = std::max(1.0, static_cast<double>(frame_.robots.size()));
  const double per_robot = static_cast<double>(links_.open.size()) / robots;
  const double width = per_robot > 20.0 ? 0.25 : per_robot > 8.0 ? 0.5 : 0.8;
  if (options_.links && !links_.open.empty()) path(palette::link, width, pairs(links_.open));
  if (options_.blocked_links && !links_.blocked.empty()) {
    path(palette::blocked, width, pairs(links_.blocked), " stroke-dasharray=\"2 3\"");
  }
}

void Picture::trails() {
  for (std::size_t i = 0; i < trails_.size() && i < frame_.robots.size(); ++i) {
    if (trails_[i].size() < 2) continue;
    const RobotFrame& robot = frame_.robots[i];
    const Color& color = robot.role == Role::spare ? palette::trail : color_of(robot.role, robot.alive);
    path(color, std::max(1.0, 0.35 * robot_px_), [&] {
      char command = 'M';
      for (const Vec2 p : trails_[i]) {
        move_to(screen(p), command);
        command = 'L';
      }
    }, " stroke-opacity=\"0.45\" stroke-linejoin=\"round\" stroke-linecap=\"round\"");
  }
}

void Picture::targets() {
  for (const TargetFrame& target : frame_.targets) {
    const Vec2 at = screen(target.position);
    const double radius = std::max(setting_.target_tolerance_m * scale_, robot_px_ + 3.0);
    out_.put("<circle");
    attribute("cx", at.x);
    attribute("cy", at.y);
    attribute("r", radius);
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

template <class Which>
void Picture::edges(std::int32_t RobotFrame::*to, const Which& which) {
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
  const auto broken = [this](bool is_linked) {
    broken_edges_ = broken_edges_ || !is_linked;
    return !is_linked;
  };
  old_edges_ = std::any_of(frame_.robots.begin(), frame_.robots.end(), [this](const RobotFrame& r) {
    return r.alive && r.role != Role::spare && valid(r.old_parent);
  });
  path(palette::tree, width, [&] { edges(&RobotFrame::parent, open); }, " stroke-linecap=\"round\"");
  path(palette::old_tree, 0.8 * width, [&] { edges(&RobotFrame::old_parent, open); }, " stroke-dasharray=\"6 4\"");
  path(palette::root, width, [&] {
    edges(&RobotFrame::parent, broken);
    edges(&RobotFrame::old_parent, broken);
  }, " stroke-dasharray=\"2 3\"");
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
  circle(radius_px, color.hex, "#1a1a1a", std::min(1.0, 0.18 * radius_px));
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
  path(palette::tree, std::clamp(0.3 * robot_px_, 0.8, 2.0), [&] {
    for (const RobotFrame& robot : frame_.robots) {
      if (!robot.alive) continue;
      const Vec2 at = screen(robot.position);
      const Vec2 ahead = unit_vector(robot.heading_rad);
      move_to(at, 'M');
      move_to(at + 1.7 * symbol_px(robot.role) * Vec2{ahead.x, -ahead.y}, 'L');
    }
  }, " stroke-linecap=\"round\"");
}

void Picture::robots(std::initializer_list<Role> roles) {
  for (const Role role : roles) {
    for (const RobotFrame& robot : frame_.robots) {
      if (robot.role != role) continue;
      robot_symbol(screen(robot.position), robot.role, robot.alive, symbol_px(role));
      out_.put('\n');
    }
  }
}

constexpr std::string_view halo =
    " stroke=\"#ffffff\" stroke-width=\"3\" stroke-linejoin=\"round\" paint-order=\"stroke\"";

void Picture::ids() {
  const double size = std::clamp(1.6 * robot_px_, 8.0, 13.0);
  for (std::size_t k = 0; k < frame_.targets.size(); ++k) {
    const Vec2 at = screen(frame_.targets[k].position);
    const double away = std::max(setting_.target_tolerance_m * scale_, robot_px_ + 3.0) * 0.75 + 3.0;
    // Towards the inside of the picture, so that a label never leaves it.
    const bool right = at.x < width_ - 4.0 * margin_px;
    std::string label("T");
    label += std::to_string(k);
    text(at + Vec2{right ? away : -away, -away}, 15.0, label,
         std::string(" fill=\"#8f3f6d\" font-weight=\"bold\"") + std::string(halo) +
             (right ? "" : " text-anchor=\"end\""));
  }
  if (!options_.ids) return;
  for (std::size_t i = 0; i < frame_.robots.size(); ++i) {
    text(screen(frame_.robots[i].position) + Vec2{1.2 * robot_px_, 1.2 * robot_px_ + 0.5 * size}, size,
         std::to_string(i), halo);
  }
}

void Picture::legend_symbol(const std::function<void(Vec2)>& symbol, const std::string& words) {
  const double width = 46.0 + 7.3 * static_cast<double>(words.size());
  if (legend_at_.x > margin_px && legend_at_.x + width > width_ - margin_px) {
    legend_at_ = {margin_px, legend_at_.y + legend_row_px};
  }
  symbol(legend_at_ + Vec2{12.0, 0.0});
  text(legend_at_ + Vec2{30.0, 4.5}, 13.0, words);
  legend_at_.x += width;
}

void Picture::legend_entries() {
  std::array<std::size_t, 4> count{};
  std::size_t dead = 0;
  for (const RobotFrame& robot : frame_.robots) {
    robot.alive ? ++count[static_cast<std::size_t>(robot.role)] : ++dead;
  }
  for (const Role role : {Role::root, Role::worker, Role::connector, Role::spare}) {
    legend_symbol([&](Vec2 at) { robot_symbol(at, role, true, 5.5); },
                  std::string(name_of(role)) + " " + std::to_string(count[static_cast<std::size_t>(role)]));
  }
  if (dead > 0) {
    legend_symbol([&](Vec2 at) { robot_symbol(at, Role::spare, false, 5.5); }, "dead " + std::to_string(dead));
  }
  const auto stroke = [&](const Color& color, double width_px, std::string_view more) {
    return [this, &color, width_px, more](Vec2 at) {
      path(color, width_px, [&] {
        move_to(at - Vec2{12.0, 0.0}, 'M');
        move_to(at + Vec2{12.0, 0.0}, 'L');
      }, more);
    };
  };
  legend_symbol(stroke(palette::tree, 3.0, ""), "tree");
  if (old_edges_) legend_symbol(stroke(palette::old_tree, 2.5, " stroke-dasharray=\"6 4\""), "old tree");
  if (broken_edges_) legend_symbol(stroke(palette::root, 3.0, " stroke-dasharray=\"2 3\""), "broken edge");
  if (options_.links && !links_.open.empty()) legend_symbol(stroke(palette::link, 1.2, ""), "radio link");
  if (options_.blocked_links && !links_.blocked.empty()) {
    legend_symbol(stroke(palette::blocked, 1.2, " stroke-dasharray=\"2 3\""), "no line of sight");
  }
  if (!frame_.targets.empty()) {
    legend_symbol([&](Vec2 at) {
      out_.put("<circle");
      attribute("cx", at.x);
      attribute("cy", at.y);
      attribute("r", 7.0);
      attribute("fill", palette::target.hex);
      attribute("fill-opacity", 0.18);
      attribute("stroke", palette::target.hex);
      attribute("stroke-width", 2.0);
      out_.put("/>");
    }, "target, tolerance");
  }
  const bool trails = std::any_of(trails_.begin(), trails_.end(), [](const auto& t) { return t.size() > 1; });
  if (trails) {
    legend_symbol(stroke(palette::connector, 2.5, " stroke-opacity=\"0.45\""),
                  "trail, " + in_decimals(options_.trail_s, 0) + " s");
  }
}

void Picture::scale_bar() {
  const double length_m = nice_length(0.22 * (width_ - 2.0 * margin_px) / scale_);
  const double right = width_ - margin_px;
  const double y = title_px - 12.0;
  const double length_px = length_m * scale_;
  path(palette::tree, 1.6, [&] {
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
  text({right - length_px / 2.0, y - 8.0}, 13.0, words.view(), " text-anchor=\"middle\"");
}

std::string Picture::svg() {
  Text body;
  std::swap(body, out_);
  title();
  scale_bar();
  obstacles();
  radio();
  trails();
  targets();
  // Headings below the bodies, so that only what sticks out is seen; spares below the tree, and
  // the few that matter on top of the many.
  headings();
  robots({Role::spare});
  trees();
  robots({Role::connector, Role::worker, Role::root});
  ids();
  legend_at_ = {margin_px, map_bottom() + 4.0};
  double height = map_bottom();
  if (options_.legend) {
    legend_entries();
    height = legend_at_.y + 20.0;
  }
  std::swap(body, out_);
  out_.put("<svg xmlns=\"http://www.w3.org/2000/svg\"");
  attribute("width", width_);
  attribute("height", height);
  out_.put(" viewBox=\"0 0 ");
  number(width_);
  out_.put(' ');
  number(height);
  out_.put("\" font-family=\"Helvetica, Arial, sans-serif\">\n");
  out_.put("<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n");
  out_.put(body.view());
  out_.put("</svg>\n");
  return std::string(out_.view());
}

}  // namespace

std::string draw_svg(const Setting& setting, const Frame& frame, const Trails& trails, const DrawOptions& options) {
  return Picture(setting, frame, trails, options).svg();
}

std::string draw_svg(Recording& recording, double time_s, const DrawOptions& options) {
  const Frame frame = recording.frame_at(time_s);
  Trails trails(frame.robots.size());
  double next_s = 0.0;
  if (options.trail_s > 0.0) {
    recording.for_each(
        [&](const Frame& earlier) {
          if (earlier.time_s + 1e-9 < next_s && earlier.tick != frame.tick) return true;
          next_s = earlier.time_s + trail_step_s;
          const std::size_t n = std::min(earlier.robots.size(), trails.size());
          for (std::size_t i = 0; i < n; ++i) {
            const Vec2 p = earlier.robots[i].position;
            if (trails[i].empty() || !(trails[i].back() == p)) trails[i].push_back(p);
          }
          return true;
        },
        std::max(0.0, frame.time_s - options.trail_s), frame.time_s);
  }
  return draw_svg(recording.setting_at(frame.time_s), frame, trails, options);
}

}  // namespace banyan::record
