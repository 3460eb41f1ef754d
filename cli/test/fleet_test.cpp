// SPDX-License-Identifier: MIT
// Fleets of processes, as a user starts them, and what may happen to them: processes that are killed, bad radio,
// Ctrl-C. Their clocks are five times as fast as the wall's, so that a mission of ten seconds takes two.
#include <netinet/in.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <thread>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/config/config.hpp"
#include "banyan/hosts/udp/remote_swarm.hpp"
#include "banyan/hosts/udp/robot.hpp"
#include "banyan/record/simulation.hpp"
#include "started_processes.hpp"
#include "summary.hpp"

namespace banyan::cli {
namespace {

const std::string three_targets = std::string(BANYAN_SCENARIOS) + "/khepera-three-targets.toml";

// ---- Robots in this process: the swarm that is elsewhere, without clocks and sockets ----

// Robots that step once a tick, right after the hub's word.
class NearbyRobots final : public udp::RemoteLink {
 public:
  NearbyRobots(const world::Scenario& scenario, std::size_t robots, const std::string& names = "")
      : RemoteLink(roster_), roster_(names.empty() ? udp::Roster(robots) : udp::Roster(names)), answers_(robots) {
    Setup setup = world::setup_of(scenario);
    setup.history = 1;
    for (std::size_t i = 0; i < robots; ++i)
      robots_.emplace_back(world::algorithm_of(scenario), setup, roster_.id(i), 0.5);
  }
  [[nodiscard]] std::optional<udp::Status> take(std::size_t i) override {
    return std::exchange(answers_[i], std::nullopt);
  }
  void deliver(std::size_t i, udp::SensorFrame frame, std::span<const udp::Hearing> heard) override {
    const double now_s = 1.0 + 0.1 * frame.tick;
    frame.mission = 1;
    const auto travelled = udp::decode_frame(udp::encode(frame));
    ASSERT_TRUE(travelled);
    robots_[i].take(*travelled, now_s);
    robots_[i].take(udp::HeardBundle{frame.tick, frame.odometry, {heard.begin(), heard.end()}});
    answers_[i] = udp::decode_status(udp::encode(robots_[i].step(now_s)));
  }
  void dismiss(std::size_t i) override { dismissed.insert(i); }
  std::set<std::size_t> dismissed;

