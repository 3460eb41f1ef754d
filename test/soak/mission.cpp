// SPDX-License-Identifier: MIT
#include "mission.hpp"

#include <algorithm>
#include <cmath>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/controller/core/trig.hpp"
#include "banyan/world/faults.hpp"
#include "banyan/world/random.hpp"

namespace banyan::soak {
namespace {

using namespace world;
using world::Vec2;

constexpr std::size_t most_robots = 400;  // so that a mission takes seconds

// A stream of draws of its own for every attempt at every mission.
class Dice {
 public:
  Dice(std::uint64_t seed, std::uint64_t index, std::uint64_t attempt) : key_{mix(mix(mix(seed) ^ index) ^ attempt)} {}
  double share() { return to_uniform(mix(key_ ^ mix(++drawn_))); }
  double between(double low, double high) { return low + (high - low) * share(); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(share() * static_cast<double>(n)); }
  bool once_in(double n) { return share() * n < 1.0; }
  Vec2 around(Vec2 center, double least, double most) {
    const double r = between(least, most);
    return center + r * unit_vector(2.0 * pi<double> * share());
  }

 private:
  std::uint64_t key_;
  std::uint64_t drawn_ = 0;
};

// Numbers with few digits, so that what is found can be read.
double rounded(double x, double unit) { return std::round(x / unit) * unit; }

void draw_start(Dice& dice, Scenario& s) {
  constexpr Layout layouts[] = {Layout::hexagonal, Layout::hexagonal, Layout::line,  Layout::ring,
                                Layout::cross,     Layout::bridge,    Layout::random};
  const std::size_t kind = dice.below(std::size(layouts));
  Start& start = s.swarm.start;
  start.layout = layouts[kind];
  if (kind == 0) return;  // compact
  start.jitter_m = 0.01;
  start.link_share = rounded(dice.between(0.7, 0.95), 0.01);
  start.bridge_robots = 1 + dice.below(6);
  if (kind == 1) start.pitch_share = 0.93;
  else if (start.layout != Layout::random && start.layout != Layout::bridge)
    start.pitch_share = rounded(dice.between(0.2, 0.94), 0.01);
}

void draw_targets(Dice& dice, Scenario& s, bool plain) {
  const bool many = !plain && dice.once_in(16);  // one in twenty of all
  const std::size_t count = many ? 13 + dice.below(88) : 1 + dice.below(12);
  const double radius = rounded(dice.between(1.0, 4.5) * s.radio.range_m, 0.01);
  if (dice.once_in(3)) s.targets = RingTargets{count, radius, dice.between(0.0, 6.28), {}};
  else s.targets = RandomTargets{count, radius, {}};
  s.swarm.redundancy = rounded(dice.between(1.5, 8.0), 0.01);
  s.swarm.robots = std::clamp(robot_count(s), count + 1, std::max(most_robots, count + 1));
}

void draw_radio(Dice& dice, Scenario& s, bool plain) {
  s.radio.line_of_sight = dice.once_in(2);
  if (!dice.once_in(4)) s.radio.loss = rounded(dice.between(0.0, 0.3), 0.01);
  if (plain) return;
  if (dice.once_in(5)) s.radio.range_m = rounded(dice.between(0.6, 4.0), 0.1);
  const std::size_t model = dice.below(6);
  if (model >= 1 && model <= 3) s.radio.model = static_cast<RadioModel::Model>(model);
  s.radio.burst_s = rounded(dice.between(0.2, 3.0), 0.1);
  s.radio.path_loss_exponent = rounded(dice.between(2.0, 4.0), 0.1);
  s.radio.shadowing_db = rounded(dice.between(0.0, 4.0), 0.1);
  s.radio.one_way_share = rounded(dice.between(0.0, 0.3), 0.01);
  if (dice.once_in(8)) s.radio.latency_ticks = 2 + static_cast<int>(dice.below(2));
}

void draw_noise(Dice& dice, Scenario& s) {
  s.radio.range_noise_m = rounded(dice.between(0.0, 0.1), 0.001);
  s.radio.bearing_noise_rad = dice.between(0.0, 0.1);
  s.robot.wheel_noise = rounded(dice.between(0.0, 0.1), 0.001);
  s.robot.odometry_noise = rounded(dice.between(0.0, 0.05), 0.001);
}

void draw_obstacles(Dice& dice, Scenario& s, double reach) {
  for (std::size_t left = 1 + dice.below(6); left > 0; --left) {
    const Vec2 center = dice.around({}, 0.2 * reach, reach);
    const std::size_t shape = dice.below(3);
    if (shape == 0) s.obstacles.emplace_back(Disc{center, dice.between(0.1, 0.6)});
    else if (shape == 1)
      s.obstacles.emplace_back(Box{center, {dice.between(0.2, 2.0), dice.between(0.2, 1.0)}, dice.between(0.0, 3.0)});
    else s.obstacles.emplace_back(Wall{center, dice.around(center, 0.5, 3.0)});
  }
}

void draw_deaths(Dice& dice, Scenario& s, double limit_s) {
  Kill kill;
  constexpr Kill::Of whom[] = {Kill::Of::robots, Kill::Of::connectors, Kill::Of::root, Kill::Of::worker,
                               Kill::Of::worker_and_parent};
  kill.of = whom[dice.below(std::size(whom))];
  const bool share = kill.of == Kill::Of::robots || kill.of == Kill::Of::connectors;
  if (share && dice.once_in(2)) kill.share = rounded(dice.between(0.05, 0.4), 0.01);
  else kill.count = 1 + dice.below(3);
  if (dice.once_in(2)) kill.every_s = rounded(dice.between(0.5, 20.0), 0.1);
  const double time_s = rounded(dice.between(0.0, 0.4 * limit_s), 0.1);
  s.events.push_back({time_s, dice.once_in(2) ? Event::When::time : Event::When::half_way, kill});
  s.robot.dead_bodies = dice.once_in(2);
}

void draw_changes(Dice& dice, Scenario& s, double reach, double limit_s, std::size_t targets) {
  const double time_s = rounded(dice.between(0.0, 0.5 * limit_s), 0.1);
  const std::size_t what = dice.below(4);
  if (what == 0)
    s.events.push_back(
        {time_s, Event::When::time,
         MoveTarget{dice.below(targets), dice.around({}, 0.3 * reach, reach), dice.once_in(2) ? 0.0 : 0.05}});
  else if (what == 1) s.events.push_back({time_s, Event::When::time, AddTarget{dice.around({}, 0.3 * reach, reach)}});
  else if (what == 2 && targets > 1) s.events.push_back({time_s, Event::When::time, RemoveTarget{dice.below(targets)}});
  else
    s.events.push_back(
        {time_s, Event::When::time, Freeze{dice.below(*s.swarm.robots), rounded(dice.between(1.0, 30.0), 0.1)}});
}

Scenario drawn(std::uint64_t seed, std::uint64_t index, std::uint64_t attempt) {
  Dice dice(seed, index, attempt);
  Scenario s = world::plain_scenario(algorithms());
  s.name = "soak-" + std::to_string(seed) + "-" + std::to_string(index);
  s.seed = mix(seed ^ mix(index)) >> 32;
  const bool plain = dice.once_in(4);  // of the kind of which most is promised, whatever its start
  draw_radio(dice, s, plain);
  draw_start(dice, s);
  draw_targets(dice, s, plain);
  const std::vector<Vec2> targets = target_positions(s);
  double reach = 0.0;
  for (const Vec2 p : targets) reach = std::max(reach, norm(p));
  s.mission.time_limit_s = std::round(10.0 * std::max(reach, 1.0) / s.robot.wheel_limit_m_s);
  if (plain) return s;
  const std::size_t body = dice.below(10);
  s.robot.body = body == 0 ? BodyModel::linear : body == 1 ? BodyModel::box2d : BodyModel::disks;
  if (dice.once_in(2.2)) draw_obstacles(dice, s, reach);
  if (dice.once_in(4)) draw_noise(dice, s);
  if (dice.once_in(6)) s.clocks = {true, rounded(dice.between(0.0, 0.05), 0.001), 5};
  if (dice.once_in(4)) draw_deaths(dice, s, s.mission.time_limit_s);
  if (dice.once_in(8)) draw_changes(dice, s, reach, s.mission.time_limit_s, targets.size());
  return s;
}

bool is_possible(const Scenario& scenario) {
  const auto found = faults(scenario);
  return std::none_of(found.begin(), found.end(), [](const Fault& f) { return !f.warning; });
}

}  // namespace

// A draw that does not fit, such as a target in a box, is repeated.
Scenario mission(std::uint64_t seed, std::uint64_t index) {
  for (std::uint64_t attempt = 0;; ++attempt)
    if (Scenario s = drawn(seed, index, attempt); is_possible(s)) return s;
}

Traits traits_of(const Scenario& s) {
  Traits t;
  for (const Event& event : s.events) {
    const bool death = std::holds_alternative<Die>(event.action) || std::holds_alternative<Kill>(event.action);
    (death ? t.deaths : t.changes) = true;
  }
  t.noise = s.radio.range_noise_m > 0.0 || s.radio.bearing_noise_rad > 0.0 || s.robot.wheel_noise > 0.0 ||
            s.robot.wheel_bias > 0.0 || s.robot.odometry_noise > 0.0;
  t.obstacles = !s.obstacles.empty();
  t.clocks = s.clocks.asynchronous || s.radio.latency_ticks > 1;
  t.loose = s.swarm.start.layout != Layout::hexagonal || start_pitch_m(s) > 0.25 * s.radio.range_m;
  t.small_radio = s.radio.range_m < 2.0;
  t.rough_radio = s.radio.model != RadioModel::Model::disc || s.radio.loss > 0.3 || s.radio.slots > 0;
  t.many = target_positions(s).size() > 12;
  return t;
}

std::string text_of(const Traits& t) {
  std::string text;
  const auto add = [&text](bool is, const char* word) {
    if (is) text += (text.empty() ? "" : ", ") + std::string(word);
  };
  add(t.loose, "loose start");
  add(t.many, "many targets");
  add(t.deaths, "deaths");
  add(t.noise, "noise");
  add(t.obstacles, "obstacles");
  add(t.changes, "changes");
  add(t.clocks, "clocks or latency");
  add(t.small_radio, "small radio");
  add(t.rough_radio, "rough radio");
  return text.empty() ? "plain" : text;
}

}  // namespace banyan::soak
