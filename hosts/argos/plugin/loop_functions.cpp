// SPDX-License-Identifier: MIT
#include "loop_functions.hpp"

#include <argos3/core/simulator/entity/composable_entity.h>
#include <argos3/core/simulator/entity/controllable_entity.h>
#include <argos3/core/simulator/simulator.h>
#include <argos3/core/simulator/space/space.h>
#include <argos3/core/utility/logging/argos_log.h>

#include <signal.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/controller/core/printable.hpp"
#include "banyan/controller/core/trig.hpp"
#include "banyan/world/names.hpp"
#include "simulator.hpp"

namespace banyan::argos {

using namespace ::argos;

namespace {

constexpr double obstacle_height_m = 0.5;
constexpr double wall_thickness_m = 0.02;  // ARGoS has no walls without any

// That of the bodies' origins, from which ARGoS measures: so the distance is that on the ground.
constexpr double light_height_m = 0.01;

std::string exact(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}
std::string triple(double x, double y, double z) { return exact(x) + "," + exact(y) + "," + exact(z); }
std::string heading_text(double rad) { return triple(rad * 180.0 / pi<double>, 0.0, 0.0); }

Pose pose_of(const CEmbodiedEntity& body) {
  const SAnchor& origin = body.GetOriginAnchor();
  CRadians heading, pitch, roll;
  origin.Orientation.ToEulerAngles(heading, pitch, roll);
  return {{origin.Position.GetX(), origin.Position.GetY()}, heading.GetValue()};
}

bool truth(const Attribute& attribute, const std::string& where) {
  if (attribute.value == "true") return true;
  if (attribute.value != "false")
    THROW_ARGOSEXCEPTION(where << ": " << attribute.name << " must be true or false, not "
                               << world::the_text(attribute.value));
  return false;
}

// ARGoS dies of a signal where it is, and what was recorded would stay a .part. The first one ends the experiment
// after its tick instead; the second kills as usual. Not where somebody else handles it.
volatile std::sig_atomic_t stop_signal = 0;

void catch_stop_signals() {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    if (::sigaction(number, nullptr, &before) != 0 || before.sa_handler != SIG_DFL) continue;
    struct sigaction action {};
    action.sa_handler = [](int caught) { stop_signal = caught; };
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    ::sigemptyset(&action.sa_mask);
    ::sigaction(number, &action, nullptr);
  }
}

// All controllers of ours in the arena, by the number in their id.
template <class Visit> void each_controller(CSpace& space, const Visit& visit) {
  const auto found = space.GetEntityMapPerTypePerId().find("controller");
  if (found == space.GetEntityMapPerTypePerId().end()) return;
  for (auto& [id, any] : found->second) {
    auto* const entity = any_cast<CControllableEntity*>(any);
    if (auto* const controller = dynamic_cast<Controller*>(&entity->GetController()))
      visit(*controller, entity->GetParent());
  }
}

}  // namespace

void LoopFunctions::read_options(TConfigurationNode& node) {
  if (!NodeExists(node, "mission"))
    THROW_ARGOSEXCEPTION(
        place_in_experiment(node)
        << ": <loop_functions label=\"banyan_loop_functions\"> needs an element <mission scenario=\"FILE\" />");
  TConfigurationNode& element = GetNode(node, "mission");
  const std::string where = place_in_experiment(element) + ": <mission>";
  constexpr std::string_view known[] = {"scenario", "out", "robot", "controller", "obstacles", "force"};
  for (const Attribute& attribute : attributes_of_node(element)) {
    if (attribute.name == "scenario") options_.scenario = path_in_experiment(attribute.value);
    else if (attribute.name == "out") options_.out = path_in_experiment(attribute.value);
    else if (attribute.name == "robot") options_.robot = attribute.value;
    else if (attribute.name == "controller") options_.controller = attribute.value;
    else if (attribute.name == "force") options_.force = truth(attribute, where);
    else if (attribute.name == "obstacles") {
      constexpr std::string_view eyes[] = {"sensors", "world"};
      if (attribute.value != eyes[0] && attribute.value != eyes[1])
        THROW_ARGOSEXCEPTION(where << ": obstacles must be " << world::alternatives(eyes) << ", not "
                                   << world::the_text(attribute.value));
      options_.eyes_of_world = attribute.value == eyes[1];
    } else {
      const std::string_view near = world::nearest_name(attribute.name, known);
      THROW_ARGOSEXCEPTION(where << ": " << attribute.name << " is unknown"
                                 << (near.empty() ? "" : "; did you mean " + std::string(near) + "?"));
    }
  }
  if (options_.scenario.empty()) THROW_ARGOSEXCEPTION(where << ": scenario=\"FILE\" is missing");
}

