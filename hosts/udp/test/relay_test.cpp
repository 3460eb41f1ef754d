// SPDX-License-Identifier: MIT
// The bad radio, between real sockets.
#include "banyan/hosts/udp/relay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace banyan::udp {
namespace {

const Address any_port = parse_address("127.0.0.1:0");

// Numbered datagrams from a robot to the hub; when each arrived, s of the wall, in the order of arrival.
struct Arrival {
  std::size_t number = 0;
  double after_s = 0.0;
};
std::vector<Arrival> sent_through(const Impairment& hop, std::size_t count, double wait_s, std::size_t bytes = 40, double speed = 1.0) {
  const Socket robot(any_port), hub(any_port);
  Relay relay(any_port, hub.local(), hop, 5, speed);
  const Clock clock;
  std::vector<Arrival> arrivals;
  std::vector<double> sent_s;
  const auto collect = [&] {
    std::array<std::uint8_t, 2000> room;
    Address from;
    while (const auto datagram = hub.receive(room, from)) {
      const std::size_t number = DatagramReader(*datagram).take<std::uint32_t>();
      arrivals.push_back({number, clock.now_s() - sent_s[number]});
    }
  };
  for (std::size_t k = 0; k < count; ++k) {
    Bytes datagram;
    DatagramWriter(datagram).put(static_cast<std::uint32_t>(k));
    datagram.resize(bytes);
    sent_s.push_back(clock.now_s());
    robot.send(datagram, relay.local());
    if (k % 20 == 19) relay.pump(0.001);
    collect();
  }
  while (clock.now_s() < sent_s.back() + wait_s) {
    relay.pump(0.001);
    collect();
  }
  return arrivals;
}

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
  EXPECT_FALSE(from[1] == from[2]);  // the hub knows them apart
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

TEST(Relay, LosesAndDoublesAsManyAsItShould) {
  constexpr std::size_t count = 4000;
  const auto lost = sent_through({.loss = 0.3}, count, 0.05);
  EXPECT_NEAR(static_cast<double>(lost.size()), 0.7 * count, 5.0 * std::sqrt(0.3 * 0.7 * count));
  const auto doubled = sent_through({.duplicate = 0.2}, count, 0.05);
  EXPECT_NEAR(static_cast<double>(doubled.size()), 1.2 * count, 5.0 * std::sqrt(0.2 * 0.8 * count));
}

TEST(Relay, DelaysAndReorders) {
  const auto still = sent_through({.delay_s = 0.03}, 100, 0.2);
  ASSERT_EQ(still.size(), 100U);
  for (std::size_t k = 0; k < still.size(); ++k) {
    EXPECT_GE(still[k].after_s, 0.03);
    EXPECT_EQ(still[k].number, k);  // the order stays
  }
  const auto jittered = sent_through({.delay_s = 0.03, .jitter_s = 0.02}, 200, 0.2);
  ASSERT_EQ(jittered.size(), 200U);
  const auto by_time = [](const Arrival& a, const Arrival& b) { return a.after_s < b.after_s; };
  EXPECT_GE(std::ranges::min_element(jittered, by_time)->after_s, 0.01);
  EXPECT_FALSE(std::ranges::is_sorted(jittered, {}, &Arrival::number));
  const auto overtaken = sent_through({.delay_s = 0.05, .reorder = 0.5}, 100, 0.2);
  EXPECT_EQ(overtaken.size(), 100U);
  EXPECT_FALSE(std::ranges::is_sorted(overtaken, {}, &Arrival::number));
  // In a clock that is ten times as fast.
  const auto fast = sent_through({.delay_s = 0.5}, 10, 0.2, 40, 10.0);
  ASSERT_EQ(fast.size(), 10U);
  EXPECT_GE(fast[0].after_s, 0.05);
}

TEST(Relay, LimitsTheRate) {
  // 20 datagrams of 500 bytes at 100 kB/s take 0.1 s.
  const auto arrivals = sent_through({.rate_bytes_s = 1e5}, 20, 0.3, 500);
  ASSERT_EQ(arrivals.size(), 20U);
  EXPECT_GE(arrivals.back().after_s, 0.095);
}

TEST(Relay, TwoHopsMakeTheWay) {
  const Impairment hop = per_hop({.loss = 0.3, .delay_s = 0.02, .jitter_s = 0.01, .duplicate = 0.1, .reorder = 0.0, .rate_bytes_s = 7.0});
  EXPECT_NEAR((1.0 - hop.loss) * (1.0 - hop.loss), 0.7, 1e-12);
  EXPECT_NEAR((1.0 - hop.duplicate) * (1.0 - hop.duplicate), 0.9, 1e-12);
  EXPECT_EQ(hop.delay_s, 0.01);
  EXPECT_EQ(hop.jitter_s, 0.005);
  EXPECT_EQ(hop.rate_bytes_s, 7.0);
}

}  // namespace
}  // namespace banyan::udp
