// SPDX-License-Identifier: MIT
// The neighbour table: who stays in it, for how long, and where the silent ones are thought to be.
#include "banyan/controller/core/neighbors.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "banyan/controller/core/trig.hpp"

namespace banyan {
namespace {

constexpr RobotId me = 500;
constexpr std::array<RobotId, 2> none{nobody, nobody};

// What neighbours say, kept in an array of its own beside the table.
struct Said {
  RobotId parent = nobody;
  RobotId old_parent = nobody;
  int number = 0;  // of the packet
  friend bool operator==(const Said&, const Said&) = default;
};

class Table : public Neighbors {
 public:
  struct Packet {
    RobotId id;
    Vec2 position;
    Said said;
  };
  void update(const std::vector<Packet>& packets, const Carry& carry, int liveness_ticks, std::array<RobotId, 2> keep) {
    const auto must_stay = [&](RobotId id, const Said& said) {
      return id == keep[0] || id == keep[1] || said.parent == me || said.old_parent == me;
    };
    begin(1, way);
    for (const Packet& p : packets) {
      Vec2 before;
      int k = file(p.id, p.position, before, carry);
      if (k < 0) k = enter(p.id, p.position, must_stay(p.id, p.said), [&](int j) { return must_stay(id(j), said(j)); });
      if (k >= 0) said_[static_cast<std::size_t>(k)] = p.said;
    }
    const auto keeps = [&](int k) { return id(k) == keep[0] || id(k) == keep[1]; };
    for (int k = 0; (k = remove_next(k, carry, liveness_ticks, keeps)) >= 0;) close_gap(said_, k, size() + 1);
  }
  float way = 0.0F;  // 0: measurements are not filtered
  [[nodiscard]] const Said& said(int k) const { return said_[static_cast<std::size_t>(k)]; }

