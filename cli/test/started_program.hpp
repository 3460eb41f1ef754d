// SPDX-License-Identifier: MIT
// The program as a user meets it: started for real, in a directory of its own, judged by its exit
// code, what it says and the files it leaves. What the tests of its commands have in common.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace banyan::cli {

struct Outcome {
  int code = -1;  // exit code, or 1000 + the signal that killed it
  std::string out, err;
};

struct Circumstances {
  rlim_t largest_file = RLIM_INFINITY;   // what may be written into one file, like a full disk
  std::string directory = "";            // below home
  std::string program = BANYAN_PROGRAM;  // found in PATH if there is no slash
  std::vector<std::pair<std::string, std::string>> environment = {};
  int input = -1;                 // a descriptor for standard input, else /dev/null
  bool ignores_children = false;  // by a parent that does, which is inherited
  std::vector<int> closed = {};   // standard streams that it has not
  const char* out = nullptr;      // a file for standard output instead of one that is read at the end
};

using Arguments = std::vector<std::string>;

inline std::string contents(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();  // what /proc says of a process that ends meanwhile cannot be read to its end, and throws
                       // elsewhere
  return text.str();
}

inline bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class StartedProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "banyan-program-XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    home_ = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(home_); }

  void write(const std::string& name, const std::string& text) {
    std::filesystem::create_directories((home_ / name).parent_path());
    std::ofstream(home_ / name, std::ios::binary) << text;
  }
  [[nodiscard]] std::string read(const std::string& name) const { return contents(home_ / name); }
  [[nodiscard]] bool exists(const std::string& name) const { return std::filesystem::exists(home_ / name); }

  pid_t start(const Arguments& arguments, const Circumstances& how = {}) {
    // All that takes memory comes before the fork: another thread of this process may hold the heap's lock,
    // and in the child nobody would ever let it go.
    const std::string out = how.out ? how.out : (home_ / "stdout.txt").string();
    const std::string err = (home_ / "stderr.txt").string();
    const std::string directory = (home_ / how.directory).string();
    std::vector<std::string> variables;
    for (char** at = environ; *at != nullptr; ++at) {
      const std::string variable = *at;
      const std::string known = variable.substr(0, variable.find('='));
      const auto is_given = [&](const auto& given) { return given.first == known; };
      if (std::none_of(how.environment.begin(), how.environment.end(), is_given)) variables.push_back(variable);
    }
    for (const auto& [name, value] : how.environment) variables.push_back(name + "=" + value);
    std::vector<char*> environment;
    environment.reserve(variables.size() + 1);
    for (std::string& variable : variables) environment.push_back(variable.data());
    environment.push_back(nullptr);
    std::vector<char*> argv{const_cast<char*>(how.program.c_str())};
    for (const auto& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);

    const pid_t child = ::fork();
    if (child != 0) return child;
    ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
    ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
    ::dup2(how.input >= 0 ? how.input : ::open("/dev/null", O_RDONLY), 0);
    for (const int descriptor : how.closed) ::close(descriptor);
    if (::chdir(directory.c_str()) != 0) ::_exit(99);
    if (how.largest_file != RLIM_INFINITY) {
      const rlimit limit{how.largest_file, how.largest_file};
      ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    if (how.ignores_children) ::signal(SIGCHLD, SIG_IGN);
    ::execvpe(how.program.c_str(), argv.data(), environment.data());
    ::_exit(98);
  }
  Outcome finish(pid_t child) {
    int status = 0;
    ::waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status), read("stdout.txt"), read("stderr.txt")};
  }
  Outcome run(const Arguments& arguments, const Circumstances& how = {}) { return finish(start(arguments, how)); }

  // What must not start: exit code 2, a reason, and no trace of results.
  void expect_refused(const Arguments& arguments, const std::string& reason) {
    const auto outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_TRUE(has(outcome.err, reason)) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_FALSE(exists("out"));
  }

  std::filesystem::path home_;
};

}  // namespace banyan::cli
