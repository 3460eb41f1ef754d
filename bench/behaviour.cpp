// SPDX-License-Identifier: MIT
// Behaviour over the paper's 27 worlds (Sec. IV-B): T in {2, 3, 4} targets on a circle of r in
// {3, 6, 9} m, redundancy k in {2, 3, 4}, many seeds. Prints one row per radius: share complete,
// median normalised time, runs with a broken edge or a split graph, committed robots.
//
//   behaviour [--algorithm outwards|inwards] [--reading corrected|literal] [--seeds N]
//             [--first-seed S] [--los] [--loss P] [--body disks|box2d|linear] [--range C]
//             [--set key=value] [--csv FILE] [--verbose]
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "banyan/measure/observer.hpp"
#include "banyan/world/threads.hpp"

namespace {

using namespace banyan;

struct Options {
  std::string algorithm = "outwards";
  std::string reading = "corrected";
  std::string body = "disks";
  std::string csv;
  std::uint64_t first_seed = 1;
  std::uint64_t seeds = 10;
  bool line_of_sight = false;
  bool verbose = false;
  double loss = 0.0;
  double range_m = 2.0;
  std::vector<std::pair<std::string, double>> parameters;
};

[[noreturn]] void usage(const std::string& word) {
  std::fprintf(stderr, "behaviour: cannot use '%s'; the head of bench/behaviour.cpp lists the options\n", word.c_str());
  std::exit(2);
}

Options parse(int argc, char** argv) {
  Options o;
  for (int a = 1; a < argc; ++a) {
    const std::string word = argv[a];
    const auto value = [&]() -> std::string { return a + 1 < argc ? argv[++a] : (usage(word), ""); };
    if (word == "--algorithm") o.algorithm = value();
    else if (word == "--reading") o.reading = value();
    else if (word == "--body") o.body = value();
    else if (word == "--csv") o.csv = value();
    else if (word == "--first-seed") o.first_seed = std::stoull(value());
    else if (word == "--seeds") o.seeds = std::stoull(value());
    else if (word == "--los") o.line_of_sight = true;
    else if (word == "--verbose") o.verbose = true;
    else if (word == "--loss") o.loss = std::stod(value());
    else if (word == "--range") o.range_m = std::stod(value());
    else if (word == "--set") {
      const std::string pair = value();
      const std::size_t equals = pair.find('=');
      if (equals == std::string::npos) usage(pair);
      o.parameters.emplace_back(pair.substr(0, equals), std::stod(pair.substr(equals + 1)));
    } else usage(word);
  }
  if (o.body != "disks" && o.body != "box2d" && o.body != "linear") usage(o.body);
  return o;
}

struct Job {
  double radius_m;
  std::size_t targets;
  double redundancy;
  std::uint64_t seed;
  measure::Run run;
};

world::Scenario scenario_of(const Job& job, const Options& o) {
  world::Scenario s;
  s.seed = job.seed;
  s.mission.algorithm = o.algorithm;
  s.mission.reading = o.reading;
  s.mission.parameters = o.parameters;
  s.swarm.redundancy = job.redundancy;
  s.robot.body = o.body == "box2d" ? world::BodyModel::box2d : o.body == "linear" ? world::BodyModel::linear : world::BodyModel::disks;
  s.radio.range_m = o.range_m;
  s.radio.line_of_sight = o.line_of_sight;
  s.radio.loss = o.loss;
  s.targets = world::RingTargets{.count = job.targets, .radius_m = job.radius_m};
  return s;
}

void run(Job& job, const Options& o) {
  world::World world(scenario_of(job, o));
  measure::Observer observer(world);
  world::Executor alone(1);
  while (!observer.finished()) {
    world.step(alone);
    observer.observe(world);
  }
  job.run = observer.result(world);
}

double median(std::vector<double> v) {
  if (v.empty()) return -1.0;
  std::sort(v.begin(), v.end());
  return v.size() % 2 == 1 ? v[v.size() / 2] : 0.5 * (v[v.size() / 2 - 1] + v[v.size() / 2]);
}

void summarise(const char* name, const std::vector<Job>& jobs, double radius_m) {
  std::size_t n = 0, complete = 0, distance = 0, occlusion = 0, split = 0, split_distance = 0;
  std::vector<double> time, committed, bound;
  double ratio = 0.0;
  for (const Job& job : jobs) {
    if (radius_m > 0.0 && job.radius_m != radius_m) continue;
    const measure::Run& r = job.run;
    ++n;
    complete += r.complete;
    distance += r.broken_ticks_by_distance > 0;
    occlusion += r.broken_ticks_by_occlusion > 0;
    split += r.split_ticks > 0;
    split_distance += r.split_ticks_by_distance > 0;
    ratio += r.disconnected_time_ratio;
    time.push_back(r.normalized_time);
    committed.push_back(static_cast<double>(r.committed) / r.robots);
    bound.push_back(r.completion_time_s > 0.0 ? r.completion_time_s / r.time_bound_s : 0.0);
  }
  const double d = static_cast<double>(n) / 100.0;
  std::printf("%-6s %5zu %9.2f %8.3f %8.2f %10.1f %10.1f %9.4f %8.1f %8.1f %9.2f\n", name, n, static_cast<double>(complete) / d,
              median(time), median(bound), static_cast<double>(distance) / d, static_cast<double>(occlusion) / d,
              ratio / static_cast<double>(n), static_cast<double>(split) / d, static_cast<double>(split_distance) / d, median(committed));
}

void write_csv(const std::string& path, const std::vector<Job>& jobs) {
  std::ofstream out(path);
  out << "radius_m,targets,redundancy,seed,complete,normalized_time,broken_by_distance,broken_by_occlusion,split,committed,robots,insertions,repairs\n";
  for (const Job& j : jobs)
    out << j.radius_m << ',' << j.targets << ',' << j.redundancy << ',' << j.seed << ',' << j.run.complete << ',' << j.run.normalized_time << ','
        << j.run.broken_ticks_by_distance << ',' << j.run.broken_ticks_by_occlusion << ',' << j.run.split_ticks << ',' << j.run.committed << ','
        << j.run.robots << ',' << j.run.insertions << ',' << j.run.repairs << '\n';
  if (!out) std::fprintf(stderr, "behaviour: could not write %s\n", path.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = parse(argc, argv);
  std::vector<Job> jobs;
  for (const double radius_m : {9.0, 6.0, 3.0})  // the long runs first
    for (const std::size_t targets : {4UL, 3UL, 2UL})
      for (const double redundancy : {4.0, 3.0, 2.0})
        for (std::uint64_t s = 0; s < options.seeds; ++s) jobs.push_back({radius_m, targets, redundancy, options.first_seed + s, {}});
  std::atomic<std::size_t> next{0};
  {
    std::vector<std::jthread> workers;
    for (unsigned w = 0; w < std::max(1U, std::thread::hardware_concurrency()); ++w)
      workers.emplace_back([&] {
        for (std::size_t k = next++; k < jobs.size(); k = next++) run(jobs[k], options);
      });
  }
  std::printf("%s %s, C = %.1f m, %s, line of sight %s, loss %.0f %%, seeds %llu-%llu\n", options.algorithm.c_str(), options.reading.c_str(),
              options.range_m, options.body.c_str(), options.line_of_sight ? "on" : "off", options.loss * 100.0,
              static_cast<unsigned long long>(options.first_seed), static_cast<unsigned long long>(options.first_seed + options.seeds - 1));
  std::printf("radius  runs complete%%  t/limit  t/bound broken-d%% broken-o%% brokentime   split%%  split-d%% commit/N\n");
  summarise("3 m", jobs, 3.0);
  summarise("6 m", jobs, 6.0);
  summarise("9 m", jobs, 9.0);
  summarise("all", jobs, 0.0);
  if (options.verbose)
    for (const Job& j : jobs)
      if (!j.run.complete || j.run.broken_ticks_by_distance > 0 || j.run.split_ticks > 0)
        std::printf("  r=%g T=%zu k=%g seed=%llu complete=%d t=%.3f broken-d=%llu broken-o=%llu split=%llu repairs=%llu\n", j.radius_m, j.targets,
                    j.redundancy, static_cast<unsigned long long>(j.seed), j.run.complete, j.run.normalized_time,
                    static_cast<unsigned long long>(j.run.broken_ticks_by_distance), static_cast<unsigned long long>(j.run.broken_ticks_by_occlusion),
                    static_cast<unsigned long long>(j.run.split_ticks), static_cast<unsigned long long>(j.run.repairs));
  if (!options.csv.empty()) write_csv(options.csv, jobs);
}
