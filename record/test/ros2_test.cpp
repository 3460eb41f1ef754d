// SPDX-License-Identifier: MIT
// Messages of ROS 2, decoded by nothing but the definitions that go with them. record/test/readers/ has the libraries
// of others do it.
#include "banyan/record/ros2.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "banyan/record/export.hpp"
#include "banyan/record/mcap.hpp"
#include "sample.hpp"

namespace banyan::record {
namespace {

using nlohmann::json;

// As section 7.4 of DDS-XTypes has XCDR1: little endian, each number at a multiple of its size.
class Decoder {
 public:
  explicit Decoder(const ros2::MessageType& type) {
    std::istringstream lines(type.definition);
    std::string current;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("====")) {
        std::getline(lines, line);
        current = line.substr(std::string_view("MSG: ").size());
      } else if (line.find('=') == std::string::npos) {
        const std::size_t space = line.find(' ');
        fields_[current].emplace_back(line.substr(0, space), line.substr(space + 1));
      }
    }
  }

  json decode(std::string_view bytes) {
    EXPECT_EQ(bytes.substr(0, 4), std::string_view("\0\1\0\0", 4));
    body_ = bytes.substr(4);
    at_ = 0;
    json message = structure("");
    EXPECT_EQ(at_, body_.size()) << "bytes that no field wants";
    return message;
  }

 private:
  json structure(const std::string& name) {
    json all = json::object();
    EXPECT_TRUE(fields_.contains(name)) << name;
    for (const auto& [type, field] : fields_[name]) {
      if (!type.ends_with("[]")) {
        all[field] = value(type);
        continue;
      }
      json& list = all[field] = json::array();
      for (auto left = number(4); left > 0; --left) list.push_back(value(type.substr(0, type.size() - 2)));
    }
    return all;
  }
  json value(const std::string& type) {
    if (type == "string") {
      const auto size = number(4);
      const std::string_view text = body_.substr(at_, size);
      at_ += size;
      EXPECT_EQ(text.find('\0'), text.size() - 1);
      return text.substr(0, text.size() - 1);
    }
    if (type == "float64") return std::bit_cast<double>(number(8));
    if (type == "float32") return std::bit_cast<float>(static_cast<std::uint32_t>(number(4)));
    if (type == "int32") return static_cast<std::int32_t>(number(4));
    if (type == "uint32") return number(4);
    if (type == "uint8" || type == "bool") return number(1);
    if (type == "int8") return static_cast<std::int8_t>(number(1));
    return structure(type);
  }
  std::uint64_t number(std::size_t size) {
    at_ = (at_ + size - 1) / size * size;
    std::uint64_t all = 0;
    for (std::size_t k = 0; k < size; ++k) {
      all |= static_cast<std::uint64_t>(static_cast<unsigned char>(body_.at(at_ + k))) << (8 * k);
    }
    at_ += size;
    return all;
  }

  std::map<std::string, std::vector<std::pair<std::string, std::string>>> fields_;
  std::string_view body_;
  std::size_t at_ = 0;
};

json markers_of(const Setting& setting, const Frame& frame, const RadioLinks* links = nullptr) {
  ros2::CdrWriter out;
  write_markers(out, {.nanoseconds = 2500000000}, setting, frame, links);
  return Decoder(ros2::markers_type()).decode(out.view())["markers"];
}

json layer(const json& markers, std::string_view name) {
  json found = json::array();
  for (const json& marker : markers)
    if (marker["ns"] == name) found.push_back(marker);
  return found;
}

TEST(Ros2Messages, TransformsAreWhereRobotsAreAlsoTheDead) {
  const Frame frame = test::sample_frame(20, 3.0, 7);
  ASSERT_FALSE(frame.robots[17].alive);
  ros2::CdrWriter out;
  write_transforms(out, {.nanoseconds = 3000000700, .map = "world", .body = "r{}/body_{}"}, frame);
  const json all = Decoder(ros2::transforms_type()).decode(out.view())["transforms"];
  ASSERT_EQ(all.size(), 20U);
  for (std::size_t i = 0; i < 20; ++i) {
    const std::string number = std::to_string(i);
    EXPECT_EQ(all[i]["child_frame_id"], "r" + number + "/body_" + number);
    EXPECT_EQ(all[i]["header"], (json{{"stamp", {{"sec", 3}, {"nanosec", 700}}}, {"frame_id", "world"}}));
    const json& transform = all[i]["transform"];
    EXPECT_NEAR(transform["translation"]["x"].get<double>(), frame.robots[i].position.x, 1e-4);
    EXPECT_NEAR(transform["translation"]["y"].get<double>(), frame.robots[i].position.y, 1e-4);
    const double z = transform["rotation"]["z"], w = transform["rotation"]["w"];
    EXPECT_NEAR(std::remainder(2.0 * std::atan2(z, w) - frame.robots[i].heading_rad, 2.0 * pi<double>), 0.0, 1e-4);
    EXPECT_NEAR(std::hypot(z, w), 1.0, 1e-4);
  }
}

