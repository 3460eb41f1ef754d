// SPDX-License-Identifier: MIT
// The two ends of the line protocol against each other: Bases here, banyan-robot's own LineBase there.
#include "banyan/hosts/ros2/bases.hpp"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <functional>
#include <thread>

namespace banyan::ros2 {
namespace {

class BasesTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::unique_ptr<udp::Driver> robot(std::size_t place) const {
    return udp::open_line_base("tcp:127.0.0.1:" + std::to_string(bases.port(place)));
  }
  void listen(double now_s) {
    bases.listen(now_s, [this](std::size_t place, const Velocity& v) { driven.emplace_back(place, v); });
  }
  // Loopback takes a moment.
  void listen_until(double now_s, std::size_t count) {
    for (int k = 0; k < 500 && driven.size() < count; ++k) {
      listen(now_s);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    ASSERT_EQ(driven.size(), count);
  }
  Bases bases{udp::parse_address("127.0.0.1:0"), 2};
  std::vector<std::pair<std::size_t, Velocity>> driven;
};

TEST_F(BasesTest, CommandsAndPosesReachTheOtherSide) {
  const auto first = robot(0), second = robot(1);
  second->drive({0.2F, -0.1F, 1.5F});
  listen_until(1.0, 1);
  EXPECT_EQ(driven[0].first, 1U);
  EXPECT_FLOAT_EQ(driven[0].second.forward_m_s, 0.2F);
  EXPECT_FLOAT_EQ(driven[0].second.sideways_m_s, -0.1F);
  EXPECT_FLOAT_EQ(driven[0].second.turn_rad_s, 1.5F);
  bases.tell(1, {{1.25F, -3.5F}, 0.5F});
  for (int k = 0; k < 500 && !second->last_pose_s(); ++k) {
    second->listen(2.0);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  ASSERT_TRUE(second->pose_at(2.0));
  EXPECT_EQ(second->pose_at(2.0)->position, (Vec2{1.25F, -3.5F}));
  EXPECT_NEAR(second->pose_at(2.0)->turn_rad, 0.5F, 1e-4F);
  first->listen(2.0);
  EXPECT_FALSE(first->last_pose_s());
}

TEST_F(BasesTest, WhoSaysNothingStandsStillOnce) {
  const auto base = robot(0);
  base->drive({0.2F, 0.0F, 0.0F});
  listen_until(1.0, 1);
  listen(1.5);
  EXPECT_EQ(driven.size(), 1U);
  listen(1.51);
  ASSERT_EQ(driven.size(), 2U);
  EXPECT_EQ(driven[1].second.forward_m_s, 0.0F);
  listen(3.0);
  EXPECT_EQ(driven.size(), 2U);
}

TEST_F(BasesTest, WhoGoesStandsStillAtOnceAndMayComeAgain) {
  auto base = robot(0);
  base->drive({0.0F, 0.0F, 1.0F});
  listen_until(1.0, 1);
  base.reset();
  listen_until(1.01, 2);
  EXPECT_EQ(driven[1].second.turn_rad_s, 0.0F);
  base = robot(0);
  base->drive({0.1F, 0.0F, 0.0F});
  listen_until(1.1, 3);
  const auto other = robot(0);  // started again before the old wire was known to be broken
  other->drive({0.3F, 0.0F, 0.0F});
  listen_until(1.2, 4);
  EXPECT_FLOAT_EQ(driven[3].second.forward_m_s, 0.3F);
}

TEST_F(BasesTest, NonsenseDrivesNobody) {
  const int wire = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address = udp::parse_address("127.0.0.1:" + std::to_string(bases.port(0))).raw;
  ASSERT_EQ(::connect(wire, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  const std::string text =
      "drive 1 2\ndrive nan 0 0\nDRIVE 1 2 3\n" + std::string(10000, 'x') + "\npose 1 2 3\ndrive 0.5 0 0\r\n";
  ASSERT_EQ(::send(wire, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  listen_until(1.0, 1);
  EXPECT_FLOAT_EQ(driven[0].second.forward_m_s, 0.5F);
  ::close(wire);
}

TEST_F(BasesTest, APortThatIsTakenIsNamed) {
  try {
    const Bases again(udp::parse_address("127.0.0.1:" + std::to_string(bases.port(1))), 1);
    FAIL();
  } catch (const udp::SocketError& error) {
    EXPECT_NE(std::string(error.what()).find("tcp:127.0.0.1:" + std::to_string(bases.port(1))), std::string::npos);
  }
  EXPECT_THROW(Bases(udp::parse_address("127.0.0.1:65530"), 10), udp::SocketError);
}

}  // namespace
}  // namespace banyan::ros2
