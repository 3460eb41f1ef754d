// SPDX-License-Identifier: MIT
// Everything that can be wrong with a scenario. Checks run in two rounds: values one by one, against
// the table of keys, and, only if these are valid, how they fit together.
#include "banyan/world/faults.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "banyan/controller/core/algorithm.hpp"
#include "banyan/world/bodies.hpp"
#include "banyan/world/decimal.hpp"
#include "banyan/world/names.hpp"
#include "banyan/world/obstacles.hpp"
#include "banyan/world/placement.hpp"
#include "banyan/world/schema.hpp"
#include "banyan/world/stations.hpp"
#include "fault_list.hpp"

namespace banyan::world {
namespace {

// ---- Round one: every value ----

void check_range(FaultList& list, const std::string& key, double x, const Range& range, std::string_view unit) {
  if (const auto text = range_fault(x, range, unit)) list.fail(key, *text);
}

// A value against the row of its key; `path` as users write it.
struct CheckValue {
  FaultList& list;
  const std::string& path;
  const Range& range;
  std::string_view unit;
  Names names;
  void operator()(std::monostate) const {}
  void operator()(bool) const {}
  void operator()(const NamePairs& /*pairs*/) const {}
  void operator()(std::int64_t n) const {
    if (const auto text = whole_range_fault(n, range, unit)) list.fail(path, *text);
  }
  void operator()(double x) const { check_range(list, path, x, range, unit); }
  void operator()(const std::string& word) const {
    if (names.empty()) return;
    if (const auto text = name_fault(word, names)) list.fail(path, *text);
  }
  void operator()(Vec2 p) const {
    check_range(list, path + "[0]", p.x, range, unit);
    check_range(list, path + "[1]", p.y, range, unit);
  }
  template <class Element> void operator()(const std::vector<Element>& elements) const {
    for (std::size_t i = 0; i < elements.size(); ++i)
      CheckValue{list, element(path, i), range, unit, names}(elements[i]);
  }
};

// `shown` is the section as users write it: "events[2]" for "events".
template <class Owner>
void check_keys(FaultList& list, const std::string& shown, std::span<const Key<Owner>> keys, const Owner& owner) {
  for (const Key<Owner>& key : keys) {
    if (key.terms.only_in_files) continue;
    const std::string path = shown.empty() ? std::string(key.path) : shown + "." + std::string(key.name());
    const Value value = effective(key, keys, owner);
    std::visit(CheckValue{list, path, key.range, key.unit, key.access.names(owner)}, value);
    if (value.index() == 0 && key.access.optional && get(key, owner).index() != 0)
      list.fail(path, "give " + std::string(key.name()) + " or " + std::string(key.terms.not_beside) + ", not both");
  }
}

void check_parameter(FaultList& list, const AlgorithmList& algorithms, const std::string& name, double value) {
  const std::string key = "mission.parameters." + name;
  std::vector<std::string_view> known;
  for (const ParameterInfo& info : algorithms.parameters()) {
    if (info.key == name) {
      check_range(list, key, value, {widened(info.minimum), widened(info.maximum)}, info.unit);
      return;
    }
    known.push_back(info.key);
  }
  const std::string_view near = nearest_name(name, known);
  list.fail(
      key, "there is no such parameter" + (near.empty() ? std::string() : "; did you mean " + std::string(near) + "?"));
}

// The largest value that a key may have.
std::size_t most(std::string_view path) {
  return static_cast<std::size_t>(find_key(scenario_keys(), path)->range.maximum);
}

// Keys that a list start excludes, and keys that need one.
void check_layout(FaultList& list, const SwarmModel& swarm) {
  const Start& start = swarm.start;
  if (start.layout != Layout::list) {
    if (!start.positions.empty()) list.fail("swarm.start.positions_m", "needs swarm.start.layout = \"list\"");
    if (!start.headings_rad.empty()) list.fail("swarm.start.headings_deg", "needs swarm.start.layout = \"list\"");
    return;
  }
  list.check_length("swarm.start.positions_m", start.positions.size(), most("swarm.robots"));
  if (swarm.robots && *swarm.robots != start.positions.size())
    list.fail("swarm.robots", "is " + std::to_string(*swarm.robots) + ", but swarm.start.positions_m lists " +
                                  std::to_string(start.positions.size()) + "; leave it out");
  if (!start.headings_rad.empty() && start.headings_rad.size() != start.positions.size())
    list.fail("swarm.start.headings_deg", "must have one entry per position (" +
                                              std::to_string(start.positions.size()) + "), not " +
                                              std::to_string(start.headings_rad.size()));
}

bool switches_sight_on(const Scenario& scenario) {
  return std::any_of(scenario.events.begin(), scenario.events.end(), [](const Event& event) {
    const auto* change = std::get_if<SetLineOfSight>(&event.action);
    return change != nullptr && change->line_of_sight;
  });
}

// Why there is none.
#ifdef __EMSCRIPTEN__
constexpr const char* no_box2d = "the body model box2d is not in the browser's build; use disks or linear";
#else
constexpr const char* no_box2d =
    "the body model box2d needs Box2D, which this banyan was built without; install libbox2d-dev and build again, or "
    "use disks or linear";
#endif

constexpr std::size_t most_stations = 100;

// The keys of one station, one by one and with each other.
void check_station(FaultList& list, const std::string& path, const Station& station) {
  check_keys(list, path, station_keys(), station);
  if (!good_name(station.name))
    list.fail(path + ".name", "is \"" + station.name + "\"; allowed: " + std::string(name_rule));
  else if (station.name.find_first_not_of("0123456789") == std::string::npos)
    list.fail(path + ".name", "is \"" + station.name + "\": numbers are targets; give it a letter");
  if (station.course.empty()) {
    const auto useless = [&](bool given, const char* key) {
      if (given) list.fail(path + "." + key, "needs course_m: without way points the station stands");
    };
    useless(station.speed_m_s > 0.0, "speed_m_s");
    useless(station.loop, "loop");
    useless(!station.times.empty(), "times_s");
    return;
  }
  if (station.times.empty()) {
    if (!(station.speed_m_s > 0.0))
      list.fail(path + ".speed_m_s", "a station with course_m needs speed_m_s above 0, or times_s");
    return;
  }
  if (station.speed_m_s > 0.0 || station.pause_s > 0.0 || station.loop)
    list.fail(path + ".times_s", "give times_s or speed_m_s, pause_s and loop, not both");
  if (station.times.size() != station.course.size())
    list.fail(path + ".times_s", "must have one entry per way point (" + std::to_string(station.course.size()) +
                                     "), not " + std::to_string(station.times.size()));
  for (std::size_t k = 0; k < station.times.size(); ++k)
    if (!(station.times[k] > (k == 0 ? station.start_s : station.times[k - 1])))
      list.fail(element(path + ".times_s", k), "must be later than the one before, and than start_s");
}

void check_station_values(FaultList& list, const Scenario& scenario) {
  const std::vector<Station>& stations = scenario.stations;
  if (stations.size() > most_stations)
    return list.fail("stations", "are " + std::to_string(stations.size()) + "; at most " +
                                     std::to_string(most_stations) + " are possible");
  std::vector<std::string_view> names;
  bool rooted = scenario.swarm.root.has_value();
  for (std::size_t s = 0; s < stations.size(); ++s) {
    const std::string path = element("stations", s);
    check_station(list, path, stations[s]);
    if (std::find(names.begin(), names.end(), stations[s].name) != names.end())
      list.fail(path + ".name", "is \"" + stations[s].name + "\", as another station is called");
    names.push_back(stations[s].name);
    if (stations[s].root && rooted)
      list.fail(path + ".root", "there is one first root: another station is it, or the robot swarm.root");
    rooted = rooted || stations[s].root;
  }
}

// Data flows between stations and targets.
void check_connect(FaultList& list, const Scenario& scenario) {
  std::vector<std::string_view> names;
  for (const Station& station : scenario.stations) names.push_back(station.name);
  const std::size_t targets = mission_targets(scenario).size();
  const auto check = [&](const std::string& key, const std::string& name) {
    if (std::find(names.begin(), names.end(), name) != names.end()) return;
    const bool number = !name.empty() && name.size() < 7 && name.find_first_not_of("0123456789") == std::string::npos;
    if (number && std::stoul(name) < targets && std::to_string(std::stoul(name)) == name) return;
    const std::string_view near = nearest_name(name, names);
    list.fail(key, "there is no station \"" + name + "\"" +
                       (near.empty() ? "" : "; did you mean \"" + std::string(near) + "\"?") +
                       " (stations: " + (names.empty() ? "none" : alternatives(names)) + "; targets: " +
                       (targets == 0 ? "none" : "\"0\" to \"" + std::to_string(targets - 1) + "\"") + ")");
  };
  for (std::size_t i = 0; i < scenario.mission.connect.size(); ++i) {
    const auto& [a, b] = scenario.mission.connect[i];
    const std::string key = element("mission.connect", i);
    check(key, a);
    check(key, b);
    if (a == b) list.fail(key, "names \"" + a + "\" twice");
  }
}

void check_values(FaultList& list, const Scenario& scenario) {
  check_keys(list, "", scenario_keys(), scenario);
  if (scenario.algorithms == nullptr)
    list.fail("mission.algorithm", "the program has given no list of algorithms to choose from");
  else
    for (const auto& [name, value] : scenario.mission.parameters)
      check_parameter(list, *scenario.algorithms, name, value);
  check_layout(list, scenario.swarm);
  if (const auto* listed = std::get_if<std::vector<Vec2>>(&scenario.targets))
    if (!listed->empty() || (scenario.stations.empty() && !scenario.visits.positions))
      list.check_length("targets.positions_m", listed->size(), most("targets.count"));
  if (scenario.visits.positions)
    list.check_length("visits.positions_m", scenario.visits.positions->size(), most("targets.count"));
  if (scenario.battery.places.size() > 100)
    list.fail("battery.places_m",
              "has " + std::to_string(scenario.battery.places.size()) + " places; at most 100 are possible");
  if (scenario.battery.start_spread >= scenario.battery.start_charge)
    list.fail("battery.start_spread", "must be below battery.start_charge, else robots would start empty");
  if (scenario.robot.body == BodyModel::box2d && !has_box2d()) list.fail("robot.body", no_box2d);
  if (!scenario.clocks.asynchronous && scenario.clocks.drift != 0.0)
    list.warn("clocks.drift", "has no effect without clocks.asynchronous");
  if (scenario.radio.sight_leak > 0.0 && !scenario.radio.line_of_sight && !switches_sight_on(scenario))
    list.warn("radio.sight_leak", "has no effect without radio.line_of_sight");
  for (std::size_t i = 0; i < scenario.obstacles.size(); ++i) {
    check_keys(list, element("obstacles", i), obstacle_keys(), scenario.obstacles[i]);
    const Wall* wall = std::get_if<Wall>(&scenario.obstacles[i]);
    if (wall != nullptr && wall->from == wall->to)
      list.fail(element("obstacles", i) + ".to_m", "must differ from the wall's other end");
    if (const auto* map = std::get_if<FloorMap>(&scenario.obstacles[i])) check_map(list, element("obstacles", i), *map);
  }
  check_station_values(list, scenario);
  check_event_values(list, scenario.events);
}

// ---- Round two: how they fit ----

// `missions`: how many targets are the mission's own; places to charge follow.
std::string target_key(const Scenario& scenario, std::size_t missions, std::size_t i) {
  const std::size_t charging = held_charging_places(scenario).size();
  if (i >= missions + charging) {
    std::size_t left = i - missions - charging;
    for (std::size_t s = 0; s < scenario.stations.size(); ++s)
      if (!scenario.stations[s].root && left-- == 0) return element("stations", s) + ".position_m";
  }
  if (i >= missions) {
    const std::vector<Vec2>& places = scenario.battery.places;
    const Vec2 held = held_charging_places(scenario)[i - missions];
    return element("battery.places_m",
                   static_cast<std::size_t>(std::find(places.begin(), places.end(), held) - places.begin()));
  }
  return std::holds_alternative<std::vector<Vec2>>(scenario.targets) ? element("targets.positions_m", i) : "targets";
}

// "; of those here, more are kept by a, b"; nothing if no algorithm is one of these.
template <class Is> std::string of_those_here(const AlgorithmList& algorithms, const char* what, const Is& is) {
  std::string names;
  for (const std::string_view name : algorithms.names())
    if (is(*algorithms.find(name))) names += (names.empty() ? "" : ", ") + std::string(name);
  return names.empty() ? "" : std::string("; of those here, ") + what + " " + names;
}

// What is possible does not depend on how large a robot is or how fast, but on how that compares with its radio and its
// ticks.
void check_proportions(FaultList& list, const Scenario& scenario) {
  const double fewest = widened(least_rounds_per_drive), most = widened(most_rounds_per_drive);
  const double thinnest = widened(least_body_radius), widest = widened(most_body_radius);
  constexpr double rounding = 1e-9;
  const double range = scenario.radio.range_m;
  const double drive = drive_s(scenario);
  const double ticks = drive / scenario.tick_s;
  if (ticks < fewest * (1.0 - rounding) || ticks > most * (1.0 + rounding)) {
    const Range& any_tick = find_key(scenario_keys(), "tick_s")->range;
    const double least_s = std::max(drive / most, any_tick.minimum),
                 most_s = std::min(drive / fewest, any_tick.maximum);
    list.fail("tick_s",
              "a robot drives as far as the radio reaches in radio.range_m / (robot.wheel_limit_m_s * tick_s) = " +
                  short_text(range) + " / (" + short_text(scenario.robot.wheel_limit_m_s) + " * " +
                  short_text(scenario.tick_s) + ") = " + short_text(ticks) + " ticks, which must be 25 to 2000; " +
                  (least_s <= most_s ? "set tick_s to " + short_text(least_s) + " to " + short_text(most_s) + " s"
                                     : "set radio.range_m or robot.wheel_limit_m_s, no tick_s fits these"),
              {"radio.range_m", "robot.wheel_limit_m_s"});
  }
  const double share = scenario.robot.radius_m / range;
  if (share < thinnest * (1.0 - rounding) || share > widest * (1.0 + rounding))
    list.fail("robot.radius_m",
              "is " + short_text(scenario.robot.radius_m) + " m, " + short_text(share) +
                  " of radio.range_m = " + short_text(range) + " m; must be 0.001 to 0.17 of it, here " +
                  short_text(thinnest * range) + " to " + short_text(widest * range) + " m",
              {"radio.range_m"});
}

// mission.time_limit_s, as it is given or as it follows.
void check_time_limit(FaultList& list, const Scenario& scenario) {
  const double limit_s = time_limit_s(scenario);
  if (limit_s >= scenario.tick_s) return;
  const std::string least = "give at least tick_s = " + short_text(scenario.tick_s) + " s";
  if (scenario.mission.time_limit_s > 0.0)
    list.fail("mission.time_limit_s", "is " + short_text(limit_s) + " s, shorter than a tick: " + least +
                                          ", or 0 for ten times a straight drive to the farthest target");
  else if (limit_s > 0.0)
    list.fail("mission.time_limit_s", "is not given, and ten times a straight drive to the farthest target is " +
                                          short_text(limit_s) + " s, shorter than a tick: " + least);
  else
    list.fail("mission.time_limit_s",
              "is not given, and no target is away from swarm.start.center_m, so that no limit follows: " + least);
}

// The keys of the scenario's own parameters that the text names.
std::vector<std::string> parameters_in(const std::string& text, const Scenario& scenario) {
  std::vector<std::string> keys;
  for (const auto& [name, value] : scenario.mission.parameters)
    if (text.find(name) != std::string::npos) keys.push_back("mission.parameters." + name);
  return keys;
}

void check_platform(FaultList& list, const Scenario& scenario) {
  const double reach = scenario.robot.wheel_limit_m_s * scenario.tick_s;
  if (!scenario.obstacles.empty() && reach >= scenario.robot.radius_m)
    list.fail("tick_s", "a robot covers " + short_text(reach) +
                            " m in one tick and could pass through an obstacle;"
                            " tick_s * robot.wheel_limit_m_s must be below robot.radius_m");
  check_time_limit(list, scenario);
  for (std::size_t i = 0; i < scenario.obstacles.size(); ++i)
    check_obstacle_body(list, scenario, element("obstacles", i) + ".size_m", scenario.obstacles[i]);
  if (const std::string text = algorithm_of(scenario).fault(setup_of(scenario)); !text.empty())
    list.fail("mission.parameters", text, parameters_in(text, scenario));
  if (scenario.mission.link_redundancy > 1 && !algorithm_of(scenario).knows_redundancy())
    list.fail("mission.link_redundancy", "is " + std::to_string(scenario.mission.link_redundancy) + ", but " +
                                             scenario.mission.algorithm + " keeps one path" +
                                             of_those_here(*scenario.algorithms, "more are kept by",
                                                           [](const Algorithm& a) { return a.knows_redundancy(); }));
  if (scenario.mission.reading != Mission{}.reading && !algorithm_of(scenario).knows_readings())
    list.warn("mission.reading", "has no effect with " + scenario.mission.algorithm + ", which has one reading" +
                                     of_those_here(*scenario.algorithms, "both readings are known to",
                                                   [](const Algorithm& a) { return a.knows_readings(); }));
}

// Visits every pair nearer than `reach` once, by a sweep along x, until `visit` returns false.
template <class Visit> void each_pair(const std::vector<Vec2>& p, double reach, const Visit& visit) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return p[a].x != p[b].x ? p[a].x < p[b].x : a < b; });
  for (std::size_t a = 0; a < p.size(); ++a) {
    for (std::size_t b = a + 1; b < p.size() && p[order[b]].x - p[order[a]].x < reach; ++b) {
      const std::size_t i = std::min(order[a], order[b]);
      const std::size_t j = std::max(order[a], order[b]);
      const double d = distance(p[i], p[j]);
      if (d < reach && !visit(i, j, d)) return;
    }
  }
}

