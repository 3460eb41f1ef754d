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
  EXPECT_EQ(lines->at(1).robot, 12U);
  EXPECT_EQ(lines->at(1).pose, (TrackedPose{{-0.125, 0.3}, -3.14}));
}

TEST(PoseLines, AreWrittenAsTheyAreRead) {
  const PoseLine line{12, {{-1e-7, 0.1 + 0.2}, -3.14}};
  const auto again = parse_poses(pose_line(line) + pose_line({0, {}}));
  ASSERT_TRUE(again);
  ASSERT_EQ(again->size(), 2U);
  EXPECT_EQ(again->at(0).robot, 12U);
  EXPECT_EQ(again->at(0).pose, line.pose);
}

TEST(PoseLines, OneThatIsWrongSpoilsAll) {
  for (const char* wrong :
       {"0 1 2 3", "0 1 2\n", "0 1 2 3 4\n", "-1 1 2 3\n", "0 nan 2 3\n", "0 1 inf 3\n", "0 1 2 1e9\n", "0 1e9 2 3\n",
        "x\n", "\n", "0  1 2 3\n", "0 1 2 3\r\n", "0,1,2,3\n", "0 1 2 3\n0 1 2\n"})
    EXPECT_FALSE(parse_poses(wrong)) << wrong;
  EXPECT_TRUE(parse_poses(""));
}

TEST(PoseStream, KeepsTheLastPoseOfEach) {
  PoseStream stream(parse_address("127.0.0.1:0"), 2);
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
  PoseStream again(parse_address("127.0.0.1:0"), 2);
  again.restore(stream.lines());
  EXPECT_EQ(again.poses()[1], stream.poses()[1]);
  EXPECT_EQ(again.lines(), "0 0 0 0\n1 2.5 3 0.5\n");
  EXPECT_TRUE(stream.missing().empty());
}

}  // namespace
}  // namespace banyan::udp
