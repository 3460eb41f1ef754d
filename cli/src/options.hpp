// SPDX-License-Identifier: MIT
// What the options of several commands have in common.
#pragma once

#include <CLI/CLI.hpp>

#include <cstdint>
#include <string>
#include <vector>

#include "banyan/config/config.hpp"

namespace banyan::cli {

// Of `run`, and of what else ends in the results of a run.
struct RunOptions {
  std::string scenario;
  std::vector<config::Override> overrides;  // --set, --seed, --series, ... in the order given
  std::string out;                          // "": out/<name>-<algorithm>-<seed>
  bool json = false;
  bool quiet = false;
  bool force = false;
  int threads = 0;  // 0: by the number of robots
};

// --set and --with, in the order given; --seed, which is short for one.
void add_overrides(CLI::App& command, std::vector<config::Override>& overrides);
void add_seed(CLI::App& command, std::vector<config::Override>& overrides);
// All but the scenario and the threads.
void add_results(CLI::App& command, RunOptions& options);

// A shell's empty variable is no name.
[[nodiscard]] CLI::Validator a_name();
// CLI11's own checks take nan for any number, and speak of a value that is not in range.
[[nodiscard]] CLI::Validator number_within(double least, double most);
[[nodiscard]] CLI::Validator whole_within(std::int64_t least, std::int64_t most);
[[nodiscard]] CLI::Validator moment();

// What `draw` and `film` have in common.
template <class Options> void add_look(CLI::App& command, Options& options) {
  command.add_flag("--links,!--no-links", options.links, "show or leave out radio links; default: show");
  command.add_flag("--blocked", options.blocked, "show pairs in range without a line of sight");
  command.add_flag("--ids", options.ids, "number the robots");
  command.add_flag("!--no-legend", options.legend, "leave out the legend");
  command.add_flag("--dark", options.dark, "light on dark");
}

// Of what has `view`.
template <class Options> void add_page_beside(CLI::App& command, Options& options) {
  command.add_flag("--view", options.view, "show it live in the browser; the page stays until Ctrl-C");
}

// Of what has `ros2`.
template <class Options> void add_ros2(CLI::App& command, Options& options) {
  command.add_flag("--ros2", options.ros2, "show it in ROS 2, which may add targets and kill robots (docs/ros2.md)");
}

// How long robots may be silent, at first and later.
template <class Options> void add_patience(CLI::App& command, Options& options) {
  command.add_option("--wait", options.wait_s, "how long to wait for robots at first, s; default 10")
      ->type_name("S")
      ->check(moment());
  command
      .add_option("--dead-after", options.dead_after_s,
                  "a robot that is silent for this long counts as dead, s; default 5")
      ->type_name("S")
      ->check(number_within(0.5, 1e6));
}

// Who belongs to a fleet.
template <class Options> void add_members(CLI::App& command, Options& options) {
  command
      .add_option("--names", options.names,
                  "names of the robots, each ending in its id: cf_1,cf_7 or robot_{01-09}; default their ids, from 0")
      ->type_name("NAMES");
  command.add_option("--room", options.room, "so many robots may join later; default 16")
      ->type_name("N")
      ->check(whole_within(0, 1000));
}

template <class Options> void add_pace(CLI::App& command, Options& options) {
  command.add_option("--speed", options.speed, "speed of all clocks, default 1; for tests")
      ->type_name("X")
      ->check(number_within(0.01, 100.0));
  command.add_option("--bundle", options.bundle, "most packets in one datagram to a robot; default 1, as on a radio")
      ->type_name("N")
      ->check(whole_within(1, 64));
}

}  // namespace banyan::cli