// Groups of robots, joined link by link.
class Groups {
 public:
  explicit Groups(std::size_t robots) : leader_(robots), count_{robots} {
    std::iota(leader_.begin(), leader_.end(), std::size_t{0});
  }
  void join(std::size_t i, std::size_t j) noexcept {
    const std::size_t left = find(i);
    const std::size_t right = find(j);
    if (left == right) return;
    leader_[right] = left;
    --count_;
  }
  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  [[nodiscard]] bool together(std::size_t i, std::size_t j) noexcept { return find(i) == find(j); }

 private:
  [[nodiscard]] std::size_t find(std::size_t i) noexcept {
    while (leader_[i] != i) i = leader_[i] = leader_[leader_[i]];
    return i;
  }
  std::vector<std::size_t> leader_;
  std::size_t count_;
};

// How far from the start's centre robots may be, or be sent: farther away they would have no numbers for places.
double farthest_m(const Scenario& scenario) { return widened(farthest_target) * scenario.radio.range_m; }

// "500 m from swarm.start.center_m; ..." if that is too far; else nothing.
std::string far_text(const Scenario& scenario, Vec2 p) {
  const double away = distance(scenario.swarm.start.center, p);
  if (away <= farthest_m(scenario)) return {};
  return short_text(away) +
         " m from swarm.start.center_m, farther than 200 * radio.range_m = " + short_text(farthest_m(scenario)) +
         " m; bring it nearer, or set a longer range";
}

