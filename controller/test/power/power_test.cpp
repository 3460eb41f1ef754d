// SPDX-License-Identifier: MIT
// Batteries as robots know them: what passes the gate, what is sent, and that a swarm without them says nothing of them.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <vector>

#include "banyan/controller/convoy/convoy.hpp"
#include "banyan/controller/power/power.hpp"
#include "bench.hpp"

namespace banyan {
namespace {

PoweredConvoyMessage arbitrary_powered() {
  PoweredConvoyMessage m;
  m.id = *rc::gen::inRange<RobotId>(0, nobody);
  m.leaving = *rc::gen::arbitrary<bool>();
  m.in_place = *rc::gen::arbitrary<bool>();
  m.level = *rc::gen::arbitrary<std::uint8_t>();
  m.place_hops = *rc::gen::arbitrary<std::uint8_t>();
  m.relieves = *rc::gen::arbitrary<RobotId>();
  m.heir = *rc::gen::arbitrary<RobotId>();
  m.warned = *rc::gen::arbitrary<RobotId>();
  return m;
}

TEST(Power, AMessageTravelsAndTakesNoMoreThanSixteenBytes) {
  static_assert(wire_size<PoweredConvoyMessage>() <= wire_size<ConvoyMessage>() + 16);
  static_assert(wire_size<PoweredConvoyMessage>() <= largest_wire);
  EXPECT_TRUE(rc::check([] {
    const PoweredConvoyMessage m = arbitrary_powered();
    std::array<std::uint8_t, wire_size<PoweredConvoyMessage>()> bytes{};
    RC_ASSERT(encode_fields(m, bytes) == bytes.size());
    RC_ASSERT(decode_fields<PoweredConvoyMessage>(bytes) == m);
  }));
}

TEST(Power, RobotsWithAndWithoutBatteriesDoNotTakeEachOthersMessages) {
  std::array<std::uint8_t, wire_size<PoweredConvoyMessage>()> powered{};
  PoweredConvoyMessage m;
  m.id = 3;
  encode_fields(m, powered);
  EXPECT_EQ(powered[0] & 0x0F, further_wire_version);
  EXPECT_EQ(powered[1], block::power);
  EXPECT_FALSE(decode_fields<ConvoyMessage>(powered).has_value());
  EXPECT_FALSE(decode_fields<ConvoyMessage>(std::span(powered).first(wire_size<ConvoyMessage>())).has_value());
  powered[1] = 0;  // no blocks
  EXPECT_FALSE(decode_fields<PoweredConvoyMessage>(powered).has_value());
  powered[1] = block::power | 2;  // an unknown one
  EXPECT_FALSE(decode_fields<PoweredConvoyMessage>(powered).has_value());
}

constexpr auto no_children = [](int) { return 0; };

// A lone robot of that role with this much charge.
struct LoneRobot {
  ConvoyParams params = convoy_defaults();
  PoweredConvoyState state;
  explicit LoneRobot(bool worker, bool root) : state(initial_powered_state(1, worker, root)) {}
  PoweredConvoyMessage step(float level, bool charging = false) {
    Senses senses;
    senses.charge = Charge{level, charging};
    std::vector<Heard> heard;
    return powered_convoy_step(params, state, {heard, senses, params}).message;
  }
};

TEST(Power, ARobotOfTheTreeAsksToBeRelievedWhenItRunsLowAndASpareSeeksAPlace) {
  LoneRobot root(false, true);
  EXPECT_FALSE(root.step(0.9F).leaving);
  for (int t = 0; t < 60; ++t) root.step(0.2F);
  EXPECT_TRUE(root.step(0.2F).leaving);
  EXPECT_TRUE(powered_report(root.state).leaves);
  // Charged where it stands, it stays.
  for (int t = 0; t < 100; ++t) root.step(1.0F, true);
  EXPECT_FALSE(root.step(1.0F, true).leaving);

  LoneRobot spare(false, false);
  for (int t = 0; t < 60; ++t) spare.step(0.2F);
  EXPECT_FALSE(spare.step(0.2F).leaving);
  EXPECT_TRUE(powered_report(spare.state).seeks_charge);
}

TEST(Power, WithoutAMeasuredChargeNothingIsDecided) {
  LoneRobot root(false, true);
  std::vector<Heard> heard;
  PoweredConvoyMessage said;
  for (int t = 0; t < 50; ++t) said = powered_convoy_step(root.params, root.state, {heard, {}, root.params}).message;
  EXPECT_FALSE(said.leaving);
  EXPECT_EQ(said.level, 0xFF);
}

// A connector (id 1) below robot 9, with a child 2 that has to leave and a robot 3 beneath that.
class AboveALeaver : public ::testing::Test {
 protected:
  AboveALeaver() {
    bench.state.role = Role::connector;
    bench.state.parent = 9;
    bench.put(9, {-1.5F, 0.0F}).role = Role::root;
    bench.put_child(2, {0.2F, 0.0F}, Role::connector).child_count = 1;
    auto& below = bench.put(3, {1.7F, 0.0F});
    below.role = Role::connector;
    below.parent = 2;
    leaver.leaving = true;
    leaver.level = 50;
  }
  // Whom it says that it relieves, with so much charge.
  RobotId relieved(float level) {
    auto robot = bench.tick();
    power.standings[static_cast<std::size_t>(robot.table().find(2))] = leaver;
    const auto child_count = [&](int k) { return int{robot.convoy_of(k).child_count}; };
    PowerRobot me{robot, power, bench.params, child_count};
    Senses senses;
    senses.charge = Charge{level, false};
    watch_charge(me, senses);
    watch_relief(me);
    return power.said.relieves;
  }
  ConvoyBench bench = grown<Convoy>();
  PowerStanding leaver;
  PowerState power;
};

TEST_F(AboveALeaver, TakesItsPlaceIfItHasMoreCharge) {
  EXPECT_EQ(relieved(0.9F), 2);
  power.said.in_place = false;
  leaver.level = 250;
  EXPECT_EQ(relieved(0.9F), nobody);
}

TEST_F(AboveALeaver, NotWhereItIsNotBesideIt) {
  bench.move(2, {0.7F, 0.0F});
  EXPECT_EQ(relieved(0.9F), nobody);
}

TEST_F(AboveALeaver, NotAChildThatStays) {
  leaver.leaving = false;
  EXPECT_EQ(relieved(0.9F), nobody);
}

TEST_F(AboveALeaver, NotIfItHasToLeaveItself) {
  EXPECT_EQ(relieved(0.3F), nobody);
  EXPECT_TRUE(power.said.leaving);
}

TEST_F(AboveALeaver, StandsThereOnceItHearsAllOfItsChildren) {
  // In the best spot: beside the leaver, hiding nobody.
  Vec2 spot;
  ASSERT_EQ(relieved(0.9F), 2);
  {
    auto robot = bench.tick();
    const auto child_count = [&](int k) { return int{robot.convoy_of(k).child_count}; };
    PowerRobot me{robot, power, bench.params, child_count};
    ASSERT_TRUE(find_relief_spot(me, spot));
  }
  bench.move(9, Vec2{-1.5F, 0.0F} - spot);
  bench.move(2, Vec2{0.2F, 0.0F} - spot);
  bench.move(3, Vec2{1.7F, 0.0F} - spot);
  bench.say(2).child_count = 2;  // one that is hidden
  relieved(0.9F);
  EXPECT_FALSE(power.said.in_place);
  bench.say(2).child_count = 1;
  relieved(0.9F);
  EXPECT_TRUE(power.said.in_place);
}

// A connector (id 1) below robot 9 and above robot 2, in a chain in which all have to leave. 9 - 1 - 2.
class AmongLeavers : public ::testing::Test {
 protected:
  AmongLeavers() {
    bench.state.role = Role::connector;
    bench.state.parent = 9;
    bench.put(9, {-1.5F, 0.0F}).role = Role::connector;
    bench.put_child(2, {1.5F, 0.0F}, Role::connector);
  }
  // Whether it asks for a spare, with such charges of 254.
  bool asks(std::uint8_t above, std::uint8_t mine, std::uint8_t below, bool child_leaves) {
    auto robot = bench.tick();
    power.said.leaving = true;
    power.said.level = mine;
    auto& parent = power.standings[static_cast<std::size_t>(robot.table().find(9))];
    parent.leaving = true;
    parent.level = above;
    auto& child = power.standings[static_cast<std::size_t>(robot.table().find(2))];
    child.leaving = child_leaves;
    child.level = below;
    const auto child_count = [](int) { return 1; };
    return wants_relief(PowerRobot{robot, power, bench.params, child_count});
  }
  ConvoyBench bench = grown<Convoy>();
  PowerState power;
};

TEST_F(AmongLeavers, TheLowestGoesFirstAndKeepsItsTurnWhileChargesAreNearlyEqual) {
  // Both sink by turns: whichever is a unit below the other, the lower one asks.
  for (std::uint8_t level = 120; level > 20; --level) {
    EXPECT_TRUE(asks(level, level, level, false));
    EXPECT_TRUE(asks(static_cast<std::uint8_t>(level - 1), level, level, false));
    EXPECT_FALSE(asks(level, level, static_cast<std::uint8_t>(level + 1), true));
    EXPECT_FALSE(asks(level, level, level, true));
  }
}

TEST_F(AmongLeavers, AClearlyEmptierRobotGoesBeforeThoseBelowIt) {
  EXPECT_TRUE(asks(100, 50, 100, true));
  EXPECT_FALSE(asks(50, 100, 100, false));
}

TEST(Power, ARobotWithLessChargeSeemsNearerAndMoreUrgentCallsOfOthersAreNotDrowned) {
  auto bench = grown<Convoy>();
  PowerState power;
  const auto hops = [&](float level, std::uint8_t heard) {
    auto robot = bench.tick();
    robot.call_hops = heard;
    bench.state.call_hops = 0;
    power.level = level;
    PowerRobot me{robot, power, bench.params, no_children};
    call_for_relief(me);
    return int{bench.state.call_hops};
  };
  EXPECT_LT(hops(0.1F, nobody_calls), hops(0.5F, nobody_calls));
  EXPECT_GE(hops(0.0F, nobody_calls), relief_call);
  EXPECT_EQ(hops(0.5F, 3), 4);  // an edge that holds workers back comes first
}

// A free spare (id 1) between a robot that calls and another charged spare.
class CalledSpare : public ::testing::Test {
 protected:
  // Whether it goes, if the other spare is so far from the caller.
  bool goes(float other_m, std::uint8_t other_level) {
    auto bench = grown<Convoy>();
    bench.state.role = Role::spare;
    bench.put(9, {1.5F, 0.0F}).role = Role::connector;
    auto& other = bench.put(5, {1.5F, other_m});
    other.role = Role::spare;
    other.call_hops = relief_call + 2;
    auto robot = bench.tick();
    robot.call_hops = relief_call + 1;
    bench.state.reference = 9;
    bench.state.called = true;
    PowerState power;
    power.level = 0.95F;
    power.ready = true;
    power.standings[static_cast<std::size_t>(robot.table().find(5))].level = other_level;
    PowerRobot me{robot, power, bench.params, no_children};
    tend_battery(me);
    return bench.state.called;
  }
};

TEST_F(CalledSpare, GoesUnlessAnotherChargedOneIsNearer) {
  EXPECT_TRUE(goes(1.7F, 250));
  EXPECT_FALSE(goes(1.0F, 250));
  EXPECT_TRUE(goes(1.0F, 100));  // that one is not charged
}

TEST(Power, ASpareThatWaitsIsSlowUnlessItHidesAnEdge) {
  const auto pace = [](float off_m, bool called) {
    auto bench = grown<Convoy>();
    bench.state.role = Role::spare;
    bench.state.called = called;
    bench.put(9, {-0.8F, off_m}).role = Role::connector;
    auto& child = bench.put(2, {0.8F, off_m});
    child.role = Role::connector;
    child.parent = 9;
    auto robot = bench.tick();
    bench.state.called = called;
    PowerState power;
    return leisure(PowerRobot{robot, power, bench.params, no_children}, bench.params.clearance_m);
  };
  EXPECT_LT(pace(0.6F, false), 0.5F);
  EXPECT_EQ(pace(0.1F, false), 1.0F);
  EXPECT_EQ(pace(0.6F, true), 1.0F);
}

TEST(Power, ARootThatHasToLeaveTakesAnyHeirWithMoreChargeOnlyWhenItIsUrgent) {
  auto bench = grown<Convoy>();
  bench.put(5, {1.0F, 0.0F}).role = Role::connector;
  auto robot = bench.tick();
  PowerState power;
  PowerRobot me{robot, power, bench.params, no_children};
  const auto may = [&](float mine, std::uint8_t level) {
    power.said.leaving = true;
    power.level = mine;
    power.standings[static_cast<std::size_t>(robot.table().find(5))].level = level;
    return may_inherit_root(me, robot.table().find(5));
  };
  EXPECT_TRUE(may(0.5F, 250));
  EXPECT_FALSE(may(0.5F, 150));
  EXPECT_TRUE(may(0.3F, 150));
  EXPECT_FALSE(may(0.3F, 70));
  EXPECT_FALSE(may(0.3F, 0xFF));  // not known
}

TEST(Power, ThresholdsThatContradictEachOtherAreFaults) {
  ConvoyParams p = convoy_defaults();
  EXPECT_EQ(convoy_fault(p), "");
  p.relieve_below = p.ready_above;
  EXPECT_NE(convoy_fault(p).find("relieve_below"), std::string_view::npos);
  p = convoy_defaults();
  p.charge_below = p.ready_above - 0.1F;
  EXPECT_NE(convoy_fault(p).find("charge_below"), std::string_view::npos);
}

}  // namespace
}  // namespace banyan
