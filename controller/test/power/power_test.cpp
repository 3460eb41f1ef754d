// SPDX-License-Identifier: MIT
// Batteries as robots know them: what passes the gate, what is sent, and that a swarm without them says nothing of
// them.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "banyan/controller/convoy/convoy.hpp"
#include "bench.hpp"
#include "convoy/towing.hpp"
#include "over_the_wire.hpp"
#include "power/power.hpp"

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
    RC_ASSERT(over_the_wire(m) == m);
  }));
}

TEST(Power, RobotsWithAndWithoutBatteriesDoNotTakeEachOthersMessages) {
  std::array<std::uint8_t, wire_size<PoweredConvoyMessage>()> powered{};
  PoweredConvoyMessage m;
  m.id = 3;
  encode_fields(m, powered);
  EXPECT_EQ(powered[0], ConvoyMessage::blocks | block::further | wire_version);
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
    return powered_convoy_step(params, state, {heard, senses, test_platform}).message;
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

// With companions a tree that has arrived is not reconstructed but for this.
TEST(Power, ARootThatHasToLeaveHasTheTreeReconstructedWithCompanionsToo) {
  const auto is_reconstructed = [](float level) {
    LoneRobot root(false, true);
    root.params.link_redundancy = 2;
    for (int t = 0; t < 60; ++t) root.step(level);
    root.state.phase = Phase::grow_tree;
    root.state.phase_ticks = 1000;
    root.state.subtree_workers = 1;
    root.step(level);
    return root.state.phase != Phase::grow_tree;
  };
  EXPECT_FALSE(is_reconstructed(0.9F));
  EXPECT_TRUE(is_reconstructed(0.2F));
}

TEST(Power, WithoutAMeasuredChargeNothingIsDecided) {
  LoneRobot root(false, true);
  std::vector<Heard> heard;
  PoweredConvoyMessage said;
  for (int t = 0; t < 50; ++t) said = powered_convoy_step(root.params, root.state, {heard, {}, test_platform}).message;
  EXPECT_FALSE(said.leaving);
  EXPECT_EQ(said.level, 0xFF);
}

// A connector (id 1) below robot 9, with a child 2 that has to leave and a robot 3 beneath that.
class AboveALeaver : public ::testing::Test {
 protected:
  AboveALeaver() {
    bench.state.role = Role::connector;
    bench.state.parent = 9;
    bench.put(9, {-0.75F, 0.0F}).role = Role::root;
    bench.put_child(2, {0.1F, 0.0F}, Role::connector).child_count = 1;
    auto& below = bench.put(3, {0.85F, 0.0F});
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
    watch_charge(me, Charge{level, false}, {});
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
  bench.move(2, {0.35F, 0.0F});
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
  bench.move(9, Vec2{-0.75F, 0.0F} - spot);
  bench.move(2, Vec2{0.1F, 0.0F} - spot);
  bench.move(3, Vec2{0.85F, 0.0F} - spot);
  bench.say(2).child_count = 2;  // one that is hidden
  relieved(0.9F);
  EXPECT_FALSE(power.said.in_place);
  bench.say(2).child_count = 1;
  relieved(0.9F);
  EXPECT_TRUE(power.said.in_place);
}

// Were the hidden child behind the leaver from wherever it goes, it would go to and fro between two spots.
TEST_F(AboveALeaver, RemembersForAWhileWhereAHiddenChildWas) {
  bench.say(2).child_count = 2;
  relieved(0.9F);
  EXPECT_NEAR(power.unseen.x, 1.1F, 5e-5F) << "right behind the leaver";
  EXPECT_NEAR(power.unseen.y, 0.0F, 5e-5F);
  bench.move(2, {0.0F, 0.1F});
  for (int tick = 1; tick < 50; ++tick) relieved(0.9F);
  EXPECT_NEAR(power.unseen.x, 1.1F, 5e-5F) << "where it was";
  for (int tick = 0; tick < 3; ++tick) relieved(0.9F);
  EXPECT_NEAR(power.unseen.y, 1.1F, 5e-5F) << "after half a drive behind it as seen from here";
  bench.say(2).child_count = 1;
  relieved(0.9F);
  EXPECT_EQ(power.unseen_ticks, 0);
}

// Where a spare goes that robot 2, 0.9 C ahead and below robot 9, has let into its edge so long ago.
Vec2 course_to_leaver(ConvoyBench& bench, float drives) {
  bench.state.role = Role::spare;
  auto& leaver = bench.put(2, {0.9F, 0.0F});
  leaver.role = Role::connector;
  leaver.parent = 9;
  auto robot = bench.tick();
  bench.state.spare_state = SpareState::extend_edge;
  bench.state.request = 2;
  bench.state.request_ticks = static_cast<std::uint16_t>(bench.params.rounds(drives));
  PowerState power;
  power.standings[static_cast<std::size_t>(robot.table().find(2))].leaving = true;
  PowerRobot me{robot, power, bench.params, no_children};
  robot.power = &me;
  return waiting_motion(robot);
}

TEST(Power, ASpareGoesToTheLeaverPastARobotThatStandsInItsWay) {
  const auto course = [](Vec2 parent) {
    auto bench = grown<Convoy>();
    bench.put(9, parent).role = Role::connector;
    return unit(course_to_leaver(bench, 0.0F));
  };
  EXPECT_GT(course({0.45F, -0.5F}).x, 0.95F) << "nobody is in the way";
  EXPECT_GT(course({0.45F, -0.01F}).y, 0.3F);
  EXPECT_LT(course({0.45F, 0.01F}).y, -0.3F);
}

TEST(Power, ASpareThatIsKeptOffDrivesOnAfterAWhile) {
  const auto course = [](float drives) {
    auto bench = grown<Convoy>();
    // An edge between two robots lies across its way.
    bench.put(9, {0.05F, 0.17F}).role = Role::connector;
    auto& other = bench.put(8, {0.05F, -0.17F});
    other.role = Role::connector;
    other.parent = 9;
    return course_to_leaver(bench, drives);
  };
  EXPECT_GT(std::abs(course(0.1F).y), 0.5F) << "turned aside by the edge";
  EXPECT_NEAR(course(0.9F).y, 0.0F, 0.1F);
  EXPECT_GT(course(0.9F).x, 0.9F);
}

TEST(Power, ATravellerGoesRoundTheRobotThatHidesTheWay) {
  auto bench = grown<Convoy>();
  bench.state.role = Role::spare;
  bench.put(9, {0.1F, 0.0F}).role = Role::connector;
  auto robot = bench.tick();
  PowerState power;
  power.travels = true;
  power.way = {0.1F, 0.0F};
  PowerRobot me{robot, power, bench.params, no_children};
  robot.power = &me;
  EXPECT_GT(std::abs(unit(waiting_motion(robot)).y), 0.4F) << "not to and from it";
  power.way = {0.5F, 0.0F};
  bench.move(9, power.way);
  EXPECT_GT(unit(waiting_motion(robot)).x, 0.99F);
}

// A connector (id 1) below robot 9 and above robot 2, in a chain in which all have to leave. 9 - 1 - 2.
class AmongLeavers : public ::testing::Test {
 protected:
  AmongLeavers() {
    bench.state.role = Role::connector;
    bench.state.parent = 9;
    bench.put(9, {-0.75F, 0.0F}).role = Role::connector;
    bench.put_child(2, {0.75F, 0.0F}, Role::connector);
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

// A robot (id 1) beside robot 5, which says what the test makes it say.
class BesideAnother : public ::testing::Test {
 protected:
  BesideAnother() { bench.put(5, {0.75F, 0.0F}).role = Role::connector; }
  void tell(Role self_role, float level, std::uint8_t place_hops) {
    auto robot = bench.tick();
    bench.state.role = self_role;
    power.standings[static_cast<std::size_t>(robot.table().find(5))].place_hops = place_hops;
    PowerRobot me{robot, power, bench.params, no_children};
    power.level = -1.0F;  // no smoothing
    watch_charge(me, Charge{level, false}, {});
    call_hops = robot.call_hops;
  }
  ConvoyBench bench = grown<Convoy>();
  PowerState power;
  int call_hops = 0;
};

TEST_F(BesideAnother, HearsOnlyCallsOfThisTickOrTheLastAndNoneThatHaveGoneOnForTooLong) {
  bench.say(5).call_hops = relief_call + 3;
  tell(Role::spare, 0.9F, 2);
  EXPECT_EQ(call_hops, relief_call + 3);
  bench.say(5).call_hops = 70;  // more hops than any relief is away: it has ended, and is only counted up
  tell(Role::spare, 0.9F, 2);
  EXPECT_EQ(call_hops, nobody_calls);
  bench.say(5).call_hops = companion_call + 1;
  tell(Role::spare, 0.9F, 2);
  EXPECT_EQ(call_hops, companion_call + 1);
  bench.say(5).call_hops = relief_call + 3;
  bench.tick();
  bench.silence(5);
  bench.tick(), bench.tick();
  auto robot = bench.tick();
  ASSERT_TRUE(robot.table().alive(robot.table().find(5)));
  EXPECT_EQ(robot.call_hops, relief_call + 3);
  PowerRobot me{robot, power, bench.params, no_children};
  watch_charge(me, std::nullopt, {});
  EXPECT_EQ(robot.call_hops, nobody_calls);
}

TEST_F(BesideAnother, LeavesTheSoonerTheFartherItIsFromAPlace) {
  power.was_charged = true;
  tell(Role::connector, 0.45F, 1);
  EXPECT_FALSE(power.said.leaving);
  tell(Role::connector, 0.45F, 8);
  EXPECT_TRUE(power.said.leaving);
}

TEST_F(BesideAnother, LeavesSoonerByItsIdOnlyUntilItHasBeenCharged) {
  tell(Role::connector, 0.45F, 1);
  EXPECT_TRUE(power.said.leaving);
  power = {};
  power.was_charged = true;
  tell(Role::connector, 0.45F, 1);
  EXPECT_FALSE(power.said.leaving);
}

TEST_F(BesideAnother, DoesNotTurnBackOnItsWayToARelief) {
  tell(Role::spare, 0.6F, 3);
  EXPECT_FALSE(power.ready);
  bench.state.called = true;
  tell(Role::spare, 0.6F, 3);
  EXPECT_TRUE(power.ready);
  tell(Role::spare, 0.4F, 3);  // there it would have to leave at once
  EXPECT_FALSE(power.ready);
}

// A spare (id 1) that has to be charged, between robots 5 and 6.
class OnItsWay : public ::testing::Test {
 protected:
  OnItsWay() {
    bench.put(5, {0.75F, 0.0F}).role = Role::connector;
    bench.put(6, {0.2F, 0.2F}).role = Role::connector;
  }
  Vec2 tick(float forward_m = 0.0F) {
    Odometry odometry;
    odometry.forward_m = forward_m;
    auto robot = bench.tick(odometry);
    bench.state.role = Role::spare;
    for (const auto& [id, hops] : {std::pair{RobotId{5}, hops_of_5}, std::pair{RobotId{6}, std::uint8_t{2}}})
      if (const int k = robot.table().find(id); k >= 0) power.standings[static_cast<std::size_t>(k)].place_hops = hops;
    PowerRobot me{robot, power, bench.params, no_children};
    watch_charge(me, Charge{0.15F, false}, {});
    tend_battery(me);
    return power.way;
  }
  ConvoyBench bench = grown<Convoy>();
  PowerState power;
  std::uint8_t hops_of_5 = 1;
};

TEST_F(OnItsWay, DrivesToWhereTheRobotAheadWasAlsoWhenItIsHidden) {
  EXPECT_NEAR(tick().x, 0.75F, 5e-4F);
  ASSERT_TRUE(power.travels);
  bench.silence(5);
  for (int t = 0; t < 30; ++t) tick();
  EXPECT_NEAR(tick(0.25F).x, 0.5F, 5e-4F) << "its own way is subtracted";
  EXPECT_NEAR(tick(0.35F).y, 0.2F, 5e-4F) << "there, it takes the next one";
}

TEST_F(OnItsWay, LeavesARobotThatHasLostTheWay) {
  tick();
  hops_of_5 = 9;
  tick();
  EXPECT_EQ(power.way_id, 6);
}

TEST_F(OnItsWay, PrefersARobotOfTheTreeToASpareAsFarAway) {
  hops_of_5 = 2;
  bench.say(6).role = Role::spare;
  EXPECT_NEAR(tick().x, 0.75F, 5e-4F) << "though the spare is nearer";
}

// A spare (id 1) beside a connector that needs a companion, and from which the way to a place is known.
TEST(Power, ACompanionThatHasToBeChargedGoes) {
  ConvoyParams params = convoy_defaults();
  params.link_redundancy = 2;
  params.line_of_sight = false;
  PoweredConvoyState state = initial_powered_state(1, false, false);
  PoweredConvoyMessage root, connector, worker;
  for (PoweredConvoyMessage* m : {&root, &connector, &worker}) {
    m->epoch = 2;
    m->phase = Phase::grow_tree;
    m->root = {1, 9};
    m->level = 250;
    m->place_hops = 3;
  }
  root.id = 9;
  root.role = Role::root;
  connector.id = 2;
  connector.role = Role::connector;
  connector.parent = 9;
  connector.child_count = 1;
  worker.id = 3;
  worker.role = Role::worker;
  worker.parent = 2;
  const auto beside_after = [&](int ticks, float level) {
    std::vector<Heard> heard{{&root, {-0.9F, 0.5F}}, {&connector, {0.0F, 0.5F}}, {&worker, {0.9F, 0.5F}}};
    Senses senses;
    senses.charge = Charge{level, false};
    RobotId below = nobody;
    for (int t = 0; t < ticks; ++t)
      below = powered_convoy_step(params, state, {heard, senses, test_platform}).message.below;
    return below;
  };
  EXPECT_EQ(beside_after(10, 0.95F), 2);
  EXPECT_EQ(beside_after(100, 0.3F), nobody);
}

// A worker (id 1) that chooses its parent in a new epoch, between two candidates.
class Choosing : public ::testing::Test {
 protected:
  Choosing() {
    state.epoch = 2;
    state.phase = Phase::select_parent;
    state.root = {1, 9};
    state.label = 300;
    for (PoweredConvoyMessage* m : {&first, &second}) {
      m->epoch = 2;
      m->phase = Phase::select_parent;
      m->root = {1, 9};
      m->level = 250;
    }
    first.id = 5;
    first.label = 150;
    second.id = 6;
    second.label = 100;  // so that by its label it is preferred
  }
  RobotId parent() {
    std::vector<Heard> heard{{&first, {0.5F, 0.3F}}, {&second, {0.5F, -0.3F}}};
    Senses senses;
    senses.charge = Charge{0.45F, false};
    senses.orders.sent = true;
    senses.orders.target = Vec2{0.0F, 0.005F};  // it is there
    return powered_convoy_step(params, state, {heard, senses, test_platform}).message.parent;
  }
  ConvoyParams params = convoy_defaults();
  PoweredConvoyState state = initial_powered_state(1, true, false);
  PoweredConvoyMessage first, second;
};

TEST_F(Choosing, ASpareThatIsNotChargedIsTheLastChoice) {
  second.level = 100;
  EXPECT_EQ(parent(), 5);
}

TEST_F(Choosing, AmongChargedSparesTheLabelDecides) { EXPECT_EQ(parent(), 6); }

TEST_F(Choosing, AnEdgeToARobotThatHasToLeaveIsKept) {
  for (PoweredConvoyMessage* m : {&first, &second}) m->role = Role::connector;
  first.leaving = true;
  first.level = 90;
  state.old_parent = 5;
  EXPECT_EQ(parent(), 5);
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
  power.said.place_hops = 1;
  EXPECT_LT(hops(0.1F, nobody_calls), hops(0.5F, nobody_calls));
  EXPECT_GE(hops(0.0F, nobody_calls), relief_call);
  EXPECT_EQ(hops(0.5F, 3), 4);  // an edge that holds workers back comes first
  // The call comes to the place as if it had been made there.
  power.said.place_hops = 2;
  const int near = hops(0.9F, nobody_calls);
  power.said.place_hops = 8;
  EXPECT_EQ(hops(0.9F, nobody_calls), near - 6);
}

// A free spare (id 1) between a robot that calls and another charged spare.
class CalledSpare : public ::testing::Test {
 protected:
  // Whether it goes, if the other spare is so far from the caller.
  static bool goes(float other_away, std::uint8_t other_level, std::uint8_t call = relief_call) {
    auto bench = grown<Convoy>();
    bench.state.role = Role::spare;
    bench.put(9, {0.75F, 0.0F}).role = Role::connector;
    auto& other = bench.put(5, {0.75F, other_away});
    other.role = Role::spare;
    other.call_hops = static_cast<std::uint8_t>(call + 2);
    auto robot = bench.tick();
    robot.call_hops = static_cast<std::uint8_t>(call + 1);
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
  EXPECT_TRUE(goes(0.85F, 250));
  EXPECT_FALSE(goes(0.5F, 250));
  EXPECT_TRUE(goes(0.5F, 100));      // that one is not charged
  EXPECT_FALSE(goes(0.5F, 250, 0));  // nor to an edge that holds workers back
}

// Otherwise it would be far from the next call, or empty before it comes.
TEST(Power, AChargedSpareWaitsWithinTwoHopsOfAPlace) {
  const auto goes = [](std::uint8_t hops) {
    auto bench = grown<Convoy>();
    bench.state.role = Role::spare;
    bench.put(5, {0.75F, 0.0F}).role = Role::connector;
    auto robot = bench.tick();
    PowerState power;
    power.level = 0.95F;
    power.ready = true;
    power.said.place_hops = hops;
    power.standings[static_cast<std::size_t>(robot.table().find(5))].place_hops = static_cast<std::uint8_t>(hops - 1);
    PowerRobot me{robot, power, bench.params, no_children};
    tend_battery(me);
    return bench.state.called && bench.state.reference == 5;
  };
  EXPECT_FALSE(goes(1));
  EXPECT_FALSE(goes(2));
  EXPECT_TRUE(goes(3));
}

TEST(Power, AtAPlaceRobotsWithEnoughChargeMakeRoomForThoseWithout) {
  const auto leaves = [](bool seeks, bool charging, float level, std::uint8_t other_level) {
    auto bench = grown<Convoy>();
    bench.state.role = Role::spare;
    bench.put(5, {0.25F, 0.0F}).role = Role::worker;  // keeps the place
    bench.put(6, {0.0F, 0.3F}).role = Role::spare;
    auto robot = bench.tick();
    PowerState power;
    power.level = level;
    power.seeks = seeks;
    power.charging = charging;
    power.standings[static_cast<std::size_t>(robot.table().find(5))].place_hops = 0;
    power.standings[static_cast<std::size_t>(robot.table().find(6))].level = other_level;
    Vec2 away;
    return leaves_place(PowerRobot{robot, power, bench.params, no_children}, away) && away.x < -0.9F;
  };
  EXPECT_TRUE(leaves(false, false, 0.99F, 250)) << "it is full";
  EXPECT_FALSE(leaves(true, true, 0.6F, 60)) << "it is being charged";
  EXPECT_TRUE(leaves(true, false, 0.6F, 60)) << "it waits for a slot, and the other one needs it more";
  EXPECT_FALSE(leaves(true, false, 0.6F, 200)) << "the other one can wait as well";
  EXPECT_FALSE(leaves(true, false, 0.4F, 60)) << "it cannot wait itself";
}

TEST(Power, ASpareThatWaitsIsSlowUnlessItHidesAnEdge) {
  const auto pace = [](float off, bool called) {
    auto bench = grown<Convoy>();
    bench.state.role = Role::spare;
    bench.state.called = called;
    bench.put(9, {-0.4F, off}).role = Role::connector;
    auto& child = bench.put(2, {0.4F, off});
    child.role = Role::connector;
    child.parent = 9;
    auto robot = bench.tick();
    bench.state.called = called;
    PowerState power;
    Guard guard;
    return give_way(PowerRobot{robot, power, bench.params, no_children}, bench.params.clearance, guard);
  };
  EXPECT_LT(pace(0.3F, false), 0.5F);
  EXPECT_EQ(pace(0.05F, false), 1.0F);
  EXPECT_EQ(pace(0.3F, true), 1.0F);
}

// How fast a spare may drive towards an edge so far ahead of it, at v_max if nothing limits it.
float speed_towards_edge(float ahead, bool leaving, RobotId grant, bool joins = false) {
  auto bench = grown<Convoy>();
  bench.state.role = Role::spare;
  bench.put(9, {-0.4F, ahead}).role = Role::connector;
  auto& child = bench.put(2, {0.4F, ahead});
  child.role = Role::connector;
  child.parent = 9;
  child.grant = grant;
  auto robot = bench.tick();
  if (joins) bench.state.spare_state = SpareState::extend_edge;
  PowerState power;
  power.standings[static_cast<std::size_t>(robot.table().find(2))].leaving = leaving;
  Guard guard;
  std::ignore = give_way(PowerRobot{robot, power, bench.params, no_children}, bench.params.clearance, guard);
  return guard.apply({0.0F, 1.0F}).y;
}

TEST(Power, NoSpareDrivesIntoAnEdgeOfRobotsThatChangePlaces) {
  EXPECT_EQ(speed_towards_edge(0.09F, false, nobody), 1.0F) << "nobody leaves";
  EXPECT_EQ(speed_towards_edge(0.09F, true, nobody), 1.0F) << "nobody comes to relieve it";
  EXPECT_NEAR(speed_towards_edge(0.09F, true, 7), 0.0F, 5e-3F);
  EXPECT_LT(speed_towards_edge(0.06F, true, 7), -0.25F) << "it makes room";
  EXPECT_EQ(speed_towards_edge(0.025F, true, 7), 1.0F) << "it is in there already";
  EXPECT_GT(speed_towards_edge(0.09F, true, 7, true), 0.5F) << "one that joins an edge needs less room";
}

TEST_F(AboveALeaver, BeginsOnlyWhileItHearsAllItsTreeNeighbours) {
  leaver.leaving = false;
  relieved(0.9F);
  leaver.leaving = true;
  bench.silence(9);
  EXPECT_EQ(relieved(0.9F), nobody);
  bench.put(9, {-0.75F, 0.0F}).role = Role::root;
  EXPECT_EQ(relieved(0.9F), 2);
  bench.silence(9);
  EXPECT_EQ(relieved(0.9F), 2) << "begun, it goes on";
}

TEST_F(AboveALeaver, DoesNotGoWhereTheLeaverHidesItsParent) {
  bench.move(2, {-0.1F, 0.055F});
  relieved(0.9F);
  auto robot = bench.tick();
  Guard guard;
  std::ignore = give_way(PowerRobot{robot, power, bench.params, no_children}, bench.params.clearance, guard);
  EXPECT_LT(guard.apply({0.0F, 1.0F}).y, 0.25F);
  EXPECT_EQ(guard.apply({0.0F, -1.0F}).y, -1.0F);
}

TEST(Power, TheSpotBesideALeaverIsOnThisSideOfWhereItHidesAChild) {
  auto bench = grown<Convoy>();
  bench.state.role = Role::connector;
  bench.state.parent = 9;
  bench.put(9, {0.0F, 0.8F}).role = Role::root;
  bench.put_child(2, {0.15F, 0.05F}, Role::connector);
  bench.put_child(3, {0.85F, 0.05F}, Role::connector);
  auto robot = bench.tick();
  PowerState power;
  power.said.relieves = 2;
  power.standings[static_cast<std::size_t>(robot.table().find(2))].leaving = true;
  Vec2 spot;
  ASSERT_TRUE(find_relief_spot(PowerRobot{robot, power, bench.params, no_children}, spot));
  EXPECT_LT(spot.y, 0.05F);
}

TEST(Power, ASpareThatAReconstructionStopsBetweenTwoRobotsGetsOutOfThere) {
  const auto motion = [](float off, bool powered) {
    auto bench = grown<Convoy>();
    bench.state.role = Role::spare;
    bench.state.phase = Phase::start_tree;
    bench.put(9, {-0.4F, off}).role = Role::connector;
    auto& child = bench.put(2, {0.4F, off});
    child.role = Role::connector;
    child.old_parent = 9;
    auto robot = bench.tick();
    PowerState power;
    PowerRobot me{robot, power, bench.params, no_children};
    if (powered) robot.power = &me;
    return waiting_motion(robot);
  };
  EXPECT_LT(motion(0.025F, true).y, -0.1F);
  EXPECT_EQ(motion(0.025F, false), Vec2{});
  EXPECT_EQ(motion(0.15F, true), Vec2{}) << "it hides nobody";
}

TEST_F(AboveALeaver, StaysWhereItIsWhileTheTreeIsReconstructed) {
  bench.move(2, {0.175F, 0.05F});
  relieved(0.9F);
  const auto motion = [&](Phase phase) {
    bench.state.phase = phase;
    auto robot = bench.tick();
    PowerRobot me{robot, power, bench.params, no_children};
    robot.power = &me;
    return towed_motion(robot);
  };
  EXPECT_NE(motion(Phase::grow_tree), Vec2{});
  EXPECT_EQ(motion(Phase::select_parent), Vec2{});
}

TEST(Power, ARootThatHasToLeaveTakesAnyHeirWithMoreChargeOnlyWhenItIsUrgent) {
  auto bench = grown<Convoy>();
  bench.put(5, {0.5F, 0.0F}).role = Role::connector;
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
