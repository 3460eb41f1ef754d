// SPDX-License-Identifier: MIT
// What a scenario stands for, and everything that can be wrong with one. Checks run in two
// rounds: numbers one by one, then, only if these are sane, how they fit together.
#include "banyan/world/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

#include "banyan/controller/core/trig.hpp"
#include "banyan/world/bodies.hpp"
#include "banyan/world/names.hpp"
#include "banyan/world/obstacles.hpp"
#include "banyan/world/placement.hpp"
#include "banyan/world/random.hpp"

namespace banyan::world {
namespace {

constexpr double world_size = 1e4;        // m; beyond it single precision on robots loses the millimetre
constexpr std::size_t most_robots = nobody;  // ids are 16 bits, the last one means nobody
constexpr std::size_t most_targets = 10000;
constexpr double delta_inwards = 1.540841;  // m; protocol 2, row 10

std::string number(double x) {
  char text[32];
  static_cast<void>(std::snprintf(text, sizeof text, "%g", x));  // %g always fits
  return text;
}
std::string at(Vec2 p) { return "(" + number(p.x) + ", " + number(p.y) + ")"; }
std::string element(const char* list, std::size_t i) { return std::string(list) + "[" + std::to_string(i) + "]"; }

struct Range {
  double minimum, maximum;
  bool above = false;  // minimum itself is not allowed
};
constexpr Range positive(double maximum) { return {0.0, maximum, true}; }
constexpr Range up_to(double maximum) { return {0.0, maximum}; }

// Collects faults; each check says whether it passed.
class Report {
 public:
  bool number_in(const std::string& key, double x, Range range) {
    if (std::isfinite(x) && (range.above ? x > range.minimum : x >= range.minimum) && x <= range.maximum) return true;
    const std::string allowed = range.above
        ? "above " + number(range.minimum) + " and at most " + number(range.maximum)
        : "between " + number(range.minimum) + " and " + number(range.maximum);
    return fail(key, "must be a number " + allowed + ", not " + number(x));
  }
  bool count_in(const std::string& key, std::size_t n, std::size_t minimum, std::size_t maximum) {
    if (n >= minimum && n <= maximum) return true;
    return fail(key, "must be between " + std::to_string(minimum) + " and " + std::to_string(maximum) + ", not " +
                         std::to_string(n));
  }
  bool point(const std::string& key, Vec2 p) {
    if (std::abs(p.x) <= world_size && std::abs(p.y) <= world_size) return true;  // false for NaN
    return fail(key, "must lie within " + number(world_size) + " m of the origin, not at " + at(p));
  }
  bool fail(std::string key, std::string text) {
    list_.push_back({std::move(key), std::move(text), false});
    return false;
  }
  void warn(std::string key, std::string text) { list_.push_back({std::move(key), std::move(text), true}); }
  [[nodiscard]] bool failed() const noexcept {
    return std::any_of(list_.begin(), list_.end(), [](const Fault& f) { return !f.warning; });
  }
  [[nodiscard]] std::vector<Fault> take() { return std::move(list_); }

