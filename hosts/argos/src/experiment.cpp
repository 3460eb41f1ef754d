// SPDX-License-Identifier: MIT
#include "banyan/hosts/argos/experiment.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "banyan/hosts/argos/settings.hpp"
#include "banyan/world/decimal.hpp"
#include "banyan/world/placement.hpp"

namespace banyan::argos {
namespace {

constexpr std::array<RobotKind, 2> kinds{
    {{"kheperaiv", "kheperaiv_proximity", 0.0704, 0.1054}, {"foot-bot", "footbot_proximity", 0.085036758, 0.14}}};

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      default: out += c;
    }
  }
  return out;
}

std::string number(double value) { return world::number_text(value); }

// Elements with attributes, two spaces a level.
class Xml {
 public:
  using Attributes = std::vector<Attribute>;
  void open(std::string_view name, const Attributes& attributes = {}) {
    line(name, attributes, ">");
    open_.emplace_back(name);
  }
  void close() {
    const std::string name = open_.back();
    open_.pop_back();
    text_ += indent() + "</" + name + ">\n";
  }
  void leaf(std::string_view name, const Attributes& attributes) { line(name, attributes, " />"); }
  // Two hyphens would end a comment before its time.
  void comment(std::string_view words) {
    std::string safe(words);
    for (std::size_t at = safe.find("--"); at != std::string::npos; at = safe.find("--", at))
      safe.replace(at, 2, "- -");
    text_ += indent() + "<!-- " + safe + " -->\n";
  }
  [[nodiscard]] std::string text() const { return "<?xml version=\"1.0\" ?>\n" + text_; }

 private:
  [[nodiscard]] std::string indent() const {
    std::string spaces(2 * open_.size(), ' ');
    return spaces;
  }
  void line(std::string_view name, const Attributes& attributes, const char* end) {
    text_ += indent() + "<" + std::string(name);
    for (const Attribute& attribute : attributes)
      text_ += " " + attribute.name + "=\"" + escaped(attribute.value) + "\"";
    text_ += std::string(end) + "\n";
  }
  std::string text_;
  std::vector<std::string> open_;
};

constexpr double room_m = 10.0;  // the literal readings wander off, and ARGoS has nothing outside the arena

