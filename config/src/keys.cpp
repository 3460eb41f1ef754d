// SPDX-License-Identifier: MIT
#include "banyan/config/keys.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "banyan/config/document.hpp"
#include "banyan/controller/core/algorithm.hpp"

namespace banyan::config {
namespace {

using world::Vec2;
using Names = std::span<const std::string_view>;

constexpr std::string_view layout_names[] = {"hexagonal", "grid", "list"};
constexpr std::string_view body_names[] = {"disks", "box2d", "linear"};
constexpr std::string_view target_layout_names[] = {"list", "ring", "random"};
constexpr std::string_view obstacle_names[] = {"disc", "box", "wall"};
constexpr std::string_view event_names[] = {"die",        "freeze", "set_loss", "move_target",
                                            "add_target", "kill",   "blackout", "remove_target",
                                            "set_line_of_sight", "move_obstacle"};
constexpr std::string_view when_names[] = {"time", "half-way", "complete"};
constexpr std::string_view of_names[] = {"robots", "connectors", "root", "worker", "worker_and_parent"};
constexpr std::string_view reading_names[] = {"corrected", "literal"};

Names algorithm_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list;
    for (const Algorithm* algorithm : algorithms()) list.push_back(algorithm->name());
    return list;
  }();
  return names;
}

std::size_t index_of(Names names, std::string_view name) {
  return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

constexpr double far_away = 1e4;  // m, the size of a world
constexpr double most_robots = nobody;
constexpr Range anywhere{-far_away, far_away};
constexpr Range share{0.0, 1.0};
// Seeds stay below 2^53, so that every reader of JSON, the viewer among them, sees them exactly.
constexpr Range seeds{0.0, 9007199254740992.0};
constexpr Range any_angle{-360.0, 360.0};

// clang-format off: a row per key is easier to read
constexpr Section section_list[] = {
    {"", "The world as a whole."},
    {"mission", "What the swarm is to do, and by which algorithm."},
    {"mission.parameters",
     "Overrides of the algorithm's parameters, the paper's Table I among them. `banyan algorithms` lists their "
     "defaults, which depend on algorithm and reading."},
    {"swarm", "How many robots. Give `robots` or `redundancy`, not both."},
    {"swarm.start", "Where the robots begin: a compact connected cluster.", "layout"},
    {"robot", "One robot's body and wheels. The defaults are a Khepera IV."},
    {"radio", "Who hears whom, and how well."},
    {"clocks", "When robots step: all together, or each by its own clock."},
    {"targets", "Where the workers have to go.", "layout"},
    {"obstacles",
     "An obstacle each: `[[obstacles]]` as often as needed. They block motion and, with "
     "`radio.line_of_sight`, the radio. Robots see them only within `robot.proximity_m`.",
     "kind"},
    {"events", "What happens to the world at a given time or moment of the mission: `[[events]]` as often as needed.",
     "kind"},
    {"output", "What `banyan run` keeps. It never changes what happens."},
};

constexpr Key<Form> scenario_list[] = {
    {"",
     "name",
     "",
     {},
     "names the run and its output directory; letters, digits, '-', '_' and '.'",
     [](Form& f) -> std::string& { return f.configuration.scenario.name; },
     "",
     false,
     "the file's name"},
    {"",
     "description",
     "",
     {},
     "what this world is about, for readers",
     [](Form& f) -> std::string& { return f.configuration.scenario.description; }},
    {"",
     "tick_s",
     "s",
     {0.0, 1.0, true},
     "length of a tick; robots broadcast, decide and move once a tick",
     [](Form& f) -> double& { return f.configuration.scenario.tick_s; }},
    {"", "seed", "", seeds, "decides everything random; the same seed gives the same run",
     SeedAccess<Form>{[](Form& f) -> std::uint64_t& { return f.configuration.scenario.seed; }}},

    {"mission",
     "algorithm",
     "",
     {},
     "how the tree grows",
     ChoiceAccess<Form>{
         algorithm_names,
         [](const Form& f) { return index_of(algorithm_names(), f.configuration.scenario.mission.algorithm); },
         [](Form& f, std::size_t i) { f.configuration.scenario.mission.algorithm = algorithm_names()[i]; }}},
    {"mission",
     "reading",
     "",
     {},
     "the paper as printed (literal), or with its gaps closed (corrected)",
     ChoiceAccess<Form>{[]() -> Names { return reading_names; },
                        [](const Form& f) { return index_of(reading_names, f.configuration.scenario.mission.reading); },
                        [](Form& f, std::size_t i) { f.configuration.scenario.mission.reading = reading_names[i]; }}},
    {"mission",
     "scale",
     "",
     {0.0, 1000.0, true},
     "factor on Table I's lengths S, A, delta, E and J (paper Sec. IV-C)",
     [](Form& f) -> double& { return f.configuration.scenario.mission.scale; }},
    {"mission",
     "target_tolerance_m",
     "m",
     {0.0, far_away, true},
     "a target is reached when its worker is this near",
     [](Form& f) -> double& { return f.configuration.scenario.mission.target_tolerance_m; }},
    {"mission",
     "time_limit_s",
     "s",
     {0.0, 1e7},
     "the run ends then; 0: ten times a straight drive to the farthest target",
     [](Form& f) -> double& { return f.configuration.scenario.mission.time_limit_s; }},
    {"mission",
     "stop_when_complete",
     "",
     {},
     "end the run as soon as all targets are reached at once",
     [](Form& f) -> bool& { return f.configuration.scenario.mission.stop_when_complete; }},
    {"mission",
     "settle_s",
     "s",
     {0.0, 1e7},
     "with stop_when_complete: go on this long after completion, so that the tree can settle",
     [](Form& f) -> double& { return f.configuration.scenario.mission.settle_s; }},

    {"swarm",
     "robots",
     "",
     {2.0, most_robots},
     "number of robots",
     [](Form& f) -> std::size_t& { return f.configuration.scenario.swarm.robots; },
     "",
     false,
     "from redundancy, or the length of start.positions_m"},
    {"swarm",
     "redundancy",
     "",
     {0.0, 1000.0, true},
     "the paper's k: ceil(k * sum of target distances / 1.540841 m) robots",
     [](Form& f) -> double& { return f.configuration.scenario.swarm.redundancy; }},
    {"swarm",
     "root",
     "",
     {0.0, most_robots - 1},
     "index of the first root, counted from 0 at the centre of the start",
     [](Form& f) -> std::optional<std::size_t>& { return f.configuration.scenario.swarm.root; },
     "",
     false,
     "a random robot that is no worker"},

    {"swarm.start",
     "layout",
     "",
     {},
     "hexagonal or square lattice, or a list of positions",
     ChoiceAccess<Form>{
         []() -> Names { return layout_names; },
         [](const Form& f) { return static_cast<std::size_t>(f.configuration.scenario.swarm.start.layout); },
         [](Form& f, std::size_t i) { f.configuration.scenario.swarm.start.layout = static_cast<world::Layout>(i); }}},
    {"swarm.start", "center_m", "m", anywhere, "centre of the cluster",
     [](Form& f) -> Vec2& { return f.configuration.scenario.swarm.start.center; }},
    {"swarm.start",
     "pitch_m",
     "m",
     {0.0, 1000.0, true},
     "distance between neighbours of the lattice",
     [](Form& f) -> double& { return f.configuration.scenario.swarm.start.pitch_m; },
     "hexagonal grid"},
    {"swarm.start",
     "jitter_m",
     "m",
     {0.0, 1000.0},
     "each robot is off its lattice point by up to this",
     [](Form& f) -> double& { return f.configuration.scenario.swarm.start.jitter_m; },
     "hexagonal grid"},
    {"swarm.start", "positions_m", "m", anywhere, "one [x, y] per robot",
     [](Form& f) -> std::vector<Vec2>& { return f.configuration.scenario.swarm.start.positions; }, "list", true},
    {"swarm.start", "headings_deg", "deg", any_angle, "one angle per robot, counter-clockwise from the x axis",
     [](Form& f) -> std::vector<double>& { return f.configuration.scenario.swarm.start.headings_rad; }, "list", false,
     "random"},

    {"robot",
     "body",
     "",
     {},
     "disks: wheels and contacts, fast; box2d: with mass and force limits; linear: the "
     "paper's point masses, holonomic",
     ChoiceAccess<Form>{
         []() -> Names { return body_names; },
         [](const Form& f) { return static_cast<std::size_t>(f.configuration.scenario.robot.body); },
         [](Form& f, std::size_t i) { f.configuration.scenario.robot.body = static_cast<world::BodyModel>(i); }}},
    {"robot",
     "radius_m",
     "m",
     {0.0, 100.0, true},
     "radius of the body",
     [](Form& f) -> double& { return f.configuration.scenario.robot.radius_m; }},
    {"robot",
     "wheel_distance_m",
     "m",
     {0.0, 2.0, true},
     "distance between the wheels",
     [](Form& f) -> double& { return f.configuration.scenario.robot.wheel_distance_m; }},
    {"robot",
     "wheel_limit_m_s",
     "m/s",
     {0.0, 10.0, true},
     "largest speed of a wheel",
     [](Form& f) -> double& { return f.configuration.scenario.robot.wheel_limit_m_s; }},
    {"robot", "wheel_noise", "", share, "sigma of the factor on each wheel's speed, drawn every tick",
     [](Form& f) -> double& { return f.configuration.scenario.robot.wheel_noise; }},
    {"robot", "wheel_bias", "", share, "sigma of a factor on each wheel's speed, drawn once",
     [](Form& f) -> double& { return f.configuration.scenario.robot.wheel_bias; }},
    {"robot", "odometry_noise", "", share, "sigma of the factor on each odometry reading",
     [](Form& f) -> double& { return f.configuration.scenario.robot.odometry_noise; }},
    {"robot",
     "mass_kg",
     "kg",
     {0.0, 1e4, true},
     "mass (body box2d)",
     [](Form& f) -> double& { return f.configuration.scenario.robot.mass_kg; }},
    {"robot",
     "max_force_n",
     "N",
     {0.0, 1e6, true},
     "largest force of the wheels (body box2d)",
     [](Form& f) -> double& { return f.configuration.scenario.robot.max_force_n; }},
    {"robot",
     "max_torque_nm",
     "N m",
     {0.0, 1e6, true},
     "largest torque of the wheels (body box2d)",
     [](Form& f) -> double& { return f.configuration.scenario.robot.max_torque_nm; }},
    {"robot",
     "max_acceleration_m_s2",
     "m/s^2",
     {0.0, 1e4, true},
     "bound on the acceleration |u| (body linear)",
     [](Form& f) -> double& { return f.configuration.scenario.robot.max_acceleration_m_s2; }},
    {"robot",
     "dead_bodies",
     "",
     {},
     "the dead stay where they are and block motion and sight; false: they vanish",
     [](Form& f) -> bool& { return f.configuration.scenario.robot.dead_bodies; }},
    {"robot",
     "proximity_m",
     "m",
     {0.0, 100.0},
     "reach of the proximity sensor, from the robot's centre to the surface of obstacles and dead bodies; 0: none",
     [](Form& f) -> double& { return f.configuration.scenario.robot.proximity_m; }},

    {"radio",
     "range_m",
     "m",
     {0.0, 100.0, true},
     "C: two robots nearer than this hear each other",
     [](Form& f) -> double& { return f.configuration.scenario.radio.range_m; }},
    {"radio",
     "line_of_sight",
     "",
     {},
     "robots and obstacles in between block a packet",
     [](Form& f) -> bool& { return f.configuration.scenario.radio.line_of_sight; }},
    {"radio", "loss", "", share, "probability that a packet does not arrive, per packet and receiver",
     [](Form& f) -> double& { return f.configuration.scenario.radio.loss; }},
    {"radio",
     "range_noise_m",
     "m",
     {0.0, 1000.0},
     "sigma of the measured range",
     [](Form& f) -> double& { return f.configuration.scenario.radio.range_noise_m; }},
    {"radio",
     "bearing_noise_deg",
     "deg",
     {0.0, 180.0},
     "sigma of the measured bearing",
     [](Form& f) -> double& { return f.configuration.scenario.radio.bearing_noise_rad; }},
    {"radio",
     "latency_ticks",
     "ticks",
     {1.0, 100.0},
     "a message is heard so many ticks after it was sent",
     [](Form& f) -> int& { return f.configuration.scenario.radio.latency_ticks; }},
    {"radio",
     "slots",
     "",
     {0.0, 65535.0},
     "packets a robot can receive in one tick; 0: no limit",
     [](Form& f) -> int& { return f.configuration.scenario.radio.slots; }},

    {"clocks",
     "asynchronous",
     "",
     {},
     "each robot steps at its own moments, not all of them at the begin of every tick",
     [](Form& f) -> bool& { return f.configuration.scenario.clocks.asynchronous; }},
    {"clocks",
     "drift",
     "",
     {0.0, 0.5},
     "each clock's rate is 1 + uniform(-drift, drift), drawn once",
     [](Form& f) -> double& { return f.configuration.scenario.clocks.drift; }},
    {"clocks",
     "substeps",
     "",
     {2.0, 100.0},
     "parts of a tick after each of which bodies move and packets fly (asynchronous)",
     [](Form& f) -> int& { return f.configuration.scenario.clocks.substeps; }},

    {"targets",
     "layout",
     "",
     {},
     "a list of positions, equal angles on a circle, or random in an annulus",
     ChoiceAccess<Form>{[]() -> Names { return target_layout_names; }, [](const Form& f) { return f.targets_layout; },
                        [](Form& f, std::size_t i) { f.targets_layout = i; }}},
    {"targets", "positions_m", "m", anywhere, "one [x, y] per target",
     [](Form& f) -> std::vector<Vec2>& { return f.target_positions; }, "list", true},
    {"targets",
     "count",
     "",
     {1.0, 10000.0},
     "number of targets",
     [](Form& f) -> std::size_t& { return f.target_count; },
     "ring random"},
    {"targets",
     "radius_m",
     "m",
     {0.0, far_away},
     "distance of the targets from the centre; the largest one if random",
     [](Form& f) -> double& { return f.target_radius_m; },
     "ring random"},
    {"targets", "phase_deg", "deg", any_angle, "direction of the first target, counter-clockwise from the x axis",
     [](Form& f) -> double& { return f.target_phase_rad; }, "ring"},
    {"targets", "center_m", "m", anywhere, "centre of the circle or annulus",
     [](Form& f) -> Vec2& { return f.target_center; }, "ring random"},
};

// Of the recording; they follow its switch.
constexpr Key<Form> recording_list[] = {
    {"output",
     "record_every",
     "ticks",
     {1.0, 1e6},
     "record the robots every so many ticks; metrics at every tick",
     [](Form& f) -> std::uint32_t& { return f.configuration.output.record_every; }},
    {"output",
     "messages",
     "",
     {},
     "record what each robot broadcast, beside where it was",
     [](Form& f) -> bool& { return f.configuration.output.messages; }},
};

template <std::size_t format> bool& wanted(Form& form) { return form.configuration.output.wanted[format]; }

// A switch for each format of record/'s table that has a key. Keys refer to texts: both are made once.
template <std::size_t... format> std::vector<Key<Form>> with_outputs(std::index_sequence<format...>) {
  static std::array<std::string, sizeof...(format)> meanings;
  std::vector<Key<Form>> keys(std::begin(scenario_list), std::end(scenario_list));
  const auto add = [&](const record::OutputFormat& of, std::string& meaning, bool& (*access)(Form&)) {
    if (of.key.empty()) return;
    meaning = "write " + std::string(of.file) + ", " + std::string(of.what);
    keys.push_back({"output", of.key, "", {}, meaning, access});
    if (of.key == "record") keys.insert(keys.end(), std::begin(recording_list), std::end(recording_list));
  };
  (add(record::output_formats[format], meanings[format], wanted<format>), ...);
  return keys;
}

constexpr Key<ObstacleForm> obstacle_list[] = {
    {"obstacles",
     "kind",
     "",
     {},
     "shape of the obstacle",
     ChoiceAccess<ObstacleForm>{[]() -> Names { return obstacle_names; }, [](const ObstacleForm& o) { return o.kind; },
                                [](ObstacleForm& o, std::size_t i) { o.kind = i; }},
     "",
     true},
    {"obstacles", "center_m", "m", anywhere, "centre", [](ObstacleForm& o) -> Vec2& { return o.center; }, "disc box",
     true},
    {"obstacles",
     "radius_m",
     "m",
     {0.0, far_away, true},
     "radius",
     [](ObstacleForm& o) -> double& { return o.radius_m; },
     "disc",
     true},
    {"obstacles",
     "size_m",
     "m",
     {0.0, far_away, true},
     "length and width",
     [](ObstacleForm& o) -> Vec2& { return o.size; },
     "box",
     true},
    {"obstacles", "angle_deg", "deg", any_angle, "direction of the length, counter-clockwise from the x axis",
     [](ObstacleForm& o) -> double& { return o.angle_rad; }, "box"},
    {"obstacles", "from_m", "m", anywhere, "one end", [](ObstacleForm& o) -> Vec2& { return o.from; }, "wall", true},
    {"obstacles", "to_m", "m", anywhere, "the other end", [](ObstacleForm& o) -> Vec2& { return o.to; }, "wall", true},
};

constexpr Key<EventForm> event_list[] = {
    {"events",
     "time_s",
     "s",
     {0.0, 1e7},
     "when: so long after what `when` says",
     [](EventForm& e) -> double& { return e.time_s; },
     "",
     true},
    {"events",
     "when",
     "",
     {},
     "what time_s counts from: time, the start; half-way, the workers' remaining distances have fallen to half; "
     "complete, all targets are held at once for the first time. An event whose moment never comes never happens",
     ChoiceAccess<EventForm>{[]() -> Names { return when_names; }, [](const EventForm& e) { return e.when; },
                             [](EventForm& e, std::size_t i) { e.when = i; }},
     "",
     false,
     "time"},
    {"events",
     "kind",
     "",
     {},
     "what happens",
     ChoiceAccess<EventForm>{[]() -> Names { return event_names; }, [](const EventForm& e) { return e.kind; },
                             [](EventForm& e, std::size_t i) { e.kind = i; }},
     "",
     true},
    {"events",
     "robot",
     "",
     {0.0, most_robots - 1},
     "index of the robot, counted from 0",
     [](EventForm& e) -> std::size_t& { return e.robot; },
     "die freeze",
     true},
    {"events",
     "duration_s",
     "s",
     {0.0, 1e7},
     "how long it stands still (freeze; 0: for good) or nobody hears anything (blackout)",
     [](EventForm& e) -> double& { return e.duration_s; },
     "freeze blackout"},
    {"events", "loss", "", share, "the new radio.loss", [](EventForm& e) -> double& { return e.loss; }, "set_loss",
     true},
    {"events", "line_of_sight", "", {}, "the new radio.line_of_sight; the robots are told",
     [](EventForm& e) -> bool& { return e.line_of_sight; }, "set_line_of_sight", true},
    {"events",
     "target",
     "",
     {0.0, 1e5},
     "index of the target, counted from 0",
     [](EventForm& e) -> std::size_t& { return e.target; },
     "move_target remove_target",
     true},
    {"events",
     "obstacle",
     "",
     {0.0, 1e6},
     "index of the obstacle, counted from 0",
     [](EventForm& e) -> std::size_t& { return e.obstacle; },
     "move_obstacle",
     true},
    {"events", "position_m", "m", anywhere,
     "where the target is from then on, or drives to; where the centre of the obstacle is, of a wall its middle",
     [](EventForm& e) -> Vec2& { return e.position; }, "move_target add_target move_obstacle", true},
    {"events",
     "speed_m_s",
     "m/s",
     {0.0, 100.0},
     "the target drives there in a straight line; 0: it jumps",
     [](EventForm& e) -> double& { return e.speed_m_s; },
     "move_target",
     false,
     "0"},
    {"events",
     "of",
     "",
     {},
     "whom the dead are drawn from: the living, by the role they broadcast when it acts; worker_and_parent: a worker "
     "and its parent in the tree",
     ChoiceAccess<EventForm>{[]() -> Names { return of_names; }, [](const EventForm& e) { return e.of; },
                             [](EventForm& e, std::size_t i) { e.of = i; }},
     "kill",
     false,
     "robots"},
    {"events", "share", "", share, "how many die: so much of those they are drawn from when it begins, rounded",
     [](EventForm& e) -> std::optional<double>& { return e.share; }, "kill", false, "count counts"},
    {"events",
     "count",
     "",
     {1.0, most_robots},
     "how many die; not beside share",
     [](EventForm& e) -> std::optional<std::size_t>& { return e.count; },
     "kill",
     false,
     "1"},
    {"events",
     "every_s",
     "s",
     {0.0, 1e7},
     "they die one by one, so far apart; 0: all at once",
     [](EventForm& e) -> double& { return e.every_s; },
     "kill",
     false,
     "0"},
};

// clang-format on

struct ToObstacleForm {
  ObstacleForm operator()(const world::Disc& d) const {
    return {.kind = 0, .center = d.center, .radius_m = d.radius_m};
  }
  ObstacleForm operator()(const world::Box& b) const {
    return {.kind = 1, .center = b.center, .size = b.size, .angle_rad = b.angle_rad};
  }
  ObstacleForm operator()(const world::Wall& w) const { return {.kind = 2, .from = w.from, .to = w.to}; }
};

world::Obstacle to_obstacle(const ObstacleForm& o) {
  switch (o.kind) {
    case 0:
      return world::Disc{o.center, o.radius_m};
    case 1:
      return world::Box{o.center, o.size, o.angle_rad};
    default:
      return world::Wall{o.from, o.to};
  }
}

EventForm to_event_form(const world::Event& e) {
  using Kind = world::Event::Kind;
  EventForm form{.kind = static_cast<std::size_t>(e.kind),
                 .time_s = e.time_s,
                 .position = e.position,
                 .when = static_cast<std::size_t>(e.when),
                 .of = static_cast<std::size_t>(e.of),
                 .share = e.share,
                 .count = e.count,
                 .every_s = e.every_s};
  if (e.kind == Kind::die || e.kind == Kind::freeze) form.robot = e.index;
  if (e.kind == Kind::move_target || e.kind == Kind::remove_target) form.target = e.index;
  if (e.kind == Kind::freeze || e.kind == Kind::blackout) form.duration_s = e.value;
  if (e.kind == Kind::set_loss) form.loss = e.value;
  if (e.kind == Kind::move_target) form.speed_m_s = e.value;
  if (e.kind == Kind::set_line_of_sight) form.line_of_sight = e.value != 0.0;
  if (e.kind == Kind::move_obstacle) form.obstacle = e.index;
  return form;
}

world::Event to_event(const EventForm& form) {
  using Kind = world::Event::Kind;
  world::Event e{
      .time_s = form.time_s, .kind = static_cast<Kind>(form.kind), .when = static_cast<world::Event::When>(form.when)};
  if (e.kind == Kind::die || e.kind == Kind::freeze) e.index = form.robot;
  if (e.kind == Kind::move_target || e.kind == Kind::remove_target) e.index = form.target;
  if (e.kind == Kind::freeze || e.kind == Kind::blackout) e.value = form.duration_s;
  if (e.kind == Kind::set_loss) e.value = form.loss;
  if (e.kind == Kind::move_target) e.value = form.speed_m_s;
  if (e.kind == Kind::set_line_of_sight) e.value = form.line_of_sight ? 1.0 : 0.0;
  if (e.kind == Kind::move_obstacle) e.index = form.obstacle;
  if (e.kind == Kind::move_target || e.kind == Kind::add_target || e.kind == Kind::move_obstacle)
    e.position = form.position;
  if (e.kind != Kind::kill) return e;
  e.of = static_cast<world::Event::Of>(form.of);
  e.share = form.share;
  e.count = form.count;
  e.every_s = form.every_s;
  return e;
}

}  // namespace

