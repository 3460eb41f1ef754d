// SPDX-License-Identifier: MIT
#include "ros2_beside.hpp"

#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <thread>
#include <utility>

#include "banyan/controller/core/printable.hpp"
#include "commands.hpp"
#include "terminal.hpp"

namespace banyan::cli {
namespace {

using ros2::feed::FeedTopic;
namespace feed = ros2::feed;

// By the wall's clock: what eyes can follow, and what a slow network carries.
constexpr double bodies_every_s = 0.02, markers_every_s = 0.09, diagnosis_every_s = 1.0;
constexpr double robots_at_full_rate = 1000;  // of markers; above, they come in proportion less often
constexpr std::size_t robots_with_links = 1000;
constexpr std::size_t most_waiting = 1000;  // datagrams
constexpr int most_asked = 100;             // in a tick
constexpr double look_every_s = 0.02;       // for signals and questions, while a tick is waited for

std::string marked(FeedTopic topic, std::uint8_t place, std::size_t robot, std::string_view part) {
  const feed::PartHead head{topic, place, static_cast<std::uint16_t>(robot)};
  std::string datagram(sizeof head, '\0');
  std::memcpy(datagram.data(), &head, sizeof head);
  return datagram.append(part);
}

// "kill of=root count=1": a kind of event and its keys. Words end at spaces outside of brackets and quotes.
std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  std::string word;
  int depth = 0;
  bool quoted = false;
  for (const char c : text) {
    if (c == '"') quoted = !quoted;
    if (!quoted && (c == '[' || c == '{')) ++depth;
    if (!quoted && (c == ']' || c == '}')) --depth;
    const bool ends = !quoted && depth <= 0 && (c == ' ' || c == '\t' || c == '\n');
    if (!ends) word += c;
    else if (!word.empty()) words.push_back(std::exchange(word, {}));
  }
  if (!word.empty()) words.push_back(word);
  return words;
}

// "events[3].robot" is robot.
std::string within_event(const std::string& key) {
  const auto dot = key.starts_with("events[") ? key.find("].") : std::string::npos;
  return dot == std::string::npos ? key : key.substr(dot + 2);
}

struct Asked {
  std::optional<world::Event> event;
  std::string fault;  // why not
};

void add_fault(std::string& text, const std::string& key, const std::string& fault) {
  text += (text.empty() ? "" : "; ") + (key.empty() ? "" : within_event(key) + ": ") + fault;
}

Asked event_of(const std::string& command, config::Configuration current, const world::World& world) {
  Asked asked;
  const std::vector<std::string> words = words_of(command);
  if (words.empty() || words.front().find('=') != std::string::npos) {
    asked.fault = "begins with no kind of event, as in: add_target position_m=[2,1]";
    return asked;
  }
  config::Node event{config::Node::Table{}, {}};
  try {
    for (std::size_t k = 0; k < words.size(); ++k) {
      const config::Override change{k == 0 ? "kind=" + words[k] : words[k], "command"};
      for (const config::Problem& problem : config::apply(event, change))
        add_fault(asked.fault, words[k], problem.text);
    }
    for (const char* key : {"time_s", "when"})
      if (event.find(key) != nullptr) add_fault(asked.fault, key, "is not for commands: they happen now");
    if (!asked.fault.empty()) return asked;
    current.scenario = world.scenario();
    const config::Loaded loaded = config::with_event(current, world.time_s(), std::move(event));
    for (const config::Problem& problem : loaded.problems)
      if (!problem.warning) add_fault(asked.fault, problem.key, problem.text);
    if (!asked.fault.empty()) return asked;
    asked.event = loaded.configuration.scenario.events.back();
    for (const world::Fault& fault : world.faults_now(*asked.event)) add_fault(asked.fault, fault.key, fault.text);
  } catch (const config::DocumentError& error) { asked.fault = error.problem.text; }
  return asked;
}

// The target that a point on the floor asks for.
std::string command_of_point(std::string_view text, std::string& fault) {
  std::array<double, 2> at{};
  if (text.size() < sizeof at) return "";
  std::memcpy(at.data(), text.data(), sizeof at);
  const std::string frame(text.substr(sizeof at));
  const std::string_view map = record::ros2::Stamp{}.map;
  if (frame != map) fault = "the point is in the frame \"" + frame + "\", not \"" + std::string(map) + "\"";
  else if (!std::isfinite(at[0]) || !std::isfinite(at[1])) fault = "the point is nowhere: a coordinate is not finite";
  return "add_target position_m=[" + config::number_text(at[0]) + "," + config::number_text(at[1]) + "]";
}

const char* name_of_source(FeedTopic topic) {
  return topic == FeedTopic::goal ? "/goal_pose" : topic == FeedTopic::click ? "/clicked_point" : "/banyan/command";
}

}  // namespace