// From the public definitions, of which nothing else of ours has these.
const std::string parts_of_odometry =
    "================\nMSG: std_msgs/Header\ntime stamp\nstring frame_id\n"
    "================\nMSG: time\nint32 sec\nuint32 nanosec\n"
    "================\nMSG: pose36\npose pose\n================\nMSG: pose\nxyz position\nxyzw orientation\n"
    "================\nMSG: xyz\nfloat64 x\nfloat64 y\nfloat64 z\n"
    "================\nMSG: xyzw\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"
    "================\nMSG: twist\nxyz linear\nxyz angular\n";

std::string covariance(const std::string& name) {
  std::string fields;
  for (int k = 0; k < 36; ++k) fields += "float64 " + name + std::to_string(k) + "\n";
  return fields;
}

// It looks to the west across the cut of angles, and slides to its right while it turns.
TEST(Ros2Messages, OdometryHasTheSpeedInTheRobotsOwnFrame) {
  const ros2::MessageType type{"nav_msgs/msg/Odometry", "std_msgs/Header header\nstring child_frame_id\npose pose\n" +
                                                            covariance("p") + "twist twist\n" + covariance("t") +
                                                            parts_of_odometry};
  RobotFrame before, now;
  before.position = {1.0, 2.0};
  before.heading_rad = 3.1;
  now.position = {1.0, 2.05};  // 0.5 m/s to the north
  now.heading_rad = -pi<double>;
  ros2::CdrWriter out;
  write_odometry(out, {.nanoseconds = 1500000000}, 7, now, before, 0.1);
  const json odometry = Decoder(type).decode(out.view());
  EXPECT_EQ(odometry["header"], (json{{"stamp", {{"sec", 1}, {"nanosec", 500000000}}}, {"frame_id", "map"}}));
  EXPECT_EQ(odometry["child_frame_id"], "robot_7/base_link");
  EXPECT_NEAR(odometry["pose"]["position"]["y"].get<double>(), 2.05, 1e-9);
  EXPECT_NEAR(std::abs(odometry["pose"]["orientation"]["z"].get<double>()), 1.0, 1e-4);
  EXPECT_NEAR(odometry["twist"]["linear"]["x"].get<double>(), 0.0, 1e-6);
  EXPECT_NEAR(odometry["twist"]["linear"]["y"].get<double>(), -0.5, 1e-6);
  EXPECT_NEAR(odometry["twist"]["angular"]["z"].get<double>(), (pi<double> - 3.1) / 0.1, 1e-6);
  for (const char* zero : {"p0", "p35", "t0", "t35"}) EXPECT_EQ(odometry[zero], 0.0);
  write_odometry(out, {}, 7, now, before, 0.0);
  EXPECT_EQ(Decoder(type).decode(out.view())["twist"]["linear"]["y"], 0.0);
}

TEST(Ros2Messages, TheClockIsATime) {
  ros2::CdrWriter out;
  write_clock(out, {.nanoseconds = 61000000007});
  const json clock = Decoder({"rosgraph_msgs/msg/Clock", "int32 sec\nuint32 nanosec\n"}).decode(out.view());
  EXPECT_EQ(clock, (json{{"sec", 61}, {"nanosec", 7}}));
}

