// SPDX-License-Identifier: MIT
// Missions in ROS 2 (docs/ros2.md), seen by another implementation of DDS (hosts/ros2/test/watcher.cpp).
#include <fcntl.h>
#include <signal.h>

#include <regex>
#include <set>
#include <tuple>

#include "started_processes.hpp"

namespace banyan::cli {
namespace {

class MissionInRos : public StartedProcesses {
 protected:
  void SetUp() override {
    StartedProcesses::SetUp();
    std::array<int, 2> pipe{};
    ASSERT_EQ(::pipe2(pipe.data(), O_CLOEXEC), 0);
    asking_ = pipe[1];
    const std::string seen = (home_ / "seen.txt").string();
    Circumstances how{.program = BANYAN_ROS2_WATCHER};
    how.input = pipe[0];
    how.out = seen.c_str();
    watcher_ = start({"9", domain_}, how);
    ::close(pipe[0]);
  }
  void TearDown() override {
    if (asking_ >= 0) close();
    StartedProcesses::TearDown();
  }
  static std::string scenario() { return std::string(BANYAN_SCENARIOS) + "/khepera-three-targets.toml"; }
  [[nodiscard]] Circumstances in_ros() const {
    return {.environment = {{"ROS_DOMAIN_ID", domain_}, {"ROS_LOCALHOST_ONLY", "1"}, {"ROS_DISTRO", "jazzy"}}};
  }
  pid_t begin(Arguments arguments) {
    arguments.insert(arguments.end(), {"--ros2", "--out", "result"});
    return start(arguments, in_ros());
  }
  // Nothing ends it but its time.
  pid_t begin_endless(const Arguments& more = {}) {
    Arguments arguments{"run", scenario(), "--speed", "10", "--set", "mission.stop_when_complete=false"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return begin(arguments);
  }
  void ask(const std::string& what) const {
    EXPECT_EQ(::write(asking_, (what + "\n").c_str(), what.size() + 1), static_cast<ssize_t>(what.size() + 1));
  }
  [[nodiscard]] bool sees(const std::string& text) const {
    return becomes([&] { return has(read("seen.txt"), text); });
  }
  // The watcher ends; its lines, without their times.
  std::set<std::string> close() {
    ::close(asking_);
    asking_ = -1;
    EXPECT_EQ(finish(watcher_).code, 0);
    std::set<std::string> lines;
    std::istringstream text(read("seen.txt"));
    for (std::string line; std::getline(text, line);)
      lines.insert(std::regex_replace(line, std::regex("^[0-9.]+ "), ""));
    return lines;
  }
  [[nodiscard]] pid_t ros_beside(pid_t mission) const {
    for (const pid_t child : children_of(mission))
      if (has(command_line(child), "banyan-ros2")) return child;
    return 0;
  }

  const std::string domain_ = std::to_string(101 + ::getpid() % 100);
  int asking_ = -1;
  pid_t watcher_ = 0;
};

std::set<std::string> expected_endpoints() {
  std::set<std::string> lines{"participant enclave=/;",
                              "node / banyan: 3 readers, 14 writers, 0 unknown",
                              "reader rt/goal_pose geometry_msgs::msg::dds_::PoseStamped_ reliable volatile",
                              "reader rt/clicked_point geometry_msgs::msg::dds_::PointStamped_ reliable volatile",
                              "reader rt/banyan/command std_msgs::msg::dds_::String_ reliable volatile",
                              "writer ros_discovery_info rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_ reliable "
                              "transient-local",
                              "writer rt/clock rosgraph_msgs::msg::dds_::Clock_ reliable volatile",
                              "writer rt/tf tf2_msgs::msg::dds_::TFMessage_ reliable volatile",
                              "writer rt/markers visualization_msgs::msg::dds_::MarkerArray_ reliable volatile",
                              "writer rt/diagnostics diagnostic_msgs::msg::dds_::DiagnosticArray_ reliable volatile",
                              "writer rt/rosout rcl_interfaces::msg::dds_::Log_ reliable transient-local"};
  for (int i = 0; i < 9; ++i)
    lines.insert("writer rt/robot_" + std::to_string(i) + "/odom nav_msgs::msg::dds_::Odometry_ reliable volatile");
  return lines;
}

TEST_F(MissionInRos, IsSeenWholeByAnotherDds) {
  const Outcome mission = finish(begin({"run", scenario(), "--speed", "2"}));
  EXPECT_EQ(mission.code, 0) << mission.err;
  EXPECT_TRUE(has(mission.out, "COMPLETE after")) << mission.out;
  EXPECT_TRUE(sees("log 20 banyan.complete"));
  EXPECT_TRUE(sees("status 0 banyan: mission: complete"));
  const auto said = close();
  const auto is_endpoint = [](const std::string& line) {
    return line.starts_with("reader ") || line.starts_with("writer ") || line.starts_with("participant ") ||
           line.starts_with("node / banyan:");
  };
  std::set<std::string> endpoints;
  std::copy_if(said.begin(), said.end(), std::inserter(endpoints, endpoints.end()), is_endpoint);
  EXPECT_EQ(endpoints, expected_endpoints());
  for (int i = 0; i < 9; ++i) {
    const std::string body = " map robot_" + std::to_string(i) + "/base_link";
    EXPECT_TRUE(said.contains("frame" + body)) << i;
    EXPECT_TRUE(said.contains("odometry" + body)) << i;
  }
  EXPECT_TRUE(said.contains("odometry of 9 robots, 9 moved"));
  EXPECT_TRUE(said.contains("status 0 banyan: network: in one part"));
  std::size_t with_tree = 0;
  for (const std::string& line : said) {
    EXPECT_FALSE(line.starts_with("status 2")) << line;
    EXPECT_FALSE(has(line, "another speed") || has(line, "where no robot is")) << line;
    if (line.starts_with("markers robots:9 headings:18 ") && has(line, " tree:") && has(line, " links:") &&
        has(line, " targets:1 target_names:1"))
      ++with_tree;
    if (line.starts_with("clock ")) { EXPECT_TRUE(line.ends_with(" 0 back")) << line; }
  }
  EXPECT_GT(with_tree, 0U);
}

TEST_F(MissionInRos, DoesWhatItIsAskedAndSaysWhatItRefuses) {
  const pid_t mission = begin_endless({"--set", "mission.time_limit_s=1000"});
  ASSERT_TRUE(sees("banyan.complete"));
  ask("click map 1.0 -1.0");
  EXPECT_TRUE(sees("banyan.target_added target T3 is new at (1.00, -1.00) m"));
  EXPECT_TRUE(sees("banyan.asked /clicked_point: add_target position_m=[1,-1]"));
  ask("goal map -0.5 0.5");
  EXPECT_TRUE(sees("target T4 is new at (-0.50, 0.50) m"));
  ask("command die robot=8");
  EXPECT_TRUE(sees("status 1 banyan: robots: 1 of 9 dead"));
  EXPECT_TRUE(sees("log 30 banyan.death"));
  ask("command move_target target=3 position_m=[1, -1.1]");
  EXPECT_TRUE(sees("asked /banyan/command: move_target target=3 position_m=[1, -1.1]"));
  ask("command set_loss loss=0.1");
  EXPECT_TRUE(sees("asked /banyan/command: set_loss loss=0.1"));
  ask("command remove_target target=4");
  EXPECT_TRUE(sees("asked /banyan/command: remove_target target=4"));
  const std::vector<std::pair<std::string, std::string>> bad{
      {"click camera 1 1", "/clicked_point: refused: the point is in the frame \"camera\", not \"map\""},
      {"goal map nan 1", "the point is nowhere: a coordinate is not finite"},
      {"goal map 1e300 1", "/goal_pose: refused: position_m[0]: is 1e+300"},
      {"command die robot=99", "robot: there is no robot 99; the last one is 8"},
      {"command dye robot=1", "did you mean \"die\"?"},
      {"command die robot=1 time_s=4", "time_s: is not for commands: they happen now"},
      {"command robot=1", "begins with no kind of event, as in: add_target position_m=[2,1]"},
      {"command kill of=[[[[", "not the text \"[[[[\" (kill of=[[[[)"},
      {"command add_obstacle position_m=[1,", "(add_obstacle position_m=[1,)"},
      {"command " + std::string(6000, '['), "(" + std::string(4096, '[') + ")"}};
  for (const auto& [asked, answer] : bad) {
    ask(asked);
    EXPECT_TRUE(sees(answer)) << asked.substr(0, 40) << "\n" << read("stderr.txt");
  }
  ::kill(mission, SIGINT);
  const Outcome outcome = finish(mission);
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_TRUE(has(outcome.err, "/clicked_point: refused: the point is in the frame \"camera\"")) << outcome.err;
  EXPECT_TRUE(exists("result/run.mcap"));
}

TEST_F(MissionInRos, IsNotBegunWhereRosCannotBe) {
  for (const auto& [variable, value, code] :
       {std::tuple("ROS_DOMAIN_ID", "300", 2), std::tuple("CYCLONEDDS_URI", "<broken", 1)}) {
    Circumstances how = in_ros();
    std::erase_if(how.environment, [&](const auto& given) { return given.first == variable; });
    how.environment.emplace_back(variable, value);
    const Outcome outcome = run({"run", scenario(), "--ros2", "--out", "result"}, how);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_TRUE(has(outcome.err, "banyan-ros2 could not begin, so nothing was started")) << outcome.err;
    EXPECT_FALSE(exists("result/run.json"));
  }
  EXPECT_EQ(run({"run", scenario(), "--speed", "2"}).code, 2);  // of what is not shown
}

// Neither a ROS 2 that stands still nor one that dies costs a mission time or results.
TEST_F(MissionInRos, WaitsForNobody) {
  const auto hash_of = [](const std::string& text) {
    std::smatch found;
    return std::regex_search(text, found, std::regex("\"hash\": \"([0-9a-f]+)\"")) ? found[1].str() : "";
  };
  ASSERT_EQ(run({"run", scenario(), "--out", "alone", "--set", "mission.stop_when_complete=false"}).code, 0);
  for (const int signal : {SIGSTOP, SIGKILL}) {
    const auto begun = Clock::now();
    const pid_t mission = begin_endless({"--force"});
    ASSERT_TRUE(becomes([&] { return ros_beside(mission) != 0; }));
    const pid_t beside = ros_beside(mission);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    ::kill(beside, signal);
    const Outcome outcome = finish(mission);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(has(outcome.err, "banyan-ros2 has ended; the mission goes on without ROS 2"), signal == SIGKILL);
    EXPECT_EQ(hash_of(read("result/run.json")), hash_of(read("alone/run.json")));
    EXPECT_LT(Clock::now() - begun, std::chrono::seconds(13));  // 80 s at ten times real time
    EXPECT_FALSE(runs(beside));
  }
}

// The fleet is in a network of its own, and ROS 2 is not; a hub that is killed is started again.
TEST_F(MissionInRos, AFleetIsSeenAlsoWhenItsHubIsKilled) {
  const pid_t fleet = begin({"fleet", scenario(), "--speed", "2"});
  ASSERT_TRUE(sees("banyan.phase phase grow_tree"));
  const auto hubs = [&] {
    for (const pid_t child : children_of(fleet))
      if (has(command_line(child), " hub ")) return child;
    return pid_t{0};
  };
  const pid_t first = hubs();
  ASSERT_NE(first, 0);
  ::kill(first, SIGKILL);
  const Outcome outcome = finish(fleet);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "COMPLETE after")) << outcome.out;
  EXPECT_TRUE(sees("log 20 banyan.complete"));
  const auto said = close();
  EXPECT_TRUE(said.contains("odometry of 9 robots, 9 moved"));
  for (const std::string& line : said)
    if (line.starts_with("clock ")) { EXPECT_TRUE(line.ends_with(" 0 back")) << line; }
}

}  // namespace
}  // namespace banyan::cli
