// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/robot_options.hpp"

#include "banyan/hosts/udp/command_line.hpp"
#include "banyan/hosts/udp/envelope.hpp"
#include "banyan/hosts/udp/mavlink_base.hpp"

namespace banyan::udp {
namespace {

void add_parameters(CLI::App& app, std::vector<std::pair<std::string, double>>& parameters) {
  constexpr double most = 1e9;
  app.add_option_function<std::vector<std::string>>(
         "--set",
         [&parameters](const std::vector<std::string>& assignments) {
           for (const std::string& text : assignments)
             parameters.emplace_back(text.substr(0, text.find('=')),
                                     std::strtod(text.c_str() + text.find('=') + 1, nullptr));
         },
         "a parameter of the algorithm, such as safe_range=0.85; may be repeated")
      ->type_name("KEY=VALUE")
      ->type_size(1)
      ->allow_extra_args(false)
      ->expected(1, 10000)
      ->take_all()
      ->check({[](const std::string& text) {
                 const std::size_t equals = text.find('=');
                 return equals == std::string::npos ? "must be KEY=VALUE, not \"" + text + "\""
                                                    : number_fault(text.substr(equals + 1), -most, most);
               },
               ""})
      ->default_function([&parameters] {
        std::string lines;
        for (const auto& [key, value] : parameters) lines += key + "=" + number_text(value) + "\n";
        return lines;
      });
}

void add_options(CLI::App& app, RobotOptions& o) {
  Platform& platform = o.setup.platform;
  add_number(app, "--id", o.id, 0, most_fleet_robots - 1, "id of this robot, from 0; required", true);
  add_text(app, "--hub", "ADDRESS:PORT", o.hub, "where the hub is; this or --peers is required");
  add_text(app, "--peers", "ADDRESSES", o.peers,
           "without a hub: ADDRESS:PORT of every other robot, separated by commas, or of a broadcast; needs --base");
  add_text(app, "--listen", "ADDRESS:PORT", o.listen, "where its peers find it; required with --peers");
  add_text(app, "--tell", "ADDRESS:PORT", o.tell,
           "with --peers: report there to banyan listen what it does and sees, to be recorded");
  add_flag(app, "--root", o.root, true, "with --peers: it is the first root; exactly one robot is");
  add_flag(app, "--worker", o.worker, true, "with --peers: it will be sent to a target");
  add_text(app, "--key", "FILE", o.key_file, "the fleet's keys; required");
  add_text(app, "--base", "BASE", o.base,
           "what it drives on: tcp:ADDRESS:PORT or a serial device; mavlink:udp:ADDRESS:PORT, mavlink:tcp:ADDRESS:PORT "
           "or mavlink:DEVICE[@BAUD] for an autopilot; default the hub's simulated wheels");
  add_number(app, "--system", o.system, 1, 255, "MAVLink system id of its autopilot; default the robot's id plus 1",
             true);
  add_number(app, "--height", o.height_m, 0.0, 1e4,
             "height that its autopilot is to keep above the origin of its local frame, m; required with mavlink:");
  add_text(app, "--home", "HOME", o.home,
           "where that origin is in the scenario: a file with lines ROBOT EAST NORTH, in m; LATITUDE,LONGITUDE of the "
           "scenario's origin; or tracker, if one sees it; required with mavlink:");
  add_text(app, "--poses", "ADDRESS:PORT", o.poses,
           "the hub's --poses, which is told where it is; required with mavlink: unless --home is tracker");
  add_text(app, "--algorithm", "NAME", o.algorithm, "default convoy");
  add_number(app, "--max-payload", o.max_payload, 1, 65535,
             "bytes that a packet of its radio carries: an algorithm with longer messages is refused; default any",
             true);
  add_text(app, "--reading", "NAME", o.setup.reading, "corrected, the default, or literal");
  add_number(app, "--range", platform.communication_range_m, 1e-3, 1e4, "C, how far the radio reaches, m; default 2");
  add_number(app, "--tick", platform.tick_s, 1e-3, 10.0, "control period, s; default 0.1");
  add_number(app, "--wheel-limit", platform.wheel_limit_m_s, 1e-4, 100.0, "largest speed of a wheel, m/s; default 0.2");
  add_number(app, "--wheel-distance", platform.wheel_distance_m, 1e-4, 100.0,
             "distance between the wheels, m; default 0.1054");
  add_number(
      app, "--radius", platform.body_radius_m, 1e-3, 100.0,
      "radius of a robot's body, m; what a base sees where a robot was heard is not an obstacle; default 0.0704");
  add_number(app, "--proximity", o.proximity_m, 1e-3, 1e3,
             "what its base sees farther from its middle is no obstacle yet, m; for a lidar; default none is too far");
  add_number(app, "--arrival", o.setup.arrival_distance_m, 1e-4, 1e3,
             "how near to a target it has arrived, m; default 0.2");
  add_number(app, "--link-redundancy", o.setup.link_redundancy, 1, 3,
             "paths between any two targets that share no other robot, 1 to 3; default 1", true);
  add_flag(app, "--holonomic", platform.drive, Drive::holonomic, "it can move sideways");
  add_flag(app, "--no-line-of-sight", platform.line_of_sight, false, "the radio goes through bodies");
  add_parameters(app, o.setup.parameters);
  add_number(app, "--stop-after", o.stop_after_s, 0.05, 3600.0,
             "it stands still after this long without a word from the hub or, with --peers, from its base, s; default "
             "0.5");
  add_number(app, "--delay", o.delay_s, 0.0, 1.0,
             "time from a measurement of the tracker to its arrival, s; matters with --base; default 0");
  add_number(app, "--speed", o.speed, 1e-2, 1e3, "speed of its clock, default 1; for tests");
}

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

void check_autopilot(const RobotOptions& options) {
  if (!is_mavlink(options.base)) {
    if (options.system > 0 || options.height_m >= 0.0 || !options.home.empty() || !options.poses.empty())
      throw OptionError("--system, --height, --home and --poses need an autopilot: --base mavlink:...");
    return;
  }
  if (!options.peers.empty())
    throw OptionError(
        "--peers needs a base that measures where other robots are; an autopilot does not: fly with a hub");
  if (options.speed < 1.0) throw OptionError("--speed below 1 would slow set-points down, too; leave it out");
  if (options.system == 0 && options.id >= 255)
    throw OptionError("--system is missing: without it, it is the id plus 1, and MAVLink's ids end at 255");
  if (options.height_m < 0.0)
    throw OptionError("--height is missing: what height its autopilot is to keep above its origin, m");
  if (options.home.empty())
    throw OptionError(
        "--home is missing: where the local frame of its autopilot begins; a file with lines ROBOT EAST NORTH, "
        "LATITUDE,LONGITUDE of the scenario's origin, or tracker");
  if (options.home == "tracker" && !options.poses.empty())
    throw OptionError("--home tracker and --poses exclude each other: either a tracker tells the hub, or the robot");
  if (options.home != "tracker" && options.poses.empty())
    throw OptionError(
        "--poses is missing: ADDRESS:PORT of the hub's --poses; or --home tracker, if one sees the robot");
}

}  // namespace

std::string robot_usage() {
  CLI::App app("banyan-robot: one robot of a fleet (docs/robots.md)", "banyan-robot");
  RobotOptions usual;
  add_options(app, usual);
  return app.help();
}

RobotOptions parse_robot_options(std::span<const std::string> arguments) {
  CLI::App app;
  RobotOptions parsed;
  add_options(app, parsed);
  read_arguments(app, arguments);
  if (parsed.id == nobody) throw OptionError("--id is missing");
  check_who_guides(parsed);
  check_autopilot(parsed);
  if (parsed.key_file.empty()) throw OptionError("--key is missing");
  return parsed;
}

std::vector<std::string> to_arguments(const RobotOptions& wanted) {
  CLI::App now, usual;
  RobotOptions as_wanted = wanted, by_default;
  add_options(now, as_wanted);
  add_options(usual, by_default);
  return written_arguments(now, usual);
}

}  // namespace banyan::udp