// The least rectangle around everything that the scenario names, and room to drive.
struct Extent {
  world::Vec2 low, high;
  void add(world::Vec2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
};

void add_obstacle(Extent& extent, const world::Obstacle& obstacle) {
  const auto around = [&](world::Vec2 center, double reach) {
    extent.add(center - world::Vec2{reach, reach});
    extent.add(center + world::Vec2{reach, reach});
  };
  if (const auto* disc = std::get_if<world::Disc>(&obstacle)) around(disc->center, disc->radius_m);
  if (const auto* box = std::get_if<world::Box>(&obstacle)) around(box->center, 0.5 * norm(box->size));
  if (const auto* wall = std::get_if<world::Wall>(&obstacle)) {
    extent.add(wall->from);
    extent.add(wall->to);
  }
}

Extent extent_of(const world::Scenario& scenario) {
  Extent extent;
  for (const world::Vec2 p : world::place(scenario).position) extent.add(p);
  for (const world::Vec2 p : world::target_positions(scenario)) extent.add(p);
  for (const world::Obstacle& obstacle : scenario.obstacles) add_obstacle(extent, obstacle);
  for (const world::Event& event : scenario.events) {
    if (const auto* added = std::get_if<world::AddTarget>(&event.action)) extent.add(added->position);
    if (const auto* moved = std::get_if<world::MoveTarget>(&event.action)) extent.add(moved->position);
  }
  const auto outwards = [&](double x) { return x < 0.0 ? std::floor(x - room_m) : std::ceil(x + room_m); };
  return {{outwards(std::min(extent.low.x, -1e-9)), outwards(std::min(extent.low.y, -1e-9))},
          {outwards(std::max(extent.high.x, 0.0)), outwards(std::max(extent.high.y, 0.0))}};
}

void add_controller(Xml& xml, const world::Scenario& scenario, const Experiment& experiment) {
  xml.open("controllers");
  xml.open("banyan_controller", {{"id", "banyan"}, {"library", experiment.library}});
  xml.open("actuators");
  xml.leaf("range_and_bearing", {{"implementation", "default"}});
  xml.leaf("differential_steering", {{"implementation", "default"}});
  xml.close();
  xml.open("sensors");
  Xml::Attributes ears{{"implementation", "medium"}, {"medium", "rab"}};
  if (scenario.radio.loss > 0.0) ears.push_back({"packet_drop_prob", number(scenario.radio.loss)});
  xml.leaf("range_and_bearing", ears);
  xml.leaf("differential_steering", {{"implementation", "default"}});
  xml.leaf("positioning", {{"implementation", "default"}});
  if (experiment.eyes == Eyes::sensors && !scenario.obstacles.empty())
    xml.leaf(experiment.robot->proximity, {{"implementation", "default"}});
  xml.close();
  xml.leaf("params", attributes_of(scenario));
  xml.close();
  xml.close();
}

void add_mission(Xml& xml, const Experiment& experiment) {
  xml.open("loop_functions", {{"library", experiment.library}, {"label", "banyan_loop_functions"}});
  Xml::Attributes attributes{{"scenario", experiment.world},
                             {"out", experiment.out},
                             {"robot", std::string(experiment.robot->entity)},
                             {"controller", "banyan"},
                             {"obstacles", experiment.eyes == Eyes::sensors ? "sensors" : "world"}};
  if (experiment.force) attributes.push_back({"force", "true"});
  xml.leaf("mission", attributes);
  xml.close();
}

void add_arena(Xml& xml, const Extent& extent) {
  const world::Vec2 size = extent.high - extent.low, center = 0.5 * (extent.low + extent.high);
  xml.comment("The loop functions place robots and obstacles.");
  // ARGoS' index of the radio needs a height of at least one metre.
  xml.leaf("arena", {{"size", number(size.x) + "," + number(size.y) + ",1"},
                     {"center", number(center.x) + "," + number(center.y) + ",0.4"}});
  xml.open("physics_engines");
  xml.leaf("dynamics2d", {{"id", "dyn2d"}});
  xml.close();
}

void add_medium(Xml& xml, const world::Scenario& scenario, Sight sight) {
  xml.open("media");
  if (sight == Sight::exact && scenario.radio.line_of_sight)
    xml.leaf("banyan_exact_range_and_bearing", {{"id", "rab"}});
  else
    xml.leaf("range_and_bearing",
             {{"id", "rab"}, {"check_occlusions", scenario.radio.line_of_sight ? "true" : "false"}});
  xml.close();
}

void add_view(Xml& xml, const Extent& extent, const std::string& library) {
  const world::Vec2 center = 0.5 * (extent.low + extent.high);
  const double height_m = 2.0 + std::max(extent.high.x - extent.low.x, extent.high.y - extent.low.y) - 2.0 * room_m;
  const std::string at = number(center.x) + "," + number(center.y);
  xml.open("visualization");
  xml.open("qt-opengl");
  xml.leaf("user_functions", {{"library", library}, {"label", "banyan_qt_user_functions"}});
  xml.open("camera");
  xml.open("placements");
  xml.leaf("placement", {{"index", "0"},
                         {"position", at + "," + number(height_m)},
                         {"look_at", at + ",0"},
                         {"up", "0,1,0"},
                         {"lens_focal_length", "20"}});
  xml.close();
  xml.close();
  xml.close();
  xml.close();
}

}  // namespace

std::span<const RobotKind> robot_kinds() noexcept { return kinds; }

const RobotKind* find_robot_kind(std::string_view entity) noexcept {
  const auto found =
      std::find_if(kinds.begin(), kinds.end(), [&](const RobotKind& kind) { return kind.entity == entity; });
  return found == kinds.end() ? nullptr : &*found;
}

world::Scenario with_robot(world::Scenario scenario, const RobotKind& kind) {
  scenario.robot.radius_m = kind.radius_m;
  scenario.robot.wheel_distance_m = kind.wheel_distance_m;
  return scenario;
}

std::string experiment_xml(const world::Scenario& scenario, const Experiment& experiment) {
  const Extent extent = extent_of(scenario);
  Xml xml;
  xml.comment("Written by " + experiment.made_by);
  xml.open("argos-configuration");
  xml.open("framework");
  xml.leaf("system", {{"threads", "0"}});
  xml.comment("length 0: the mission ends by itself. The seed places the robots, too.");
  xml.leaf("experiment", {{"length", "0"},
                          {"ticks_per_second", number(std::round(1.0 / scenario.tick_s))},
                          {"random_seed", std::to_string(scenario.seed)}});
  xml.close();
  add_controller(xml, scenario, experiment);
  add_mission(xml, experiment);
  add_arena(xml, extent);
  add_medium(xml, scenario, experiment.sight);
  add_view(xml, extent, experiment.library);
  xml.close();
  return xml.text();
}

}  // namespace banyan::argos
