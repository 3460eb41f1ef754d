// SPDX-License-Identifier: MIT
#include "banyan/hosts/ros2/options.hpp"

#include <cctype>
#include <sstream>

#include "banyan/hosts/ros2/names.hpp"
#include "banyan/hosts/udp/command_line.hpp"
#include "banyan/hosts/udp/roster.hpp"

namespace banyan::ros2 {
namespace {

using udp::add_flag;
using udp::add_number;
using udp::add_text;
using udp::OptionError;

constexpr double most_robots = 1000, largest_id = 60000, largest_domain = 232;

void add_options(CLI::App& app, Options& o) {
  add_number(app, "--robots", o.robots, 1, most_robots,
             "number of robots, with ids from 0; this, --names or --id is required", true);
  add_text(app, "--names", "NAMES", o.names,
           "robots with these names, as of banyan hub, their ids one after the other: cf_{01-09}; {} is then the name");
  add_number(app, "--id", o.first, 0, largest_id, "one robot alone, with this id", true);
  add_text(app, "--poses", "ADDRESS:PORT", o.poses, "send where robots are to banyan hub --poses there");
  add_text(app, "--bases", "ADDRESS:PORT", o.bases,
           "be the base of robot i for banyan-robot --base tcp:ADDRESS:(PORT + i); with --id, at PORT itself");
  add_text(app, "--pose", "TOPIC", o.pose_topic,
           "geometry_msgs/PoseStamped in --frame; default /robot_{}/pose if there is no --odometry");
  add_text(app, "--odometry", "TOPIC", o.odometry_topic,
           "nav_msgs/Odometry, for the base; without --pose also where the robot is, and then in --frame");
  add_text(app, "--cmd-vel", "TOPIC", o.command_topic, "geometry_msgs/Twist; default /robot_{}/cmd_vel");
  add_flag(app, "--stamped", o.stamped, true, "commands are geometry_msgs/TwistStamped");
  add_text(app, "--frame", "NAME", o.frame, "frame in which the scenario has its targets; default map");
  add_text(app, "--body-frame", "NAME", o.body_frame, "a robot's frame in /tf; default robot_{}/base_link");
  add_flag(app, "--no-tf", o.tf, false, "publish no tf2_msgs/TFMessage on /tf");
  add_number(app, "--max-age", o.max_age_s, 0.0, 3600.0,
             "largest age of a pose, s; default 0.3; 0: stamps are not compared with this computer's clock");
  add_text(app, "--node", "NAME", o.node, "name of this node; default banyan_ros2");
  add_number(app, "--domain", o.domain, 0, largest_domain, "DDS domain; default ROS_DOMAIN_ID, otherwise 0", true);
  add_flag(app, "--localhost", o.localhost, true,
           "talk to this computer alone, as with ROS_LOCALHOST_ONLY=1 or ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST");
  add_flag(
      app, "--humble", o.humble, true,
      "be seen by ros2 node list of ROS 2 Humble and older, and not by newer ones; so if ROS_DISTRO is one of them");
  app.add_option("--swarm", o.swarm)->group("");  // of banyan run --ros2, which starts this
}

// As ROS 2 has them: separated by semicolons.
std::vector<std::string> peers_of(const std::string& list) {
  std::vector<std::string> peers;
  std::istringstream words(list);
  for (std::string peer; std::getline(words, peer, ';');) {
    if (peer.empty()) continue;
    for (const char c : peer)
      if (std::isalnum(static_cast<unsigned char>(c)) == 0 &&
          std::string_view(".-_:").find(c) == std::string_view::npos)
        throw OptionError("ROS_STATIC_PEERS has \"" + peer +
                          "\", which is no address; expected are addresses with ; between them");
    peers.push_back(peer);
  }
  return peers;
}

// What the environment says comes first, as options that are given may say otherwise.
Options from_environment(const Environment& environment) {
  const auto value = [&](const char* name) {
    const char* text = environment(name);
    return std::string(text == nullptr ? "" : text);
  };
  Options options;
  if (const std::string domain = value("ROS_DOMAIN_ID"); !domain.empty()) {
    const std::string fault = udp::number_fault(domain, 0, largest_domain, true);
    if (!fault.empty()) throw OptionError("ROS_DOMAIN_ID " + fault);
    options.domain = static_cast<std::uint32_t>(std::strtod(domain.c_str(), nullptr));
  }
  options.localhost = value("ROS_LOCALHOST_ONLY") == "1" || value("ROS_AUTOMATIC_DISCOVERY_RANGE") == "LOCALHOST";
  options.peers = peers_of(value("ROS_STATIC_PEERS"));
  const std::string distribution = value("ROS_DISTRO");
  for (const char* old : {"foxy", "galactic", "humble"}) options.humble |= distribution == old;
  return options;
}

// Whether names of this pattern differ from robot to robot.
bool tells_apart(const std::string& pattern) { return of_robot(pattern, 0) != of_robot(pattern, 1); }

// In names of topics and frames, robots are called by their names.
void take_names(const CLI::App& app, Options& options) {
  if (options.robots > 0 || app.count("--id") > 0)
    throw OptionError("--names, --robots and --id exclude each other: give one of them");
  const udp::Roster roster(options.names);
  options.first = roster.id(0);
  options.robots = roster.size();
  const std::string& first = roster.name(0);
  const std::size_t begin = first.find_last_not_of("0123456789") + 1, digits = first.size() - begin;
  const std::string call =
      first.substr(0, begin) + (digits == 0 ? "" : "{:0" + std::to_string(std::min<std::size_t>(digits, 9)) + "}");
  for (std::size_t k = 0; k < roster.size(); ++k)
    if (roster.id(k) != options.first + k || roster.name(k) != of_robot(call, roster.id(k)))
      throw OptionError("--names: \"" + roster.name(k) +
                        "\" is not next in a row; names here are numbered one after the other, as cf_{01-09}");
  if (app.count("--cmd-vel") == 0) options.command_topic = "/{}/cmd_vel";
  if (app.count("--body-frame") == 0) options.body_frame = "{}/base_link";
  for (std::string* pattern :
       {&options.pose_topic, &options.odometry_topic, &options.command_topic, &options.body_frame})
    for (std::size_t at = pattern->find("{}"); at != std::string::npos; at = pattern->find("{}", at + call.size()))
      pattern->replace(at, 2, call);
}

void check_topic(const char* option, const std::string& pattern, std::size_t robots) {
  if (pattern.empty()) return;
  if (const std::string fault = topic_fault(of_robot(pattern, 0)); !fault.empty())
    throw OptionError(std::string(option) + " \"" + pattern + "\" " + fault);
  if (robots > 1 && !tells_apart(pattern))
    throw OptionError(std::string(option) + " \"" + pattern + "\" must have {} where the robot's id belongs");
}

void check(const Options& options) {
  if (options.robots == 0) throw OptionError("--robots, --names or --id is missing");
  if (options.poses.empty() && options.bases.empty())
    throw OptionError("--poses, --bases or both are missing: there is nothing to do");
  check_topic("--pose", options.pose_topic, options.robots);
  check_topic("--odometry", options.odometry_topic, options.robots);
  check_topic("--cmd-vel", options.command_topic, options.robots);
  if (options.command_topic.empty() && !options.bases.empty()) throw OptionError("--cmd-vel must not be empty");
  if (options.frame.empty()) throw OptionError("--frame must not be empty");
  if (options.tf && options.robots > 1 && !tells_apart(options.body_frame))
    throw OptionError("--body-frame \"" + options.body_frame + "\" must have {} where the robot's id belongs");
  if (const std::string fault = node_fault(options.node); !fault.empty())
    throw OptionError("--node \"" + options.node + "\" " + fault);
}

}  // namespace

std::string usage() {
  CLI::App app(
      "banyan-ros2: robots and tracker of ROS 2 for banyan hub and banyan-robot (docs/ros2.md)\n"
      "{} in a name stands for a robot's id, {:02} for the same with two digits.",
      "banyan-ros2");
  Options usual;
  add_options(app, usual);
  return app.help();
}

Options parse_options(std::span<const std::string> arguments, const Environment& environment) {
  CLI::App app;
  Options options = from_environment(environment);
  add_options(app, options);
  udp::read_arguments(app, arguments);
  if (options.pose_topic.empty() && options.odometry_topic.empty())
    options.pose_topic = options.names.empty() ? "/robot_{}/pose" : "/{}/pose";
  if (!options.names.empty()) take_names(app, options);
  if (app.count("--id") > 0) {
    if (options.robots > 0) throw OptionError("--robots and --id exclude each other: give one of the two");
    options.robots = 1;
  }
  if (options.swarm >= 0) {
    options.node = "banyan";
    return options;
  }
  check(options);
  return options;
}

}  // namespace banyan::ros2