 private:
  std::vector<Fault> list_;
};

// A number that becomes the controller parameter `name`, in the single precision it will have;
// false if there is no such parameter.
bool check_as_parameter(Report& report, const std::string& key, double x, std::string_view name) {
  for (const ParameterInfo& info : parameter_table()) {
    if (info.key != name) continue;
    const bool fits = std::abs(x) <= static_cast<double>(std::numeric_limits<float>::max());  // false for NaN
    report.number_in(key, fits ? static_cast<double>(static_cast<float>(x)) : x, {info.minimum, info.maximum});
    return true;
  }
  return false;
}

// ---------------------------------------------------------------- round one: every number

void check_name(Report& report, const char* key, std::string_view word, std::span<const std::string_view> known) {
  if (std::find(known.begin(), known.end(), word) != known.end()) return;
  const std::string_view near = nearest_name(word, known);
  report.fail(key, "\"" + std::string(word) + "\" is unknown; must be " + listed(known) +
                       (near.empty() ? "" : " (did you mean " + std::string(near) + "?)"));
}

// Parameters that describe the platform have their place elsewhere in a scenario.
std::string_view platform_key(std::string_view parameter) noexcept {
  if (parameter == "communication_range_m") return "radio.range_m";
  if (parameter == "tick_s") return "tick_s";
  if (parameter == "wheel_limit_m_s") return "robot.wheel_limit_m_s";
  if (parameter == "wheel_distance_m") return "robot.wheel_distance_m";
  return {};
}

void check_parameter(Report& report, const std::string& name, double value) {
  const std::string key = "mission.parameters." + name;
  if (const std::string_view place = platform_key(name); !place.empty()) {
    report.fail(key, "is set by " + std::string(place));
    return;
  }
  if (check_as_parameter(report, key, value, name)) return;
  std::vector<std::string_view> known;
  for (const ParameterInfo& info : parameter_table())
    if (platform_key(info.key).empty()) known.push_back(info.key);
  const std::string_view near = nearest_name(name, known);
  report.fail(key, "there is no such parameter" +
                       (near.empty() ? std::string() : "; did you mean " + std::string(near) + "?"));
}

void check_mission(Report& report, const Mission& mission) {
  std::vector<std::string_view> names;
  for (const Algorithm* algorithm : algorithms()) names.push_back(algorithm->name());
  check_name(report, "mission.algorithm", mission.algorithm, names);
  const std::string_view readings[] = {"corrected", "literal"};
  check_name(report, "mission.reading", mission.reading, readings);
  report.number_in("mission.scale", mission.scale, positive(1000.0));
  report.number_in("mission.target_tolerance_m", mission.target_tolerance_m, positive(world_size));
  report.number_in("mission.time_limit_s", mission.time_limit_s, up_to(1e7));
  report.number_in("mission.settle_s", mission.settle_s, up_to(1e7));
  for (const auto& [name, value] : mission.parameters) check_parameter(report, name, value);
}

void check_list_start(Report& report, const SwarmModel& swarm) {
  const Start& start = swarm.start;
  report.count_in("swarm.start.positions", start.positions.size(), 1, most_robots);
  if (swarm.robots != 0 && swarm.robots != start.positions.size())
    report.fail("swarm.robots", "is " + std::to_string(swarm.robots) + ", but swarm.start.positions lists " +
                                    std::to_string(start.positions.size()) + "; leave it out");
  for (std::size_t i = 0; i < start.positions.size(); ++i)
    report.point(element("swarm.start.positions", i), start.positions[i]);
  if (!start.headings_rad.empty() && start.headings_rad.size() != start.positions.size())
    report.fail("swarm.start.headings_rad", "must have one entry per position (" +
                                                std::to_string(start.positions.size()) + "), not " +
                                                std::to_string(start.headings_rad.size()));
  for (std::size_t i = 0; i < start.headings_rad.size(); ++i)
    report.number_in(element("swarm.start.headings_rad", i), start.headings_rad[i], {-1000.0, 1000.0});
}

void check_swarm(Report& report, const SwarmModel& swarm) {
  const Start& start = swarm.start;
  report.point("swarm.start.center", start.center);
  if (start.layout == Layout::list) {
    check_list_start(report, swarm);
    return;
  }
  if (!start.positions.empty()) report.fail("swarm.start.positions", "needs swarm.start.layout = \"list\"");
  if (!start.headings_rad.empty()) report.fail("swarm.start.headings_rad", "needs swarm.start.layout = \"list\"");
  report.number_in("swarm.start.pitch_m", start.pitch_m, positive(1000.0));
  report.number_in("swarm.start.jitter_m", start.jitter_m, up_to(1000.0));
  if (swarm.robots == 0) report.number_in("swarm.redundancy", swarm.redundancy, positive(1000.0));
  else report.count_in("swarm.robots", swarm.robots, 2, most_robots);
}

void check_robot(Report& report, const RobotModel& robot) {
  if (robot.body == BodyModel::box2d && !has_box2d())
    report.fail("robot.body", "the body model box2d is not in the browser's build; use disks or linear");
  report.number_in("robot.radius_m", robot.radius_m, positive(100.0));
  check_as_parameter(report, "robot.wheel_distance_m", robot.wheel_distance_m, "wheel_distance_m");
  check_as_parameter(report, "robot.wheel_limit_m_s", robot.wheel_limit_m_s, "wheel_limit_m_s");
  report.number_in("robot.wheel_noise", robot.wheel_noise, up_to(1.0));
  report.number_in("robot.wheel_bias", robot.wheel_bias, up_to(1.0));
  report.number_in("robot.odometry_noise", robot.odometry_noise, up_to(1.0));
  report.number_in("robot.mass_kg", robot.mass_kg, positive(1e4));
  report.number_in("robot.max_force_n", robot.max_force_n, positive(1e6));
  report.number_in("robot.max_torque_nm", robot.max_torque_nm, positive(1e6));
  report.number_in("robot.max_acceleration_m_s2", robot.max_acceleration_m_s2, positive(1e4));
  report.number_in("robot.proximity_m", robot.proximity_m, up_to(100.0));
}

void check_clocks(Report& report, const Clocks& clocks) {
  report.number_in("clocks.drift", clocks.drift, up_to(0.5));
  report.number_in("clocks.substeps", clocks.substeps, {2.0, 100.0});
  if (!clocks.asynchronous && clocks.drift != 0.0) report.warn("clocks.drift", "has no effect without clocks.asynchronous");
}

void check_radio(Report& report, const RadioModel& radio) {
  check_as_parameter(report, "radio.range_m", radio.range_m, "communication_range_m");
  report.number_in("radio.loss", radio.loss, up_to(1.0));
  report.number_in("radio.range_noise_m", radio.range_noise_m, up_to(1000.0));
  report.number_in("radio.bearing_noise_rad", radio.bearing_noise_rad, up_to(pi<double>));
  report.number_in("radio.latency_ticks", radio.latency_ticks, {1.0, 100.0});
  report.number_in("radio.slots", radio.slots, up_to(65535.0));
}

struct CheckTargets {
  Report& report;
  void operator()(const std::vector<Vec2>& list) const {
    report.count_in("targets.positions", list.size(), 1, most_targets);
    for (std::size_t i = 0; i < list.size(); ++i) report.point(element("targets.positions", i), list[i]);
  }
  void operator()(const RingTargets& ring) const {
    both(ring);
    report.number_in("targets.phase_rad", ring.phase_rad, {-1000.0, 1000.0});
  }
  void operator()(const RandomTargets& random) const { both(random); }
  template <class T>
  void both(const T& t) const {
    report.count_in("targets.count", t.count, 1, most_targets);
    report.number_in("targets.radius_m", t.radius_m, up_to(world_size));
    report.point("targets.center", t.center);
  }
};

struct CheckObstacle {
  Report& report;
  std::string key;
  void operator()(const Disc& disc) const {
    report.point(key + ".center", disc.center);
    report.number_in(key + ".radius_m", disc.radius_m, positive(world_size));
  }
  void operator()(const Box& box) const {
    report.point(key + ".center", box.center);
    report.number_in(key + ".size", std::min(box.size.x, box.size.y), positive(world_size));
    report.number_in(key + ".size", std::max(box.size.x, box.size.y), positive(world_size));
    report.number_in(key + ".angle_rad", box.angle_rad, {-1000.0, 1000.0});
  }
  void operator()(const Wall& wall) const {
    const bool ends = report.point(key + ".from", wall.from) && report.point(key + ".to", wall.to);
    if (ends && wall.from == wall.to) report.fail(key + ".to", "must differ from the wall's other end");
  }
};

void check_kill(Report& report, const std::string& key, const Event& event) {
  if (event.share && event.count) report.fail(key + ".share", "give share or count, not both");
  if (event.share) report.number_in(key + ".share", *event.share, up_to(1.0));
  if (event.count) report.count_in(key + ".count", *event.count, 1, most_robots);
  report.number_in(key + ".every_s", event.every_s, up_to(1e7));
}

void check_event(Report& report, const std::string& key, const Event& event) {
  report.number_in(key + ".time_s", event.time_s, up_to(1e7));
  switch (event.kind) {
    case Event::Kind::set_loss: report.number_in(key + ".loss", event.value, up_to(1.0)); break;
    case Event::Kind::freeze: report.number_in(key + ".seconds", event.value, up_to(1e7)); break;
    case Event::Kind::blackout: report.number_in(key + ".duration_s", event.value, positive(1e7)); break;
    case Event::Kind::move_target: report.number_in(key + ".speed_m_s", event.value, up_to(100.0)); [[fallthrough]];
    case Event::Kind::add_target:
    case Event::Kind::move_obstacle: report.point(key + ".position", event.position); break;
    case Event::Kind::set_line_of_sight:
      if (event.value != 0.0 && event.value != 1.0)
        report.fail(key + ".line_of_sight", "must be 0 or 1, not " + number(event.value));
      break;
    case Event::Kind::kill: check_kill(report, key, event); break;
    case Event::Kind::die:
    case Event::Kind::remove_target: break;
    default: report.fail(key + ".kind", "there is no such kind");
  }
}

void check_numbers(Report& report, const Scenario& scenario) {
  check_as_parameter(report, "tick_s", scenario.tick_s, "tick_s");
  check_mission(report, scenario.mission);
  check_swarm(report, scenario.swarm);
  check_robot(report, scenario.robot);
  check_radio(report, scenario.radio);
  check_clocks(report, scenario.clocks);
  std::visit(CheckTargets{report}, scenario.targets);
  for (std::size_t i = 0; i < scenario.obstacles.size(); ++i)
    std::visit(CheckObstacle{report, element("obstacles", i)}, scenario.obstacles[i]);
  for (std::size_t i = 0; i < scenario.events.size(); ++i)
    check_event(report, element("events", i), scenario.events[i]);
}

// ---------------------------------------------------------------- round two: how they fit

double clearance_to_all(const std::vector<Obstacle>& obstacles, Vec2 p) noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (const Obstacle& o : obstacles) least = std::min(least, clearance(o, p));
  return least;
}

std::string target_key(const Scenario& scenario, std::size_t i) {
  return std::holds_alternative<std::vector<Vec2>>(scenario.targets) ? element("targets.positions", i) : "targets";
}

void check_target_room(Report& report, const Scenario& scenario, const std::vector<Obstacle>& obstacles,
                       const std::string& key, const std::string& name, Vec2 p) {
  const double room = clearance_to_all(obstacles, p);
  if (room <= 0.0) {
    report.fail(key, name + " at " + at(p) + " lies inside an obstacle");
  } else if (room + scenario.mission.target_tolerance_m < scenario.robot.radius_m) {
    report.fail(key, name + " at " + at(p) + " is so close to an obstacle that no robot of radius " +
                         number(scenario.robot.radius_m) + " m gets within mission.target_tolerance_m of it");
  }
}

void check_platform(Report& report, const Scenario& scenario) {
  const double reach = scenario.robot.wheel_limit_m_s * scenario.tick_s;
  if (!scenario.obstacles.empty() && reach >= scenario.robot.radius_m)
    report.fail("tick_s", "a robot covers " + number(reach) + " m in one tick and could pass through an obstacle;"
                              " tick_s * robot.wheel_limit_m_s must be below robot.radius_m");
  if (2.0 * scenario.robot.radius_m >= scenario.radio.range_m)
    report.fail("radio.range_m", "must exceed two robot radii (" + number(2.0 * scenario.robot.radius_m) +
                                     " m), else no robot can hear another");
  if (time_limit_s(scenario) < scenario.tick_s)
    report.fail("mission.time_limit_s", "must be given when no target is away from swarm.start.center");
  if (const std::string text = find_algorithm(scenario.mission.algorithm)->fault(setup_of(scenario)); !text.empty())
    report.fail("mission.parameters", text);
}

std::size_t find(std::vector<std::size_t>& leader, std::size_t i) noexcept {
  while (leader[i] != i) i = leader[i] = leader[leader[i]];
  return i;
}

// Overlaps and connected components of a list start, by a sweep along x.
void check_listed_cluster(Report& report, const Scenario& scenario) {
  const std::vector<Vec2>& p = scenario.swarm.start.positions;
  const double range = scenario.radio.range_m;
  const double touch = 2.0 * scenario.robot.radius_m;
  std::vector<std::size_t> order(p.size());
  std::vector<std::size_t> leader(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::iota(leader.begin(), leader.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return p[a].x != p[b].x ? p[a].x < p[b].x : a < b;
  });
  std::size_t parts = p.size();
  for (std::size_t a = 0; a < p.size(); ++a) {
    for (std::size_t b = a + 1; b < p.size() && p[order[b]].x - p[order[a]].x < std::max(range, touch); ++b) {
      const std::size_t i = std::min(order[a], order[b]);
      const std::size_t j = std::max(order[a], order[b]);
      const double d = distance(p[i], p[j]);
      if (d < touch)
        report.fail(element("swarm.start.positions", j), "overlaps position " + std::to_string(i) + ": " + number(d) +
                                                             " m apart, two radii are " + number(touch) + " m");
      const std::size_t left = find(leader, i);
      const std::size_t right = find(leader, j);
      if (d < range && left != right) {
        leader[right] = left;
        --parts;
      }
    }
  }
  if (parts > 1)
    report.fail("swarm.start.positions", "the start is not connected: " + std::to_string(parts) +
                                             " groups are farther than radio.range_m = " + number(range) +
                                             " m from each other");
  for (std::size_t i = 0; i < p.size(); ++i)
    if (clearance_to_all(scenario.obstacles, p[i]) < scenario.robot.radius_m)
      report.fail(element("swarm.start.positions", i), "a robot at " + at(p[i]) + " touches an obstacle");
}

void check_lattice_cluster(Report& report, const Scenario& scenario) {
  const Start& start = scenario.swarm.start;
  const double touch = 2.0 * scenario.robot.radius_m;
  if (start.pitch_m - 2.0 * start.jitter_m < touch)
    report.fail("swarm.start.pitch_m", "robots do not fit: pitch_m - 2 jitter_m = " +
                                           number(start.pitch_m - 2.0 * start.jitter_m) +
                                           " m must be at least two radii, " + number(touch) + " m");
  if (start.pitch_m + 2.0 * start.jitter_m >= scenario.radio.range_m)
    report.fail("swarm.start.pitch_m", "the start would not be connected: pitch_m + 2 jitter_m = " +
                                           number(start.pitch_m + 2.0 * start.jitter_m) +
                                           " m must be below radio.range_m = " + number(scenario.radio.range_m) + " m");
  if (report.failed() || scenario.obstacles.empty()) return;
  const std::size_t wanted = robot_count(scenario);
  const std::size_t placed = place(scenario).position.size();
  if (placed == 0)
    report.fail("swarm.start.center", "there is no room for a robot at " + at(start.center) + ": an obstacle is closer"
                                          " than robot.radius_m + swarm.start.jitter_m");
  else if (placed < wanted)
    report.fail("swarm.start", "only " + std::to_string(placed) + " of " + std::to_string(wanted) +
                                   " robots fit between the obstacles around the start");
}

void check_swarm_fits(Report& report, const Scenario& scenario) {
  const std::size_t robots = robot_count(scenario);
  if (robots > most_robots) {
    report.fail("swarm.redundancy", "asks for " + std::to_string(robots) + " robots; at most " +
                                        std::to_string(most_robots) + " are possible");
    return;
  }
  if (scenario.swarm.root && *scenario.swarm.root >= robots)
    report.fail("swarm.root", "there is no robot " + std::to_string(*scenario.swarm.root) + "; the last one is " +
                                  std::to_string(robots - 1));
  if (scenario.swarm.start.layout == Layout::list) check_listed_cluster(report, scenario);
  else check_lattice_cluster(report, scenario);
}

// What the events before one leave behind, as far as that can be told beforehand.
struct Sequel {
  std::size_t targets;   // that have been there, given up or not
  std::size_t served;    // those that are not given up
  std::size_t most;      // the largest of `served` so far
  std::vector<std::size_t> removed;
  std::vector<Obstacle> obstacles;
};

// Who and what an event refers to exists when it happens.
void check_event_fits(Report& report, const Scenario& scenario, std::size_t index, std::size_t robots, const Sequel& before) {
  const Event& event = scenario.events[index];
  const std::string key = element("events", index);
  const bool robot = event.kind == Event::Kind::die || event.kind == Event::Kind::freeze;
  const bool target = event.kind == Event::Kind::move_target || event.kind == Event::Kind::remove_target;
  if (const double limit = time_limit_s(scenario); event.time_s >= limit)
    report.warn(key + ".time_s", "the run ends before: its limit is " + number(limit) + " s");
  if (robot && event.index >= robots)
    report.fail(key + ".robot", "there is no robot " + std::to_string(event.index) + "; the last one is " +
                                    std::to_string(robots - 1));
  if (target && event.index >= before.targets)
    report.fail(key + ".target", "there is no target " + std::to_string(event.index) +
                                     " at that time; the last one is " + std::to_string(before.targets - 1));
  const std::size_t obstacles = before.obstacles.size();
  if (event.kind == Event::Kind::move_obstacle && event.index >= obstacles)
    report.fail(key + ".obstacle", "there is no obstacle " + std::to_string(event.index) +
                                       (obstacles == 0 ? "" : "; the last one is " + std::to_string(obstacles - 1)));
  if (event.kind == Event::Kind::add_target || event.kind == Event::Kind::move_target)
    check_target_room(report, scenario, before.obstacles, key + ".position", "the target", event.position);
}

void follow(Sequel& sequel, const Event& event) {
  if (event.kind == Event::Kind::move_obstacle && event.index < sequel.obstacles.size())
    sequel.obstacles[event.index] = moved(sequel.obstacles[event.index], event.position);
  if (event.kind == Event::Kind::add_target) {
    ++sequel.targets;
    sequel.most = std::max(sequel.most, ++sequel.served);
  }
  const auto known = std::find(sequel.removed.begin(), sequel.removed.end(), event.index);
  if (event.kind == Event::Kind::remove_target && event.index < sequel.targets && known == sequel.removed.end()) {
    sequel.removed.push_back(event.index);
    --sequel.served;
  }
}

// Returns the largest number of targets at a time. Events that wait for a moment of the mission are
// taken as late as possible: after all the others, and adding to the most there has been.
std::size_t check_events(Report& report, const Scenario& scenario, std::size_t targets, std::size_t robots) {
  const std::vector<Event>& events = scenario.events;
  std::vector<std::size_t> order(events.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return events[a].time_s < events[b].time_s; });
  const auto waits = [&](std::size_t i) { return events[i].when != Event::When::time; };
  const auto adds_late = static_cast<std::size_t>(std::count_if(order.begin(), order.end(), [&](std::size_t i) {
    return waits(i) && events[i].kind == Event::Kind::add_target;
  }));
  Sequel sequel{targets + adds_late, targets, targets, {}, scenario.obstacles};
  for (const std::size_t i : order) {
    if (waits(i)) continue;
    check_event_fits(report, scenario, i, robots, sequel);
    follow(sequel, events[i]);
  }
  for (const std::size_t i : order)
    if (waits(i)) check_event_fits(report, scenario, i, robots, sequel);
  return sequel.most + adds_late;
}

