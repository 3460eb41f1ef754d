// SPDX-License-Identifier: MIT
// The wire format: every message survives the way, everything else is refused.
#include "banyan/controller/core/wire.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include "banyan/controller/convoy/message.hpp"
#include "banyan/controller/core/digest.hpp"
#include "over_the_wire.hpp"

namespace banyan {
namespace {

// ---- Arbitrary messages, listed by hand: a field that visit_fields() forgot does not survive ----

std::uint16_t word() { return *rc::gen::arbitrary<std::uint16_t>(); }
bool flag() { return *rc::gen::arbitrary<bool>(); }
RobotId sender() { return *rc::gen::inRange<RobotId>(0, nobody); }
RobotId robot() { return flag() ? nobody : sender(); }
std::int16_t signed_word() { return *rc::gen::arbitrary<std::int16_t>(); }
Coordinate coordinate() { return Coordinate::of(Coordinate{signed_word()}.value()); }
std::uint8_t byte() { return *rc::gen::arbitrary<std::uint8_t>(); }

void fill(TreeMessage& m) {
  const auto length = [] { return static_cast<float>(*rc::gen::inRange(-1'000'000, 1'000'001)) * 0.001F; };
  m.id = sender();
  m.role = static_cast<Role>(*rc::gen::inRange(0, 4));
  m.phase = static_cast<Phase>(*rc::gen::inRange(0, 5));
  m.need = static_cast<Need>(*rc::gen::inRange(0, 3));
  for (bool* field : {&m.flood_done, &m.committed, &m.parent_silent}) *field = flag();
  for (std::uint16_t* field : {&m.epoch, &m.root.sequence, &m.label, &m.seqno, &m.depth, &m.want}) *field = word();
  for (RobotId* field :
       {&m.root.id, &m.parent, &m.old_parent, &m.flood_parent, &m.grant, &m.request, &m.inserted_child, &m.new_root})
    *field = robot();
  for (RobotCount* field : {&m.flood_robots, &m.flood_workers, &m.subtree, &m.subtree_workers, &m.count})
    *field = word();
  for (std::int16_t* field : {&m.pull_x, &m.pull_y}) *field = signed_word();
  for (Coordinate* field : {&m.centroid_x, &m.centroid_y}) *field = coordinate();
  m.tree_hops = byte();
  m.call_hops = byte();
  for (float* field : {&m.q_x, &m.q_y}) *field = length();
}
void fill(HealingMessage& m) {
  fill(static_cast<TreeMessage&>(m));
  m.root_told = flag();
  for (RobotId* field : {&m.serves, &m.told, &m.task_serves, &m.task_holder}) *field = robot();
  for (std::uint16_t* field : {&m.heartbeat, &m.task_beat}) *field = word();
  m.root_size = word();
  for (Coordinate* field : {&m.root_x, &m.root_y, &m.task_x, &m.task_y}) *field = coordinate();
}
void fill(ConvoyMessage& m) {
  fill(static_cast<HealingMessage&>(m));
  m.pinned = flag();
  m.hinge_x = coordinate();
  m.hinge_y = coordinate();
  m.child_count = byte();
  for (RobotId* field : {&m.below, &m.warned, &m.above, &m.task_host}) *field = robot();
}

template <class Message> Message arbitrary_message() {
  Message m;
  fill(m);
  return m;
}

template <class Message> Message of_robot(RobotId id) {
  Message m;
  m.id = id;
  return m;
}

template <class Message> class Wire : public testing::Test {};
using Messages = testing::Types<TreeMessage, HealingMessage, ConvoyMessage>;
TYPED_TEST_SUITE(Wire, Messages, );

// ---- The way ----

TYPED_TEST(Wire, EveryMessageSurvivesTheWay) {
  const bool holds = rc::check([] {
    const auto m = arbitrary_message<TypeParam>();
    const std::optional<TypeParam> back = over_the_wire(m);
    RC_ASSERT(back.has_value());
    RC_ASSERT(*back == m);
  });
  EXPECT_TRUE(holds);
}

TYPED_TEST(Wire, WhatIsWrittenIsAsLongAsItsType) {
  const bool holds = rc::check([] {
    std::vector<std::uint8_t> bytes(largest_wire + 8, 0xAA);
    const auto m = arbitrary_message<TypeParam>();
    constexpr std::size_t size = wire_size<TypeParam>();
    RC_ASSERT(encode_fields(m, bytes) == size);
    RC_ASSERT(std::all_of(bytes.begin() + static_cast<std::ptrdiff_t>(size), bytes.end(),
                          [](std::uint8_t b) { return b == 0xAA; }));
  });
  EXPECT_TRUE(holds);
}

TEST(WireSize, LiteralFitsInto64BytesTheOthersInto96) {
  EXPECT_LE(wire_size<TreeMessage>(), 64U);
  EXPECT_LE(wire_size<HealingMessage>(), 96U);
  EXPECT_LE(wire_size<ConvoyMessage>(), 96U);
  EXPECT_EQ(largest_plain_wire, 96U);
}

TYPED_TEST(Wire, ByteOrderIsLittleEndianWhateverTheMachine) {
  auto m = of_robot<TypeParam>(0x1234);
  m.epoch = 0xABCD;
  const auto bytes = encoded(m);
  EXPECT_EQ(bytes[0] & 0x07, wire_version);
  EXPECT_EQ(bytes[3], 0x34);
  EXPECT_EQ(bytes[4], 0x12);
  EXPECT_EQ(bytes[5], 0xCD);
  EXPECT_EQ(bytes[6], 0xAB);
}

// ---- Hostile bytes ----

// A second encoding gives the same bytes: no byte that is accepted goes unused.
TYPED_TEST(Wire, AcceptsNoOtherBytesThanItsOwn) {
  const bool holds = rc::check([](const std::vector<std::uint8_t>& noise) {
    auto bytes = encoded(arbitrary_message<TypeParam>());
    for (std::size_t k = 0; k < noise.size(); ++k) bytes[(k * 31 + noise[k]) % bytes.size()] ^= noise[k];
    const auto m = decode_fields<TypeParam>(bytes);
    if (m) RC_ASSERT(encoded(*m) == bytes);
  });
  EXPECT_TRUE(holds);
}

TYPED_TEST(Wire, RandomBytesOfTheRightLengthAreReadOrRefused) {
  const bool holds = rc::check([] {
    auto bytes =
        *rc::gen::container<std::vector<std::uint8_t>>(wire_size<TypeParam>(), rc::gen::arbitrary<std::uint8_t>());
    if (flag()) bytes[0] = TypeParam::blocks | wire_version;
    const auto m = decode_fields<TypeParam>(bytes);
    if (!m) return;
    RC_ASSERT(m->role <= Role::root);
    RC_ASSERT(m->phase <= Phase::select_root);
    RC_ASSERT(m->need <= Need::await);
    RC_ASSERT(std::fabs(m->q_x) <= q_limit && std::fabs(m->q_y) <= q_limit);
  });
  EXPECT_TRUE(holds);
}

TYPED_TEST(Wire, EveryOtherLengthIsRefused) {
  const auto good = encoded(of_robot<TypeParam>(7));
  // The vector holds exactly `size` bytes, so a sanitizer sees any read past the end.
  for (std::size_t size = 0; size <= 2 * good.size(); ++size) {
    std::vector<std::uint8_t> bytes(good.begin(),
                                    good.begin() + static_cast<std::ptrdiff_t>(std::min(size, good.size())));
    bytes.resize(size);
    EXPECT_EQ(decode_fields<TypeParam>(bytes).has_value(), size == good.size()) << size;
  }
}

TYPED_TEST(Wire, EveryOtherVersionAndSetOfBlocksIsRefused) {
  auto bytes = encoded(of_robot<TypeParam>(7));
  for (int header = 0; header < 256; ++header) {
    bytes[0] = static_cast<std::uint8_t>(header);
    EXPECT_EQ(decode_fields<TypeParam>(bytes).has_value(), header == (TypeParam::blocks | wire_version)) << header;
  }
}

// The last bits of the second byte are for whoever adds a block.
template <class Message> constexpr int flags_in_second_byte = 2;  // flood_done, parent_silent
template <> constexpr int flags_in_second_byte<HealingMessage> = 7;
template <> constexpr int flags_in_second_byte<ConvoyMessage> = 8;

TYPED_TEST(Wire, BadEnumeratorsAndReservedBitsAreRefused) {
  const auto good = encoded(of_robot<TypeParam>(7));
  for (int value = 0; value < 256; ++value) {
    auto states = good;
    states[1] = static_cast<std::uint8_t>(value);
    const bool valid = (value >> 2 & 7) <= 4 && (value >> 5 & 3) <= 2;
    EXPECT_EQ(decode_fields<TypeParam>(states).has_value(), valid) << value;
    auto flags = good;
    flags[2] = static_cast<std::uint8_t>(value);
    EXPECT_EQ(decode_fields<TypeParam>(flags).has_value(), value < 1 << flags_in_second_byte<TypeParam>) << value;
  }
}

TYPED_TEST(Wire, NobodyDoesNotSpeak) { EXPECT_FALSE(over_the_wire(TypeParam{}).has_value()); }

TYPED_TEST(Wire, NumbersThatWouldPoisonASumAreRefused) {
  auto m = of_robot<TypeParam>(7);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity(), 1.001F * q_limit, -1.001F * q_limit}) {
    m.q_x = bad;
    EXPECT_FALSE(over_the_wire(m).has_value()) << bad;
    m.q_x = 0.0F, m.q_y = bad;
    EXPECT_FALSE(over_the_wire(m).has_value()) << bad;
  }
  m.q_x = q_limit, m.q_y = -q_limit;
  EXPECT_TRUE(over_the_wire(m).has_value());
}