struct Breadth {
  double from, to;  // along x
};

// Each point's distance to the nearest obstacle, `reach` if none is nearer than that, none above 0 inside one. By a
// sweep along x: of thousands of points and thousands of obstacles, all pairs would be too many.
std::vector<double> rooms(const std::vector<Obstacle>& obstacles, const std::vector<Vec2>& points, double reach) {
  std::vector<double> room(points.size(), reach);
  if (obstacles.empty()) return room;
  const double margin = reach * (1.0 + 1e-9);  // an end may be rounded
  std::vector<Breadth> breadth(obstacles.size());
  for (std::size_t k = 0; k < obstacles.size(); ++k) {
    const Disc disc = enclosing(obstacles[k]);  // however it is turned
    breadth[k] = {disc.center.x - disc.radius_m, disc.center.x + disc.radius_m};
    breadth[k].from -= margin + 1e-9 * std::abs(breadth[k].from);
    breadth[k].to += margin + 1e-9 * std::abs(breadth[k].to);
  }
  std::vector<std::size_t> order(points.size()), coming(obstacles.size()), near;
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::iota(coming.begin(), coming.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return points[a].x < points[b].x; });
  std::sort(coming.begin(), coming.end(),
            [&](std::size_t a, std::size_t b) { return breadth[a].from < breadth[b].from; });
  auto next = coming.begin();
  for (const std::size_t i : order) {
    const Vec2 p = points[i];
    for (; next != coming.end() && breadth[*next].from <= p.x; ++next) near.push_back(*next);
    std::erase_if(near, [&](std::size_t k) { return breadth[k].to < p.x; });
    for (auto k = near.begin(); k != near.end() && room[i] > 0.0; ++k)  // inside one is enough
      room[i] = std::min(room[i], clearance(obstacles[*k], p));
  }
  return room;
}

