// SPDX-License-Identifier: MIT
// What a robot of cohesive control broadcasts (docs/baselines.md).
#pragma once

#include <array>
#include <cstdint>

#include "banyan/controller/core/fixed_point.hpp"
#include "banyan/controller/core/report.hpp"
#include "banyan/controller/core/wire.hpp"

namespace banyan::baselines::cohesion {

inline constexpr std::size_t most_said_sectors = 3;
inline constexpr std::size_t most_leaders = 8;
inline constexpr float per_rad = 10000.0F;   // units of an angle
inline constexpr float per_speed = 100.0F;   // of a velocity, which is in units of K
inline constexpr float per_help = 64.0F;     // of a cry for help
inline constexpr float per_density = 16.0F;  // of a density
inline constexpr std::uint8_t unknown_depth = 255;

// Where the sender sees a neighbour. Who sees both learns how the sender is turned.
struct Mention {
  RobotId id = nobody;
  std::uint16_t bearing = 0;  // counter-clockwise from straight on

  friend bool operator==(const Mention&, const Mention&) = default;
};

// The mean angle of open sectors along a boundary, up to the sender's, and of how many.
struct Mean {
  std::uint16_t angle = 0;
  std::uint8_t sectors = 0;

  [[nodiscard]] float rad() const noexcept { return static_cast<float>(angle) / per_rad; }
  friend bool operator==(const Mean&, const Mean&) = default;
};

// An open sector: counter-clockwise from one neighbour to the next there is nothing of the swarm. With no sectors in
// its means it is none, and only says where two neighbours are.
struct SaidSector {
  Mention right, left;
  Mean right_mean, left_mean;  // along the boundary that comes in from there

  [[nodiscard]] bool is_open() const noexcept { return right_mean.sectors > 0 && left_mean.sectors > 0; }
  friend bool operator==(const SaidSector&, const SaidSector&) = default;
};

struct SaidVelocity {
  std::int8_t forward = 0;
  std::int8_t left = 0;

  [[nodiscard]] Vec2 in_frame() const noexcept {
    return Vec2{static_cast<float>(forward), static_cast<float>(left)} / per_speed;
  }
  friend bool operator==(const SaidVelocity&, const SaidVelocity&) = default;
};
[[nodiscard]] constexpr SaidVelocity to_wire(Vec2 v) noexcept {
  return {to_fixed<std::int8_t>(v.x, per_speed), to_fixed<std::int8_t>(v.y, per_speed)};
}

struct SaidLeader {
  RobotId id = nobody;
  std::uint8_t hops = 0;  // to it
  SaidVelocity velocity;  // its own, in the frame of the sender

  friend bool operator==(const SaidLeader&, const SaidLeader&) = default;
};

struct Message {
  static constexpr std::uint8_t blocks = 0;
  RobotId id = nobody;
  bool candidate = false;  // a sector may be open
  bool matching = false;   // and both its neighbours are candidates
  std::array<SaidSector, most_said_sectors> sectors{};
  SaidVelocity velocity;  // its own
  std::array<SaidLeader, most_leaders> leaders{};
  std::uint8_t depth = unknown_depth;      // hops to a large boundary
  std::uint8_t thickness = unknown_depth;  // the largest depth that reaches so far,
  std::uint8_t hops = 0;                   // and hops to it
  std::uint8_t help = 0;
  std::uint8_t density = 0;
  RobotId root = nobody;      // the robot that it believes to be root,
  std::uint8_t root_age = 0;  // from so many ticks ago