// False if there are more targets than robots that can be sent.
bool check_events_fit(Report& report, const Scenario& scenario, std::size_t targets, std::size_t robots) {
  const std::size_t at_most = check_events(report, scenario, targets, robots);
  if (at_most + 1 <= robots) return true;
  return report.fail("swarm.robots", std::to_string(robots) + " robots cannot serve " + std::to_string(at_most) +
                                         " targets: each needs a worker, and the root is none of them");
}

void check_targets_fit(Report& report, const Scenario& scenario) {
  const std::vector<Vec2> targets = target_positions(scenario);
  const std::size_t robots = robot_count(scenario);
  for (std::size_t i = 0; i < targets.size(); ++i)
    check_target_room(report, scenario, scenario.obstacles, target_key(scenario, i), "target " + std::to_string(i), targets[i]);
  if (!check_events_fit(report, scenario, targets.size(), robots)) return;
  const std::size_t needed = least_robots(targets, scenario.mission.target_tolerance_m, scenario.radio.range_m);
  if (needed > robots)
    report.warn("targets", "out of reach: no connected network of fewer than " + std::to_string(needed) +
                               " robots spans the targets at radio.range_m = " + number(scenario.radio.range_m) +
                               " m, and there are " + std::to_string(robots));
}

// ---------------------------------------------------------------- what a scenario stands for

