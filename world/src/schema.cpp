// SPDX-License-Identifier: MIT
#include "banyan/world/schema.hpp"

#include "banyan/controller/core/algorithm.hpp"
#include "banyan/world/decimal.hpp"

namespace banyan::world {

// ---- Names of enums and of the alternatives of variants ----

template <> struct NamesOf<Layout> {
  static constexpr std::string_view list[] = {"hexagonal", "grid", "line", "ring", "cross", "bridge", "random", "list"};
};
template <> struct NamesOf<BodyModel> { static constexpr std::string_view list[] = {"disks", "box2d", "linear"}; };
template <> struct NamesOf<RadioModel::Model> {
  static constexpr std::string_view list[] = {"disc", "bursts", "path_loss", "one_way"};
};
template <> struct NamesOf<Battery::Model> {
  static constexpr std::string_view list[] = {"none", "power", "time", "motion", "time_motion"};
};
template <> struct NamesOf<Event::When> {
  static constexpr std::string_view list[] = {"time", "half-way", "complete"};
};
template <> struct NamesOf<Kill::Of> {
  static constexpr std::string_view list[] = {"robots", "connectors", "root", "worker", "worker_and_parent"};
};
template <> struct NamesOf<Targets> {
  static constexpr std::string_view list[] = {"list", RingTargets::kind, RandomTargets::kind};
};
template <> struct Conversion<std::shared_ptr<const CellGrid>> {
  using Cells = std::shared_ptr<const CellGrid>;
  static constexpr Type type = Type::text;
  static constexpr bool optional = true;
  static Names names() noexcept { return {}; }
  static Value get(const Cells& cells) { return cells ? Value(cells->text()) : Value(); }
  static void set(Cells& cells, const Value& value) {
    cells = std::make_shared<const CellGrid>(CellGrid::from_text(std::get<std::string>(value)));
  }
};
template <class... Alternatives> struct NamesOf<std::variant<Alternatives...>> {
  static constexpr std::string_view list[] = {Alternatives::kind...};
};

// ---- Where the parts are ----

template <> struct Parts<Scenario> {
  template <class Part> static Part* find(Scenario& s) noexcept {
    if constexpr (std::is_same_v<Part, Scenario>) return &s;
    else if constexpr (std::is_same_v<Part, Mission>) return &s.mission;
    else if constexpr (std::is_same_v<Part, SwarmModel>) return &s.swarm;
    else if constexpr (std::is_same_v<Part, Start>) return &s.swarm.start;
    else if constexpr (std::is_same_v<Part, RobotModel>) return &s.robot;
    else if constexpr (std::is_same_v<Part, RadioModel>) return &s.radio;
    else if constexpr (std::is_same_v<Part, Clocks>) return &s.clocks;
    else if constexpr (std::is_same_v<Part, Battery>) return &s.battery;
    else if constexpr (std::is_same_v<Part, Visits>) return &s.visits;
    else return std::get_if<Part>(&s.targets);
  }
};
template <> struct Parts<Obstacle> {
  template <class Part> static Part* find(Obstacle& o) noexcept { return std::get_if<Part>(&o); }
};
template <> struct Parts<Event> {
  template <class Part> static Part* find(Event& e) noexcept {
    if constexpr (std::is_same_v<Part, Event>) return &e;
    else return std::get_if<Part>(&e.action);
  }
};

namespace {

Names algorithm_names(const Scenario& s) noexcept { return s.algorithms == nullptr ? Names() : s.algorithms->names(); }
Names reading_names(const Scenario&) noexcept {
  static constexpr std::string_view names[] = {"corrected", "literal"};
  return names;
}

bool is_listed(const Scenario& s) noexcept { return s.swarm.start.layout == Layout::list; }
double* redundancy_of(Scenario& s) noexcept { return is_listed(s) ? nullptr : &s.swarm.redundancy; }
bool is_bridge(const Scenario& s) noexcept { return s.swarm.start.layout == Layout::bridge; }
bool is_random(const Scenario& s) noexcept { return s.swarm.start.layout == Layout::random; }
std::optional<double>* pitch_of(Scenario& s) noexcept { return is_listed(s) ? nullptr : &s.swarm.start.pitch_m; }
std::optional<double>* pitch_share_of(Scenario& s) noexcept {
  return is_listed(s) ? nullptr : &s.swarm.start.pitch_share;
}
std::optional<double>* jitter_of(Scenario& s) noexcept {
  return is_listed(s) || is_random(s) ? nullptr : &s.swarm.start.jitter_m;
}
double* link_share_of(Scenario& s) noexcept {
  return is_bridge(s) || is_random(s) ? &s.swarm.start.link_share : nullptr;
}
std::size_t* bridge_robots_of(Scenario& s) noexcept { return is_bridge(s) ? &s.swarm.start.bridge_robots : nullptr; }
template <auto member, RadioModel::Model model> double* radio_of(Scenario& s) noexcept {
  return s.radio.model == model ? &(s.radio.*member) : nullptr;
}
using Radios = RadioModel::Model;
template <auto member, Battery::Model... models> auto* battery_of(Scenario& s) noexcept {
  const bool counts = sizeof...(models) == 0 ? s.battery.on() : ((s.battery.model == models) || ...);
  return counts ? &(s.battery.*member) : nullptr;
}
using Draws = Battery::Model;
std::vector<Vec2>* positions_of(Scenario& s) noexcept { return is_listed(s) ? &s.swarm.start.positions : nullptr; }
std::vector<double>* headings_of(Scenario& s) noexcept { return is_listed(s) ? &s.swarm.start.headings_rad : nullptr; }
std::vector<Vec2>* listed_targets_of(Scenario& s) noexcept { return std::get_if<std::vector<Vec2>>(&s.targets); }
Obstacle* itself(Obstacle& o) noexcept { return &o; }

// What really limits a world is how its lengths and times compare: faults.cpp looks at that.
constexpr double world_size = 1e8;  // m
constexpr double long_range = 1e5;  // m
constexpr double long_time = 1e9;   // s
constexpr Range any_value;
constexpr Range some_robots{1.0, most_robots};
constexpr Range robots_of_swarm{2.0, most_robots};
constexpr Range any_robot{0.0, most_robots - 1};
constexpr Range anywhere{-world_size, world_size};
constexpr Range any_length{0.0, world_size, true};
constexpr Range any_reach{0.0, long_range};
constexpr Range some_reach{0.0, long_range, true};
constexpr Range any_time{0.0, long_time};
constexpr Range any_share{0.0, 1.0};
constexpr Range any_part{0.0, 1.0, true};
constexpr Range any_angle{-360.0, 360.0};
// Seeds stay below 2^53, so that every reader of JSON, the viewer among them, sees them exactly.
constexpr Range any_seed{0.0, 9007199254740992.0};

constexpr Section section_list[] = {
    {"", "The world as a whole."},
    {"mission", "What the swarm is to do, and by which algorithm."},
    {"mission.parameters",
     "Overrides of the algorithm's parameters, the paper's Table I among them. `banyan algorithms` lists their "
     "defaults, which depend on algorithm and reading."},
    {"swarm", "How many robots. Give `robots` or `redundancy`, not both."},
    {"swarm.start", "Where the robots begin: connected, by default a compact cluster.", "layout"},
    {"robot", "One robot's body and wheels. The defaults are a Khepera IV."},
    {"radio", "Which robots hear each other, and how well.", "model"},
    {"clocks", "When robots step: all together, or each by its own clock."},
    {"battery", "What robots run on, and where they are charged. Without it they never run down.", "model"},
    {"targets", "Where the workers have to go.", "layout"},
    {"visits",
     "Places at which a robot has to be once, beside the targets. As soon as one has been there, it is free again.", "",
     false, true},
    {"stations",
     "Nodes of the network that are no robots of the swarm, such as a base or a vehicle: repeat `[[stations]]` as "
     "often "
     "as needed. They speak the swarm's protocol, and go where their course says. They are robots, too: their numbers "
     "come after those of the others.",
     "", true, true},
    {"obstacles",
     "One obstacle each: repeat `[[obstacles]]` as often as needed. They block motion and, with "
     "`radio.line_of_sight`, the radio. Robots see them only within `robot.proximity_m`.",
     "kind", true},
    {"events", "What happens at a given time or moment of the mission: repeat `[[events]]` as often as needed.", "kind",
     true},
};

// A row: key, member, unit, range, meaning, and further properties.
// clang-format off
constexpr Key<Scenario> scenario_rows[] = {
    {"name", of<&Scenario::name>, "", any_value,
     "names the run and its output directory; letters, digits, '-', '_' and '.'", {.otherwise = "the file's name"}},
    {"description", of<&Scenario::description>, "", any_value, "what this world is about, for readers"},
    {"tick_s", of<&Scenario::tick_s>, "s", {0.001, 10.0},
     "length of a tick; robots broadcast, decide and move once a tick"},
    {"map", of<&Scenario::map>, "", any_value,
     "a map of ROS, by its YAML file: short for one of the obstacles with that `file`", {.otherwise = "none"}},
    {"seed", of<&Scenario::seed>, "", any_seed, "determines everything random; the same seed gives the same run",
     {.only_in_files = true}},

    {"mission.algorithm", word<&Mission::algorithm, algorithm_names>, "", any_value,
        "how the robots keep together on the way"},
    {"mission.reading", word<&Mission::reading, reading_names>, "", any_value,
     "the paper as printed (literal), or with its gaps closed (corrected); literal has an effect with outwards and "
     "inwards only"},
    {"mission.target_tolerance_m", of<&Mission::target_tolerance_m>, "m", any_length,
     "a target is reached when its worker is this near", {.otherwise = "0.1 C, at least 2.84 radii"}},
    {"mission.time_limit_s", of<&Mission::time_limit_s>, "s", any_time,
     "the run ends then; 0: ten times a straight drive to the farthest target"},
    {"mission.stop_when_complete", of<&Mission::stop_when_complete>, "", any_value,
     "end the run as soon as all targets are held at once by a tree in one piece"},
    {"mission.settle_s", of<&Mission::settle_s>, "s", any_time,
     "with stop_when_complete: go on this long after completion, so that the tree can settle"},
    {"mission.link_redundancy", of<&Mission::link_redundancy>, "", {1.0, 3.0},
     "k: paths between any two targets that share no other robot, so that any k - 1 robots can die at once; above 1 "
     "only with an algorithm that has rules for it, as convoy has"},
    {"mission.connect", of<&Mission::connect>, "", any_value,
     "pairs of nodes between which data has to flow, such as [[\"base\", \"vehicle\"]]: names of stations, or numbers of "
     "targets as text. The columns from connected_time_ratio on measure them",
     {.otherwise = "all stations and targets with each other"}},

    {"swarm.robots", of<&SwarmModel::robots>, "", robots_of_swarm, "number of robots",
     {.otherwise = "from redundancy, or the length of start.positions_m"}},
    {"swarm.redundancy", by<redundancy_of>, "", {0.0, 1000.0, true},
     "the paper's k: ceil(k * sum of target distances / (0.7704205 * radio.range_m)) robots",
     {.not_beside = "robots", .selector = "swarm.start.layout"}},
    {"swarm.root", of<&SwarmModel::root>, "", any_robot,
     "index of the first root, counted from 0 at the centre of the start",
     {.otherwise = "a random robot that is not a worker"}},

    {"swarm.start.layout", of<&Start::layout>, "", any_value,
     "a compact cluster on a hexagonal or square lattice, a line along the x axis, a ring, a cross, two clusters with "
     "a bridge, a random connected graph, or a list of positions"},
    {"swarm.start.center_m", of<&Start::center>, "m", anywhere,
     "centre of the start; in a random one, the robot from which it grows"},
    {"swarm.start.pitch_m", by<pitch_of>, "m", some_reach,
     "distance between neighbours, within the clusters of a bridge; in a random start the least distance between "
     "any two",
     {.otherwise = "0.16 C, at least 4.55 radii", .not_beside = "pitch_share"}},
    {"swarm.start.pitch_share", by<pitch_share_of>, "", any_part,
     "the same as a share of radio.range_m; not beside pitch_m", {.otherwise = "pitch_m counts"}},
    {"swarm.start.jitter_m", by<jitter_of>, "m", any_reach, "each robot is displaced from its point by up to this",
     {.otherwise = "0.01 C, at least 0.284 radii"}},
    {"swarm.start.link_share", by<link_share_of>, "", any_part,
     "spacing of the bridge, or longest link over which a random start grows, as a share of radio.range_m"},
    {"swarm.start.bridge_robots", by<bridge_robots_of>, "", some_robots, "robots between the two clusters"},
    {"swarm.start.positions_m", by<positions_of>, "m", anywhere, "one [x, y] per robot", {.required = true}},
    {"swarm.start.headings_deg", by<headings_of>, "deg", any_angle,
     "one angle per robot, counter-clockwise from the x axis", {.otherwise = "random"}},

    {"robot.body", of<&RobotModel::body>, "", any_value,
     "disks: wheels and contacts, fast; box2d: with mass and force limits; linear: the paper's point masses, "
     "holonomic"},
    {"robot.radius_m", of<&RobotModel::radius_m>, "m", some_reach, "radius of the body"},
    {"robot.wheel_distance_m", of<&RobotModel::wheel_distance_m>, "m", some_reach,
     "distance between the wheels", {.otherwise = "1.497 radii"}},
    {"robot.wheel_limit_m_s", of<&RobotModel::wheel_limit_m_s>, "m/s", {1e-4, 1000.0},
     "largest speed of a wheel"},
    {"robot.wheel_noise", of<&RobotModel::wheel_noise>, "", any_share,
     "sigma of the factor on each wheel's speed, drawn every tick"},
    {"robot.wheel_bias", of<&RobotModel::wheel_bias>, "", any_share,
     "sigma of a factor on each wheel's speed, drawn once"},
    {"robot.odometry_noise", of<&RobotModel::odometry_noise>, "", any_share,
     "sigma of the factor on each odometry reading"},
    {"robot.mass_kg", of<&RobotModel::mass_kg>, "kg", {0.0, 1e4, true}, "mass (body box2d)"},
    {"robot.max_force_n", of<&RobotModel::max_force_n>, "N", {0.0, 1e6, true},
     "largest force of the wheels (body box2d)"},
    {"robot.max_torque_nm", of<&RobotModel::max_torque_nm>, "N m", {0.0, 1e6, true},
     "largest torque of the wheels (body box2d)"},
    {"robot.max_acceleration_m_s2", of<&RobotModel::max_acceleration_m_s2>, "m/s^2", {0.0, 1e8, true},
     "bound on the acceleration |u| (body linear)", {.otherwise = "50 wheel_limit^2 / C"}},
    {"robot.dead_bodies", of<&RobotModel::dead_bodies>, "", any_value,
     "the dead stay where they are and block motion and sight; false: they vanish"},
    {"robot.proximity_m", of<&RobotModel::proximity_m>, "m", any_reach,
     "reach of the proximity sensor, from the robot's centre to the surface of obstacles and dead bodies; 0: none",
     {.otherwise = "0.15 C, at least 4.26 radii"}},

    {"radio.model", of<&RadioModel::model>, "", any_value,
     "which packets are lost within range and sight: disc, each with the same probability; bursts, many in a row; "
     "path_loss, more the farther away the sender is; one_way, between some pairs all those in one direction"},
    {"radio.range_m", of<&RadioModel::range_m>, "m", {0.01, long_range},
     "C: two robots nearer than this hear each other"},
    {"radio.line_of_sight", of<&RadioModel::line_of_sight>, "", any_value,
     "robots and obstacles in between block a packet"},
    {"radio.sight_leak", of<&RadioModel::sight_leak>, "", any_share,
     "share of the lines of sight past one robot's body that let packets through nevertheless; headings decide which; "
     "0: sight is exact; 0.18 as in ARGoS 3"},
    {"radio.loss", of<&RadioModel::loss>, "", any_share,
     "probability that a packet does not arrive, per packet and receiver"},
    {"radio.burst_s", by<radio_of<&RadioModel::burst_s, Radios::bursts>>, "s", {0.0, 1e6, true},
     "mean length of a burst, in which nothing arrives over a link; radio.loss is the share of time in bursts"},
    {"radio.path_loss_exponent", by<radio_of<&RadioModel::path_loss_exponent, Radios::path_loss>>, "", {1.0, 10.0},
     "n: the signal falls with the n-th power of the distance; 2 in free space, 3 indoors"},
    {"radio.edge_loss", by<radio_of<&RadioModel::edge_loss, Radios::path_loss>>, "", {0.001, 0.999},
     "share of the packets that are lost at distance range_m"},
    {"radio.shadowing_db", by<radio_of<&RadioModel::shadowing_db, Radios::path_loss>>, "dB", {0.0, 20.0},
     "sigma of the difference between a pair's signal and what its distance predicts"},
    {"radio.shadowing_s", by<radio_of<&RadioModel::shadowing_s, Radios::path_loss>>, "s", {0.0, 1e6},
     "time after which that difference is drawn anew; 0: it stays the same for the whole run"},
    {"radio.one_way_share", by<radio_of<&RadioModel::one_way_share, Radios::one_way>>, "", any_share,
     "share of the pairs of robots in which one never hears the other"},
    {"radio.range_noise_m", of<&RadioModel::range_noise_m>, "m", any_reach, "sigma of the measured range"},
    {"radio.bearing_noise_deg", of<&RadioModel::bearing_noise_rad>, "deg", {0.0, 180.0},
     "sigma of the measured bearing"},
    {"radio.latency_ticks", of<&RadioModel::latency_ticks>, "ticks", {1.0, 100.0},
     "a message is heard this many ticks after it was sent"},
    {"radio.slots", of<&RadioModel::slots>, "", {0.0, 65535.0}, "packets a robot can receive in one tick; 0: no limit"},

    {"clocks.asynchronous", of<&Clocks::asynchronous>, "", any_value,
     "each robot steps at its own moments, not all of them at the beginning of every tick"},
    {"clocks.drift", of<&Clocks::drift>, "", {0.0, 0.5}, "each clock's rate is 1 + uniform(-drift, drift), drawn once"},
    {"clocks.substeps", of<&Clocks::substeps>, "", {2.0, 100.0},
     "parts of a tick, after each of which bodies move and packets travel (asynchronous)"},

    {"battery.model", of<&Battery::model>, "", any_value,
     "how the charge sinks: none, not at all; power, by what each part draws; time, motion and time_motion, as in "
     "ARGoS, by shares of the charge"},
    {"battery.capacity_j", by<battery_of<&Battery::capacity_j>>, "J", {0.0, 1e9, true}, "energy of a full battery"},
    {"battery.start_charge", by<battery_of<&Battery::start_charge>>, "", any_part, "charge at the start, as a share"},
    {"battery.start_spread", by<battery_of<&Battery::start_spread>>, "", any_share,
     "each robot starts with up to this share less, drawn from the seed"},
    {"battery.idle_w", by<battery_of<&Battery::idle_w, Draws::power>>, "W", {0.0, 1e6},
     "drawn at all times by sensors and everything without a key of its own"},
    {"battery.computing_w", by<battery_of<&Battery::computing_w, Draws::power>>, "W", {0.0, 1e6},
        "drawn by the computer"},
    {"battery.radio_w", by<battery_of<&Battery::radio_w, Draws::power>>, "W", {0.0, 1e6}, "drawn by the radio"},
    {"battery.drive_w_per_m_s", by<battery_of<&Battery::drive_w_per_m_s, Draws::power>>, "W s/m", {0.0, 1e9},
     "drawn by each wheel, times its speed"},
    {"battery.charge_per_s", by<battery_of<&Battery::charge_per_s, Draws::time, Draws::time_motion>>, "1/s", {0.0, 1000.0},
     "share of a full battery that each second takes"},
    {"battery.charge_per_m", by<battery_of<&Battery::charge_per_m, Draws::motion, Draws::time_motion>>, "1/m", {0.0,
        1000.0},
     "share that each metre takes"},
    {"battery.charge_per_rad", by<battery_of<&Battery::charge_per_rad, Draws::motion, Draws::time_motion>>, "1/rad",
     {0.0, 1.0}, "share that each radian of turning takes"},
    {"battery.noise", by<battery_of<&Battery::noise>>, "", any_share, "sigma of the measured charge"},
    {"battery.places_m", by<battery_of<&Battery::places>>, "m", anywhere,
     "charging places, one [x, y] each; the swarm holds them like targets"},
    {"battery.slots", by<battery_of<&Battery::slots>>, "", {1.0, 1000.0},
        "robots that a place charges at the same time"},
    {"battery.reach_m", by<battery_of<&Battery::reach_m>>, "m", some_reach,
     "a place charges robots no farther from it than this", {.otherwise = "0.3 C, at least 8.52 radii"}},
    {"battery.charge_w", by<battery_of<&Battery::charge_w>>, "W", {0.0, 1e6, true},
        "power into each robot that is charged"},

    {"targets.layout", of<&Scenario::targets>, "", any_value,
     "a list of positions, equal angles on a circle, or random in an annulus"},
    {"targets.positions_m", by<listed_targets_of>, "m", anywhere, "one [x, y] per target", {.required = true}},
    {"targets.count", of<&RingTargets::count, &RandomTargets::count>, "", {1.0, 10000.0}, "number of targets"},
    {"targets.radius_m", of<&RingTargets::radius_m, &RandomTargets::radius_m>, "m", {0.0, world_size},
     "distance of the targets from the centre; the largest one if random", {.otherwise = "1.5 C"}},
    {"targets.phase_deg", of<&RingTargets::phase_rad>, "deg", any_angle,
     "direction of the first target, counter-clockwise from the x axis"},
    {"targets.center_m", of<&RingTargets::center, &RandomTargets::center>, "m", anywhere,
     "centre of the circle or annulus"},

    {"visits.positions_m", of<&Visits::positions>, "m", anywhere, "one [x, y] per place", {.otherwise = "none"}},
    {"visits.at_once", of<&Visits::at_once>, "", some_robots,
     "to so many places robots are on their way at the same time; a spare is sent to the nearest", {.otherwise = "1"}},
    {"visits.patience_s", of<&Visits::patience_s>, "s", {0.0, long_time, true},
     "if nobody is there by then, another place is tried first",
     {.otherwise = "4 times a straight drive, and 100 ticks"}},
};

constexpr Key<Station> station_rows[] = {
    {"stations.name", of<&Station::name>, "", any_value, "its name; letters, digits, '-', '_' and '.'",
     {.required = true}},
    {"stations.position_m", of<&Station::position>, "m", anywhere, "where it is at the start", {.required = true}},
    {"stations.course_m", of<&Station::course>, "m", anywhere, "the way points to which it goes from there, in straight lines"},
    {"stations.speed_m_s", of<&Station::speed_m_s>, "m/s", {0.0, 1000.0}, "its speed between them"},
    {"stations.pause_s", of<&Station::pause_s>, "s", any_time, "how long it stands at each of them"},
    {"stations.start_s", of<&Station::start_s>, "s", any_time, "when it leaves"},
    {"stations.loop", of<&Station::loop>, "", any_value,
     "from the last way point it goes back to where it began, and on"},
    {"stations.times_s", of<&Station::times>, "s", any_time,
     "when it is at each of the way points, instead of speed_m_s, pause_s and loop"},
    {"stations.announce_s", of<&Station::announce_s>, "s", any_time,
     "so long ahead it knows its course, and the swarm can prepare"},
    {"stations.root", of<&Station::root>, "", any_value, "it is the first root of the tree, and stays it"},
};

constexpr Key<Obstacle> obstacle_rows[] = {
    {"obstacles.kind", by<itself>, "", any_value, "shape of the obstacle", {.required = true}},
    {"obstacles.center_m", of<&Disc::center, &Box::center>, "m", anywhere, "centre", {.required = true}},
    {"obstacles.radius_m", of<&Disc::radius_m>, "m", any_length, "radius", {.required = true}},
    {"obstacles.size_m", of<&Box::size>, "m", any_length, "length and width", {.required = true}},
    {"obstacles.angle_deg", of<&Box::angle_rad, &FloorMap::angle_rad>, "deg", any_angle,
     "direction of a box's length or of a map's rows, counter-clockwise from the x axis"},
    {"obstacles.from_m", of<&Wall::from>, "m", anywhere, "one end", {.required = true}},
    {"obstacles.to_m", of<&Wall::to>, "m", anywhere, "the other end", {.required = true}},
    {"obstacles.file", of<&FloorMap::file>, "", any_value,
     "a map from a file, as seen from that of the scenario: YAML of ROS, with which resolution_m, origin_m and "
     "angle_deg come; a picture (PNG, BMP, PGM) whose dark pixels are occupied; a .map of MovingAI",
     {.otherwise = "cells count"}},
    {"obstacles.resolution_m", of<&FloorMap::cell_m>, "m", any_length, "side of a cell", {.required = true}},
    {"obstacles.origin_m", of<&FloorMap::origin>, "m", anywhere,
     "lower left corner of the cells, about which they are turned"},
    {"obstacles.cells", of<&FloorMap::cells>, "", any_value,
     "rows of cells from the top: `#` occupied, `.` free; `12.` is twelve free ones, `3*` before a row three of them",
     {.required = true, .text_fault = CellGrid::text_fault}},
};

constexpr Key<Event> event_rows[] = {
    {"events.time_s", of<&Event::time_s>, "s", any_time, "time after the moment that `when` names", {.required = true}},
    {"events.when", of<&Event::when>, "", any_value,
     "what time_s counts from: time, the start; half-way, the workers' remaining distances have fallen to half; "
     "complete, all targets are held at once for the first time, by a tree in one piece. An event whose moment never "
     "comes never happens"},
    {"events.kind", of<&Event::action>, "", any_value, "what happens", {.required = true}},
    {"events.robot", of<&Die::robot, &Freeze::robot, &Join::robot>, "", any_robot,
     "index of the robot, counted from 0; one that joins is the next one, or one that has died", {.required = true}},
    {"events.duration_s", of<&Freeze::duration_s, &Blackout::duration_s>, "s", any_time,
     "how long the robot stands still (freeze; 0: for good) or no robot hears anything (blackout; above 0)"},
    {"events.loss", of<&SetLoss::loss>, "", any_share, "the new radio.loss", {.required = true}},
    {"events.line_of_sight", of<&SetLineOfSight::line_of_sight>, "", any_value,
     "the new radio.line_of_sight; the robots are told", {.required = true}},
    {"events.target", of<&MoveTarget::target, &RemoveTarget::target>, "", {0.0, 1e5},
     "index of the target, counted from 0", {.required = true}},
    {"events.obstacle", of<&MoveObstacle::obstacle, &RemoveObstacle::obstacle>, "", {0.0, 1e6},
     "index of the obstacle, counted from 0 among those there at that time", {.required = true}},
    {"events.position_m", of<&MoveTarget::position, &AddTarget::position, &MoveObstacle::position,
        &AddObstacle::position, &Join::position>, "m", anywhere,
     "where the target is from then on, or drives to; where the centre of the obstacle is (of a wall, its middle); "
     "where the robot stands that joins",
     {.required = true}},
    {"events.radius_m", of<&AddObstacle::radius_m>, "m", any_length, "radius of the disc", {.required = true}},
    {"events.speed_m_s", of<&MoveTarget::speed_m_s>, "m/s", {0.0, 1000.0},
     "the target drives there in a straight line; 0: it jumps"},
    {"events.of", of<&Kill::of>, "", any_value,
     "which robots the dead are drawn from: the living, by the role they broadcast when the event acts; "
     "worker_and_parent: a worker and its parent in the tree"},
    {"events.share", of<&Kill::share>, "", any_share,
     "how many die: this share of the robots they are drawn from when the event begins, rounded",
     {.otherwise = "count counts", .not_beside = "count"}},
    {"events.count", of<&Kill::count>, "", some_robots, "how many die; not beside share", {.otherwise = "1"}},
    {"events.every_s", of<&Kill::every_s>, "s", any_time, "they die one by one, this long apart; 0: all at once"},
};
// clang-format on

}  // namespace

std::span<const Section> scenario_sections() noexcept { return section_list; }
std::span<const Key<Obstacle>> obstacle_keys() noexcept { return obstacle_rows; }
std::span<const Key<Event>> event_keys() noexcept { return event_rows; }
std::span<const Key<Station>> station_keys() noexcept { return station_rows; }

std::span<const Key<Scenario>> scenario_keys() noexcept { return scenario_rows; }

}  // namespace banyan::world
