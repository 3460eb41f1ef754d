// SPDX-License-Identifier: MIT
// `banyan tune`: from a tune file to its folder of results.
#include <signal.h>

#include <algorithm>
#include <cinttypes>
#include <filesystem>
#include <memory>
#include <thread>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/study/tune.hpp"
#include "commands.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "program.hpp"
#include "shipped.hpp"
#include "simulate_run.hpp"
#include "terminal.hpp"

namespace banyan::cli {

using config::number_text;
using study::TunePlan;
namespace {

struct TuneOptions {
  std::string file;
  std::string out;  // "": out/<name>
  int threads = 0;  // 0: all cores; under mpirun 1 per process
  bool force = false;
  bool quiet = false;
  bool dry_run = false;
};

namespace fs = std::filesystem;

// What is searched and how, for the summary and for --dry-run.
std::string plan_text(const TunePlan& plan) {
  const auto& o = plan.optimizer;
  const auto& mission = plan.worlds.front().scenario.mission;
  std::string text = summary_line("algorithm", mission.algorithm + " (" + mission.reading + ")");
  text += summary_line("fitness", std::string(study::name_of(plan.fitness.judgement)));
  text += summary_line("search", std::string(study::name_of(o.search)) + ", " + plural(o.islands, "island") + " of " +
                                     plural(o.population, "individual") + ", " + plural(o.generations, "generation") +
                                     format(", seed %" PRIu64, o.seed));
  std::string worlds;
  for (const auto& world : plan.worlds) worlds += (worlds.empty() ? "" : ", ") + world.scenario.name;
  text += summary_line("worlds", worlds);
  return text + summary_line("seeds", plural(plan.training.size(), "seed") + " to train on, " +
                                          grouped(static_cast<double>(plan.test.size())) + " to test with");
}

std::string dry_run_text(const TunePlan& plan, const std::string& directory) {
  const auto evaluations = plan.evaluations() * plan.optimizer.islands;
  const auto compared = plan.comparison_runs();
  std::string text = plan.name + ": nothing was started\n\n" + plan_text(plan);
  text += summary_line("runs", "at most " + grouped(static_cast<double>(evaluations * plan.runs() + compared)) + ": " +
                                   plural(evaluations, "evaluation") + " of " + plural(plan.runs(), "run") + ", and " +
                                   grouped(static_cast<double>(compared)) +
                                   " to compare; what cannot be run or was seen before costs none");
  text += summary_line("results", "in " + directory + "/");
  text += "\n  parameter                  from      to        start\n";
  for (std::size_t i = 0; i < plan.bounds.size(); ++i) {
    const auto& bound = plan.bounds[i];
    text +=
        format("  %-26s %-9s %-9s %s\n", bound.parameter.c_str(), number_text(bound.low).c_str(),
               number_text(bound.high).c_str(), plan.initial.empty() ? "random" : number_text(plan.initial[i]).c_str());
  }
  return text;
}

std::string score_text(const study::Fitness& fitness, const study::TuneScore& score) {
  if (score.trials == 0) return "cannot be run";
  return format("%7.4f %6.1f %% %9s %6.1f %%", fitness.of(score.merit), 100.0 * score.complete_share,
                score.median_time_s ? format("%.1f s", *score.median_time_s).c_str() : "-",
                100.0 * score.disconnected_share);
}

std::string comparison_text(const TunePlan& plan, const study::TuneResult& result) {
  const std::string columns = format("%7s %8s %9s %8s", "fitness", "complete", "median", "discon.");
  std::string text = format("  %-12s  %-37s %s\n", "", "training seeds", "test seeds");
  text += format("  %-12s  %-37s %s\n", "", columns.c_str(), columns.c_str());
  for (const auto& c : result.candidates)
    text += format("  %-12s  %-37s %s\n", c.name.c_str(), score_text(plan.fitness, c.training).c_str(),
                   score_text(plan.fitness, c.test).c_str());
  text += "\n  parameter                  best        default     bounds\n";
  const auto& best = result.candidates[0];
  const auto& untuned = result.candidates[1];
  for (std::size_t i = 0; i < plan.bounds.size(); ++i) {
    const auto& bound = plan.bounds[i];
    const double margin = 0.01 * (bound.high - bound.low);
    const bool at_bound = best.point[i] < bound.low + margin || best.point[i] > bound.high - margin;
    text += format("  %-26s %-11.6g %-11.6g %s to %s%s\n", bound.parameter.c_str(), best.point[i], untuned.point[i],
                   number_text(bound.low).c_str(), number_text(bound.high).c_str(),
                   at_bound ? "; the best is at the edge: widen them?" : "");
  }
  return text;
}

std::string summary_text(const TunePlan& plan, const study::TuneResult& result, const std::string& directory,
                         double wall_s) {
  const auto& best = result.candidates.front();
  std::string text = plan.name + format(": best fitness %.4f, %.4f on the test seeds\n\n",
                                        plan.fitness.of(best.training.merit), plan.fitness.of(best.test.merit));
  text += plan_text(plan);
  text += summary_line("work", plural(result.evaluations, "evaluation") + format(", %.1f s", wall_s) +
                                   (result.resumed_at > 0 ? format(" from generation %u on", result.resumed_at) : ""));
  text += "\n" + comparison_text(plan, result);
  text += "\n\"default\" is the scenarios without tuning; \"discon.\" is the share of runs with any disconnection.\n";
  text += "\nResults in " + directory + "/\n";
  text += "  best.toml        the best parameters; lay them over a scenario: banyan run FILE --with best.toml\n";
  text += "  tune.json        everything above, with the whole configuration\n";
  text += "  generations.csv  fitness over generations; its figure is fitness (.json, .svg, .pdf, .png)\n";
  if (plan.optimizer.search == study::Search::nsga2)
    text += "  front.csv        " + plural(result.front, "compromise") + " between the two goals\n";
  return text;
}

std::string directory_of(const TuneOptions& options, const TunePlan& plan) {
  std::string directory = options.out.empty() ? "out/" + plan.name : options.out;
  while (directory.size() > 1 && directory.ends_with('/')) directory.pop_back();
  return directory;
}

void refuse_what_is_there(const std::string& directory, bool force) {
  std::error_code error;
  if (fs::exists(directory, error) && !fs::is_directory(directory, error))
    throw CommandError(exit_usage, directory + " exists and is no directory; --out needs one");
  if (const auto foreign = study::foreign_tune_output(directory); !foreign.empty())
    throw CommandError(exit_usage, foreign +
                                       " is not from a tuning, and one would replace it; move it away, or choose "
                                       "another --out DIR");
  if (study::tune_finished(directory) && !force)
    throw CommandError(exit_usage, directory +
                                       " already holds a finished tuning; add --force to replace it, or choose "
                                       "another --out DIR");
}

// Makes sure that the tuning, and no other, may write there as long as the lock lives.
std::unique_ptr<study::TuneLock> claim(const std::string& directory, bool force) {
  refuse_what_is_there(directory, force);  // before anything is written
  make_directory(directory);
  try {
    auto lock = std::make_unique<study::TuneLock>(directory);
    refuse_what_is_there(directory, force);  // another may have finished meanwhile
    if (force) study::remove_tune_outputs(directory);
    return lock;
  } catch (const study::TuneBusy& e) { throw CommandError(exit_usage, e.what()); }
}

int threads_of(const TuneOptions& options, const study::Processes& processes) {
  if (options.threads > 0) return options.threads;
  // mpirun has counted the cores already.
  return processes.size() > 1 ? 1 : static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 256U));
}