struct TargetPositions {
  const Scenario& scenario;
  std::vector<Vec2> operator()(const std::vector<Vec2>& list) const { return list; }
  std::vector<Vec2> operator()(const RingTargets& ring) const {
    std::vector<Vec2> positions;
    for (std::size_t i = 0; i < ring.count; ++i) {
      const double turn = 2.0 * pi<double> * (static_cast<double>(i) / static_cast<double>(ring.count));
      positions.push_back(ring.center + ring.radius_m * unit_vector(ring.phase_rad + turn));
    }
    return positions;
  }
  std::vector<Vec2> operator()(const RandomTargets& random) const {
    std::vector<Vec2> positions;
    for (std::size_t i = 0; i < random.count; ++i) positions.push_back(draw(random, i));
    return positions;
  }
  // A draw in an obstacle is repeated; when obstacles cover everything, faults() sees the last one.
  [[nodiscard]] Vec2 draw(const RandomTargets& random, std::size_t i) const {
    Vec2 p{};
    for (std::uint64_t attempt = 0; attempt < 1000; ++attempt) {
      const double u = to_uniform(bits(scenario.seed, Purpose::targets, i, 2 * attempt));
      const double v = to_uniform(bits(scenario.seed, Purpose::targets, i, 2 * attempt + 1));
      p = random.center + random.radius_m * std::sqrt(0.1 + 0.9 * u) * unit_vector(2.0 * pi<double> * v);
      if (clearance_to_all(scenario.obstacles, p) >= scenario.robot.radius_m) break;
    }
    return p;
  }
};

