// SPDX-License-Identifier: MIT
// SELECT PARENT: whom each algorithm takes, and what becomes of robots that lose their parent.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "bench.hpp"
#include "numbers.hpp"

namespace banyan::paper {
namespace {

template <class Kind> BenchOf<Kind> selecting() {
  BenchOf<Kind> bench = grown<Kind>();
  bench.state.phase = Phase::select_parent;
  bench.state.label = 200;
  return bench;
}

// A neighbour in the tree.
template <class Kind> auto& committed(BenchOf<Kind>& bench, RobotId id, Vec2 position, std::uint16_t label) {
  auto& m = bench.put(id, position);
  m.committed = true;
  m.role = Role::connector;
  m.label = label;
  m.depth = 3;
  m.tree_hops = 0;
  return m;
}

TEST(PaperOutwards, TakesTheClosestOfTheTree) {
  auto bench = selecting<Outwards>();
  committed(bench, 5, {0.75F, 0}, 50);
  committed(bench, 6, {0.5F, 0}, 150);
  committed(bench, 7, {0.1F, 0}, 180).committed = false;
  committed(bench, 8, {0.05F, 0}, 250);
  committed(bench, 9, {0.02F, 0}, 20).role = Role::worker;
  bench.step();
  EXPECT_EQ(bench.state.parent, 6);
  EXPECT_TRUE(bench.state.committed);
  EXPECT_EQ(bench.state.depth, 4);
}

TEST(PaperInwards, OnlyWorkersAndTheNamedJoin) {
  auto bench = selecting<Inwards>();
  committed(bench, 5, {0.725F, 0}, 20);  // beyond S
  committed(bench, 6, {0.65F, 0}, 60);
  committed(bench, 7, {0.1F, 0}, 180);
  bench.steps(3);
  EXPECT_EQ(bench.state.parent, nobody) << "nobody needs me";
  bench.put_child(20, {-0.5F, 0}, Role::worker).label = 300;
  bench.step();
  EXPECT_EQ(bench.state.parent, 6) << "the smallest label within S";
}

TEST(PaperInwards, AsPrintedTheSmallestLabelCountsWhereverItIs) {
  const auto parent = [](auto bench) {
    bench.state.label = 300;
    bench.send({2.5F, 0.0F});
    committed(bench, 5, {0.6F, 0}, 150);    // within S = 0.676
    committed(bench, 6, {0, 0.725F}, 100);  // beyond
    bench.step();
    return bench.state.parent;
  };
  EXPECT_EQ(parent(selecting<InwardsLiteral>()), 6);
  EXPECT_EQ(parent(selecting<Inwards>()), 5);
}

TEST(PaperParent, IsNearerThanCAsPrintedAndThanDeltaAsCorrected) {
  const auto takes = []<class Kind>(BenchOf<Kind> bench, float range) {
    committed(bench, 5, {range, 0}, 100);
    bench.step();
    return bench.state.parent == 5;
  };
  EXPECT_TRUE(takes(selecting<OutwardsLiteral>(), 0.995F));
  EXPECT_FALSE(takes(selecting<OutwardsLiteral>(), 1.005F));
  EXPECT_TRUE(takes(selecting<Outwards>(), 0.935F));
  EXPECT_FALSE(takes(selecting<Outwards>(), 0.945F));
}

// The order property: whoever is taken was ahead, and who takes it is behind it.
RC_GTEST_PROP(PaperParent, IsAlwaysAheadOfItsChild, ()) {
  auto bench = *rc::gen::arbitrary<bool>() ? selecting<Outwards>() : grown<Outwards>();
  bench.state.role = Role::connector;
  bench.state.label = static_cast<std::uint16_t>(*rc::gen::inRange(0, 1000));
  bench.state.seqno = static_cast<Serial>(*rc::gen::inRange(0, 5));
  const int count = *rc::gen::inRange(1, 8);
  for (int k = 0; k < count; ++k) {
    auto& m = committed(bench, static_cast<RobotId>(5 + k), polar(number(0.05F, 0.9F), number(-3, 3)),
                        static_cast<std::uint16_t>(*rc::gen::inRange(0, 1000)));
    m.seqno = static_cast<Serial>(*rc::gen::inRange(0, 5));
    m.epoch = static_cast<Serial>(*rc::gen::inRange(0, 2));
    m.committed = *rc::gen::arbitrary<bool>();
  }
  for (int t = 0; t < 30; ++t) {
    const auto before = bench.state;
    bench.step();
    if (bench.state.parent == nobody || bench.state.parent == before.parent) continue;
    const auto& m = bench.say(bench.state.parent);
    RC_ASSERT(m.epoch == before.epoch);
    RC_ASSERT(m.seqno > before.seqno || (m.seqno == before.seqno && m.label < before.label));
    RC_ASSERT(m.seqno > bench.state.seqno || (m.seqno == bench.state.seqno && m.label < bench.state.label));
  }
}

TEST(PaperParent, ThatFallsSilentIsReplacedByARobotOfTheTree) {
  auto bench = grown<Inwards>();
  bench.state.label = 300;
  bench.state.parent = 5;
  bench.send({2.5F, 0});
  committed(bench, 5, {0.5F, 0}, 100);
  committed(bench, 6, {0, 0.6F}, 50).role = Role::spare;
  committed(bench, 7, {0, -0.6F}, 150);
  bench.step();
  bench.silence(5);
  bench.steps(5);
  EXPECT_EQ(bench.state.parent, 5) << "it may only have been quiet";
  bench.step();
  EXPECT_EQ(bench.state.parent, 7);
}

TEST(PaperParent, AnOrphanWaitsAndThenDraftsTheSpareNearestToTheTree) {
  auto bench = grown<Outwards>();
  bench.state.label = 300;
  bench.state.parent = 5;
  bench.send({2.5F, 0});
  committed(bench, 5, {0.5F, 0}, 100).depth = invalid_depth;
  bench.say(5).tree_hops = unreachable;
  auto& spare = bench.put(6, {0, 0.5F});
  spare.label = 200;
  spare.seqno = 1;
  spare.tree_hops = 1;
  bench.steps(20);
  EXPECT_EQ(bench.state.parent, 5);
  bench.step();
  EXPECT_EQ(bench.state.parent, 6);
  EXPECT_EQ(report(bench.state).tally.repairs, 1U);
}

TEST(PaperParent, ASpareLeafLeaves) {
  auto bench = grown<Outwards>();
  bench.state.parent = 5;
  bench.state.label = 200;
  committed(bench, 5, {0.5F, 0}, 100);
  bench.put_child(6, {-0.5F, 0}, Role::spare);
  bench.step();
  EXPECT_EQ(bench.state.parent, 5) << "a spare still hangs on it";
  bench.silence(6);
  bench.steps(13);
  EXPECT_EQ(bench.state.parent, nobody);
}

TEST(PaperOrder, ALabelShrinksWithinAnEpochInTheCorrectedReadingOnly) {
  const auto label = []<class Kind>(BenchOf<Kind> bench) {
    bench.state.role = Role::connector;
    bench.state.parent = 5;
    bench.state.label = 5000;
    committed(bench, 5, {0.5F, 0}, 100).seqno = 11;
    bench.put_child(6, {-0.5F, 0}, Role::worker);
    bench.step();
    return bench.state.label;
  };
  EXPECT_EQ(label(grown<OutwardsLiteral>()), 5000);
  EXPECT_EQ(label(grown<Outwards>()), 228);
}

TEST(PaperRole, AConnectorWithoutAChildTurnsSpareAfterAWhile) {
  auto bench = grown<Outwards>();
  bench.state.parent = 5;
  bench.state.role = Role::connector;
  committed(bench, 5, {0.5F, 0}, 100);
  bench.steps(30);
  EXPECT_EQ(bench.state.role, Role::connector);
  bench.step();
  EXPECT_EQ(bench.state.role, Role::spare);
  EXPECT_EQ(bench.state.parent, nobody);
}

TEST(PaperRole, FollowsTheOrdersAndCarriesTheTargetAlong) {
  BenchOf<OutwardsLiteral> bench;
  bench.state.phase = Phase::grow_tree;
  bench.send({1.5F, 2.0F});
  EXPECT_EQ(bench.step().message.want, 640);
  EXPECT_EQ(bench.state.role, Role::worker);
  bench.orders.target.reset();
  EXPECT_EQ(bench.step({.forward_m = 1.5F}).message.want, 512) << "carried along while it is not sensed";
  bench.call_back();
  EXPECT_EQ(bench.step().message.want, 0);
  EXPECT_NE(bench.state.role, Role::worker);
}

}  // namespace
}  // namespace banyan::paper
