// SPDX-License-Identifier: MIT
// A world as a user describes it: pure data with defaults, no file format. config/ reads it from
// TOML or JSON by the table of keys in schema.hpp; tests and programs build it directly. Lengths in
// m, angles in rad, times in s. Below the data: functions of what it stands for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "banyan/controller/core/algorithm.hpp"
#include "banyan/controller/core/vec2.hpp"
#include "banyan/world/cell_grid.hpp"

namespace banyan::world {

using Vec2 = BasicVec2<double>;

struct Mission {
  std::string algorithm;                       // a name in Scenario::algorithms
  std::string reading = "corrected";           // or "literal"
  std::optional<double> target_tolerance_m{};  // this and other lengths may follow from C and the body: see below
  double time_limit_s = 0.0;                   // 0: 10 r / v_max, r the farthest target from the start's centre
  bool stop_when_complete = true;
  double settle_s = 0.0;            // with stop_when_complete: how long to go on after completion
  std::size_t link_redundancy = 1;  // k: paths between any two targets that share no other robot
  // Which nodes data has to flow between: names of stations, or numbers of targets. Empty: between all of them.
  std::vector<std::pair<std::string, std::string>> connect;
  std::vector<std::pair<std::string, double>> parameters;  // overrides, by their keys
};

enum class Layout : std::uint8_t { hexagonal, grid, line, ring, cross, bridge, random, list };

struct Start {
  Layout layout = Layout::hexagonal;
  Vec2 center{};
  std::optional<double> pitch_m{};
  std::optional<double> pitch_share{};  // of radio.range_m, instead of pitch_m
  std::optional<double> jitter_m{};     // uniform in a disc of this radius around each point; not in a random start
  double link_share = 0.9;              // of radio.range_m: spacing of the bridge, longest link of a random start
  std::size_t bridge_robots = 3;        // layout bridge: between the two clusters
  std::vector<Vec2> positions;          // layout list
  std::vector<double> headings_rad;     // layout list, optional: random if empty
};

struct SwarmModel {
  std::optional<std::size_t> robots;  // none: from redundancy, ceil(k sum_i |p_i| / redundancy_edge_m())
  double redundancy = 2.0;            // k
  Start start;
  std::optional<std::size_t> root;  // index; none: a random robot that is not a worker
  std::size_t room = 0;             // places for robots that join by an intervention: a program's, no key of files
};

enum class BodyModel : std::uint8_t { disks, box2d, linear };

struct RobotModel {
  BodyModel body = BodyModel::disks;
  double radius_m = 0.0704;  // Khepera IV
  std::optional<double> wheel_distance_m{};
  double wheel_limit_m_s = 0.2;
  double wheel_noise = 0.0;                       // sigma of the factor on each wheel's speed, drawn every tick
  double wheel_bias = 0.0;                        // sigma of a factor drawn once per wheel
  double odometry_noise = 0.0;                    // sigma of the factor on each odometry reading
  double mass_kg = 0.4;                           // box2d
  double max_force_n = 1.5;                       // box2d
  double max_torque_nm = 1.5;                     // box2d
  std::optional<double> max_acceleration_m_s2{};  // linear: |u| <= this (paper II-A)
  bool dead_bodies = true;                        // the dead stay and block motion and sight; false: they vanish
  std::optional<double> proximity_m{};            // reach of the proximity sensor from the robot's centre; 0: none
};

struct RadioModel {
  // Which packets do not arrive, beside those that are out of range or sight.
  enum class Model : std::uint8_t { disc, bursts, path_loss, one_way };
  Model model = Model::disc;
  double range_m = 2.0;             // C: a link exists at distance < C (strict, symmetric)
  bool line_of_sight = false;       // blocked by robots and obstacles
  double sight_leak = 0.0;          // share of the lines of sight past one body over which packets get through
  double loss = 0.0;                // probability that a packet is lost, per packet and receiver
  double range_noise_m = 0.0;       // sigma
  double bearing_noise_rad = 0.0;   // sigma
  int latency_ticks = 1;            // a message sent in tick t is heard in t + latency
  double burst_s = 0.5;             // bursts: mean length of a time in which nothing arrives over a link
  double path_loss_exponent = 3.0;  // path_loss: n
  double edge_loss = 0.5;           // path_loss: share of the packets lost at distance C, without shadowing
  double shadowing_db = 3.0;        // path_loss: sigma of the shadowing of a pair
  double shadowing_s = 5.0;         // path_loss: time after which it is drawn anew; 0: never
  double one_way_share = 0.2;       // one_way: of the pairs of robots, those in which one never hears the other
  int slots = 0;                    // packets a robot can receive in one tick; 0: no limit
};

// What a robot runs on (docs/model.md). The defaults are a Khepera IV: 7.4 V times 3400 mAh; standing it lasts 8 h,
// driving at full speed 5 h.
struct Battery {
  // none: robots never run down; power: what each part draws; time, motion and both: as in ARGoS, shares of the charge.
  enum class Model : std::uint8_t { none, power, time, motion, time_motion };
  Model model = Model::none;
  double capacity_j = 90576.0;
  double start_charge = 1.0;  // share of the capacity
  double start_spread = 0.0;  // so much less at most, uniform
  double idle_w = 1.4;        // power: sensors, motor controllers and all that is not below
  double computing_w = 1.25;  // its computer
  double radio_w = 0.5;
  double drive_w_per_m_s = 4.72;  // by each wheel
  double charge_per_s = 1e-4;     // time: share of the capacity
  double charge_per_m = 1e-3;     // motion
  double charge_per_rad = 1e-3;
  double noise = 0.0;               // sigma of the measured charge, as a share of the capacity
  std::vector<Vec2> places;         // where robots are charged; each is held like a target
  std::size_t slots = 4;            // robots charged at one place at the same time
  std::optional<double> reach_m{};  // from a place to the robots that it charges
  double charge_w = 25.0;           // into each of them

