// SPDX-License-Identifier: MIT
// `banyan view`: the page in the browser, with a recording or a scenario.
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/record/recording.hpp"
#include "commands.hpp"
#include "link.hpp"
#include "options.hpp"
#include "page_server.hpp"
#include "shipped.hpp"
#include "terminal.hpp"

namespace banyan::cli {

using namespace config;
namespace {

struct ViewOptions {
  std::string file;                         // a recording or a scenario; "": neither
  std::vector<config::Override> overrides;  // of the scenario
  std::string page;                         // folder; "": BANYAN_PAGE, else where it was installed
  std::string scenarios;                    // folder; "": where they were when this was built, or were installed
  int port = 0;                             // 0: any that is free
  bool open = true;                         // in a browser
  bool wait = false;                        // until the recording has begun
};

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

std::string page_folder(const ViewOptions& options) {
  std::error_code ignored;
  if (options.page.empty()) {
    if (std::string folder = shipped_page(); !folder.empty()) return folder;
  } else if (fs::is_regular_file(fs::path(options.page) / "index.html", ignored)) {
    return options.page;
  }
  throw CommandError(exit_lost,
                     (!options.page.empty()   ? options.page
                      : is_set("BANYAN_PAGE") ? std::string(std::getenv("BANYAN_PAGE"))
                                              : installed("viewer").string()) +
                         ": the page is not there (no index.html). In a clone of Banyan, `./banyan view` builds it; "
                         "or build it with viewer/build and say where it is with --page DIR or BANYAN_PAGE");
}

std::string scenarios_folder(const ViewOptions& options) {
  std::error_code ignored;
  if (!options.scenarios.empty()) {
    if (fs::is_directory(options.scenarios, ignored)) return options.scenarios;
    throw CommandError(exit_usage, options.scenarios + ": there is no such folder");
  }
  return shipped_scenarios();
}

bool is_recording(const std::string& file) {
  std::array<char, 5> start{};
  std::error_code ignored;
  if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored))
    return false;  // what comes out of a pipe is gone once it is read
  std::ifstream(file, std::ios::binary).read(start.data(), start.size());
  return std::string_view(start.data(), start.size()) == "\x89MCAP" || file.ends_with(".mcap") ||
         file.ends_with(".mcap.part");
}

// Under the name that it has now: it may be finished meanwhile, or only being written.
std::string present_name(const std::string& file) {
  std::error_code ignored;
  return !fs::exists(file, ignored) && fs::exists(other_name(file), ignored) ? other_name(file) : file;
}

// Who waits for a part does not mean the finished one of an earlier run.
bool has_begun(const std::string& recording) {
  std::error_code none;
  const auto bytes = fs::file_size(recording.ends_with(".part") ? recording : present_name(recording), none);
  return !none && bytes >= 5;
}

// Reports now what would fail later. A part is still being written and may be large: its start must do.
void check_recording(const std::string& given) {
  const std::string file = present_name(given);
  const record::InputFile input(file);
  std::string start;
  if (!input.read(0, 5, start) || start != "\x89MCAP") throw record::FileError(file, "is not an MCAP file");
  if (file.ends_with(".part")) return;
  const record::Recording recording(file);
  for (const auto& warning : recording.warnings()) complain(file + ": warning: " + warning);
}

// The scenario for /start.json: its text as it is, and the changes of the command line. The page cannot read
// files that the command line merges into it: then the text is the merged result.
json scenario_start(const ViewOptions& options, std::string text, const Configuration& configuration) {
  json overrides = json::array();
  bool files = false;
  for (const Override& change : options.overrides) {
    files = files || change.assignment.empty();
    overrides.push_back(change.assignment);
  }
  std::string name = fs::path(options.file).filename();
  if (files) {
    text = config_toml(configuration);
    overrides = json::array();
    name = fs::path(name).replace_extension(".toml");
  }
  return {{"scenario", {{"name", name}, {"text", text}, {"overrides", overrides}}}};
}

// Nothing if the scenario has faults, which are printed. It is read once: it may be a pipe.
std::optional<json> checked_start(const ViewOptions& options) {
  std::string text;
  try {
    text = read_text_file(itself_or_shipped(options.file, "scenarios"));
  } catch (const DocumentError& error) {
    print_problems({error.problem});
    return std::nullopt;
  }
  const auto loaded = parse_configuration(options.file, text, algorithms(), options.overrides);
  print_problems(loaded.problems);
  if (!loaded.ok()) return std::nullopt;
  return scenario_start(options, std::move(text), loaded.configuration);
}

