// SPDX-License-Identifier: MIT
// The wire format: every message survives the way, everything else is refused.
#include "banyan/controller/message.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace banyan {
namespace {

Message arbitrary_message() {
  const auto word = [] { return *rc::gen::arbitrary<std::uint16_t>(); };
  const auto meters = [] { return static_cast<float>(*rc::gen::inRange(-1'000'000, 1'000'001)) * 0.001F; };
  Message m;
  m.id = *rc::gen::inRange<std::uint16_t>(0, nobody);
  m.role = static_cast<Role>(*rc::gen::inRange(0, 4));
  m.phase = static_cast<Phase>(*rc::gen::inRange(0, 5));
  m.need = static_cast<Need>(*rc::gen::inRange(0, 3));
  m.flood_done = *rc::gen::arbitrary<bool>();
  m.committed = *rc::gen::arbitrary<bool>();
  m.parent_silent = *rc::gen::arbitrary<bool>();
  for (std::uint16_t* field : {&m.epoch, &m.root.sequence, &m.root.id, &m.root_size, &m.label_cm, &m.pulse, &m.depth, &m.parent, &m.old_parent,
                               &m.flood_parent, &m.flood_robots, &m.flood_workers, &m.subtree, &m.subtree_workers, &m.count,
                               &m.grant, &m.request, &m.inserted_child, &m.warned, &m.new_root, &m.want_cm, &m.heartbeat, &m.serves, &m.told,
                               &m.task_serves, &m.task_holder, &m.task_beat})
    *field = word();
  for (std::int16_t* field : {&m.pull_x, &m.pull_y, &m.centroid_x_cm, &m.centroid_y_cm, &m.root_x_cm, &m.root_y_cm, &m.task_x_cm, &m.task_y_cm}) *field = static_cast<std::int16_t>(word());
  m.tree_hops = *rc::gen::arbitrary<std::uint8_t>();
  m.call_hops = *rc::gen::arbitrary<std::uint8_t>();
  m.child_count = *rc::gen::arbitrary<std::uint8_t>();
  m.q = {meters(), meters()};
  return m;
}

RC_GTEST_PROP(Message, SurvivesTheWay, ()) {
  const Message m = arbitrary_message();
  const std::optional<Message> back = decode(encode(m));
  RC_ASSERT(back.has_value());
  RC_ASSERT(*back == m);
}

// A second encoding gives the same bytes: no byte that is accepted goes unused.
RC_GTEST_PROP(Message, AcceptsNoOtherBytesThanItsOwn, (const std::vector<std::uint8_t>& noise)) {
  Wire wire = encode(arbitrary_message());
  for (std::size_t k = 0; k < noise.size(); ++k) wire[(k * 31 + noise[k]) % wire_size] ^= noise[k];
  const std::optional<Message> m = decode(wire);
  if (m) RC_ASSERT(encode(*m) == wire);
}

RC_GTEST_PROP(Message, RandomBytesOfTheRightLengthAreReadOrRefused, ()) {
  std::vector<std::uint8_t> bytes = *rc::gen::container<std::vector<std::uint8_t>>(wire_size, rc::gen::arbitrary<std::uint8_t>());
  if (*rc::gen::arbitrary<bool>()) bytes[0] = wire_version;
  const std::optional<Message> m = decode(bytes);
  if (!m) return;
  RC_ASSERT(m->role <= Role::root);
  RC_ASSERT(m->phase <= Phase::select_root);
  RC_ASSERT(m->need <= Need::await);
  RC_ASSERT(std::fabs(m->q.x) <= q_limit_m && std::fabs(m->q.y) <= q_limit_m);
}

TEST(Message, FitsIntoNinetySixBytes) { EXPECT_LE(wire_size, 96U); }

TEST(Message, ByteOrderIsLittleEndianWhateverTheMachine) {
  Message m;
  m.id = 0x1234;
  m.epoch = 0xABCD;
  const Wire wire = encode(m);
  EXPECT_EQ(wire[0], wire_version);
  EXPECT_EQ(wire[3], 0x34);
  EXPECT_EQ(wire[4], 0x12);
  EXPECT_EQ(wire[5], 0xCD);
  EXPECT_EQ(wire[6], 0xAB);
}

TEST(Message, EveryOtherLengthIsRefused) {
  Message m;
  m.id = 7;
  const Wire wire = encode(m);
  // The vector holds exactly `size` bytes, so a sanitizer sees any read past the end.
  for (std::size_t size = 0; size <= 2 * wire_size; ++size) {
    std::vector<std::uint8_t> bytes(wire.begin(), wire.begin() + static_cast<std::ptrdiff_t>(std::min(size, wire_size)));
    bytes.resize(size);
    EXPECT_EQ(decode(bytes).has_value(), size == wire_size) << size;
  }
}

TEST(Message, EveryOtherVersionIsRefused) {
  Message m;
  m.id = 7;
  Wire wire = encode(m);
  for (int version = 0; version < 256; ++version) {
    wire[0] = static_cast<std::uint8_t>(version);
    EXPECT_EQ(decode(wire).has_value(), version == wire_version) << version;
  }
}

TEST(Message, BadEnumeratorsAndReservedBitsAreRefused) {
  Message m;
  m.id = 7;
  const Wire good = encode(m);
  for (int states = 0; states < 256; ++states) {
    Wire wire = good;
    wire[1] = static_cast<std::uint8_t>(states);
    const bool valid = (states >> 2 & 7) <= 4 && (states >> 5 & 3) <= 2 && states < 128;
    EXPECT_EQ(decode(wire).has_value(), valid) << states;
  }
  for (int flags = 0; flags < 256; ++flags) {
    Wire wire = good;
    wire[2] = static_cast<std::uint8_t>(flags);
    EXPECT_EQ(decode(wire).has_value(), flags < 32) << flags;
  }
}

TEST(Message, NobodyDoesNotSpeak) { EXPECT_FALSE(decode(encode(Message{})).has_value()); }

TEST(Message, NumbersThatWouldPoisonASumAreRefused) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity(), 1.001F * q_limit_m, -1.001F * q_limit_m}) {
    Message m;
    m.id = 7;
    m.q = {bad, 0.0F};
    EXPECT_FALSE(decode(encode(m)).has_value()) << bad;
    m.q = {0.0F, bad};
    EXPECT_FALSE(decode(encode(m)).has_value()) << bad;
  }
  Message m;
  m.id = 7;
  m.q = {q_limit_m, -q_limit_m};
  EXPECT_TRUE(decode(encode(m)).has_value());
}

TEST(Message, RootTokensAreOrderedBySequenceThenId) {
  EXPECT_TRUE(newer({2, 1}, {1, 9}));
  EXPECT_TRUE(newer({2, 5}, {2, 4}));
  EXPECT_FALSE(newer({2, 4}, {2, 4}));
  EXPECT_FALSE(newer({1, 9}, {2, 1}));
}

TEST(Message, VectorsGoToTheParentOrDuringASwitchToTheOldOne) {
  Message m;
  EXPECT_EQ(up_of(m), nobody);
  m.old_parent = 4;
  EXPECT_EQ(up_of(m), 4);
  m.parent = 5;
  EXPECT_EQ(up_of(m), 5);
  m.role = Role::root;  // a root keeps the edge to its old parent, but reports to nobody
  EXPECT_EQ(up_of(m), nobody);
}

}  // namespace
}  // namespace banyan
