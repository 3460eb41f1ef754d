// SPDX-License-Identifier: MIT
// `banyan listen`: records a mission of robots that have no hub, by what they tell. What they cannot know, where they
// are on the floor, it does not know either (chart.hpp).
#include <signal.h>

#include "banyan/hosts/udp/listener.hpp"
#include "banyan/world/faults.hpp"
#include "commands.hpp"
#include "fleet_members.hpp"
#include "keep_run.hpp"
#include "options.hpp"
#include "page_beside.hpp"
#include "terminal.hpp"
#include "tracked_bodies.hpp"

namespace banyan::cli {
namespace {

// Of a scenario whose robots are processes without a hub.
struct ListenOptions {
  RunOptions run;
  std::string listen = "0.0.0.0:4700";
  std::string key_file;
  std::string names;      // of robots; "": ids from 0
  std::size_t room = 16;  // for robots that join later
  double wait_s = 10.0;   // for robots, before the recording begins
  double dead_after_s = 5.0;
  double speed = 1.0;
  bool view = false;  // the page beside it
};

constexpr double moved_m = 0.05;  // by less a target has not moved: it is measured
constexpr double told_lately_s = 0.5;

// Which robots have a target, in their order: target k is that of the k-th.
std::vector<std::size_t> workers_of(const udp::Chart& chart, std::size_t robots) {
  std::vector<std::size_t> workers;
  for (std::size_t i = 0; i < robots; ++i)
    if (chart.target_of(i)) workers.push_back(i);
  if (workers.empty()) throw CommandError(exit_lost, "no robot says that it has a target");
  return workers;
}

// The scenario with the robots where they place each other. Each target lies where its worker stands, since a world
// sends whoever is nearest; from the first tick on it is where that robot says.
world::Scenario told_by(const udp::Listener& listener, const std::vector<std::size_t>& workers,
                        world::Scenario scenario) {
  const std::size_t robots = world::robot_count(scenario);
  scenario.mission.time_limit_s = world::time_limit_s(scenario);  // by the scenario's own targets
  scenario = started_where_seen(std::move(scenario), listener.chart().poses().first(robots));
  std::vector<world::Vec2> targets;
  targets.reserve(workers.size());
  for (const std::size_t worker : workers) targets.push_back(listener.chart().poses()[worker]->position);
  scenario.targets = targets;
  scenario.swarm.root.reset();
  for (std::size_t i = 0; i < robots; ++i)
    if (listener.last(i)->report.role == Role::root) scenario.swarm.root = i;
  std::string text;
  for (const world::Fault& fault : world::faults(scenario))
    if (!fault.warning) text += "\n  " + fault.key + ": " + fault.text;
  if (!text.empty()) throw CommandError(exit_lost, "what the robots tell cannot be:" + text);
  return scenario;
}

// Makes the ticks of a world of what has been told by then.
class Ears {
 public:
  // `has_names`: others than numbers.
  Ears(udp::Listener& listener, std::vector<std::size_t> workers, bool has_names)
      : listener_(listener), workers_(std::move(workers)), has_names_(has_names) {}

  record::RunEnd operator()(world::World world, record::Sink& sink, world::Executor& executor,
                            const record::GoOn& go_on) {
    const udp::Roster& roster = listener_.roster();
    for (std::size_t i = 0; i < roster.size() && has_names_; ++i) world.call(i, roster.name(i));
    record::Simulation simulation(std::move(world), sink);
    const auto stopped = [&] { return !go_on(simulation); };
    simulation.stop_when(stopped);
    while (!simulation.finished() && living(simulation.world()) > 0) {
      const udp::FleetChanges changes =
          listener_.wait_for(static_cast<std::uint32_t>(simulation.world().tick()), stopped);
      if (stopped()) return simulation.finish(true);
      for (const std::size_t robot : changes.dead) {
        complain(at(simulation, robot) + " has fallen silent and counts as dead");
        happen(simulation, world::Die{robot});
      }
      for (const std::size_t robot : changes.joined) {
        complain(at(simulation, robot) + " has joined");
        if (has_names_) simulation.call(robot, roster.name(robot));
        happen(simulation, world::Join{robot, listener_.chart().poses()[robot]->position});
      }
      for (std::size_t k = 0; k < workers_.size(); ++k) look_at_target(simulation, k);
      simulation.step(executor);
    }
    return simulation.finish(false);
  }