 private:
  std::array<Said, neighbor_capacity> said_{};
};

struct Packets {
  std::vector<Table::Packet> heard;
  void add(RobotId id, Vec2 position, RobotId parent = nobody, RobotId old_parent = nobody) {
    heard.push_back({id, position, {parent, old_parent, static_cast<int>(heard.size())}});
  }
};

std::set<RobotId> ids(const Neighbors& table) {
  std::set<RobotId> all;
  for (int k = 0; k < table.size(); ++k) all.insert(table.id(k));
  return all;
}

Packets crowd(int count, float from_m = 0.2F) {
  Packets packets;
  for (int k = 0; k < count; ++k)
    packets.add(static_cast<RobotId>(k), unit_vector(static_cast<float>(k)) * (from_m + 0.01F * static_cast<float>(k)));
  return packets;
}

TEST(Neighbors, AnEntryLivesAsLongAsTheLivenessPeriod) {
  constexpr int liveness = 5;
  Table table;
  Packets packets;
  packets.add(3, {1, 0});
  table.update(packets.heard, Carry(), liveness, none);
  ASSERT_EQ(table.size(), 1);
  EXPECT_EQ(table.age(0), 0);
  for (int age = 1; age <= liveness; ++age) {
    table.update({}, Carry(), liveness, none);
    ASSERT_EQ(table.size(), 1) << age;
    EXPECT_EQ(table.age(0), age);
    EXPECT_TRUE(table.alive(0));
  }
  table.update({}, Carry(), liveness, none);
  EXPECT_EQ(table.size(), 0);
}

TEST(Neighbors, ASilentTreeNeighborIsKeptButNotAlive) {
  Table table;
  Packets packets;
  packets.add(3, {1, 0});
  packets.add(4, {0, 1});
  packets.add(5, {1, 1});
  table.update(packets.heard, Carry(), 2, none);
  for (int k = 0; k < 50; ++k) table.update({}, Carry(), 2, {3, 4});
  EXPECT_EQ(ids(table), (std::set<RobotId>{3, 4}));
  EXPECT_FALSE(table.alive(table.find(3)));
  EXPECT_EQ(table.find(5), -1);
}

TEST(Neighbors, HearingAgainMakesYoung) {
  Table table;
  Packets packets;
  packets.add(3, {1, 0});
  table.update(packets.heard, Carry(), 5, none);
  table.update({}, Carry(), 5, none);
  packets.heard[0].position = {2, 0};
  table.update(packets.heard, Carry(), 5, none);
  EXPECT_EQ(table.size(), 1);
  EXPECT_EQ(table.age(0), 0);
  EXPECT_FLOAT_EQ(table.range(0), 2.0F);
}

TEST(Neighbors, OfSeveralPacketsOfOneSenderTheLastCounts) {
  Table table;
  Packets packets;
  packets.add(3, {1, 0});
  packets.add(4, {0, 1});
  packets.add(3, {2, 0}, 8);
  table.update(packets.heard, Carry(), 5, none);
  ASSERT_EQ(table.size(), 2);
  EXPECT_EQ(table.said(table.find(3)).parent, 8);
  EXPECT_FLOAT_EQ(table.range(table.find(3)), 2.0F);
}

TEST(Neighbors, BeyondItsCapacityItKeepsTheNearest) {
  Table table;
  Packets packets = crowd(3 * neighbor_capacity);
  std::reverse(packets.heard.begin(), packets.heard.end());
  table.update(packets.heard, Carry(), 5, none);
  ASSERT_EQ(table.size(), neighbor_capacity);
  for (int k = 0; k < neighbor_capacity; ++k) EXPECT_GE(table.find(static_cast<RobotId>(k)), 0) << k;
}

TEST(Neighbors, TreeNeighborsAreNeverEvicted) {
  Packets packets = crowd(neighbor_capacity, 0.2F);
  packets.add(300, {1.9F, 0});            // my parent
  packets.add(301, {1.9F, 0.1F});         // my old parent
  packets.add(302, {1.8F, 0.2F}, me);     // a child
  packets.add(303, {1.8F, 0.3F}, 7, me);  // an old child
  packets.add(304, {1.85F, 0.3F}, 7, 8);  // far, and nobody to me
  std::vector<Table::Packet> heard = packets.heard;
  for (int turn = 0; turn < 7; ++turn) {
    Table table;
    table.update(heard, Carry(), 5, {300, 301});
    ASSERT_EQ(table.size(), neighbor_capacity);
    for (const RobotId id : std::array<RobotId, 4>{300, 301, 302, 303})
      EXPECT_GE(table.find(id), 0) << id << " in turn " << turn;
    EXPECT_EQ(table.find(304), -1);
    std::rotate(heard.begin(), heard.begin() + 17, heard.end());
  }
}

TEST(Neighbors, ATableFullOfTreeNeighborsTakesNobodyElse) {
  Table table;
  Packets packets;
  for (int k = 0; k < neighbor_capacity; ++k) packets.add(static_cast<RobotId>(k), {1.5F, 0}, me);
  packets.add(400, {0.1F, 0});
  table.update(packets.heard, Carry(), 5, none);
  EXPECT_EQ(table.size(), neighbor_capacity);
  EXPECT_EQ(table.find(400), -1);
}

// Who is known, and what is known of each, does not depend on the order of arrival.
RC_GTEST_PROP(Neighbors, TheOrderOfArrivalDoesNotMatter, ()) {
  const int count = *rc::gen::inRange(0, 2 * neighbor_capacity);
  Packets packets;
  for (int k = 0; k < count; ++k) {
    const float far = 0.1F + 0.001F * static_cast<float>((k * 7919) % 1777);  // no two ranges are equal
    packets.add(static_cast<RobotId>(k), unit_vector(static_cast<float>(k)) * far, k % 50 == 49 ? me : nobody);
  }
  std::vector<Table::Packet> heard = packets.heard;
  Table in_order;
  in_order.update(heard, Carry(), 5, {3, 4});
  const auto shift = *rc::gen::inRange(0, count + 1);
  std::rotate(heard.begin(), heard.begin() + shift, heard.end());
  if (*rc::gen::arbitrary<bool>()) std::reverse(heard.begin(), heard.end());
  Table shuffled;
  shuffled.update(heard, Carry(), 5, {3, 4});
  RC_ASSERT(ids(in_order) == ids(shuffled));
  for (int k = 0; k < in_order.size(); ++k) {
    const int same = shuffled.find(in_order.id(k));
    RC_ASSERT(shuffled.position(same) == in_order.position(k));
    RC_ASSERT(shuffled.said(same) == in_order.said(k));
  }
}

// Random comings and goings against a plain map from id to (position, age).
RC_GTEST_PROP(Neighbors, AgreesWithAMap, ()) {
  constexpr int liveness = 4;
  struct Entry {
    Vec2 position;
    int age;
    int number;
  };
  std::map<RobotId, Entry> expected;
  Table table;
  const int ticks = *rc::gen::inRange(1, 40);
  for (int t = 0; t < ticks; ++t) {
    Packets packets;
    for (const int id : *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 30))) {
      const Vec2 at{static_cast<float>(id), static_cast<float>(t)};
      packets.add(static_cast<RobotId>(id), at);
    }
    const std::array<RobotId, 2> keep{static_cast<RobotId>(*rc::gen::inRange(0, 30)), nobody};
    table.update(packets.heard, Carry(), liveness, keep);
    for (auto& [id, entry] : expected) ++entry.age;
    for (const auto& p : packets.heard) expected[p.id] = {p.position, 0, p.said.number};
    std::erase_if(expected, [&](const auto& entry) { return entry.second.age > liveness && entry.first != keep[0]; });
    RC_ASSERT(table.size() == static_cast<int>(expected.size()));
    for (const auto& [id, entry] : expected) {
      const int k = table.find(id);
      RC_ASSERT(k >= 0);
      RC_ASSERT(table.position(k) == entry.position);
      RC_ASSERT(table.age(k) == entry.age);
      RC_ASSERT(table.said(k).number == entry.number);
    }
  }
}

