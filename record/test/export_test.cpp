// SPDX-License-Identifier: MIT
// The exported CSV against the frames that went in.
#include "banyan/record/export.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "sample.hpp"

namespace banyan::record {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) c == ',' ? (void)fields.emplace_back() : fields.back().push_back(c);
  return fields;
}

std::string index_text(std::int32_t index) { return index < 0 ? "" : std::to_string(index); }

TEST(Export, EveryRowIsARobotAtATick) {
  const test::TemporaryDirectory directory;
  test::record_sample(directory.file("a.mcap"), 45, 40);
  Recording recording(directory.file("a.mcap"));
  EXPECT_EQ(export_csv(recording, directory.file("a.csv")), 45U * 40U);
  std::ifstream file(directory.file("a.csv"));
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "tick,time_s,robot,x_m,y_m,heading_rad,role,phase,parent,old_parent,alive,connected,target");
  for (std::uint64_t t = 0; t < 40; ++t) {
    const Frame frame = test::sample_frame(45, 3.0, t);
    for (std::size_t i = 0; i < 45; ++i) {
      ASSERT_TRUE(std::getline(file, line));
      const auto f = split(line);
      const RobotFrame& robot = frame.robots[i];
      ASSERT_EQ(f.size(), 13U);
      EXPECT_EQ(f[0], std::to_string(t));
      EXPECT_NEAR(std::stod(f[1]), frame.time_s, 1e-9);
      EXPECT_EQ(f[2], std::to_string(i));
      EXPECT_NEAR(std::stod(f[3]), robot.position.x, 0.51e-4);
      EXPECT_NEAR(std::stod(f[4]), robot.position.y, 0.51e-4);
      EXPECT_NEAR(std::stod(f[5]), robot.heading_rad, 0.51e-4);
      EXPECT_EQ(f[6], name_of(robot.role));
      EXPECT_EQ(f[7], name_of(robot.phase));
      EXPECT_EQ(f[8], index_text(robot.parent));
      EXPECT_EQ(f[9], index_text(robot.old_parent));
      EXPECT_EQ(f[10], robot.alive ? "1" : "0");
      EXPECT_EQ(f[11], robot.connected ? "1" : "0");
      EXPECT_EQ(f[12], index_text(robot.target));
    }
  }
  EXPECT_FALSE(std::getline(file, line));
}

TEST(Export, RangeAndStep) {
  const test::TemporaryDirectory directory;
  test::record_sample(directory.file("a.mcap"), 3, 40);
  Recording recording(directory.file("a.mcap"));
  std::string all;
  ExportOptions options;
  options.from_s = 1.0;
  options.to_s = 2.0;
  options.every = 5;
  EXPECT_EQ(export_csv(
                recording, [&](std::string_view piece) { all += piece; }, options),
            9U);
  EXPECT_NE(all.find("\n15,1.5000,0,"), std::string::npos);
  EXPECT_EQ(all.find("\n16,"), std::string::npos);
}

TEST(Export, AFullDiskIsAnErrorAndNothingIsReplaced) {
  const test::TemporaryDirectory directory;
  test::record_sample(directory.file("a.mcap"), 45, 40);
  Recording recording(directory.file("a.mcap"));
  EXPECT_THROW(export_csv(recording, "/dev/full"), FileError);
  write_file(directory.file("a.csv"), "mine");
  EXPECT_THROW(export_csv(recording, directory.file("a.csv")), FileError);
}

}  // namespace
}  // namespace banyan::record
