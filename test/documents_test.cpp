// SPDX-License-Identifier: MIT
// What the documents show is true: every TOML block is a scenario without faults, every command
// runs, every link and every path in backquotes leads somewhere.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path source = BANYAN_SOURCE_DIR;

struct Line {
  fs::path file;
  std::size_t number = 0;
  std::string text;
  std::string block;  // "sh", "toml", ... inside a fenced block; "plain" if it names no language
  [[nodiscard]] std::string where() const { return file.filename().string() + ":" + std::to_string(number); }
};

std::vector<Line> lines_of_documents(std::initializer_list<const char*> folders = {"docs"}) {
  std::vector<fs::path> files{source / "README.md", source / "CONTRIBUTING.md"};
  for (const char* folder : folders)
    for (const auto& entry : fs::directory_iterator(source / folder))
      if (entry.path().extension() == ".md") files.push_back(entry.path());
  std::vector<Line> lines;
  for (const fs::path& file : files) {
    std::ifstream in(file);
    EXPECT_TRUE(in) << file;
    std::string block;
    Line line{file, 0, "", ""};
    while (std::getline(in, line.text)) {
      ++line.number;
      const bool fence = line.text.starts_with("```");
      if (fence) block = !block.empty() ? "" : line.text.size() > 3 ? line.text.substr(3) : "plain";
      line.block = fence ? "fence" : block;
      lines.push_back(line);
    }
    EXPECT_TRUE(block.empty()) << file << " ends within a block";
  }
  return lines;
}

// A directory like a clone of the repository after ./banyan has built: gone at the end.
class Clone {
 public:
  Clone() {
    std::string form = (fs::temp_directory_path() / "banyan-documents-XXXXXX").string();
    if (::mkdtemp(form.data()) == nullptr) throw std::runtime_error("no temporary directory");
    path = form;
    for (const char* folder : {"scenarios", "studies", "parameters", "results"})
      if (fs::exists(source / folder)) fs::create_symlink(source / folder, path / folder);
    fs::create_symlink(BANYAN_PROGRAM, path / "banyan");
  }
  ~Clone() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  Clone(const Clone&) = delete;
  Clone& operator=(const Clone&) = delete;

  struct Result {
    int status;
    std::string output;
  };
  [[nodiscard]] Result run(const std::string& command) const {
    Result result{-1, ""};
    // A shell is the point: it is where a reader types these commands.
    // NOLINTNEXTLINE(cert-env33-c)
    std::FILE* pipe = ::popen(("cd '" + path.string() + "' && " + command + " 2>&1 </dev/null").c_str(), "r");
    if (pipe == nullptr) return result;
    std::array<char, 4096> part;
    while (const std::size_t n = std::fread(part.data(), 1, part.size(), pipe)) result.output.append(part.data(), n);
    const int status = ::pclose(pipe);
    if (WIFEXITED(status)) result.status = WEXITSTATUS(status);
    return result;
  }
  // A server, ended by Ctrl-C; with an empty page, since what is in it does not matter here.
  [[nodiscard]] Result view(const std::string& command) const {
    return run("mkdir -p page && touch page/index.html && BANYAN_PAGE=page timeout --signal=INT --preserve-status 1 " +
               command + " --no-open");
  }
  fs::path path;
};

// A block with axes is a study, any other a scenario.
TEST(Documents, TomlBlocksAreScenariosOrStudiesWithoutFault) {
  const Clone clone;
  std::size_t blocks = 0;
  std::string toml;
  for (const Line& line : lines_of_documents()) {
    if (line.block == "toml") {
      toml += line.text + "\n";
    } else if (!toml.empty()) {
      ++blocks;
      std::ofstream(clone.path / "block.toml") << toml;
      const bool study = toml.find("axes") != std::string::npos;
      toml.clear();
      const auto result = clone.run(study ? "./banyan study block.toml --dry-run" : "./banyan validate block.toml");
      EXPECT_EQ(result.status, 0) << "the block before " << line.where() << "\n" << result.output;
      EXPECT_EQ(result.output.find("warning"), std::string::npos) << "before " << line.where() << "\n" << result.output;
    }
  }
  EXPECT_GE(blocks, 5U);
}

TEST(Documents, CommandsRun) {
  const Clone clone;
  std::size_t commands = 0;
  for (const Line& line : lines_of_documents()) {
    if (line.block != "sh" || !line.text.starts_with("./")) continue;
    if (!line.text.starts_with("./banyan ")) {  // a script of the house
      EXPECT_TRUE(fs::exists(source / line.text.substr(2, line.text.find(' ') - 2))) << line.where();
      continue;
    }
    ++commands;
    if (line.text.starts_with("./banyan view")) {
      const auto shown = clone.view(line.text);
      EXPECT_EQ(shown.status, 130) << line.where() << ": " << line.text << "\n" << shown.output;
      EXPECT_NE(shown.output.find("http://127.0.0.1:"), std::string::npos) << line.where() << "\n" << shown.output;
      continue;
    }
    // The shortest of its measurements instead of the better part of a minute.
    const bool bench = line.text.starts_with("./banyan bench");
    // Only the first study is a matter of seconds; of the others and of tunings the plan must do.
    const bool long_one = std::regex_search(line.text, std::regex("banyan (study|tune) ")) &&
                          line.text.find("first.toml") == std::string::npos &&
                          line.text.find("--help") == std::string::npos;
    // And the first second of a run that is long on purpose.
    const bool long_run = line.text.find("--set mission.time_limit_s=") != std::string::npos;
    const auto result = clone.run(line.text + (bench      ? " spread-94-los --windows 1 --window 0.01"
                                               : long_one ? " --dry-run"
                                               : long_run ? " --set mission.time_limit_s=1"
                                                          : ""));
    EXPECT_EQ(result.status, 0) << line.where() << ": " << line.text << "\n" << result.output;
  }
  EXPECT_GE(commands, 8U);
}

TEST(Documents, LinksAndPathsLeadSomewhere) {
  const std::regex link(R"(\]\(([^)#:]+)(#[^)]*)?\))");
  const std::regex path(
      R"(`((?:algorithms|bench|cli|cmake|config|controller|docs|examples|hosts|measure|record|baselines|scenarios|studies|study|test|viewer|world)/[\w./-]+\.\w+)`)");
  std::size_t found = 0;
  // Of the notebook this is all: its commands and numbers are of their day.
  for (const Line& line : lines_of_documents({"docs", "notebook"})) {
    if (!line.block.empty()) continue;
    const auto each = [&](const std::regex& form, const fs::path& base) {
      for (std::sregex_iterator it(line.text.begin(), line.text.end(), form), end; it != end; ++it) {
        ++found;
        EXPECT_TRUE(fs::exists(base / (*it)[1].str())) << line.where() << ": " << (*it)[1].str();
      }
    };
    each(link, line.file.parent_path());
    if (line.file.parent_path().filename() != "notebook") each(path, source);
  }
  EXPECT_GE(found, 50U);
}

}  // namespace