TEST(Ros2Messages, DiagnosesSayWhatIsWrongAndHowBadItIs) {
  using Level = ros2::Diagnosis::Level;
  measure::Tick tick;
  tick.alive = 9;
  tick.roots = tick.components = tick.tree_parts = 1;
  tick.active_targets = 3;
  const auto levels = [&] {
    std::vector<Level> list;
    for (const auto& part : ros2::diagnose(tick, 9)) list.push_back(part.level);
    return list;
  };
  EXPECT_EQ(levels(), (std::vector{Level::ok, Level::ok, Level::ok}));
  EXPECT_EQ(ros2::diagnose(tick, 9)[0].message, "0 of 3 targets held");
  tick.targets_reached = 3;
  EXPECT_EQ(ros2::diagnose(tick, 9)[0].message, "complete");
  tick.broken_by_occlusion = 1;
  tick.alive = 7;
  EXPECT_EQ(levels(), (std::vector{Level::ok, Level::warning, Level::warning}));
  EXPECT_EQ(ros2::diagnose(tick, 9)[1].message, "1 broken edge");
  EXPECT_EQ(ros2::diagnose(tick, 9)[2].message, "2 of 9 dead");
  tick.components = 2;
  EXPECT_EQ(ros2::diagnose(tick, 9)[1].message, "in 2 parts");
  tick.alive = 0;
  EXPECT_EQ(levels(), (std::vector{Level::ok, Level::error, Level::error}));

  ros2::CdrWriter out;
  write_diagnostics(out, {.nanoseconds = 1000000002}, ros2::diagnose(tick, 9));
  const json array = Decoder({"diagnostic_msgs/msg/DiagnosticArray",
                              "std_msgs/Header header\nstatus[] status\n" + parts_of_odometry +
                                  "================\nMSG: status\nuint8 level\nstring name\nstring message\nstring "
                                  "hardware_id\nvalue[] values\n"
                                  "================\nMSG: value\nstring key\nstring value\n"})
                         .decode(out.view());
  ASSERT_EQ(array["status"].size(), 3U);
  EXPECT_EQ(array["status"][1]["level"], 2);
  EXPECT_EQ(array["status"][1]["name"], "banyan: network");
  EXPECT_EQ(array["status"][2]["values"][0], (json{{"key", "robots"}, {"value", "9"}}));
}

TEST(Ros2Messages, MarkersBeginByDeletingAndHaveIdsOfTheirOwn) {
  const json markers = markers_of(test::sample_setting(), test::sample_frame(30, 3.0, 7));
  EXPECT_EQ(markers[0]["action"], 3);
  std::set<std::pair<std::string, int>> seen;
  for (std::size_t k = 1; k < markers.size(); ++k) {
    EXPECT_EQ(markers[k]["action"], 0);
    EXPECT_EQ(markers[k]["lifetime"], (json{{"sec", 0}, {"nanosec", 0}}));
    EXPECT_EQ(markers[k]["header"], (json{{"stamp", {{"sec", 2}, {"nanosec", 500000000}}}, {"frame_id", "map"}}));
    EXPECT_TRUE(seen.emplace(markers[k]["ns"], markers[k]["id"]).second) << markers[k];
  }
  std::set<std::string> layers;
  for (const auto& [name, id] : seen) layers.insert(name);
  EXPECT_EQ(layers,
            (std::set<std::string>{"headings", "obstacles", "old_tree", "robots", "target_names", "targets", "tree"}));
}

TEST(Ros2Messages, DeadRobotsAreGreyAndHaveNoEdge) {
  Frame frame;
  frame.robots.resize(3);
  frame.robots[0].role = Role::root;
  frame.robots[1].parent = 0;
  frame.robots[2].parent = 1;
  frame.robots[2].position = {1.0, 2.0};
  EXPECT_EQ(layer(markers_of({}, frame), "tree")[0]["points"].size(), 4U);
  frame.robots[1].alive = false;
  const json markers = markers_of({}, frame);
  const json edges = layer(markers, "tree")[0]["points"];
  ASSERT_EQ(edges.size(), 2U);
  EXPECT_EQ(edges[0]["y"], 2.0);
  const json colors = layer(markers, "robots")[0]["colors"];
  EXPECT_EQ(colors[1]["r"], colors[1]["g"]);
  EXPECT_EQ(colors[1]["g"], colors[1]["b"]);
  EXPECT_GT(colors[0]["r"], colors[0]["b"]);
}

TEST(Ros2Messages, ATargetThatIsGivenUpIsGoneAndTheOthersKeepTheirNames) {
  Frame frame;
  frame.robots.resize(1);
  frame.targets = {{{1.0, 0.0}, 0}, {{2.0, 0.0}, 0, false}, {{3.0, 0.5}, 0}};
  const json names = layer(markers_of({}, frame), "target_names");
  ASSERT_EQ(names.size(), 2U);
  EXPECT_EQ(names[1]["text"], "T2");
  EXPECT_EQ(names[1]["id"], 2);
  EXPECT_EQ(names[1]["pose"]["position"]["y"], 0.5);
  EXPECT_EQ(layer(markers_of({}, frame), "targets").size(), 2U);
}

