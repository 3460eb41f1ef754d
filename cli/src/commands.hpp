// SPDX-License-Identifier: MIT
// The commands of the program, one function and one struct of options each; main.cpp fills the
// structs. Each returns an exit code and throws CommandError or record::FileError if something
// fails.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "banyan/config/config.hpp"

namespace banyan::cli {

struct RunOptions {
  std::string scenario;
  std::vector<config::Override> overrides;  // --set, --seed, --series, ... in the order given
  std::string out;                          // "": out/<name>-<algorithm>-<seed>
  bool json = false;
  bool quiet = false;
  bool force = false;
  int threads = 0;  // 0: by the number of robots
};
int run_command(const RunOptions& options);

// Of a scenario whose robots are processes (docs/robots.md).
struct HubOptions {
  RunOptions run;
  std::string listen = "0.0.0.0:4600";
  std::string key_file;
  std::string poses;          // ADDRESS:PORT at which a tracker's poses arrive; "": bodies are simulated
  std::string tape;           // file; "": none
  bool resume = false;        // go on where the tape ends
  double wait_s = 10.0;       // for robots, before the mission begins
  double dead_after_s = 5.0;  // a robot that is silent for so long counts as dead
  double speed = 1.0;
  std::size_t bundle = 1;     // packets heard per datagram
  bool view = false;          // the page beside it
  std::string impairment;     // a line of the summary: what makes the radio bad, and how
  bool print_robots = false;  // their command lines, instead
  std::string new_key;        // make this file, instead
  std::string stop;           // ADDRESS:PORT[,...] of robots without a hub: stop them, instead
};
int hub_command(const HubOptions& options);

// Of a scenario whose robots are processes without a hub.
struct ListenOptions {
  RunOptions run;
  std::string listen = "0.0.0.0:4700";
  std::string key_file;
  double wait_s = 10.0;  // for robots, before the recording begins
  double dead_after_s = 5.0;
  double speed = 1.0;
  bool view = false;  // the page beside it
};
int listen_command(const ListenOptions& options);

// Becomes banyan-robot.
int robot_command(const std::vector<std::string>& arguments);
// Becomes banyan-ros2.
int ros2_command(const std::vector<std::string>& arguments);

struct FleetOptions {
  RunOptions run;
  bool loopback = false;  // no network namespaces
  bool restart = true;    // robots that end unasked
  bool view = false;      // the page beside it
  double speed = 1.0;
  std::size_t bundle = 1;
  double loss = 0.0;  // from here on: of the way from robot to robot
  double delay_ms = 0.0;
  double jitter_ms = 0.0;
  double duplicate = 0.0;
  double reorder = 0.0;
  double rate_kbit_s = 0.0;         // of each robot, either way; 0: no limit
  std::string impairment = "auto";  // who does that: "netem", "relay"; "auto": netem where it can be had
};
int fleet_command(const FleetOptions& options);

// An experiment for ARGoS (docs/argos.md).
struct ArgosOptions {
  std::string scenario;
  std::vector<config::Override> overrides;
  std::string output;  // the .argos file; the world goes beside it
  std::string out;     // directory of its results; "": beside it, without the ending
  std::string robot = "kheperaiv";
  std::string sight = "stock";        // or "exact"
  std::string obstacles = "sensors";  // or "world"
  std::string library;                // "": the one that was built with this program
  bool force = false;
};
int argos_command(const ArgosOptions& options);

struct ExportOptions {
  std::string recording;
  std::string output = "-";  // "-": standard output
  double from_s = 0.0;
  double to_s = std::numeric_limits<double>::infinity();
  std::size_t every = 1;
  bool csv = true;  // the only format there is
  bool force = false;
};
int export_command(const ExportOptions& options);

struct DrawOptions {
  std::string recording;
  std::string output = "-";
  std::string format;                                     // "svg" or "png"; "": by the ending of `output`
  double at_s = std::numeric_limits<double>::infinity();  // the end
  double trail_s = 10.0;
  double width_px = 1000.0;
  bool links = true;
  bool blocked = false;
  bool ids = false;
  bool legend = true;
  bool dark = false;
  bool force = false;
};
int draw_command(const DrawOptions& options);

struct FilmOptions {
  std::string recording;
  std::string output;
  int fps = 0;         // 0: 30, of a GIF 15
  double speed = 0.0;  // seconds of the run in a second of the film; 0: chosen (film.cpp)
  double from_s = 0.0;
  double to_s = std::numeric_limits<double>::infinity();
  int width = 0, height = 0;  // px, even; 0: 1280 x 720, of a GIF 720 x 450
  double trail_s = 5.0;
  bool links = true;
  bool blocked = false;
  bool ids = false;
  bool legend = true;
  bool dark = false;
  bool quiet = false;
  bool force = false;
};
int film_command(const FilmOptions& options);

struct ViewOptions {
  std::string file;                         // a recording or a scenario; "": neither
  std::vector<config::Override> overrides;  // of the scenario
  std::string page;                         // folder; "": BANYAN_PAGE, else where it was installed
  std::string scenarios;                    // folder; "": where they were when this was built, or were installed
  int port = 0;                             // 0: any that is free
  bool open = true;                         // in a browser
  bool wait = false;                        // until the recording has begun
};
int view_command(const ViewOptions& options);

struct ValidateOptions {
  std::vector<std::string> files;
  std::vector<config::Override> overrides;
  bool json = false;
  bool quiet = false;
  std::string show;  // "toml" or "json": print the complete effective configuration
};
int validate_command(const ValidateOptions& options);

struct AlgorithmsOptions {
  std::string name;  // "": all
  bool json = false;
};
int algorithms_command(const AlgorithmsOptions& options);

struct KeysOptions {
  std::string prefix;
  bool json = false;
  bool markdown = false;
  bool columns = false;
};
int keys_command(const KeysOptions& options);

// For shell completion: what may follow `word` after --set, one candidate per line.
int complete_keys_command(const std::string& word);

struct StudyOptions {
  std::string file;
  std::vector<config::Override> overrides;  // of all runs
  std::string out;                          // "": out/<name>
  int threads = 0;                          // 0: all cores; under mpirun one a process
  std::string shard;                        // "3/8", "": everything
  std::string sbatch;                       // write a job script there instead
  int shards = 16;                          // of that script
  bool dry_run = false;
  bool yes = false;
  bool force = false;
  bool extend = false;
  bool retry = false;
  bool mix_versions = false;
  bool quiet = false;
};
int study_command(const StudyOptions& options);

struct CollectOptions {
  StudyOptions study;
  std::vector<std::string> from;  // more folders with shards
  bool partial = false;
};
int collect_command(const CollectOptions& options);

struct SoakOptions {
  std::string file;  // a scenario to watch instead; "": random missions
  std::uint64_t seed = 1;
  std::uint64_t from = 0;                 // the first mission
  std::optional<std::uint64_t> missions;  // how many; none: as many as there is time for
  double seconds = 0.0;                   // of wall time; 0: until it is stopped, or missions are done
  std::string out;                        // "": out/soak-<seed>
  int threads = 0;                        // missions at once; 0: all cores
  bool whole = false;                     // missions with findings are kept as they are
  bool force = false;
  bool quiet = false;
};
int soak_command(const SoakOptions& options);

struct BenchOptions {
  bool json = false;
  int windows = 7;                // measured windows per layout
  double window_s = 0.7;          // wall time of one; a mission is measured whole
  std::string algorithm;          // "": each layout's own
  std::vector<std::string> only;  // names of layouts; empty: all
};
int bench_command(const BenchOptions& options);

struct TuneOptions {
  std::string file;
  std::string out;  // "": out/<name>
  int threads = 0;  // 0: all cores; under mpirun 1 per process
  bool force = false;
  bool quiet = false;
  bool dry_run = false;
};
int tune_command(const TuneOptions& options);

}  // namespace banyan::cli