Ros2Beside::Ros2Beside() {
  std::array<int, 2> ends{};
  std::array<std::string, 3> words{ros2_program(), "--swarm", ""};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends.data()) != 0)
    throw CommandError(exit_lost, std::string("socketpair: ") + std::strerror(errno));
  socket_ = ends[0];
  words[2] = std::to_string(ends[1]);
  std::array<char*, 4> argv{words[0].data(), words[1].data(), words[2].data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addclose(&actions, socket_);
  ::posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);  // standard output is the mission's
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);  // a terminal's Ctrl-C reaches the mission alone
  const int error = ::posix_spawn(&process_, argv[0], &actions, &attributes, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::posix_spawnattr_destroy(&attributes);
  ::close(ends[1]);
  if (error == 0 && begins()) return;
  ::close(socket_);
  if (error != 0) throw CommandError(exit_lost, words[0] + ": " + std::strerror(error));
  int status = 0;
  ::waitpid(process_, &status, 0);
  const bool bad_usage = WIFEXITED(status) && WEXITSTATUS(status) == exit_usage;
  throw CommandError(bad_usage ? exit_usage : exit_lost, "banyan-ros2 could not begin, so nothing was started");
}

// False: it has ended. One that takes long is not waited for.
bool Ros2Beside::begins() const {
  constexpr int patience_ms = 5000;
  pollfd answer{socket_, POLLIN, 0};
  if (::poll(&answer, 1, patience_ms) <= 0) return true;
  feed::PartHead head;
  return ::recv(socket_, &head, sizeof head, MSG_DONTWAIT) > 0;
}

