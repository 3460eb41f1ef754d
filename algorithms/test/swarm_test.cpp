// SPDX-License-Identifier: MIT
// Swarms of every algorithm and reading, behind the interface that a host has: packets find their
// messages, strangers are heard over the wire, copies go their own way, and no sensor breaks a robot.
#include "banyan/controller/core/swarm.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "banyan/algorithms/algorithms.hpp"
#include "banyan/controller/core/wire.hpp"

namespace banyan {
namespace {

constexpr std::size_t robots = 5;

// Robots in a row, 1 m apart, that all hear each other; robot 0 is root, the last is sent ahead.
struct Row {
  std::unique_ptr<Swarm> swarm;
  std::array<std::vector<Packet>, robots> packets;
  std::array<Sensed, robots> sensed;
  std::array<Velocity, robots> commands{};
  std::array<Report, robots> reports{};

  Row(const Algorithm& algorithm, const char* reading, std::size_t history = 1, RobotId first_id = 10) {
    std::vector<Member> members;
    for (std::size_t i = 0; i < robots; ++i)
      members.push_back({static_cast<RobotId>(first_id + i), i + 1 == robots, i == 0});
    Setup setup;
    setup.reading = reading;
    setup.history = history;
    swarm = algorithm.make(setup, members);
    for (std::size_t i = 0; i < robots; ++i) listen(i);
  }
  static Vec2 seen(std::size_t from, std::size_t to) {
    return {static_cast<float>(to) - static_cast<float>(from), 0.0F};
  }
  void listen(std::size_t i) {
    for (std::size_t j = 0; j < robots; ++j)
      if (j != i) packets[i].push_back({static_cast<std::uint32_t>(j), 1, seen(i, j)});
    sensed[i].packets = packets[i];
    if (i + 1 == robots) sensed[i].senses.orders = {true, Vec2{3.0F, 0.0F}};
  }
  void tick() {
    swarm->step(0, sensed, commands, reports);
    swarm->advance();
  }
  [[nodiscard]] std::uint64_t digest() const {
    Digest d;
    for (std::size_t i = 0; i < robots; ++i) swarm->add_to(d, i);
    return d.value();
  }
  [[nodiscard]] double number(std::size_t i, std::string_view name) const {
    const auto fields = swarm->message_fields();
    std::vector<double> numbers(fields.size());
    swarm->message_numbers(i, numbers);
    for (std::size_t k = 0; k < fields.size(); ++k)
      if (fields[k].name == name) return numbers[k];
    ADD_FAILURE() << name;
    return 0.0;
  }
};

struct Choice {
  const Algorithm* algorithm;
  const char* reading;
};

// Every algorithm; those of the paper as printed, too.
std::vector<Choice> choices() {
  std::vector<Choice> all{{&outwards(), "literal"}, {&inwards(), "literal"}};
  for (const Algorithm* algorithm : algorithms()) all.push_back({algorithm, "corrected"});
  return all;
}
std::string name_of(const testing::TestParamInfo<Choice>& of) {
  std::string name = std::string(of.param.algorithm->name()) + "_" + of.param.reading;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

class EverySwarm : public testing::TestWithParam<Choice> {
 protected:
  [[nodiscard]] static Row row(std::size_t history = 1) { return {*GetParam().algorithm, GetParam().reading, history}; }
};
INSTANTIATE_TEST_SUITE_P(Algorithms, EverySwarm, testing::ValuesIn(choices()), name_of);
// Over the tree.
class EveryTree : public EverySwarm {};
INSTANTIATE_TEST_SUITE_P(Algorithms, EveryTree,
                         testing::Values(Choice{&outwards(), "literal"}, Choice{&outwards(), "corrected"},
                                         Choice{&inwards(), "literal"}, Choice{&inwards(), "corrected"},
                                         Choice{&convoy(), "corrected"}),
                         name_of);

TEST_P(EveryTree, AWorkerFindsItsWayIntoTheTree) {
  Row r = row();
  for (int t = 0; t < 60; ++t) r.tick();
  EXPECT_EQ(r.reports[0].role, Role::root);
  EXPECT_EQ(r.reports[robots - 1].role, Role::worker);
  EXPECT_EQ(r.reports[robots - 1].serves, 10 + robots - 1);
  EXPECT_NE(r.reports[robots - 1].parent, nobody);
  EXPECT_EQ(r.number(robots - 1, "parent"), r.reports[robots - 1].parent);
  EXPECT_EQ(r.number(0, "parent"), -1.0) << "nobody";
  EXPECT_EQ(row().number(2, "label"), -1.0) << "unknown";
  for (std::size_t i = 0; i < robots; ++i) {
    EXPECT_EQ(r.reports[i].root, 10);
    EXPECT_EQ(r.swarm->report(i).parent, r.reports[i].parent);
  }
}

constexpr RobotId far_off = 55'440;
constexpr RobotId large_id = 10 + far_off;

// A swarm with large ids does the same as one with small ones, if the difference is a multiple of all the periods in
// which robots take turns by their ids.
TEST_P(EveryTree, OnlyTheOrderOfIdsCounts) {
  Row small = row();
  Row large{*GetParam().algorithm, GetParam().reading, 1, large_id};
  for (int t = 0; t < 60; ++t) {
    small.tick();
    large.tick();
    for (std::size_t i = 0; i < robots; ++i) {
      ASSERT_EQ(small.commands[i].forward_m_s, large.commands[i].forward_m_s) << t << ' ' << i;
      ASSERT_EQ(small.commands[i].turn_rad_s, large.commands[i].turn_rad_s) << t << ' ' << i;
    }
  }
  EXPECT_EQ(large.reports[robots - 1].serves, large_id + robots - 1);
  EXPECT_EQ(large.reports[robots - 2].root, large_id);
  EXPECT_EQ(large.reports[robots - 1].parent, small.reports[robots - 1].parent + far_off);
}

// Over the wire too.
TEST_P(EverySwarm, RobotsWithTheLargestIdsAreHeard) {
  Row r{*GetParam().algorithm, GetParam().reading, 1, large_id};
  r.tick();
  std::array<std::uint8_t, largest_wire> bytes{};
  const std::size_t size = r.swarm->send(1, bytes);
  EXPECT_EQ(size, r.swarm->message_bytes());
  const auto place = r.swarm->receive(std::span(bytes).first(size));
  ASSERT_TRUE(place.has_value());
  std::vector<double> numbers(r.swarm->message_fields().size());
  r.swarm->message_numbers(*place, numbers);
  EXPECT_EQ(r.number(1, "id"), large_id + 1.0);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (r.swarm->message_fields()[k].name == "id") { EXPECT_EQ(numbers[k], large_id + 1.0); }
  }
}

// A packet of Crazyflies' own radio carries 60 bytes, of which their app may want a few.
TEST_P(EverySwarm, TravelsInASmallPacketOrIsRefusedAtTheStart) {
  constexpr std::size_t limit = 57;
  const Algorithm& algorithm = *GetParam().algorithm;
  banyan::Setup setup;
  setup.reading = GetParam().reading;
  Row r = row();
  for (int t = 0; t < 20; ++t) r.tick();
  std::array<std::uint8_t, largest_wire> said{};
  const std::size_t size = r.swarm->send(1, said);
  EXPECT_EQ(message_bytes(algorithm, setup), size);
  const std::string fault = payload_fault(algorithm, setup, limit, algorithms());
  EXPECT_EQ(fault.empty(), size <= limit) << fault;
  if (size > limit) {
    EXPECT_TRUE(fault.find("these fit: caravan (40), link-consensus (46)") != std::string::npos) << fault;
    return;
  }
  std::array<std::uint8_t, limit> packet{};
  std::copy_n(said.begin(), size, packet.begin());
  EXPECT_TRUE(r.swarm->receive(std::span(packet).first(size)));
  for (std::size_t cut = 0; cut < size; ++cut)
    EXPECT_FALSE(r.swarm->receive(std::span(packet).first(cut))) << "cut to " << cut << " bytes";
  EXPECT_FALSE(r.swarm->receive(packet)) << "with what was behind it in the packet";
}

TEST(SmallPackets, ConvoyOnBatteriesSaysMore) {
  banyan::Setup setup;
  EXPECT_EQ(payload_fault(convoy(), setup, 96, algorithms()), "");
  setup.platform.battery = true;
  EXPECT_EQ(payload_fault(convoy(), setup, 96, AlgorithmList{&convoy()}),
            "a message of convoy has 104 bytes, and the radio carries 96; no algorithm has a shorter one");
}

TEST_P(EverySwarm, RangesInAnyOrderAreOneTick) {
  Row whole = row();
  Row parts = row();
  for (int t = 0; t < 40; ++t) {
    whole.tick();
    for (const std::size_t first : {std::size_t{3}, std::size_t{0}, std::size_t{4}}) {
      const std::size_t count = first == 0 ? 3 : 1;
      parts.swarm->step(first, std::span(parts.sensed).subspan(first, count),
                        std::span(parts.commands).subspan(first, count),
                        std::span(parts.reports).subspan(first, count));
    }
    parts.swarm->advance();
  }
  EXPECT_EQ(whole.digest(), parts.digest());
}

TEST_P(EverySwarm, ACopyGoesItsOwnWay) {
  Row r = row();
  for (int t = 0; t < 5; ++t) r.tick();  // later a swarm may have come to rest
  const std::uint64_t before = r.digest();
  std::unique_ptr<Swarm> copy = r.swarm->clone();
  r.tick();
  EXPECT_NE(r.digest(), before);
  std::swap(r.swarm, copy);
  EXPECT_EQ(r.digest(), before);
}

TEST_P(EverySwarm, TheDeadRepeatTheirLastMessageAndDoNotStep) {
  Row r = row();
  for (int t = 0; t < 30; ++t) r.tick();
  std::array<std::uint8_t, largest_wire> last{};
  const std::size_t size = r.swarm->send(2, last);
  r.sensed[2].steps = false;
  r.commands[2] = {7.0F, 7.0F, 7.0F};
  for (int t = 0; t < 5; ++t) r.tick();
  std::array<std::uint8_t, largest_wire> now{};
  EXPECT_EQ(r.swarm->send(2, now), size);
  EXPECT_EQ(now, last);
  EXPECT_EQ(r.commands[2].forward_m_s, 7.0F) << "nor is it told anything";
}

// The root begins in its first tick. A packet of `age` ticks ago says so that much later.
TEST_P(EveryTree, PacketsMayBeAsOldAsTheHistory) {
  for (std::uint32_t age = 1; age <= 3; ++age) {
    Row r = row(3);
    r.packets[1] = {{0, age, Row::seen(1, 0)}};
    r.sensed[1].packets = r.packets[1];
    std::uint32_t ticks = 0;
    while (r.number(1, "phase") == 0.0 && ticks < 40) {
      r.tick();
      ++ticks;
    }
    EXPECT_EQ(ticks, 1 + age);
  }
}

TEST_P(EverySwarm, HearsStrangersOverTheWireForOneTick) {
  Row native = row();
  Row foreign = row();
  for (int t = 0; t < 40; ++t) {
    // Robot 0 of the one hears robot 1 of the other as a stranger, with what robot 1 of its own said.
    std::array<std::uint8_t, largest_wire> bytes{};
    const std::size_t size = foreign.swarm->send(1, bytes);
    EXPECT_EQ(size, foreign.swarm->message_bytes());
    const auto place = t == 0 ? std::optional<std::uint32_t>(1) : foreign.swarm->receive(std::span(bytes).first(size));
    ASSERT_TRUE(place.has_value());
    for (Packet& p : foreign.packets[0])
      if (p.position == Row::seen(0, 1)) p.sender = *place;
    native.tick();
    foreign.tick();
    ASSERT_EQ(native.digest(), foreign.digest()) << t;
  }
}

TEST_P(EverySwarm, RefusesWhatItsAlgorithmDoesNotWrite) {
  Row r = row();
  r.tick();
  std::array<std::uint8_t, largest_wire> bytes{};
  const std::size_t size = r.swarm->send(1, bytes);
  EXPECT_FALSE(r.swarm->receive(std::span(bytes).first(size - 1)).has_value());
  EXPECT_TRUE(r.swarm->receive(std::span(bytes).first(size)).has_value());
  bytes[0] ^= 1;
  EXPECT_FALSE(r.swarm->receive(std::span(bytes).first(size)).has_value());
}

TEST_P(EverySwarm, HasANameAndANumberForEveryField) {
  const Row r = row();
  for (const FieldInfo& field : r.swarm->message_fields()) {
    EXPECT_FALSE(field.name.empty());
    EXPECT_FALSE(field.meaning.empty()) << field.name;
  }
  EXPECT_EQ(r.number(2, "id"), 12.0);
  EXPECT_GT(r.swarm->memory_bytes(), robots * r.swarm->message_bytes());
}

// What no sensor that works says.
float broken() {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  return *rc::gen::element(std::numeric_limits<float>::quiet_NaN(), infinite, -infinite, 3e38F, -3e38F);
}

RC_GTEST_PROP(Swarms, NoBrokenSensorMakesAVelocityInfiniteOrASecondRoot, ()) {
  for (const Choice choice : choices()) {
    Row r(*choice.algorithm, choice.reading);
    for (int t = 0; t < 30; ++t) r.tick();
    const std::array<Report, robots> before = r.reports;
    const std::size_t victim = *rc::gen::inRange<std::size_t>(0, robots);
    const Sensed sane = r.sensed[victim];
    const std::vector<Packet> heard = r.packets[victim];
    const std::array obstacles{Vec2{broken(), broken()}};
    Senses& senses = r.sensed[victim].senses;
    senses.odometry = {broken(), broken(), broken()};
    senses.elapsed_s = broken();
    senses.obstacles = obstacles;
    if (senses.orders.sent) senses.orders.target = Vec2{broken(), broken()};
    for (Packet& p : r.packets[victim]) p = {p.sender, p.age_ticks, {broken(), broken()}, broken()};
    r.tick();
    r.packets[victim] = heard;
    r.sensed[victim] = sane;
    for (int t = 0; t < 20; ++t) {
      for (const Velocity& v : r.commands)
        RC_ASSERT(std::isfinite(v.forward_m_s) && std::isfinite(v.sideways_m_s) && std::isfinite(v.turn_rad_s));
      for (std::size_t i = 0; i < robots; ++i)
        RC_ASSERT(r.reports[i].root == before[i].root && r.reports[i].tally.elections == before[i].tally.elections);
      RC_ASSERT(r.reports[robots - 1].want > 0.0F);
      r.tick();
    }
  }
}

}  // namespace
}  // namespace banyan