std::span<const Key<Form>> scenario_keys() noexcept {
  using Formats = std::make_index_sequence<std::size(record::output_formats)>;
  static const std::vector<Key<Form>> keys = with_outputs(Formats());
  return keys;
}
std::span<const Key<ObstacleForm>> obstacle_keys() noexcept { return obstacle_list; }
std::span<const Key<EventForm>> event_keys() noexcept { return event_list; }
std::span<const Section> sections() noexcept { return section_list; }

Form to_form(const Configuration& configuration) {
  Form form;
  form.configuration = configuration;
  const auto& scenario = configuration.scenario;
  form.targets_layout = scenario.targets.index();
  if (const auto* list = std::get_if<std::vector<Vec2>>(&scenario.targets)) form.target_positions = *list;
  auto common = [&](const auto& t) {
    form.target_count = t.count;
    form.target_radius_m = t.radius_m;
    form.target_center = t.center;
  };
  if (const auto* ring = std::get_if<world::RingTargets>(&scenario.targets)) {
    common(*ring);
    form.target_phase_rad = ring->phase_rad;
  }
  if (const auto* random = std::get_if<world::RandomTargets>(&scenario.targets)) common(*random);
  for (const auto& o : scenario.obstacles) form.obstacles.push_back(std::visit(ToObstacleForm{}, o));
  for (const auto& e : scenario.events) form.events.push_back(to_event_form(e));
  return form;
}

