// SPDX-License-Identifier: MIT
// `banyan hub`: a scenario whose robots are processes. And `banyan robot` and `banyan ros2`, programs of their own.
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <thread>

#include "banyan/hosts/udp/hub.hpp"
#include "banyan/hosts/udp/journal.hpp"
#include "banyan/hosts/udp/peers.hpp"
#include "banyan/hosts/udp/pose_stream.hpp"
#include "banyan/hosts/udp/remote_swarm.hpp"
#include "banyan/hosts/udp/socket.hpp"
#include "banyan/world/faults.hpp"
#include "banyan/world/names.hpp"
#include "banyan/world/placement.hpp"
#include "commands.hpp"
#include "fleet_members.hpp"
#include "keep_run.hpp"
#include "options.hpp"
#include "page_beside.hpp"
#include "ros2_beside.hpp"
#include "terminal.hpp"
#include "tracked_bodies.hpp"

namespace banyan::cli {
namespace {

// Of a scenario whose robots are processes (docs/robots.md).
struct HubOptions {
  RunOptions run;
  std::string listen = "0.0.0.0:4600";
  std::string key_file;
  std::string poses;          // ADDRESS:PORT at which a tracker's poses arrive; "": bodies are simulated
  std::string names;          // of robots; "": ids from 0
  std::size_t room = 16;      // for robots that join later
  std::string journal;        // file; "": none
  bool resume = false;        // go on where the journal ends
  double wait_s = 10.0;       // for robots, before the mission begins
  double dead_after_s = 5.0;  // a robot that is silent for so long counts as dead
  double speed = 1.0;
  std::size_t bundle = 1;     // packets heard per datagram
  bool view = false;          // the page beside it
  bool ros2 = false;          // shown in ROS 2
  int ros2_socket = -1;       // likewise, by what a fleet has started; -1: by nothing
  std::string impairment;     // a line of the summary: what makes the radio bad, and how
  bool print_robots = false;  // their command lines, instead
  std::string new_key;        // make this file, instead
  std::string stop;           // ADDRESS:PORT[,...] of robots without a hub: stop them, instead
};

constexpr double blind_after_s = 0.3;  // without poses
constexpr double still_after_s = 0.5;  // a robot that is not heard for so long stands in the world, too

std::uint64_t digest_of(const std::string& text) {
  Digest digest;
  for (const char c : text) digest.add(c);
  return digest.value();
}

// The configuration is the one that was given, wherever a tracker sees robots.
std::unique_ptr<udp::HubJournal> open_journal(const HubOptions& options, const config::Configuration& configuration,
                                              udp::PoseStream* tracker) {
  if (options.journal.empty()) return nullptr;
  const std::uint64_t digest =
      digest_of(config::config_json(configuration) + options.names + " " + std::to_string(options.room));
  if (!options.resume)
    return std::make_unique<udp::HubJournal>(options.journal, digest, std::random_device{}(),
                                             tracker ? tracker->lines() : "");
  auto journal = std::make_unique<udp::HubJournal>(options.journal, digest);
  if (journal->start().empty() != (tracker == nullptr))
    throw CommandError(
        exit_usage,
        options.journal + (tracker == nullptr ? ": is the journal of a mission with a tracker; --poses is missing"
                                              : ": is the journal of a mission without a tracker; leave --poses out"));
  if (tracker != nullptr) tracker->restore(journal->start());
  return journal;
}

// What takes the place of World::step's own robots: waits for the moment of each tick.
class Conductor {
 public:
  // `tracker`: null if bodies are simulated. `ros2`: nobody is told if it has no socket.
  Conductor(udp::Hub& hub, udp::PoseStream* tracker, udp::KeyFile& keys, const HubOptions& options,
            const Ros2Mission& ros2)
      : hub_(hub), tracker_(tracker), keys_(keys), options_(options), ros2_(ros2) {}

  record::RunEnd operator()(world::World world, record::Sink& sink, world::Executor& executor,
                            const record::GoOn& go_on) {
    std::optional<Ros2Sink> ros2;
    if (ros2_.socket >= 0) ros2.emplace(sink, ros2_);
    for (std::size_t i = 0; i < hub_.roster().size() && !options_.names.empty(); ++i)
      world.call(i, hub_.roster().name(i));
    record::Simulation simulation(std::move(world), ros2 ? *ros2 : sink);
    const auto stopped = [&] { return !go_on(simulation); };
    simulation.stop_when(stopped);
    if (tracker_ != nullptr) hub_.watch(*tracker_, [&] { see(stopped); });
    if (!options_.resume) gather(stopped);
    while (!simulation.finished()) {
      const udp::FleetChanges changes = hub_.wait_for(static_cast<std::uint32_t>(simulation.world().tick()), stopped);
      if (stopped()) return end(simulation, true);
      refresh_keys();
      for (const std::size_t robot : changes.dead) bury(simulation, robot);
      coming_.insert(coming_.end(), changes.joined.begin(), changes.joined.end());
      welcome(simulation);
      if (ros2) ros2->heed(simulation);
      simulation.step(executor);
    }
    return end(simulation, false);
  }