study::TuneResult search(const TunePlan& plan, study::Workers& workers, const std::string& directory,
                         ProgressLine& progress) {
  study::TuneHooks hooks;
  hooks.stopped = [] { return stop_signal() != 0; };
  hooks.progress = [&](double share, const std::string& text) {
    if (progress.due()) progress.show(share, text, false);
  };
  hooks.drawer.script = shipped_figures();
  try {
    return study::tune(plan, workers, directory, hooks);
  } catch (const study::TuneError& e) { throw CommandError(exit_lost, e.what()); }
}

int tune_command(const TuneOptions& options) {
  study::Processes processes;
  const int threads = threads_of(options, processes);
  if (processes.rank() != 0) {
    processes.serve(simulate_run, threads);
    return exit_done;
  }
  const auto loaded = study::load_tune(options.file, algorithms());
  print_problems(loaded.problems);
  if (!loaded.ok()) return exit_usage;
  const TunePlan& plan = loaded.plan;
  const std::string directory = directory_of(options, plan);
  if (options.dry_run) {
    print_text(dry_run_text(plan, directory));
    return exit_done;
  }

  const auto lock = claim(directory, options.force);
  catch_stop_signals();
  ProgressLine progress(!options.quiet);
  const auto workers = processes.workers(simulate_run, threads);
  const auto result = search(plan, *workers, directory, progress);
  progress.clear();
  if (result.interrupted) {
    complain(std::string("stopped by ") + stop_signal_name() +
             "; the same command goes on from the last generation in " + directory);
    return exit_signal + stop_signal();
  }
  for (const auto& warning : result.warnings) complain("warning: " + warning);
  if (!options.quiet) print_text(summary_text(plan, result, directory, progress.elapsed_s()));
  return exit_done;
}

void add_tune(CLI::App& command, CommandAction& action) {
  auto options = std::make_shared<TuneOptions>();
  command.footer(
      "Writes best.toml (parameters for a scenario), tune.json, generations.csv and the figure fitness;\n"
      "nsga2 also front.csv. If it is stopped, the same command resumes there and ends with the same\n"
      "result. docs/tuning.md describes the file. Over several machines: mpirun banyan tune FILE.\n\n"
      "Examples:\n"
      "  banyan tune studies/tune-outwards-small.toml --dry-run\n"
      "  banyan tune studies/tune-outwards-small.toml --out results/tuned");
  command.add_option("file", options->file, "a tune file (.toml or .json)")->required()->type_name("FILE");
  command.add_option("-o,--out", options->out, "directory for the results, default out/<name>")
      ->type_name("DIR")
      ->check(a_name());
  command
      .add_option("-t,--threads", options->threads,
                  "runs at once, default all cores; under mpirun per process, default 1; never changes the result")
      ->type_name("N")
      ->check(whole_within(1, 256));
  command.add_flag("-f,--force", options->force, "start over, replacing what is there");
  command.add_flag("-q,--quiet", options->quiet, "no progress and no summary; warnings and errors only");
  command.add_flag("-n,--dry-run", options->dry_run, "say what would be done, and do nothing");
  command.callback([options, &action] { action = [options] { return tune_command(*options); }; });
}

}  // namespace
}  // namespace banyan::cli

int main(int argc, char** argv) {
  using namespace banyan::cli;
  return run_program({"banyan tune", tune_purpose, "", {}, add_tune}, argc, argv);
}