// False: stopped by a signal before.
bool wait_for(const std::string& recording) {
  catch_stop_signals();
  while (!has_begun(recording)) {
    if (stop_signal() != 0) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

void open_browser(const std::string& address) {
  if (!has_desktop()) return;
  // Not waited for, and its output is dropped: some browsers stay in the foreground and print messages.
  posix_spawn_file_actions_t files;
  ::posix_spawn_file_actions_init(&files);
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    ::posix_spawn_file_actions_addopen(&files, descriptor, "/dev/null", O_RDWR, 0);
  }
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGDEF);
  sigset_t ours;  // a browser must not inherit which signals we ignore or catch
  ::sigemptyset(&ours);
  for (const int number : {SIGCHLD, SIGPIPE, SIGXFSZ}) ::sigaddset(&ours, number);
  ::posix_spawnattr_setsigdefault(&attributes, &ours);
  std::array<std::string, 2> words{"xdg-open", address};
  std::array<char*, 3> argv{words[0].data(), words[1].data(), nullptr};
  pid_t child = 0;
  (void)::posix_spawnp(&child, "xdg-open", &files, &attributes, argv.data(), environ);  // none: the address is printed
  ::posix_spawnattr_destroy(&attributes);
  ::posix_spawn_file_actions_destroy(&files);
}

void find_page(const ViewOptions& options, PageContent& content) {
  content.page = page_folder(options);
  content.scenarios = scenarios_folder(options);
}

int view_command(const ViewOptions& options) {
  // A misspelt name is told before a page that is missing; but nobody shall wait for a recording and then have no page.
  PageContent content;
  if (options.wait) find_page(options, content);
  std::string fragment;
  if (is_link(options.file)) {
    if (!options.overrides.empty())
      throw CommandError(exit_usage, "a link carries its own changes: --set, --seed and --with are for scenarios");
    const LoadedLink link = load_link(options.file);
    print_problems(link.loaded.problems);
    if (!link.loaded.ok()) return exit_usage;
    fragment = link.fragment;
  } else if (!options.file.empty() && is_recording(options.file)) {
    if (!options.overrides.empty())
      throw CommandError(exit_usage, "a recording cannot be changed: --set, --seed and --with are for scenarios");
    if (options.wait && !wait_for(options.file)) return exit_signal + stop_signal();
    check_recording(options.file);
    content.recording = options.file;
  } else if (!options.file.empty()) {
    const auto start = checked_start(options);
    if (!start) return exit_usage;
    content.scenario = start->dump(-1, ' ', false, json::error_handler_t::replace);
  }
  if (!options.wait) find_page(options, content);
  catch_stop_signals();
  ::signal(SIGCHLD, SIG_IGN);  // the browser is not waited for
  ::signal(SIGPIPE, SIG_IGN);  // a browser that is closed must not end us
  const PageServer server(content, options.port);
  const std::string address = server.address() + fragment;
  print(address + "\n");
  complain("the page is at this address as long as this runs; Ctrl-C ends it");
  if (options.open) open_browser(address);
  while (stop_signal() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  return exit_signal + stop_signal();
}

}  // namespace

void add_view(CLI::App& command, CommandAction& action) {
  auto options = std::make_shared<ViewOptions>();
  command.footer(
      "Serves the page at an address of this machine, prints it and opens the browser if there is a\n"
      "desktop. Only users of this machine can reach it. Ctrl-C ends it.\n"
      "A recording that is still being written is shown live.\n\n"
      "Examples:\n"
      "  banyan view out/three-targets-convoy-1/run.mcap\n"
      "  banyan view --wait out/lab/run.mcap          (live, while it is written)\n"
      "  banyan view scenarios/three-targets.toml --set radio.loss=0.3\n"
      "  banyan view");
  command
      .add_option("file", options->file,
                  "a run.mcap, a scenario to be run in the page, or a link; none: a choice of scenarios")
      ->type_name("FILE");
  add_overrides(command, options->overrides);
  add_seed(command, options->overrides);
  command.add_option("--port", options->port, "port on this machine; default any that is free")
      ->type_name("N")
      ->check(whole_within(0, 65535));
  command.add_flag("!--no-open", options->open, "only print the address");
  command.add_flag("--wait", options->wait, "wait for a recording that has not begun yet");
  command.add_option("--page", options->page, "the built page; default BANYAN_PAGE, or where it was installed")
      ->type_name("DIR");
  command.add_option("--scenarios", options->scenarios, "what the page offers to run; default Banyan's own")
      ->type_name("DIR");
  command.callback([options, &action] { action = [options] { return view_command(*options); }; });
}

}  // namespace banyan::cli
