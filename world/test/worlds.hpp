// SPDX-License-Identifier: MIT
// Worlds that several tests share, and what an onlooker can tell of the trees in them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <string>
#include <vector>

#include "banyan/algorithms/inside.hpp"
#include "banyan/controller/core/trig.hpp"
#include "banyan/world/bodies.hpp"
#include "banyan/world/random.hpp"
#include "banyan/world/threads.hpp"
#include "banyan/world/world.hpp"
#include "plain_scenario.hpp"

namespace banyan::world {

// BANYAN_LONG=1 asks for long searches.
inline bool long_search() {
  const char* value = std::getenv("BANYAN_LONG");
  return value != nullptr && std::string(value) != "0" && *value != '\0';
}

// The paper's conditions (Sec. IV-B): a compact cluster of robots, targets on a ring.
inline Scenario ring(const std::string& algorithm, std::size_t robots, std::size_t targets, double radius_m,
                     std::uint64_t seed) {
  Scenario s = plain_scenario();
  s.mission.algorithm = algorithm;
  s.swarm.robots = robots;
  s.targets = RingTargets{targets, radius_m};
  s.seed = seed;
  return s;
}

// Everything at once that makes a run hard.
inline Scenario hostile(const std::string& algorithm, std::size_t robots, std::uint64_t seed) {
  Scenario s = ring(algorithm, robots, 3, 4.0, seed);
  s.radio.line_of_sight = true;
  s.radio.loss = 0.3;
  s.radio.range_noise_m = 0.02;
  s.radio.bearing_noise_rad = 0.02;
  s.robot.wheel_noise = 0.05;
  s.robot.odometry_noise = 0.05;
  return s;
}

inline Poses one_robot(Vec2 position = {}, double heading_rad = 0.0) {
  return {{position}, {unit_vector(heading_rad)}};
}

// Of one, two and four threads, after every tick.
inline void expect_the_same_on_any_number_of_threads(const Scenario& s, int ticks, const std::string& what) {
  World one(s), two(s), four(s);
  Executor pair(2), team(4);
  for (int t = 0; t < ticks; ++t) {
    one.step();
    two.step(pair);
    four.step(team);
    ASSERT_EQ(one.hash(), two.hash()) << what << ", tick " << t;
    ASSERT_EQ(one.hash(), four.hash()) << what << ", tick " << t;
    for (const Vec2 p : one.positions()) ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y)) << what;
  }
}

// What robot i broadcast last, as it travels.
inline std::vector<std::uint8_t> said(const World& world, std::size_t i) {
  std::vector<std::uint8_t> bytes(largest_wire);
  bytes.resize(world.swarm().send(i, bytes));
  return bytes;
}

// The sizes of the parts of the network, by which living robots are within range of each other.
inline std::vector<std::size_t> part_sizes_by_range(const World& world) {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < world.size(); ++i)
    if (world.alive()[i] != 0) open.push_back(i);
  std::vector<std::size_t> sizes;
  while (!open.empty()) {
    sizes.push_back(0);
    std::vector<std::size_t> front{open.back()};
    open.pop_back();
    while (!front.empty()) {
      const Vec2 here = world.positions()[front.back()];
      front.pop_back();
      ++sizes.back();
      const auto reached = std::stable_partition(open.begin(), open.end(), [&](std::size_t j) {
        return distance(here, world.positions()[j]) >= world.scenario().radio.range_m;
      });
      front.insert(front.end(), reached, open.end());
      open.erase(reached, open.end());
    }
  }
  return sizes;
}

inline std::size_t parts_by_range(const World& world) { return part_sizes_by_range(world).size(); }

inline int living_roots(const World& world) {
  int count = 0;
  for (std::size_t i = 0; i < world.size(); ++i)
    count += world.alive()[i] != 0 && world.reports()[i].role == Role::root ? 1 : 0;
  return count;
}

// The links that a robot promises to keep.
inline std::vector<RobotId> links_of(const Report& r) {
  std::vector<RobotId> links;
  if (r.parent != nobody) links.push_back(r.parent);
  for (const RobotId id : r.kept)
    if (id != nobody) links.push_back(id);
  return links;
}

inline bool all_held(const World& world) {
  for (std::size_t k = 0; k < world.targets().size(); ++k)
    if (!world.holder(k)) return false;
  return true;
}

inline void run_until(World& world, std::uint64_t tick) {
  while (world.tick() < tick) world.step();
}

// Where a robot believes entry k of its table to be, m.
inline Vec2 believed_m(const World& world, const Neighbors& table, int k) {
  return Vec2{table.position(k).x, table.position(k).y} * world.scenario().radio.range_m;
}

}  // namespace banyan::world