 private:
  void refresh_keys() {
    if (const std::string fault = keys_.refresh(); !fault.empty()) complain(fault);
    hub_.use(keys_.keys());
  }

  void gather(const udp::Hub::Stopped& stopped) {
    const auto missing = hub_.gather(options_.wait_s, [&] {
      refresh_keys();
      return stopped();
    });
    if (missing.empty() || stopped()) return;
    hub_.stop_all();
    throw CommandError(
        exit_lost, format("within %g s nothing was heard of robot ", options_.wait_s) + hub_.roster().list_of(missing));
  }

  // Without poses nothing goes on: the hub is silent, so the robots stand still, until the tracker is back.
  void see(const udp::Hub::Stopped& stopped) const {
    tracker_->listen();
    if (tracker_->silence_s() > blind_after_s) complain("the tracker is silent; the mission waits");
    while (tracker_->silence_s() > blind_after_s && !stopped()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      tracker_->listen();
    }
  }

  [[nodiscard]] std::string at(const record::Simulation& simulation, std::size_t robot) const {
    return format("%.1f s: robot ", simulation.world().time_s()) + hub_.roster().name(robot);
  }

  void bury(record::Simulation& simulation, std::size_t robot) {
    std::erase(coming_, robot);
    if (simulation.world().alive()[robot] == 0) return;
    complain(at(simulation, robot) + (hub_.has_left(robot) ? " has left" : " has fallen silent and counts as dead"));
    world::Event event;
    event.action = world::Die{robot};
    simulation.intervene(event);
  }

  // One in a tick: the next stands beside it. Whoever cannot be there yet waits.
  void welcome(record::Simulation& simulation) {
    if (coming_.empty()) return;
    const std::size_t robot = coming_.front();
    const auto place = place_of(simulation.world(), robot);
    if (!place) return;
    world::Event event;
    event.action = world::Join{robot, *place};
    if (const auto faults = simulation.world().faults_now(event); !faults.empty()) {
      if (told_.insert(robot).second) complain(at(simulation, robot) + " cannot join yet: " + faults.front().text);
      return;
    }
    if (!options_.names.empty()) simulation.call(robot, hub_.roster().name(robot));
    simulation.intervene(event);
    complain(at(simulation, robot) + " has joined");
    coming_.pop_front();
    told_.erase(robot);
  }
  [[nodiscard]] std::optional<world::Vec2> place_of(const world::World& world, std::size_t robot) const {
    if (tracker_ == nullptr) return world::free_place(world);
    const auto& seen = tracker_->poses()[robot];
    return seen ? std::optional(seen->position) : std::nullopt;
  }

  record::RunEnd end(record::Simulation& simulation, bool interrupted) {
    if (const std::size_t silent = hub_.stop_all(); silent > 0)
      complain(plural(silent, "robot") + " did not confirm the stop; without the hub they stand still by themselves");
    return simulation.finish(interrupted);
  }