  friend bool operator==(const Message&, const Message&) = default;
};

template <class Visitor, class Sector>
constexpr void visit_sector(Visitor& visit, const char* const (&names)[8], Sector& s) noexcept {
  visit.robot(names[0], "a neighbour where an open sector begins, or any, -1: none", s.right.id);
  visit.scaled(names[1], "where it is, rad counter-clockwise from straight on", s.right.bearing, per_rad);
  visit.robot(names[2], "the neighbour where it ends, or any, -1: none", s.left.id);
  visit.scaled(names[3], "where it is", s.left.bearing, per_rad);
  visit.scaled(names[4], "mean of the open sectors along the boundary from the first, rad", s.right_mean.angle,
               per_rad);
  visit.number(names[5], "how many they are, 0: no open sector", s.right_mean.sectors);
  visit.scaled(names[6], "mean of the open sectors along the boundary from the other, rad", s.left_mean.angle, per_rad);
  visit.number(names[7], "how many they are, 0: no open sector", s.left_mean.sectors);
}

inline constexpr const char* sector_names[most_said_sectors][8] = {
    {"right_1", "right_bearing_1", "left_1", "left_bearing_1", "right_mean_1", "right_count_1", "left_mean_1",
     "left_count_1"},
    {"right_2", "right_bearing_2", "left_2", "left_bearing_2", "right_mean_2", "right_count_2", "left_mean_2",
     "left_count_2"},
    {"right_3", "right_bearing_3", "left_3", "left_bearing_3", "right_mean_3", "right_count_3", "left_mean_3",
     "left_count_3"}};
inline constexpr const char* leader_names[most_leaders][4] = {
    {"leader_1", "leader_hops_1", "leader_x_1", "leader_y_1"},
    {"leader_2", "leader_hops_2", "leader_x_2", "leader_y_2"},
    {"leader_3", "leader_hops_3", "leader_x_3", "leader_y_3"},
    {"leader_4", "leader_hops_4", "leader_x_4", "leader_y_4"},
    {"leader_5", "leader_hops_5", "leader_x_5", "leader_y_5"},
    {"leader_6", "leader_hops_6", "leader_x_6", "leader_y_6"},
    {"leader_7", "leader_hops_7", "leader_x_7", "leader_y_7"},
    {"leader_8", "leader_hops_8", "leader_x_8", "leader_y_8"}};

template <class Visitor, class M> constexpr void visit_all(Visitor& visit, M& m) noexcept {
  visit.flag("candidate", "a sector between two neighbours may be open", m.candidate);
  visit.flag("matching", "and both these neighbours are candidates", m.matching);
  visit.robot("id", "of the sender", m.id);
  for (std::size_t k = 0; k < most_said_sectors; ++k) visit_sector(visit, sector_names[k], m.sectors[k]);
  visit.scaled("velocity_x", "its own, by the speed gain", m.velocity.forward, per_speed);
  visit.scaled("velocity_y", "its own, by the speed gain", m.velocity.left, per_speed);
  for (std::size_t k = 0; k < most_leaders; ++k) {
    visit.robot(leader_names[k][0], "a leader, the nearest first, -1: none", m.leaders[k].id);
    visit.number(leader_names[k][1], "hops to it", m.leaders[k].hops);
    visit.scaled(leader_names[k][2], "its velocity in the sender's frame", m.leaders[k].velocity.forward, per_speed);
    visit.scaled(leader_names[k][3], "its velocity in the sender's frame", m.leaders[k].velocity.left, per_speed);
  }
  visit.known("depth", "hops to a large boundary, -1: unknown", m.depth);
  visit.known("thickness", "the largest depth that reaches so far, -1: unknown", m.thickness);
  visit.number("hops", "to the robot with that depth", m.hops);
  visit.scaled("help", "that a leader with few neighbours needs, less with each hop", m.help, per_help);
  visit.scaled("density", "robots in a square as wide as the longest link", m.density, per_density);
  visit.robot("root", "the robot that it believes to be root, -1: nobody", m.root);
  visit.number("root_age", "ticks since that said so", m.root_age);
}
template <class Visitor> constexpr void visit_fields(Visitor& visit, Message& m) noexcept { visit_all(visit, m); }
template <class Visitor> constexpr void visit_fields(Visitor& visit, const Message& m) noexcept { visit_all(visit, m); }

}  // namespace banyan::baselines::cohesion
