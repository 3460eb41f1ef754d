// SPDX-License-Identifier: MIT
// The relay between real sockets; impairment_test.cpp has what it does to datagrams.
#include "banyan/hosts/udp/relay.hpp"

#include <gtest/gtest.h>

#include <array>

namespace banyan::udp {
namespace {

const Address any_port = parse_address("127.0.0.1:0");

TEST(Relay, HandsOnAndBack) {
  const Socket robot(any_port), other(any_port), hub(any_port), stranger(any_port);
  Relay relay(any_port, hub.local(), {}, 1, 1.0);
  robot.send(Bytes{1}, relay.local());
  other.send(Bytes{2}, relay.local());
  relay.pump(0.02);
  std::array<std::uint8_t, 10> room;
  std::array<Address, 3> from;
  for (std::size_t k = 1; k <= 2; ++k) {
    const auto datagram = hub.receive(room, from[k]);
    ASSERT_TRUE(datagram);
    hub.send(Bytes{static_cast<std::uint8_t>(10 * (*datagram)[0])}, from[k]);
  }
  EXPECT_FALSE(from[1] == from[2]);   // the hub knows them apart
  stranger.send(Bytes{99}, from[1]);  // only the hub may answer
  relay.pump(0.02);
  Address ignored;
  const auto first = robot.receive(room, ignored);
  ASSERT_TRUE(first);
  EXPECT_EQ((*first)[0], 10);
  EXPECT_FALSE(robot.receive(room, ignored));
  const auto second = other.receive(room, ignored);
  ASSERT_TRUE(second);
  EXPECT_EQ((*second)[0], 20);
  EXPECT_EQ(relay.taken(), 5U - 1U);
  EXPECT_EQ(relay.handed_on(), 4U);
}

// A line that is fed faster than it carries does not grow without end.
TEST(Relay, LosesWhatDoesNotFitIntoTheLine) {
  const Socket robot(any_port), hub(any_port);
  Relay relay(any_port, hub.local(), {.delay_s = 1000.0}, 1, 1.0);
  for (std::size_t k = 0; k < most_under_way + 500; ++k) {
    robot.send(Bytes{1}, relay.local());
    if (k % 50 == 49) relay.pump(0.0);
  }
  relay.pump(0.0);
  EXPECT_EQ(relay.taken(), most_under_way + 500);
  EXPECT_EQ(relay.under_way(), most_under_way);
}

}  // namespace
}  // namespace banyan::udp