  [[nodiscard]] bool on() const noexcept { return model != Model::none; }
};

// A node of the network that is no robot of the swarm: a base, a vehicle, a person. It speaks the algorithm's protocol
// and goes where its course says, whatever the algorithm wants. Its place is held like a target, by itself.
struct Station {
  std::string name;
  Vec2 position{};              // at the start
  std::vector<Vec2> course{};   // way points after that; none: it stands
  double speed_m_s = 0.0;       // between them
  double pause_s = 0.0;         // at each of them
  double start_s = 0.0;         // it leaves then
  bool loop = false;            // from the last way point it goes on to the first place, and so on
  std::vector<double> times{};  // s, instead of speed, pauses and loop: when it is at each way point
  double announce_s = 0.0;      // so long ahead it tells the swarm where it will be
  bool root = false;            // it is the tree's first root, and stays that
};

// Places at which a robot has to be once: as soon as one is there, it is free again. Spares are sent, to one place at a
// time or so many.
struct Visits {
  std::optional<std::vector<Vec2>> positions{};
  std::optional<std::size_t> at_once{};
  std::optional<double> patience_s{};  // then another place is tried first
  [[nodiscard]] std::vector<Vec2> places() const { return positions.value_or(std::vector<Vec2>{}); }
};

// The alternatives of a variant carry the name by which a file chooses them.
struct RingTargets {
  static constexpr std::string_view kind = "ring";
  std::size_t count = 3;
  std::optional<double> radius_m{};
  double phase_rad = 0.0;
  Vec2 center{};
};
// |p| = radius sqrt(0.1 + 0.9 u): uniform in an annulus, drawn from the run's seed.
struct RandomTargets {
  static constexpr std::string_view kind = "random";
  std::size_t count = 3;
  std::optional<double> radius_m{};
  Vec2 center{};
};
using Targets = std::variant<std::vector<Vec2>, RingTargets, RandomTargets>;  // the first: "list"

struct Disc {
  static constexpr std::string_view kind = "disc";
  Vec2 center;
  double radius_m = 0.0;
  friend bool operator==(const Disc&, const Disc&) = default;
};
struct Box {
  static constexpr std::string_view kind = "box";
  Vec2 center;
  Vec2 size;
  double angle_rad = 0.0;
  friend bool operator==(const Box&, const Box&) = default;
};
struct Wall {  // a segment without thickness
  static constexpr std::string_view kind = "wall";
  Vec2 from;
  Vec2 to;
  friend bool operator==(const Wall&, const Wall&) = default;
};
struct FloorMap {  // occupied cells of a grid
  static constexpr std::string_view kind = "map";
  std::optional<std::string> file{};      // config/ puts the cells in its place
  double cell_m = 0.0;                    // side of a cell, above 0
  Vec2 origin{};                          // the lower left corner,
  double angle_rad = 0.0;                 // about which it is turned
  std::shared_ptr<const CellGrid> cells;  // none while it is being described

