// SPDX-License-Identifier: MIT
// `banyan study` and `banyan collect`: many runs, from their file to tables and figures.
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <map>
#include <thread>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/record/file.hpp"
#include "banyan/study/execute.hpp"
#include "banyan/study/folder.hpp"
#include "banyan/study/journal.hpp"
#include "banyan/study/plan.hpp"
#include "banyan/study/study.hpp"
#include "banyan/study/workers.hpp"
#include "banyan/version.hpp"
#include "commands.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "sbatch.hpp"
#include "shipped.hpp"
#include "simulate_run.hpp"
#include "study_summary.hpp"
#include "terminal.hpp"

namespace banyan::cli {

using namespace study;
namespace {

struct CollectOptions {
  StudyOptions study;
  std::vector<std::string> from;  // more folders with shards
  bool partial = false;
};

constexpr double ask_above = 100'000;   // runs
constexpr double at_most = 10'000'000;  // a plan is held in memory
constexpr double sampling_s = 2.0;      // how long an estimate may take

// "3/8"; the shard's number counts from 1.
Shard shard_of(const std::string& text) {
  if (text.empty()) return {};
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, shard.number);
  const bool slash = number.ec == std::errc{} && number.ptr != end && *number.ptr == '/';
  const auto count = std::from_chars(slash ? number.ptr + 1 : end, end, shard.count);
  const bool read = slash && count.ec == std::errc{} && count.ptr == end;
  if (!read || shard.number < 1 || shard.number > shard.count || shard.count > 100'000)
    throw CommandError(exit_usage, "--shard " + text + ": expects i/n with i from 1 to n, such as 3/8");
  return shard;
}

// Asks on a terminal; without one only --yes will do.
void confirm_number(double rows, bool yes) {
  const std::string number = grouped(rows) + " runs";
  if (rows > at_most)
    throw CommandError(exit_usage, "this study has " + number + "; " + grouped(at_most) + " are the most");
  if (rows <= ask_above || yes) return;
  if (::isatty(STDIN_FILENO) != 1)
    throw CommandError(exit_usage, "this study has " + number + "; add --yes if that is meant");
  std::fprintf(stderr, "banyan: this study has %s; go on? [y/N] ", number.c_str());
  std::fflush(stderr);
  char answer[16] = "";
  if (!std::fgets(answer, sizeof answer, stdin) || (answer[0] != 'y' && answer[0] != 'Y'))
    throw CommandError(exit_usage, "nothing was started");
}

struct Prepared {
  Study study;
  Plan plan;
};

// The study and its plan, or exit_usage after printing every problem.
bool prepare(const StudyOptions& options, Prepared& prepared) {
  auto loaded = load_study(itself_or_shipped(options.file, "studies"), options.overrides);
  if (!loaded.ok()) {
    print_problems(loaded.problems);
    return false;
  }
  prepared.study = std::move(loaded.study);
  const double rows = count_rows(prepared.study);
  confirm_number(rows, options.yes || options.dry_run);
  ProgressLine progress(!options.quiet);
  prepared.plan = make_plan(prepared.study, algorithms(), [&](double planned) {
    if (!progress.due()) return;
    const std::string text = format("%s of %s runs planned", grouped(planned).c_str(), grouped(rows).c_str());
    progress.show(planned / rows, text, false);
  });
  progress.clear();
  print_problems(prepared.plan.problems);
  return prepared.plan.ok();
}

Folder folder_of(const StudyOptions& options, const Study& study) {
  std::string path = options.out.empty() ? "out/" + study.name : options.out;
  while (path.size() > 1 && path.ends_with('/')) path.pop_back();
  return {path};
}

// Whether a study has left its results, or a beginning of them, in the folder.
bool is_of_a_study(const Folder& folder) { return !journals_in(folder.path).empty() || finished(folder).has_value(); }

// Files of these names that no study has written belong to the user.
void check_strangers(const Folder& folder) {
  if (is_of_a_study(folder)) return;
  std::error_code ignored;
  for (const auto& path :
       {folder.table(), folder.statistics(), folder.comparisons(), folder.figures(), folder.runs()}) {
    if (std::filesystem::exists(path, ignored))
      throw CommandError(exit_usage, path + " is not of a study; choose another --out DIR");
  }
}

void start_over(const Folder& folder) {
  try {
    throw_away(folder);
  } catch (const record::FileBusy& busy) { throw CommandError(exit_usage, busy.what()); }
}

// No existing results may get lost: a folder is used only if it belongs to this very study.
void check_folder(const Folder& folder, const Prepared& prepared, const StudyOptions& options) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (fs::exists(folder.path, ignored) && !fs::is_directory(folder.path, ignored))
    throw CommandError(exit_usage, folder.path + " exists and is no directory; --out needs one");
  check_strangers(folder);
  if (options.force) return;
  const auto there = finished(folder);
  if (!there || options.extend) return;
  if (there->study != prepared.study.name)
    throw CommandError(exit_usage,
                       folder.path + " holds the finished study \"" + there->study + "\"; choose another --out DIR");
  if (there->plan != plan_text(prepared.plan))
    throw CommandError(exit_usage,
                       folder.path + " holds this study finished with another plan (" +
                           grouped(static_cast<double>(there->runs)) + " runs; now " +
                           grouped(static_cast<double>(prepared.plan.runs.size())) +
                           "). --extend keeps the runs that both have and makes the tables anew, --force starts "
                           "over, or choose another --out DIR");
}

void check_builds(const Gathered& gathered, const StudyOptions& options) {
  if (options.mix_versions) return;
  for (const auto& build : gathered.builds) {
    if (build != this_build())
      throw CommandError(exit_usage,
                         "the results that are there were made by banyan " + build + ", and this is " + this_build() +
                             ": --mix-versions goes on with both, --force starts over, or choose another --out DIR");
  }
}

std::string plan_summary(const Prepared& prepared, const Shard& shard, std::size_t todo) {
  const auto& [study, plan] = prepared;
  std::string text = study.name + ": " + grouped(static_cast<double>(plan.rows.size())) + " runs\n";
  for (const auto& part : study.parts) {
    text += "  " + (part.name.empty() ? "" : part.name + ": ");
    for (const auto& axis : part.axes) {
      text += axis.name + " (";
      for (std::size_t v = 0; v < axis.values.size() && v < 12; ++v) text += (v > 0 ? ", " : "") + axis.values[v].label;
      text += axis.values.size() > 12 ? format(", ... %zu in all) x ", axis.values.size()) : ") x ";
    }
    text += format("%zu seed%s\n", part.seeds.size(), part.seeds.size() == 1 ? "" : "s");
  }
  if (plan.runs.size() < plan.rows.size())
    text += format("  %zu different simulations: parts share the others\n", plan.runs.size());
  if (!shard.whole()) text += format("  shard %zu of %zu\n", shard.number, shard.count);
  if (todo < plan.runs.size()) text += "  " + grouped(static_cast<double>(todo)) + " to do here\n";
  return text;
}

int threads_of(const StudyOptions& options, const Processes& processes) {
  if (options.threads > 0) return options.threads;
  // mpirun has counted the cores already.
  return processes.size() > 1 ? 1 : static_cast<int>(std::clamp(std::thread::hardware_concurrency(), 1U, 256U));
}

int dry_run(const Prepared& prepared, const Shard& shard, const std::vector<std::size_t>& todo, const Folder& folder,
            int at_once) {
  const double seconds = estimate_s(prepared.plan, todo, sampling_s) / at_once;
  print_text(plan_summary(prepared, shard, todo.size()) + "  about " + duration_text(seconds) +
             format(" with %d at once", at_once) + " (from sample runs); results in " + folder.path + "\n");
  return exit_done;
}

Watch progress_watch(ProgressLine& progress) {
  return [&progress](const study::Standing& now) {
    if (progress.due() && now.done > 0) {
      const double rate = static_cast<double>(now.done) / progress.elapsed_s();
      progress.show(now.share,
                    format("%s of %s done, %zu failed, %.1f/s", grouped(static_cast<double>(now.done)).c_str(),
                           grouped(static_cast<double>(now.wanted)).c_str(), now.failed, rate),
                    false);
    }
    return stop_signal() == 0;
  };
}

int finish(const Prepared& prepared, const Gathered& gathered, const Folder& folder, bool quiet) {
  const auto drawn = write_results(prepared.study, prepared.plan, gathered, folder, Drawer{shipped_figures()});
  if (!drawn.complaint.empty()) complain(drawn.complaint);
  const Results results(prepared.study, prepared.plan, gathered.outcomes);
  if (!quiet) print_text(study_summary(prepared.study, results, folder, drawn));
  if (results.failed() > 0) {
    complain(format("%zu of %zu runs failed: column \"error\" of ", results.failed(), results.rows()) + folder.table() +
             "; --retry tries them again");
    return exit_lost;
  }
  return drawn.complaint.empty() ? exit_done : exit_lost;
}

// Runs that failed earlier count as well: the exit status is about the shard, not about this call.
int finish_shard(const Plan& plan, const Shard& shard, const Outcomes& outcomes, const Folder& folder,
                 const StudyOptions& options) {
  std::size_t done = 0, failed = 0;
  for (std::size_t run = 0; run < plan.runs.size(); ++run) {
    const auto at = outcomes.find(plan.runs[run].id);
    if (!shard.holds(run) || at == outcomes.end()) continue;
    ++done;
    if (!at->second.error.empty()) ++failed;
  }
  if (!options.quiet)
    print_text(format("shard %zu of %zu is done (%zu runs, %zu failed); when all are: banyan collect ", shard.number,
                      shard.count, done, failed) +
               options.file + " --out " + folder.path + "\n");
  if (failed > 0) complain(format("%zu of %zu runs failed; --retry tries them again", failed, done));
  return failed > 0 ? exit_lost : exit_done;
}

int run_plan(const StudyOptions& options, const Prepared& prepared, const Shard& shard, Processes& processes) {
  const auto folder = folder_of(options, prepared.study);
  check_folder(folder, prepared, options);
  if (options.force && !options.dry_run) start_over(folder);
  auto gathered = options.force ? Gathered{} : gather(journals_in(folder.path), prepared.study.name);
  check_builds(gathered, options);
  const auto todo = runs_to_do(prepared.plan, shard, gathered.outcomes, options.retry);
  const int threads = threads_of(options, processes);
  if (options.dry_run) return dry_run(prepared, shard, todo, folder, threads * processes.size());
  if (!options.quiet) print_text(plan_summary(prepared, shard, todo.size()));

  make_directory(folder.path + "/journal");
  catch_stop_signals();
  ::signal(SIGPIPE, SIG_IGN);
  study::Standing standing;
  {
    Journal journal(folder.journal(shard), prepared.study.name, std::string(version), std::string(git_id()));
    const auto workers = processes.workers(simulate_run, threads);
    ProgressLine progress(!options.quiet);
    standing = execute(prepared.plan, todo, *workers, journal, folder.runs(), progress_watch(progress));
  }
  if (standing.stopped) {
    complain(format("stopped by %s after %zu of %zu runs; the same command goes on from there", stop_signal_name(),
                    standing.done, standing.wanted));
    return exit_signal + stop_signal();
  }
  gathered = gather(journals_in(folder.path), prepared.study.name);
  if (const auto missing = runs_to_do(prepared.plan, shard, gathered.outcomes, false).size(); missing > 0) {
    complain(format("%zu of %zu runs are no longer in ", missing, prepared.plan.runs.size()) + folder.path +
             "/journal, where they had been written; the same command does them again");
    return exit_lost;
  }
  if (!shard.whole()) return finish_shard(prepared.plan, shard, gathered.outcomes, folder, options);
  return finish(prepared, gathered, folder, options.quiet);
}

// Rows from other folders, so that this one is complete by itself.
void keep_collected(const Prepared& prepared, const Gathered& all, const Folder& folder) {
  const auto own = gather(journals_in(folder.path), prepared.study.name);
  Journal journal(folder.path + "/journal/collected.jsonl", prepared.study.name, std::string(version),
                  std::string(git_id()));
  for (const auto& [id, outcome] : all.outcomes) {
    if (!own.outcomes.contains(id)) journal.append({id, outcome});
  }
  journal.sync();
}

int study_command(const StudyOptions& options) {
  Processes processes;
  if (processes.rank() > 0) {
    processes.serve(simulate_run, std::max(1, options.threads));
    return exit_done;
  }
  const auto shard = shard_of(options.shard);
  if (!shard.whole() && options.force)
    throw CommandError(exit_usage,
                       "--force would throw away the other shards too; remove the folder first, or use "
                       "another --out DIR");
  if (processes.size() > 1 && options.file == "-")
    throw CommandError(exit_usage, "a study under mpirun must be a file, not standard input");
  Prepared prepared;
  if (!prepare(options, prepared)) return exit_usage;
  if (!options.sbatch.empty()) {
    if (options.file == "-") throw CommandError(exit_usage, "--sbatch needs a study in a file, not standard input");
    const auto folder = folder_of(options, prepared.study);
    const auto script = sbatch_script(options, prepared.study.name, std::filesystem::absolute(folder.path).string());
    if (options.sbatch == "-") print(script);
    else record::write_file(options.sbatch, script, options.force ? record::Existing::replace : record::Existing::keep);
    return exit_done;
  }
  return run_plan(options, prepared, shard, processes);
}

int collect_command(const CollectOptions& options) {
  Prepared prepared;
  const StudyOptions& of = options.study;
  if (!prepare(of, prepared)) return exit_usage;
  const auto folder = folder_of(of, prepared.study);
  auto sources = sources_in(folder.path);
  // A table that was kept without the rest is a source, and gather() refuses it if it is not of this study.
  const bool table_kept = sources.size() == 1 && sources.front() == folder.table();
  if (!of.force && !table_kept) check_folder(folder, prepared, of);
  for (const auto& from : options.from) {
    const auto more = sources_in(from);
    if (more.empty())
      throw CommandError(exit_usage, from + " holds no results of a study (" + from + "/journal/*.jsonl or runs.csv)");
    sources.insert(sources.end(), more.begin(), more.end());
  }
  if (sources.empty())
    throw CommandError(exit_usage, folder.path + " holds no results of a study; first run it: banyan study " + of.file);
  const auto gathered = gather(sources, prepared.study.name);
  check_builds(gathered, of);
  const auto missing = runs_to_do(prepared.plan, {}, gathered.outcomes, false);
  if (!missing.empty()) {
    complain(format("%zu of %zu runs are missing", missing.size(), prepared.plan.runs.size()) +
             (options.partial
                  ? ""
                  : "; finish the shards (banyan study --shard i/n), or add --partial to collect what is there"));
    if (!options.partial) return exit_lost;
  }
  make_directory(folder.path + "/journal");
  if (!options.from.empty() || table_kept) keep_collected(prepared, gathered, folder);
  return finish(prepared, gathered, folder, of.quiet);
}

// What `study` and `collect` have in common.
void add_study_options(CLI::App& command, StudyOptions& options) {
  command.add_option("study", options.file, "a study (.toml or .json)")->required()->type_name("FILE");
  add_overrides(command, options.overrides);
  command.add_option("-o,--out", options.out, "directory for everything, default out/<name>")
      ->type_name("DIR")
      ->check(a_name());
  command.add_flag("--extend", options.extend,
                   "the study has changed since it finished: keep the runs that both versions have");
  command.add_flag("--mix-versions", options.mix_versions, "continue with results of another version of banyan");
  command.add_flag("-y,--yes", options.yes, "do not ask, however many runs there are");
  command.add_flag("-q,--quiet", options.quiet, "no plan, no progress, no summary; warnings and errors only");
}

}  // namespace

