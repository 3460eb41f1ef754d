// SPDX-License-Identifier: MIT
// A mission small enough for a chip: robots that are points in an open plane, each run by itself, as a host on a robot
// runs it: it receives bytes, steps and sends bytes. The world is exact (no loss, no bodies), so that a chip and a
// computer must agree on every bit.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "banyan/controller/core/algorithm.hpp"
#include "banyan/controller/core/trig.hpp"
#include "banyan/controller/core/wire.hpp"

namespace banyan::chip {

inline constexpr std::size_t targets = 3;  // robot 0 is the root, the next three are the workers
inline constexpr float target_distance_m = 4.0F;
inline constexpr float pitch_m = 0.25F;
inline constexpr int ticks = 300;

// A count that grows with the instructions carried out; its differences are taken modulo 2^24.
using Clock = std::uint32_t (*)() noexcept;
inline std::uint32_t between(std::uint32_t begun, std::uint32_t ended) noexcept { return (ended - begun) & 0xFFFFFF; }

struct Cost {
  std::uint64_t robot_steps = 0;
  std::uint64_t packets = 0;    // heard
  std::uint64_t receiving = 0;  // in counts: messages read
  std::uint64_t stepping = 0;   // a step, its message written
  std::uint32_t longest = 0;    // of both, in one robot-step
};

class ChipMission {
 public:
  ChipMission(const Algorithm& algorithm, std::size_t robots) {
    Setup setup;
    setup.platform.line_of_sight = false;
    for (std::size_t i = 0; i < robots; ++i) {
      const Member member{static_cast<RobotId>(i), i >= 1 && i <= targets, i == 0};
      robots_.push_back({algorithm.make(setup, {&member, 1}), place(i), {1.0F, 0.0F}, {}, {}});
      robots_.back().size = robots_.back().swarm->send(0, robots_.back().said);
    }
    heard_.reserve(robots);
  }

  // All robots, once: everybody hears what was said in the tick before, from where its sender was then.
  void tick(Clock clock, Cost& cost) {
    std::vector<Said> said;
    for (const Robot& robot : robots_) said.push_back({robot.place, robot.said, robot.size});
    for (std::size_t i = 0; i < robots_.size(); ++i) step(i, said, clock, cost);
    for (Robot& robot : robots_) robot.move();
  }

  void add_to(Digest& digest) const {
    for (const Robot& robot : robots_) {
      digest.add(robot.place.x), digest.add(robot.place.y);
      robot.swarm->add_to(digest, 0);
    }
  }

 private:
  using Bytes = std::array<std::uint8_t, largest_wire>;

  struct Robot {
    std::unique_ptr<Swarm> swarm;
    Vec2 place;    // m
    Vec2 heading;  // unit vector
    Velocity command;
    Odometry odometry;
    Bytes said{};
    std::size_t size = 0;

    // An arc, by its chord.
    void move() {
      constexpr Platform platform;
      const float turn = command.turn_rad_s * platform.tick_s;
      const Vec2 half = unit_vector(0.5F * turn);
      const Vec2 chord = half * (command.forward_m_s * platform.tick_s);
      place = place + rotate(heading, chord);
      heading = rotate(heading, unit_vector(turn));
      odometry = {chord.x, chord.y, turn};
    }
  };
  struct Said {
    Vec2 place;
    Bytes bytes;
    std::size_t size;
  };

  // The robots in a square, the first in its middle, so that the root and the workers are together.
  static Vec2 place(std::size_t i) noexcept {
    int x = 0, y = 0, dx = 1, dy = 0, side = 1, walked = 0, turns = 0;
    for (std::size_t k = 0; k < i; ++k) {
      x += dx, y += dy;
      if (++walked < side) continue;
      walked = 0;
      const int old_dx = dx;
      dx = -dy, dy = old_dx;
      if (++turns % 2 == 0) ++side;
    }
    return Vec2{static_cast<float>(x), static_cast<float>(y)} * pitch_m;
  }

  static Vec2 target_of(std::size_t worker) noexcept {
    return unit_vector(2.0943951F * static_cast<float>(worker)) * target_distance_m;
  }

  void step(std::size_t i, const std::vector<Said>& said, Clock clock, Cost& cost) {
    Robot& robot = robots_[i];
    constexpr float range_m = Platform{}.communication_range_m;
    heard_.clear();
    std::uint32_t receiving = 0;
    for (std::size_t k = 0; k < said.size(); ++k) {
      const Vec2 offset = said[k].place - robot.place;
      if (k == i || squared_norm(offset) >= range_m * range_m) continue;
      const std::uint32_t begun = clock();
      const auto sender = robot.swarm->receive(std::span(said[k].bytes).first(said[k].size));
      receiving += between(begun, clock());
      if (sender) heard_.push_back({*sender, 1, rotate_back(robot.heading, offset), 0.0F});
    }
    Sensed sensed{heard_, {}, true};
    sensed.senses.odometry = robot.odometry;
    if (i >= 1 && i <= targets) {
      sensed.senses.orders.sent = true;
      sensed.senses.orders.target = rotate_back(robot.heading, target_of(i) - robot.place);
    }
    Report report;
    const std::uint32_t begun = clock();
    robot.swarm->step(0, {&sensed, 1}, {&robot.command, 1}, {&report, 1});
    robot.swarm->advance();
    robot.size = robot.swarm->send(0, robot.said);
    const std::uint32_t stepping = between(begun, clock());
    ++cost.robot_steps;
    cost.packets += heard_.size();
    cost.receiving += receiving;
    cost.stepping += stepping;
    cost.longest = std::max(cost.longest, receiving + stepping);
  }

  std::vector<Robot> robots_;
  std::vector<Packet> heard_;
};

}  // namespace banyan::chip