// Overlaps and connected components of a list start.
void check_listed_cluster(FaultList& list, const Scenario& scenario) {
  const std::vector<Vec2>& p = scenario.swarm.start.positions;
  const double range = scenario.radio.range_m;
  const double touch = 2.0 * scenario.robot.radius_m;
  constexpr int most_overlaps = 100;  // as many as anybody reads; where all overlap, pairs are too many to look at
  int overlaps = 0;
  Groups groups(p.size());
  each_pair(p, std::max(range, touch), [&](std::size_t i, std::size_t j, double d) {
    if (d < touch) {
      ++overlaps;
      list.fail(element("swarm.start.positions_m", j), "overlaps position " + std::to_string(i) + ": " + short_text(d) +
                                                           " m apart, two radii are " + short_text(touch) + " m");
    }
    if (d < range) groups.join(i, j);
    return overlaps < most_overlaps;
  });
  if (overlaps < most_overlaps && groups.count() > 1)
    list.fail("swarm.start.positions_m", "the start is not connected: " + std::to_string(groups.count()) +
                                             " groups are farther than radio.range_m = " + short_text(range) +
                                             " m from each other");
  for (std::size_t i = 0; i < p.size(); ++i)
    if (const std::string text = far_text(scenario, p[i]); !text.empty())
      list.fail(element("swarm.start.positions_m", i), "is " + text);
  const std::vector<double> room = rooms(scenario.obstacles, p, scenario.robot.radius_m);
  for (std::size_t i = 0; i < p.size(); ++i)
    if (room[i] < scenario.robot.radius_m)
      list.fail(element("swarm.start.positions_m", i),
                "a robot at " + at(p[i]) + " touches an obstacle" +
                    free_place_text(list, scenario.obstacles, p[i], scenario.robot.radius_m));
}

