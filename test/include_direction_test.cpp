// SPDX-License-Identifier: MIT
// The arrows of the house: cli -> study -> config -> record -> measure -> world -> controller,
// and viewer -> config: a browser has no processes to start. Only algorithms -> controller, baselines knows the
// algorithms; the others see them through controller/core, and who composes a program hands the list down. So does
// baselines -> controller/core. A host is a program of its own beside the world: hosts -> controller/core; what starts
// one is above it, cli -> hosts. hosts/argos is one that observes and records its robots as a world: hosts/argos ->
// config. Reads the include lines of every source file and names each that points up.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "sources.hpp"

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string, std::less<>>;

// Room -> the rooms it may include besides itself.
const std::map<std::string, Names, std::less<>> may_include = {
    {"controller", {}},
    {"baselines", {"controller"}},
    {"algorithms", {"controller", "baselines"}},
    {"world", {"controller"}},
    {"measure", {"controller", "world"}},
    {"record", {"controller", "world", "measure"}},
    {"config", {"controller", "world", "measure", "record"}},
    {"study", {"controller", "world", "measure", "record", "config"}},
    {"hosts", {"controller", "algorithms"}},
    {"cli", {"controller", "algorithms", "world", "measure", "record", "config", "study", "hosts"}},
    {"viewer", {"controller", "algorithms", "world", "measure", "record", "config"}},
};

// Folders of hosts/ that may include more than the room.
const std::map<std::string, Names, std::less<>> host_may_include = {
    {"argos", {"controller", "algorithms", "world", "measure", "record", "config"}},
    {"python", {"controller", "algorithms", "world", "measure", "record", "config", "study"}},
};

// Libraries that have one home: <prefix of the header> -> the rooms, or folders of hosts/, that know them.
const std::map<std::string, Names, std::less<>> homes = {
    {"Eigen/", {"measure", "study", "baselines"}},
    {"Spectra/", {"measure"}},
    {"box2d/", {"world"}},
    {"zstd", {"record"}},
    {"toml++/", {"config"}},
    {"CLI/", {"cli", "hosts"}},
    {"httplib", {"cli"}},
    {"librsvg/", {"cli"}},
    {"cairo", {"cli"}},
    {"pagmo/", {"study"}},
    {"boost/", {"study"}},
    {"mpi.h", {"study"}},
    {"sodium", {"hosts"}},
    {"dds/", {"hosts"}},
    {"fastdds/", {"hosts"}},
    {"fastcdr/", {"hosts"}},
    {"emscripten", {"viewer"}},
    {"pybind11/", {"hosts/python"}},
    {"Python.h", {"hosts/python"}},
    {"argos3/", {"hosts/argos"}},
};

// The whole of the standard library that runs on a robot: no heap, no streams, no clock, no threads.
const Names on_the_robot = {"algorithm", "array",    "bit",         "cmath",       "compare",
                            "concepts",  "cstddef",  "cstdint",     "cstring",     "limits",
                            "numeric",   "optional", "span",        "string_view", "tuple",
                            "utility",   "version",  "type_traits", "iterator",    "initializer_list"};

// The interface's side towards hosts, which have a heap. Nothing else in controller/ includes these, and in baselines/
// only algorithm.cpp, which makes an Algorithm of each, and algorithm.hpp of common/.
const Names for_hosts = {"swarm.hpp",        "swarm_of.hpp",  "algorithm.hpp",
                         "algorithm_of.hpp", "elsewhere.hpp", "printable.hpp"};
const Names of_hosts = {"cstdio", "functional", "memory", "string", "vector", "new", "cstdlib", "sys/mman.h"};
bool is_for_hosts(const fs::path& file) {
  if (file.parent_path().filename() == "core") return for_hosts.contains(file.filename().string());
  return file.stem() == "algorithm" && std::find(file.begin(), file.end(), "baselines") != file.end();
}

// What has include/, src/ and test/: a room, and in baselines/ and hosts/ each of its folders.
fs::path part_of(const fs::path& room_folder, const fs::path& file) {
  const bool has_parts = room_folder.filename() == "baselines" || room_folder.filename() == "hosts";
  return has_parts ? room_folder / *file.lexically_relative(room_folder).begin() : room_folder;
}
// Whether a file is no test, nor anything else besides the libraries.
bool is_product(const fs::path& room_folder, const fs::path& file) {
  const fs::path part = part_of(room_folder, file);
  const std::string folder = file.lexically_relative(part).begin()->string();
  return folder == "include" || folder == "src" || (part != room_folder && folder != "test");
}