  udp::Hub& hub_;
  udp::PoseStream* tracker_;
  udp::KeyFile& keys_;
  const HubOptions& options_;
  Ros2Mission ros2_;
  std::deque<std::size_t> coming_;  // who have joined, and are not in the world yet
  std::set<std::size_t> told_;      // of these, for whom it was said why
};

std::string remarks_on(const udp::HubCounts& counts, const std::string& impairment) {
  std::string text = summary_line(
      "processes", format("control period %.1f ms (median), %.1f ms (99th percentile), %.1f ms (longest); %s late",
                          counts.periods.quantile_ms(0.5), counts.periods.quantile_ms(0.99),
                          counts.periods.longest_ms(), plural(counts.late_ticks, "tick").c_str()));
  text +=
      summary_line("datagrams", format("%s to robots, %s from them", grouped(static_cast<double>(counts.sent)).c_str(),
                                       grouped(static_cast<double>(counts.received)).c_str()));
  if (!impairment.empty()) text += summary_line("impairment", impairment);
  std::string dropped;
  for (std::size_t k = 0; k < udp::drop_kinds; ++k) {
    if (counts.dropped[k] == 0) continue;
    dropped += (dropped.empty() ? "" : ", ") + grouped(static_cast<double>(counts.dropped[k])) + " " +
               udp::name_of(static_cast<udp::Drop>(k));
  }
  return text + summary_line("dropped", (dropped.empty() ? "none by the hub" : dropped + " by the hub") + ", " +
                                            grouped(static_cast<double>(counts.dropped_by_robots)) + " by robots");
}

// Until each robot has been seen.
std::unique_ptr<udp::PoseStream> open_tracker(const HubOptions& options, const udp::Roster& roster) {
  if (options.poses.empty()) return nullptr;
  auto tracker = std::make_unique<udp::PoseStream>(udp::parse_address(options.poses), roster);
  tracker->tell_unknown([&roster](const std::string& name) {
    std::vector<std::string_view> known;
    for (std::size_t i = 0; i < roster.size(); ++i) known.push_back(roster.name(i));
    const std::string near(world::nearest_name(name, known));
    complain("the tracker sees " + name + ", which is no robot of this mission" +
             (near.empty() ? "" : "; did you mean " + near + "?"));
  });
  const udp::Clock clock;
  while (!tracker->missing().empty() && clock.now_s() < options.wait_s) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    tracker->listen();
  }
  if (!tracker->missing().empty())
    throw CommandError(exit_lost, format("within %g s the tracker did not see robot ", options.wait_s) +
                                      roster.list_of(tracker->missing()));
  return tracker;
}

// The scenario with the robots where they are; refused if no mission can begin there.
world::Scenario seen_by(const udp::PoseStream& tracker, const world::Scenario& scenario) {
  world::Scenario seen = started_where_seen(scenario, tracker.poses().first(world::robot_count(scenario)));
  std::string text;
  for (const world::Fault& fault : world::faults(seen))
    if (!fault.warning) text += "\n  " + fault.key + ": " + fault.text;
  if (!text.empty()) throw CommandError(exit_usage, "no mission can begin where the tracker sees the robots:" + text);
  return seen;
}

world::World make_world(const world::Scenario& scenario, const Algorithm& remote, const udp::PoseStream* tracker) {
  if (tracker == nullptr) return {scenario, remote};
  return {scenario, remote, tracked_bodies(tracker->poses())};
}

udp::KeyFile keys_of(const HubOptions& options) {
  if (options.key_file.empty())
    throw CommandError(exit_usage, "--key is missing; make one with banyan hub --new-key FILE");
  return udp::KeyFile(options.key_file);
}

int play_scenario(const HubOptions& options) {
  config::Configuration configuration = load_fleet(options.run.scenario, options.run.overrides);
  world::Scenario& scenario = configuration.scenario;
  udp::KeyFile keys = keys_of(options);
  udp::Roster roster = roster_of(options.names, options.room, scenario);
  const auto tracker = open_tracker(options, roster);
  const auto journal = open_journal(options, configuration, tracker.get());
  if (tracker) scenario = seen_by(*tracker, scenario);
  scenario.swarm.room = roster.most() - roster.size();
  configuration.output.live = true;  // it takes as long as it takes, and somebody may want to watch
  const RunOutputs outputs(configuration, options.run.out, options.run.force || options.resume);
  PageBeside page = options.view ? PageBeside(outputs, configuration.output) : PageBeside();
  try {
    std::optional<Ros2Beside> ros2;
    if (options.ros2) ros2.emplace();
    const Ros2Mission mission{ros2 ? ros2->socket() : options.ros2_socket, configuration,
                              tracker ? RosWorld::real : RosWorld::simulated, journal ? journal->recorded().size() : 0};
    const udp::HubSettings hub_options{udp::parse_address(options.listen), scenario.tick_s, options.speed,
                                       options.dead_after_s, options.bundle};
    udp::Hub hub(hub_options, roster, keys.keys(), journal.get());
    hub.tell_refusals([](const std::string& text) { complain(text); });
    const auto silence = static_cast<std::uint32_t>(still_after_s / scenario.tick_s);
    const AlgorithmElsewhere remote = udp::remote_algorithm(world::algorithm_of(scenario), hub, silence);
    RunOptions run = options.run;
    run.threads = 1;
    world::World world = make_world(scenario, remote, tracker.get());
    const int code = keep_run(
        configuration, outputs, run, [&] { return std::move(world); },
        Conductor(hub, tracker.get(), keys, options, mission),
        [&] { return remarks_on(hub.counts(), options.impairment); });
    page.stay();
    return code;
  } catch (...) {
    outputs.abandon();
    throw;
  }
}

// Nobody knows how many there are, so whoever is there has this long to answer.
int stop_peers(const HubOptions& options) {
  constexpr double insist_s = 2.0, call_every_s = 0.05;
  const udp::KeyRing keys = keys_of(options).keys();
  const std::vector<udp::Address> addresses = udp::parse_addresses(options.stop);
  const udp::Socket socket(udp::Address{});
  const std::array<int, 1> descriptor{socket.descriptor()};
  const udp::Clock clock;
  udp::Stopper stopper(udp::new_session());
  for (double call_s = 0.0; clock.now_s() < insist_s && stop_signal() == 0; call_s += call_every_s) {
    for (const udp::Address& address : addresses) socket.send(stopper.call(keys), address);
    while (clock.wait(descriptor, call_s + call_every_s)) {
      std::array<std::uint8_t, udp::largest_datagram + 1> room{};
      udp::Address from;
      udp::Drop reason{};
      while (const auto datagram = socket.receive(room, from))
        if (const auto envelope = udp::authenticate(*datagram, keys, reason))
          for (const udp::Bytes& reply : stopper.take(*envelope, keys)) socket.send(reply, from);
    }
  }
  const udp::Roster roster = options.names.empty() ? udp::Roster(std::size_t{0}) : udp::Roster(options.names);
  std::string stopped, silent;
  for (const auto& [robot, has_stopped] : stopper.robots()) {
    std::string& list = has_stopped ? stopped : silent;
    list += (list.empty() ? "" : ", ") + roster.name_of(robot);
  }
  if (!silent.empty()) throw CommandError(exit_lost, "did not confirm the stop: robot " + silent);
  if (stopped.empty()) throw CommandError(exit_lost, "no robot has answered at " + options.stop);
  print("stopped: robot " + stopped + "\n");
  return exit_done;
}

int print_robots(const HubOptions& options) {
  const config::Configuration configuration = load_fleet(options.run.scenario, options.run.overrides);
  const udp::Roster roster = roster_of(options.names, options.room, configuration.scenario);
  std::string text;
  for (std::size_t i = 0; i < roster.size(); ++i) {
    udp::RobotOptions robot = robot_options(configuration.scenario, roster.id(i));
    robot.key_file = options.key_file.empty() ? "KEY" : options.key_file;
    robot.hub = options.listen;
    robot.speed = options.speed;
    text += "banyan-robot";
    for (const std::string& argument : udp::to_arguments(robot)) text += " " + argument;
    if (roster.name(i) != std::to_string(roster.id(i))) text += "  # " + roster.name(i);
    text += "\n";
  }
  print(text);
  return exit_done;
}

int hub_command(const HubOptions& options) {
  return with_fleet_errors([&] {
    if (!options.new_key.empty()) {
      udp::write_new_key(options.new_key);
      return static_cast<int>(exit_done);
    }
    if (!options.stop.empty()) return stop_peers(options);
    if (options.run.scenario.empty()) throw CommandError(exit_usage, "a scenario is missing; see banyan hub --help");
    if (options.resume && options.journal.empty()) throw CommandError(exit_usage, "--resume needs --journal");
    if (options.print_robots) return print_robots(options);
    ::signal(SIGPIPE, SIG_IGN);  // as in `banyan run`
    return play_scenario(options);
  });
}

}  // namespace