 private:
  udp::Roster roster_;
  std::vector<udp::UdpRobot> robots_;
  std::vector<std::optional<udp::Status>> answers_;
};

record::RunEnd played(const world::Scenario& scenario, NearbyRobots& robots) {
  const AlgorithmElsewhere remote = udp::remote_algorithm(world::algorithm_of(scenario), robots, 5);
  record::Sinks nobody_listens;
  world::Executor alone(1);
  return record::run_scenario(world::World(scenario, remote), nobody_listens, alone);
}

config::Configuration configuration(const std::vector<std::string>& assignments = {}) {
  std::vector<config::Override> overrides;
  overrides.reserve(assignments.size());
  for (const auto& assignment : assignments) overrides.push_back({assignment, "test"});
  auto loaded = config::load_configuration(three_targets, algorithms(), overrides);
  EXPECT_TRUE(loaded.ok());
  return loaded.configuration;
}

TEST(RemoteSwarm, DoesWhatTheWorldsOwnDoes) {
  for (const char* algorithm : {"outwards", "inwards", "convoy"}) {
    const world::Scenario scenario = configuration({std::string("mission.algorithm=") + algorithm}).scenario;
    NearbyRobots robots(scenario, world::robot_count(scenario));
    const auto remote = played(scenario, robots);
    record::Sinks nobody_listens;
    world::Executor alone(1);
    const auto own = record::run_scenario(world::World(scenario), nobody_listens, alone);
    ASSERT_TRUE(remote.run.complete) << algorithm;
    EXPECT_EQ(remote.run.split_ticks, 0U);
    // Nearly: they learn of their first frame a tick later, and their odometry is rounded differently.
    EXPECT_NEAR(remote.run.completion_time_s, own.run.completion_time_s, 0.1 * own.run.completion_time_s) << algorithm;
  }
}

// A robot's id is its own, its index the world's; what is observed is in indices.
TEST(RemoteSwarm, IdsNeedNotBeIndices) {
  for (const char* algorithm : {"outwards", "convoy"}) {
    const world::Scenario scenario = configuration({std::string("mission.algorithm=") + algorithm}).scenario;
    NearbyRobots plain(scenario, 9), named(scenario, 9, "cf_{31-38},lead_700");
    const auto expected = played(scenario, plain), found = played(scenario, named);
    ASSERT_TRUE(found.run.complete) << algorithm;
    // Ids decide only in the order of robots, which is the same here.
    EXPECT_EQ(found.run.completion_time_s, expected.run.completion_time_s) << algorithm;
    EXPECT_EQ(found.run.driven_m, expected.run.driven_m) << algorithm;
  }
}

TEST(RemoteSwarm, WhoeverJoinsIsAFreshSpare) {
  world::Scenario scenario =
      configuration({"mission.algorithm=convoy", "mission.stop_when_complete=false", "mission.time_limit_s=40"})
          .scenario;
  world::Event join, die, again;
  join.time_s = 2.0;
  join.action = world::Join{9, {0.0, -0.7}};
  die.time_s = 3.0;
  die.action = world::Die{9};
  again.time_s = 5.0;
  again.action = world::Join{9, {0.3, -0.7}};
  scenario.events = {join, die, again};
  NearbyRobots robots(scenario, 10);
  const AlgorithmElsewhere remote = udp::remote_algorithm(world::algorithm_of(scenario), robots, 5);
  world::World world(scenario, remote);
  while (world.time_s() < 5.05) world.step();
  EXPECT_EQ(world.alive()[9], 1);
  EXPECT_EQ(world.reports()[9].role, Role::spare);
  while (world.time_s() < 40.0) {
    world.step();
    ASSERT_FALSE(world.links(9).empty()) << world.time_s();
  }
  EXPECT_TRUE(world.holder(0) && world.holder(1) && world.holder(2));
}

TEST(RemoteSwarm, KeepsTwoPaths) {
  auto loaded = config::load_configuration(
      std::string(BANYAN_SCENARIOS) + "/three-targets.toml", algorithms(),
      {{"mission.link_redundancy=2", "test"}, {"swarm.redundancy=5", "test"}, {"mission.settle_s=30", "test"}});
  ASSERT_TRUE(loaded.ok());
  const world::Scenario scenario = loaded.configuration.scenario;
  NearbyRobots robots(scenario, world::robot_count(scenario));
  const auto remote = played(scenario, robots);
  EXPECT_TRUE(remote.run.complete);
  EXPECT_GT(remote.run.redundant_time_ratio, 0.9);
}

TEST(RemoteSwarm, IsAFunctionOfWhatRobotsSay) {
  const world::Scenario scenario = configuration({"radio.loss=0.2", "radio.latency_ticks=2"}).scenario;
  NearbyRobots first(scenario, world::robot_count(scenario)), second(scenario, world::robot_count(scenario));
  EXPECT_EQ(played(scenario, first).run.hash, played(scenario, second).run.hash);
}

TEST(RemoteSwarm, TargetsThatAreGivenUpAndDeathsReachTheRobots) {
  world::Scenario scenario =
      configuration({"mission.algorithm=convoy", "mission.stop_when_complete=false", "mission.time_limit_s=40"})
          .scenario;
  world::Event give_up, die;
  give_up.time_s = 3.0;
  give_up.action = world::RemoveTarget{1};
  die.time_s = 4.0;
  die.action = world::Die{8};
  scenario.events = {give_up, die};
  NearbyRobots robots(scenario, world::robot_count(scenario));
  const AlgorithmElsewhere remote = udp::remote_algorithm(world::algorithm_of(scenario), robots, 5);
  world::World world(scenario, remote);
  while (world.time_s() < 40.0) world.step();
  EXPECT_EQ(robots.dismissed, (std::set<std::size_t>{8}));
  const auto given_up = static_cast<RobotId>(world.targets()[1].worker);
  for (const Report& report : world.reports()) EXPECT_NE(report.serves, given_up);
  EXPECT_TRUE(world.holder(0) && world.holder(2));
}

TEST(RemoteSwarm, ACopyOfItsWorldIsOfTheSameHashAndTalksToNobody) {
  const world::Scenario scenario = configuration().scenario;
  NearbyRobots robots(scenario, world::robot_count(scenario));
  const AlgorithmElsewhere remote = udp::remote_algorithm(world::algorithm_of(scenario), robots, 5);
  world::World world(scenario, remote);
  for (int k = 0; k < 20; ++k) world.step();
  world::World copy = world;
  EXPECT_EQ(copy.hash(), world.hash());
  copy.step();
  copy.step();
  world.step();  // its robots still answer
  EXPECT_NE(copy.hash(), world.hash());
}

// ---- The summary ----

TEST(Summary, SaysWhichRobotsRefusedReadings) {
  const config::Configuration of = configuration();
  const RunOutputs outputs(of, testing::TempDir() + "summary", true);
  record::RunRow row{};
  EXPECT_FALSE(has(summary_text(row, of, outputs, {}), "refused"));
  row.run.rejected = 120;
  row.run.rejected_by = "3";
  EXPECT_TRUE(has(summary_text(row, of, outputs, {}), "refused    120 impossible readings, by robot 3\n"));
  row.run.rejected = 1;
  EXPECT_TRUE(has(summary_text(row, of, outputs, {}), "refused    1 impossible reading, by robot 3\n"));
  row.run.rejected_by = "3, 5";
  EXPECT_TRUE(has(summary_text(row, of, outputs, {}), "by robots 3, 5\n"));
  outputs.abandon();
}

TEST(Summary, TellsWhatWorkersOwnDeathsCostWhereTheyDo) {
  const config::Configuration of = configuration();
  const RunOutputs outputs(of, testing::TempDir() + "summary", true);
  record::RunRow row{};
  row.run.complete = true;
  row.run.deaths = 2;
  row.run.held_time_ratio = 0.99;
  row.run.unheld_time_ratio_by_death = 0.0;
  EXPECT_FALSE(has(summary_text(row, of, outputs, {}), "own workers")) << "nothing lost by them";
  row.run.unheld_time_ratio_by_death = 0.0075;
  const std::string text = summary_text(row, of, outputs, {});
  EXPECT_TRUE(
      has(text, "targets not held for 1.00 % of the time once complete, 0.75 % by their own workers' deaths; "));
  row.run.deaths = 0;
  EXPECT_FALSE(has(summary_text(row, of, outputs, {}), "own workers")) << "nobody died";
  outputs.abandon();
}

// ---- Processes ----

class FleetProgram : public StartedProcesses {
 protected:
  // The child of the fleet whose command line has these words; 0: there is none.
  static pid_t child_with(pid_t fleet, const std::string& words) {
    for (const pid_t child : children_of(fleet))
      if (runs(child) && has(command_line(child), words)) return child;
    return 0;
  }
  static pid_t robot(pid_t fleet, int id) { return child_with(fleet, "banyan-robot --id " + std::to_string(id) + " "); }
  static pid_t hub(pid_t fleet) { return child_with(fleet, " hub "); }

