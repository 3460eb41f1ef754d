// SPDX-License-Identifier: MIT
// A frame as foxglove.SceneUpdate (scene.hpp). Robots are cylinders in the colour of their role,
// the tree and the old tree are lists of lines, targets flat discs with their number.
#include "scene.hpp"

#include <string>

#include "banyan/controller/core/trig.hpp"
#include "banyan/record/palette.hpp"
#include "frame_json.hpp"

namespace banyan::record {

namespace {

constexpr double robot_height_m = 0.06;  // Khepera IV
constexpr double wall_height_m = 0.15;

void color(Text& out, const Color& c, double alpha = 1.0) {
  out.put("{\"r\":");
  out.fixed(c.red / 255.0, 3);
  out.put(",\"g\":");
  out.fixed(c.green / 255.0, 3);
  out.put(",\"b\":");
  out.fixed(c.blue / 255.0, 3);
  out.put(",\"a\":");
  out.fixed(alpha, 2);
  out.put('}');
}

void point(Text& out, Vec2 p, double z) {
  out.put("{\"x\":");
  out.fixed(p.x, 3);
  out.put(",\"y\":");
  out.fixed(p.y, 3);
  out.put(",\"z\":");
  out.fixed(z, 3);
  out.put('}');
}

void pose(Text& out, Vec2 p, double z, double angle_rad = 0.0) {
  const Vec2 half = unit_vector(angle_rad / 2.0);  // the quaternion of a turn about z
  out.put("\"pose\":{\"position\":");
  point(out, p, z);
  out.put(",\"orientation\":{\"x\":0,\"y\":0,\"z\":");
  out.fixed(half.y, 4);
  out.put(",\"w\":");
  out.fixed(half.x, 4);
  out.put("}}");
}

void cylinder(Text& out, Vec2 p, double radius_m, double height_m, const Color& c, double alpha = 1.0) {
  out.put('{');
  pose(out, p, height_m / 2.0);
  out.put(",\"size\":");
  point(out, {2.0 * radius_m, 2.0 * radius_m}, height_m);
  out.put(",\"bottom_scale\":1,\"top_scale\":1,\"color\":");
  color(out, c, alpha);
  out.put("},");
}

// Every member of an entity must be there; those not handed in are empty.
struct Entity {
  Text& out;
  double time_s;
  void begin(std::string_view id) const {
    out.put("{\"timestamp\":");
    write_time(out, time_s);
    out.put(",\"frame_id\":\"world\",\"id\":");
    out.json_string(id);
    out.put(",\"lifetime\":{\"sec\":0,\"nsec\":0},\"frame_locked\":false,\"metadata\":[]");
  }
  template <class Fill> void list(std::string_view name, const Fill& fill) const {
    out.put(",\"");
    out.put(name);
    out.put("\":[");
    const std::size_t before = out.size();
    fill();
    if (out.size() > before) out.drop_last();
    out.put(']');
  }
  void empty(std::initializer_list<std::string_view> names) const {
    for (const std::string_view name : names) list(name, [] {});
  }
  void end() const { out.put("},"); }
};

template <class Points> void line_list(Text& out, const Color& c, double thickness_m, const Points& points) {
  out.put("{\"type\":2,");
  pose(out, {}, 0.0);
  out.put(",\"thickness\":");
  out.fixed(thickness_m, 4);
  out.put(",\"scale_invariant\":false,\"points\":[");
  const std::size_t before = out.size();
  points();
  if (out.size() > before) out.drop_last();
  out.put("],\"color\":");
  color(out, c);
  out.put(",\"colors\":[],\"indices\":[]},");
}

void segment(Text& out, Vec2 a, Vec2 b, double z) {
  point(out, a, z);
  out.put(',');
  point(out, b, z);
  out.put(',');
}

bool has_edge(const Frame& frame, const RobotFrame& robot, std::int32_t to) {
  return robot.alive && to >= 0 && static_cast<std::size_t>(to) < frame.robots.size();
}

void robots(const Entity& entity, const Setting& setting, const Frame& frame) {
  Text& out = entity.out;
  entity.begin("robots");
  entity.list("cylinders", [&] {
    for (const RobotFrame& r : frame.robots) {
      cylinder(out, r.position, setting.radius_m, robot_height_m, color_of(r.role, r.alive));
    }
  });
  entity.list("lines", [&] {
    line_list(out, palette::tree, setting.radius_m / 4.0, [&] {
      for (const RobotFrame& r : frame.robots) {
        segment(out, r.position, r.position + setting.radius_m * unit_vector(r.heading_rad), robot_height_m + 0.002);
      }
    });
  });
  entity.empty({"arrows", "cubes", "spheres", "triangles", "texts", "models"});
  entity.end();
}

void trees(const Entity& entity, const Setting& setting, const Frame& frame) {
  Text& out = entity.out;
  const auto edges = [&](std::int32_t RobotFrame::*to, double z) {
    for (const RobotFrame& r : frame.robots) {
      if (!has_edge(frame, r, r.*to)) continue;
      segment(out, r.position, frame.robots[static_cast<std::size_t>(r.*to)].position, z);
    }
  };
  entity.begin("trees");
  entity.list("lines", [&] {
    line_list(out, palette::old_tree, setting.radius_m / 3.0, [&] { edges(&RobotFrame::old_parent, 0.02); });
    line_list(out, palette::tree, setting.radius_m / 3.0, [&] { edges(&RobotFrame::parent, 0.03); });
  });
  entity.empty({"arrows", "cubes", "spheres", "cylinders", "triangles", "texts", "models"});
  entity.end();
}

void targets(const Entity& entity, const Setting& setting, const Frame& frame) {
  Text& out = entity.out;
  entity.begin("targets");
  entity.list("cylinders", [&] {
    for (const TargetFrame& t : frame.targets) {
      if (!t.active) continue;
      cylinder(out, t.position, setting.target_tolerance_m, 0.005, palette::target, 0.5);
    }
  });
  entity.list("texts", [&] {
    for (std::size_t k = 0; k < frame.targets.size(); ++k) {
      if (!frame.targets[k].active) continue;
      out.put('{');
      pose(out, frame.targets[k].position, 0.35);
      out.put(",\"billboard\":true,\"font_size\":0.25,\"scale_invariant\":false,\"color\":");
      color(out, palette::target);
      out.put(",\"text\":\"T");
      out.natural(k);
      out.put("\"},");
    }
  });
  entity.empty({"arrows", "cubes", "spheres", "lines", "triangles", "models"});
  entity.end();
}

void obstacles(const Entity& entity, const Setting& setting) {
  Text& out = entity.out;
  entity.begin("obstacles");
  entity.list("cylinders", [&] {
    for (const world::Obstacle& o : setting.obstacles) {
      const auto* disc = std::get_if<world::Disc>(&o);
      if (disc != nullptr) cylinder(out, disc->center, disc->radius_m, wall_height_m, palette::obstacle);
    }
  });
  entity.list("cubes", [&] {
    for (const world::Obstacle& o : setting.obstacles) {
      const auto* box = std::get_if<world::Box>(&o);
      if (box == nullptr) continue;
      out.put('{');
      pose(out, box->center, wall_height_m / 2.0, box->angle_rad);
      out.put(",\"size\":");
      point(out, box->size, wall_height_m);
      out.put(",\"color\":");
      color(out, palette::obstacle);
      out.put("},");
    }
  });
  entity.list("lines", [&] {
    line_list(out, palette::obstacle, 0.03, [&] {
      for (const world::Obstacle& o : setting.obstacles) {
        if (const auto* wall = std::get_if<world::Wall>(&o)) segment(out, wall->from, wall->to, wall_height_m / 2.0);
      }
    });
  });
  entity.empty({"arrows", "spheres", "triangles", "texts", "models"});
  entity.end();
}

}  // namespace

void write_scene(Text& out, const Setting& setting, const Frame& frame) {
  const Entity entity{out, frame.time_s};
  out.put("{\"deletions\":[],\"entities\":[");
  robots(entity, setting, frame);
  trees(entity, setting, frame);
  targets(entity, setting, frame);
  if (!setting.obstacles.empty()) obstacles(entity, setting);
  out.drop_last();
  out.put("]}");
}

}  // namespace banyan::record
