// SPDX-License-Identifier: MIT
#include "soak.hpp"

#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cinttypes>
#include <cstring>
#include <fstream>
#include <map>
#include <thread>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/config/config.hpp"
#include "isolated.hpp"
#include "journal.hpp"
#include "mission.hpp"
#include "outputs.hpp"
#include "shrink.hpp"
#include "terminal.hpp"

namespace banyan::soak {

using namespace cli;
namespace {

using Steady = std::chrono::steady_clock;

constexpr int shrinking_runs = 150;

std::size_t target_count(const world::Scenario& s) { return world::target_positions(s).size(); }

bool has(const SoakOutcome& outcome, const std::string& kind) {
  return std::any_of(outcome.findings.begin(), outcome.findings.end(),
                     [&](const Finding& f) { return f.kind == kind; });
}

std::string lines_of(const SoakOutcome& outcome, const world::Scenario& scenario) {
  std::string text;
  for (const Finding& f : outcome.findings)
    text += format("  %-16s at %7.1f s: %s%s\n", f.kind.c_str(), f.time_s, f.text.c_str(),
                   is_promised(f.kind, scenario) ? " (promised not to happen)" : "");
  return text;
}

class Soak {
 public:
  Soak(const SoakOptions& options, std::string directory)
      : options_(options),
        directory_(std::move(directory)),
        journal_(directory_ + "/soak.csv", options.seed, options.force),
        next_{options.from},
        progress_(!options.quiet) {
    processes_ = options.threads > 0 ? static_cast<std::size_t>(options.threads)
                                     : std::max<std::size_t>(1, std::thread::hardware_concurrency());
  }

  int run() {
    std::vector<Running> running;
    while (true) {
      while (running.size() < processes_ && !is_over() && !is_last()) start(running);
      if (running.empty() || stop_signal() != 0 || (is_over() && !options_.missions)) break;
      collect(running);
    }
    running.clear();
    progress_.clear();
    report();
    if (stop_signal() != 0) return exit_signal + stop_signal();
    return broken_ > 0 ? exit_lost : exit_done;
  }

 private:
  struct Running {
    std::uint64_t index;
    world::Scenario scenario;
    Isolated process;
  };

  [[nodiscard]] double elapsed_s() const { return std::chrono::duration<double>(Steady::now() - begin_).count(); }
  [[nodiscard]] bool is_over() const {
    return stop_signal() != 0 || (options_.seconds > 0.0 && elapsed_s() >= options_.seconds);
  }
  [[nodiscard]] bool is_last() const { return options_.missions && next_ >= options_.from + *options_.missions; }

  void start(std::vector<Running>& running) {
    const std::uint64_t index = next_++;
    if (journal_.has(index)) return;
    world::Scenario scenario = mission(options_.seed, index);
    Isolated process(scenario, index % 4 == 0);
    running.push_back({index, std::move(scenario), std::move(process)});
  }

  void collect(std::vector<Running>& running) {
    std::vector<pollfd> waiting;
    waiting.reserve(running.size());
    for (const Running& r : running) waiting.push_back({r.process.descriptor(), POLLIN, 0});
    static_cast<void>(::poll(waiting.data(), waiting.size(), 200));
    for (std::size_t k = running.size(); k-- > 0;) {
      const auto outcome = running[k].process.take();
      if (!outcome) continue;
      const Running ended = std::move(running[k]);
      running.erase(running.begin() + static_cast<std::ptrdiff_t>(k));
      judge(ended.index, ended.scenario, *outcome);
    }
    if (progress_.due()) show();
  }

  void show() {
    const std::string text = format("%zu missions, %zu with findings", missions_, with_findings_);
    const double of_time = options_.seconds > 0.0 ? elapsed_s() / options_.seconds : 0.0;
    const double of_missions =
        options_.missions ? static_cast<double>(missions_) / static_cast<double>(*options_.missions) : 0.0;
    progress_.show(std::min(1.0, std::max(of_time, of_missions)), text, true);
  }

  void judge(std::uint64_t index, const world::Scenario& scenario, const SoakOutcome& outcome) {
    journal_.add(row_of(index, scenario, outcome));
    ++missions_;
    complete_ += outcome.complete ? 1 : 0;
    with_findings_ += outcome.findings.empty() ? 0 : 1;
    for (const Finding& finding : outcome.findings) {
      const bool promised = is_promised(finding.kind, scenario);
      broken_ += promised ? 1 : 0;
      Count& count = counts_[finding.kind];
      ++count.all;
      count.promised += promised ? 1 : 0;
      if (promised || count.all == 1) keep(index, scenario, finding, promised);
    }
  }

