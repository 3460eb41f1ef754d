// SPDX-License-Identifier: MIT
// Hand-made frames for tests: a swarm on a jittered hexagonal lattice, a tree in it, and a few of
// everything that can be recorded. A function of its arguments only.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "banyan/controller/core/trig.hpp"
#include "banyan/record/recording.hpp"
#include "banyan/world/random.hpp"
#include "plain_scenario.hpp"

namespace banyan::record::test {

inline std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline double uniform(std::uint64_t a, std::uint64_t b) {
  return world::to_uniform(world::bits(7, world::Purpose::placement, a, b));
}

inline Setting sample_setting() {
  Setting setting;
  setting.name = "sample \"ring\" <&>";
  setting.algorithm = "outwards";
  setting.reading = "corrected";
  setting.seed = 18446744073709551615ULL;
  setting.radius_m = 0.0704;
  setting.line_of_sight = true;
  setting.time_limit_s = 300.0;
  setting.obstacles = {world::Disc{{4.0, 0.1}, 0.25}, world::Box{{-2.5, 1.0}, {0.6, 0.2}, 0.5},
                       world::Wall{{-1.0, -2.0}, {1.0, -2.5}}};
  return setting;
}

// Robots within `spread_m`; each has the nearest robot that is closer to the centre as parent.
inline Frame sample_frame(std::size_t robots, double spread_m, std::uint64_t tick) {
  Frame frame;
  frame.tick = tick;
  frame.time_s = static_cast<double>(tick) * 0.1;
  for (std::size_t i = 0; i < robots; ++i) {
    const double turn = 2.399963 * static_cast<double>(i);  // a sunflower: even at any number
    const double r = spread_m * std::sqrt((static_cast<double>(i) + 0.3 * uniform(i, 1)) / static_cast<double>(robots));
    const double drift = 0.002 * static_cast<double>(tick % 1000);
    RobotFrame robot;
    robot.position = (r + drift * r / spread_m) * unit_vector(turn);
    robot.heading_rad = angle_of(unit_vector(turn + 6.0 * uniform(i, 2)));
    robot.role = uniform(i, 3) < 0.5 ? Role::connector : Role::spare;
    if (i + 3 > robots) robot.role = Role::worker;
    if (i == 0) robot.role = Role::root;
    robot.phase = static_cast<Phase>(tick / 50 % 5);
    robot.need = static_cast<Need>(i % 3);
    robot.spare_state = static_cast<SpareState>(i % 3);
    robot.alive = i % 40 != 17;
    robot.connected = robot.alive && i % 11 != 5;
    robot.epoch = static_cast<std::uint16_t>(1 + tick / 250);
    robot.label_m = i % 13 == 3 ? -1.0 : r;
    robot.grant = i % 7 == 2 ? static_cast<std::int32_t>(i / 2) : -1;
    robot.request = i % 5 == 1 ? static_cast<std::int32_t>(i / 3) : -1;
    robot.want_m = 0.25 * static_cast<double>(i % 9);
    frame.robots.push_back(robot);
  }
  for (std::size_t i = 1; i < robots; ++i) {
    double best = 1e9;
    for (std::size_t j = i > 120 ? i - 120 : 0; j < i; ++j) {
      const double d = distance(frame.robots[i].position, frame.robots[j].position);
      if (d < best && frame.robots[j].role != Role::spare) {
        best = d;
        frame.robots[i].parent = static_cast<std::int32_t>(j);
      }
    }
    const std::int32_t parent = frame.robots[i].parent;
    if (parent >= 0) frame.robots[i].depth = frame.robots[static_cast<std::size_t>(parent)].depth + 1;
    if (i % 6 == 4) frame.robots[i].old_parent = static_cast<std::int32_t>(i / 2);
  }
  for (std::size_t k = 0; k < 2 && robots >= 3; ++k) {
    const std::size_t worker = robots - 1 - k;
    frame.robots[worker].target = static_cast<std::int32_t>(k);
    frame.targets.push_back({1.1 * frame.robots[worker].position, static_cast<std::int32_t>(worker)});
    frame.targets.back().position = {std::round(10.0 * frame.targets.back().position.x) / 10.0,
                                     std::round(10.0 * frame.targets.back().position.y) / 10.0};
  }
  return frame;
}

inline measure::Tick sample_tick(const Frame& frame) {
  measure::Tick tick;
  tick.tick = frame.tick;
  tick.time_s = frame.time_s;
  tick.alive = static_cast<std::uint32_t>(frame.robots.size());
  tick.roots = 1;
  tick.workers = 2;
  tick.connectors = 3;
  tick.spares = 4;
  tick.committed = 6;
  tick.edges = 7;
  tick.broken_by_distance = frame.tick % 90 == 45 ? 2 : 0;
  tick.broken_by_occlusion = 1;
  tick.components = frame.tick % 60 == 30 ? 2 : 1;
  tick.components_by_distance = 1;
  tick.fiedler_low = frame.tick % 2 == 0;
  tick.fiedler = frame.tick % 20 == 0 ? 0.125 : -1.0;
  tick.worst_target_distance_m = 1.25;
  tick.targets_reached = 1;
  return tick;
}

inline measure::Run sample_run(std::uint64_t ticks) {
  measure::Run run;
  run.ticks = ticks;
  run.time_s = static_cast<double>(ticks) * 0.1;
  run.complete = true;
  run.completion_time_s = run.time_s;
  run.robots = 9;
  run.hash = 0x0123456789ABCDEFULL;
  return run;
}

inline Provenance sample_provenance() {
  return {R"({"mission":{"algorithm":"outwards"},"n":[1,2]})", "0.2.0", "abc1234", 42};
}

// Ticks 0 .. ticks-1.
inline void record_sample(const std::string& path, std::size_t robots, std::uint64_t ticks,
                          const RecorderOptions& options = {}) {
  Recorder recorder(path, sample_provenance(), options);
  for (std::uint64_t t = 0; t < ticks; ++t) {
    const Frame frame = sample_frame(robots, 3.0, t);
    recorder.frame(sample_setting(), frame, sample_tick(frame));
  }
  recorder.finish(sample_run(ticks));
}

// A world whose run is over in a moment.
inline world::Scenario small_world() {
  world::Scenario scenario = world::plain_scenario();
  scenario.name = "small";
  scenario.swarm.robots = 6;
  scenario.targets = world::RingTargets{2, 0.9};
  scenario.mission.time_limit_s = 5.0;
  return scenario;
}

// A directory of its own for each test, removed afterwards.
class TemporaryDirectory {
 public:
  TemporaryDirectory() {
    std::string name = (std::filesystem::temp_directory_path() / "banyan-record-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary directory");
    path_ = name;
  }
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  ~TemporaryDirectory() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

}  // namespace banyan::record::test
