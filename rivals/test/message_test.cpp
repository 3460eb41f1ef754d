// SPDX-License-Identifier: MIT
// What rivals say survives the way as bytes, and nothing else is accepted.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "banyan/rivals/fiedler/fiedler.hpp"
#include "banyan/rivals/link_consensus/link_consensus.hpp"
#include "banyan/rivals/mst/mst.hpp"
#include "over_the_wire.hpp"

namespace banyan::rivals {
namespace {

std::uint16_t word() { return *rc::gen::arbitrary<std::uint16_t>(); }
std::uint8_t byte() { return *rc::gen::arbitrary<std::uint8_t>(); }
RobotId sender() { return *rc::gen::inRange<std::uint16_t>(0, nobody); }

// Listed by hand: a field that visit_fields() forgot does not survive.
void fill(link_consensus::Message& m) {
  m.id = sender();
  m.root = word();
  m.beat = word();
  m.way = word();
  m.parent = word();
  for (RobotId& link : m.links) link = word();
  m.bid = {word(), word(), word(), byte(), byte(), byte()};
  m.agrees = *rc::gen::arbitrary<bool>();
}

void fill(mst::Message& m) {
  m.id = sender();
  m.epoch = word();
  m.next = word();
  m.countdown = byte();
  m.level = byte();
  m.fragment = word();
  m.up = word();
  for (bool* flag : {&m.ready, &m.decided, &m.done}) *flag = *rc::gen::arbitrary<bool>();
  m.best = {word(), word(), word()};
  m.choice = {word(), word(), word()};
  m.root = word();
  for (RobotId& branch : m.branches) branch = word();
}

void fill(fiedler::Message& m) {
  m.id = sender();
  for (float* real : {&m.component, &m.mean.value, &m.mean.integral, &m.square.value, &m.square.integral, &m.product.value, &m.product.integral, &m.lambda})
    *real = fiedler::largest_real * (static_cast<float>(word()) / 32767.5F - 1.0F);
  m.links = byte();
  m.largest_degree = word();
  m.degree_age = byte();
  m.root = word();
  m.root_age = byte();
}

template <class Message>
class Said : public testing::Test {};
using Messages = testing::Types<link_consensus::Message, mst::Message, fiedler::Message>;
TYPED_TEST_SUITE(Said, Messages, );

TYPED_TEST(Said, SurvivesTheWay) {
  const bool holds = rc::check([] {
    TypeParam m;
    fill(m);
    const std::optional<TypeParam> back = over_the_wire(m);
    RC_ASSERT(back.has_value());
    RC_ASSERT(*back == m);
  });
  EXPECT_TRUE(holds);
}

TYPED_TEST(Said, FitsIntoAPacket) { EXPECT_LE(wire_size<TypeParam>(), largest_wire); }

// Any bytes: refused, or such that writing them again gives the same.
TYPED_TEST(Said, AnyOtherBytesAreRefused) {
  const bool holds = rc::check([] {
    TypeParam m;
    fill(m);
    auto bytes = encoded(m);
    const auto at = *rc::gen::inRange<std::size_t>(0, bytes.size());
    bytes[at] = byte();
    if (const auto back = decode_fields<TypeParam>(bytes)) RC_ASSERT(encoded(*back) == bytes);
    RC_ASSERT(!decode_fields<TypeParam>(std::span(bytes).first(*rc::gen::inRange<std::size_t>(0, bytes.size()))).has_value());
    std::vector<std::uint8_t> longer(bytes.begin(), bytes.end());
    longer.push_back(0);
    RC_ASSERT(!decode_fields<TypeParam>(longer).has_value());
    bytes = encoded(m);
    bytes[0] ^= *rc::gen::element<std::uint8_t>(1, 2, 16, 128);
    RC_ASSERT(!decode_fields<TypeParam>(bytes).has_value());
  });
  EXPECT_TRUE(holds);
}

template <class Message>
struct RobotsOf;
template <>
struct RobotsOf<link_consensus::Message> : link_consensus::Robots {};
template <>
struct RobotsOf<mst::Message> : mst::Robots {};
template <>
struct RobotsOf<fiedler::Message> : fiedler::Robots {};

// What passes the decoder may still be nonsense: three robots that say anything, of one another and of whom nobody knows.
TYPED_TEST(Said, AnythingIsSurvived) {
  using Robots = RobotsOf<TypeParam>;
  const bool holds = rc::check([] {
    const typename Robots::Params params{};
    typename Robots::State state = Robots::initial(3, *rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>());
    for (int tick = 0; tick < 20; ++tick) {
      std::array<TypeParam, 3> messages;
      std::vector<typename Robots::Heard> heard;
      for (TypeParam& m : messages) {
        fill(m);
        m.id = *rc::gen::inRange<RobotId>(0, 6);
        heard.push_back({&m, {0.01F * static_cast<float>(byte()), 0.01F * static_cast<float>(byte()) - 1.0F}});
      }
      const auto output = Robots::step(params, state, heard, {});
      RC_ASSERT(std::isfinite(output.velocity.forward_m_s) && std::isfinite(output.velocity.turn_rad_s));
      RC_ASSERT(std::abs(output.velocity.forward_m_s) <= params.wheel_limit_m_s);
      RC_ASSERT(over_the_wire(output.message).has_value());
    }
  });
  EXPECT_TRUE(holds);
}

TEST(Document, SaysHowLongMessagesAre) {
  std::ifstream in(BANYAN_SOURCE_DIR "/docs/rivals.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  std::smatch match;
  ASSERT_TRUE(std::regex_search(page, match, std::regex("link consensus has (\\d+) bytes, one of mst (\\d+), one of fiedler (\\d+)")));
  EXPECT_EQ(std::stoul(match[1]), wire_size<link_consensus::Message>());
  EXPECT_EQ(std::stoul(match[2]), wire_size<mst::Message>());
  EXPECT_EQ(std::stoul(match[3]), wire_size<fiedler::Message>());
}

TYPED_TEST(Said, NobodyIsNoSender) { EXPECT_FALSE(over_the_wire(TypeParam{}).has_value()); }

}  // namespace
}  // namespace banyan::rivals