// Neighbours of the layout have room beside each other and are linked.
void check_spacing(FaultList& list, const Scenario& scenario) {
  const Start& start = scenario.swarm.start;
  const bool random = start.layout == Layout::random;
  const std::string key = start.pitch_share ? "swarm.start.pitch_share" : "swarm.start.pitch_m";
  const std::string jitter = random ? "" : " 2 jitter_m";
  const double off = random ? 0.0 : 2.0 * start_jitter_m(scenario);
  const double range = scenario.radio.range_m;
  const double touch = 2.0 * scenario.robot.radius_m;
  const double pitch = start_pitch_m(scenario);
  const double link = start.link_share * range;
  if (pitch - off < touch)
    list.fail(key,
              "robots do not fit: " + (random ? "the pitch" : "pitch_m -" + jitter) + " = " + short_text(pitch - off) +
                  " m must be at least two radii, " + short_text(touch) + " m",
              {"robot.radius_m"});
  if (!random && pitch + off >= range)
    list.fail(key,
              "the start would not be connected: pitch_m +" + jitter + " = " + short_text(pitch + off) +
                  " m must be below radio.range_m = " + short_text(range) + " m",
              {"radio.range_m"});
  if (!random && start.layout != Layout::bridge) return;
  if (link + off >= range)
    list.fail("swarm.start.link_share", "the start would not be connected: link_share * range_m" +
                                            (random ? "" : " +" + jitter) + " = " + short_text(link + off) +
                                            " m must be below radio.range_m = " + short_text(range) + " m");
  if (link < pitch)
    list.fail("swarm.start.link_share", "link_share * range_m = " + short_text(link) +
                                            " m must be at least the distance between neighbours, " +
                                            short_text(pitch) + " m");
}

