// SPDX-License-Identifier: MIT
#include "banyan/hosts/ros2/options.hpp"

#include <string_view>

#include "banyan/hosts/ros2/names.hpp"

namespace banyan::ros2 {
namespace {

using BridgeOption = udp::OptionRow<Options>;
using udp::OptionError;

constexpr double most_robots = 1000, largest_id = 60000, largest_domain = 232;

template <class Get> BridgeOption text(const char* name, const char* form, const char* meaning, Get get) {
  return udp::text_option<Options>(name, form, meaning, get);
}

BridgeOption whole(const char* name, const char* meaning, double least, double most,
                   const std::function<void(Options&, double)>& set) {
  return {name,
          "N",
          meaning,
          [=](Options& o, const std::string& value) { set(o, udp::option_whole_number(value, least, most)); },
          {}};
}

BridgeOption flag(const char* name, const char* meaning, bool Options::*member, bool value = true) {
  return {name, "", meaning, [=](Options& o, const std::string&) { o.*member = value; }, {}};
}

const std::vector<BridgeOption>& rows() {
  static const std::vector<BridgeOption> list = {
      whole("--robots", "number of robots, with ids from 0; this or --id is required", 1, most_robots,
            [](Options& o, double n) {
              if (o.robots != 0) throw OptionError("cannot be beside --id: give one of the two");
              o.robots = static_cast<std::size_t>(n);
            }),
      whole("--id", "one robot alone, with this id", 0, largest_id,
            [](Options& o, double n) {
              if (o.robots != 0) throw OptionError("cannot be beside --robots: give one of the two");
              o.first = static_cast<std::size_t>(n);
              o.robots = 1;
            }),
      text("--poses", "ADDRESS:PORT", "send where robots are to banyan hub --poses there",
           [](Options& o) -> std::string& { return o.poses; }),
      text("--bases", "ADDRESS:PORT",
           "be the base of robot i for banyan-robot --base tcp:ADDRESS:(PORT + i); with --id, at PORT itself",
           [](Options& o) -> std::string& { return o.bases; }),
      text("--pose", "TOPIC", "geometry_msgs/PoseStamped in --frame; default /robot_{}/pose if there is no --odometry",
           [](Options& o) -> std::string& { return o.pose_topic; }),
      text("--odometry", "TOPIC",
           "nav_msgs/Odometry, for the base; without --pose also where the robot is, and then in --frame",
           [](Options& o) -> std::string& { return o.odometry_topic; }),
      text("--cmd-vel", "TOPIC", "geometry_msgs/Twist; default /robot_{}/cmd_vel",
           [](Options& o) -> std::string& { return o.command_topic; }),
      flag("--stamped", "commands are geometry_msgs/TwistStamped", &Options::stamped),
      text("--frame", "NAME", "frame in which the scenario has its targets; default map",
           [](Options& o) -> std::string& { return o.frame; }),
      text("--body-frame", "NAME", "a robot's frame in /tf; default robot_{}/base_link",
           [](Options& o) -> std::string& { return o.body_frame; }),
      flag("--no-tf", "publish no tf2_msgs/TFMessage on /tf", &Options::tf, false),
      udp::real_option<Options>("--max-age",
                                "largest age of a pose, s; default 0.3; 0: stamps are not compared with this "
                                "computer's clock",
                                0.0, 3600.0, [](Options& o) -> double& { return o.max_age_s; }),
      text("--node", "NAME", "name of this node; default banyan_ros2",
           [](Options& o) -> std::string& { return o.node; }),
      whole("--domain", "DDS domain; default ROS_DOMAIN_ID, otherwise 0", 0, largest_domain,
            [](Options& o, double n) { o.domain = static_cast<std::uint32_t>(n); }),
      flag("--localhost",
           "talk to this computer alone, as with ROS_LOCALHOST_ONLY=1 or ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST",
           &Options::localhost),
      flag("--humble", "be seen by ros2 node list of ROS 2 Humble and older, and not by newer ones", &Options::humble),
  };
  return list;
}

// What the environment says comes first, as options that are given may say otherwise.
Options from_environment(const Environment& environment) {
  const auto value = [&](const char* name) {
    const char* text = environment(name);
    return std::string(text == nullptr ? "" : text);
  };
  Options options;
  try {
    if (const std::string domain = value("ROS_DOMAIN_ID"); !domain.empty())
      options.domain = static_cast<std::uint32_t>(udp::option_whole_number(domain, 0, largest_domain));
  } catch (const OptionError& error) { throw OptionError(std::string("ROS_DOMAIN_ID ") + error.what()); }
  options.localhost = value("ROS_LOCALHOST_ONLY") == "1" || value("ROS_AUTOMATIC_DISCOVERY_RANGE") == "LOCALHOST";
  return options;
}

void check_topic(const char* option, const std::string& pattern, std::size_t robots) {
  if (pattern.empty()) return;
  if (const std::string fault = topic_fault(of_robot(pattern, 0)); !fault.empty())
    throw OptionError(std::string(option) + " \"" + pattern + "\" " + fault);
  if (robots > 1 && pattern.find("{}") == std::string::npos)
    throw OptionError(std::string(option) + " \"" + pattern + "\" must have {} where the robot's id belongs");
}

void check(const Options& options) {
  if (options.robots == 0) throw OptionError("--robots or --id is missing");
  if (options.poses.empty() && options.bases.empty())
    throw OptionError("--poses, --bases or both are missing: there is nothing to do");
  check_topic("--pose", options.pose_topic, options.robots);
  check_topic("--odometry", options.odometry_topic, options.robots);
  check_topic("--cmd-vel", options.command_topic, options.robots);
  if (options.command_topic.empty() && !options.bases.empty()) throw OptionError("--cmd-vel must not be empty");
  if (options.frame.empty()) throw OptionError("--frame must not be empty");
  if (options.tf && options.robots > 1 && options.body_frame.find("{}") == std::string::npos)
    throw OptionError("--body-frame \"" + options.body_frame + "\" must have {} where the robot's id belongs");
  if (const std::string fault = node_fault(options.node); !fault.empty())
    throw OptionError("--node \"" + options.node + "\" " + fault);
}

}  // namespace

std::string usage() {
  return "banyan-ros2: robots and tracker of ROS 2 for banyan hub and banyan-robot (docs/ros2.md)\n\n"
         "  {} in a name stands for a robot's id.\n\n" +
         udp::option_usage<Options>(rows());
}

Options parse_options(std::span<const std::string> arguments, const Environment& environment) {
  Options options = udp::read_options<Options>(rows(), arguments, from_environment(environment));
  if (options.pose_topic.empty() && options.odometry_topic.empty()) options.pose_topic = "/robot_{}/pose";
  check(options);
  return options;
}

}  // namespace banyan::ros2
