// SPDX-License-Identifier: MIT
// The banyan program: its command line. What each command does is in the file named after it.
#include <signal.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <new>
#include <sstream>

#include "banyan/record/file.hpp"
#include "banyan/record/output_formats.hpp"
#include "banyan/version.hpp"
#include "commands.hpp"
#include "terminal.hpp"

namespace {

using namespace banyan::cli;
using namespace banyan::config;

constexpr const char* purpose =
    "Banyan: a swarm of robots deploys to several distant targets and keeps its radio\n"
    "network in one piece by growing a tree.\n";

constexpr const char* command_group = "Commands";

constexpr const char* main_footer =
    "Examples:\n"
    "  banyan run scenarios/three-targets.toml\n"
    "  banyan run scenarios/paper-large.toml --set mission.algorithm=inwards --seed 7\n"
    "  banyan validate scenarios/*.toml\n"
    "  banyan COMMAND --help\n\n"
    "Exit codes: 0 done, whether or not the mission completed; 1 failed: a file cannot be read or\n"
    "written, or an internal error; 2 bad options or a bad scenario, nothing was started; 129,\n"
    "130 or 143 stopped by SIGHUP, Ctrl-C or SIGTERM, with valid files of what was done so far.";

constexpr const char* run_footer =
    "Writes run.mcap (the recording), run.csv (one row) and run.json (the same with the whole\n"
    "configuration; `banyan run out/.../run.json` runs it again).\n\n"
    "Examples:\n"
    "  banyan run scenarios/three-targets.toml\n"
    "  banyan run scenarios/three-targets.toml --set mission.algorithm=inwards --set radio.loss=0.3\n"
    "  banyan run scenarios/paper-large.toml --seed 7 --out results/large-7 --series\n"
    "  banyan run scenarios/swarm-10000.toml --no-record --json > result.json\n\n"
    "`banyan keys` lists what can be set, `banyan algorithms` the algorithms and their parameters.";

constexpr const char* validate_footer =
    "Reports everything that is wrong at once, as file:line. The exit code is 2 if anything is.\n\n"
    "Examples:\n"
    "  banyan validate scenarios/*.toml\n"
    "  banyan validate my.toml --set swarm.robots=12 --show toml";

constexpr const char* export_footer =
    "Columns: tick, time_s, robot, x_m, y_m, heading_rad, role, phase, parent, old_parent, alive,\n"
    "connected, target.\n\n"
    "Examples:\n"
    "  banyan export out/three-targets-convoy-1/run.mcap --csv -o robots.csv\n"
    "  banyan export run.mcap --csv --from 10 --to 20 --every 10 | head";

constexpr const char* draw_footer =
    "Examples:\n"
    "  banyan draw out/three-targets-convoy-1/run.mcap --at 30 -o frame.svg\n"
    "  banyan draw run.mcap --at 30 --width 1600 --dark -o frame.png\n"
    "  banyan draw run.mcap --ids --trail 0 > end.svg";

constexpr const char* film_footer =
    "Made by ffmpeg. MP4 plays everywhere, WebM in browsers, GIF in a README. Without --speed the film\n"
    "is at most 20 s long (a GIF 12 s), 1 to 64 times as fast as the run; the last frame stays for a\n"
    "second. The view stays the same throughout the film.\n\n"
    "Examples:\n"
    "  banyan film out/three-targets-convoy-1/run.mcap -o three.mp4\n"
    "  banyan film run.mcap -o slow.mp4 --from 10 --to 20 --speed 1 --ids\n"
    "  banyan film run.mcap -o readme.gif --width 640 --height 400 --dark";

constexpr const char* view_footer =
    "Serves the page at an address of this machine, prints it and opens the browser if there is a\n"
    "desktop. Only users of this machine can reach it. Ctrl-C ends it.\n"
    "A recording that is still being written is shown live.\n\n"
    "Examples:\n"
    "  banyan view out/three-targets-convoy-1/run.mcap\n"
    "  banyan view --wait out/lab/run.mcap          (live, while it is written)\n"
    "  banyan view scenarios/three-targets.toml --set radio.loss=0.3\n"
    "  banyan view";

constexpr const char* hub_footer =
    "Hands each robot what it can hear: packets of robots in range and in sight, with range and bearing.\n"
    "Bodies move in a simulated world as the robots command. Results are as from `banyan run`;\n"
    "docs/robots.md has the rest.\n\n"
    "Examples:\n"
    "  banyan hub --new-key fleet.key\n"
    "  banyan hub scenarios/khepera-three-targets.toml --key fleet.key --listen 192.168.1.10:4600 --print-robots\n"
    "  banyan hub scenarios/khepera-three-targets.toml --key fleet.key --listen 192.168.1.10:4600";

constexpr const char* listen_footer =
    "Robots report by --tell what they do, whom they measure and where their targets are. Their places follow from\n"
    "that, in a frame of their own. The number of robots, radio and bodies are as in the scenario.\n"
    "Results are as from `banyan run`.\n\n"
    "Examples:\n"
    "  banyan listen scenarios/khepera-three-targets.toml --key fleet.key --listen 192.168.1.10:4700 --view";

constexpr const char* fleet_footer =
    "Runs a hub and a process per robot on this machine, over real UDP, each robot in a network namespace of its own\n"
    "where the machine allows it. Robots that end by themselves are started again, and so is the hub.\n"
    "Results are as from `banyan run`.\n\n"
    "Examples:\n"
    "  banyan fleet scenarios/khepera-three-targets.toml --view\n"
    "  banyan fleet scenarios/khepera-two-targets.toml --loss 0.1 --delay-ms 20 --jitter-ms 10\n"
    "  banyan fleet scenarios/khepera-three-targets.toml --set mission.algorithm=convoy --speed 5";

constexpr const char* argos_footer =
    "Writes FILE.argos, which `argos3 -c` runs from any directory, and FILE.world.toml, the scenario with all\n"
    "changes. Robots, targets and obstacles come from the scenario; the results are those of `banyan run`.\n"
    "docs/argos.md has the rest.\n\n"
    "Examples:\n"
    "  banyan argos scenarios/paper-medium.toml -o medium.argos\n"
    "  banyan argos scenarios/paper-medium.toml --set mission.algorithm=convoy --seed 7 --sight exact -o convoy.argos";

constexpr const char* algorithms_footer = "Examples:\n  banyan algorithms\n  banyan algorithms inwards --json";

constexpr const char* keys_footer =
    "Examples:\n  banyan keys\n  banyan keys radio.\n  banyan keys --markdown > docs/scenario-keys.md\n"
    "  banyan keys --columns > docs/columns.md";

constexpr const char* tune_footer =
    "Writes best.toml (parameters for a scenario), tune.json, generations.csv and the figure fitness;\n"
    "nsga2 also front.csv. If it is stopped, the same command resumes there and ends with the same\n"
    "result. docs/tuning.md describes the file. Over several machines: mpirun banyan tune FILE.\n\n"
    "Examples:\n"
    "  banyan tune studies/tune-outwards-small.toml --dry-run\n"
    "  banyan tune studies/tune-outwards-small.toml --out results/tuned";

constexpr const char* study_footer =
    "Writes runs.csv (a row per run), statistics.csv, comparisons.csv, figures/ and study.json. If it is\n"
    "stopped, the same command resumes there. docs/studies.md describes the file.\n\n"
    "Examples:\n"
    "  banyan study studies/first.toml --dry-run\n"
    "  banyan study studies/first.toml\n"
    "  mpirun -n 64 banyan study studies/paper.toml\n"
    "  seq 8 | parallel banyan study studies/paper.toml --shard {}/8\n"
    "  banyan study studies/paper.toml --sbatch paper.sbatch --shards 50";

constexpr const char* collect_footer =
    "A folder in which only runs.csv was kept works, too: new statistics need no new runs.\n\n"
    "Examples:\n"
    "  banyan collect studies/paper.toml\n"
    "  banyan collect studies/paper.toml --out all shards-of-a shards-of-b";

constexpr const char* soak_footer =
    "Runs random missions of every kind and checks, at every tick, that nothing happens that must not;\n"
    "docs/soak.md lists what that is. A mission with a finding is reduced to a smaller one, which is written\n"
    "beside the journal, soak.csv, and the command that runs it again is printed. The same seed and number\n"
    "give the same mission; called again, the soak continues after the missions in its journal. With a FILE\n"
    "it watches that scenario. The exit code is 1 if a promise of docs/soak.md was broken.\n\n"
    "Examples:\n"
    "  banyan soak --seconds 60\n"
    "  banyan soak --seed 7 --missions 1000\n"
    "  banyan soak --seed 7 --from 123 --missions 1 --out again\n"
    "  banyan soak out/soak-7/split-123.toml";

constexpr const char* bench_footer =
    "Layouts: dense-94-los (94 moving robots, about 85 in range of each), spread-94-los,\n"
    "spread-1000-los and spread-10000-los (7 neighbours each); and whole missions with convoy, mission-94\n"
    "(paper-large, 300 s), mission-1000 (benchmark-1000, 60 s) and mission-10000 (benchmark-10000, 15 s). All with\n"
    "line of sight, one thread, the full controller and all metrics at every tick.\n\n"
    "Examples:\n"
    "  banyan bench\n"
    "  banyan bench mission-94 --algorithm inwards\n"
    "  banyan bench --json > today.json";

// Collects --set and the options that are short for one, in the order given.
void add_overrides(CLI::App& command, std::vector<Override>& overrides) {
  command
      .add_option_function<std::vector<std::string>>(
          "-s,--set",
          [&overrides](const std::vector<std::string>& list) {
            for (const auto& assignment : list) overrides.push_back({assignment, "--set " + assignment});
          },
          "change a key of the scenario, such as radio.loss=0.3; may be repeated")
      ->type_name("KEY=VALUE")
      ->type_size(1)
      ->allow_extra_args(false)
      ->expected(1, 10000)
      ->take_all();
  command
      .add_option_function<std::vector<std::string>>(
          "-w,--with",
          [&overrides](const std::vector<std::string>& list) {
            for (const auto& file : list) overrides.push_back({"", "--with " + file, file});
          },
          "lay the keys of a file over the scenario, such as tuned parameters; may be repeated")
      ->type_name("FILE")
      ->type_size(1)
      ->allow_extra_args(false)
      ->expected(1, 100)
      ->take_all();
}

void add_seed(CLI::App& command, std::vector<Override>& overrides) {
  command
      .add_option_function<std::string>(
          "--seed",
          [&overrides](const std::string& seed) {
            overrides.push_back({"seed=" + seed, "--seed " + seed});
          },
          "change the scenario's seed")
      ->type_name("N");
}

// For each format of output: to have one that is not the default, and not to have one that is.
void add_outputs(CLI::App& command, std::vector<Override>& overrides) {
  for (const auto& format : banyan::record::output_formats) {
    if (format.key.empty()) continue;
    const std::string key(format.key), text = std::string(format.file) + ", " + std::string(format.what);
    const std::string name = (format.by_default ? "--no-" : "--") + key;
    const std::string assignment = "output." + key + (format.by_default ? "=false" : "=true");
    command.add_flag_function(
        name,
        [&overrides, name, assignment](std::int64_t) {
          overrides.push_back({assignment, name});
        },
        (format.by_default ? "do not write " : "also write ") + text);
  }
}

// A shell's empty variable is none.
const CLI::Validator a_name([](const std::string& text) { return text.empty() ? "must not be empty" : std::string(); },
                            "");

// CLI::Range takes nan for any number, and speaks of a value that is not in range.
template <typename Number> CLI::Validator within(Number least, Number most, const std::string& limits) {
  return {[=](const std::string& text) {
            Number value{};
            const bool fits = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
            return fits ? std::string() : "must be a " + limits + ", not \"" + text + "\"";
          },
          ""};
}

CLI::Validator number_within(double least, double most) {
  return within(least, most, "number from " + number_text(least) + " to " + number_text(most));
}

CLI::Validator whole_within(std::int64_t least, std::int64_t most) {
  return within(least, most, "whole number from " + std::to_string(least) + " to " + std::to_string(most));
}

void add_run(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<RunOptions>();
  auto* command = app.add_subcommand("run", "run a scenario and write its results")->group(command_group);
  command->footer(run_footer);
  command
      ->add_option("scenario", options->scenario,
                   "a scenario (.toml or .json), an earlier run.json, a link of the page, - for standard input")
      ->required()
      ->type_name("FILE");
  add_overrides(*command, options->overrides);
  add_seed(*command, options->overrides);
  command->add_option("-o,--out", options->out, "directory for the results, default out/<name>-<algorithm>-<seed>")
      ->type_name("DIR")
      ->check(a_name);
  command->add_flag("-f,--force", options->force, "replace results that are already there");
  command->add_flag("--json", options->json, "print the result as JSON on standard output, and nothing else there");
  command->add_flag("-q,--quiet", options->quiet, "no progress and no summary; warnings and errors only");
  add_outputs(*command, options->overrides);
  command
      ->add_option_function<std::string>(
          "--record-every",
          [options](const std::string& n) {
            options->overrides.push_back({"output.record_every=" + n, "--record-every " + n});
          },
          "record the robots at every Nth tick only")
      ->type_name("N");
  command
      ->add_option("-t,--threads", options->threads,
                   "threads within the run, default 1, or all cores from 500 robots on; never changes the result")
      ->type_name("N")
      ->check(whole_within(1, 256));
  command->callback([options, &action] { action = [options] { return run_command(*options); }; });
}

void add_validate(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<ValidateOptions>();
  auto* command = app.add_subcommand("validate", "report everything that is wrong with scenarios, without running them")
                      ->group(command_group);
  command->footer(validate_footer);
  command->add_option("files", options->files, "scenarios")->required()->type_name("FILE");
  add_overrides(*command, options->overrides);
  add_seed(*command, options->overrides);
  command->add_option("--show", options->show, "print the complete configuration, defaults included")
      ->type_name("toml|json")
      ->check(CLI::IsMember({"toml", "json"}).description(""));
  command->add_flag("--json", options->json, "print the report as JSON");
  command->add_flag("-q,--quiet", options->quiet, "say nothing about scenarios that are fine");
  command->callback([options, &action] { action = [options] { return validate_command(*options); }; });
}

// CLI11's own check lets nan through.
const CLI::Validator moment(
    [](const std::string& text) {
      double value = 0.0;
      const bool number = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value >= 0.0;
      return number ? std::string() : "must be a number of at least 0, not \"" + text + "\"";
    },
    "");

void add_export(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<ExportOptions>();
  auto* command =
      app.add_subcommand("export", "turn a recording into a table: a row per tick and robot")->group(command_group);
  command->footer(export_footer);
  command->add_option("recording", options->recording, "a run.mcap")->required()->type_name("FILE");
  command->add_flag("--csv", options->csv, "write comma-separated values (the only format, and the default)");
  command->add_option("-o,--output", options->output, "file to write, default standard output")->type_name("FILE");
  command->add_option("--from", options->from_s, "first moment, s")->type_name("S")->check(moment);
  command->add_option("--to", options->to_s, "last moment, s")->type_name("S")->check(moment);
  command->add_option("--every", options->every, "every Nth recorded tick only")
      ->type_name("N")
      ->check(whole_within(1, 1000000));
  command->add_flag("-f,--force", options->force, "replace the file if it exists");
  command->callback([options, &action] { action = [options] { return export_command(*options); }; });
}

// What `draw` and `film` have in common.
template <class Options> void add_look(CLI::App& command, Options& options) {
  command.add_flag("--links,!--no-links", options.links, "show or leave out radio links; default: show");
  command.add_flag("--blocked", options.blocked, "show pairs in range without a line of sight");
  command.add_flag("--ids", options.ids, "number the robots");
  command.add_flag("!--no-legend", options.legend, "leave out the legend");
  command.add_flag("--dark", options.dark, "light on dark");
}

void add_draw(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<DrawOptions>();
  auto* command = app.add_subcommand("draw", "draw a moment of a recording as SVG or PNG")->group(command_group);
  command->footer(draw_footer);
  command->add_option("recording", options->recording, "a run.mcap")->required()->type_name("FILE");
  command->add_option("--at", options->at_s, "the moment, s; default the end")->type_name("S")->check(moment);
  command->add_option("-o,--output", options->output, "file to write (.svg or .png), default standard output")
      ->type_name("FILE");
  command->add_option("--format", options->format, "format, whatever the file's extension; default svg")
      ->type_name("svg|png")
      ->check(CLI::IsMember({"svg", "png"}).description(""));
  command->add_option("--trail", options->trail_s, "how far back trails go, s; default 10")
      ->type_name("S")
      ->check(moment);
  command->add_option("--width", options->width_px, "width in pixels, default 1000")
      ->type_name("PX")
      ->check(number_within(200.0, 20000.0));  // as record::PictureOptions has it
  add_look(*command, *options);
  command->add_flag("-f,--force", options->force, "replace the file if it exists");
  command->callback([options, &action] { action = [options] { return draw_command(*options); }; });
}

// Pixels of a film: its encoders take pairs of them.
CLI::Validator even_size(int least, int most) {
  return {[=](const std::string& text) {
            int value = 0;
            const bool fits =
                CLI::detail::lexical_cast(text, value) && value >= least && value <= most && value % 2 == 0;
            return fits ? std::string()
                        : "must be an even number of " + std::to_string(least) + " to " + std::to_string(most) +
                              ", not \"" + text + "\"";
          },
          ""};
}

void add_film(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<FilmOptions>();
  auto* command = app.add_subcommand("film", "turn a recording into a film: MP4, WebM or GIF")->group(command_group);
  command->footer(film_footer);
  command->add_option("recording", options->recording, "a run.mcap")->required()->type_name("FILE");
  command->add_option("-o,--output", options->output, "file to write: .mp4, .webm or .gif")
      ->required()
      ->type_name("FILE");
  command->add_option("--fps", options->fps, "frames a second; default 30, for a GIF 15")
      ->type_name("N")
      ->check(whole_within(1, 120));
  command->add_option("--speed", options->speed, "seconds of the run in a second of the film, 0.1 to 64")
      ->type_name("X")
      ->check(number_within(0.1, 64.0));
  command->add_option("--from", options->from_s, "first moment, s")->type_name("S")->check(moment);
  command->add_option("--to", options->to_s, "last moment, s")->type_name("S")->check(moment);
  command->add_option("--width", options->width, "width in pixels; default 1280, for a GIF 720")
      ->type_name("PX")
      ->check(even_size(200, 7680));
  command->add_option("--height", options->height, "height in pixels; default 720, for a GIF 450")
      ->type_name("PX")
      ->check(even_size(150, 4320));
  command->add_option("--trail", options->trail_s, "how far back trails go, s; default 5")
      ->type_name("S")
      ->check(moment);
  add_look(*command, *options);
  command->add_flag("-q,--quiet", options->quiet, "no progress and no summary; warnings and errors only");
  command->add_flag("-f,--force", options->force, "replace the file if it exists");
  command->callback([options, &action] { action = [options] { return film_command(*options); }; });
}

void add_view(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<ViewOptions>();
  auto* command = app.add_subcommand("view", "show a recording or a scenario in the browser")->group(command_group);
  command->footer(view_footer);
  command
      ->add_option("file", options->file,
                   "a run.mcap, a scenario to be run in the page, or a link; none: a choice of scenarios")
      ->type_name("FILE");
  add_overrides(*command, options->overrides);
  add_seed(*command, options->overrides);
  command->add_option("--port", options->port, "port on this machine; default any that is free")
      ->type_name("N")
      ->check(whole_within(0, 65535));
  command->add_flag("!--no-open", options->open, "only print the address");
  command->add_flag("--wait", options->wait, "wait for a recording that has not begun yet");
  command->add_option("--page", options->page, "the built page; default BANYAN_PAGE, or where it was installed")
      ->type_name("DIR");
  command->add_option("--scenarios", options->scenarios, "what the page offers to run; default Banyan's own")
      ->type_name("DIR");
  command->callback([options, &action] { action = [options] { return view_command(*options); }; });
}

void add_algorithms(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<AlgorithmsOptions>();
  auto* command = app.add_subcommand("algorithms", "list the algorithms and their parameters")->group(command_group);
  command->footer(algorithms_footer);
  command->add_option("name", options->name, "only this one")->type_name("NAME");
  command->add_flag("--json", options->json, "as JSON");
  command->callback([options, &action] { action = [options] { return algorithms_command(*options); }; });
}

void add_keys(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<KeysOptions>();
  auto* command =
      app.add_subcommand("keys", "list every key of a scenario: type, range, default, meaning")->group(command_group);
  command->footer(keys_footer);
  command->add_option("prefix", options->prefix, "only keys that begin with this")->type_name("PREFIX");
  command->add_flag("--json", options->json, "as JSON");
  command->add_flag("--markdown", options->markdown, "as the page docs/scenario-keys.md");
  command->add_flag("--columns", options->columns, "the columns of results instead, as the page docs/columns.md");
  command->callback([options, &action] { action = [options] { return keys_command(*options); }; });

  auto word = std::make_shared<std::string>();
  auto* completion = app.add_subcommand("complete-keys", "")->group("");  // for the shell
  completion->add_option("word", *word);
  completion->callback([word, &action] { action = [word] { return complete_keys_command(*word); }; });
}

void add_tune(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<TuneOptions>();
  auto* command =
      app.add_subcommand("tune", "search for better controller parameters by evolution")->group(command_group);
  command->footer(tune_footer);
  command->add_option("file", options->file, "a tune file (.toml or .json)")->required()->type_name("FILE");
  command->add_option("-o,--out", options->out, "directory for the results, default out/<name>")
      ->type_name("DIR")
      ->check(a_name);
  command
      ->add_option("-t,--threads", options->threads,
                   "runs at once, default all cores; under mpirun per process, default 1; never changes the result")
      ->type_name("N")
      ->check(whole_within(1, 256));
  command->add_flag("-f,--force", options->force, "start over, replacing what is there");
  command->add_flag("-q,--quiet", options->quiet, "no progress and no summary; warnings and errors only");
  command->add_flag("-n,--dry-run", options->dry_run, "say what would be done, and do nothing");
  command->callback([options, &action] { action = [options] { return tune_command(*options); }; });
}

// What `study` and `collect` have in common.
void add_study_options(CLI::App& command, StudyOptions& options) {
  command.add_option("study", options.file, "a study (.toml or .json)")->required()->type_name("FILE");
  add_overrides(command, options.overrides);
  command.add_option("-o,--out", options.out, "directory for everything, default out/<name>")
      ->type_name("DIR")
      ->check(a_name);
  command.add_flag("--extend", options.extend,
                   "the study has changed since it finished: keep the runs that both versions have");
  command.add_flag("--mix-versions", options.mix_versions, "continue with results of another version of banyan");
  command.add_flag("-y,--yes", options.yes, "do not ask, however many runs there are");
  command.add_flag("-q,--quiet", options.quiet, "no plan, no progress, no summary; warnings and errors only");
}

void add_study(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<StudyOptions>();
  auto* command = app.add_subcommand("study", "run a scenario many times over and compare")->group(command_group);
  command->footer(study_footer);
  add_study_options(*command, *options);
  command->add_flag("-f,--force", options->force, "delete the results that are there and start over");
  command->add_flag("-n,--dry-run", options->dry_run, "print the plan and an estimate of its time, and start nothing");
  command->add_flag("--retry", options->retry, "also run failed runs again");
  command
      ->add_option("-t,--threads", options->threads,
                   "runs at once, default all cores; under mpirun per process, default 1")
      ->type_name("N")
      ->check(whole_within(1, 256));
  command->add_option("--shard", options->shard, "do the i-th of n equal parts only; `banyan collect` merges them")
      ->type_name("I/N");
  command
      ->add_option("--sbatch", options->sbatch,
                   "write a job array for Slurm to this file (-: standard output) and exit")
      ->type_name("FILE");
  command->add_option("--shards", options->shards, "tasks of that array, default 16")
      ->type_name("N")
      ->check(whole_within(1, 100000));
  command->callback([options, &action] { action = [options] { return study_command(*options); }; });
}

void add_collect(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<CollectOptions>();
  auto* command =
      app.add_subcommand("collect", "merge the shards of a study into its tables and figures")->group(command_group);
  command->footer(collect_footer);
  add_study_options(*command, options->study);
  command->add_flag("-f,--force", options->study.force, "replace tables that are there, of whatever study they are");
  command->add_option("folders", options->from, "more folders with results of this study")->type_name("DIR");
  command->add_flag("--partial", options->partial, "make the tables even if runs are missing");
  command->callback([options, &action] { action = [options] { return collect_command(*options); }; });
}

constexpr std::int64_t most_missions = 1'000'000'000'000;

void add_soak(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<SoakOptions>();
  auto* command = app.add_subcommand("soak", "run random missions and look for faults")->group(command_group);
  command->footer(soak_footer);
  command->add_option("file", options->file, "a scenario to watch, instead of random missions")->type_name("FILE");
  command->add_option("-s,--seed", options->seed, "seed of the missions, default 1")
      ->type_name("N")
      ->check(whole_within(0, 9007199254740992));
  command->add_option("--from", options->from, "first mission, default 0")
      ->type_name("N")
      ->check(whole_within(0, most_missions));
  command->add_option("--missions", options->missions, "how many; default as many as there is time for")
      ->type_name("N")
      ->check(whole_within(1, most_missions));
  command->add_option("--seconds", options->seconds, "how long; default until Ctrl-C")->type_name("S")->check(moment);
  command->add_option("-o,--out", options->out, "directory for journal and findings, default out/soak-<seed>")
      ->type_name("DIR")
      ->check(a_name);
  command->add_option("-t,--threads", options->threads, "missions at once, default all cores")
      ->type_name("N")
      ->check(whole_within(1, 256));
  command->add_flag("-f,--force", options->force, "start a new journal");
  command->add_flag("--no-shrink", options->whole, "keep missions with findings whole, instead of making them smaller");
  command->add_flag("-q,--quiet", options->quiet, "no progress and no summary; findings only");
  command->callback([options, &action] { action = [options] { return soak_command(*options); }; });
}

void add_bench(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<BenchOptions>();
  auto* command =
      app.add_subcommand("bench", "measure the speed of the simulation on this machine")->group(command_group);
  command->footer(bench_footer);
  command->add_option("layouts", options->only, "only these layouts")->type_name("LAYOUT");
  command->add_option("--algorithm", options->algorithm, "run every layout with this one instead of the layout's own")
      ->type_name("NAME");
  command->add_flag("--json", options->json, "print the figures as JSON");
  command->add_option("--windows", options->windows, "measured windows per layout, default 7")
      ->type_name("N")
      ->check(whole_within(1, 1000));
  command
      ->add_option("--window", options->window_s,
                   "length of a window, s of wall time, default 0.7; a mission is measured whole")
      ->type_name("S")
      ->check(number_within(0.01, 600.0));
  command->callback([options, &action] { action = [options] { return bench_command(*options); }; });
}

// What `run`, `hub` and `fleet` have in common.
void add_results(CLI::App& command, RunOptions& options) {
  add_overrides(command, options.overrides);
  add_seed(command, options.overrides);
  command.add_option("-o,--out", options.out, "directory for the results, default out/<name>-<algorithm>-<seed>")
      ->type_name("DIR")
      ->check(a_name);
  command.add_flag("-f,--force", options.force, "replace results that are already there");
  command.add_flag("--json", options.json, "print the result as JSON on standard output, and nothing else there");
  command.add_flag("-q,--quiet", options.quiet, "no progress and no summary; warnings and errors only");
  add_outputs(command, options.overrides);
}

template <class Options> void add_page_beside(CLI::App& command, Options& options) {
  command.add_flag("--view", options.view, "show it live in the browser; the page stays until Ctrl-C");
}

// How long robots may be silent, at first and later.
template <class Options> void add_patience(CLI::App& command, Options& options) {
  command.add_option("--wait", options.wait_s, "how long to wait for robots at first, s; default 10")
      ->type_name("S")
      ->check(moment);
  command
      .add_option("--dead-after", options.dead_after_s,
                  "a robot that is silent for this long counts as dead, s; default 5")
      ->type_name("S")
      ->check(number_within(0.5, 1e6));
}

template <class Options> void add_pace(CLI::App& command, Options& options) {
  command.add_option("--speed", options.speed, "speed of all clocks, default 1; for tests")
      ->type_name("X")
      ->check(number_within(0.01, 100.0));
  command.add_option("--bundle", options.bundle, "most packets in one datagram to a robot; default 1, as on a radio")
      ->type_name("N")
      ->check(whole_within(1, 64));
}

void add_hub(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<HubOptions>();
  auto* command = app.add_subcommand("hub", "hand each robot process what its robot can hear")->group(command_group);
  command->footer(hub_footer);
  command->add_option("scenario", options->run.scenario, "a scenario (.toml or .json)")->type_name("FILE");
  command->add_option("--key", options->key_file, "the fleet's keys; only their owner may read them")
      ->type_name("FILE");
  command->add_option("--new-key", options->new_key, "make a key file and exit")->type_name("FILE");
  command
      ->add_option("--stop", options->stop,
                   "stop robots that have no hub, at these addresses or at a broadcast, and exit")
      ->type_name("ADDRESSES");
  command->add_option("--listen", options->listen, "where robots find it, default 0.0.0.0:4600")
      ->type_name("ADDRESS:PORT");
  command->add_flag("--print-robots", options->print_robots, "print the command line of each robot and exit");
  add_patience(*command, *options);
  command->add_option("--poses", options->poses, "take poses from a tracker here, instead of simulating bodies")
      ->type_name("ADDRESS:PORT");
  command->add_option("--tape", options->tape, "keep here what robots say and the tracker sees, to resume from")
      ->type_name("FILE");
  command->add_flag("--resume", options->resume, "go on where the tape ends");
  command->add_option("--impairment", options->impairment, "for the summary")->group("");  // a fleet says it
  add_results(*command, options->run);
  add_pace(*command, *options);
  add_page_beside(*command, *options);
  command->callback([options, &action] { action = [options] { return hub_command(*options); }; });
}

void add_listen(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<ListenOptions>();
  auto* command =
      app.add_subcommand("listen", "record robots that have no hub, from what they report")->group(command_group);
  command->footer(listen_footer);
  command->add_option("scenario", options->run.scenario, "a scenario (.toml or .json)")->required()->type_name("FILE");
  command->add_option("--key", options->key_file, "the fleet's keys; only their owner may read them")
      ->required()
      ->type_name("FILE");
  command->add_option("--listen", options->listen, "where robots report to, their --tell; default 0.0.0.0:4700")
      ->type_name("ADDRESS:PORT");
  add_patience(*command, *options);
  command->add_option("--speed", options->speed, "speed of its clock, default 1; for tests")
      ->type_name("X")
      ->check(number_within(0.01, 100.0));
  add_results(*command, options->run);
  add_page_beside(*command, *options);
  command->callback([options, &action] { action = [options] { return listen_command(*options); }; });
}

void add_robot(CLI::App& app, std::function<int()>& action) {
  auto* command = app.add_subcommand("robot", "be one robot; see banyan robot --help")->group(command_group);
  command->prefix_command();
  command->set_help_flag();
  command->callback([command, &action] { action = [command] { return robot_command(command->remaining()); }; });
}

void add_ros2(CLI::App& app, std::function<int()>& action) {
  auto* command =
      app.add_subcommand("ros2", "connect a fleet with ROS 2; see banyan ros2 --help")->group(command_group);
  command->prefix_command();
  command->set_help_flag();
  command->callback([command, &action] { action = [command] { return ros2_command(command->remaining()); }; });
}

void add_fleet(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<FleetOptions>();
  auto* command = app.add_subcommand("fleet", "run a scenario as processes, over real UDP")->group(command_group);
  command->footer(fleet_footer);
  command->add_option("scenario", options->run.scenario, "a scenario (.toml or .json)")->required()->type_name("FILE");
  add_results(*command, options->run);
  add_pace(*command, *options);
  const auto way = [&](const char* name, double& value, double most, const char* meaning) {
    command->add_option(name, value, meaning)->type_name("X")->check(number_within(0.0, most));
  };
  way("--loss", options->loss, 0.99, "share of the packets lost from robot to robot");
  way("--delay-ms", options->delay_ms, 10000.0, "delay of a packet from robot to robot");
  way("--jitter-ms", options->jitter_ms, 10000.0, "how much that delay varies, uniformly, either way");
  way("--duplicate", options->duplicate, 0.99, "share of the packets that arrive twice");
  way("--reorder", options->reorder, 1.0, "share of the packets that are not delayed and so overtake others");
  way("--rate-kbit", options->rate_kbit_s, 1e9, "kbit/s for each robot, in each direction; default 0: no limit");
  command
      ->add_option(
          "--impairment", options->impairment,
          "who does that: netem, the kernel, or relay, a process of ours; default auto: netem where it can be had")
      ->type_name("WHO")
      ->check(CLI::IsMember({"auto", "netem", "relay"}).description(""));
  add_page_beside(*command, *options);
  command->add_flag("--loopback", options->loopback, "no network namespaces: all share the loopback device");
  command->add_flag("!--no-restart", options->restart, "do not restart robots that have ended");
  command->callback([options, &action] { action = [options] { return fleet_command(*options); }; });
}

void add_argos(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<ArgosOptions>();
  auto* command = app.add_subcommand("argos", "write an experiment for the simulator ARGoS 3")->group(command_group);
  command->footer(argos_footer);
  command->add_option("scenario", options->scenario, "a scenario (.toml or .json)")->required()->type_name("FILE");
  command->add_option("-o,--output", options->output, "the experiment, FILE.argos")->required()->type_name("FILE");
  command->add_option("--out", options->out, "directory for its results, default FILE without .argos")
      ->type_name("DIR");
  const auto choice = [&](const char* name, std::string& value, const std::vector<std::string>& allowed,
                          const char* meaning) {
    command->add_option(name, value, meaning)->check(CLI::IsMember(allowed).description(""));
  };
  choice("--robot", options->robot, {"kheperaiv", "foot-bot"}, "kheperaiv, the default, or foot-bot");
  choice("--sight", options->sight, {"stock", "exact"},
         "stock: lines of sight as ARGoS has them, the default; or exact");
  choice("--obstacles", options->obstacles, {"sensors", "world"},
         "how robots see them: by sensors of their own, the default, or told by the world");
  command->add_option("--library", options->library, "libbanyan_argos, default the one built with this program")
      ->type_name("FILE");
  command->add_flag("-f,--force", options->force, "replace the files, and later the results, that are there");
  add_overrides(*command, options->overrides);
  add_seed(*command, options->overrides);
  command->callback([options, &action] { action = [options] { return argos_command(*options); }; });
}

// "did you mean" for a mistyped command or option.
std::string suggestion(const CLI::App& app, const std::vector<std::string>& arguments) {
  const CLI::App* command = &app;
  for (const auto* chosen : app.get_subcommands()) command = chosen;
  for (const auto& argument : arguments) {
    std::vector<std::string> names;
    if (argument.starts_with("-")) {
      for (const auto* option : command->get_options()) {
        for (const auto& name : option->get_lnames()) names.push_back("--" + name);
      }
    } else if (command == &app) {
      for (const auto* sub : app.get_subcommands([](const CLI::App* s) { return !s->get_group().empty(); }))
        names.push_back(sub->get_name());
    }
    const std::vector<std::string_view> views(names.begin(), names.end());
    const auto word = argument.substr(0, argument.find('='));
    if (std::find(names.begin(), names.end(), word) != names.end()) continue;
    if (const auto near = nearest(word, views); !near.empty())
      return "\"" + word + "\" is unknown; did you mean " + std::string(near) + "?";
  }
  return "";
}

// As banyan-robot and banyan-ros2 say it (option_table.hpp), not "At Most 1 required but received 2".
std::string in_our_words(const CLI::ParseError& error) {
  const std::string text = error.what();
  const auto end = text.find(": At Most 1 required but received ");
  return end == std::string::npos ? text : text.substr(0, end) + " is given twice; give it once";
}

int report_bad_usage(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& arguments) {
  const CLI::App* command = &app;
  for (const auto* chosen : app.get_subcommands()) command = chosen;
  const auto hint = dynamic_cast<const CLI::ExtrasError*>(&error) || dynamic_cast<const CLI::RequiredError*>(&error)
                        ? suggestion(app, arguments)
                        : "";
  complain(hint.empty() ? in_our_words(error) : hint);
  const std::string name = command == &app ? "banyan" : "banyan " + command->get_name();
  complain("see " + name + " --help");
  return exit_usage;
}

int run_program(int argc, char** argv) {
  CLI::App app(purpose, "banyan");
  std::function<int()> action;
  app.footer(main_footer);
  app.get_formatter()->column_width(28);
  app.get_formatter()->label("SUBCOMMAND", "COMMAND");
  app.set_help_flag("-h,--help", "print this help and exit");
  app.set_version_flag("--version",
                       "banyan " + std::string(banyan::version) + " (git " + std::string(banyan::git_id()) + ")",
                       "print the version and exit");
  app.require_subcommand(1);
  add_run(app, action);
  add_validate(app, action);
  add_export(app, action);
  add_draw(app, action);
  add_film(app, action);
  add_view(app, action);
  add_algorithms(app, action);
  add_keys(app, action);
  add_tune(app, action);
  add_study(app, action);
  add_soak(app, action);
  add_collect(app, action);
  add_bench(app, action);
  add_hub(app, action);
  add_listen(app, action);
  add_robot(app, action);
  add_ros2(app, action);
  add_fleet(app, action);
  add_argos(app, action);
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {  // --help, --version
    std::ostringstream text;
    app.exit(wanted, text, text);
    print(text.str());
    return exit_done;
  } catch (const CLI::ParseError& error) {
    if (arguments.empty()) {
      std::fputs(app.help().c_str(), stderr);
      return exit_usage;
    }
    return report_bad_usage(app, error, arguments);
  }
  return action();
}

}  // namespace

int main(int argc, char** argv) {
  reserve_standard_streams();
  ::signal(SIGXFSZ, SIG_IGN);  // a file size limit is then an error of write(), like a full disk
  try {
    return run_program(argc, argv);
  } catch (const CommandError& e) {
    complain(e.what());
    return e.exit_code;
  } catch (const banyan::record::FileError& e) {
    complain(e.what());
    return exit_lost;
  } catch (const std::filesystem::filesystem_error& e) {
    complain(e.path1().string() + ": " + e.code().message());
    return exit_lost;
  } catch (const std::bad_alloc&) {
    complain("out of memory");
    return exit_lost;
  } catch (const std::exception& e) {
    complain(std::string("internal error: ") + e.what());
    return exit_lost;
  }
}