// A place has one form: its finest.
TYPED_TEST(Wire, LongerFormsOfAPlaceAreRefused) {
  auto m = of_robot<TypeParam>(7);
  for (int bits = INT16_MIN; bits <= INT16_MAX; ++bits) {
    m.centroid_x.bits = static_cast<std::int16_t>(bits);
    const int steps = bits >> 2, scale = bits & 3;
    const bool is_finest = scale == 0 || std::abs(steps) * 4 > 8191;
    ASSERT_EQ(over_the_wire(m).has_value(), is_finest && steps >= -8191) << steps << ", scale " << scale;
  }
}

// Algorithms of different blocks do not misread each other, were their messages of the same length.
TEST(WireBlocks, EachIsToldByItsHeader) {
  EXPECT_EQ(encoded(of_robot<TreeMessage>(7))[0], wire_version);
  EXPECT_EQ(encoded(of_robot<HealingMessage>(7))[0], wire_version | block::healing);
  EXPECT_EQ(encoded(of_robot<ConvoyMessage>(7))[0], wire_version | block::healing | block::obstacles | block::convoy);
  const auto healing = encoded(of_robot<HealingMessage>(7));
  EXPECT_FALSE(decode_fields<TreeMessage>(healing).has_value());
  EXPECT_FALSE(decode_fields<ConvoyMessage>(healing).has_value());
}

// ---- Ids and counts ----

TYPED_TEST(Wire, TheLargestIdAndCountSurviveTheWay) {
  auto m = of_robot<TypeParam>(0xFFFE);  // 0xFFFF is nobody
  m.subtree = 0xFFFF;
  EXPECT_EQ(over_the_wire(m), m);
}

TEST(RobotIds, HashAsNumbersOfAnyWidth) {
  const auto of = [](auto value) {
    Digest digest;
    digest.add(value);
    return digest.value();
  };
  EXPECT_EQ(of(nobody), of(std::uint64_t{0xFFFF}));
  EXPECT_EQ(of(RobotId{7}), of(std::uint64_t{7}));
}

}  // namespace
}  // namespace banyan
