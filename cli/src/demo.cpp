// SPDX-License-Identifier: MIT
// `banyan demo`: a run to look at, with nothing to type; in the browser, or else in the terminal.
#include <signal.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <thread>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/record/simulation.hpp"
#include "commands.hpp"
#include "options.hpp"
#include "program.hpp"
#include "shipped.hpp"
#include "terminal.hpp"
#include "terminal_map.hpp"

namespace banyan::cli {
namespace {

constexpr const char* scene = "three-targets.toml";
constexpr const char* change = "targets.radius_m=6";  // far enough to see something
constexpr double pace = 4.0;                          // times as fast as the robots would drive
constexpr double frame_s = 0.4;                       // simulated, from picture to picture: ten a second

struct DemoOptions {
  bool terminal = false;
};

// Draws the run over itself in a terminal; elsewhere only its end.
class TerminalShow final : public record::Sink {
 public:
  TerminalShow() : is_terminal_(::isatty(STDOUT_FILENO) != 0) {
    style_.colour = is_terminal_ && !is_set("NO_COLOR");
    winsize size{};
    if (is_terminal_ && ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 && size.ws_row > 0) {
      style_.columns = std::clamp<int>(size.ws_col, 20, 100);
      style_.lines = std::clamp<int>(size.ws_row - 4, 8, 40);
    }
  }

  void start(const world::World& world) override {
    setting_ = record::setting_of(world);
    record::capture(world, frame_);
    view_ = record::view_of(setting_, frame_);
  }
  void tick(const world::World& world, const measure::Tick& /*tick*/) override {
    if (!is_terminal_ || world.time_s() < next_s_) return;
    next_s_ += frame_s;
    show(world);
    std::this_thread::sleep_until(begun_ + std::chrono::duration<double>(world.time_s() / pace));
  }
  void finish(const world::World& world, const record::RunEnd& /*end*/) override { show(world); }

 private:
  using Clock = std::chrono::steady_clock;

  void show(const world::World& world) {
    record::capture(world, frame_);
    const auto in_tree = std::count_if(frame_.robots.begin(), frame_.robots.end(),
                                       [](const record::RobotFrame& r) { return r.alive && r.role != Role::spare; });
    std::string text = shown_ ? format("\x1b[%dA\r\x1b[J", style_.lines + 2) : "";
    text += terminal_map(frame_, view_, style_);
    text += format("%5.1f s   %td of %zu robots in the tree\nR root  W worker  o connector  . spare  + target\n",
                   world.time_s(), in_tree, frame_.robots.size());
    print(text);
    shown_ = is_terminal_;
  }

  bool is_terminal_;
  MapStyle style_;
  record::Setting setting_;
  record::Frame frame_;
  record::Viewport view_{};
  double next_s_ = 0.0;
  bool shown_ = false;
  Clock::time_point begun_ = Clock::now();
};

int in_terminal(const std::string& file) {
  const auto loaded = config::load_configuration(file, algorithms(), {{change, ""}});
  print_problems(loaded.problems);
  if (!loaded.ok()) return exit_lost;
  catch_stop_signals();
  ::signal(SIGPIPE, SIG_IGN);
  TerminalShow show;
  world::Executor alone(1);
  const record::RunEnd end = record::run_scenario(world::World(loaded.configuration.scenario), show, alone,
                                                  [](const record::Simulation&) { return stop_signal() == 0; });
  if (end.interrupted) return exit_signal + stop_signal();
  const bool whole = end.run.disconnected_time_ratio == 0.0;
  print((end.run.complete ? format("All targets are held after %.1f s", end.run.completion_time_s)
                          : format("Not all targets are held after %.1f s", end.run.time_s)) +
        (whole ? ", and the network was in one piece all the time.\n" : ".\n") +
        "Next:  banyan run three-targets   (numbers and a recording)\n"
        "       banyan view   (missions in the browser, to interfere with)\n");
  return exit_done;
}

int demo_command(const DemoOptions& options) {
  const std::string file = shipped_scenarios() + "/" + scene;
  if (options.terminal || !has_desktop() || shipped_page().empty()) return in_terminal(file);
  std::array<std::string, 4> words{"view", file, "--set", change};
  std::array<char*, 4> arguments{};
  std::transform(words.begin(), words.end(), arguments.begin(), [](std::string& word) { return word.data(); });
  become("/proc/self/exe", arguments);
}

}  // namespace

void add_demo(CLI::App& command, CommandAction& action) {
  auto options = std::make_shared<DemoOptions>();
  command.footer(
      "Three workers drive to targets 6 m away, and the other robots keep the network in one piece: in the\n"
      "browser if there is a desktop, else in this terminal. Nothing is written.\n\n"
      "Examples:\n"
      "  banyan demo\n"
      "  banyan demo --terminal");
  command.add_flag("--terminal", options->terminal, "in the terminal, also where there is a desktop");
  action = [options] { return demo_command(*options); };
}

}  // namespace banyan::cli