  // Started, and under way: its hub has a journal of some ticks.
  pid_t start_fleet(Arguments more, std::size_t ticks = 10, const char* speed = "5") {
    more.insert(more.begin(), {"fleet", three_targets, "--speed", speed, "--out", "result", "--quiet"});
    const pid_t fleet = start(more);
    const auto journal = home_ / "result/fleet.journal";
    EXPECT_TRUE(becomes([&] {
      return std::filesystem::exists(journal) && std::filesystem::file_size(journal) > 20 + ticks * 6 * 9;
    })) << read("stderr.txt");
    return fleet;
  }
  // Kills a child of it and waits until another one is there in its place.
  static void kill_and_wait(pid_t child, const std::function<pid_t()>& again) {
    ASSERT_GT(child, 0);
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    EXPECT_TRUE(becomes([&] {
      const pid_t now = again();
      return now > 0 && now != child;
    }));
  }
  // Ended well, with the results of a mission that completed in a network that was never split.
  nlohmann::json expect_complete(pid_t fleet) {
    const auto children = children_of(fleet);
    const Outcome outcome = finish(fleet);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    for (const pid_t child : children) EXPECT_FALSE(runs(child)) << child;
    EXPECT_FALSE(exists("result/fleet.journal"));
    EXPECT_TRUE(exists("result/run.mcap") && exists("result/run.csv"));
    const auto whole = nlohmann::json::parse(read("result/run.json"), nullptr, false);
    auto result = whole.value("result", nlohmann::json::object());
    EXPECT_TRUE(result.contains("complete") && result["complete"] == true)
        << result.dump(1).substr(0, 2000) << outcome.err;
    return result;
  }
};

TEST_F(FleetProgram, CompletesAndSaysWhatARunSays) {
  const Outcome outcome = run({"fleet", three_targets, "--speed", "5", "--out", "result"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* words :
       {"COMPLETE after", "network    in one piece at every tick", "control period", "the recording", "0 by robots"})
    EXPECT_TRUE(has(outcome.out, words)) << words << "\n" << outcome.out;
  EXPECT_FALSE(has(outcome.out, "hash"));  // nothing that can be repeated to the bit
  EXPECT_TRUE(exists("result/run.mcap"));
}

TEST_F(FleetProgram, GoesOnWhenARobotAndTheHubAreKilled) {
  // A robot is back after a second of the wall; at a speed of 5 it would count as dead by then.
  const pid_t fleet = start_fleet({"--loss", "0.1", "--set", "mission.stop_when_complete=false", "--set",
                                   "mission.time_limit_s=30", "--set", "mission.algorithm=convoy"},
                                  30, "3");
  kill_and_wait(robot(fleet, 4), [&] { return robot(fleet, 4); });
  kill_and_wait(hub(fleet), [&] { return hub(fleet); });
  kill_and_wait(robot(fleet, 2), [&] { return robot(fleet, 2); });
  const auto result = expect_complete(fleet);
  EXPECT_EQ(result["ticks"], 300);  // of the whole mission, not of the second hub's
  EXPECT_EQ(result["deaths"], 0);
  EXPECT_EQ(result["split_ticks_by_distance"], 0);  // who stands still for three seconds may hide others
}

TEST_F(FleetProgram, ARobotThatStaysAwayCountsAsDead) {
  const pid_t fleet = start_fleet({"--no-restart", "--set", "mission.algorithm=convoy", "--set",
                                   "mission.stop_when_complete=false", "--set", "mission.time_limit_s=40"});
  ASSERT_EQ(::kill(robot(fleet, 6), SIGKILL), 0);
  const auto result = expect_complete(fleet);
  EXPECT_EQ(result["deaths"], 1);
}

TEST_F(FleetProgram, StandsLossDelayDuplicatesAndReordering) {
  for (const char* algorithm : {"outwards", "inwards", "convoy"}) {
    const pid_t fleet =
        start_fleet({"--force", "--loss", "0.3", "--delay-ms", "20", "--jitter-ms", "10", "--duplicate", "0.1",
                     "--reorder", "0.1", "--set", std::string("mission.algorithm=") + algorithm});
    const auto result = expect_complete(fleet);
    EXPECT_EQ(result["split_ticks"], 0) << algorithm;
    std::filesystem::remove_all(home_ / "result");
  }
}

// By tc netem if there is one, which is asked of tc itself; `./check --full` runs this again in a kernel that has it.
TEST_F(FleetProgram, NetemMakesTheRadioBadWhereItIs) {
  // NOLINTNEXTLINE(cert-env33-c): only a shell has ||
  const bool there = std::system(
                         "unshare -n tc qdisc add dev lo root netem 2>/dev/null || unshare -rn tc qdisc add dev lo "
                         "root netem 2>/dev/null") == 0;
  // Option and value side by side.
  // clang-format off
  const Outcome outcome = run({"fleet", three_targets, "--speed", "5", "--set", "mission.algorithm=convoy",
                               "--loss", "0.3", "--delay-ms", "20", "--jitter-ms", "10", "--duplicate", "0.1",
                               "--reorder", "0.1", "--rate-kbit", "400", "--impairment", "netem", "--out", "result"});
  // clang-format on
  EXPECT_EQ(exists("result"), there);
  EXPECT_EQ(outcome.code, there ? 0 : 2) << outcome.err;
  const Arguments expected =
      there ? Arguments{"COMPLETE after", "in one piece at every tick",
                        "by tc netem: 30 % lost, 20 ± 10 ms late, 10 % twice, 10 % not delayed, 400 kbit/s"}
            : Arguments{"--impairment netem cannot be had here: ", "--impairment relay does the same"};
  for (const std::string& words : expected)
    EXPECT_TRUE(has(outcome.out + outcome.err, words)) << words << outcome.out << outcome.err;
}

TEST_F(FleetProgram, ARelayMakesTheRadioBadWhereNetemIsNot) {
  const Outcome outcome = run({"fleet", three_targets, "--speed", "5", "--set", "mission.algorithm=convoy", "--loss",
                               "0.1", "--loopback", "--out", "result"});
  EXPECT_TRUE(has(outcome.out, "by a relay: 10 % lost\n")) << outcome.out << outcome.err;
  const Outcome without = run({"fleet", three_targets, "--loopback", "--impairment", "netem", "--out", "neither"});
  EXPECT_EQ(without.code, 2);
  EXPECT_TRUE(has(without.err, "cannot be had here: robots have no networks of their own")) << without.err;
  const Outcome unknown = run({"fleet", three_targets, "--impairment", "magic", "--out", "neither"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_TRUE(has(unknown.err, "auto") && has(unknown.err, "netem") && has(unknown.err, "relay")) << unknown.err;
  EXPECT_FALSE(exists("neither"));
}

TEST_F(FleetProgram, CtrlCStopsAllAndLeavesValidFiles) {
  const pid_t fleet = start_fleet({"--set", "mission.stop_when_complete=false"});
  const auto children = children_of(fleet);
  EXPECT_EQ(children.size(), 10U);
  ::kill(fleet, SIGINT);
  const Outcome outcome = finish(fleet);
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_TRUE(has(outcome.err, "stopped by Ctrl-C"));
  EXPECT_FALSE(has(outcome.err, "did not confirm"));
  for (const pid_t child : children) EXPECT_FALSE(runs(child));
  EXPECT_EQ(run({"export", "result/run.mcap", "-o", "robots.csv"}).code, 0);
}

// The page's own tests look at what it shows.
TEST_F(FleetProgram, ThePageBesideItStaysUntilCtrlC) {
  write("page/index.html", "<!doctype html>");
  const pid_t fleet =
      start({"fleet", three_targets, "--speed", "10", "--out", "result", "--json", "--view"},
            {.environment = {{"BANYAN_PAGE", (home_ / "page").string()}, {"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}}});
  EXPECT_TRUE(becomes([&] { return has(read("stderr.txt"), "http://127.0.0.1:"); })) << read("stderr.txt");
  EXPECT_TRUE(exists("result/run.mcap.part"));
  const auto over = [&] { return exists("result/run.mcap") && hub(fleet) == 0 && robot(fleet, 0) == 0; };
  EXPECT_TRUE(becomes(over)) << read("stderr.txt");
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const pid_t page = child_with(fleet, " view ");
  EXPECT_GT(page, 0);
  EXPECT_TRUE(nlohmann::json::accept(read("stdout.txt"))) << read("stdout.txt");
  ::kill(fleet, SIGINT);
  EXPECT_EQ(finish(fleet).code, 0);
  EXPECT_FALSE(runs(page));
  EXPECT_TRUE(
      has(run({"fleet", three_targets, "--view", "--set", "output.record=false"}).err, "none is to be written"));
}

TEST_F(FleetProgram, AllEndWithAFleetThatIsKilled) {
  const pid_t fleet = start_fleet({"--loss", "0.1", "--set", "mission.stop_when_complete=false"});
  const auto children = children_of(fleet);
  EXPECT_EQ(children.size(), 10U);
  ::kill(fleet, SIGKILL);
  EXPECT_EQ(finish(fleet).code, 1000 + SIGKILL);
  for (const pid_t child : children) EXPECT_TRUE(becomes([&] { return !runs(child); })) << child;
}

TEST_F(FleetProgram, ARobotIsSmall) {
  const pid_t fleet = start_fleet({"--loopback", "--set", "mission.stop_when_complete=false"});
  std::istringstream status(contents("/proc/" + std::to_string(robot(fleet, 0)) + "/status"));
  unsigned long largest_kb = 0;
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) largest_kb = std::stoul(line.substr(6));
  EXPECT_GT(largest_kb, 0U);
  EXPECT_LE(largest_kb, BANYAN_ROBOT_LIMIT_KB);
  ::kill(fleet, SIGTERM);
  EXPECT_EQ(finish(fleet).code, 143);
}

// The laboratory of docs/robots.md: nine bases behind TCP, a tracker, nine robots, and a hub that simulates nothing.
class Laboratory : public FleetProgram {
 protected:
  void SetUp() override {
    FleetProgram::SetUp();
    const int port = free_port();
    hub_address_ = "127.0.0.1:" + std::to_string(port);
    poses_ = "127.0.0.1:" + std::to_string(port + 1);
    ASSERT_EQ(run({"hub", "--new-key", "fleet.key"}).code, 0);
    const std::string examples = BANYAN_EXAMPLES;
    bases_ = start({"-c", "exec python3 " + examples + "/base.py 9 " + std::to_string(port + 2) +
                              " 5 | tee seen.csv | exec python3 " + examples + "/tracker.py " + poses_},
                   {.program = "sh"});
    ASSERT_TRUE(becomes([&] { return answers(port + 2 + 8); }));
    for (int i = 0; i < 9; ++i)
      robots_.push_back(
          start({"robot", "--id", std::to_string(i), "--hub", hub_address_, "--key", "fleet.key", "--algorithm",
                 "outwards", "--speed", "5", "--base", "tcp:127.0.0.1:" + std::to_string(port + 2 + i)}));
  }
  void TearDown() override {
    for (const pid_t robot : robots_)
      if (::kill(robot, SIGTERM) == 0) finish(robot);
    for (const pid_t child : children_of(bases_)) ::kill(child, SIGTERM);
    finish(bases_);
    FleetProgram::TearDown();
  }
  [[nodiscard]] Arguments hub() const {
    return {"hub",  three_targets, "--key", "fleet.key", "--listen", hub_address_, "--poses",
            poses_, "--speed",     "5",     "--out",     "result",   "--force"};
  }
  // The latest poses that the camera has seen, one line of each robot.
  [[nodiscard]] std::map<std::string, std::string> seen() const {
    std::map<std::string, std::string> latest;
    std::istringstream lines(read("seen.csv"));
    for (std::string line; std::getline(lines, line) && !lines.eof();) latest[line.substr(0, line.find(','))] = line;
    return latest;
  }
  // Where robots stand before a mission: what differs from it later has moved.
  [[nodiscard]] std::map<std::string, std::string> seen_at_rest() const {
    EXPECT_TRUE(becomes([&] { return seen().size() == 9U; }));
    return seen();
  }
  void expect_complete(const Outcome& hub) {
    EXPECT_EQ(hub.code, 0) << hub.err;
    EXPECT_TRUE(has(hub.out, "COMPLETE after")) << hub.out;
    EXPECT_TRUE(has(hub.out, "in one piece at every tick")) << hub.out;
    if (HasFailure()) return;                                            // the robots still wait for a hub
    for (const pid_t robot : robots_) EXPECT_EQ(finish(robot).code, 0);  // the hub has stopped it
    robots_.clear();
  }
  std::string hub_address_, poses_;
  pid_t bases_ = 0;
  std::vector<pid_t> robots_;
};

void say_to(int port, const std::string& text) {
  const int s = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ::sendto(s, text.data(), text.size(), 0, reinterpret_cast<sockaddr*>(&address), sizeof address);
  ::close(s);
}

TEST_F(FleetProgram, ATrackerMaySeeWhereNoMissionCanBegin) {
  ASSERT_EQ(run({"hub", "--new-key", "fleet.key"}).code, 0);
  const int port = free_port();
  const pid_t hub = start({"hub", three_targets, "--key", "fleet.key", "--listen", "127.0.0.1:0", "--poses",
                           "127.0.0.1:" + std::to_string(port)});
  std::string poses;
  for (int i = 0; i < 9; ++i) poses += std::to_string(i) + " " + std::to_string(i == 8 ? 9.0 : 0.3 * i) + " 0 0\n";
  EXPECT_TRUE(becomes([&] { return say_to(port, poses), !runs(hub); }));
  const Outcome outcome = finish(hub);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(
      has(outcome.err,
          "where the tracker sees the robots:\n  swarm.start.positions_m: the start is not connected: 2 groups"))
      << outcome.err;
}

TEST_F(Laboratory, Completes) { expect_complete(run(hub())); }

// Steps of docs/robots.md, each of which leaves the mission going on.
TEST_F(Laboratory, KeysChangeDuringAMission) {
  using namespace std::chrono_literals;
  const std::string first = read("fleet.key");
  const std::string second = "2 " + std::string(64, 'b') + "\n";
  const auto begin = seen_at_rest();
  const pid_t mission = start(hub());
  EXPECT_TRUE(becomes([&] { return seen() != begin; }));
  for (const std::string& keys : {first + second, std::string("nonsense\n"), second + first, second}) {
    write("fleet.key", keys);
    for (const pid_t robot : robots_) ::kill(robot, SIGHUP);
    std::this_thread::sleep_for(200ms);
  }
  const Outcome outcome = finish(mission);
  EXPECT_TRUE(has(outcome.err, "fleet.key")) << outcome.err;  // the nonsense
  expect_complete(outcome);
}

// The hub waits for robots that have a key which it learns of only then.
TEST_F(Laboratory, KeysChangeWhileTheHubGathers) {
  const std::string second = "2 " + std::string(64, 'b') + "\n";
  write("hub.key", read("fleet.key"));
  std::filesystem::permissions(home_ / "hub.key", std::filesystem::perms{0600});
  write("fleet.key", second);  // which robots notice by themselves
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  Arguments arguments = hub();
  *(std::find(arguments.begin(), arguments.end(), "--key") + 1) = "hub.key";
  const pid_t mission = start(arguments);
  EXPECT_TRUE(becomes([&] { return runs(mission) && has(command_line(mission), "hub.key"); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  write("hub.key", second);
  expect_complete(finish(mission));
}

// A hub that is killed goes on from its journal, which has what the tracker saw, too.
TEST_F(Laboratory, AHubThatIsStartedAgainGoesOnWhereItWas) {
  Arguments arguments = hub();
  for (const char* more : {"--journal", "mission.journal"}) arguments.emplace_back(more);
  const pid_t first = start(arguments);
  const auto journal = home_ / "mission.journal";
  EXPECT_TRUE(becomes([&] { return std::filesystem::exists(journal) && std::filesystem::file_size(journal) > 30000; }))
      << read("stderr.txt");
  ::kill(first, SIGKILL);
  finish(first);
  const auto blind = run({"hub", three_targets, "--key", "fleet.key", "--listen", hub_address_, "--journal",
                          "mission.journal", "--resume"});
  EXPECT_EQ(blind.code, 2);
  EXPECT_TRUE(has(blind.err, "mission.journal: is the journal of a mission with a tracker; --poses is missing"))
      << blind.err;
  arguments.emplace_back("--resume");
  expect_complete(run(arguments));
  // The recording is that of the whole mission: from where robots stood in the beginning, without a gap.
  ASSERT_EQ(run({"export", "result/run.mcap", "-o", "robots.csv"}).code, 0);
  std::istringstream rows(read("robots.csv"));
  std::string row;
  std::getline(rows, row);
  std::size_t count = 0;
  for (; std::getline(rows, row); ++count) {
    std::replace(row.begin(), row.end(), ',', ' ');
    std::istringstream words(row);
    double tick = 0.0, time_s = 0.0, robot = 0.0, x = 0.0, y = 0.0;
    words >> tick >> time_s >> robot >> x >> y;
    ASSERT_EQ(tick, std::floor(static_cast<double>(count) / 9.0));
    if (count >= 9) continue;
    const std::size_t line = count / 3;  // of the start, three robots each
    EXPECT_NEAR(x, 0.32 * static_cast<double>(count % 3) - 0.32, 0.03);
    EXPECT_NEAR(y, 0.32 * static_cast<double>(line) - 0.32, 0.03);
  }
  EXPECT_EQ(count, 9 * (nlohmann::json::parse(read("result/run.json"))["result"]["ticks"].get<std::size_t>() + 1));
}

TEST_F(Laboratory, RobotsStandStillWithoutTheHubAndGoOnWithAnother) {
  using namespace std::chrono_literals;
  const auto begin = seen_at_rest();
  const pid_t first = start(hub());
  EXPECT_TRUE(becomes([&] { return seen() != begin; }));
  std::this_thread::sleep_for(300ms);
  ::kill(first, SIGKILL);
  finish(first);
  std::this_thread::sleep_for(500ms);  // 0.1 s of the wall for robots to notice; the rest for a machine that is busy
  const auto stopped = seen();
  std::this_thread::sleep_for(300ms);
  EXPECT_EQ(seen(), stopped);
  expect_complete(run(hub()));
}

// Nine robots, called cf_11 to cf_19, and a hub, none of which the others start or end.
class ComingAndGoing : public FleetProgram {
 protected:
  void SetUp() override {
    FleetProgram::SetUp();
    hub_address_ = "127.0.0.1:" + std::to_string(free_port());
    ASSERT_EQ(run({"hub", "--new-key", "fleet.key"}).code, 0);
    for (int id = 11; id < 20; ++id) start_robot(id);
  }
  void TearDown() override {
    for (const auto& [id, robot] : robots_)
      if (::kill(robot, SIGTERM) == 0) finish(robot);
    FleetProgram::TearDown();
  }
  void start_robot(int id) {
    robots_[id] = start({"robot", "--id", std::to_string(id), "--hub", hub_address_, "--key", "fleet.key",
                         "--algorithm", "convoy", "--speed", "5"});
  }
  [[nodiscard]] Arguments hub(const std::string& out) const {
    // Option and value side by side.
    // clang-format off
    return {"hub", three_targets, "--key", "fleet.key", "--listen", hub_address_, "--names", "cf_{11-19}",
            "--journal", "mission.journal", "--speed", "5", "--out", out, "--force", "--wait", "60",
            "--set", "mission.algorithm=convoy", "--set", "mission.stop_when_complete=false",
            "--set", "mission.time_limit_s=60"};
    // clang-format on
  }
  [[nodiscard]] bool told(const std::string& words) const { return has(read("stderr.txt"), words); }
  [[nodiscard]] nlohmann::json result(const std::string& out) const {
    return nlohmann::json::parse(read(out + "/run.json"))["result"];
  }
  std::string hub_address_;
  std::map<int, pid_t> robots_;
};

TEST_F(ComingAndGoing, RobotsJoinLeaveAndComeBackWhileTheMissionGoesOn) {
  pid_t mission = start(hub("result"));
  const auto journal = home_ / "mission.journal";
  EXPECT_TRUE(becomes([&] { return std::filesystem::exists(journal) && std::filesystem::file_size(journal) > 75000; }))
      << read("stderr.txt");
  start_robot(42);  // some five seconds later, an id that nobody has announced
  EXPECT_TRUE(becomes([&] { return told("s: robot cf_42 has joined"); })) << read("stderr.txt");
  ::kill(robots_[18], SIGTERM);
  EXPECT_TRUE(becomes([&] { return told("s: robot cf_18 has left"); })) << read("stderr.txt");
  EXPECT_EQ(finish(robots_[18]).code, 128 + SIGTERM);
  start_robot(18);
  EXPECT_TRUE(becomes([&] { return told("s: robot cf_18 has joined"); })) << read("stderr.txt");
  ::kill(mission, SIGKILL);
  finish(mission);
  Arguments again = hub("result");
  again.emplace_back("--resume");
  const Outcome outcome = run(again);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "COMPLETE after") && has(outcome.out, "in one piece at every tick")) << outcome.out;
  EXPECT_TRUE(has(outcome.err, "s: robot cf_42 has joined")) << outcome.err;
  const auto played = result("result");
  EXPECT_EQ(played["deaths"], 1);
  EXPECT_EQ(played["survivors"], 10);
  EXPECT_EQ(played["ticks"], 600);
  for (const auto& [id, robot] : robots_) EXPECT_EQ(finish(robot).code, 0) << id;
  robots_.clear();
  // The world is a function of the journal, those who join included.
  Arguments replay = hub("replay");
  replay.emplace_back("--resume");
  ASSERT_EQ(run(replay).code, 0);
  EXPECT_EQ(result("replay")["hash"], played["hash"]);
  // A recording has them from then on.
  ASSERT_EQ(run({"export", "result/run.mcap", "-o", "robots.csv"}).code, 0);
  std::map<int, int> rows;
  std::istringstream lines(read("robots.csv"));
  for (std::string line; std::getline(lines, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    double tick = 0.0, time_s = 0.0;
    int robot = 0;
    if (std::istringstream(line) >> tick >> time_s >> robot) ++rows[robot];
  }
  EXPECT_EQ(rows.size(), 10U);
  EXPECT_EQ(rows[8], 601);
  EXPECT_LT(rows[9], 590);
}

TEST_F(ComingAndGoing, WhoeverIsNotWantedOrTwiceThereIsNamed) {
  Arguments arguments = hub("result");
  for (const char* more : {"--room", "0"}) arguments.emplace_back(more);
  const pid_t mission = start(arguments);
  start_robot(42);
  EXPECT_TRUE(becomes([&] { return told("refused robot cf_42 at 127.0.0.1:"); })) << read("stderr.txt");
  const pid_t first = robots_[12];
  start_robot(12);
  EXPECT_TRUE(becomes([&] { return told("refused a second robot cf_12 at 127.0.0.1:"); })) << read("stderr.txt");
  ::kill(first, SIGTERM);
  finish(first);
  ::kill(mission, SIGINT);
  finish(mission);
}

// Nine robots that talk to each other, each with a base that measures the others; nobody else takes part.
class WithoutAHub : public FleetProgram {
 protected:
  static constexpr int count = 9;
  static constexpr double reach_m = 2.0;
  static constexpr std::array<std::array<double, 2>, 3> targets{{{0.0, 1.6}, {-1.386, -0.8}, {1.386, -0.8}}};

  void SetUp() override {
    FleetProgram::SetUp();
    port_ = free_port();
    ASSERT_EQ(run({"hub", "--new-key", "fleet.key"}).code, 0);
    std::string command =
        std::string("exec python3 ") + BANYAN_EXAMPLES + "/base.py 9 " + std::to_string(port_ + count) + " 5 2";
    for (const auto& [x, y] : targets) command += " " + std::to_string(x) + "," + std::to_string(y);
    bases_ = start({"-c", command + " > seen.csv"}, {.program = "sh"});
    ASSERT_TRUE(becomes([&] { return answers(port_ + 2 * count - 1); }));
    robots_.resize(count);
    for (int i = count - 1; i >= 0; --i) start_robot(i, i == 0);
  }
  void TearDown() override {
    for (const pid_t robot : robots_)
      if (robot > 0 && ::kill(robot, SIGKILL) == 0) finish(robot);
    ::kill(bases_, SIGTERM);
    finish(bases_);
    FleetProgram::TearDown();
  }
  void start_robot(int i, bool root) {
    // Option and value side by side.
    // clang-format off
    Arguments arguments{"robot", "--id", std::to_string(i), "--listen", address(i), "--peers", others_than(i),
                        "--key", "fleet.key", "--speed", "5",
                        "--base", "tcp:127.0.0.1:" + std::to_string(port_ + count + i), "--tell", address(3 * count)};
    // clang-format on
    if (root) arguments.emplace_back("--root");
    if (i >= 1 && i <= 3) arguments.emplace_back("--worker");
    robots_[static_cast<std::size_t>(i)] = start(arguments);
  }
  [[nodiscard]] std::string address(int i) const { return "127.0.0.1:" + std::to_string(port_ + i); }
  [[nodiscard]] std::string others_than(int self) const {
    std::string list;
    for (int i = 0; i < count; ++i)
      if (i != self) list += (list.empty() ? "" : ",") + address(i);
    return list;
  }
  using Places = std::array<std::array<double, 2>, count>;
  // Where all of them were at each moment that has been written.
  [[nodiscard]] std::vector<Places> seen() const {
    std::vector<Places> moments;
    Places now{};
    std::istringstream lines(read("seen.csv"));
    for (std::string line; std::getline(lines, line) && !lines.eof();) {
      std::size_t i = 0;
      double x = 0.0, y = 0.0;
      char comma = 0;
      if (!(std::istringstream(line) >> i >> comma >> x >> comma >> y)) continue;
      now.at(i) = {x, y};
      if (i == count - 1) moments.push_back(now);
    }
    return moments;
  }
  static double distance(const std::array<double, 2>& a, const std::array<double, 2>& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1]);
  }
  [[nodiscard]] bool is_complete() const {
    const auto moments = seen();
    for (std::size_t k = 0; k < targets.size(); ++k)
      if (moments.empty() || distance(moments.back()[k + 1], targets[k]) > 0.2) return false;
    return true;
  }
  static bool is_in_one_piece(const Places& places) {
    std::vector<std::size_t> reached{0};
    std::array<bool, count> is_reached{true};
    for (std::size_t next = 0; next < reached.size(); ++next)
      for (std::size_t j = 0; j < places.size(); ++j)
        if (!is_reached.at(j) && distance(places.at(reached[next]), places.at(j)) <= reach_m) {
          is_reached.at(j) = true;
          reached.push_back(j);
        }
    return reached.size() == places.size();
  }
  int port_ = 0;
  pid_t bases_ = 0;
  std::vector<pid_t> robots_;
};

TEST_F(WithoutAHub, TheyCompleteInOnePieceAndStopAtAWord) {
  EXPECT_TRUE(becomes([&] { return seen().size() > 1 && seen().back() != seen().front(); }));  // under way
  ::kill(robots_[8], SIGKILL);
  finish(robots_[8]);
  start_robot(8, false);
  EXPECT_TRUE(becomes([&] { return is_complete(); }));
  for (const Places& places : seen()) ASSERT_TRUE(is_in_one_piece(places));
  std::string all = others_than(-1);
  const Outcome outcome = run({"hub", "--stop", all, "--key", "fleet.key"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "stopped: robot 0, 1, 2, 3, 4, 5, 6, 7, 8\n");
  for (pid_t& robot : robots_) {
    EXPECT_EQ(finish(robot).code, 0);
    robot = 0;
  }
  EXPECT_EQ(run({"hub", "--stop", all, "--key", "fleet.key"}).code, 1);  // nobody is there any more
}

// Somebody listens: what is recorded is what they did, but for where on the floor they did it.
TEST_F(WithoutAHub, TheirMissionIsRecordedByWhatTheyTell) {
  const Outcome outcome = run({"listen", three_targets, "--key", "fleet.key", "--listen", address(3 * count), "--speed",
                               "5", "--wait", "60", "--out", "result"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const char* words : {"COMPLETE after", "network    in one piece at every tick", "the recording",
                            "places are the robots' own", " 0 datagrams dropped"})
    EXPECT_TRUE(has(outcome.out, words)) << words << "\n" << outcome.out << outcome.err;
  EXPECT_EQ(run({"export", "result/run.mcap", "-o", "robots.csv"}).code, 0);
  std::istringstream rows(read("robots.csv"));
  Places last{};
  for (std::string row; std::getline(rows, row);) {
    double time_s = 0.0, x = 0.0, y = 0.0;
    std::size_t tick = 0, i = 0;
    char comma = 0;
    if (std::istringstream(row) >> tick >> comma >> time_s >> comma >> i >> comma >> x >> comma >> y)
      last.at(i) = {x, y};
  }
  double best_m = 1e9;  // the moment of the last tick is one of those that were seen
  for (const Places& truth : seen()) {
    double worst_m = 0.0;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < i; ++j)
        worst_m = std::max(worst_m, std::fabs(distance(last.at(i), last.at(j)) - distance(truth.at(i), truth.at(j))));
    best_m = std::min(best_m, worst_m);
  }
  EXPECT_LT(best_m, 0.1);
  EXPECT_TRUE(
      has(run({"listen", three_targets, "--key", "fleet.key", "--listen", address(3 * count + 1), "--wait", "0.3"}).err,
          "there was no place for robot 0, 1, 2"));
}

// One comes later, with an id of which neither the others nor whoever listens know anything.
TEST_F(WithoutAHub, WhoeverJoinsTakesPartAndIsRecorded) {
  ::kill(robots_[8], SIGKILL);
  finish(robots_[8]);
  robots_[8] = 0;
  // Option and value side by side.
  // clang-format off
  const pid_t listener = start({"listen", three_targets, "--key", "fleet.key", "--listen", address(3 * count),
                                "--speed", "5", "--wait", "60", "--out", "result", "--set", "swarm.start.layout=grid", "--set", "swarm.robots=8",
                                "--set", "mission.stop_when_complete=false", "--set", "mission.time_limit_s=30"});
  // clang-format on
  EXPECT_TRUE(becomes([&] { return exists("result/run.mcap.part"); })) << read("stderr.txt");
  std::this_thread::sleep_for(std::chrono::milliseconds(800));
  start_robot(8, false);
  const Outcome outcome = finish(listener);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "COMPLETE after")) << outcome.out << outcome.err;
  EXPECT_TRUE(has(outcome.err, "s: robot 8 has joined")) << outcome.err;
  EXPECT_FALSE(has(outcome.err, "refused")) << outcome.err;
  ASSERT_EQ(run({"export", "result/run.mcap", "-o", "robots.csv"}).code, 0);
  std::istringstream rows(read("robots.csv"));
  std::size_t count_of_last = 0, moments = 0;
  Places last{};
  for (std::string row; std::getline(rows, row);) {
    double time_s = 0.0, x = 0.0, y = 0.0;
    std::size_t tick = 0, i = 0;
    char comma = 0;
    if (!(std::istringstream(row) >> tick >> comma >> time_s >> comma >> i >> comma >> x >> comma >> y)) continue;
    last.at(i) = {x, y};
    moments += i == 0 ? 1U : 0U;
    count_of_last += i == 8 ? 1U : 0U;
  }
  EXPECT_GT(count_of_last, 50U);
  EXPECT_LT(count_of_last, moments);
  EXPECT_LT(distance(last[8], last[0]), 2.0 * reach_m);
}

TEST_F(FleetProgram, RefusesWhatCannotBe) {
  expect_refused({"fleet", three_targets, "--loss", "1"}, "from 0 to 0.99");
  expect_refused({"fleet", "-"}, "must be a file");
  expect_refused({"fleet", three_targets, "--set", "radio.rnage_m=1"}, "rnage_m");
  expect_refused({"fleet", three_targets, "--set", "battery.model=power"},
                 "nobody tells a robot that is a process its charge");
  expect_refused({"fleet", BANYAN_SCENARIOS "/three-targets.toml", "--set", "swarm.robots=65535"},
                 "a fleet has at most 65534");
  expect_refused({"hub", three_targets}, "--key is missing");
  expect_refused({"hub", three_targets, "--key", "k", "--print-robots", "--names", "cf_{1-8}"},
                 "--names has 8 names, the scenario 9 robots");
  expect_refused({"fleet", three_targets, "--names", "cf_{1-9},cf_01"}, "have the same id, 1");
  expect_refused({"hub", three_targets, "--key", "k", "--resume"}, "--resume needs --journal");
  write("loose.key", "1 " + std::string(64, 'a') + "\n");
  std::filesystem::permissions(home_ / "loose.key", std::filesystem::perms{0644});
  expect_refused({"hub", three_targets, "--key", "loose.key"}, "chmod 600");
  EXPECT_EQ(run({"hub", "--new-key", "fleet.key"}).code, 0);
  EXPECT_EQ(run({"hub", "--new-key", "fleet.key"}).code, 2);
  const auto alone = run({"hub", three_targets, "--key", "fleet.key", "--listen", "127.0.0.1:0", "--wait", "0.1"});
  EXPECT_EQ(alone.code, 1);
  EXPECT_TRUE(has(alone.err, "nothing was heard of robot 0, 1, 2, 3, 4, 5, 6, 7, 8")) << alone.err;
  const auto robot = run({"robot", "--id", "3", "--hub", "127.0.0.1:9", "--key", "fleet.key", "--set", "no_such_m=1"});
  EXPECT_EQ(robot.code, 2);
  EXPECT_TRUE(has(robot.err, "no_such_m is unknown")) << robot.err;
}

TEST_F(FleetProgram, RecordingsHaveTheNamesOfRobots) {
  const Outcome outcome =
      run({"fleet", three_targets, "--speed", "5", "--names", "cf_{01-08},lead_42", "--out", "result", "--quiet"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(has(read("result/run.mcap"), R"("names":["cf_01","cf_02","cf_03")"));
}

TEST_F(FleetProgram, RobotsAreCalledByTheirNames) {
  const auto printed = run({"hub", three_targets, "--key", "k", "--print-robots", "--names", "cf_{08-16}"});
  EXPECT_EQ(printed.code, 0) << printed.err;
  EXPECT_TRUE(printed.out.starts_with("banyan-robot --id 8 --hub")) << printed.out;
  EXPECT_TRUE(has(printed.out, "  # cf_08\nbanyan-robot --id 9 ")) << printed.out;
  ASSERT_EQ(run({"hub", "--new-key", "fleet.key"}).code, 0);
  const auto alone = run({"hub", three_targets, "--key", "fleet.key", "--listen", "127.0.0.1:0", "--wait", "0.1",
                          "--names", "cf_{08-16}"});
  EXPECT_TRUE(has(alone.err, "nothing was heard of robot cf_08, cf_09, cf_10")) << alone.err;
  const int port = free_port();
  const pid_t blind = start({"hub", three_targets, "--key", "fleet.key", "--listen", "127.0.0.1:0", "--wait", "5",
                             "--names", "cf_{08-16}", "--poses", "127.0.0.1:" + std::to_string(port)});
  EXPECT_TRUE(becomes([&] {
    say_to(port, "cf_08 0 0 0\n9 1 0 0\ncf_8 0 0 0\nwand 0 0 0\n");
    return has(read("stderr.txt"), "the tracker sees wand");
  }));
  const Outcome outcome = finish(blind);
  EXPECT_TRUE(has(outcome.err, "sees cf_8, which is no robot of this mission; did you mean cf_08?")) << outcome.err;
  EXPECT_TRUE(has(outcome.err, "did not see robot cf_10, cf_11, cf_12, cf_13, cf_14, cf_15, cf_16")) << outcome.err;
}

TEST_F(FleetProgram, AFleetMayHaveAnyIds) {
  const Outcome outcome =
      run({"fleet", three_targets, "--speed", "5", "--names", "cf_{1-8},lead_300", "--out", "result"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "COMPLETE after") && has(outcome.out, "in one piece at every tick")) << outcome.out;
  EXPECT_FALSE(has(outcome.err, "refused")) << outcome.err;
}

TEST_F(FleetProgram, TheHubPrintsTheCommandOfEachRobot) {
  const auto outcome = run({"hub", three_targets, "--key", "fleet.key", "--listen", "10.1.2.3:4600", "--print-robots",
                            "--set", "radio.range_m=2.5"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 9);
  EXPECT_TRUE(outcome.out.starts_with(
      "banyan-robot --id 0 --hub 10.1.2.3:4600 --key fleet.key --algorithm outwards --range 2.5"))
      << outcome.out;
}

}  // namespace
}  // namespace banyan::cli