Ros2Beside::~Ros2Beside() {
  using Clock = std::chrono::steady_clock;
  ::close(socket_);  // by which it ends
  const auto patience = Clock::now() + std::chrono::seconds(1);
  while (::waitpid(process_, nullptr, WNOHANG) == 0) {
    if (Clock::now() > patience) ::kill(process_, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

void Ros2Sink::start(const world::World& world) {
  kept_.start(world);
  say_hello(world);
  show(world, measure::at_start(world, false), true);
}

void Ros2Sink::tick(const world::World& world, const measure::Tick& tick) {
  kept_.tick(world, tick);
  if (world.size() != robots_) say_hello(world);
  show(world, tick, false);
}

void Ros2Sink::finish(const world::World& world, const record::RunEnd& end) {
  kept_.finish(world, end);
  show(world, world.tick() > 0 ? end.last : measure::at_start(world, false), true);
}

record::ros2::Stamp Ros2Sink::stamp() const {
  using namespace std::chrono;
  if (mission_.kind == RosWorld::simulated)
    return {.nanoseconds = static_cast<std::uint64_t>(std::llround(1e9 * now_.time_s))};
  const auto now = duration_cast<nanoseconds>(system_clock::now().time_since_epoch());
  return {.nanoseconds = static_cast<std::uint64_t>(now.count())};
}

// Moments that were missed are not made up for.
bool Ros2Sink::due(Moment& next, double period_s) {
  const Moment now = std::chrono::steady_clock::now();
  if (now < next) return false;
  next = now + std::chrono::duration_cast<Moment::duration>(std::chrono::duration<double>(period_s));
  return true;
}

void Ros2Sink::say_hello(const world::World& world) {
  robots_ = world.size();
  put(FeedTopic::hello, mission_.kind == RosWorld::simulated ? "\1" : std::string_view("\0", 1), robots_);
}

void Ros2Sink::show(const world::World& world, const measure::Tick& tick, bool all) {
  if (gone_ || world.tick() < mission_.first_tick) return;
  record::capture(world, now_);
  if (!record::still_holds(setting_, world)) setting_ = record::setting_of(world);
  const record::ros2::Stamp moment = stamp();
  if (mission_.kind == RosWorld::simulated) {
    record::ros2::write_clock(cdr_, moment);
    put(FeedTopic::clock, cdr_.view());
    if (due(next_bodies_, bodies_every_s) || all) show_bodies(moment);
  }
  const auto robots = static_cast<double>(now_.robots.size());
  if (due(next_markers_, markers_every_s * std::max(1.0, robots / robots_at_full_rate)) || all) {
    const bool with_links = now_.robots.size() <= robots_with_links;
    const record::RadioLinks links = with_links ? record::radio_links(setting_, now_) : record::RadioLinks{};
    record::ros2::write_markers(cdr_, moment, setting_, now_, &links);
    put(FeedTopic::markers, cdr_.view());
  }
  for (const record::RecordedEvent& event : watcher_.watch(setting_, now_, tick)) {
    record::ros2::write_log(cdr_, moment, event);
    put(FeedTopic::log, cdr_.view());
  }
  if (due(next_diagnosis_, diagnosis_every_s) || all) {
    const auto parts = record::ros2::diagnose(tick, now_.robots.size());
    record::ros2::write_diagnostics(cdr_, moment, parts);
    put(FeedTopic::diagnostics, cdr_.view());
  }
}

void Ros2Sink::show_bodies(const record::ros2::Stamp& moment) {
  record::ros2::write_transforms(cdr_, moment, now_);
  put(FeedTopic::transforms, cdr_.view());
  const bool known = shown_.robots.size() == now_.robots.size();
  const double elapsed_s = known ? now_.time_s - shown_.time_s : 0.0;
  for (std::size_t i = 0; i < std::min(now_.robots.size(), feed::most_odometers); ++i) {
    const record::RobotFrame& before = known ? shown_.robots[i] : now_.robots[i];
    record::ros2::write_odometry(cdr_, moment, i, now_.robots[i], before, elapsed_s);
    put(FeedTopic::odometry, cdr_.view(), i);
  }
  shown_ = now_;
}

void Ros2Sink::put(FeedTopic topic, std::string_view message, std::size_t robot) {
  const bool must_arrive = topic == FeedTopic::hello || topic == FeedTopic::log;
  if (gone_ || (!flush() && (!must_arrive || waiting_.size() > most_waiting))) return;
  std::uint8_t place = feed::first_part;
  for (std::size_t from = 0; from < message.size(); from += feed::largest_part) {
    if (message.size() - from <= feed::largest_part) place |= feed::last_part;
    waiting_.push_back(marked(topic, place, robot, message.substr(from, feed::largest_part)));
    place = 0;
  }
  static_cast<void>(flush());
}

// False: some must wait.
bool Ros2Sink::flush() {
  while (!waiting_.empty() && !gone_) {
    const std::string& next = waiting_.front();
    if (::send(mission_.socket, next.data(), next.size(), MSG_DONTWAIT | MSG_NOSIGNAL) >= 0) waiting_.pop_front();
    else if (errno == EAGAIN || errno == ENOBUFS) return false;
    else if (errno != EINTR) gone_ = true;
  }
  if (!gone_) return true;
  if (!waiting_.empty()) complain("banyan-ros2 has ended; the mission goes on without ROS 2");
  waiting_.clear();
  return false;
}

void Ros2Sink::put_log(std::string_view kind, const std::string& text) {
  record::ros2::write_log(cdr_, stamp(), {now_.tick, now_.time_s, std::string(kind), -1, -1, text});
  put(FeedTopic::log, cdr_.view());
}

void Ros2Sink::heed(record::Simulation& simulation) {
  if (simulation.world().tick() < mission_.first_tick) return;  // that was then
  std::array<char, sizeof(feed::PartHead) + feed::longest_command> room{};
  for (int asked = 0; asked < most_asked && !gone_; ++asked) {
    const ssize_t size = ::recv(mission_.socket, room.data(), room.size(), MSG_DONTWAIT);
    if (size < static_cast<ssize_t>(sizeof(feed::PartHead))) return;
    feed::PartHead head;
    std::memcpy(&head, room.data(), sizeof head);
    heed(simulation, head.topic, {room.data() + sizeof head, static_cast<std::size_t>(size) - sizeof head});
  }
}

void Ros2Sink::heed(record::Simulation& simulation, FeedTopic topic, std::string_view text) {
  if (topic == FeedTopic::hello) return;  // from one that took long
  std::string fault;
  const std::string command = topic == FeedTopic::command ? std::string(text) : command_of_point(text, fault);
  Asked asked;
  if (fault.empty()) asked = event_of(command, mission_.configuration, simulation.world());
  else asked.fault = fault;
  const std::string source = name_of_source(topic);
  if (asked.event) {
    simulation.intervene(*asked.event);
    return put_log("asked", source + ": " + printable_lines(command));
  }
  const std::string refusal =
      source + ": refused: " + printable_lines(asked.fault) + " (" + printable_lines(command) + ")";
  constexpr std::size_t most = 32;  // anyone may ask, and must not fill the terminal
  if (++refused_ <= most) complain(refusal);
  if (refused_ == most) complain("what else is refused stands in /rosout alone");
  put_log("refused", refusal);
}

Play played_in_ros2(const Ros2Mission& mission, double speed) {
  return [=](world::World world, record::Sink& sink, world::Executor& executor, const record::GoOn& go_on) {
    using Clock = std::chrono::steady_clock;
    Ros2Sink shown(sink, mission);
    record::Simulation simulation(std::move(world), shown);
    simulation.stop_when([&] { return !go_on(simulation); });
    const double tick_s = simulation.world().scenario().tick_s / speed;
    const auto seconds = [](double s) {
      return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
    };
    Clock::time_point next = Clock::now();
    while (!simulation.finished()) {
      for (;;) {
        if (!go_on(simulation)) return simulation.finish(true);
        const Clock::duration left = next - Clock::now();
        if (left <= Clock::duration::zero()) break;
        std::this_thread::sleep_for(std::min(left, seconds(look_every_s)));
      }
      shown.heed(simulation);
      simulation.step(executor);
      next = std::max(next + seconds(tick_s), Clock::now());  // what took too long is not made up for
    }
    return simulation.finish(false);
  };
}

}  // namespace banyan::cli