 private:
  static std::size_t living(const world::World& world) {
    const auto alive = world.alive();
    return static_cast<std::size_t>(std::count_if(alive.begin(), alive.end(), [](auto a) { return a != 0; }));
  }
  [[nodiscard]] std::string at(const record::Simulation& simulation, std::size_t robot) const {
    return format("%.1f s: robot ", simulation.world().time_s()) + listener_.roster().name(robot);
  }
  static void happen(record::Simulation& simulation, const world::Action& action) {
    world::Event event;
    event.action = action;
    if (const auto faults = simulation.world().faults_now(event); faults.empty()) simulation.intervene(event);
    else complain("what the robots tell cannot be: " + faults.front().text);
  }
  void look_at_target(record::Simulation& simulation, std::size_t k) const {
    const auto told = listener_.chart().target_of(workers_[k]);
    if (!told || norm(*told - simulation.world().targets()[k].position) < moved_m) return;
    happen(simulation, world::MoveTarget{.target = k, .position = *told});
  }

  udp::Listener& listener_;
  std::vector<std::size_t> workers_;
  bool has_names_;
};

std::string remarks_on(const udp::Listener& listener) {
  return summary_line("listening", format("%s accounts of robots, %s datagrams dropped; places are the robots' own",
                                          grouped(static_cast<double>(listener.received())).c_str(),
                                          grouped(static_cast<double>(listener.dropped())).c_str()));
}

void gather(udp::Listener& listener, std::size_t targets, double wait_s) {
  const auto missing = listener.gather(wait_s, targets, [] { return stop_signal() != 0; });
  if (missing.empty() || stop_signal() != 0) return;
  throw CommandError(exit_lost, format("within %g s there was no place for robot ", wait_s) +
                                    listener.roster().list_of(missing) +
                                    ": it was not heard, or measured nobody who measured it");
}

int record_mission(const ListenOptions& options) {
  config::Configuration configuration = load_fleet(options.run.scenario, options.run.overrides);
  configuration.output.live = true;
  world::Scenario& scenario = configuration.scenario;
  const udp::ListenerOptions ends{udp::parse_address(options.listen), scenario.tick_s, options.speed,
                                  options.dead_after_s};
  udp::Roster roster = roster_of(options.names, options.room, scenario);
  udp::Listener listener(ends, roster, udp::KeyFile(options.key_file).keys());
  listener.tell_refusals([](const std::string& text) { complain(text); });
  gather(listener, world::mission_targets(scenario).size(), options.wait_s);
  if (stop_signal() != 0) return exit_signal + stop_signal();
  const auto workers = workers_of(listener.chart(), world::robot_count(scenario));
  scenario = told_by(listener, workers, scenario);
  scenario.swarm.room = roster.most() - world::robot_count(scenario);
  const RunOutputs outputs(configuration, options.run.out, options.run.force);
  PageBeside page = options.view ? PageBeside(outputs, configuration.output) : PageBeside();
  try {
    const auto silence = static_cast<std::uint32_t>(told_lately_s / scenario.tick_s);
    const AlgorithmElsewhere remote = udp::remote_algorithm(world::algorithm_of(scenario), listener, silence);
    RunOptions run = options.run;
    run.threads = 1;
    world::World world(scenario, remote, tracked_bodies(listener.chart().poses()));
    const int code = keep_run(
        configuration, outputs, run, [&] { return std::move(world); }, Ears(listener, workers, !options.names.empty()),
        [&] { return remarks_on(listener); });
    page.stay();
    return code;
  } catch (...) {
    outputs.abandon();
    throw;
  }
}

int listen_command(const ListenOptions& options) {
  ::signal(SIGPIPE, SIG_IGN);
  catch_stop_signals();
  return with_fleet_errors([&] { return record_mission(options); });
}

}  // namespace

void add_listen(CLI::App& command, CommandAction& action) {
  auto options = std::make_shared<ListenOptions>();
  command.footer(
      "Robots report by --tell what they do, whom they measure and where their targets are. Their places follow from\n"
      "that, in a frame of their own. The number of robots at first, radio and bodies are as in the scenario.\n"
      "Results are as from `banyan run`.\n\n"
      "Examples:\n"
      "  banyan listen scenarios/khepera-three-targets.toml --key fleet.key --listen 192.168.1.10:4700 --view");
  command.add_option("scenario", options->run.scenario, "a scenario (.toml or .json)")->required()->type_name("FILE");
  command.add_option("--key", options->key_file, "the fleet's keys; only their owner may read them")
      ->required()
      ->type_name("FILE");
  command.add_option("--listen", options->listen, "where robots report to, their --tell; default 0.0.0.0:4700")
      ->type_name("ADDRESS:PORT");
  add_members(command, *options);
  add_patience(command, *options);
  command.add_option("--speed", options->speed, "speed of its clock, default 1; for tests")
      ->type_name("X")
      ->check(number_within(0.01, 100.0));
  add_results(command, options->run);
  add_page_beside(command, *options);
  command.callback([options, &action] { action = [options] { return listen_command(*options); }; });
}

}  // namespace banyan::cli
