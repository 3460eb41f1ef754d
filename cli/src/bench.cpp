// SPDX-License-Identifier: MIT
// `banyan bench`: how many robot-steps per second this machine does, with everything on that a run
// has by default: the full controller, line of sight, all metrics at every tick; one thread.
//
// Where the layout is to stay the same while robots move, spares that orbit their reference robot
// (the literal reading) keep nearly every robot moving, and targets just beside the swarm keep the
// workers busy without pulling it apart. Each window starts from the same settled state and returns
// to it after `lap_ticks`, and the number of neighbours at the start and end of a window is part of
// the result, so that a drifting layout would show. A mission is what users run: there a window is
// all of it, from the first tick on.
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/config/config.hpp"
#include "banyan/controller/core/trig.hpp"
#include "banyan/measure/observer.hpp"
#include "banyan/world/world.hpp"
#include "commands.hpp"
#include "options.hpp"
#include "shipped.hpp"
#include "terminal.hpp"

namespace banyan::cli {

using namespace config;
namespace {

struct BenchOptions {
  bool json = false;
  int windows = 7;                // measured windows per layout
  double window_s = 0.7;          // wall time of one; a mission is measured whole
  std::string algorithm;          // "": each layout's own
  std::vector<std::string> only;  // names of layouts; empty: all
};

using Steady = std::chrono::steady_clock;

struct BenchLayout {
  enum class Kind : std::uint8_t { dense, spread, mission };
  const char* name;
  Kind kind;
  std::size_t robots;          // a mission has those of
  const char* scenario;        // a shipped one
  std::uint64_t settle_ticks;  // before the first window: beyond START and SELECT PARENT
  std::uint64_t lap_ticks;     // then back to the settled world, before the layout has changed
};
using Kind = BenchLayout::Kind;
constexpr BenchLayout bench_layouts[] = {{"dense-94-los", Kind::dense, 94, nullptr, 400, 1000},
                                         {"spread-94-los", Kind::spread, 94, nullptr, 400, 1000},
                                         {"spread-1000-los", Kind::spread, 1000, nullptr, 60, 100},
                                         {"spread-10000-los", Kind::spread, 10000, nullptr, 60, 100},
                                         {"mission-94", Kind::mission, 0, "paper-large", 0, 3000},
                                         {"mission-1000", Kind::mission, 0, "benchmark-1000", 0, 600},
                                         {"mission-10000", Kind::mission, 0, "benchmark-10000", 0, 150}};
constexpr double spread_pitch_m = 1.3;
constexpr double dense_pitch_m = 0.21;

world::Scenario standing_scenario(const BenchLayout& layout) {
  world::Scenario s = world::plain_scenario(algorithms());
  s.name = layout.name;
  s.mission.reading = "literal";
  s.mission.time_limit_s = 1e6;
  s.mission.stop_when_complete = false;
  s.swarm.robots = layout.robots;
  s.radio.line_of_sight = true;
  if (layout.kind == Kind::dense) {
    // Without the tree's springs, which would push all robots apart to S, and with avoidance only
    // below the lattice's own pitch.
    s.mission.algorithm = "inwards";
    s.mission.parameters = {{"avoidance_range", dense_pitch_m / s.radio.range_m}, {"interaction_gain", 0.0}};
    s.swarm.start.pitch_m = dense_pitch_m;
    s.targets = world::RingTargets{.count = 4, .radius_m = 1.0};
  } else {
    s.mission.algorithm = "outwards";
    s.swarm.start.layout = world::Layout::grid;
    s.swarm.start.pitch_m = spread_pitch_m;
    const double swarm_radius_m = spread_pitch_m * std::sqrt(static_cast<double>(layout.robots) / pi<double>);
    s.targets = world::RingTargets{.count = 4, .radius_m = swarm_radius_m + 0.9};
  }
  return s;
}

world::Scenario mission_scenario(const BenchLayout& layout) {
  const std::string file = shipped_scenarios() + "/" + layout.scenario + ".toml";
  const auto loaded = load_configuration(file, algorithms());
  if (!loaded.ok()) throw CommandError(exit_lost, to_string(loaded.problems.front()));
  world::Scenario s = loaded.configuration.scenario;
  s.mission.algorithm = "convoy";
  return s;
}

world::Scenario scenario_of(const BenchLayout& layout, const BenchOptions& options) {
  world::Scenario s = layout.kind == Kind::mission ? mission_scenario(layout) : standing_scenario(layout);
  if (!options.algorithm.empty()) s.mission.algorithm = options.algorithm;
  for (const world::Fault& fault : world::faults(s)) {
    if (fault.warning) continue;
    const std::string where = fault.key == "mission.algorithm" ? "--algorithm" : layout.name + (": " + fault.key);
    throw CommandError(exit_usage, where + ": " + fault.text);
  }
  return s;
}

double seconds_since(Steady::time_point start) { return std::chrono::duration<double>(Steady::now() - start).count(); }

double cpu_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

// Bytes of the process in memory.
double resident_bytes() {
  double pages = 0.0, resident = 0.0;
  if (!(std::ifstream("/proc/self/statm") >> pages >> resident)) resident = 0.0;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

struct NeighborCounts {
  double in_range = 0.0;  // mean per robot
  double visible = 0.0;   // of these, with line of sight
};
NeighborCounts neighbors_of(const world::World& world) {
  std::size_t visible = 0;
  for (std::size_t i = 0; i < world.size(); ++i) visible += world.links(i).size();
  const auto n = static_cast<double>(world.size());
  return {(static_cast<double>(visible) + 2.0 * static_cast<double>(world.blocked().size())) / n,
          static_cast<double>(visible) / n};
}

struct Sample {
  std::string algorithm;
  std::size_t robots = 0;
  std::vector<double> rates;              // robot-steps per second of wall time, one per window
  std::vector<double> cpu_rates;          // the same per second of processor time, for a busy machine
  NeighborCounts start, end;              // first and last tick of the windows
  double moving_share = 0.0;              // robots that moved in the last tick, mean over windows
  double startup_s = 0.0;                 // from the scenario to a world that can step, observer included
  double bytes_per_robot = 0.0;           // as the world counts
  double resident_bytes_per_robot = 0.0;  // as the operating system counts
};

// Share of the robots that move by more than 0.1 mm in the tick it takes to find out.
double moving_share(world::World& world) {
  const std::vector<world::Vec2> before(world.positions().begin(), world.positions().end());
  world.step();
  std::size_t moved = 0;
  for (std::size_t i = 0; i < before.size(); ++i) moved += distance(before[i], world.positions()[i]) > 1e-4;
  return static_cast<double>(moved) / static_cast<double>(before.size());
}

// One window: steps for `seconds` of measured time, or a whole mission; copies back to `settled` do not count.
void measure_window(const world::World& settled, const BenchLayout& layout, double seconds, Sample& sample,
                    int windows) {
  if (layout.kind == Kind::mission) seconds = std::numeric_limits<double>::infinity();
  double spent_s = 0.0;
  double cpu_s = 0.0;
  double steps = 0.0;
  world::World world = settled;
  do {
    world = settled;
    measure::Observer observer(world);
    const auto start = Steady::now();
    const double cpu_start_s = cpu_seconds();
    double lap_s = 0.0;
    for (std::uint64_t t = 0; t < layout.lap_ticks && spent_s + lap_s < seconds; ++t) {
      world.step();
      observer.observe(world);
      steps += static_cast<double>(world.size());
      lap_s = seconds_since(start);
    }
    spent_s += lap_s;
    cpu_s += cpu_seconds() - cpu_start_s;
  } while (layout.kind != Kind::mission && spent_s < seconds);
  const auto end = neighbors_of(world);
  sample.end.in_range += end.in_range / windows;
  sample.end.visible += end.visible / windows;
  sample.moving_share += moving_share(world) / windows;
  sample.rates.push_back(steps / spent_s);
  sample.cpu_rates.push_back(steps / cpu_s);
}

Sample measure_layout(const BenchLayout& layout, const BenchOptions& options, ProgressLine& progress) {
  Sample sample;
  const auto scenario = scenario_of(layout, options);
  const double before = resident_bytes();
  const auto start = Steady::now();
  world::World settled(scenario);
  measure::Observer observer(settled);
  sample.startup_s = seconds_since(start);
  for (std::uint64_t t = 0; t < layout.settle_ticks; ++t) {
    settled.step();
    observer.observe(settled);
    if (progress.due()) progress.show(0.0, std::string(layout.name) + ": settling", false);
  }
  sample.algorithm = scenario.mission.algorithm;
  sample.robots = settled.size();
  const auto n = static_cast<double>(sample.robots);
  sample.bytes_per_robot = static_cast<double>(settled.memory_bytes()) / n;
  sample.resident_bytes_per_robot = std::max(0.0, resident_bytes() - before) / n;
  sample.start = neighbors_of(settled);
  for (int w = 0; w < options.windows; ++w) {
    measure_window(settled, layout, options.window_s, sample, options.windows);
    if (progress.due()) progress.show(0.0, format("%s: window %d of %d", layout.name, w + 1, options.windows), false);
  }
  return sample;
}

nlohmann::ordered_json json_of(const Sample& sample) {
  const auto [low, high] = std::minmax_element(sample.rates.begin(), sample.rates.end());
  auto round_to = [](double v, double unit) { return std::round(v / unit) * unit; };
  auto hundredth = [](double v) { return std::round(v * 100.0) / 100.0; };
  return {{"robot_steps_per_s", round_to(median(sample.rates), 1.0)},
          {"lowest", round_to(*low, 1.0)},
          {"highest", round_to(*high, 1.0)},
          {"robot_steps_per_cpu_s", round_to(median(sample.cpu_rates), 1.0)},
          {"windows", sample.rates.size()},
          {"robots", sample.robots},
          {"algorithm", sample.algorithm},
          {"neighbors_in_range_start", hundredth(sample.start.in_range)},
          {"neighbors_in_range_end", hundredth(sample.end.in_range)},
          {"neighbors_visible_start", hundredth(sample.start.visible)},
          {"neighbors_visible_end", hundredth(sample.end.visible)},
          {"moving_share", hundredth(sample.moving_share)},
          {"startup_s", std::round(sample.startup_s * 1e4) / 1e4},
          {"memory_bytes_per_robot", round_to(sample.bytes_per_robot, 1.0)},
          {"resident_bytes_per_robot", round_to(sample.resident_bytes_per_robot, 1.0)}};
}

std::string row_text(const BenchLayout& layout, const Sample& sample) {
  const auto [low, high] = std::minmax_element(sample.rates.begin(), sample.rates.end());
  return format("%-17s %12s  %10s .. %-10s %11s  %5.1f -> %-5.1f %5.1f -> %-5.1f %5.0f %%  %8.4f  %9s\n", layout.name,
                grouped(median(sample.rates)).c_str(), grouped(*low).c_str(), grouped(*high).c_str(),
                grouped(median(sample.cpu_rates)).c_str(), sample.start.in_range, sample.end.in_range,
                sample.start.visible, sample.end.visible, 100.0 * sample.moving_share, sample.startup_s,
                grouped(sample.bytes_per_robot).c_str());
}

std::vector<BenchLayout> chosen_layouts(const std::vector<std::string>& only) {
  std::vector<BenchLayout> chosen;
  std::vector<std::string_view> names;
  for (const auto& layout : bench_layouts) {
    names.emplace_back(layout.name);
    if (only.empty() || std::find(only.begin(), only.end(), layout.name) != only.end()) chosen.push_back(layout);
  }
  for (const auto& name : only) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    const auto near = nearest(name, names);
    throw CommandError(exit_usage, "there is no layout \"" + name + "\"" +
                                       (near.empty() ? "" : "; did you mean " + std::string(near) + "?"));
  }
  return chosen;
}

int bench_command(const BenchOptions& options) {
  const auto layouts = chosen_layouts(options.only);
  auto report = nlohmann::ordered_json::object();
  if (!options.json) {
    print("Robot-steps per second: one thread, line of sight, full controller, metrics at every tick" +
          (options.algorithm.empty() ? "" : "; all with " + options.algorithm) + ".\n\n" +
          format("%-17s %12s  %-24s %11s  %-14s %-14s %-8s %-9s %s\n", "layout", "median", "   lowest .. highest",
                 "per CPU s", "in range", "visible", "moving", "start, s", "bytes/robot"));
  }
  for (const auto& layout : layouts) {
    ProgressLine progress(true);
    const auto sample = measure_layout(layout, options, progress);
    progress.clear();
    if (options.json) report[layout.name] = json_of(sample);
    else print(row_text(layout, sample));
  }
  if (options.json) print(report.dump(2) + "\n");
  else
    print(
        format("\nin range, visible: neighbours per robot at the first and last tick of a window. %d windows of %g s\n"
               "or of a whole mission.\n"
               "per CPU s: the median per second of processor time, for machines that are busy otherwise.\n",
               options.windows, options.window_s));
  return exit_done;
}

}  // namespace

void add_bench(CLI::App& command, CommandAction& action) {
  auto options = std::make_shared<BenchOptions>();
  command.footer(
      "Layouts: dense-94-los (94 moving robots, about 85 in range of each), spread-94-los,\n"
      "spread-1000-los and spread-10000-los (7 neighbours each); and whole missions with convoy, mission-94\n"
      "(paper-large, 300 s), mission-1000 (benchmark-1000, 60 s) and mission-10000 (benchmark-10000, 15 s). All with\n"
      "line of sight, one thread, the full controller and all metrics at every tick.\n\n"
      "Examples:\n"
      "  banyan bench\n"
      "  banyan bench mission-94 --algorithm inwards\n"
      "  banyan bench --json > today.json");
  command.add_option("layouts", options->only, "only these layouts")->type_name("LAYOUT");
  command.add_option("--algorithm", options->algorithm, "run every layout with this one instead of the layout's own")
      ->type_name("NAME");
  command.add_flag("--json", options->json, "print the figures as JSON");
  command.add_option("--windows", options->windows, "measured windows per layout, default 7")
      ->type_name("N")
      ->check(whole_within(1, 1000));
  command
      .add_option("--window", options->window_s,
                  "length of a window, s of wall time, default 0.7; a mission is measured whole")
      ->type_name("S")
      ->check(number_within(0.01, 600.0));
  command.callback([options, &action] { action = [options] { return bench_command(*options); }; });
}

}  // namespace banyan::cli