// Robots that the arena has already, in the order of their numbers.
void LoopFunctions::find_robots() {
  inhabitants_.clear();
  each_controller(GetSpace(), [&](Controller& controller, CComposableEntity& robot) {
    inhabitants_.push_back({&controller, &robot.GetComponent<CEmbodiedEntity>("body")});
  });
  const auto id = [](const Inhabitant& robot) { return *id_of(robot.controller->GetId()); };
  std::sort(inhabitants_.begin(), inhabitants_.end(), [&](const auto& a, const auto& b) { return id(a) < id(b); });
  for (std::size_t i = 0; i < inhabitants_.size(); ++i)
    if (id(inhabitants_[i]) != i)
      THROW_ARGOSEXCEPTION("The ids of robots must end with the numbers from 0 to "
                           << inhabitants_.size() - 1 << ", each once; \"" << inhabitants_[i].controller->GetId()
                           << "\" does not fit");
}

// What the .argos file says, as options over the scenario.
std::vector<std::string> LoopFunctions::assignments() const {
  TConfigurationNode& root = CSimulator::GetInstance().GetConfigurationRoot();
  TConfigurationNode& controller = CSimulator::GetInstance().GetConfigForController(options_.controller);
  std::vector<std::string> list;
  try {
    list = read_settings(attributes_of_node(GetNode(controller, "params")), algorithms(), tick_of_simulator_s())
               .assignments;
  } catch (const SettingsError& error) {
    THROW_ARGOSEXCEPTION(place_in_experiment(GetNode(controller, "params")) << ": " << error.what());
  }
  double loss = 0.0, length_s = 0.0;
  GetNodeAttributeOrDefault(GetNode(GetNode(controller, "sensors"), "range_and_bearing"), "packet_drop_prob", loss,
                            loss);
  GetNodeAttributeOrDefault(GetNode(GetNode(root, "framework"), "experiment"), "length", length_s, length_s);
  list.push_back("radio.loss=" + exact(loss));
  list.push_back("tick_s=" + exact(tick_of_simulator_s()));
  list.push_back("seed=" + std::to_string(CSimulator::GetInstance().GetRandomSeed()));
  if (length_s > 0.0) list.push_back("mission.time_limit_s=" + exact(length_s));
  return list;
}

void LoopFunctions::make_mission(const std::string& out) {
  try {
    mission_ = std::make_unique<MissionRun>(load_mission(options_.scenario, assignments(), algorithms()), out,
                                            options_.force, placed_, *this);
  } catch (const MissionError& error) { THROW_ARGOSEXCEPTION(error.what()); }
}

void LoopFunctions::add(TConfigurationNode& element) {
  CEntity* const entity = CFactory<CEntity>::New(element.Value());
  entity->Init(element);
  AddEntity(*entity);
}

