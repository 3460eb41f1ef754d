// SPDX-License-Identifier: MIT
#include "program.hpp"

#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <new>
#include <sstream>

#include "banyan/record/file.hpp"
#include "banyan/version.hpp"
#include "terminal.hpp"

namespace banyan::cli {

using config::nearest;
namespace {

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

// As banyan-robot and banyan-ros2 say it (command_line.hpp), not "At Most 1 required but received 2".
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
  complain("see " + (command == &app ? "" : app.get_name() + " ") + command->get_name() + " --help");
  return exit_usage;
}

// "with: box2d, zstd; without: ros2"
std::string feature_line() {
  std::string text;
  if (!features.empty()) text += "with: " + std::string(features);
  if (!missing_features.empty()) text += (text.empty() ? "" : "; ") + ("without: " + std::string(missing_features));
  return text;
}

[[noreturn]] void become(std::string program, std::span<char*> arguments) {
  std::vector<char*> words{program.data()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  words.push_back(nullptr);
  ::execv(program.c_str(), words.data());
  throw CommandError(exit_lost, program + ": " + std::strerror(errno));
}

// A command has its options from the moment on at which it is read: those of all take longer than what most do.
void add_commands(CLI::App& app, const ProgramParts& program, CommandAction& action, std::span<char*> arguments) {
  app.footer(program.footer);
  for (const Command& command : program.commands) {
    CLI::App* added = app.add_subcommand(command.name, command.purpose);
    added->group(*command.purpose == '\0' ? "" : "Commands");
    added->preparse_callback([=, &action, &command](std::size_t rest) {
      if (command.program != nullptr) become(command.program(), arguments.last(rest));
      command.add(*added, action);
    });
  }
  app.require_subcommand(1);
  app.set_version_flag(
      "--version",
      program.name + (" " + std::string(version)) + " (git " + std::string(git_id()) + ")\n" + feature_line(),
      "print the version and exit");
}

int read_and_do(const ProgramParts& program, int argc, char** argv) {
  CLI::App app(program.purpose, program.name);
  CommandAction action;
  app.get_formatter()->column_width(28);
  app.get_formatter()->label("SUBCOMMAND", "COMMAND");
  app.set_help_flag("-h,--help", "print this help and exit");
  if (program.add != nullptr) program.add(app, action);
  else add_commands(app, program, action, {argv, argv + argc});
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {  // --help, --version
    std::ostringstream text;
    app.exit(wanted, text, text);
    print(text.str());
    return exit_done;
  } catch (const CLI::ParseError& error) {
    if (arguments.empty() && program.add == nullptr) {
      std::fputs(app.help().c_str(), stderr);
      return exit_usage;
    }
    return report_bad_usage(app, error, arguments);
  }
  return action();
}

}  // namespace

int run_program(const ProgramParts& program, int argc, char** argv) {
  reserve_standard_streams();
  ::signal(SIGXFSZ, SIG_IGN);  // a file size limit is then an error of write(), like a full disk
  try {
    return read_and_do(program, argc, argv);
  } catch (const CommandError& e) {
    complain(e.what());
    return e.exit_code;
  } catch (const record::FileError& e) {
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

}  // namespace banyan::cli