TEST(Ros2Messages, AWallStandsBetweenItsEnds) {
  Setting setting;
  setting.obstacles = {world::Disc{{4.0, 0.5}, 0.25}, world::Box{{-2.5, 1.0}, {0.5, 0.25}, 0.5},
                       world::Wall{{-1.0, -2.0}, {2.0, 2.0}}};
  const json obstacles = layer(markers_of(setting, {}), "obstacles");
  ASSERT_EQ(obstacles.size(), 3U);
  EXPECT_EQ(obstacles[0]["scale"]["x"], 0.5);
  EXPECT_EQ(obstacles[1]["scale"]["y"], 0.25);
  const json& wall = obstacles[2];
  EXPECT_EQ(wall["scale"]["x"], 5.0);
  EXPECT_EQ(wall["pose"]["position"]["x"], 0.5);
  const double z = wall["pose"]["orientation"]["z"], w = wall["pose"]["orientation"]["w"];
  EXPECT_NEAR(2.0 * std::atan2(z, w), std::atan2(4.0, 3.0), 1e-4);
}

world::FloorMap sample_map(const char* cells) {
  world::FloorMap map;
  map.cell_m = 0.25;
  map.origin = {-1.0, 2.0};
  map.angle_rad = 0.5;
  map.cells = std::make_shared<const world::CellGrid>(world::CellGrid::from_text(cells));
  return map;
}

TEST(Ros2Messages, AMapHasItsLowestRowFirst) {
  ros2::CdrWriter out;
  write_map(out, {.nanoseconds = 2500000000}, sample_map("#..\n.##"));
  const json map = Decoder(ros2::map_type()).decode(out.view());
  EXPECT_EQ(map["header"]["frame_id"], "map");
  EXPECT_EQ(map["info"]["resolution"], 0.25F);
  EXPECT_EQ(map["info"]["width"], 3);
  EXPECT_EQ(map["info"]["height"], 2);
  EXPECT_EQ(map["info"]["origin"]["position"]["y"], 2.0);
  EXPECT_NEAR(map["info"]["origin"]["orientation"]["z"].get<double>(), std::sin(0.25), 1e-4);
  EXPECT_EQ(map["data"], (json{0, 100, 100, 100, 0, 0}));
}

// RViz complains of a list without points.
TEST(Ros2Messages, ListsWithoutPointsAreNoMarkers) {
  EXPECT_EQ(markers_of({}, {}).size(), 1U);
  Frame frame;
  frame.robots.resize(2);
  RadioLinks links;
  EXPECT_TRUE(layer(markers_of({}, frame, &links), "links").empty());
  links.open = {{0, 1}};
  const json markers = markers_of({}, frame, &links);
  EXPECT_EQ(layer(markers, "links")[0]["points"].size(), 2U);
  EXPECT_TRUE(layer(markers, "tree").empty());
}

TEST(Ros2Messages, TheLogWarnsOfWhatIsBad) {
  ros2::CdrWriter out;
  Decoder decoder(ros2::log_type());
  write_log(out, {.nanoseconds = 100000000}, {.kind = "death", .text = "robot 3 has died"});
  const json death = decoder.decode(out.view());
  EXPECT_EQ(death["level"], 30);
  EXPECT_EQ(death["name"], "banyan.death");
  EXPECT_EQ(death["msg"], "robot 3 has died");
  EXPECT_EQ(death["stamp"], (json{{"sec", 0}, {"nanosec", 100000000}}));
  write_log(out, {}, {.kind = "arrival", .text = ""});
  EXPECT_EQ(decoder.decode(out.view())["level"], 20);
}

std::size_t count(mcap::Reader& reader, std::string_view topic, std::vector<mcap::Nanoseconds>* times = nullptr) {
  std::size_t number = 0;
  reader.messages(reader.find_channel(topic)->id, [&](const mcap::LoggedMessage& message) {
    if (times != nullptr) times->push_back(message.log_time);
    ++number;
    return true;
  });
  return number;
}