void LoopFunctions::place_robots() {
  const world::World& world = mission_->world();
  for (std::size_t i = 0; i < world.size(); ++i) {
    const Pose pose = mission_->start(i);
    TConfigurationNode robot(options_.robot), body("body"), controller("controller");
    SetNodeAttribute(robot, "id", "robot" + std::to_string(i));
    SetNodeAttribute(robot, "rab_range", exact(world.scenario().radio.range_m));
    SetNodeAttribute(robot, "rab_data_size", world.swarm().message_bytes());
    SetNodeAttribute(body, "position", triple(pose.position.x, pose.position.y, 0.0));
    SetNodeAttribute(body, "orientation", heading_text(pose.heading_rad));
    SetNodeAttribute(controller, "config", options_.controller);
    AddChildNode(robot, body);
    AddChildNode(robot, controller);
    add(robot);
  }
}

void LoopFunctions::place_obstacles() {
  const auto& obstacles = mission_->world().obstacles();
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    const auto* disc = std::get_if<world::Disc>(&obstacles[k]);
    TConfigurationNode element(disc != nullptr ? "cylinder" : "box"), body("body");
    SetNodeAttribute(element, "id", "obstacle" + std::to_string(k));
    SetNodeAttribute(element, "movable", "false");
    world::Vec2 center;
    double angle_rad = 0.0;
    if (disc != nullptr) {
      center = disc->center;
      SetNodeAttribute(element, "radius", exact(disc->radius_m));
      SetNodeAttribute(element, "height", exact(obstacle_height_m));
    } else if (const auto* box = std::get_if<world::Box>(&obstacles[k])) {
      center = box->center;
      angle_rad = box->angle_rad;
      SetNodeAttribute(element, "size", triple(box->size.x, box->size.y, obstacle_height_m));
    } else {
      const auto& wall = std::get<world::Wall>(obstacles[k]);
      center = 0.5 * (wall.from + wall.to);
      angle_rad = angle_of(wall.to - wall.from);
      SetNodeAttribute(element, "size", triple(distance(wall.from, wall.to), wall_thickness_m, obstacle_height_m));
    }
    SetNodeAttribute(body, "position", triple(center.x, center.y, 0.0));
    SetNodeAttribute(body, "orientation", heading_text(angle_rad));
    AddChildNode(element, body);
    add(element);
  }
}

// Workers with light sensors go to the light, so there must be one, and one alone: the sensor does not tell lights
// apart.
void LoopFunctions::place_lights() {
  const auto by_light = std::find_if(inhabitants_.begin(), inhabitants_.end(),
                                     [](const auto& robot) { return robot.controller->finds_targets_by_light(); });
  if (by_light == inhabitants_.end()) return;
  const auto& targets = mission_->world().targets();
  if (targets.size() != 1)
    THROW_ARGOSEXCEPTION("A light sensor does not tell "
                         << targets.size() << " targets apart; give the controller the sensor positioning");
  TConfigurationNode light("light");
  SetNodeAttribute(light, "id", "target0");
  SetNodeAttribute(light, "position", triple(targets[0].position.x, targets[0].position.y, light_height_m));
  SetNodeAttribute(light, "orientation", "0,0,0");
  SetNodeAttribute(light, "color", "yellow");
  SetNodeAttribute(light, "intensity", exact(by_light->controller->settings().light_intensity_m));
  SetNodeAttribute(light, "medium", "leds");
  add(light);
}

void LoopFunctions::begin() {
  for (std::size_t i = 0; i < inhabitants_.size(); ++i) {
    const Member member = mission_->member(i);
    if (member.worker && !inhabitants_[i].controller->finds_targets())
      THROW_ARGOSEXCEPTION("Robot \"" << inhabitants_[i].controller->GetId()
                                      << "\" is a worker and needs the sensor positioning or footbot_light");
    inhabitants_[i].controller->begin(member);
    inhabitants_[i].died_at.reset();
  }
  mission_->begin();
  done_ = lost_ = false;
}