const Names& allowed_for(const fs::path& room_folder, const fs::path& file) {
  if (room_folder.filename() == "hosts")
    if (const auto found = host_may_include.find(part_of(room_folder, file).filename().string());
        found != host_may_include.end())
      return found->second;
  return may_include.at(room_folder.filename().string());
}

struct Include {
  std::string name;
  bool quoted = false;
};

std::vector<Include> includes(const fs::path& file) {
  static const std::regex line_form(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::ifstream in(file);
  std::vector<Include> found;
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (std::regex_search(line, match, line_form)) found.push_back({match[2], match[1] == "\""});
  }
  return found;
}

// A private header: beside the file, or in its room's src/ or test/; tests may share the helpers of
// the tests of a room below, and baselines those in common/.
std::optional<std::string> quoted_fault(const fs::path& room_folder, const fs::path& file, const std::string& name) {
  const fs::path part = part_of(room_folder, file);
  if (file.lexically_relative(part / "test").begin()->string() != "..") {
    for (const std::string& below : may_include.at(room_folder.filename().string()))
      if (fs::exists(room_folder.parent_path() / below / "test" / name) && name.find("..") == std::string::npos)
        return std::nullopt;
  }
  // The viewer's src/ is the page's; its C++ is in live/.
  for (const fs::path& folder :
       {file.parent_path(), part / "src", part / "live", part / "test", room_folder / "common/test"}) {
    if (!fs::exists(folder / name)) continue;
    const std::string inside =
        fs::weakly_canonical(folder / name).lexically_relative(fs::weakly_canonical(room_folder)).string();
    return inside.starts_with("..") ? std::optional("reaches out of its room") : std::nullopt;
  }
  return "is not in its room";
}

// The paper's two algorithms share no room with ours but core/.
bool is_of_paper(const fs::path& file) { return std::find(file.begin(), file.end(), "paper") != file.end(); }

// What is wrong with an include line of `file` in `room`, in words; nothing if it is right.
std::optional<std::string> fault(const fs::path& room_folder, const fs::path& file, const Include& include,
                                 bool product) {
  const std::string room = room_folder.filename().string();
  const std::string& name = include.name;
  const bool on_robot = product && (room == "controller" || room == "baselines") && !is_for_hosts(file);
  if (name.starts_with("banyan/")) {
    const std::size_t slash = name.find('/', 7);
    if (slash == std::string::npos)
      return room == "controller" ? std::optional("is not the controller's") : std::nullopt;
    const std::string other = name.substr(7, slash - 7);
    if (other == "controller" && product && room != "controller" && room != "algorithms" &&
        !name.starts_with("banyan/controller/core/"))
      return "names an algorithm";
    if (on_robot && is_for_hosts(name)) return "is for hosts";
    if (room == "controller" && product && is_of_paper(file.lexically_relative(room_folder)) != is_of_paper(name) &&
        !name.starts_with("banyan/controller/core/"))
      return "is shared with the paper's room";
    if (other == "algorithms" && !product && room != "controller") return std::nullopt;  // tests name them
    if (!may_include.contains(other)) return "names no room";
    if (other != room && !allowed_for(room_folder, file).contains(other)) return "points up";
    return std::nullopt;
  }
  if (include.quoted) {
    const bool from_folder = room == "controller" && product && name.find('/') != std::string::npos;
    if (from_folder && is_of_paper(file.lexically_relative(room_folder)) != is_of_paper(name))
      return "is shared with the paper's room";
    return quoted_fault(room_folder, file, name);
  }
  const std::string part = room + "/" + part_of(room_folder, file).filename().string();
  for (const auto& [prefix, rooms] : homes) {
    if (name.starts_with(prefix) && !rooms.contains(room) && !rooms.contains(part)) return "belongs into another room";
  }
  if (product && (room == "controller" || room == "baselines") && !on_the_robot.contains(name) &&
      (on_robot || !of_hosts.contains(name)))
    return "has no place on a robot";
  return std::nullopt;
}