  // Shrinks the first finding of each kind, and every one that breaks a promise: a known weakness only while
  // there is time, and not at all a mission that does not end, or if none is to be shrunk.
  void keep(std::uint64_t index, const world::Scenario& scenario, const Finding& finding, bool promised) {
    const auto again = [&](const world::Scenario& s) {
      if (stop_signal() != 0 || (!promised && is_over())) return false;
      const SoakOutcome outcome = Isolated(s, finding.kind == "not-reproducible").wait();
      return has(outcome, finding.kind) && (!promised || is_promised(finding.kind, s));
    };
    config::Configuration small;
    const double until_s = finding.kind == "crash" ? world::time_limit_s(scenario) : finding.time_s;
    const bool whole = options_.whole || Isolated::has_no_end(finding);
    small.scenario = shrink(scenario, until_s, again, whole ? 0 : shrinking_runs);
    small.scenario.name = finding.kind + "-" + std::to_string(index);
    small.scenario.description = format("banyan_soak --seed %" PRIu64 ", mission %" PRIu64 "%s: ", options_.seed, index,
                                        whole ? "" : ", made smaller") +
                                 finding.text;
    const std::string path = directory_ + "/" + small.scenario.name + ".toml";
    std::ofstream out(path);
    out << config::config_toml(small);
    if (!out.flush()) throw CommandError(exit_lost, "cannot write " + path + ": " + std::strerror(errno));
    progress_.clear();
    complain(format("%s%s in mission %" PRIu64 " (%s): %s; %s and %s%s:\n  banyan_soak %s",
                    promised ? "BROKEN PROMISE: " : "known weakness: ", finding.kind.c_str(), index,
                    text_of(traits_of(scenario)).c_str(), finding.text.c_str(),
                    plural(world::robot_count(small.scenario), "robot").c_str(),
                    plural(target_count(small.scenario), "target").c_str(), whole ? "" : " are enough", path.c_str()));
  }

  void report() const {
    if (options_.quiet) return;
    std::string text = format("%s in %s, seed %" PRIu64 " from mission %" PRIu64 ": %zu complete, %zu with findings",
                              plural(missions_, "mission").c_str(), duration_text(elapsed_s()).c_str(), options_.seed,
                              options_.from, complete_, with_findings_);
    text += "\n";
    for (const auto& [kind, count] : counts_)
      text += format("  %-16s %5zu %s", kind.c_str(), count.all,
                     count.promised > 0 ? format("(%zu promised not to happen)\n", count.promised).c_str() : "\n");
    text += format(
        "All of this seed in %s/soak.csv; time over the longest drive of a worker to its target, past obstacles: "
        "median, 95 %%, worst:\n",
        directory_.c_str());
    text += table_of(journal_.rows());
    text += format("Again, one alone: banyan_soak --seed %" PRIu64 " --from N --missions 1 --out DIR\n", options_.seed);
    print_text(text);
  }

  struct Count {
    std::size_t all = 0, promised = 0;
  };
  const SoakOptions& options_;
  std::string directory_;
  SoakJournal journal_;
  std::uint64_t next_;
  ProgressLine progress_;
  std::size_t processes_ = 1;
  Steady::time_point begin_ = Steady::now();
  std::size_t missions_ = 0, complete_ = 0, with_findings_ = 0, broken_ = 0;
  std::map<std::string, Count> counts_;
};

// A given scenario, watched in the same way.
int watch_file(const SoakOptions& options) {
  const config::Loaded loaded = config::load_configuration(options.file, algorithms());
  print_problems(loaded.problems);
  if (!loaded.ok()) return exit_usage;
  const world::Scenario& scenario = loaded.configuration.scenario;
  const SoakOutcome outcome = Isolated(scenario, true).wait();
  if (stop_signal() != 0) return exit_signal + stop_signal();
  print_text(format("%s (%s): %s\n", scenario.name.c_str(), text_of(traits_of(scenario)).c_str(),
                    outcome.findings.empty() ? "nothing found" : "found") +
             lines_of(outcome, scenario));
  const bool broken = std::any_of(outcome.findings.begin(), outcome.findings.end(),
                                  [&](const Finding& f) { return is_promised(f.kind, scenario); });
  return broken ? exit_lost : exit_done;
}

}  // namespace

int run_soak(const SoakOptions& options) {
  catch_stop_signals();
  if (!options.file.empty()) return watch_file(options);
  const std::string directory = options.out.empty() ? "out/soak-" + std::to_string(options.seed) : options.out;
  make_directory(directory);
  return Soak(options, directory).run();
}

}  // namespace banyan::soak
