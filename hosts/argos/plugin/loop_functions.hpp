// SPDX-License-Identifier: MIT
// A Banyan mission in ARGoS: places robots and obstacles, sends workers to their targets, lets events happen, and keeps
// the same recording and results as `banyan run`.
//
//   <loop_functions library="libbanyan_argos" label="banyan_loop_functions">
//     <mission scenario="/…/medium.toml"       the rest of the world: placement, targets, obstacles, events
//              out="/…/results"                directory; none: no results
//              robot="kheperaiv" controller="banyan"   what is placed; unless the arena has robots with our controller
//              already obstacles="sensors"             or "world": the world says what is near, up to robot.proximity_m
//              force="false" />                may replace results
//   </loop_functions>
//
// What the .argos file says counts, whatever the scenario says: algorithm, parameters, range, sight, loss, seed,
// length.
#pragma once

#include <argos3/core/simulator/entity/embodied_entity.h>
#include <argos3/core/simulator/loop_functions.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "banyan/hosts/argos/mission.hpp"
#include "controller.hpp"

namespace banyan::argos {

class LoopFunctions final : public ::argos::CLoopFunctions, public MirroredRobots {
 public:
  void Init(::argos::TConfigurationNode& node) override;
  void Reset() override;
  void PostStep() override;
  bool IsExperimentFinished() override;
  void PostExperiment() override;
  void Destroy() override;

  // For the view. Null before Init().
  [[nodiscard]] const MissionRun* mission() const noexcept { return mission_.get(); }

 private:
  struct Options {
    std::string scenario, out, robot = "kheperaiv", controller = "banyan";
    bool eyes_of_world = false, force = false;
  };
  struct Inhabitant {
    Controller* controller;
    ::argos::CEmbodiedEntity* body;
    std::optional<Pose> died_at{};  // its body has been taken away
  };

  [[nodiscard]] Pose pose(std::size_t i) const override;
  [[nodiscard]] Said said(std::size_t i) const override { return inhabitants_[i].controller->said(); }
  void tell(std::size_t i, const Told& told) override;

  void read_options(::argos::TConfigurationNode& node);
  void find_robots();
  [[nodiscard]] std::vector<std::string> assignments() const;
  void make_mission(const std::string& out);
  void place_robots();
  void place_obstacles();
  void place_lights();
  void begin();
  void take_away(std::size_t i);
  [[nodiscard]] bool leaves_arena(std::size_t i) const;
  void finish(bool interrupted);
  void add(::argos::TConfigurationNode& element);

  Options options_;
  std::vector<Inhabitant> inhabitants_;  // by index in the world
  std::vector<Pose> placed_;             // by the arena
  std::unique_ptr<MissionRun> mission_;
  int resets_ = 0;
  bool done_ = false;
  bool lost_ = false;  // a robot was about to leave the arena
};

}  // namespace banyan::argos
