// SPDX-License-Identifier: MIT
// Maps from files: the same floor as PGM, PNG, BMP, by ROS and by MovingAI; what is wrong with one; and what is
// written.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/config/config.hpp"
#include "banyan/version.hpp"

namespace banyan::config {
namespace {

namespace fs = std::filesystem;

const std::string maps = BANYAN_MAPS;
const std::string floor_cells = "6#\n#4.#\n#.#..#\n6#";

class Maps : public testing::Test {
 protected:
  Maps() { fs::create_directories(folder_); }
  ~Maps() override { fs::remove_all(folder_); }
  Maps(const Maps&) = delete;
  Maps& operator=(const Maps&) = delete;

  std::string write(const std::string& name, const std::string& text) const {
    const std::string path = (folder_ / name).string();
    fs::create_directories(fs::path(path).parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  // A scenario far from the map; with `text` in it.
  Loaded load(const std::string& text, const std::vector<Override>& overrides = {}) const {
    const std::string file = write("scenario.toml", text +
                                                        "\n[swarm]\nstart.center_m = [50, 50]\n[targets]\nlayout = "
                                                        "\"list\"\npositions_m = [[51, 50], [50, 52]]\n");
    return load_configuration(file, algorithms(), overrides);
  }
  Loaded load_file(const std::string& file, const std::string& more = "resolution_m = 0.5") const {
    return load("[[obstacles]]\nkind = \"map\"\nfile = \"" + file + "\"\n" + more);
  }
  // The first error, without its folder.
  std::string error(const Loaded& loaded) const {
    for (const Problem& problem : loaded.problems) {
      if (problem.warning) continue;
      std::string text = to_string(problem);
      for (const std::string& where : {folder_.string() + "/", maps + "/"})
        for (auto at = text.find(where); at != std::string::npos; at = text.find(where)) text.erase(at, where.size());
      return text;
    }
    return "no error";
  }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("banyan-maps-" + std::to_string(::getpid()));
};

const world::FloorMap& map_of(const Loaded& loaded) {
  return std::get<world::FloorMap>(loaded.configuration.scenario.obstacles.at(0));
}

#define NEEDS_YAML() \
  if (std::string(missing_features).find("maps") != std::string::npos) GTEST_SKIP() << "built without libyaml"

TEST_F(Maps, AreTheSameAsPgmPngAndBmp) {
  for (const char* file : {"floor.pgm", "floor.png", "floor.bmp"}) {
    const Loaded loaded = load_file(maps + "/" + file, "resolution_m = 0.5\norigin_m = [1, 2]\nangle_deg = 90");
    ASSERT_TRUE(loaded.ok()) << error(loaded);
    EXPECT_EQ(map_of(loaded).cells->text(), floor_cells) << file;
    EXPECT_EQ(map_of(loaded).cell_m, 0.5);
    EXPECT_EQ(map_of(loaded).origin, (world::Vec2{1.0, 2.0}));
  }
}

TEST_F(Maps, OfRosHaveResolutionAndPlaceAndAreSeenFromTheirFile) {
  NEEDS_YAML();
  for (const std::string& text :
       {"map = \"" + maps + "/floor.yaml\"", "[[obstacles]]\nkind = \"map\"\nfile = \"" + maps + "/floor.yaml\""}) {
    const Loaded loaded = load(text);
    ASSERT_TRUE(loaded.ok()) << error(loaded);
    EXPECT_EQ(map_of(loaded).cells->text(), floor_cells);
    EXPECT_EQ(map_of(loaded).cell_m, 0.05);
    EXPECT_EQ(map_of(loaded).origin, (world::Vec2{-10.0, -2.5}));
    EXPECT_EQ(map_of(loaded).angle_rad, 0.5);
  }
  const Loaded moved = load_file(maps + "/floor.yaml", "origin_m = [3, 4]");
  ASSERT_TRUE(moved.ok()) << error(moved);
  EXPECT_EQ(map_of(moved).origin, (world::Vec2{3.0, 4.0})) << "the scenario's own word counts";
}

TEST_F(Maps, StandBesideOtherObstacles) {
  NEEDS_YAML();
  const Loaded loaded = load("map = \"" + maps +
                             "/floor.yaml\"\n[[obstacles]]\nkind = \"disc\"\ncenter_m = [1, 1]\n"
                             "radius_m = 0.1");
  ASSERT_TRUE(loaded.ok()) << error(loaded);
  ASSERT_EQ(loaded.configuration.scenario.obstacles.size(), 2U);
  EXPECT_TRUE(std::holds_alternative<world::FloorMap>(loaded.configuration.scenario.obstacles[1]));
}

// By map_server of Navigation 2: above occupied_thresh a pixel is occupied, with negate it is a bright one; unknown is
// no obstacle. In the mode scale a transparent pixel is unknown, and raw pixels are values, 100 for occupied.
TEST_F(Maps, OfRosAreReadAsRosReadsThem) {
  NEEDS_YAML();
  const std::string head = "resolution: 1\norigin: [0, 0, 0]\n";
  const auto cells = [&](const std::string& more) {
    const Loaded loaded = load_file(write("m/f.yaml", head + more), "");
    return loaded.ok() ? map_of(loaded).cells->text() : error(loaded);
  };
  write("m/grey.pgm", std::string("P5\n5 1\n255\n\x00\x59\x5a\x64\xff", 16));  // 0, 89, 90, 100, 255
  EXPECT_EQ(cells("image: grey.pgm\n"), "##3.") << "(255 - 90) / 255 is below 0.65";
  EXPECT_EQ(cells("image: grey.pgm\noccupied_thresh: 0.6\nfree_thresh: 0.2\n"), "4#.");
  EXPECT_EQ(cells("image: grey.pgm\nnegate: 1\n"), "4.#");
  EXPECT_EQ(cells("image: grey.pgm\nnegate: true\nmode: scale\n"), "4.#");
  EXPECT_EQ(cells("image: grey.pgm\nmode: raw\n"), "3.#.");
  EXPECT_EQ(cells("image: " + maps + "/alpha.png\nmode: scale\noccupied_thresh: 0.1\n"), floor_cells);
  EXPECT_EQ(cells("image: " + maps + "/alpha.png\noccupied_thresh: 0.1\n"), "6#\n#3.##\n#.#..#\n6#")
      << "in the mode trinary alpha counts like a colour";
}

TEST_F(Maps, OfMovingAi) {
  const Loaded loaded = load_file(maps + "/floor.map");
  ASSERT_TRUE(loaded.ok()) << error(loaded);
  EXPECT_EQ(map_of(loaded).cells->text(), floor_cells);
}

TEST_F(Maps, AreWrittenWithTheirCellsSoThatARunNeedsNoFile) {
  const Loaded loaded = load_file(maps + "/floor.png", "resolution_m = 0.05\norigin_m = [0.1, 0.2]\nangle_deg = 12.5");
  ASSERT_TRUE(loaded.ok()) << error(loaded);
  const std::string json = config_json(loaded.configuration), toml = config_toml(loaded.configuration);
  EXPECT_EQ(json.find("floor.png"), std::string::npos);
  for (const std::string& text : {json, toml}) {
    const Loaded again = parse_configuration("again", text, algorithms());
    ASSERT_TRUE(again.ok()) << error(again);
    EXPECT_EQ(again.configuration.scenario.obstacles, loaded.configuration.scenario.obstacles);
    EXPECT_EQ(config_json(again.configuration), json);
  }
}

TEST_F(Maps, WithAnotherCellAreAnotherText) {  // of which the ids of a study's runs are digests
  const Loaded one = load("[[obstacles]]\nkind = \"map\"\nresolution_m = 1\ncells = \"#..\"");
  const Loaded other = load("[[obstacles]]\nkind = \"map\"\nresolution_m = 1\ncells = \".#.\"");
  ASSERT_TRUE(one.ok() && other.ok());
  EXPECT_NE(config_json(one.configuration), config_json(other.configuration));
}

TEST_F(Maps, CanBeDrawnInTheScenarioAndChangedByAnOption) {
  const std::string drawn =
      "[[obstacles]]\nkind = \"map\"\nresolution_m = 0.25\ncells = \"\"\"\n  ####\n  #..#\n  ####\n\"\"\"";
  EXPECT_EQ(map_of(load(drawn)).cells->text(), "4#\n#..#\n4#");
  const Loaded other = load(drawn, {{"obstacles[0].file=" + maps + "/floor.pgm", "--set"}});
  ASSERT_TRUE(other.ok()) << error(other);
  EXPECT_EQ(map_of(other).cells->text(), floor_cells);
  const Loaded finer = load(drawn, {{"obstacles[0].resolution_m=0.125", "--set"}});
  EXPECT_EQ(map_of(finer).cell_m, 0.125);
}

TEST_F(Maps, SayWhatIsWrongAndWhere) {
  EXPECT_EQ(error(load_file("nowhere.png")),
            "scenario.toml:3: error: obstacles[0].file: nowhere.png: there is no such file");
  EXPECT_EQ(
      error(load_file(write("empty.png", "x"))),
      "scenario.toml:3: error: obstacles[0].file: empty.png: is no picture that can be read: PNG, BMP, or PGM and "
      "PPM of the binary kind (P5, P6)");
  EXPECT_EQ(
      error(load_file(write("large.pgm", "P5\n5000 5000\n255\n"))),
      "scenario.toml:3: error: obstacles[0].file: large.pgm: has 5000 x 5000 pixels; at most 16777216 are possible, "
      "as of 4096 x 4096");
  EXPECT_EQ(error(load_file(maps + "/floor.png", "")),
            "scenario.toml:1: error: obstacles[0].resolution_m: is missing; kind = \"map\" needs it");
  EXPECT_EQ(error(load_file(maps + "/floor.png", "resolution_m = 1\ncells = \"#\"")),
            "scenario.toml:3: error: obstacles[0].file: give file or cells, not both");
  EXPECT_EQ(error(load("[[obstacles]]\nkind = \"map\"\nresolution_m = 1")),
            "scenario.toml:1: error: obstacles[0].cells: is missing; kind = \"map\" needs it");
  EXPECT_EQ(error(load("[[obstacles]]\nkind = \"map\"\nresolution_m = 1\ncells = \"##\\n#\"")),
            "scenario.toml:4: error: obstacles[0].cells: row 2 has 1 cells, those above have 2");
  EXPECT_EQ(error(load("[[obstacles]]\nkind = \"map\"\nresolution_m = 1\ncells = \"##\"")),
            "scenario.toml:1: error: obstacles[0]: all 2 cells of the map are occupied");
  EXPECT_EQ(
      error(load("map = \"floor.png\"")),
      "scenario.toml:1: error: map: the text \"floor.png\" is no YAML of ROS, and other maps have no scale: write "
      "[[obstacles]] with kind = \"map\", file and resolution_m");
  EXPECT_EQ(error(load("map = 3")),
            "scenario.toml:1: error: map: must be the name of a file in quotes, not the number 3");
  EXPECT_EQ(error(load("[[obstacles]]\nkind = \"disc\"\nradius_m = 1\ncenter_m = [0, 0]\nfile = \"a.png\"")),
            "scenario.toml:5: error: obstacles[0].file: has no meaning with kind = \"disc\", only with \"map\"");
}

TEST_F(Maps, OfMovingAiSayWhatIsWrongInWhichLine) {
  const std::string head = "type octile\nheight 2\nwidth 3\nmap\n";
  EXPECT_EQ(error(load_file(write("a.map", "octile\n"))),
            "a.map:1: error: a map of MovingAI begins with \"type octile\"");
  EXPECT_EQ(error(load_file(write("a.map", "type octile\nheight -2\n"))),
            "a.map:2: error: must be \"height \" and a number of cells");
  EXPECT_EQ(error(load_file(write("a.map", head + "...\n..\n"))), "a.map:6: error: has 2 cells; line 3 says 3");
  EXPECT_EQ(error(load_file(write("a.map", head + "...\n"))), "a.map:6: error: has 0 cells; line 3 says 3");
  EXPECT_EQ(error(load_file(write("a.map", head + "...\n.x.\n"))),
            "a.map:6: error: has a 'x'; free are . G S, occupied @ O T W");
  EXPECT_EQ(error(load_file(write("a.map", "type octile\nheight 99999\nwidth 99999\nmap\n"))),
            "a.map:2: error: has 99999 x 99999 cells; 1 to 16777216 are possible, as of 4096 x 4096");
}

TEST_F(Maps, OfRosSayWhatIsWrongInWhichLine) {
  NEEDS_YAML();
  const auto fault = [&](const std::string& text) { return error(load_file(write("a.yaml", text), "")); };
  EXPECT_EQ(fault("image: a.pgm\norigin: [0, 0, 0]\n"), "a.yaml:1: error: resolution: is missing");
  EXPECT_EQ(fault("image: a.pgm\nresolution: 0\norigin: [0, 0, 0]\n"),
            "a.yaml:2: error: resolution: is 0; allowed: above 0, at "
            "most 100000000");
  EXPECT_EQ(fault("image: a.pgm\nresolution: 1\norigin: [0, east]\n"),
            "a.yaml:3: error: origin: must be [x, y, yaw] in m and rad, not a list of 2 values");
  EXPECT_EQ(fault("image: a.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 2\n"),
            "a.yaml:4: error: negate: must be 0 or 1, not the number 2");
  EXPECT_EQ(fault("image: a.pgm\nresolution: 1\norigin: [0, 0, 0]\nmode: tri\n").substr(0, 23),
            "a.yaml:4: error: mode: ");
  EXPECT_EQ(fault("image: a.pgm\nresolution: 1\norigin: [0, 0, 0]\nfree_thresh: 0.9\n"),
            "a.yaml:4: error: free_thresh: must not be above occupied_thresh");
  EXPECT_EQ(fault("image: gone.pgm\nresolution: 1\norigin: [0, 0, 0]\n").find("no such file") == std::string::npos,
            false);
  EXPECT_EQ(fault("image: [a\nresolution").substr(0, 34), "a.yaml:3: error: this is not YAML:");
  EXPECT_EQ(fault("- image\n").substr(0, 16), "a.yaml:1: error:");
  const Loaded odd =
      load_file(write("b.yaml", "image: " + maps + "/floor.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegat: 1\n"), "");
  EXPECT_TRUE(odd.ok()) << "ROS reads no other keys";
  ASSERT_FALSE(odd.problems.empty());
  EXPECT_NE(to_string(odd.problems[0]).find("negate"), std::string::npos) << to_string(odd.problems[0]);
}

// Whatever is in a file, it is a problem and no crash.
// Nine lists of ten aliases each: a kilobyte that would become a thousand million values.
TEST_F(Maps, OfRosWithAliasesUponAliasesAreRefused) {
  NEEDS_YAML();
  std::string yaml = "a0: &a0 [1, 1]\n";
  for (int level = 1; level <= 9; ++level) {
    const std::string below = "*a" + std::to_string(level - 1);
    yaml += "a" + std::to_string(level) + ": &a" + std::to_string(level) + " [" + below;
    for (int k = 1; k < 10; ++k) yaml += ", " + below;
    yaml += "]\n";
  }
  write("bomb.yaml", yaml);
  std::string said;
  for (const Problem& problem : load("map = \"bomb.yaml\"\n").problems) said += to_string(problem) + "\n";
  EXPECT_NE(said.find("has more than ten thousand values: no map"), std::string::npos) << said;
}

TEST_F(Maps, WithDamagedBytesAreRefusedOrRead) {
  for (const char* name : {"floor.png", "floor.bmp", "floor.pgm", "floor.yaml", "floor.map"}) {
    const std::string whole = read_file(maps + "/" + name, 1U << 20);
    for (std::size_t at = 0; at < whole.size(); ++at) {
      std::string damaged = whole;
      damaged[at] =
          "\0\xff"
          "9"[at % 3];
      for (const std::string& text : {damaged, whole.substr(0, at)}) {
        const Loaded loaded = load_file(write(std::string("damaged-") + name, text));
        if (loaded.ok()) {
          EXPECT_NE(map_of(loaded).cells, nullptr);
        } else {
          EXPECT_NE(error(loaded), "no error");
        }
      }
    }
  }
}

TEST_F(Maps, NameWhatStandsInAWallAndTheNearestFreePlace) {
  const std::string room =
      "[[obstacles]]\nkind = \"map\"\nresolution_m = 0.5\ncells = \"\"\"\n20#\n8*#18.#\n20#\n\"\"\"\n";
  const auto fault = [&](const std::string& start, const std::string& target) {
    return error(parse_configuration("a.toml",
                                     room + "[swarm]\nrobots = 5\nstart.center_m = " + start +
                                         "\n[targets]\nlayout = \"list\"\npositions_m = [" + target + "]\n",
                                     algorithms()));
  };
  EXPECT_EQ(fault("[3, 2]", "[5, 2]"), "no error");
  EXPECT_EQ(fault("[3, 2]", "[5, 0.4]"),
            "a.toml:14: error: targets.positions_m[0]: target 0 at (5, 0.4) lies inside an obstacle; the nearest free "
            "place is (5.02753, 0.573833)");
  EXPECT_EQ(fault("[0.2, 2]", "[5, 2]").substr(0, 115),
            "a.toml:11: error: swarm.start.center_m: there is no room for a robot at (0.2, 2): an obstacle is closer "
            "than robot.");
  EXPECT_EQ(
      fault("[3, 2]", "[12, 2]").substr(0, 109),
      "a.toml:14: error: targets.positions_m[0]: target 0 at (12, 2) is in a room that no robot can reach from the s");
}

}  // namespace
}  // namespace banyan::config
