// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/robot_options.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace banyan::udp {
namespace {

const std::vector<std::string> least = {"--id", "3", "--hub", "10.0.0.1:4600", "--key", "k"};

std::vector<std::string> with(std::vector<std::string> more) {
  more.insert(more.begin(), least.begin(), least.end());
  return more;
}
std::string fault(const std::vector<std::string>& arguments) {
  try {
    static_cast<void>(parse_robot_options(arguments));
  } catch (const OptionError& error) { return error.what(); }
  return "";
}

TEST(RobotOptions, WhatIsWrittenIsReadAgain) {
  // Option and value side by side.
  // clang-format off
  const auto arguments = with({"--base", "tcp:1.2.3.4:5", "--algorithm", "outwards", "--max-payload", "61", "--reading", "literal",
                               "--range", "1.7", "--tick", "0.05", "--wheel-limit", "0.13",
                               "--wheel-distance", "0.3", "--radius", "0.09", "--proximity", "0.4", "--arrival", "0.1",
                               "--link-redundancy", "2", "--holonomic", "--no-line-of-sight", "--set",
                               "safe_range=0.7", "--set", "x=0.1", "--stop-after", "0.7", "--delay", "0.02",
                               "--speed", "5"});
  // clang-format on
  const RobotOptions options = parse_robot_options(arguments);
  EXPECT_EQ(to_arguments(options), arguments);
  EXPECT_EQ(options.id, 3);
  EXPECT_EQ(options.setup.platform.communication_range_m, 1.7F);
  EXPECT_EQ(options.setup.platform.drive, Drive::holonomic);
  EXPECT_FALSE(options.setup.platform.line_of_sight);
  EXPECT_EQ(options.setup.link_redundancy, 2);
  EXPECT_EQ(options.setup.parameters.at(1).second, 0.1);
  EXPECT_EQ(to_arguments(parse_robot_options(least)), least);  // defaults are left out
}

TEST(RobotOptions, WithoutAHub) {
  const std::vector<std::string> peers = {
      "--id",     "3",     "--peers", "10.0.0.255:4600", "--listen",     "0.0.0.0:4600", "--root",
      "--worker", "--key", "k",       "--base",          "tcp:1.2.3.4:5"};
  const RobotOptions options = parse_robot_options(peers);
  EXPECT_EQ(to_arguments(options), peers);
  EXPECT_TRUE(options.root && options.worker && options.hub.empty());
  const auto without = [&](const std::string& name) {
    std::vector<std::string> rest = peers;
    const auto at = std::find(rest.begin(), rest.end(), name);
    rest.erase(at, at + 2);
    return fault(rest);
  };
  EXPECT_EQ(without("--base"), "--peers needs --base, which measures where other robots are");
  EXPECT_EQ(without("--listen"), "--peers needs --listen");
  EXPECT_EQ(fault(with({"--peers", "10.0.0.255:4600"})), "--hub and --peers exclude each other");
  EXPECT_EQ(fault(with({"--root"})), "--listen, --root and --worker need --peers: the hub says how robots begin");
}

TEST(RobotOptions, WithAnAutopilot) {
  const auto arguments = with({"--base", "mavlink:udp:127.0.0.1:14540", "--system", "9", "--height", "12.5", "--home",
                               "homes.txt", "--poses", "10.0.0.1:4700"});
  EXPECT_EQ(to_arguments(parse_robot_options(arguments)), arguments);
  EXPECT_EQ(parse_robot_options(arguments).mavlink_system(), 9);
  const auto flown = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"--base", "mavlink:/dev/ttyACM0"});
    return fault(with(more));
  };
  EXPECT_EQ(flown({"--height", "0", "--home", "tracker"}), "");
  EXPECT_TRUE(flown({"--home", "tracker"}).starts_with("--height is missing"));
  EXPECT_TRUE(flown({"--height", "5"}).starts_with("--home is missing"));
  EXPECT_TRUE(flown({"--height", "5", "--home", "homes.txt"}).starts_with("--poses is missing"));
  EXPECT_TRUE(flown({"--height", "5", "--home", "tracker", "--poses", "10.0.0.1:4700"})
                  .starts_with("--home tracker and --poses exclude each other"));
  EXPECT_TRUE(
      fault(with({"--base", "tcp:1.2.3.4:5", "--height", "5"})).ends_with("need an autopilot: --base mavlink:..."));
  EXPECT_TRUE(fault({"--id", "3", "--peers", "10.0.0.255:4600", "--listen", "0.0.0.0:4600", "--key", "k", "--base",
                     "mavlink:/dev/ttyACM0", "--height", "5", "--home", "tracker"})
                  .starts_with("--peers needs a base that measures where other robots are"));
  EXPECT_TRUE(fault({"--id", "300", "--hub", "10.0.0.1:4600", "--key", "k", "--base", "mavlink:/dev/ttyACM0",
                     "--height", "5", "--home", "tracker"})
                  .starts_with("--system is missing"));
}

TEST(RobotOptions, WhatIsWrongIsSaid) {
  EXPECT_EQ(fault({}), "--id is missing");
  EXPECT_EQ(fault({"--id", "3"}), "--hub or --peers is missing");
  EXPECT_EQ(fault(with({"--rnage", "2"})), "\"--rnage\" is unknown; see --help");
  EXPECT_EQ(fault(with({"--range"})), "--range needs a value");
  EXPECT_EQ(fault(with({"--range", "nan"})), "--range must be a number from 0.001 to 10000, not \"nan\"");
  EXPECT_EQ(fault({"--id", "1.5"}), "--id must be a whole number, not \"1.5\"");
  EXPECT_EQ(fault({"--id", "65534"}), "--id must be a number from 0 to 65533, not \"65534\"");
  EXPECT_EQ(fault(with({"--set", "x"})), "--set must be KEY=VALUE, not \"x\"");
  EXPECT_EQ(fault(with({"--id", "2"})), "--id is given twice; give it once");
  EXPECT_EQ(fault(with({"--range", "2", "--range", "2"})), "--range is given twice; give it once");
  EXPECT_EQ(fault(with({"--holonomic", "--set", "safe_range=0.8", "--holonomic", "--set", "ideal_distance=0.7"})), "");
  EXPECT_EQ(fault(with({"--holonomic=false"})), "--holonomic takes no value");
  EXPECT_NE(robot_usage().find("--stop-after"), std::string::npos);
}

}  // namespace
}  // namespace banyan::udp
