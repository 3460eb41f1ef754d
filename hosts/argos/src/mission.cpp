// SPDX-License-Identifier: MIT
#include "banyan/hosts/argos/mission.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "banyan/controller/core/trig.hpp"
#include "banyan/version.hpp"
#include "banyan/world/names.hpp"

namespace banyan::argos {
namespace {

// Events that happen to the simulator's bodies and radio, which are ARGoS' own.
std::string event_fault(const world::Event& event) {
  return std::visit(
      [](const auto& action) -> std::string {
        using Action = std::decay_t<decltype(action)>;
        if constexpr (std::is_same_v<Action, world::Freeze> || std::is_same_v<Action, world::SetLoss> ||
                      std::is_same_v<Action, world::Blackout> || std::is_same_v<Action, world::SetLineOfSight> ||
                      std::is_same_v<Action, world::MoveObstacle> || std::is_same_v<Action, world::AddObstacle> ||
                      std::is_same_v<Action, world::RemoveObstacle> || std::is_same_v<Action, world::Join>)
          return std::string(Action::kind) + " cannot happen in ARGoS";
        else return {};
      },
      event.action);
}

std::string listed(const std::vector<std::string>& list) {
  std::string text;
  for (const std::string& line : list) text += (text.empty() ? "" : "; ") + line;
  return text;
}

world::Scenario starting_at(world::Scenario scenario, const std::vector<Pose>& placed) {
  world::Start& start = scenario.swarm.start;
  start = {};
  start.layout = world::Layout::list;
  start.jitter_m = 0.0;
  scenario.swarm.robots.reset();
  for (const Pose& pose : placed) {
    start.positions.push_back(pose.position);
    start.headings_rad.push_back(angle_of(unit_vector(pose.heading_rad)));
  }
  return scenario;
}

void make_results_directory(const std::string& out, bool force) {
  namespace fs = std::filesystem;
  std::error_code error;
  fs::create_directories(out, error);
  if (error) throw MissionError(out + ": cannot be created: " + error.message());
  for (const auto& format : record::output_formats)
    if (!force && fs::exists(fs::path(out) / format.file))
      throw MissionError(out + " already holds results (" + std::string(format.file) +
                         "); choose another one, or say force=\"true\"");
}

}  // namespace

std::vector<std::string> not_in_argos(const world::Scenario& scenario) {
  std::vector<std::string> found;
  const auto refuse = [&](bool wrong, const char* text) {
    if (wrong) found.emplace_back(text);
  };
  const world::RadioModel& radio = scenario.radio;
  const world::RobotModel& robot = scenario.robot;
  const double rate = 1.0 / scenario.tick_s;
  refuse(std::abs(rate - std::round(rate)) > 1e-9, "tick_s: ARGoS has whole ticks per second");
  refuse(scenario.seed == 0 || scenario.seed > 0xFFFFFFFFU, "seed: ARGoS' is from 1 to 4294967295; 0 is its clock");
  refuse(scenario.clocks.asynchronous, "clocks.asynchronous: in ARGoS all robots step at once");
  refuse(scenario.battery.on(), "battery: our robots in ARGoS do not measure their charge");
  refuse(!scenario.stations.empty(), "stations: in ARGoS all robots go where their controllers want");
  refuse(radio.model != world::RadioModel::Model::disc, "radio.model: only \"disc\"");
  refuse(radio.latency_ticks != 1, "radio.latency_ticks: ARGoS' is 1");
  refuse(radio.range_noise_m > 0.0 || radio.bearing_noise_rad > 0.0,
         "radio.range_noise_m, radio.bearing_noise_deg: ARGoS has a noise of its own, noise_std_dev of the "
         "range_and_bearing sensor");
  refuse(radio.sight_leak > 0.0, "radio.sight_leak: ARGoS' own medium leaks by itself (docs/argos.md)");
  refuse(radio.slots > 0, "radio.slots: ARGoS has no such limit");
  refuse(robot.wheel_noise > 0.0 || robot.wheel_bias > 0.0 || robot.odometry_noise > 0.0,
         "robot.wheel_noise, robot.wheel_bias, robot.odometry_noise: ARGoS has noises of its own, of "
         "differential_steering");
  refuse(robot.body == world::BodyModel::linear, "robot.body: ARGoS' robots have wheels");
  for (std::size_t k = 0; k < scenario.events.size(); ++k)
    if (const std::string text = event_fault(scenario.events[k]); !text.empty())
      found.push_back("events[" + std::to_string(k) + "]: " + text);
  return found;
}

config::Configuration load_mission(const std::string& file, const std::vector<std::string>& assignments,
                                   const AlgorithmList& algorithms) {
  std::vector<config::Override> overrides;
  overrides.reserve(assignments.size());
  for (const std::string& assignment : assignments) overrides.push_back({assignment, assignment});
  config::Loaded loaded = config::load_configuration(file, algorithms, overrides);
  std::vector<std::string> wrong;
  for (const config::Problem& problem : loaded.problems)
    if (!problem.warning) wrong.push_back(config::to_string(problem));
  if (wrong.empty()) wrong = not_in_argos(loaded.configuration.scenario);
  if (!wrong.empty()) throw MissionError(listed(wrong));
  return std::move(loaded.configuration);
}

MissionRun::MissionRun(config::Configuration configuration, std::string out, bool force,
                       const std::vector<Pose>& placed, MirroredRobots& robots)
    : configuration_(std::move(configuration)),
      out_(std::move(out)),
      robots_(robots),
      algorithm_(world::algorithm_of(configuration_.scenario),
                 [this](std::unique_ptr<Swarm> local, const Setup&, std::span<const Member> members) {
                   members_.assign(members.begin(), members.end());
                   return mirrored_swarm(std::move(local), robots_);
                 }) {
  world::Scenario& scenario = configuration_.scenario;
  if (!placed.empty()) scenario = starting_at(scenario, placed);
  try {
    world::World world(scenario, algorithm_, mirrored_bodies(robots));
    if (!out_.empty()) {
      make_results_directory(out_, force);
      sinks_ = record::open_outputs(
          out_, {{config::config_json(configuration_), std::string(version), std::string(git_id()), scenario.seed},
                 configuration_.output,
                 force ? record::Existing::replace : record::Existing::keep});
    }
    simulation_ = std::make_unique<record::Simulation>(std::move(world), sinks_);
  } catch (const std::invalid_argument& error) {
    throw MissionError(error.what());
  } catch (const record::FileError& error) { throw MissionError(error.what()); }
}

Pose MissionRun::start(std::size_t i) const { return {world().positions()[i], angle_of(world().headings()[i])}; }

std::optional<BasicVec2<double>> MissionRun::target_of(std::size_t i) const {
  for (const world::Target& target : world().targets())
    if (target.worker == i && target.active) return target.position;
  return std::nullopt;
}

void MissionRun::begin() {
  for (std::size_t i = 0; i < world().size(); ++i) {
    Told told;
    told.sent = target_of(i).has_value();
    robots_.tell(i, told);
  }
}

void MissionRun::tick() { simulation_->step(executor_); }

std::string MissionRun::finish(bool interrupted) {
  const record::RunEnd end = simulation_->finish(interrupted);
  std::array<char, 200> text{};
  if (end.run.complete)
    std::snprintf(text.data(), text.size(), "complete at %.1f s (%.2f of the limit)", end.run.completion_time_s,
                  end.run.normalized_time);
  else
    std::snprintf(text.data(), text.size(), "%s at %.1f s, %.0f %% of the targets held",
                  interrupted ? "stopped" : "not complete", end.run.time_s, 100.0 * end.run.held_ratio);
  std::string words = text.data();
  for (const auto& failure : sinks_.failures()) words += "; " + failure.text;
  if (!out_.empty()) words += "; results in " + out_;
  return words;
}

}  // namespace banyan::argos