// Obstacles must not cut into the start, nor may it reach too far.
void check_placed(FaultList& list, const Scenario& scenario) {
  const Start& start = scenario.swarm.start;
  const std::vector<Vec2> p = place(scenario).position;
  if (p.empty() && start.layout != Layout::ring && start.layout != Layout::bridge)
    return list.fail("swarm.start.center_m", "there is no room for a robot at " + at(start.center) +
                                                 ": an obstacle is closer than robot.radius_m" +
                                                 (start.layout == Layout::random ? "" : " + swarm.start.jitter_m") +
                                                 free_place_text(list, scenario.obstacles, start.center,
                                                                 scenario.robot.radius_m + start_jitter_m(scenario)));
  if (p.size() < free_robot_count(scenario))
    return list.fail("swarm.start", "only " + std::to_string(p.size()) + " of " +
                                        std::to_string(free_robot_count(scenario)) +
                                        " robots fit between the obstacles around the start");
  for (const Vec2 q : p)
    if (const std::string text = far_text(scenario, q); !text.empty())
      return list.fail("swarm.start", "reaches to " + at(q) + ", " + text);
  if (scenario.obstacles.empty() || (start.layout != Layout::ring && start.layout != Layout::bridge)) return;
  Groups groups(p.size());
  each_pair(p, scenario.radio.range_m, [&](std::size_t i, std::size_t j, double /*distance*/) {
    const auto cuts = [&](const Obstacle& o) { return blocks(o, p[i], p[j]); };
    if (std::none_of(scenario.obstacles.begin(), scenario.obstacles.end(), cuts)) groups.join(i, j);
    return true;
  });
  if (groups.count() > 1)
    list.fail("swarm.start",
              "the start is not connected: obstacles cut it into " + std::to_string(groups.count()) + " groups");
}

