// SPDX-License-Identifier: MIT
// `banyan fleet`: a scenario as processes on this machine, a hub and robots, over real UDP.
#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>

#include "banyan/hosts/udp/fleet.hpp"
#include "banyan/hosts/udp/key.hpp"
#include "beside.hpp"
#include "commands.hpp"
#include "fleet_members.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "page_beside.hpp"
#include "ros2_beside.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

struct FleetOptions {
  RunOptions run;
  bool loopback = false;  // no network namespaces
  bool restart = true;    // robots that end unasked
  bool view = false;      // the page beside it
  bool ros2 = false;      // shown in ROS 2
  std::string names;      // of robots; "": ids from 0
  std::size_t room = 16;  // for robots that join later
  double speed = 1.0;
  std::size_t bundle = 1;
  double loss = 0.0;  // from here on: of the way from robot to robot
  double delay_ms = 0.0;
  double jitter_ms = 0.0;
  double duplicate = 0.0;
  double reorder = 0.0;
  double rate_kbit_s = 0.0;         // of each robot, either way; 0: no limit
  std::string impairment = "auto";  // who does that: "netem", "relay"; "auto": netem where it can be had
};

// The key of a fleet that lasts as long as this process: a file without a name, which its children inherit.
class MemoryKey {
 public:
  MemoryKey() : file_(::memfd_create("banyan-key", 0)) {
    if (file_ < 0 || ::fchmod(file_, S_IRUSR | S_IWUSR) != 0)
      throw CommandError(exit_lost, std::string("memfd_create: ") + std::strerror(errno));
    const std::string text = udp::new_key_text();
    if (::write(file_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
      throw CommandError(exit_lost, std::string("the fleet's key: ") + std::strerror(errno));
  }
  ~MemoryKey() { ::close(file_); }
  MemoryKey(const MemoryKey&) = delete;
  MemoryKey& operator=(const MemoryKey&) = delete;
  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

// What the options say, for the summary.
std::string text_of(const FleetOptions& options) {
  std::string text;
  const auto add = [&](const std::string& more) { text += (text.empty() ? "" : ", ") + more; };
  if (options.loss > 0.0) add(format("%g %% lost", 100.0 * options.loss));
  if (options.delay_ms > 0.0 || options.jitter_ms > 0.0)
    add(format("%g ± %g ms late", options.delay_ms, options.jitter_ms));
  if (options.duplicate > 0.0) add(format("%g %% twice", 100.0 * options.duplicate));
  if (options.reorder > 0.0) add(format("%g %% not delayed", 100.0 * options.reorder));
  if (options.rate_kbit_s > 0.0) add(format("%g kbit/s", options.rate_kbit_s));
  return text;
}

// Tells the plan who makes the radio bad: the wires, if that is wanted and can be, or else the relay.
void choose_impairment(const FleetOptions& options, udp::Fleet::Plan& plan) {
  const bool demanded = options.impairment == "netem";
  if (demanded || (options.impairment == "auto" && plan.way.any())) {
    const std::string fault =
        plan.namespaces ? udp::netem_fault(udp::per_hop(plan.way), plan.speed) : "robots have no networks of their own";
    if (demanded && !fault.empty())
      throw CommandError(exit_usage,
                         "--impairment netem cannot be had here: " + fault + "; --impairment relay does the same");
    plan.netem = fault.empty();
  }
  if (!plan.way.any()) return;
  plan.hub.insert(plan.hub.end(), {"--impairment", (plan.netem ? "by tc netem: " : "by a relay: ") + text_of(options)});
}

udp::Arguments hub_arguments(const FleetOptions& options, const std::string& key, const std::string& out,
                             const std::string& journal, int ros2) {
  // Option and value side by side.
  // clang-format off
  udp::Arguments arguments{own_program(), "hub", options.run.scenario, "--key", key, "--out", out, "--force",
                           "--journal", journal, "--speed", format("%g", options.speed), "--bundle", std::to_string(options.bundle),
                           "--room", std::to_string(options.room)};
  // clang-format on
  if (!options.names.empty()) arguments.insert(arguments.end(), {"--names", options.names});
  for (const auto& override : options.run.overrides) {
    if (override.file.empty()) arguments.insert(arguments.end(), {"--set", override.assignment});
    else arguments.insert(arguments.end(), {"--with", override.file});
  }
  if (ros2 >= 0) arguments.insert(arguments.end(), {"--ros2-socket", std::to_string(ros2)});
  if (options.run.quiet) arguments.emplace_back("--quiet");
  if (options.run.json) arguments.emplace_back("--json");
  return arguments;
}

udp::Arguments robot_arguments(const FleetOptions& options, const world::Scenario& scenario, udp::NodeId id,
                               const std::string& key) {
  udp::RobotOptions robot = robot_options(scenario, id);
  robot.key_file = key;
  robot.speed = options.speed;
  udp::Arguments arguments = udp::to_arguments(robot);
  arguments.insert(arguments.begin(), robot_program());
  return arguments;
}

int run_fleet(udp::Fleet::Plan plan) {
  udp::Fleet fleet(std::move(plan));
  bool interrupted = false;
  for (;;) {
    if (const auto code = fleet.turn()) return *code;
    if (stop_signal() == 0 || interrupted) continue;
    interrupted = true;
    fleet.interrupt(stop_signal());
  }
}

udp::Fleet::Plan make_plan(const FleetOptions& options, const world::Scenario& scenario, const udp::Roster& roster,
                           const std::string& key, const std::string& out, const std::string& journal, int ros2) {
  udp::Fleet::Plan plan;
  plan.hub = hub_arguments(options, key, out, journal, ros2);
  for (std::size_t i = 0; i < roster.size(); ++i)
    plan.robots.push_back(robot_arguments(options, scenario, roster.id(i), key));
  plan.restart = options.restart;
  plan.way = {options.loss,      options.delay_ms / 1e3, options.jitter_ms / 1e3,
              options.duplicate, options.reorder,        options.rate_kbit_s * 125.0};
  plan.speed = options.speed;
  plan.seed = scenario.seed;
  plan.namespaces = !options.loopback && udp::enter_network();
  if (!plan.namespaces && !options.loopback && !options.run.quiet)
    complain("this machine does not allow network namespaces; all robots share its loopback device");
  choose_impairment(options, plan);
  return plan;
}

int start_fleet(const FleetOptions& options) {
  if (options.run.scenario == "-")
    throw CommandError(exit_usage, "the scenario of a fleet must be a file: its hub reads it, too");
  const config::Configuration configuration = load_fleet(options.run.scenario, options.run.overrides);
  const udp::Roster roster = roster_of(options.names, options.room, configuration.scenario);
  const RunOutputs outputs(configuration, options.run.out, options.run.force);
  try {
    PageBeside page =
        options.view ? PageBeside(outputs, configuration.output) : PageBeside();  // in the network of the browser
    std::optional<Ros2Beside> ros2;                                               // likewise in the network of ROS 2
    if (options.ros2) ros2.emplace();
    const std::string journal = outputs.directory() + "/fleet.journal";
    const MemoryKey key;
    const int code = run_fleet(make_plan(options, configuration.scenario, roster, key.path(), outputs.directory(),
                                         journal, ros2 ? ros2->socket() : -1));
    std::error_code ignored;
    std::filesystem::remove(journal, ignored);
    outputs.abandon();  // if the hub has written nothing
    page.stay();
    return code;
  } catch (...) {
    outputs.abandon();
    throw;
  }
}

int fleet_command(const FleetOptions& options) {
  ::signal(SIGPIPE, SIG_IGN);
  catch_stop_signals();
  return with_fleet_errors([&] { return start_fleet(options); });
}

}  // namespace

void add_fleet(CLI::App& command, CommandAction& action) {
  auto options = std::make_shared<FleetOptions>();
  command.footer(
      "Runs a hub and a process per robot on this machine, over real UDP, each robot in a network namespace of its "
      "own\n"
      "where the machine allows it. Robots that end by themselves are started again, and so is the hub.\n"
      "Results are as from `banyan run`.\n\n"
      "Examples:\n"
      "  banyan fleet scenarios/khepera-three-targets.toml --view\n"
      "  banyan fleet scenarios/khepera-two-targets.toml --loss 0.1 --delay-ms 20 --jitter-ms 10\n"
      "  banyan fleet scenarios/khepera-three-targets.toml --set mission.algorithm=convoy --speed 5");
  command.add_option("scenario", options->run.scenario, "a scenario (.toml or .json)")->required()->type_name("FILE");
  add_results(command, options->run);
  add_members(command, *options);
  add_pace(command, *options);
  const auto way = [&](const char* name, double& value, double most, const char* meaning) {
    command.add_option(name, value, meaning)->type_name("X")->check(number_within(0.0, most));
  };
  way("--loss", options->loss, 0.99, "share of the packets lost from robot to robot");
  way("--delay-ms", options->delay_ms, 10000.0, "delay of a packet from robot to robot");
  way("--jitter-ms", options->jitter_ms, 10000.0, "how much that delay varies, uniformly, either way");
  way("--duplicate", options->duplicate, 0.99, "share of the packets that arrive twice");
  way("--reorder", options->reorder, 1.0, "share of the packets that are not delayed and so overtake others");
  way("--rate-kbit", options->rate_kbit_s, 1e9, "kbit/s for each robot, in each direction; default 0: no limit");
  command
      .add_option(
          "--impairment", options->impairment,
          "who does that: netem, the kernel, or relay, a process of ours; default auto: netem where it can be had")
      ->type_name("WHO")
      ->check(CLI::IsMember({"auto", "netem", "relay"}).description(""));
  add_page_beside(command, *options);
  add_ros2(command, *options);
  command.add_flag("--loopback", options->loopback, "no network namespaces: all share the loopback device");
  command.add_flag("!--no-restart", options->restart, "do not restart robots that have ended");
  command.callback([options, &action] { action = [options] { return fleet_command(*options); }; });
}

}  // namespace banyan::cli