void add_study(CLI::App& command, CommandAction& action) {
  auto options = std::make_shared<StudyOptions>();
  command.footer(
      "Writes runs.csv (a row per run), statistics.csv, comparisons.csv, figures/ and study.json. If it is\n"
      "stopped, the same command resumes there. docs/studies.md describes the file.\n\n"
      "Examples:\n"
      "  banyan study studies/first.toml --dry-run\n"
      "  banyan study studies/first.toml\n"
      "  mpirun -n 64 banyan study studies/paper.toml\n"
      "  seq 8 | parallel banyan study studies/paper.toml --shard {}/8\n"
      "  banyan study studies/paper.toml --sbatch paper.sbatch --shards 50");
  add_study_options(command, *options);
  command.add_flag("-f,--force", options->force, "delete the results that are there and start over");
  command.add_flag("-n,--dry-run", options->dry_run, "print the plan and an estimate of its time, and start nothing");
  command.add_flag("--retry", options->retry, "also run failed runs again");
  command
      .add_option("-t,--threads", options->threads,
                  "runs at once, default all cores; under mpirun per process, default 1")
      ->type_name("N")
      ->check(whole_within(1, 256));
  command.add_option("--shard", options->shard, "do the i-th of n equal parts only; `banyan collect` merges them")
      ->type_name("I/N");
  command
      .add_option("--sbatch", options->sbatch, "write a job array for Slurm to this file (-: standard output) and exit")
      ->type_name("FILE");
  command.add_option("--shards", options->shards, "tasks of that array, default 16")
      ->type_name("N")
      ->check(whole_within(1, 100000));
  command.callback([options, &action] { action = [options] { return study_command(*options); }; });
}

void add_collect(CLI::App& command, CommandAction& action) {
  auto options = std::make_shared<CollectOptions>();
  command.footer(
      "A folder in which only runs.csv was kept works, too: new statistics need no new runs.\n\n"
      "Examples:\n"
      "  banyan collect studies/paper.toml\n"
      "  banyan collect studies/paper.toml --out all shards-of-a shards-of-b");
  add_study_options(command, options->study);
  command.add_flag("-f,--force", options->study.force, "replace tables that are there, of whatever study they are");
  command.add_option("folders", options->from, "more folders with results of this study")->type_name("DIR");
  command.add_flag("--partial", options->partial, "make the tables even if runs are missing");
  command.callback([options, &action] { action = [options] { return collect_command(*options); }; });
}

}  // namespace banyan::cli