// A start given by a layout.
void check_laid_out(FaultList& list, const Scenario& scenario) {
  const Start& start = scenario.swarm.start;
  check_spacing(list, scenario);
  const std::size_t robots = free_robot_count(scenario);
  if (start.layout == Layout::bridge && start.bridge_robots + 2 > robots)
    list.fail("swarm.start.bridge_robots", "is " + std::to_string(start.bridge_robots) + " of " +
                                               std::to_string(robots) +
                                               " robots; at least one must be left for each cluster");
  const bool compact = start.layout == Layout::hexagonal || start.layout == Layout::grid;
  const bool small = start_pitch_m(scenario) * std::sqrt(static_cast<double>(robots)) < farthest_m(scenario);
  if (!list.failed() && !(compact && small && scenario.obstacles.empty())) check_placed(list, scenario);
}

// Where a station goes: within reach, and not through obstacles.
void check_courses(FaultList& list, const Scenario& scenario) {
  const double radius = scenario.robot.radius_m;
  for (std::size_t s = 0; s < scenario.stations.size(); ++s) {
    const Station& station = scenario.stations[s];
    const std::string path = element("stations", s);
    const auto check = [&](const std::string& key, Vec2 p) {
      if (const std::string text = far_text(scenario, p); !text.empty())
        list.fail(key, station.name + " at " + at(p) + " is " + text);
      if (clearance(scenario.obstacles, p) < radius)
        list.fail(key, station.name + " at " + at(p) +
                           " is nearer to an obstacle than robot.radius_m = " + short_text(radius) + " m");
    };
    check(path + ".position_m", station.position);
    Vec2 from = station.position;
    for (std::size_t k = 0; k < station.course.size() + (station.loop ? 1 : 0); ++k) {
      const bool back = k == station.course.size();
      const Vec2 to = back ? station.position : station.course[k];
      const std::string key = back ? path + ".loop" : element(path + ".course_m", k);
      if (!back) check(key, to);
      for (std::size_t o = 0; o < scenario.obstacles.size(); ++o)
        if (blocks(scenario.obstacles[o], from, to))
          list.fail(key, "the way from " + at(from) + " to " + at(to) + " leads through obstacle " + std::to_string(o));
      from = to;
    }
  }
}

// Where it starts: in contact with the others.
void check_stations_fit(FaultList& list, const Scenario& scenario) {
  check_courses(list, scenario);
  if (list.failed() || scenario.stations.empty()) return;
  const double range = scenario.radio.range_m;
  std::vector<Vec2> points = place(scenario).position;
  const std::size_t robots = points.size();
  for (const Station& station : scenario.stations) points.push_back(station.position);
  Groups groups(points.size());
  const double touch = 2.0 * scenario.robot.radius_m;
  each_pair(points, std::max(range, touch), [&](std::size_t i, std::size_t j, double apart) {
    if (j >= robots && apart < touch)
      list.fail(element("stations", j - robots) + ".position_m",
                scenario.stations[j - robots].name + " at " + at(points[j]) + " is " + short_text(apart) +
                    " m from a robot or another station; bodies need two radii, " + short_text(touch) + " m");
    if (apart >= range) return true;
    const auto cuts = [&](const Obstacle& o) { return blocks(o, points[i], points[j]); };
    const bool hidden =
        scenario.radio.line_of_sight && std::any_of(scenario.obstacles.begin(), scenario.obstacles.end(), cuts);
    if ((i < robots && j < robots) || !hidden) groups.join(i, j);
    return true;
  });
  for (std::size_t s = 0; s < scenario.stations.size(); ++s)
    if (!groups.together(0, robots + s))
      list.fail(element("stations", s) + ".position_m",
                scenario.stations[s].name + " at " + at(scenario.stations[s].position) +
                    " is not in contact with the start: neither a robot nor a station that is lies within "
                    "radio.range_m = " +
                    short_text(range) + " m" + (scenario.radio.line_of_sight ? " and in sight" : ""),
                {"radio.range_m"});
}

void check_swarm_fits(FaultList& list, const Scenario& scenario) {
  const std::size_t robots = free_robot_count(scenario);
  if (robots > most("swarm.robots")) {
    list.fail("swarm.redundancy", "asks for " + std::to_string(robots) + " robots; at most " +
                                      std::to_string(most("swarm.robots")) + " are possible");
    return;
  }
  if (place_count(scenario) > most("swarm.robots")) {
    list.fail("swarm.robots", "with the stations and the robots that join there are " +
                                  std::to_string(place_count(scenario)) + "; at most " +
                                  std::to_string(most("swarm.robots")) + " are possible");
    return;
  }
  if (scenario.swarm.root && *scenario.swarm.root >= robots)
    list.fail("swarm.root", "there is no robot " + std::to_string(*scenario.swarm.root) + "; the last one is " +
                                std::to_string(robots - 1));
  if (scenario.swarm.start.layout == Layout::list) check_listed_cluster(list, scenario);
  else check_laid_out(list, scenario);
}