  friend bool operator==(const FloorMap& a, const FloorMap& b) noexcept {
    const bool same_cells = a.cells == b.cells || (a.cells && b.cells && *a.cells == *b.cells);
    return same_cells && a.cell_m == b.cell_m && a.origin == b.origin && a.angle_rad == b.angle_rad;
  }
};
using Obstacle = std::variant<Disc, Box, Wall, FloorMap>;

// What can happen to a world.
struct Die {
  static constexpr std::string_view kind = "die";
  std::size_t robot = 0;
};
struct Freeze {
  static constexpr std::string_view kind = "freeze";
  std::size_t robot = 0;
  double duration_s = 0.0;  // 0: for good
};
struct SetLoss {
  static constexpr std::string_view kind = "set_loss";
  double loss = 0.0;
};
struct MoveTarget {
  static constexpr std::string_view kind = "move_target";
  std::size_t target = 0;
  Vec2 position{};
  double speed_m_s = 0.0;  // 0: it jumps
};
struct AddTarget {
  static constexpr std::string_view kind = "add_target";
  Vec2 position{};
};
struct Kill {
  static constexpr std::string_view kind = "kill";
  // Which robots it draws from: the living that broadcast the role when it acts.
  enum class Of : std::uint8_t { robots, connectors, root, worker, worker_and_parent };
  Of of = Of::robots;
  std::optional<double> share{};       // of those it draws from when it begins, rounded; not beside count
  std::optional<std::size_t> count{};  // how many; neither: one
  double every_s = 0.0;                // one by one, this long apart; 0: all at once
};
struct Blackout {  // no robot hears anything
  static constexpr std::string_view kind = "blackout";
  double duration_s = 0.0;  // above 0
};
struct RemoveTarget {
  static constexpr std::string_view kind = "remove_target";
  std::size_t target = 0;
};
struct SetLineOfSight {
  static constexpr std::string_view kind = "set_line_of_sight";
  bool line_of_sight = false;
};
struct MoveObstacle {
  static constexpr std::string_view kind = "move_obstacle";
  std::size_t obstacle = 0;
  Vec2 position{};  // of its centre, or of a wall's middle
};
struct AddObstacle {  // a disc; it becomes the last obstacle
  static constexpr std::string_view kind = "add_obstacle";
  Vec2 position{};
  double radius_m = 0.0;  // above 0
};
struct RemoveObstacle {  // those after it move up
  static constexpr std::string_view kind = "remove_obstacle";
  std::size_t obstacle = 0;
};
struct Join {  // as a spare that knows nothing: the next robot, or one that has died
  static constexpr std::string_view kind = "join";
  std::size_t robot = 0;
  Vec2 position{};
};
using Action = std::variant<Die, Freeze, SetLoss, MoveTarget, AddTarget, Kill, Blackout, RemoveTarget, SetLineOfSight,
                            MoveObstacle, AddObstacle, RemoveObstacle, Join>;

struct Event {
  // What time_s counts from: the start, the moment at which the workers' remaining distances have
  // fallen to half of what they were at the start, or the first at which all targets are held at
  // once (docs/model.md). An event whose moment never comes never happens.
  enum class When : std::uint8_t { time, half_way, complete };
  double time_s = 0.0;
  When when = When::time;
  Action action{};
};

// Without it all robots step at the beginning of every tick. With it each has its own phase, uniform in
// its period, and its own rate; bodies move and packets travel in `substeps` steps per tick.
struct Clocks {
  bool asynchronous = false;
  double drift = 0.0;  // a clock's rate is 1 + uniform(-drift, drift), drawn once
  int substeps = 5;
};

struct Scenario {
  // What mission.algorithm chooses from: the program's list, which must outlive the scenario and its worlds.
  const AlgorithmList* algorithms = nullptr;
  std::string name;
  std::string description;
  double tick_s = 0.1;
  std::uint64_t seed = 1;
  Mission mission;
  SwarmModel swarm;
  RobotModel robot;
  RadioModel radio;
  Clocks clocks;
  Battery battery;
  Targets targets = RingTargets{};
  Visits visits;
  std::vector<Station> stations;
  std::optional<std::string> map{};  // a file: config/ makes it the last of
  std::vector<Obstacle> obstacles;
  std::vector<Event> events;  // any order; equal times act in file order
};

// Nothing is said yet: all defaults, and the usual algorithm of this list.
[[nodiscard]] Scenario plain_scenario(const AlgorithmList& algorithms);

// The functions below need a scenario without faults (faults.hpp; warnings do not matter).

// The target positions that `scenario` and its seed stand for, random ones clear of obstacles, and after them the
// charging places and the places of the stations, which are held like targets. A station that is the root has none.
[[nodiscard]] std::vector<Vec2> target_positions(const Scenario& scenario);
// The charging places among them: where a station stands, that holds the place.
[[nodiscard]] std::vector<Vec2> held_charging_places(const Scenario& scenario);
// Whether robots are charged where the station stands.
[[nodiscard]] bool charges(const Scenario& scenario, const Station& station) noexcept;
// Without the charging places and the stations.
[[nodiscard]] std::vector<Vec2> mission_targets(const Scenario& scenario);

// The edge by which swarm.redundancy counts: 0.7704205 C, which is delta of inwards (protocol 2, row 10).
[[nodiscard]] double redundancy_edge_m(const Scenario& scenario) noexcept;

// Number of robots at the start that go where the algorithm wants: swarm.robots, or the paper's redundancy factor
// (protocol 2, row 10) of the mission's targets and stations. At least one more than targets and charging places.
[[nodiscard]] std::size_t free_robot_count(const Scenario& scenario);
// The same with the stations, whose indices come after those of the others.
[[nodiscard]] std::size_t robot_count(const Scenario& scenario);
// With those that join later, and swarm.room.
[[nodiscard]] std::size_t place_count(const Scenario& scenario);

// What a scenario does not say of lengths follows from the radio's range C and the body. Most are shares of this: C, or
// 28.4 radii of the body where that is more; it is C = 2 m with a Khepera IV.
[[nodiscard]] double length_scale_m(const Scenario& scenario) noexcept;
// As given, or such a share. Between neighbours of the start; in a random one the least between any two robots.
[[nodiscard]] double start_pitch_m(const Scenario& scenario) noexcept;
[[nodiscard]] double start_jitter_m(const Scenario& scenario) noexcept;
[[nodiscard]] double target_tolerance_m(const Scenario& scenario) noexcept;
[[nodiscard]] double proximity_m(const Scenario& scenario) noexcept;
[[nodiscard]] double charging_reach_m(const Scenario& scenario) noexcept;
// As given, or in proportion to the body, and to what makes a robot fast within a fiftieth of a drive.
[[nodiscard]] double wheel_distance_m(const Scenario& scenario) noexcept;
[[nodiscard]] double max_acceleration_m_s2(const Scenario& scenario) noexcept;

// A drive: the time in which a robot covers C at full speed, 10 s by default. What motion takes is counted in drives.
[[nodiscard]] double drive_s(const Scenario& scenario) noexcept;

// Times are multiples of ticks, each rounded: two that differ by no more than this are the same.
[[nodiscard]] double time_rounding_s(const Scenario& scenario) noexcept;

// mission.time_limit_s, or 10 r / v_max (paper Sec. IV-B).
[[nodiscard]] double time_limit_s(const Scenario& scenario);

// The one that mission.algorithm names.
[[nodiscard]] const Algorithm& algorithm_of(const Scenario& scenario);

// What the swarm is made for: reading, mission.parameters, and the platform (range, tick, wheels, drive)
// from `robot`, `radio` and `tick_s`.
[[nodiscard]] Setup setup_of(const Scenario& scenario);

// No network of fewer robots, each nearer than C to its neighbours, comes within tolerance of all
// targets: from the longest distance between two of them and from 0.8241 times their minimum
// spanning tree (Chung & Graham 1985). measure/steiner.hpp has the tighter bound.
[[nodiscard]] std::size_t least_robots(const std::vector<Vec2>& targets, double tolerance_m, double range_m);

}  // namespace banyan::world