Configuration to_configuration(const Form& form) {
  Configuration configuration = form.configuration;
  auto& scenario = configuration.scenario;
  switch (form.targets_layout) {
    case 0:
      scenario.targets = form.target_positions;
      break;
    case 1:
      scenario.targets =
          world::RingTargets{form.target_count, form.target_radius_m, form.target_phase_rad, form.target_center};
      break;
    default:
      scenario.targets = world::RandomTargets{form.target_count, form.target_radius_m, form.target_center};
  }
  scenario.obstacles.clear();
  scenario.events.clear();
  for (const auto& o : form.obstacles) scenario.obstacles.push_back(to_obstacle(o));
  for (const auto& e : form.events) scenario.events.push_back(to_event(e));
  return configuration;
}

std::string_view platform_key(std::string_view parameter) noexcept {
  if (parameter == "communication_range_m") return "radio.range_m";
  if (parameter == "tick_s") return "tick_s";
  if (parameter == "wheel_limit_m_s") return "robot.wheel_limit_m_s";
  if (parameter == "wheel_distance_m") return "robot.wheel_distance_m";
  return {};
}

bool applies(std::string_view when, std::string_view name) noexcept {
  while (!when.empty()) {
    const auto end = std::min(when.find(' '), when.size());
    if (when.substr(0, end) == name) return true;
    when.remove_prefix(std::min(end + 1, when.size()));
  }
  return false;
}

std::string range_text(const Range& range, std::string_view unit) {
  const bool low = range.minimum > -std::numeric_limits<double>::infinity();
  const bool high = range.maximum < std::numeric_limits<double>::infinity();
  std::string text;
  const std::string at_most = high ? ", at most " + number_text(range.maximum) : "";
  if (low && range.above)
    text = "above " + number_text(range.minimum) + at_most;
  else if (low && high)
    text = number_text(range.minimum) + " to " + number_text(range.maximum);
  else if (low)
    text = "at least " + number_text(range.minimum);
  else if (high)
    text = "at most " + number_text(range.maximum);
  else
    return "any finite number";
  return unit.empty() ? text : text + " " + std::string(unit);
}

}  // namespace banyan::config
