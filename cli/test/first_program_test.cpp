// SPDX-License-Identifier: MIT
// The small program that ./banyan builds first: it has the commands that ./banyan gives it, does with
// them what the whole one does, and says of each other command that it lacks it.
#include <iterator>
#include <regex>
#include <set>
#include <sstream>

#include "started_program.hpp"

namespace banyan::cli {
namespace {

using FirstProgram = StartedProgram;

// `--help` of the program lists them: two spaces, a name, its purpose.
std::set<std::string> commands_of(const std::string& help) {
  std::set<std::string> names;
  std::istringstream lines(help.substr(help.find("Commands:")));
  const std::regex command("^  ([a-z]+) +[a-z].*");
  std::smatch match;
  for (std::string line; std::getline(lines, line) && !line.empty();)
    if (std::regex_match(line, match, command)) names.insert(match[1]);
  return names;
}

// The words of the line of ./banyan that looks so: those that it gives to the small program, or those for which it
// builds the whole one.
std::set<std::string> words_of_script(const std::string& line) {
  const std::string script = contents(BANYAN_SCRIPT);
  std::smatch match;
  if (!std::regex_search(script, match, std::regex("\n +" + line))) return {};
  std::istringstream words(std::regex_replace(match[1].str(), std::regex("\\|"), " "));
  return {std::istream_iterator<std::string>(words), {}};
}

const Circumstances first{.program = BANYAN_FIRST_PROGRAM};

TEST_F(FirstProgram, ThoseThatTheScriptKeepsFromItAreThoseItLacks) {
  const std::set<std::string> given = words_of_script("(run[a-z| ]*)\\) ;;");
  const std::set<std::string> others = words_of_script("(argos[a-z| ]*)\\) targets=\\(banyan_cli\\)");
  ASSERT_TRUE(given.contains("run"));
  write("file", "");
  const std::set<std::string> all = commands_of(run({"--help"}).out);
  ASSERT_GE(all.size(), given.size() + 5);
  for (const auto& command : all) {
    EXPECT_EQ(others.contains(command), !given.contains(command) && command != "ros2") << command;
    const Outcome outcome = run({command, "file"}, first);
    const bool beside = command == "robot" || command == "ros2" || command == "tune";  // programs of their own
    EXPECT_EQ(has(outcome.err, "built without the command " + command), !given.contains(command) && !beside)
        << outcome.err;
  }
}

TEST_F(FirstProgram, TheSameResult) {
  const Arguments arguments{"run",         std::string(BANYAN_SCENARIOS) + "/three-targets.toml",
                            "--set",       "mission.time_limit_s=3",
                            "--no-record", "--quiet",
                            "--out"};
  for (const char* out : {"first", "whole"}) {
    Arguments with_folder = arguments;
    with_folder.emplace_back(out);
    ASSERT_EQ(run(with_folder, out == std::string("first") ? first : Circumstances{}).code, 0);
  }
  const std::regex hash("\"[a-z_]*hash\": *\"[^\"]+\"");
  std::smatch one, other;
  const std::string first_result = read("first/run.json"), whole_result = read("whole/run.json");
  ASSERT_TRUE(std::regex_search(first_result, one, hash));
  ASSERT_TRUE(std::regex_search(whole_result, other, hash));
  EXPECT_EQ(one.str(), other.str());
}

}  // namespace
}  // namespace banyan::cli