// A landmark that stays put is remembered through a random walk, with and without wheels.
RC_GTEST_PROP(Carry, DeadReckoningFollowsTheTruth, (bool holonomic)) {
  using W = BasicVec2<double>;
  const auto draw = [](int limit) { return 1e-3 * *rc::gen::inRange(-limit, limit + 1); };
  const W landmark{draw(2000), draw(2000)};
  W position{};
  W heading = unit_vector(draw(3000));
  const auto seen = [&] {
    const W d = rotate_back(heading, landmark - position);
    return Vec2{static_cast<float>(d.x), static_cast<float>(d.y)};
  };
  Vec2 point = seen();
  Vec2 arrow = seen();
  const W arrow_in_world = landmark - position;
  for (int t = 0; t < 100; ++t) {
    const W moved{draw(20), holonomic ? draw(20) : 0.0};
    const double turn = draw(300);
    const Odometry odometry{static_cast<float>(moved.x), static_cast<float>(moved.y), static_cast<float>(turn)};
    const Carry carry(odometry);
    point = carry.point(point);
    arrow = carry.vector(arrow);
    position += rotate(heading, moved);
    heading = rotate(heading, unit_vector(turn));
  }
  RC_ASSERT(distance(point, seen()) < 1e-4F);
  const W expected = rotate_back(heading, arrow_in_world);
  RC_ASSERT(std::fabs(arrow.x - expected.x) + std::fabs(arrow.y - expected.y) < 2e-4);
}

TEST(Neighbors, OnlyTheSilentAreDeadReckoned) {
  Table table;
  Packets packets;
  packets.add(3, {1, 0});
  packets.add(4, {1, 0});
  table.update(packets.heard, Carry(), 5, none);
  packets.heard.pop_back();
  table.update(packets.heard, Carry({0.25F, 0}, pi<float> / 2), 5, none);
  EXPECT_EQ(table.position(table.find(3)), (Vec2{1, 0}));
  EXPECT_NEAR(table.position(table.find(4)).x, 0.0F, 1e-6F);
  EXPECT_NEAR(table.position(table.find(4)).y, -0.75F, 1e-6F);
  EXPECT_NEAR(table.range(table.find(4)), 0.75F, 1e-6F);
}

// A table that has learnt from its first neighbours that ranges are off by half a metre.
Table with_noise(Packets& packets) {
  Table table;
  table.way = 0.02F;
  for (RobotId id = 1; id <= 8; ++id) packets.add(id, {1.5F, 0});
  for (int tick = 0; tick < 400; ++tick) {
    for (Table::Packet& p : packets.heard) p.position.x = (tick + p.id) % 2 != 0 ? 1.0F : 2.0F;
    table.update(packets.heard, Carry(), 5, none);
  }
  return table;
}

TEST(Neighbors, NoisyRangesAreFilteredAndKeepASpread) {
  Packets packets;
  const Table table = with_noise(packets);
  ASSERT_GT(table.spread(), 0.1F);
  for (int k = 0; k < table.size(); ++k) {
    EXPECT_NEAR(table.position(k).x, 1.5F, 0.15F);
    EXPECT_EQ(table.range(k), norm(table.position(k)) + table.spread());
  }
}

// A new neighbour starts where it is measured, and so does one that comes back; the next measurements are averaged.
TEST(Neighbors, ANewNeighbourStartsFromItsMeasurement) {
  Packets packets;
  Table table = with_noise(packets);
  packets.add(20, {0, 1.0F});
  table.update(packets.heard, Carry(), 5, none);
  EXPECT_EQ(table.position(table.find(20)), (Vec2{0, 1.0F}));
  packets.heard.back().position.y = 1.6F;
  table.update(packets.heard, Carry(), 5, none);
  EXPECT_NEAR(table.position(table.find(20)).y, 1.3F, 1e-4F);
  packets.heard.pop_back();
  for (int tick = 0; tick < 7; ++tick) table.update(packets.heard, Carry(), 5, none);
  ASSERT_EQ(table.find(20), -1);
  packets.add(20, {0, 0.4F});
  table.update(packets.heard, Carry(), 5, none);
  EXPECT_EQ(table.position(table.find(20)), (Vec2{0, 0.4F}));
}

// My own motion is known: it is no innovation, and a filtered position moves along with it.
TEST(Neighbors, FilteredPositionsAreCarriedByOdometry) {
  Packets packets;
  Table table = with_noise(packets);
  const Vec2 before = table.position(0);
  const Carry carry({0.2F, 0}, pi<float> / 2);
  for (Table::Packet& p : packets.heard) p.position = carry.point(table.position(table.find(p.id)));
  table.update(packets.heard, carry, 5, none);
  EXPECT_NEAR(table.position(0).x, 0.0F, 1e-5F);
  EXPECT_NEAR(table.position(0).y, -(before.x - 0.2F), 1e-5F);
}

}  // namespace
}  // namespace banyan