void LoopFunctions::Init(TConfigurationNode& node) {
  catch_stop_signals();
  read_options(node);
  find_robots();
  for (const Inhabitant& robot : inhabitants_) placed_.push_back(pose_of(*robot.body));
  make_mission(options_.out);
  if (inhabitants_.empty()) {
    place_robots();
    find_robots();
  }
  place_obstacles();
  place_lights();
  begin();
}

// Another run of the same: its results get a directory beside the first, out.2 and so on.
void LoopFunctions::Reset() {
  finish(true);
  ++resets_;
  make_mission(options_.out.empty() ? "" : options_.out + "." + std::to_string(resets_ + 1));
  begin();
}

Pose LoopFunctions::pose(std::size_t i) const {
  const Inhabitant& robot = inhabitants_[i];
  return robot.died_at ? *robot.died_at : pose_of(*robot.body);
}

// robot.dead_bodies = false: its body goes to the edge of the arena, where nobody drives. ARGoS' radio does not survive
// that a robot is removed (its media find robots by their place in a list).
void LoopFunctions::take_away(std::size_t i) {
  Inhabitant& robot = inhabitants_[i];
  if (robot.died_at) return;
  robot.died_at = pose(i);
  constexpr double from_edge_m = 0.3, apart_m = 0.25;
  const CVector3 corner = GetSpace().GetArenaLimits().GetMin();
  const auto a_row = static_cast<std::size_t>((GetSpace().GetArenaSize().GetX() - 2.0 * from_edge_m) / apart_m);
  const std::size_t row = i / a_row, column = i % a_row;
  const CVector3 place(corner.GetX() + from_edge_m + apart_m * static_cast<double>(column),
                       corner.GetY() + from_edge_m + apart_m * static_cast<double>(row), 0.0);
  if (!robot.body->MoveTo(place, CQuaternion()))
    LOGERR << "[WARNING] banyan: the body of robot " << i << " stays: there is no room at the edge of the arena"
           << '\n';
}

void LoopFunctions::tell(std::size_t i, const Told& told) {
  Told all = told;
  if (const auto target = mission_->target_of(i)) all.target = *target;
  if (!options_.eyes_of_world) all.obstacles = {};
  inhabitants_[i].controller->tell(all);
  if (!told.alive && !mission_->world().scenario().robot.dead_bodies) take_away(i);
}

// In the next tick. ARGoS would give up then, and what was recorded would be lost.
bool LoopFunctions::leaves_arena(std::size_t i) const {
  const CRange<CVector3>& arena = CSimulator::GetInstance().GetSpace().GetArenaLimits();
  const BasicVec2<double> p = pose(i).position;
  constexpr double margin_m = 0.1;
  return p.x < arena.GetMin().GetX() + margin_m || p.x > arena.GetMax().GetX() - margin_m ||
         p.y < arena.GetMin().GetY() + margin_m || p.y > arena.GetMax().GetY() - margin_m;
}

void LoopFunctions::PostStep() {
  if (done_ || lost_) return;
  mission_->tick();
  for (std::size_t i = 0; i < inhabitants_.size() && !lost_; ++i) {
    lost_ = leaves_arena(i);
    if (lost_)
      LOGERR << "[WARNING] banyan: robot " << i << " is about to leave the arena; the mission ends here" << '\n';
  }
}

bool LoopFunctions::IsExperimentFinished() { return lost_ || stop_signal != 0 || mission_->finished(); }

void LoopFunctions::finish(bool interrupted) {
  if (done_ || mission_ == nullptr) return;
  done_ = true;
  LOG << "[INFO] banyan: " << printable_lines(mission_->finish(interrupted && !mission_->finished())) << '\n';
}

void LoopFunctions::PostExperiment() { finish(true); }
void LoopFunctions::Destroy() { finish(true); }

}  // namespace banyan::argos

using BanyanLoopFunctions = banyan::argos::LoopFunctions;
REGISTER_LOOP_FUNCTIONS(BanyanLoopFunctions, "banyan_loop_functions")
