// SPDX-License-Identifier: MIT
#include "banyan/hosts/ros2/options.hpp"
#include "banyan/hosts/ros2/names.hpp"

#include <gtest/gtest.h>

#include <map>
#include <vector>

namespace banyan::ros2 {
namespace {

using Variables = std::map<std::string, std::string>;

Options parsed(const std::vector<std::string>& arguments, const Variables& variables = {}) {
  return parse_options(arguments, [&](const char* name) -> const char* {
    const auto found = variables.find(name);
    return found == variables.end() ? nullptr : found->second.c_str();
  });
}
std::string fault(const std::vector<std::string>& arguments, const Variables& variables = {}) {
  try {
    static_cast<void>(parsed(arguments, variables));
  } catch (const udp::OptionError& error) { return error.what(); }
  return "";
}
const std::vector<std::string> few = {"--robots", "9", "--poses", "127.0.0.1:4700"};
std::vector<std::string> with(std::vector<std::string> more) {
  more.insert(more.begin(), few.begin(), few.end());
  return more;
}

TEST(Ros2Options, PosesUnlessThereIsOdometry) {
  EXPECT_EQ(parsed(few).pose_topic, "/robot_{}/pose");
  EXPECT_EQ(parsed(with({"--odometry", "/robot_{}/odom"})).pose_topic, "");
  const Options both = parsed(with({"--odometry", "/r{}/odom", "--pose", "/r{}/pose"}));
  EXPECT_EQ(both.pose_topic + both.odometry_topic, "/r{}/pose/r{}/odom");
  const Options one = parsed({"--id", "7", "--bases", "127.0.0.1:5000", "--pose", "/pose", "--no-tf"});
  EXPECT_EQ(one.first, 7U);
  EXPECT_EQ(one.robots, 1U);
  EXPECT_FALSE(one.tf);
}

TEST(Ros2Options, TheEnvironmentOfRos2) {
  EXPECT_EQ(parsed(few).domain, 0U);
  EXPECT_EQ(parsed(few, {{"ROS_DOMAIN_ID", "42"}}).domain, 42U);
  EXPECT_EQ(parsed(few, {{"ROS_DOMAIN_ID", ""}}).domain, 0U);
  EXPECT_EQ(parsed(with({"--domain", "3"}), {{"ROS_DOMAIN_ID", "42"}}).domain, 3U);
  EXPECT_FALSE(parsed(few, {{"ROS_LOCALHOST_ONLY", "0"}}).localhost);
  EXPECT_TRUE(parsed(few, {{"ROS_LOCALHOST_ONLY", "1"}}).localhost);
  EXPECT_TRUE(parsed(few, {{"ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST"}}).localhost);
  EXPECT_EQ(parsed(few, {{"ROS_STATIC_PEERS", "192.168.1.20;;robot-3.local"}}).peers,
            (std::vector<std::string>{"192.168.1.20", "robot-3.local"}));
  EXPECT_EQ(fault(few, {{"ROS_STATIC_PEERS", "10.0.0.1;\"/>"}}),
            "ROS_STATIC_PEERS has \"\"/>\", which is no address; expected are addresses with ; between them");
  EXPECT_TRUE(parsed(few, {{"ROS_DISTRO", "humble"}}).humble);
  EXPECT_FALSE(parsed(few, {{"ROS_DISTRO", "jazzy"}}).humble);
  EXPECT_EQ(fault(few, {{"ROS_DOMAIN_ID", "1000"}}), "ROS_DOMAIN_ID must be a number from 0 to 232, not \"1000\"");
}

// A mission that starts it knows how many robots there are, and has no hub or bases to be told of.
TEST(Ros2Options, OfAMissionNothingElseIsAsked) {
  const Options options = parsed({"--swarm", "7"}, {{"ROS_DOMAIN_ID", "42"}});
  EXPECT_EQ(options.swarm, 7);
  EXPECT_EQ(options.domain, 42U);
  EXPECT_EQ(options.node, "banyan");
  EXPECT_EQ(usage().find("--swarm"), std::string::npos);
}

TEST(Ros2Options, RobotsMayHaveNames) {
  const Options plain = parsed({"--names", "cf_{08-10}", "--poses", "127.0.0.1:4700"});
  EXPECT_EQ(plain.first, 8U);
  EXPECT_EQ(plain.robots, 3U);
  EXPECT_EQ(of_robot(plain.pose_topic, 9), "/cf_09/pose");
  EXPECT_EQ(of_robot(plain.command_topic, 10), "/cf_10/cmd_vel");
  EXPECT_EQ(of_robot(plain.body_frame, 8), "cf_08/base_link");
  const Options given = parsed({"--names", "tb{1-3}", "--poses", "127.0.0.1:4700", "--odometry", "/lab/{}/odom"});
  EXPECT_EQ(of_robot(given.odometry_topic, 2), "/lab/tb2/odom");
  EXPECT_EQ(parsed({"--names", "leo", "--poses", "127.0.0.1:4700"}).pose_topic, "/leo/pose");
  const auto refused = [](const std::string& names, const std::vector<std::string>& more = {}) {
    std::vector<std::string> all{"--names", names, "--poses", "127.0.0.1:4700"};
    all.insert(all.end(), more.begin(), more.end());
    return fault(all);
  };
  EXPECT_NE(refused("cf_1,cf_3").find("\"cf_3\" is not next in a row"), std::string::npos) << refused("cf_1,cf_3");
  EXPECT_NE(refused("cf_1,tb2").find("\"tb2\" is not next in a row"), std::string::npos);
  EXPECT_NE(refused("leo,mia").find("is not next in a row"), std::string::npos);
  EXPECT_NE(refused("cf_{1-"), "");
  EXPECT_NE(refused("cf_1", {"--id", "3"}).find("exclude each other"), std::string::npos);
  EXPECT_NE(refused("cf_{1-2}", {"--pose", "/pose"}).find("must have {}"), std::string::npos);
}

TEST(Ros2Options, WhatIsWrongIsSaid) {
  EXPECT_EQ(fault({}), "--robots, --names or --id is missing");
  EXPECT_EQ(fault({"--robots", "9"}), "--poses, --bases or both are missing: there is nothing to do");
  EXPECT_EQ(fault({"--robots", "0"}), "--robots must be a number from 1 to 1000, not \"0\"");
  EXPECT_EQ(fault(with({"--robot", "1"})), "\"--robot\" is unknown; see --help");
  EXPECT_EQ(fault(with({"--pose", "/pose"})), "--pose \"/pose\" must have {} where the robot's id belongs");
  EXPECT_EQ(fault(with({"--pose", "robot_{}/pose"})), "--pose \"robot_{}/pose\" must begin with /");
  EXPECT_EQ(fault(with({"--body-frame", "base_link"})),
            "--body-frame \"base_link\" must have {} where the robot's id belongs");
  EXPECT_EQ(fault(with({"--max-age", "nan"})), "--max-age must be a number from 0 to 3600, not \"nan\"");
  EXPECT_EQ(fault(with({"--node", "a/b"})),
            "--node \"a/b\" must consist of letters, digits and _, and not begin with a digit");
  EXPECT_EQ(fault(with({"--bases", "127.0.0.1:5000", "--cmd-vel", ""})), "--cmd-vel must not be empty");
  EXPECT_EQ(fault(with({"--frame", ""})), "--frame must not be empty");
  EXPECT_EQ(fault({"--id", "1", "--id", "2", "--poses", "127.0.0.1:5000"}), "--id is given twice; give it once");
  EXPECT_EQ(fault(with({"--node", "a", "--node", "b"})), "--node is given twice; give it once");
  EXPECT_EQ(fault({"--robots", "3", "--id", "1"}), "--robots and --id exclude each other: give one of the two");
  EXPECT_EQ(fault({"--id", "1", "--robots", "3"}), "--robots and --id exclude each other: give one of the two");
  EXPECT_NE(usage().find("--max-age"), std::string::npos);
}

}  // namespace
}  // namespace banyan::ros2
