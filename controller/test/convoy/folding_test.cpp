// SPDX-License-Identifier: MIT
// With line of sight a branch that has arrived folds: which edges are too long, where spares join them, how its robots
// move, and who gets out of the way.
#include "convoy/folding.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include "bench.hpp"
#include "convoy/towing.hpp"

namespace banyan {
namespace {

// A connector (id 1) between its parent 2, on the right, whose parent is 9, and its child 3, on the left. All have
// arrived.
class Folding : public ::testing::Test {
 protected:
  Folding() {
    bench.params.link_redundancy = 2;
    bench.params.line_of_sight = true;
    bench.state.role = Role::connector;
    bench.state.parent = 2;
    bench.state.subtree_workers = 1;
    auto& parent = bench.put(2, {0.45F, 0.0F});
    parent.role = Role::connector;
    parent.parent = 9;
    parent.subtree_workers = 1;
    auto& child = bench.put_child(3, {-0.45F, 0.0F}, Role::worker);
    child.subtree_workers = 1;
    child.need = parent.need = Need::no_need;
    bench.put(9, {0.85F, 0.25F}).role = Role::root;
  }
  bool wants() {
    auto robot = bench.tick();
    robot.self.want = want;
    return wants_fold(robot);
  }
  Vec2 motion() { return folding_motion(bench.tick()); }
  float want = 0.0F;
  ConvoyBench bench = grown<Convoy>();
};

TEST_F(Folding, AnEdgeLongerThanAKthOfALinkWantsASpare) {
  const float link = 0.96F;
  for (const int paths : {2, 3}) {
    bench.params.link_redundancy = paths;
    bench.move(2, {link / static_cast<float>(paths) - 0.005F, 0.0F});
    EXPECT_FALSE(wants()) << paths;
    bench.move(2, {link / static_cast<float>(paths) + 0.005F, 0.0F});
    EXPECT_TRUE(wants()) << paths;
  }
}

TEST_F(Folding, AHiddenEdgeWantsASpareToo) {
  ASSERT_FALSE(wants());
  bench.silence(2);
  for (int k = 0; k < 3; ++k) EXPECT_FALSE(wants()) << k;
  EXPECT_TRUE(wants());
}

TEST_F(Folding, ALongEdgeAsksForASpare) {
  bench.move(2, {0.45F, 0.0F});
  bench.steps(3);
  EXPECT_EQ(bench.state.need, Need::no_need);
  bench.move(2, {0.6F, 0.0F});
  bench.steps(3);
  EXPECT_EQ(bench.state.need, Need::need);
}

// The spare that robot 3 has chosen joins its edge to 2 near the middle, and not beside 3.
TEST_F(Folding, AChosenSpareJoinsNearTheMiddle) {
  const auto parent_at = [&](float along) {
    bench.state = Convoy::initial(1, false, false);
    bench.state.phase = Phase::grow_tree;
    bench.state.epoch = bench.say(2).epoch;
    bench.state.request = 3;
    bench.state.spare_state = SpareState::extend_edge;
    bench.put_connector(2, {0.4F - along, 0.125F}, 100, 60).parent = 9;
    auto& owner = bench.put_connector(3, {-0.4F - along, 0.125F}, 200, 50);
    owner.parent = 2;
    owner.need = Need::await;
    owner.grant = 1;
    bench.step();
    return bench.state.parent;
  };
  EXPECT_EQ(parent_at(-0.5F), nobody);
  EXPECT_EQ(parent_at(0.0F), 2);
}

TEST_F(Folding, OnlyWhereRobotsHideOthersAndAreNotMissed) {
  bench.move(2, {0.75F, 0.0F});
  ASSERT_TRUE(wants());
  const auto wants_if = [&, params = bench.params, state = bench.state](auto make_otherwise) {
    bench.params = params;
    bench.state = state;
    make_otherwise();
    return wants();
  };
  EXPECT_FALSE(wants_if([&] { bench.params.link_redundancy = 1; }));
  EXPECT_FALSE(wants_if([&] { bench.params.line_of_sight = false; }));
  EXPECT_FALSE(wants_if([&] { bench.params.thrift = 0.1F; }));
  EXPECT_FALSE(wants_if([&] { bench.state.forgets = true; })) << "more targets than it remembers";
  EXPECT_FALSE(wants_if([&] { bench.state.too_few_to_fold = true; }));
  EXPECT_FALSE(wants_if([&] { bench.state.call_hops = 5; })) << "an edge in need calls";
  EXPECT_TRUE(wants_if([&] { bench.state.call_hops = companion_call; }));
  want = 0.5F;
  EXPECT_FALSE(wants_if([] {})) << "it still travels";
}

// Wherever it joins, both new edges are short enough: else it would join right beside the robot that it accompanies.
RC_GTEST_FIXTURE_PROP(Folding, ASpareJoinsWhereBothEdgesGetShort, ()) {
  bench.state.role = Role::spare;
  bench.state.parent = nobody;
  const float edge = static_cast<float>(*rc::gen::inRange(100, 190)) * 0.005F;
  const float along = static_cast<float>(*rc::gen::inRange(-100, 100)) * 0.005F;
  const float aside = static_cast<float>(*rc::gen::inRange(0, 40)) * 0.005F;
  bench.move(2, {0.5F * edge - along, aside});
  bench.move(3, {-0.5F * edge - along, aside});
  bench.say(3).parent = 2;
  auto robot = bench.tick();
  const bool off = is_off_middle(robot, robot.table().find(3), robot.table().find(2));
  const float longer = std::max(norm(Vec2{0.5F * edge - along, aside}), norm(Vec2{-0.5F * edge - along, aside}));
  RC_ASSERT(off == (longer > 0.5F));
  bench.say(3).want = 128;  // an edge in need of a branch that travels is joined wherever both ends are in reach
  auto travels = bench.tick();
  RC_ASSERT(!is_off_middle(travels, travels.table().find(3), travels.table().find(2)));
}

TEST_F(Folding, LongEdgesDrawThoseToChildrenSooner) {
  EXPECT_LT(motion().x, -0.1F);
  bench.move(2, {0.8F, 0.0F});
  bench.say(9).role = Role::spare;
  EXPECT_GT(motion().x, 0.1F);  // but it does not leave its parent for that
  bench.move(2, {0.4F, 0.0F});
  bench.move(3, {-0.4F, 0.0F});
  EXPECT_NEAR(norm(motion()), 0.0F, 1e-3F);
}

TEST_F(Folding, MovesSidewaysUntilItHearsItsGrandparent) {
  bench.move(2, {0.4F, 0.0F});
  bench.move(3, {-0.4F, 0.0F});
  EXPECT_EQ(motion(), Vec2{});
  bench.silence(9);
  for (int k = 0; k < 10; ++k) motion();
  bench.state.phase_ticks = 0;
  const float first = motion().y;
  EXPECT_GT(std::abs(first), 0.3F);
  bench.state.phase_ticks = 40;
  EXPECT_LT(motion().y * first, 0.0F);  // then to the other side
  bench.params.rounds_per_drive = 2000.0F;
  EXPECT_GT(motion().y * first, 0.0F) << "a slow robot has come nowhere by then";
  bench.state.phase_ticks = 800;
  EXPECT_LT(motion().y * first, 0.0F);
  bench.say(2).need = Need::need;
  EXPECT_NEAR(motion().y, 0.0F, 1e-3F) << "it may be too far away";
}

TEST_F(Folding, WithThreePathsTheGrandparentsParentToo) {
  bench.params.link_redundancy = 3;
  bench.move(2, {0.25F, 0.0F});
  bench.move(3, {-0.25F, 0.0F});
  bench.say(9).role = Role::connector;
  bench.say(9).parent = 10;
  bench.put(10, {0.8F, 0.0F}).role = Role::root;
  EXPECT_EQ(motion(), Vec2{});
  bench.silence(10);
  for (int k = 0; k < 10; ++k) motion();
  EXPECT_NEAR(std::abs(motion().y), 0.17F, 0.01F) << "slower than for the grandparent";
  bench.params.link_redundancy = 2;
  bench.move(2, {0.4F, 0.0F});
  EXPECT_NEAR(motion().y, 0.0F, 1e-3F) << "two paths do not need it";
}

// A spare near robot 3, its parent 2 and that one's parent 9.
class BetweenFolds : public ::testing::Test {
 protected:
  BetweenFolds() {
    bench.params.link_redundancy = 2;
    bench.params.line_of_sight = true;
  }
  // Seen from the spare at `me`.
  Vec2 push(Vec2 me) {
    bench.put(9, far - me).role = Role::root;
    auto& m = bench.put(2, middle - me);
    m.role = Role::connector;
    m.parent = 9;
    auto& c = bench.put(3, near - me);
    c.role = Role::worker;
    c.parent = 2;
    return clear_folds(bench.tick(), 0.16F);
  }
  Vec2 near{-0.4F, 0.0F}, middle{0.0F, 0.2F}, far{0.4F, 0.0F};
  ConvoyBench bench = grown<Convoy>();
};

TEST_F(BetweenFolds, IsPushedAwayFromTheMiddleOne) {
  EXPECT_LT(push({0.05F, -0.05F}).y, -0.1F);
  EXPECT_EQ(push({0.05F, -0.2F}), Vec2{});  // far enough
  EXPECT_EQ(push({0.05F, 0.3F}), Vec2{});   // beyond the edges: those push it
  EXPECT_EQ(push({0.6F, -0.05F}), Vec2{});  // beside the line
  EXPECT_LT(norm(push({0.05F, -0.125F})), norm(push({0.05F, -0.025F})));
}

TEST_F(BetweenFolds, ASpareThatWaitsMakesWay) {
  push({0.05F, -0.06F});
  const float folded = waiting_motion(bench.tick()).y;
  bench.params.link_redundancy = 1;
  EXPECT_LT(folded, waiting_motion(bench.tick()).y - 0.1F);
}

TEST_F(BetweenFolds, OnlyWhereABranchFolds) {
  bench.params.line_of_sight = false;
  EXPECT_EQ(push({0.05F, -0.05F}), Vec2{});
  bench.params.line_of_sight = true;
  bench.params.link_redundancy = 1;
  EXPECT_EQ(push({0.05F, -0.05F}), Vec2{});
  bench.params.link_redundancy = 2;
  far = {0.65F, 0.0F};
  EXPECT_EQ(push({0.05F, -0.05F}), Vec2{});  // those two cannot hear each other anyhow
}

// From anywhere in the triangle the way leads out through the line between the two, whichever side it is on.
RC_GTEST_FIXTURE_PROP(BetweenFolds, LeavesTheTriangleThroughTheLine, ()) {
  const Vec2 turn = unit_vector(static_cast<float>(*rc::gen::inRange(0, 628)) * 0.01F);
  const float side = *rc::gen::arbitrary<bool>() ? 1.0F : -1.0F;
  middle.y *= side;
  const float a = static_cast<float>(*rc::gen::inRange(5, 90)) * 0.01F;
  const float b = static_cast<float>(*rc::gen::inRange(5, 95)) * 0.01F * (1.0F - a);
  Vec2 me = near * (1.0F - a - b) + middle * a + far * b;
  for (Vec2* at : {&near, &middle, &far, &me}) *at = rotate(turn, *at);
  for (int k = 0; k < 60; ++k) me += clamped(push(me), 1.0F) * 0.01F;
  RC_ASSERT(cross(far - near, me - near) * side < 0.0F);
  RC_ASSERT(norm(nearest_on_segment(near - me, far - me)) > 0.075F);
}

}  // namespace
}  // namespace banyan