std::vector<std::string> faults(const fs::path& house) {
  std::vector<std::string> found;
  for (const auto& [room, allowed] : may_include) {
    for (const fs::path& file : sources(house / room)) {
      const std::string where = fs::relative(file, house).string();
      const bool product = is_product(house / room, file);
      for (const Include& include : includes(file)) {
        if (const auto what = fault(house / room, file, include, product))
          found.push_back(where + ": " + include.name + " " + *what);
      }
    }
  }
  return found;
}

std::string lines(const std::vector<std::string>& list) {
  std::string text;
  for (const std::string& line : list) text += line + '\n';
  return text;
}

// Of a path below src/ or include/banyan/ROOM/ the folder it is in; nothing if it is in none.
std::optional<std::string> folder_of(const fs::path& path) {
  const auto first = path.begin();
  return first == path.end() || std::next(first) == path.end() ? std::nullopt : std::optional(first->string());
}

// Folder -> the folders of the same room that its product includes.
std::map<std::string, Names, std::less<>> folder_arrows(const fs::path& house, const std::string& room) {
  std::map<std::string, Names, std::less<>> arrows;
  const std::string face = "banyan/" + room + "/";
  for (const fs::path part : {"src", "include/banyan"}) {
    const fs::path root = part == "src" ? house / room / part : house / room / part / room;
    if (!fs::exists(root)) continue;
    for (const fs::path& file : sources(root)) {
      const auto from = folder_of(file.lexically_relative(root));
      for (const Include& include : includes(file)) {
        const bool is_face = include.name.starts_with(face);
        if (!from || !(is_face || include.quoted)) continue;
        const fs::path own = (file.parent_path() / include.name).lexically_relative(root).lexically_normal();
        const fs::path named = is_face                  ? fs::path(include.name.substr(face.size()))
                               : fs::exists(root / own) ? own
                                                        : fs::path(include.name);
        if (const auto to = folder_of(named); to && *to != *from && *to != "..") arrows[*from].insert(*to);
      }
    }
  }
  return arrows;
}

// Folders that include each other in a circle: those left when all that lead nowhere are taken away.
std::string circle(std::map<std::string, Names, std::less<>> arrows) {
  for (bool again = true; again;) {
    again = false;
    for (auto& [from, to] : arrows)
      again |= std::erase_if(to, [&](const std::string& name) { return !arrows.contains(name); }) > 0;
    again |= std::erase_if(arrows, [](const auto& one) { return one.second.empty(); }) > 0;
  }
  std::string names;
  for (const auto& [from, to] : arrows) names += from + " ";
  return names;
}

TEST(IncludeDirection, NoRoomHasACircleOfFolders) {
  const fs::path house = BANYAN_SOURCE_DIR;
  ASSERT_GT(folder_arrows(house, "controller").size(), 5U);
  for (const auto& [room, allowed] : may_include) EXPECT_EQ(circle(folder_arrows(house, room)), "") << room;
}

TEST(IncludeDirection, ArrowsOfTheHousePointDown) {
  const fs::path house = BANYAN_SOURCE_DIR;
  ASSERT_GT(sources(house / "controller").size(), 10U);
  ASSERT_GT(sources(house / "world").size(), 5U);
  EXPECT_EQ(lines(faults(house)), "");
}

// The test itself is worth nothing if it overlooks an arrow that points up.
class WrongHouse : public ::testing::Test {
 protected:
  void SetUp() override {
    house_ = fs::path(::testing::TempDir()) / ("banyan-house-" + std::to_string(::getpid()));
    fs::remove_all(house_);
  }
  void TearDown() override { fs::remove_all(house_); }
  void write(const fs::path& file, const std::string& line) const {
    fs::create_directories((house_ / file).parent_path());
    std::ofstream(house_ / file) << "// a file\n" << line << "\nint x;\n";
  }
  [[nodiscard]] std::string faults_of(const fs::path& file, const std::string& line) const {
    write(file, line);
    return lines(faults(house_));
  }
  fs::path house_;
};

