// SPDX-License-Identifier: MIT
// The lists of libraries agree: what CMake looks for (cmake/libraries.cmake), Debian's packages (cmake/packages.txt),
// rosdep's keys (package.xml) and the copies (third_party/).
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;
using Words = std::set<std::string>;

const fs::path clone = BANYAN_SOURCE_DIR;

std::string text_of(const fs::path& path) {
  std::ifstream in(clone / path);
  return {std::istreambuf_iterator<char>(in), {}};
}

// What the first group of `expression` matches in `text`.
Words all_of(const std::string& text, const std::string& expression) {
  const std::regex wanted(expression);
  Words found;
  for (std::sregex_iterator it(text.begin(), text.end(), wanted), end; it != end; ++it) found.insert((*it)[1]);
  return found;
}

// The packages of each group of packages.txt.
std::map<std::string, Words> groups() {
  std::map<std::string, Words> found;
  std::istringstream lines(text_of("cmake/packages.txt"));
  std::string group;
  for (std::string line; std::getline(lines, line);) {
    const std::string word = line.substr(0, line.find_first_of(" #"));
    if (word.starts_with('[')) group = word.substr(1, word.find(']') - 1);
    else if (!word.empty()) found[group].insert(word);
  }
  return found;
}

// What the program can use.
const char* const of_the_program[] = {"run",    "zstd",    "box2d", "pixels",  "fleets",
                                      "tuning", "figures", "mpi",   "headers", "film"};

// rosdep's keys of Debian's packages; "": it has none, or the package is of no use without one that has none.
const std::map<std::string, std::string> rosdep_keys = {
    {"g++", ""},
    {"cmake", "cmake"},
    {"ninja-build", ""},  // make does
    {"libzstd-dev", "libzstd-dev"},
    {"libbox2d-dev", "box2d-dev"},
    {"librsvg2-dev", ""},
    {"fonts-dejavu-core", ""},
    {"pkgconf", "pkg-config"},
    {"libsodium-dev", "libsodium-dev"},
    {"iproute2", "iproute2"},
    {"libpagmo-dev", ""},
    {"libtbb-dev", ""},
    {"libboost-serialization-dev", ""},
    {"python3-matplotlib", "python3-matplotlib"},
    {"libopenmpi-dev", ""},
    {"openmpi-bin", ""},
    {"libtomlplusplus-dev", ""},
    {"libcli11-dev", "cli11"},
    {"nlohmann-json3-dev", "nlohmann-json-dev"},
    {"libeigen3-dev", "eigen"},
    {"libspectra-dev", ""},
    {"libcpp-httplib-dev", "libcpp-httplib-dev"},
    {"ffmpeg", "ffmpeg"},
};

// Of banyan-ros2 and its launch file.
const Words of_ros = {"cyclonedds", "launch", "ros2launch", "rviz2"};

TEST(Packages, PackageXmlAsksForWhatRosdepKnows) {
  auto listed = groups();
  Words keys = of_ros;
  for (const char* group : of_the_program) {
    ASSERT_FALSE(listed[group].empty()) << group;
    for (const std::string& package : listed[group]) {
      ASSERT_TRUE(rosdep_keys.contains(package)) << package;
      if (const std::string& key = rosdep_keys.at(package); !key.empty()) keys.insert(key);
    }
  }
  EXPECT_EQ(all_of(text_of("package.xml"), "<(?:build_|exec_|buildtool_)?depend>([^<]+)</"), keys);
}

TEST(Packages, ThoseThatCMakeNamesAreListed) {
  Words listed;
  for (const auto& [group, packages] : groups()) listed.insert(packages.begin(), packages.end());
  const Words named = all_of(text_of("cmake/libraries.cmake"), "\\b([a-z0-9-]+-(?:dev|tools|bin)|pkgconf)\\b");
  EXPECT_GE(named.size(), 10U);
  for (const std::string& package : named) EXPECT_TRUE(listed.contains(package)) << package;
}

TEST(Packages, EveryHeaderOnlyLibraryHasItsCopyAndItsLicence) {
  const Words wanted = all_of(text_of("cmake/libraries.cmake"), "\nbanyan_find_header_only\\((\\w+)");
  const Words within = all_of(text_of("cmake/libraries.cmake"), "\n +banyan_find_header_only\\((\\w+)");
  Words names = wanted;
  names.insert(within.begin(), within.end());
  EXPECT_EQ(names, all_of(text_of("third_party/README.md"), "\n\\| `(\\w+)`"));
  Words folders;
  for (const auto& entry : fs::directory_iterator(clone / "third_party"))
    if (entry.is_directory()) folders.insert(entry.path().filename());
  EXPECT_EQ(names, folders);
  for (const std::string& name : names) EXPECT_TRUE(fs::exists(clone / "third_party" / name / "LICENSE")) << name;
}

TEST(Packages, TheVersionIsOne) {
  EXPECT_EQ(all_of(text_of("package.xml"), "<version>([^<]+)<"),
            all_of(text_of("CMakeLists.txt"), "project\\(banyan VERSION ([0-9.]+)"));
}

}  // namespace