// Prim's algorithm: length of the minimum spanning tree, O(T^2).
double spanning_tree_length(const std::vector<Vec2>& points) {
  std::vector<double> gap(points.size(), std::numeric_limits<double>::infinity());
  std::vector<std::uint8_t> done(points.size(), 0);
  double length = 0.0;
  std::size_t next = 0;
  for (std::size_t step = 0; step < points.size(); ++step) {
    const std::size_t last = next;
    done[last] = 1;
    if (step > 0) length += gap[last];
    next = points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (done[i]) continue;
      gap[i] = std::min(gap[i], distance(points[last], points[i]));
      if (next == points.size() || gap[i] < gap[next]) next = i;
    }
  }
  return length;
}

// ceil that forgives the rounding of sines and divisions.
std::size_t robots_for(double x) noexcept { return static_cast<std::size_t>(std::max(0.0, std::ceil(x - 1e-9))); }

}  // namespace

std::vector<Fault> faults(const Scenario& scenario) {
  Report report;
  check_numbers(report, scenario);
  if (!report.failed()) check_platform(report, scenario);
  if (!report.failed()) {
    check_swarm_fits(report, scenario);
    check_targets_fit(report, scenario);
  }
  return report.take();
}

std::vector<Fault> event_faults(const Scenario& scenario, const Present* now) {
  Report report;
  for (std::size_t i = 0; i < scenario.events.size(); ++i)
    check_event(report, element("events", i), scenario.events[i]);
  const std::size_t robots = robot_count(scenario);
  if (!report.failed()) check_events_fit(report, scenario, target_positions(scenario).size(), robots);
  if (report.failed() || now == nullptr || scenario.events.empty()) return report.take();
  const std::size_t last = scenario.events.size() - 1;
  if (scenario.events[last].when != Event::When::time)
    report.fail(element("events", last) + ".when", "what somebody does happens now");
  check_event_fits(report, scenario, last, robots, {now->targets, 0, 0, {}, now->obstacles});
  return report.take();
}