TEST_F(WrongHouse, ControllerIncludesTheWorld) {
  EXPECT_EQ(faults_of("controller/src/x.cpp", "  #  include  \"banyan/world/world.hpp\""),
            "controller/src/x.cpp: banyan/world/world.hpp points up\n");
}
TEST_F(WrongHouse, ControllerTestIncludesTheWorld) {
  EXPECT_NE(faults_of("controller/test/x_test.cpp", "#include <banyan/world/world.hpp>"), "");
}
TEST_F(WrongHouse, TwoFoldersIncludeEachOther) {
  write("controller/src/tree/a.hpp", "#include \"healing/b.hpp\"");
  write("controller/src/core/c.hpp", "");
  EXPECT_EQ(circle(folder_arrows(house_, "controller")), "");
  write("controller/src/healing/b.hpp", "#include \"core/c.hpp\"");
  EXPECT_EQ(circle(folder_arrows(house_, "controller")), "");
  write("controller/src/core/c.hpp", "#include \"banyan/controller/tree/d.hpp\"");
  EXPECT_EQ(circle(folder_arrows(house_, "controller")), "core healing tree ");
}
TEST_F(WrongHouse, ControllerUsesTheHeap) { EXPECT_NE(faults_of("controller/src/x.cpp", "#include <vector>"), ""); }
TEST_F(WrongHouse, ControllerKnowsTheVersion) {
  EXPECT_NE(faults_of("controller/src/x.cpp", "#include \"banyan/version.hpp\""), "");
}
TEST_F(WrongHouse, OnlyTheSeamKnowsHosts) {
  EXPECT_EQ(faults_of("controller/include/banyan/controller/core/swarm.hpp",
                      "#include <memory>\n#include \"banyan/controller/core/swarm_of.hpp\""),
            "");
  EXPECT_NE(faults_of("controller/include/banyan/controller/core/swarm.hpp", "#include <iostream>"), "");
  EXPECT_EQ(faults_of("controller/include/banyan/controller/core/swarm.hpp", ""), "");
  EXPECT_EQ(faults_of("controller/src/x.cpp", "#include \"banyan/controller/core/swarm.hpp\""),
            "controller/src/x.cpp: banyan/controller/core/swarm.hpp is for hosts\n");
}
TEST_F(WrongHouse, ThePapersAlgorithmsStandOnCoreAlone) {
  const char* const ours = "#include \"banyan/controller/tree/motion.hpp\"";
  EXPECT_EQ(faults_of("controller/src/paper/x.cpp", "#include \"banyan/controller/core/guard.hpp\""), "");
  EXPECT_EQ(faults_of("controller/src/paper/x.cpp", ours),
            "controller/src/paper/x.cpp: banyan/controller/tree/motion.hpp is shared with the paper's room\n");
  EXPECT_EQ(faults_of("controller/src/paper/x.cpp", ""), "");
  EXPECT_EQ(faults_of("controller/src/convoy/x.cpp", ours), "");
  EXPECT_EQ(faults_of("controller/src/convoy/x.cpp", "#include \"banyan/controller/paper/paper.hpp\""),
            "controller/src/convoy/x.cpp: banyan/controller/paper/paper.hpp is shared with the paper's room\n");
  EXPECT_EQ(faults_of("controller/src/convoy/x.cpp", ""), "");
}
TEST_F(WrongHouse, OnlyTheListAndTestsNameAlgorithms) {
  EXPECT_EQ(faults_of("algorithms/src/x.cpp", "#include \"banyan/controller/paper/paper.hpp\""), "");
  EXPECT_EQ(faults_of("world/test/x_test.cpp",
                      "#include \"banyan/algorithms/algorithms.hpp\"\n#include \"banyan/controller/paper/paper.hpp\""),
            "");
  EXPECT_EQ(faults_of("world/src/x.cpp", "#include \"banyan/controller/paper/paper.hpp\""),
            "world/src/x.cpp: banyan/controller/paper/paper.hpp names an algorithm\n");
  EXPECT_EQ(faults_of("world/src/x.cpp", "#include \"banyan/algorithms/algorithms.hpp\""),
            "world/src/x.cpp: banyan/algorithms/algorithms.hpp points up\n");
  std::filesystem::remove(house_ / "world/src/x.cpp");
  EXPECT_EQ(faults_of("config/src/x.cpp", "#include \"banyan/algorithms/algorithms.hpp\""),
            "config/src/x.cpp: banyan/algorithms/algorithms.hpp points up\n");
  std::filesystem::remove(house_ / "config/src/x.cpp");
  EXPECT_EQ(faults_of("cli/src/x.cpp", "#include \"banyan/algorithms/algorithms.hpp\""), "");
}
TEST_F(WrongHouse, BaselinesStandOnTheCoreAlone) {
  EXPECT_EQ(faults_of("baselines/toy/src/x.cpp", "#include \"banyan/controller/core/guard.hpp\""), "");
  EXPECT_EQ(faults_of("baselines/toy/src/x.cpp", "#include \"banyan/controller/tree/motion.hpp\""),
            "baselines/toy/src/x.cpp: banyan/controller/tree/motion.hpp names an algorithm\n");
  EXPECT_EQ(faults_of("baselines/toy/src/x.cpp", "#include <vector>"),
            "baselines/toy/src/x.cpp: vector has no place on a robot\n");
  EXPECT_EQ(faults_of("baselines/toy/src/x.cpp", "#include \"banyan/world/world.hpp\""),
            "baselines/toy/src/x.cpp: banyan/world/world.hpp points up\n");
  EXPECT_EQ(faults_of("baselines/toy/src/x.cpp", "#include \"banyan/controller/core/algorithm_of.hpp\""),
            "baselines/toy/src/x.cpp: banyan/controller/core/algorithm_of.hpp is for hosts\n");
  EXPECT_EQ(faults_of("baselines/toy/src/x.cpp", "#include \"banyan/baselines/common/algorithm.hpp\""),
            "baselines/toy/src/x.cpp: banyan/baselines/common/algorithm.hpp is for hosts\n");
  std::filesystem::remove(house_ / "baselines/toy/src/x.cpp");
  EXPECT_EQ(faults_of("baselines/toy/src/algorithm.cpp",
                      "#include <vector>\n#include \"banyan/controller/core/algorithm_of.hpp\""),
            "");
  EXPECT_EQ(faults_of("baselines/toy/toy.cpp", "#include <vector>"),
            "baselines/toy/toy.cpp: vector has no place on a robot\n");
  std::filesystem::remove(house_ / "baselines/toy/toy.cpp");
  EXPECT_EQ(faults_of("baselines/common/test/net.hpp", "#include <vector>"), "");
  EXPECT_EQ(faults_of("baselines/toy/test/x_test.cpp",
                      "#include <vector>\n#include \"net.hpp\"\n#include \"banyan/controller/core/swarm_of.hpp\""),
            "");
  EXPECT_EQ(faults_of("algorithms/src/x.cpp", "#include \"banyan/baselines/common/motion.hpp\""), "");
  EXPECT_EQ(faults_of("world/src/x.cpp", "#include \"banyan/baselines/common/motion.hpp\""),
            "world/src/x.cpp: banyan/baselines/common/motion.hpp points up\n");
}
TEST_F(WrongHouse, AHostKnowsNoWorld) {
  EXPECT_EQ(faults_of("hosts/toy/src/x.cpp", "#include <vector>\n#include \"banyan/controller/core/swarm.hpp\""), "");
  EXPECT_EQ(faults_of("hosts/toy/src/x.cpp", "#include \"banyan/world/world.hpp\""),
            "hosts/toy/src/x.cpp: banyan/world/world.hpp points up\n");
  EXPECT_EQ(faults_of("hosts/toy/src/x.cpp", "#include \"banyan/controller/convoy/convoy.hpp\""),
            "hosts/toy/src/x.cpp: banyan/controller/convoy/convoy.hpp names an algorithm\n");
  std::filesystem::remove(house_ / "hosts/toy/src/x.cpp");
  EXPECT_EQ(faults_of("hosts/argos/src/x.cpp",
                      "#include \"banyan/config/config.hpp\"\n#include <argos3/core/simulator/simulator.h>"),
            "");
  EXPECT_EQ(faults_of("hosts/argos/src/x.cpp", "#include \"banyan/study/study.hpp\""),
            "hosts/argos/src/x.cpp: banyan/study/study.hpp points up\n");
  std::filesystem::remove(house_ / "hosts/argos/src/x.cpp");
  EXPECT_EQ(faults_of("cli/src/x.cpp", "#include \"banyan/hosts/toy/x.hpp\""), "");
  EXPECT_EQ(faults_of("world/src/x.cpp", "#include <sodium.h>"),
            "world/src/x.cpp: sodium.h belongs into another room\n");
}
TEST_F(WrongHouse, PythonPutsAProgramTogether) {
  EXPECT_EQ(faults_of("hosts/python/src/x.cpp", "#include <pybind11/pybind11.h>\n#include \"banyan/study/study.hpp\""),
            "");
  EXPECT_EQ(faults_of("hosts/python/src/x.cpp", "#include \"banyan/cli/x.hpp\""),
            "hosts/python/src/x.cpp: banyan/cli/x.hpp points up\n");
  EXPECT_EQ(faults_of("hosts/python/src/x.cpp", "#include \"banyan/controller/convoy/convoy.hpp\""),
            "hosts/python/src/x.cpp: banyan/controller/convoy/convoy.hpp names an algorithm\n");
  fs::remove(house_ / "hosts/python/src/x.cpp");
  EXPECT_EQ(faults_of("hosts/toy/src/x.cpp", "#include <pybind11/numpy.h>"),
            "hosts/toy/src/x.cpp: pybind11/numpy.h belongs into another room\n");
}
TEST_F(WrongHouse, WorldIncludesMeasure) {
  EXPECT_NE(faults_of("world/include/banyan/world/x.hpp", "#include \"banyan/measure/metrics.hpp\""), "");
}
TEST_F(WrongHouse, MeasureIncludesRecord) {
  EXPECT_NE(faults_of("measure/src/x.cpp", "#include \"banyan/record/mcap.hpp\""), "");
}
TEST_F(WrongHouse, RecordIncludesConfig) {
  EXPECT_NE(faults_of("record/src/x.cpp", "#include \"banyan/config/config.hpp\""), "");
}
TEST_F(WrongHouse, WorldReachesOut) {
  EXPECT_EQ(faults_of("cli/src/y.hpp", ""), "");
  EXPECT_EQ(faults_of("world/src/x.cpp", "#include \"../../cli/src/y.hpp\""),
            "world/src/x.cpp: ../../cli/src/y.hpp reaches out of its room\n");
  EXPECT_NE(faults_of("world/src/x.cpp", "#include \"no-such-file.hpp\""), "");
  std::ofstream(house_ / "world/src/z.hpp") << "\n";
  EXPECT_EQ(faults_of("world/src/x.cpp", "#include \"../src/z.hpp\""), "");
}
TEST_F(WrongHouse, OnlyTestsShareTheHelpersOfTests) {
  EXPECT_EQ(faults_of("controller/test/helper.hpp", ""), "");
  EXPECT_EQ(faults_of("world/test/x_test.cpp", "#include \"helper.hpp\""), "");
  EXPECT_EQ(faults_of("world/src/x.cpp", "#include \"helper.hpp\""),
            "world/src/x.cpp: helper.hpp is not in its room\n");
}
TEST_F(WrongHouse, ThePageUsesTheProgram) {
  EXPECT_NE(faults_of("viewer/live/x.cpp", "#include \"banyan/study/study.hpp\""), "");
  EXPECT_NE(faults_of("record/src/x.cpp", "#include <emscripten/bind.h>"), "");
  std::ofstream(house_ / "viewer/live/live.hpp") << "\n";
  EXPECT_NE(faults_of("record/src/x.cpp", "#include \"live.hpp\""), "");
}
TEST_F(WrongHouse, WorldReadsToml) { EXPECT_NE(faults_of("world/src/x.cpp", "#include <toml++/toml.h>"), ""); }
TEST_F(WrongHouse, RoomThatDoesNotExist) {
  EXPECT_NE(faults_of("cli/src/x.cpp", "#include \"banyan/attic/x.hpp\""), "");
}
TEST_F(WrongHouse, WhatIsRightIsNotNamed) {
  EXPECT_EQ(
      faults_of("cli/src/x.cpp", "#include \"banyan/world/world.hpp\"\n#include <CLI/CLI.hpp>\n#include <vector>"), "");
}

}  // namespace
