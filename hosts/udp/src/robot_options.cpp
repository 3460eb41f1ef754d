// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/robot_options.hpp"

#include "banyan/hosts/udp/envelope.hpp"

namespace banyan::udp {
namespace {

using Option = OptionRow<RobotOptions>;

template <class Get> Option real(const char* name, const char* meaning, double least, double most, Get get) {
  return real_option<RobotOptions>(name, meaning, least, most, get);
}
template <class Get> Option text(const char* name, const char* form, const char* meaning, Get get) {
  return text_option<RobotOptions>(name, form, meaning, get);
}
constexpr auto flag = flag_option<RobotOptions>;

void set_parameter(RobotOptions& options, const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos) throw OptionError("must be KEY=VALUE, not \"" + assignment + "\"");
  options.setup.parameters.emplace_back(assignment.substr(0, equals),
                                        option_number(assignment.substr(equals + 1), -1e9, 1e9));
}

std::vector<std::string> parameters_of(const RobotOptions& options) {
  std::vector<std::string> list;
  for (const auto& [key, value] : options.setup.parameters) list.push_back(key + "=" + option_text(value));
  return list;
}

const std::vector<Option>& options() {
  static const std::vector<Option> list = {
      {"--id", "N", "id of this robot, from 0; required",
       [](RobotOptions& o, const std::string& value) {
         o.id = static_cast<RobotId>(option_whole_number(value, 0, most_fleet_robots - 1));
       },
       [](const RobotOptions& o) { return std::vector{std::to_string(o.id)}; }},
      text("--hub", "ADDRESS:PORT", "where the hub is; this or --peers is required",
           [](RobotOptions& o) -> std::string& { return o.hub; }),
      text("--peers", "ADDRESSES",
           "without a hub: ADDRESS:PORT of every other robot, separated by commas, or of a broadcast; needs --base",
           [](RobotOptions& o) -> std::string& { return o.peers; }),
      text("--listen", "ADDRESS:PORT", "where its peers find it; required with --peers",
           [](RobotOptions& o) -> std::string& { return o.listen; }),
      text("--tell", "ADDRESS:PORT",
           "with --peers: report there to banyan listen what it does and sees, to be recorded",
           [](RobotOptions& o) -> std::string& { return o.tell; }),
      flag(
          "--root", "with --peers: it is the first root; exactly one robot is",
          [](const RobotOptions& o) { return o.root; }, [](RobotOptions& o) { o.root = true; }),
      flag(
          "--worker", "with --peers: it will be sent to a target", [](const RobotOptions& o) { return o.worker; },
          [](RobotOptions& o) { o.worker = true; }),
      text("--key", "FILE", "the fleet's keys; required", [](RobotOptions& o) -> std::string& { return o.key_file; }),
      text("--base", "BASE",
           "what it drives on: tcp:ADDRESS:PORT or a serial device; default the hub's simulated wheels",
           [](RobotOptions& o) -> std::string& { return o.base; }),
      text("--algorithm", "NAME", "default convoy", [](RobotOptions& o) -> std::string& { return o.algorithm; }),
      text("--reading", "NAME", "corrected, the default, or literal",
           [](RobotOptions& o) -> std::string& { return o.setup.reading; }),
      real("--range", "C, how far the radio reaches, m; default 2", 1e-3, 1e4,
           [](RobotOptions& o) -> float& { return o.setup.platform.communication_range_m; }),
      real("--tick", "control period, s; default 0.1", 1e-3, 10.0,
           [](RobotOptions& o) -> float& { return o.setup.platform.tick_s; }),
      real("--wheel-limit", "largest speed of a wheel, m/s; default 0.2", 1e-4, 100.0,
           [](RobotOptions& o) -> float& { return o.setup.platform.wheel_limit_m_s; }),
      real("--wheel-distance", "distance between the wheels, m; default 0.1054", 1e-4, 100.0,
           [](RobotOptions& o) -> float& { return o.setup.platform.wheel_distance_m; }),
      real("--radius",
           "radius of a robot's body, m; what a base sees where a robot was heard is not an obstacle; default 0.0704",
           1e-3, 100.0, [](RobotOptions& o) -> float& { return o.setup.platform.body_radius_m; }),
      real("--arrival", "how near to a target it has arrived, m; default 0.2", 1e-4, 1e3,
           [](RobotOptions& o) -> double& { return o.setup.arrival_distance_m; }),
      {"--link-redundancy", "K", "paths between any two targets that share no other robot, 1 to 3; default 1",
       [](RobotOptions& o, const std::string& value) {
         o.setup.link_redundancy = static_cast<int>(option_whole_number(value, 1, 3));
       },
       [](const RobotOptions& o) {
         return o.setup.link_redundancy == 1 ? std::vector<std::string>{}
                                             : std::vector{std::to_string(o.setup.link_redundancy)};
       }},
      flag(
          "--holonomic", "it can move sideways",
          [](const RobotOptions& o) { return o.setup.platform.drive == Drive::holonomic; },
          [](RobotOptions& o) { o.setup.platform.drive = Drive::holonomic; }),
      flag(
          "--no-line-of-sight", "the radio goes through bodies",
          [](const RobotOptions& o) { return !o.setup.platform.line_of_sight; },
          [](RobotOptions& o) { o.setup.platform.line_of_sight = false; }),
      {"--set", "KEY=VALUE", "a parameter of the algorithm, such as safe_range=0.85; may be repeated", set_parameter,
       parameters_of, true},
      real(
          "--stop-after",
          "it stands still after this long without a word from the hub or, with --peers, from its base, s; default 0.5",
          0.05, 3600.0, [](RobotOptions& o) -> double& { return o.stop_after_s; }),
      real("--delay", "time from a measurement of the tracker to its arrival, s; matters with --base; default 0", 0.0,
           1.0, [](RobotOptions& o) -> double& { return o.delay_s; }),
      real("--speed", "speed of its clock, default 1; for tests", 1e-2, 1e3,
           [](RobotOptions& o) -> double& { return o.speed; }),
  };
  return list;
}

}  // namespace

std::string robot_usage() {
  return "banyan-robot: one robot of a fleet (docs/robots.md)\n\n" + option_usage<RobotOptions>(options());
}

namespace {

void check_who_guides(const RobotOptions& options) {
  if (options.hub.empty() && options.peers.empty()) throw OptionError("--hub or --peers is missing");
  if (!options.hub.empty() && !options.peers.empty()) throw OptionError("--hub and --peers exclude each other");
  if (options.peers.empty()) {
    if (!options.listen.empty() || options.root || options.worker)
      throw OptionError("--listen, --root and --worker need --peers: the hub says how robots begin");
    if (!options.tell.empty()) throw OptionError("--tell needs --peers: the hub records by itself");
    return;
  }
  if (options.base.empty()) throw OptionError("--peers needs --base, which measures where other robots are");
  if (options.listen.empty()) throw OptionError("--peers needs --listen");
}

}  // namespace

RobotOptions parse_robot_options(std::span<const std::string> arguments) {
  RobotOptions parsed = read_options<RobotOptions>(options(), arguments);
  if (parsed.id == nobody) throw OptionError("--id is missing");
  check_who_guides(parsed);
  if (parsed.key_file.empty()) throw OptionError("--key is missing");
  return parsed;
}

std::vector<std::string> to_arguments(const RobotOptions& wanted) {
  return written_options<RobotOptions>(options(), wanted);
}

}  // namespace banyan::udp