TEST(Bag, HasTheChosenFramesAndNothingButMessagesOfRos) {
  const test::TemporaryDirectory directory;
  test::record_sample(directory.file("a.mcap"), 9, 100);
  Recording recording(directory.file("a.mcap"));
  ExportOptions options;
  options.from_s = 1.0;
  options.to_s = 4.6;
  options.every = 5;
  const auto messages = export_bag(recording, directory.file("bag.mcap"), Existing::keep, options);
  mcap::Reader bag(directory.file("bag.mcap"));
  EXPECT_TRUE(bag.indexed());
  ASSERT_EQ(bag.channels().size(), 3U);
  for (const auto& [id, channel] : bag.channels()) EXPECT_EQ(channel.message_encoding, "cdr");
  std::vector<mcap::Nanoseconds> times;
  EXPECT_EQ(count(bag, "/tf", &times), 8U);
  EXPECT_EQ(times.front(), 1000000000U);
  EXPECT_EQ(times.back(), 4500000000U);
  EXPECT_EQ(count(bag, "/markers"), 8U);
  std::size_t events = 0;
  for (const RecordedEvent& event : recording.events()) events += event.time_s >= 1.0 && event.time_s <= 4.6 ? 1 : 0;
  EXPECT_GT(events, 0U);
  EXPECT_EQ(count(bag, "/rosout"), events);
  EXPECT_EQ(messages, 16 + events);
}

TEST(Bag, ObstaclesAreWhereTheyWereAtThatTime) {
  const test::TemporaryDirectory directory;
  Setting setting = test::sample_setting();
  {
    Recorder recorder(directory.file("a.mcap"), test::sample_provenance());
    for (std::uint64_t t = 0; t < 4; ++t) {
      if (t == 2) setting.obstacles.erase(setting.obstacles.begin());
      const Frame frame = test::sample_frame(5, 3.0, t);
      recorder.frame(setting, frame, test::sample_tick(frame));
    }
    recorder.finish(test::sample_run(4));
  }
  Recording recording(directory.file("a.mcap"));
  (void)export_bag(recording, directory.file("bag.mcap"));
  mcap::Reader bag(directory.file("bag.mcap"));
  std::vector<std::size_t> obstacles;
  bag.messages(bag.find_channel("/markers")->id, [&](const mcap::LoggedMessage& message) {
    obstacles.push_back(layer(Decoder(ros2::markers_type()).decode(message.data)["markers"], "obstacles").size());
    return true;
  });
  EXPECT_EQ(obstacles, (std::vector<std::size_t>{3, 3, 2, 2}));
}

TEST(Bag, AMapIsThereOnceAndAgainWhenItHasMoved) {
  const test::TemporaryDirectory directory;
  Setting setting = test::sample_setting();
  setting.obstacles.emplace_back(sample_map("3*#8.#"));
  {
    Recorder recorder(directory.file("a.mcap"), test::sample_provenance());
    for (std::uint64_t t = 0; t < 6; ++t) {
      if (t == 3) std::get<world::FloorMap>(setting.obstacles.back()).origin.x += 1.0;
      const Frame frame = test::sample_frame(5, 3.0, t);
      recorder.frame(setting, frame, test::sample_tick(frame));
    }
    recorder.finish(test::sample_run(6));
  }
  Recording recording(directory.file("a.mcap"));
  EXPECT_EQ(recording.setting_at(9.0).obstacles, setting.obstacles) << "the cells, too";
  (void)export_bag(recording, directory.file("bag.mcap"));
  for (const char* file : {"a.mcap", "bag.mcap"}) {
    mcap::Reader reader(directory.file(file));
    std::vector<double> x;
    reader.messages(reader.find_channel("/map")->id, [&](const mcap::LoggedMessage& message) {
      x.push_back(Decoder(ros2::map_type()).decode(message.data)["info"]["origin"]["position"]["x"]);
      return true;
    });
    EXPECT_EQ(x, (std::vector<double>{-1.0, 0.0})) << file;
  }
}

TEST(Bag, IsMadeOfARecordingThatWasCutShort) {
  const test::TemporaryDirectory directory;
  {
    Recorder unfinished(directory.file("a.mcap"), test::sample_provenance());
    for (std::uint64_t t = 0; t < 12; ++t) {
      const Frame frame = test::sample_frame(9, 3.0, t);
      unfinished.frame(test::sample_setting(), frame, test::sample_tick(frame));
    }
  }
  Recording recording(directory.file("a.mcap.part"));
  (void)export_bag(recording, directory.file("bag.mcap"));
  mcap::Reader bag(directory.file("bag.mcap"));
  EXPECT_TRUE(bag.indexed());
  EXPECT_EQ(count(bag, "/tf"), 12U);
}

TEST(Bag, AFullDiskIsAnError) {
  const test::TemporaryDirectory directory;
  test::record_sample(directory.file("a.mcap"), 45, 40);
  Recording recording(directory.file("a.mcap"));
  EXPECT_THROW((void)export_bag(recording, "/dev/full"), FileError);
}

}  // namespace
}  // namespace banyan::record
