// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/pose_stream.hpp"

#include <gtest/gtest.h>

#include <string>

namespace banyan::udp {
namespace {

TEST(PoseLines, AreReadAsTheyAreWritten) {
  const auto lines = parse_poses("0 1.5 -2 0.25\n12 -0.125 3e-1 -3.14\n");
  ASSERT_TRUE(lines);
  ASSERT_EQ(lines->size(), 2U);
  EXPECT_EQ(lines->at(0).pose, (TrackedPose{{1.5, -2.0}, 0.25}));
  EXPECT_EQ(lines->at(1).robot, "12");
  EXPECT_EQ(lines->at(1).pose, (TrackedPose{{-0.125, 0.3}, -3.14}));
  EXPECT_EQ(parse_poses("cf_3 0 0 0\n")->at(0).robot, "cf_3");
}

TEST(PoseLines, AreWrittenAsTheyAreRead) {
  const PoseLine line{12, {{-1e-7, 0.1 + 0.2}, -3.14}};
  const auto again = parse_poses(pose_line(line) + pose_line({0, {}}));
  ASSERT_TRUE(again);
  ASSERT_EQ(again->size(), 2U);
  EXPECT_EQ(again->at(0).robot, "12");
  EXPECT_EQ(again->at(0).pose, line.pose);
}

TEST(PoseLines, OneThatIsWrongSpoilsAll) {
  for (const char* wrong :
       {"0 1 2 3", "0 1 2\n", "0 1 2 3 4\n", "0 nan 2 3\n", "0 1 inf 3\n", "0 1 2 1e9\n", "0 1e9 2 3\n", "x\n", "\n",
        "0  1 2 3\n", "0 1 2 3\r\n", "0,1,2,3\n", " 1 2 3\n", "a\tb 1 2 3\n", "0 1 2 3\n0 1 2\n"})
    EXPECT_FALSE(parse_poses(wrong)) << wrong;
  EXPECT_TRUE(parse_poses(""));
}

TEST(PoseStream, KeepsTheLastPoseOfEach) {
  const Roster two(2);
  PoseStream stream(parse_address("127.0.0.1:0"), two);
  const Socket tracker(parse_address("127.0.0.1:0"));
  const auto say = [&](const std::string& text) {
    tracker.send({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, stream.local());
    stream.listen();
  };
  EXPECT_EQ(stream.missing(), (std::vector<std::size_t>{0, 1}));
  EXPECT_GT(stream.silence_s(), 1e6);
  say("1 2 3 0.5\n7 0 0 0\n");
  EXPECT_EQ(stream.missing(), (std::vector<std::size_t>{0}));
  EXPECT_LT(stream.silence_s(), 10.0);
  say("1 2.5 3 0.5\n0 0 0 0\n");
  EXPECT_EQ(stream.poses()[1], (TrackedPose{{2.5, 3.0}, 0.5}));
  say("1 9 9 9\nnonsense\n");
  EXPECT_EQ(stream.poses()[1], (TrackedPose{{2.5, 3.0}, 0.5}));
  EXPECT_EQ(stream.refused(), 1U);
  PoseStream again(parse_address("127.0.0.1:0"), two);
  again.restore(stream.lines());
  EXPECT_EQ(again.poses()[1], stream.poses()[1]);
  EXPECT_EQ(again.lines(), "0 0 0 0\n1 2.5 3 0.5\n");
  EXPECT_TRUE(stream.missing().empty());
}

TEST(PoseStream, KnowsRobotsByTheirNamesAndNamesOthersOnce) {
  Roster roster("cf_{07-08}", 1);
  PoseStream stream(parse_address("127.0.0.1:0"), roster);
  std::vector<std::string> unknown;
  stream.tell_unknown([&](const std::string& name) { unknown.push_back(name); });
  stream.restore("cf_08 1 2 3\n7 4 5 6\ncf_9 7 8 9\nwand 0 0 0\n");
  stream.restore("wand 0 0 0\n");
  EXPECT_EQ(stream.poses()[1], (TrackedPose{{1.0, 2.0}, 3.0}));
  EXPECT_EQ(stream.poses()[0], (TrackedPose{{4.0, 5.0}, 6.0}));
  EXPECT_EQ(unknown, (std::vector<std::string>{"cf_9", "wand"}));
  EXPECT_TRUE(stream.has_seen(9));
  EXPECT_FALSE(stream.has_seen(10));
  stream.welcome(roster.add(9));
  EXPECT_EQ(stream.poses()[2], (TrackedPose{{7.0, 8.0}, 9.0}));
  EXPECT_EQ(stream.lines(), "cf_07 4 5 6\ncf_08 1 2 3\ncf_09 7 8 9\n");
}

}  // namespace
}  // namespace banyan::udp