std::vector<Vec2> target_positions(const Scenario& scenario) {
  return std::visit(TargetPositions{scenario}, scenario.targets);
}

std::size_t robot_count(const Scenario& scenario) {
  const SwarmModel& swarm = scenario.swarm;
  if (swarm.start.layout == Layout::list) return swarm.start.positions.size();
  if (swarm.robots != 0) return swarm.robots;
  double length = 0.0;
  const std::vector<Vec2> targets = target_positions(scenario);
  for (const Vec2 p : targets) length += distance(swarm.start.center, p);
  return std::max(robots_for(swarm.redundancy * length / delta_inwards), targets.size() + 1);
}

// A packet is heard so many steps of the swarm after it was composed, at most: it flies, and waits until its
// receiver's clock strikes.
static std::size_t longest_way(const Scenario& scenario) {
  const auto latency = static_cast<std::size_t>(std::max(1, scenario.radio.latency_ticks));
  if (!scenario.clocks.asynchronous) return latency;
  const auto substeps = static_cast<std::size_t>(std::max(1, scenario.clocks.substeps));
  const double slowest = std::max(1.0 - scenario.clocks.drift, 1e-3);
  return (latency - 1) * substeps + static_cast<std::size_t>(std::ceil(static_cast<double>(substeps) / slowest)) + 2;
}