void check_targets_fit(FaultList& list, const Scenario& scenario) {
  const std::vector<Vec2> targets = target_positions(scenario);
  const std::size_t robots = free_robot_count(scenario);
  const std::size_t missions = mission_targets(scenario).size();
  const std::vector<double> room = rooms(scenario.obstacles, targets, scenario.robot.radius_m);
  for (std::size_t i = 0; i < targets.size(); ++i)
    check_target_room(list, scenario, scenario.obstacles, room[i], target_key(scenario, missions, i),
                      "target " + std::to_string(i), targets[i]);
  const std::vector<Vec2> visits = scenario.visits.places();
  const std::vector<double> around = rooms(scenario.obstacles, visits, scenario.robot.radius_m);
  const auto visit_key = [](std::size_t i) { return element("visits.positions_m", i); };
  for (std::size_t i = 0; i < visits.size(); ++i)
    check_target_room(list, scenario, scenario.obstacles, around[i], visit_key(i), "place " + std::to_string(i),
                      visits[i]);
  if (!list.failed()) {
    std::vector<Vec2> places = targets;
    places.insert(places.end(), visits.begin(), visits.end());
    check_ways(list, scenario, places, [&](std::size_t i) {
      return i < targets.size() ? target_key(scenario, missions, i) : visit_key(i - targets.size());
    });
  }
  if (!check_events_fit(list, scenario, targets.size(), robots)) return;
  const std::size_t needed = least_robots(targets, target_tolerance_m(scenario), scenario.radio.range_m);
  if (needed > robot_count(scenario))
    list.warn("targets", "out of reach: no connected network of fewer than " + std::to_string(needed) +
                             " robots spans the targets at radio.range_m = " + short_text(scenario.radio.range_m) +
                             " m, and there are " + std::to_string(robot_count(scenario)));
}

}  // namespace

void check_event_values(FaultList& list, const std::vector<Event>& events) {
  for (std::size_t i = 0; i < events.size(); ++i) {
    const std::string path = element("events", i);
    check_keys(list, path, event_keys(), events[i]);
    const Blackout* blackout = std::get_if<Blackout>(&events[i].action);
    if (blackout != nullptr && blackout->duration_s == 0.0)
      list.fail(path + ".duration_s", "must be above 0 for a blackout");
  }
}

void check_obstacle_body(FaultList& list, const Scenario& scenario, const std::string& key, const Obstacle& obstacle) {
  const Box* box = std::get_if<Box>(&obstacle);
  if (box == nullptr || scenario.robot.body != BodyModel::box2d) return;
  const double least_m = least_side_in_box2d_m(*box);
  if (std::min(box->size.x, box->size.y) < least_m)
    list.fail(key, "the box is too thin for robot.body = \"box2d\": at " + at(box->center) +
                       " both sides must be at least " + short_text(least_m) + " m; a wall has no thickness");
}

void check_target_room(FaultList& list, const Scenario& scenario, std::span<const Obstacle> obstacles, double room,
                       const std::string& key, const std::string& name, Vec2 p) {
  const auto elsewhere = [&] { return free_place_text(list, obstacles, p, scenario.robot.radius_m); };
  if (const std::string text = far_text(scenario, p); !text.empty())
    list.fail(key, name + " at " + at(p) + " is " + text);
  if (room <= 0.0) {
    list.fail(key, name + " at " + at(p) + " lies inside an obstacle" + elsewhere());
  } else if (room + target_tolerance_m(scenario) < scenario.robot.radius_m) {
    list.fail(key, name + " at " + at(p) + " is so close to an obstacle that no robot of radius " +
                       short_text(scenario.robot.radius_m) + " m gets within mission.target_tolerance_m of it" +
                       elsewhere());
  }
}

std::vector<Fault> faults(const Scenario& scenario) {
  FaultList list;
  check_values(list, scenario);
  if (!list.failed()) check_proportions(list, scenario);
  if (!list.failed()) check_platform(list, scenario);
  if (!list.failed()) {
    check_swarm_fits(list, scenario);
    check_stations_fit(list, scenario);
    check_connect(list, scenario);
    check_targets_fit(list, scenario);
  }
  return list.take();
}

}  // namespace banyan::world
