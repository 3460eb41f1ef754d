// SPDX-License-Identifier: MIT
// Convoy's rules (docs/convoy.md), one by one, on a robot among neighbours that a test puts in place.
#include "banyan/controller/convoy.hpp"
#include "banyan/controller/shortcut.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "banyan/controller/motion.hpp"
#include "banyan/controller/parent_selection.hpp"
#include "banyan/controller/policies.hpp"
#include "bench.hpp"

namespace banyan {
namespace {

// A connector (id 1) of the chain 9 (root) - 2 - 1 - 3 (worker with 4 m to go).
class ConvoyChain : public ::testing::Test {
 protected:
  ConvoyChain() {
    bench.state.role = Role::connector;
    bench.state.parent = 2;
    bench.state.committed = true;
    bench.state.label_cm = 200;
    bench.state.pulse = 50;
    Message& parent = bench.put(2, {-1.0F, 0.0F});
    parent.role = Role::connector;
    parent.parent = 9;
    parent.label_cm = 100;
    parent.pulse = 51;
    parent.depth = 2;
    parent.committed = true;
    parent.child_count = 1;
    Message& child = bench.put(3, {1.6F, 0.0F});
    child.role = Role::worker;
    child.parent = 1;
    child.label_cm = 300;
    child.pulse = 49;
    child.depth = 4;
    child.want_cm = 400;
    child.committed = true;
  }
  Message& put_root(Vec2 position) {
    Message& root = bench.put(9, position);
    root.role = Role::root;
    root.label_cm = 0;
    root.pulse = 53;
    root.depth = 1;
    root.committed = true;
    return root;
  }
  Vec2 motion() {
    Robot robot = bench.tick();
    return convoy().tree_motion(robot);
  }
  RobotId parent_after_shortcuts() {
    Robot robot = bench.tick();
    take_shortcuts(robot);
    return bench.state.parent;
  }
  Bench bench = grown(convoy());
};

TEST_F(ConvoyChain, AStretchedChildTowsItsParentAlong) {
  EXPECT_GT(motion().x, 0.5F);
  bench.say(3).want_cm = 0;  // arrived: nothing but the tension of both edges is left
  EXPECT_LT(motion().x, 0.3F);
  bench.say(3).want_cm = 400;
  bench.move(3, {1.0F, 0.0F});  // slack
  EXPECT_LT(motion().x, 0.3F);
}

TEST_F(ConvoyChain, WhileRobotsAreShortWhoIsAsGoodAsThereDoesNotTow) {
  bench.say(3).want_cm = 15;
  EXPECT_GT(motion().x, 0.5F);
  bench.state.call_hops = 3;  // an edge waits in vain for a spare
  const float gives_way = motion().x;
  bench.say(3).want_cm = 400;
  EXPECT_GT(motion().x, gives_way + 0.5F);
}

TEST_F(ConvoyChain, AJunctionStaysUntilItsEdgesAreNearTheirLimit) {
  Message& other = bench.put(4, {0.0F, 1.6F});
  other = bench.say(3);
  other.id = 4;
  const Vec2 waits = motion();
  EXPECT_LT(norm(waits), 0.7F);
  bench.move(3, {1.88F, 0.0F});
  bench.move(4, {0.0F, 1.88F});
  EXPECT_GT(norm(motion()), norm(waits) + 0.2F);
}

TEST_F(ConvoyChain, AskForASpareWhenLongWithWorkLeftOrWhenHidden) {
  const auto needs = [&] {
    Robot robot = bench.tick();
    bench.state.want_m = static_cast<float>(bench.say(3).want_cm) * 0.01F;
    return convoy().needs_spare(robot);
  };
  EXPECT_FALSE(needs());
  bench.move(2, {-1.7F, 0.0F});
  EXPECT_TRUE(needs());
  bench.say(3).want_cm = 0;
  EXPECT_FALSE(needs());
  bench.move(2, {-1.0F, 0.0F});
  bench.tick();
  bench.silence(2);
  for (int t = 0; t < 2; ++t) EXPECT_FALSE(needs());
  EXPECT_TRUE(needs());
}

TEST_F(ConvoyChain, OnlyAnEdgeNearItsLimitCallsSparesFromAfar) {
  const auto calls = [&] { return convoy().may_call(bench.tick()); };
  bench.move(2, {-1.7F, 0.0F});
  EXPECT_FALSE(calls());
  bench.move(2, {-1.85F, 0.0F});
  EXPECT_TRUE(calls());
}

TEST_F(ConvoyChain, AConnectorThatIsNotNeededAnyMoreIsReleased) {
  put_root({-1.3F, 0.6F});
  EXPECT_EQ(parent_after_shortcuts(), 9);
}

TEST_F(ConvoyChain, AConnectorIsKeptThatServesAnotherOrIsFarFromItsParent) {
  put_root({-1.3F, 0.6F});
  bench.say(2).child_count = 2;
  EXPECT_EQ(parent_after_shortcuts(), 2);
  bench.say(2).child_count = 1;
  bench.move(9, {-1.6F, 0.6F});
  EXPECT_EQ(parent_after_shortcuts(), 2);
}

TEST_F(ConvoyChain, AHiddenParentIsReplacedByWhoeverIsAheadAndInSight) {
  Message& spare = bench.put(5, {-0.5F, 0.5F});
  spare.role = Role::spare;
  spare.tree_hops = 1;
  spare.pulse = 52;
  spare.label_cm = 150;
  bench.tick();
  bench.silence(2);
  EXPECT_EQ(parent_after_shortcuts(), 2);  // one lost packet is no reason
  EXPECT_EQ(parent_after_shortcuts(), 5);
}

TEST_F(ConvoyChain, AParentAboutToBeHiddenIsReplacedInTime) {
  Message& beside = bench.put(5, {-0.5F, 0.3F});
  beside.role = Role::connector;
  beside.parent = 9;
  beside.depth = 2;
  beside.pulse = 52;
  beside.label_cm = 120;
  bench.say(2).child_count = 2;  // or it would be released
  EXPECT_EQ(parent_after_shortcuts(), 2);
  Message& walker = bench.put(6, {-0.7F, -0.09F});
  walker.role = Role::spare;
  EXPECT_EQ(parent_after_shortcuts(), 5);
}

TEST_F(ConvoyChain, HoldsStillInAReconstructionWhenAllHaveArrived) {
  bench.move(3, {0.8F, 1.0F});  // not in line with the parent: tension
  bench.state.phase = Phase::start_tree;
  EXPECT_GT(norm(motion()), 0.0F);
  bench.say(3).want_cm = 0;
  EXPECT_EQ(norm(motion()), 0.0F);
  bench.state.phase = Phase::grow_tree;
  EXPECT_GT(norm(motion()), 0.0F);
}

// Robot 5 is as fresh as I am and has the larger label: it is behind me, or may hang on me.
class EndangeredEdge : public ConvoyChain {
 protected:
  EndangeredEdge() {
    Message& beside = bench.put(5, {-0.5F, 0.3F});
    beside.role = Role::connector;
    beside.parent = 9;
    beside.depth = 2;
    beside.pulse = 50;
    beside.label_cm = 400;
    bench.say(2).child_count = 2;
    bench.put(6, {-0.7F, -0.09F}).role = Role::spare;
  }
};

TEST_F(EndangeredEdge, LetsItsPulseRestUntilAStopgapIsAhead) {
  bench.step();
  EXPECT_EQ(bench.state.parent, 2);
  EXPECT_EQ(bench.state.wish, 5);
  for (int t = 0; t < 3; ++t) {
    ++bench.say(2).pulse;
    ++bench.say(5).pulse;
    bench.step();
  }
  EXPECT_EQ(bench.state.parent, 5);
}

TEST_F(EndangeredEdge, NeverHangsOnItsOwnDescendant) {
  for (int t = 0; t < 100; ++t) {
    ++bench.say(2).pulse;
    bench.say(5).pulse = bench.step().message.pulse;
    ASSERT_EQ(bench.state.parent, 2) << t;
  }
  EXPECT_GT(bench.state.pulse, 100);  // and the pulse does not rest for ever
}

// What is about to cut the edge is hidden from me, but not from my parent.
TEST_F(EndangeredEdge, IsGivenUpWhenTheParentWarns) {
  bench.move(6, {0.0F, 1.5F});
  bench.say(5).pulse = 52;
  EXPECT_EQ(parent_after_shortcuts(), 2);
  bench.say(2).warned = 1;
  EXPECT_EQ(parent_after_shortcuts(), 5);
}

TEST_F(ConvoyChain, WarnsAChildWhoseSightIsAboutToBeCut) {
  bench.put(6, {0.8F, 0.2F}).role = Role::spare;
  EXPECT_EQ(bench.step().message.warned, nobody);
  bench.move(6, {0.8F, 0.1F});
  EXPECT_EQ(bench.step().message.warned, 3);
}

TEST_F(ConvoyChain, StepsBeforeItsParentWhenItHidesItFromTheGrandparent) {
  bench.say(2).child_count = 2;  // or it would be released
  put_root({0.8F, 0.6F});
  EXPECT_EQ(parent_after_shortcuts(), 2);
  bench.move(9, {0.8F, 0.05F});
  EXPECT_EQ(parent_after_shortcuts(), 9);
}

TEST(Convoy, ASpareJoinsWhereItStandsIfItSeesBothEnds) {
  Bench bench = grown(convoy());
  bench.put(2, {-1.0F, 0.2F});
  bench.put(3, {1.0F, 0.2F});
  const auto joins = [&] {
    const Robot robot = bench.tick();
    return convoy().may_insert(robot, robot.table().find(2), robot.table().find(3));
  };
  EXPECT_TRUE(joins());
  bench.put(4, {0.5F, 0.1F}).role = Role::spare;
  EXPECT_FALSE(joins());
  bench.silence(4);
  for (int t = 0; t < 10; ++t) bench.tick();
  bench.move(3, {1.81F, 0.2F});
  EXPECT_FALSE(joins());
}

TEST(Convoy, ASpareInTheWayJoinsIfNobodyHidesAnEndFromIt) {
  Bench bench = grown(convoy());
  bench.put(2, {-1.0F, 0.0F});
  bench.put(3, {1.0F, 0.0F});
  bench.put(4, {0.5F, 0.12F}).role = Role::spare;
  const auto joins = [&] {
    const Robot robot = bench.tick();
    return convoy().may_insert(robot, robot.table().find(2), robot.table().find(3));
  };
  EXPECT_TRUE(joins());
  bench.move(4, {0.5F, 0.06F});
  EXPECT_FALSE(joins());
}

// Both are blocked, but 3 can be heard past 5; 4 hides 2.
TEST(Convoy, PrefersABlockedParentThatItStillSees) {
  Bench bench = grown(convoy());
  bench.put(2, {1.0F, 0.0F});
  bench.put(3, {0.0F, 1.2F});
  bench.put(4, {0.5F, 0.02F}).role = Role::spare;
  bench.put(5, {0.12F, 0.6F}).role = Role::spare;
  const Robot robot = bench.tick();
  const int hidden = robot.table().find(2);
  const int seen = robot.table().find(3);
  EXPECT_TRUE(convoy().prefers(robot, seen, hidden));
  EXPECT_FALSE(convoy().prefers(robot, hidden, seen));
}

// A spare 0.2 m beside the middle of the edge 2-3.
class SpareBesideAnEdge : public ::testing::Test {
 protected:
  SpareBesideAnEdge() {
    bench.put(2, {-0.8F, 0.2F}).role = Role::connector;
    bench.put(3, {0.8F, 0.2F}).role = Role::root;
  }
  Vec2 motion() {
    const Robot robot = bench.tick();
    return convoy().spare_motion(robot);
  }
  Bench bench = grown(convoy());
};

TEST_F(SpareBesideAnEdge, MakesWayForItAlsoWhenOneEndIsHiddenFromIt) {
  EXPECT_EQ(norm(motion()), 0.0F);
  bench.say(2).parent = 3;
  EXPECT_LT(motion().y, 0.0F);
  bench.silence(2);
  EXPECT_LT(motion().y, 0.0F);
}

TEST_F(SpareBesideAnEdge, MakesWayForAnEdgeOfTheOldTree) {
  bench.say(2).old_parent = 3;
  EXPECT_LT(motion().y, 0.0F);
}

// While the tree is reconstructed nobody can mend a line of sight.
TEST_F(SpareBesideAnEdge, HoldsStillInAReconstructionWhenAllHaveArrived) {
  bench.say(2).old_parent = 3;
  bench.state.phase = Phase::start_tree;
  EXPECT_EQ(norm(motion()), 0.0F);
  bench.say(2).want_cm = 100;
  EXPECT_LT(motion().y, 0.0F);
}

// Spare 5 has passed the call on and stands next to me; the tree's nearest robot 2 drives away.
TEST(Convoy, ACalledSpareKeepsUpWithTheTree) {
  Bench bench = grown(convoy());
  bench.put(5, {-0.3F, 0.0F}).role = Role::spare;
  bench.put(2, {1.4F, 0.0F}).role = Role::connector;
  bench.state.called = true;
  bench.state.reference = 5;
  const auto towards_tree = [&] {
    const Robot robot = bench.tick();
    return convoy().spare_motion(robot).x;
  };
  EXPECT_LT(towards_tree(), 0.5F);
  bench.move(2, {1.6F, 0.0F});
  EXPECT_GT(towards_tree(), 0.5F);
}

TEST(Convoy, LengthsGrowWithTheRadioAndThereIsOneReading) {
  EXPECT_TRUE(convoy().scales_with_range());
  EXPECT_FALSE(outwards().scales_with_range());
  EXPECT_TRUE(convoy().defaults(Reading::literal).corrected());
}

// Whatever a robot hears, a shortcut never takes a parent that is behind it: no cycle can close.
RC_GTEST_PROP(Convoy, ShortcutsKeepTheOrderOfTheTree, ()) {
  Bench bench = grown(convoy());
  const auto below = [](int n) { return *rc::gen::inRange(0, n); };
  bench.state.role = below(2) == 0 ? Role::connector : Role::worker;
  bench.state.is_worker = bench.state.role == Role::worker;
  bench.state.parent = 2;
  bench.state.committed = true;
  bench.state.label_cm = static_cast<std::uint16_t>(50 + below(200));
  bench.state.pulse = static_cast<std::uint16_t>(40 + below(20));
  const int count = 2 + below(8);
  for (int k = 0; k < count; ++k) {
    Message& m = bench.put(static_cast<RobotId>(2 + k), {static_cast<float>(below(360) - 180) * 0.01F, static_cast<float>(below(360) - 180) * 0.01F});
    m.role = static_cast<Role>(below(4));
    m.parent = below(3) == 0 ? nobody : static_cast<RobotId>(1 + below(count + 2));
    m.label_cm = static_cast<std::uint16_t>(below(300));
    m.pulse = static_cast<std::uint16_t>(40 + below(20));
    m.depth = static_cast<std::uint16_t>(below(5));
    m.tree_hops = static_cast<std::uint8_t>(below(3));
    m.child_count = static_cast<std::uint8_t>(below(3));
    m.committed = true;
  }
  for (int t = 0; t < 4; ++t) {
    if (t == 1 && below(2) == 0) bench.silence(2);
    Robot robot = bench.tick();
    const State before = bench.state;
    bool ahead[neighbor_capacity] = {};
    for (int k = 0; k < robot.table().size(); ++k) ahead[k] = is_ahead(robot, k);
    take_shortcuts(robot);
    if (bench.state.parent == before.parent) continue;
    RC_ASSERT(ahead[robot.parent]);
    RC_ASSERT(robot.table().message(robot.parent).parent != bench.state.id);
  }
}

}  // namespace
}  // namespace banyan