double time_limit_s(const Scenario& scenario) {
  if (scenario.mission.time_limit_s > 0.0) return scenario.mission.time_limit_s;
  double farthest = 0.0;
  for (const Vec2 p : target_positions(scenario))
    farthest = std::max(farthest, distance(scenario.swarm.start.center, p));
  return 10.0 * farthest / scenario.robot.wheel_limit_m_s;
}

Setup setup_of(const Scenario& scenario) {
  Setup setup;
  setup.reading = scenario.mission.reading;
  setup.scale = scenario.mission.scale;
  setup.platform.communication_range_m = static_cast<float>(scenario.radio.range_m);
  setup.platform.line_of_sight = scenario.radio.line_of_sight;
  setup.platform.tick_s = static_cast<float>(scenario.tick_s);
  setup.platform.wheel_limit_m_s = static_cast<float>(scenario.robot.wheel_limit_m_s);
  setup.platform.wheel_distance_m = static_cast<float>(scenario.robot.wheel_distance_m);
  setup.platform.drive = scenario.robot.body == BodyModel::linear ? Drive::holonomic : Drive::differential;
  setup.arrival_distance_m = scenario.mission.target_tolerance_m;
  setup.parameters = scenario.mission.parameters;
  setup.history = longest_way(scenario);
  return setup;
}

std::size_t least_robots(const std::vector<Vec2>& targets, double tolerance_m, double range_m) {
  double longest = 0.0;
  for (const Vec2 a : targets)
    for (const Vec2 b : targets) longest = std::max(longest, distance(a, b));
  const double count = static_cast<double>(targets.size());
  const double links = std::max(longest - 2.0 * tolerance_m,
                                0.8241 * spanning_tree_length(targets) - count * tolerance_m) / range_m;
  return robots_for(links) + 1;
}

}  // namespace banyan::world
