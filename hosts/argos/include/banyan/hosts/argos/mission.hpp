// SPDX-License-Identifier: MIT
// A Banyan mission whose robots live in another simulator: placement from the scenario before the first tick, then tick
// by tick targets and events, metrics, and the outputs of `banyan run`.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "banyan/config/config.hpp"
#include "banyan/controller/core/elsewhere.hpp"
#include "banyan/hosts/argos/mirror.hpp"
#include "banyan/record/outputs.hpp"
#include "banyan/record/simulation.hpp"
#include "banyan/world/threads.hpp"

namespace banyan::argos {

// What of a scenario ARGoS does not do, or does in a way of its own: "radio.latency_ticks: ...". None: all of it is
// done.
[[nodiscard]] std::vector<std::string> not_in_argos(const world::Scenario& scenario);

struct MissionError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A mission from its file, with options ("radio.loss=0.3") over it. Throws MissionError with all that is wrong.
[[nodiscard]] config::Configuration load_mission(const std::string& file, const std::vector<std::string>& assignments,
                                                 const AlgorithmList& algorithms);

class MissionRun {
 public:
  // `out`: the directory of the results; "": none. Refuses to replace results unless `force`. With `placed`, robots
  // begin there instead of where the scenario has them. `robots` are not called before begin(). Throws MissionError.
  MissionRun(config::Configuration configuration, std::string out, bool force, const std::vector<Pose>& placed,
             MirroredRobots& robots);
  MissionRun(const MissionRun&) = delete;
  MissionRun& operator=(const MissionRun&) = delete;

  [[nodiscard]] const world::World& world() const noexcept { return simulation_->world(); }
  [[nodiscard]] Pose start(std::size_t i) const;
  [[nodiscard]] const Member& member(std::size_t i) const { return members_[i]; }
  // Where robot i has been sent. None: nowhere, or the target was given up.
  [[nodiscard]] std::optional<BasicVec2<double>> target_of(std::size_t i) const;

  // Tells the robots what they are to do in their first step.
  void begin();
  // After each step of the robots: observes where they are and what they do, and tells them what is new.
  void tick();
  [[nodiscard]] bool finished() const noexcept { return simulation_->finished(); }
  // Writes the results. Once; no tick may follow. Returns what is to be said to the user.
  std::string finish(bool interrupted);

 private:
  config::Configuration configuration_;
  std::string out_;
  MirroredRobots& robots_;
  AlgorithmElsewhere algorithm_;
  std::vector<Member> members_;  // how the robots begin of which its last swarm was made
  record::Sinks sinks_;
  world::Executor executor_{1};
  std::unique_ptr<record::Simulation> simulation_;
};

}  // namespace banyan::argos