void add_hub(CLI::App& command, CommandAction& action) {
  auto options = std::make_shared<HubOptions>();
  command.footer(
      "Hands each robot what it can hear: packets of robots in range and in sight, with range and bearing.\n"
      "Bodies move in a simulated world as the robots command. Results are as from `banyan run`;\n"
      "docs/robots.md has the rest.\n\n"
      "Examples:\n"
      "  banyan hub --new-key fleet.key\n"
      "  banyan hub scenarios/khepera-three-targets.toml --key fleet.key --listen 192.168.1.10:4600 --print-robots\n"
      "  banyan hub scenarios/khepera-three-targets.toml --key fleet.key --listen 192.168.1.10:4600");
  command.add_option("scenario", options->run.scenario, "a scenario (.toml or .json)")->type_name("FILE");
  command.add_option("--key", options->key_file, "the fleet's keys; only their owner may read them")->type_name("FILE");
  command.add_option("--new-key", options->new_key, "make a key file and exit")->type_name("FILE");
  command
      .add_option("--stop", options->stop,
                  "stop robots that have no hub, at these addresses or at a broadcast, and exit")
      ->type_name("ADDRESSES");
  command.add_option("--listen", options->listen, "where robots find it, default 0.0.0.0:4600")
      ->type_name("ADDRESS:PORT");
  command.add_flag("--print-robots", options->print_robots, "print the command line of each robot and exit");
  add_members(command, *options);
  add_patience(command, *options);
  command.add_option("--poses", options->poses, "take poses from a tracker here, instead of simulating bodies")
      ->type_name("ADDRESS:PORT");
  command.add_option("--journal", options->journal, "keep here what robots say and the tracker sees, to resume from")
      ->type_name("FILE");
  command.add_flag("--resume", options->resume, "go on where the journal ends");
  command.add_option("--impairment", options->impairment, "for the summary")->group("");  // a fleet says it
  add_results(command, options->run);
  add_pace(command, *options);
  add_page_beside(command, *options);
  add_ros2(command, *options);
  command.add_option("--ros2-socket", options->ros2_socket, "of a fleet's --ros2")->group("");
  command.callback([options, &action] { action = [options] { return hub_command(*options); }; });
}

}  // namespace banyan::cli
