// SPDX-License-Identifier: MIT
// A mission in ROS 2: `banyan-ros2` as a process of its own, which publishes what the mission says and hands back what
// is asked of it. A process, since it must have the network that a fleet leaves, and so that nothing else needs DDS.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "banyan/config/config.hpp"
#include "banyan/hosts/ros2/feed.hpp"
#include "banyan/record/events.hpp"
#include "banyan/record/ros2.hpp"
#include "banyan/record/simulation.hpp"
#include "keep_run.hpp"

namespace banyan::cli {

class Ros2Beside {
 public:
  Ros2Beside();   // starts it; throws CommandError, also if it cannot begin
  ~Ros2Beside();  // ends it, when readers have all that was said or after a second
  Ros2Beside(const Ros2Beside&) = delete;
  Ros2Beside& operator=(const Ros2Beside&) = delete;
  [[nodiscard]] int socket() const noexcept { return socket_; }  // the mission's end

 private:
  [[nodiscard]] bool begins() const;

  int socket_ = -1;
  pid_t process_ = 0;
};

enum class RosWorld : std::uint8_t {
  simulated,  // its clock and its bodies are those of ROS 2, too
  real,       // stamps have this computer's clock, and others say where bodies are
};

// What ROS 2 is told of. `configuration` must outlive the run.
struct Ros2Mission {
  int socket;  // Ros2Beside::socket()
  const config::Configuration& configuration;
  RosWorld kind = RosWorld::simulated;
  std::uint64_t first_tick = 0;  // those before were shown already, by a hub that this one resumes
};

// Tells ROS 2 of a run, and the run of what ROS 2 asks. Messages that the other process does not take at once wait for
// the next tick, or are dropped but for the log; nothing waits for it.
class Ros2Sink final : public record::Sink {
 public:
  // `kept` is told of everything first, and must outlive this.
  Ros2Sink(record::Sink& kept, const Ros2Mission& mission) : kept_(kept), mission_(mission) {}

  void start(const world::World& world) override;
  void tick(const world::World& world, const measure::Tick& tick) override;
  void finish(const world::World& world, const record::RunEnd& end) override;
  [[nodiscard]] bool wants_fiedler(const world::World& world) const override { return kept_.wants_fiedler(world); }
  [[nodiscard]] std::string rest() const override { return kept_.rest(); }

  // What has been asked since the last call happens now, or is refused in /rosout.
  void heed(record::Simulation& simulation);

 private:
  using Moment = std::chrono::steady_clock::time_point;

  void say_hello(const world::World& world);
  void show(const world::World& world, const measure::Tick& tick, bool all);
  void show_bodies(const record::ros2::Stamp& moment);
  void put(ros2::feed::FeedTopic topic, std::string_view message, std::size_t robot = 0);
  void put_log(std::string_view kind, const std::string& text);
  [[nodiscard]] bool flush();
  [[nodiscard]] record::ros2::Stamp stamp() const;
  [[nodiscard]] static bool due(Moment& next, double period_s);
  void heed(record::Simulation& simulation, ros2::feed::FeedTopic topic, std::string_view text);

  record::Sink& kept_;
  Ros2Mission mission_;
  std::size_t refused_ = 0;  // of what was asked
  bool gone_ = false;
  std::deque<std::string> waiting_;  // datagrams
  record::ros2::CdrWriter cdr_;
  record::EventWatcher watcher_;
  record::Setting setting_;
  record::Frame now_, shown_;  // the frame, and that of the last odometry
  std::size_t robots_ = 0;     // that it was told of
  Moment next_bodies_, next_markers_, next_diagnosis_;
};

// As record::run_scenario, at `speed` times real time and with ROS 2.
[[nodiscard]] Play played_in_ros2(const Ros2Mission& mission, double speed);

}  // namespace banyan::cli
