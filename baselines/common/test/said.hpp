// SPDX-License-Identifier: MIT
// What a baseline says survives the way as bytes, and nothing else is accepted. Each instantiates Said with its Robots
// (core/swarm_of.hpp) and
//   fill(message)           draws every field. Listed by hand: one that visit_fields() forgot does not survive
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "over_the_wire.hpp"
#include "test_platform.hpp"

namespace banyan::baselines {

inline std::uint16_t word() { return *rc::gen::arbitrary<std::uint16_t>(); }
inline std::uint8_t byte() { return *rc::gen::arbitrary<std::uint8_t>(); }
inline RobotId robot() { return *rc::gen::arbitrary<RobotId>(); }
inline RobotId sender() { return *rc::gen::inRange<RobotId>(0, nobody); }

template <class Robots> class Said : public testing::Test {
 public:
  using Message = typename Robots::Message;
  static Message drawn() {
    Message m;
    Robots::fill(m);
    return m;
  }
};
TYPED_TEST_SUITE_P(Said);

TYPED_TEST_P(Said, SurvivesTheWay) {
  const bool holds = rc::check([] {
    const auto m = TestFixture::drawn();
    const auto back = over_the_wire(m);
    RC_ASSERT(back.has_value());
    RC_ASSERT(*back == m);
  });
  EXPECT_TRUE(holds);
}

TYPED_TEST_P(Said, FitsIntoAPacket) { EXPECT_LE(wire_size<typename TypeParam::Message>(), largest_wire); }

// Any bytes: refused, or such that writing them again gives the same.
TYPED_TEST_P(Said, AnyOtherBytesAreRefused) {
  using Message = typename TypeParam::Message;
  const bool holds = rc::check([] {
    const Message m = TestFixture::drawn();
    auto bytes = encoded(m);
    const auto at = *rc::gen::inRange<std::size_t>(0, bytes.size());
    bytes[at] = byte();
    if (const auto back = decode_fields<Message>(bytes)) RC_ASSERT(encoded(*back) == bytes);
    const auto shorter = std::span(bytes).first(*rc::gen::inRange<std::size_t>(0, bytes.size()));
    RC_ASSERT(!decode_fields<Message>(shorter).has_value());
    std::vector<std::uint8_t> longer(bytes.begin(), bytes.end());
    longer.push_back(0);
    RC_ASSERT(!decode_fields<Message>(longer).has_value());
    bytes = encoded(m);
    bytes[0] ^= *rc::gen::element<std::uint8_t>(1, 2, 16, 128);
    RC_ASSERT(!decode_fields<Message>(bytes).has_value());
  });
  EXPECT_TRUE(holds);
}

// What passes the decoder may still be nonsense: three robots that say anything, of one another and of whom nobody
// knows.
TYPED_TEST_P(Said, AnythingIsSurvived) {
  const bool holds = rc::check([] {
    const typename TypeParam::Params params{};
    typename TypeParam::State state = TypeParam::initial(3, *rc::gen::arbitrary<bool>(), *rc::gen::arbitrary<bool>());
    for (int tick = 0; tick < 20; ++tick) {
      std::array<typename TypeParam::Message, 3> messages;
      std::vector<typename TypeParam::Heard> heard;
      for (auto& m : messages) {
        m = TestFixture::drawn();
        m.id = *rc::gen::inRange<RobotId>(0, 6);
        heard.push_back({&m, {0.005F * static_cast<float>(byte()), 0.005F * static_cast<float>(byte()) - 0.5F}});
      }
      const auto output = TypeParam::step(params, state, {heard, {}, test_platform});
      RC_ASSERT(std::isfinite(output.motion.forward) && std::isfinite(output.motion.turn));
      RC_ASSERT(std::abs(output.motion.forward) <= 1.0F);
      RC_ASSERT(over_the_wire(output.message).has_value());
    }
  });
  EXPECT_TRUE(holds);
}

TYPED_TEST_P(Said, NobodyIsNoSender) { EXPECT_FALSE(over_the_wire(typename TypeParam::Message{}).has_value()); }

REGISTER_TYPED_TEST_SUITE_P(Said, SurvivesTheWay, FitsIntoAPacket, AnyOtherBytesAreRefused, AnythingIsSurvived,
                            NobodyIsNoSender);

}  // namespace banyan::baselines
