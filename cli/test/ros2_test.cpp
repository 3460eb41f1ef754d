// SPDX-License-Identifier: MIT
// A fleet whose robots and tracker are ROS 2's (docs/ros2.md): hub, robots and banyan-ros2 here, bodies in a process
// that speaks another implementation of DDS (hosts/ros2/test/peer.cpp). Clocks are five times as fast as the wall's.
#include <signal.h>

#include <cmath>
#include <map>
#include <regex>
#include <set>

#include "started_processes.hpp"

namespace banyan::cli {
namespace {

class RosLaboratory : public StartedProcesses {
 protected:
  static constexpr int count = 9;

  // Bodies that publish so, and a bridge that is told of it.
  void open(const std::string& peer_options, const std::string& bridge_options) {
    ASSERT_EQ(run({"hub", "--new-key", "fleet.key"}).code, 0);
    const int port = free_port();
    hub_address_ = "127.0.0.1:" + std::to_string(port);
    poses_ = "127.0.0.1:" + std::to_string(port + 1);
    first_base_ = port + 2;
    bodies_ =
        shell(std::string(BANYAN_ROS2_PEER) + " 9 " + domain_ + " 5 " + peer_options + " >peer.txt 2>peer-errors.txt");
    bridge_ = shell(std::string(BANYAN_ROS2) + " --localhost --robots 9 --domain " + domain_ + " --poses " + poses_ +
                    " --bases 127.0.0.1:" + std::to_string(first_base_) + " " + bridge_options + " 2>bridge.txt");
    ASSERT_TRUE(becomes([&] { return answers(first_base_ + count - 1); })) << read("bridge.txt");
    for (int i = 0; i < count; ++i) robots_.push_back(start_robot(i));
  }
  void TearDown() override {
    for (const pid_t child : {bodies_, bridge_}) robots_.push_back(child);
    for (const pid_t child : robots_)
      if (child > 0 && ::kill(child, SIGKILL) == 0) finish(child);
    StartedProcesses::TearDown();
  }
  pid_t shell(const std::string& command) { return start({"-c", "exec " + command}, {.program = "sh"}); }
  pid_t start_robot(int i) {
    return start({"robot", "--id", std::to_string(i), "--hub", hub_address_, "--key", "fleet.key", "--algorithm",
                  "outwards", "--speed", "5", "--base", "tcp:127.0.0.1:" + std::to_string(first_base_ + i)});
  }
  [[nodiscard]] Arguments hub() const {
    return {"hub",      std::string(BANYAN_SCENARIOS) + "/khepera-three-targets.toml",
            "--key",    "fleet.key",
            "--listen", hub_address_,
            "--poses",  poses_,
            "--speed",  "5",
            "--out",    "result",
            "--force"};
  }
  static void expect_complete(const Outcome& hub) {
    EXPECT_EQ(hub.code, 0) << hub.err;
    EXPECT_TRUE(has(hub.out, "COMPLETE after")) << hub.out;
    EXPECT_TRUE(has(hub.out, "in one piece at every tick")) << hub.out;
  }
  // Where each body is, as its last line says.
  [[nodiscard]] std::map<std::string, std::string> seen() const {
    std::map<std::string, std::string> latest;
    std::istringstream lines(read("peer.txt"));
    for (std::string line; std::getline(lines, line) && !lines.eof();)
      if (!line.empty() && line.front() >= '0' && line.front() <= '9') latest[line.substr(0, line.find(','))] = line;
    return latest;
  }
  // As long as nobody drives them.
  [[nodiscard]] std::map<std::string, std::string> seen_at_rest() const {
    EXPECT_TRUE(becomes([&] { return seen().size() == count; }));
    return seen();
  }
  // Ends the bridge, then the bodies; what those have seen of it, line by line.
  std::set<std::string> close() {
    using namespace std::chrono_literals;
    ::kill(bridge_, SIGTERM);
    EXPECT_EQ(finish(bridge_).code, 128 + SIGTERM);
    std::this_thread::sleep_for(100ms);
    ::kill(bodies_, SIGTERM);
    EXPECT_EQ(finish(bodies_).code, 0) << read("peer-errors.txt");
    bridge_ = bodies_ = 0;
    std::set<std::string> said;
    std::istringstream lines(read("peer.txt"));
    for (std::string line; std::getline(lines, line);)
      if (!line.empty() && (line.front() < '0' || line.front() > '9')) said.insert(line);
    return said;
  }
  // What the bridge says of itself when it ends.
  [[nodiscard]] std::size_t counted(const std::string& what) const {
    const std::string account = read("bridge.txt");
    std::smatch found;
    return std::regex_search(account, found, std::regex("([0-9]+) " + what)) ? std::stoul(found[1]) : 0;
  }
  // Whose ports neither free_port() nor the system hands out.
  const std::string domain_ = std::to_string(91 + ::getpid() % 10);
  std::string hub_address_, poses_;
  int first_base_ = 0;
  pid_t bodies_ = 0, bridge_ = 0;
  std::vector<pid_t> robots_;
};

// Names and types as ROS 2 mangles them, qualities of service as rclcpp, tf2_ros and rmw_dds_common have them.
std::set<std::string> endpoints(const std::string& pose_reader, const std::string& command_type) {
  std::set<std::string> lines{
      "participant enclave=/;", "writer rt/tf tf2_msgs::msg::dds_::TFMessage_ reliable volatile",
      "writer ros_discovery_info rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_ reliable transient-local",
      "node / banyan_ros2: 9 readers, 10 writers, 0 unknown"};
  for (int i = 0; i < 9; ++i) {
    const std::string robot = "rt/robot_" + std::to_string(i);
    lines.insert("reader " + robot + pose_reader + " best-effort volatile");
    lines.insert("writer " + robot + "/cmd_vel geometry_msgs::msg::dds_::" + command_type + " reliable volatile");
  }
  return lines;
}

// Takes the lines about /tf out: there is one of each body, in the map, where the body was when the bridge ended.
void expect_frames(std::set<std::string>& said, const std::map<std::string, std::string>& seen) {
  std::size_t frames = 0;
  for (auto at = said.begin(); at != said.end();) {
    std::smatch match;
    if (!std::regex_match(*at, match, std::regex("tf map robot_([0-8])/base_link (\\S+) (\\S+) (\\S+)"))) {
      ++at;
      continue;
    }
    ++frames;
    std::string line = seen.at(match[1]);
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream numbers(line);
    double id = 0.0, x = 0.0, y = 0.0, turn = 0.0;
    numbers >> id >> x >> y >> turn;
    EXPECT_NEAR(std::stod(match[2]), x, 0.002);
    EXPECT_NEAR(std::stod(match[3]), y, 0.002);
    EXPECT_NEAR(std::remainder(std::stod(match[4]) - turn, 2.0 * 3.14159265358979323846), 0.0, 0.002);
    at = said.erase(at);
  }
  EXPECT_EQ(frames, 9U);
}

TEST_F(RosLaboratory, CompletesWithPoseStampedAndTwistWhateverElseIsSaid) {
  open("pose bad", "");
  expect_complete(run(hub()));
  const auto last = seen();
  auto said = close();
  expect_frames(said, last);
  EXPECT_EQ(said, endpoints("/pose geometry_msgs::msg::dds_::PoseStamped_", "Twist_"));  // and no robot still moves
  for (const char* why : {"not finite", "of a quaternion that is no rotation", "tilted by more than 45 degrees",
                          "of another frame", "too old"})
    EXPECT_GE(counted(why), 9U) << why << "\n" << read("bridge.txt");
  EXPECT_GT(counted("poses"), 9U * 50U);
  EXPECT_TRUE(has(read("bridge.txt"), "it is of another frame: \"camera\", not \"map\"")) << read("bridge.txt");
}

TEST_F(RosLaboratory, CompletesWithOdometryAndTwistStampedAndIsSeenByHumble) {
  open("odometry stamped humble", "--odometry /robot_{}/odom --stamped --humble");
  expect_complete(run(hub()));
  const auto last = seen();
  auto said = close();
  expect_frames(said, last);
  EXPECT_EQ(said, endpoints("/odom nav_msgs::msg::dds_::Odometry_", "TwistStamped_"));
  // On a machine that has other work, some may be too old.
  for (const char* why : {"not finite", "of a quaternion", "tilted", "of another frame", "from the future"})
    EXPECT_EQ(counted(why), 0U) << read("bridge.txt");
}

// The tracker's poses in the map, and odometry since the start, which only the robots learn of.
TEST_F(RosLaboratory, ARobotThatIsKilledStandsStillAndComesAgain) {
  using namespace std::chrono_literals;
  open("both", "--pose /robot_{}/pose --odometry /robot_{}/odom --no-tf --node laboratory");
  const auto begin = seen_at_rest();
  const pid_t mission = start(hub());
  EXPECT_TRUE(becomes([&] { return seen().at("2") != begin.at("2"); }));
  ::kill(robots_[2], SIGKILL);
  finish(robots_[2]);
  std::this_thread::sleep_for(200ms);
  const std::string stopped = seen().at("2");
  std::this_thread::sleep_for(200ms);
  EXPECT_EQ(seen().at("2"), stopped);
  robots_[2] = start_robot(2);
  expect_complete(finish(mission));
  const auto said = close();
  EXPECT_TRUE(said.contains("node / laboratory: 18 readers, 9 writers, 0 unknown"));
  EXPECT_FALSE(said.contains("writer rt/tf tf2_msgs::msg::dds_::TFMessage_ reliable volatile"));
  EXPECT_GT(counted("of odometry"), 9U * 50U);
}

// The mission in ROS 2, beside robots and tracker that are there already: it has no clock and no frames of its own.
TEST_F(RosLaboratory, AHubWithATrackerShowsAllButTheBodies) {
  open("pose", "--no-tf");
  Arguments arguments = hub();
  arguments.emplace_back("--ros2");
  const Circumstances in_domain{.environment = {{"ROS_DOMAIN_ID", domain_}, {"ROS_LOCALHOST_ONLY", "1"}}};
  expect_complete(finish(start(arguments, in_domain)));
  const auto said = close();
  EXPECT_TRUE(said.contains("writer rt/markers visualization_msgs::msg::dds_::MarkerArray_ reliable volatile"));
  EXPECT_TRUE(said.contains("writer rt/diagnostics diagnostic_msgs::msg::dds_::DiagnosticArray_ reliable volatile"));
  for (const std::string& line : said) {
    EXPECT_FALSE(line.starts_with("writer rt/clock") || line.starts_with("writer rt/tf")) << line;
    EXPECT_FALSE(line.starts_with("writer") && has(line, "Odometry_")) << line;
  }
}

// Ctrl-C at the bridge while robots drive: they are told to stand still, and those who drive them lose their bases.
TEST_F(RosLaboratory, NobodyMovesWhenTheBridgeEnds) {
  open("pose", "--cmd-vel /robot_{}/cmd_vel");
  const auto begin = seen_at_rest();
  const pid_t mission = start(hub());
  EXPECT_TRUE(becomes([&] { return seen() != begin; }));
  const auto said = close();
  for (int i = 0; i < count; ++i) EXPECT_FALSE(said.contains("robot " + std::to_string(i) + " still moves"));
  ::kill(mission, SIGTERM);
  EXPECT_EQ(finish(mission).code, 128 + SIGTERM);
}

TEST_F(RosLaboratory, SaysWhatIsMissingAndWhatCannotBe) {
  const auto refused = run({"--robots", "9", "--poses", "127.0.0.1:9", "--pose", "pose"}, {.program = BANYAN_ROS2});
  EXPECT_EQ(refused.code, 2);
  EXPECT_EQ(refused.err, "banyan-ros2: --pose \"pose\" must begin with /\n");
  const auto elsewhere = run({"--robots", "9", "--bases", "192.0.2.1:5000", "--localhost"}, {.program = BANYAN_ROS2});
  EXPECT_EQ(elsewhere.code, 1);
  EXPECT_TRUE(has(elsewhere.err, "banyan-ros2: tcp:192.0.2.1:5000: ")) << elsewhere.err;
  const auto help = run({"ros2", "--help"});
  EXPECT_EQ(help.code, 0);
  EXPECT_TRUE(has(help.out, "--odometry TOPIC")) << help.out;
  // Nobody publishes.
  const pid_t alone = shell(std::string(BANYAN_ROS2) +
                            " --localhost --id 7 --domain 90 --poses 127.0.0.1:9 --pose /seven 2>bridge.txt");
  EXPECT_TRUE(becomes([&] {
    return has(read("bridge.txt"),
               "robot 7: no sound pose so far on /seven, which has 0 publishers of geometry_msgs/PoseStamped");
  })) << read("bridge.txt");
  ::kill(alone, SIGINT);
  EXPECT_EQ(finish(alone).code, 130);
}

}  // namespace
}  // namespace banyan::cli
