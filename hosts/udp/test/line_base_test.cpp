// SPDX-License-Identifier: MIT
#include "banyan/hosts/udp/line_base.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace banyan::udp {
namespace {

TEST(BaseLine, PoseAndPoints) {
  const auto pose = parse_base_line("pose 1.5 -0.25 0.5");
  ASSERT_TRUE(pose && std::holds_alternative<OdometricPose>(*pose));
  EXPECT_EQ(std::get<OdometricPose>(*pose).position, (Vec2{1.5F, -0.25F}));
  EXPECT_NEAR(std::get<OdometricPose>(*pose).turn_rad, 0.5F, 1e-6F);
  const auto turned = parse_base_line("pose 0 0 12.566371\r");  // two whole turns
  ASSERT_TRUE(turned);
  EXPECT_NEAR(std::get<OdometricPose>(*turned).turn_rad, 0.0F, 1e-4F);
  const auto seen = parse_base_line("seen 0.1 0.2 -0.3 1e-1");
  ASSERT_TRUE(seen && std::holds_alternative<Seen>(*seen));
  EXPECT_EQ(std::get<Seen>(*seen).points, (std::vector<Vec2>{{0.1F, 0.2F}, {-0.3F, 0.1F}}));
  EXPECT_TRUE(parse_base_line("seen"));
}

TEST(BaseLine, NeighboursAndTarget) {
  const auto near = parse_base_line("near 3 1.5 0 12 0.5 1.5707963");
  ASSERT_TRUE(near && std::holds_alternative<Near>(*near));
  const auto& robots = std::get<Near>(*near).robots;
  ASSERT_EQ(robots.size(), 2U);
  EXPECT_EQ(robots[0].id, 3);
  EXPECT_EQ(robots[0].position, (Vec2{1.5F, 0.0F}));
  EXPECT_EQ(robots[1].id, 12);
  EXPECT_NEAR(robots[1].position.x, 0.0F, 1e-6F);
  EXPECT_NEAR(robots[1].position.y, 0.5F, 1e-6F);
  EXPECT_EQ(*std::get<Sought>(*parse_base_line("target 2 -1")).target, (Vec2{2.0F, -1.0F}));
  EXPECT_FALSE(std::get<Sought>(*parse_base_line("target")).target);
}

TEST(BaseLine, WhatIsNoneIsRefused) {
  // clang-format off
  for (const char* line : {"", "pose", "pose 1 2", "pose 1 2 3 4", "pose 1 2 x", "pose 1 2 nan", "pose 1 2 inf",
      "pose 1 2 1e9",
                           "pose  1 2 3", "seen 1", "seen 1 2 3", "drive 0 0 0", "Pose 1 2 3", "pose 1 2 3f",
                               "seen 1,2", "near",
                           "near 1 2", "near 0.5 1 0", "near -1 1 0", "near 65535 1 0", "near 1 -1 0", "near 1 1 1e9",
                               "target 1",
                           "target 1 2 3", "target nan 0"})
    // clang-format on
    EXPECT_FALSE(parse_base_line(line)) << line;
  std::string many = "seen";
  for (std::size_t k = 0; k < 4096; ++k) many += " 1 2";
  EXPECT_TRUE(parse_base_line(many));
  EXPECT_FALSE(parse_base_line(many + " 1 2"));
}

TEST(BaseLine, Drive) { EXPECT_EQ(drive_line({0.2F, 0.0F, -1.25F}), "drive 0.2000 0.0000 -1.2500\n"); }

TEST(BaseLine, TheBasesSide) {
  const auto velocity = parse_drive_line("drive 0.2 -1e-1 -1.25\r");
  ASSERT_TRUE(velocity);
  EXPECT_FLOAT_EQ(velocity->forward_m_s, 0.2F);
  EXPECT_FLOAT_EQ(velocity->sideways_m_s, -0.1F);
  EXPECT_FLOAT_EQ(velocity->turn_rad_s, -1.25F);
  for (const char* line :
       {"", "drive", "drive 1 2", "drive 1 2 3 4", "drive 1 2 inf", "Drive 1 2 3", "pose 1 2 3", "drive 1  2"})
    EXPECT_FALSE(parse_drive_line(line)) << line;
  EXPECT_EQ(base_pose_line({{1.5F, -0.25F}, 0.5F}), "pose 1.5000 -0.2500 0.5000\n");
}

class WiredBase : public ::testing::Test {
 protected:
  void SetUp() override {
    std::array<int, 2> ends{};
    ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends.data()), 0);
    base_ = std::make_unique<LineBase>(ends[0]);
    wire_ = ends[1];
  }
  void TearDown() override {
    if (wire_ >= 0) ::close(wire_);
  }
  void say(const std::string& text) const {
    ASSERT_EQ(::write(wire_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  std::unique_ptr<LineBase> base_;
  int wire_ = -1;
};

TEST_F(WiredBase, LinesComeInPieces) {
  say("pose 1 0 0\npo");
  base_->listen(1.0);
  EXPECT_EQ(base_->pose_at(1.0)->position.x, 1.0F);
  say("se 2 0 0\nnonsense\nseen 0.5 0\n");
  base_->listen(2.0);
  EXPECT_EQ(base_->pose_at(2.0)->position.x, 2.0F);
  EXPECT_EQ(base_->pose_at(1.5)->position.x, 1.0F);  // as it was then
  EXPECT_EQ(base_->obstacles().size(), 1U);
  say(std::string(10000, 'x'));
  base_->listen(2.1);
  say("\npose 3 0 0\n");
  base_->listen(2.2);
  EXPECT_EQ(base_->pose_at(2.2)->position.x, 3.0F);
}

TEST_F(WiredBase, KnowsWhenItMeasured) {
  EXPECT_FALSE(base_->last_pose_s());
  say("near 1 2 0 2 1 0\ntarget 5 0\npose 0 0 0\n");
  base_->listen(1.0);
  say("near 2 0.5 0\n");
  base_->listen(2.0);
  EXPECT_EQ(base_->neighbour(1)->s, 1.0);
  EXPECT_EQ(base_->neighbour(2)->s, 2.0);
  EXPECT_EQ(base_->neighbour(2)->position.x, 0.5F);
  EXPECT_FALSE(base_->neighbour(3));
  EXPECT_EQ(base_->last_pose_s(), 1.0);
  EXPECT_EQ(base_->target()->position.x, 5.0F);
  say("target\n");
  base_->listen(3.0);
  EXPECT_FALSE(base_->target());
}

TEST_F(WiredBase, DrivesAndIsLost) {
  base_->drive({0.1F, 0.0F, 0.0F});
  std::array<char, 64> room{};
  const ssize_t size = ::read(wire_, room.data(), room.size());
  ASSERT_GT(size, 0);
  EXPECT_EQ(std::string(room.data(), static_cast<std::size_t>(size)), "drive 0.1000 0.0000 0.0000\n");
  base_->listen(0.0);
  EXPECT_FALSE(base_->lost());
  ::close(std::exchange(wire_, -1));
  base_->listen(0.1);
  EXPECT_TRUE(base_->lost());
}

// A terminal, and the path of its other end: what a robot's program sees of a serial device.
struct Terminal {
  int here = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
  std::string path;
  Terminal() {
    std::array<char, 128> name{};
    if (here >= 0 && ::grantpt(here) == 0 && ::unlockpt(here) == 0 && ::ptsname_r(here, name.data(), name.size()) == 0)
      path = name.data();
  }
  ~Terminal() {
    if (here >= 0) ::close(here);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
};

TEST(OpenLineBase, SetsASerialDeviceAndSpeaksOverIt) {
  Terminal terminal;
  ASSERT_FALSE(terminal.path.empty());
  termios settings{};
  ASSERT_EQ(::tcgetattr(terminal.here, &settings), 0);
  settings.c_cflag |= CSTOPB | CRTSCTS;
  settings.c_lflag |= ICANON | ECHO;
  settings.c_oflag |= OPOST | ONLCR;
  ASSERT_EQ(::cfsetspeed(&settings, B9600), 0);
  ASSERT_EQ(::tcsetattr(terminal.here, TCSANOW, &settings), 0);

  const std::unique_ptr<Driver> base = open_line_base(terminal.path);
  ASSERT_EQ(::tcgetattr(terminal.here, &settings), 0);
  EXPECT_EQ(::cfgetispeed(&settings), static_cast<speed_t>(B115200));
  EXPECT_EQ(::cfgetospeed(&settings), static_cast<speed_t>(B115200));
  EXPECT_EQ(settings.c_cflag & (CSIZE | PARENB | CSTOPB | CRTSCTS), static_cast<tcflag_t>(CS8));

  const std::string_view said =
      "pose 1.5 0 0\r\n\x03\x04\x13pose 2 0 0\n";  // a terminal would take the odd ones as orders
  ASSERT_EQ(::write(terminal.here, said.data(), said.size()), static_cast<ssize_t>(said.size()));
  base->listen(1.0);
  EXPECT_EQ(base->pose_at(1.0)->position.x, 1.5F) << "the second line is none";
  base->drive({0.1F, 0.0F, -0.5F});
  std::array<char, 128> room{};
  const ssize_t size = ::read(terminal.here, room.data(), room.size());
  ASSERT_GT(size, 0);
  EXPECT_EQ(std::string(room.data(), static_cast<std::size_t>(size)), "drive 0.1000 0.0000 -0.5000\n")
      << "no echo, no other ends of lines";

  EXPECT_FALSE(base->lost());
  ::close(std::exchange(terminal.here, -1));
  base->listen(2.0);
  EXPECT_TRUE(base->lost()) << "unplugged";
}

TEST(OpenLineBase, SaysWhatIsWrong) {
  EXPECT_THROW(static_cast<void>(open_line_base("/no/such/device")), BaseError);
  EXPECT_THROW(static_cast<void>(open_line_base("/dev/null")), BaseError);
  EXPECT_THROW(static_cast<void>(open_line_base("tcp:nowhere")), BaseError);
  EXPECT_THROW(static_cast<void>(open_line_base("tcp:127.0.0.1:1")), BaseError);
}

}  // namespace
}  // namespace banyan::udp
