// SPDX-License-Identifier: MIT
// Branches are shortened, and no shortcut breaks the order of the tree.
#include "convoy/shortcut.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "chain.hpp"
#include "tree/parent_selection.hpp"

namespace banyan {
namespace {

TEST_F(ConvoyChain, AConnectorThatIsNotNeededAnyMoreIsReleased) {
  put_root({-0.65F, 0.3F});
  EXPECT_EQ(parent_after_shortcuts(), 9);
}

TEST_F(ConvoyChain, AConnectorIsKeptThatServesAnotherOrIsFarFromItsParent) {
  put_root({-0.65F, 0.3F});
  bench.say(2).child_count = 2;
  EXPECT_EQ(parent_after_shortcuts(), 2);
  bench.say(2).child_count = 1;
  bench.move(9, {-0.8F, 0.3F});
  EXPECT_EQ(parent_after_shortcuts(), 2);
}

// The same chain, arrived, where branches fold.
class FoldedChain : public ConvoyChain {
 protected:
  FoldedChain() {
    bench.params.link_redundancy = 2;
    bench.params.line_of_sight = true;
    bench.state.want = 0.0F;
    bench.state.subtree_workers = 1;
  }
};

// Where a branch folds, its short edges are needed: a robot is released only if that leaves a short one.
TEST_F(FoldedChain, AConnectorIsReleasedOnlyIfTheEdgeStaysShort) {
  auto restore = bench.state;
  put_root({-0.65F, 0.3F});
  EXPECT_EQ(parent_after_shortcuts(), 2);
  bench.state = restore;
  bench.move(9, {-0.35F, 0.25F});
  EXPECT_EQ(parent_after_shortcuts(), 9);
}

// Instead of a spare a robot whose edge is too long takes a parent that is near enough.
TEST_F(FoldedChain, ANearParentSavesASpare) {
  bench.state.need = Need::need;
  bench.say(2).child_count = 2;
  bench.move(2, {-0.6F, 0.0F});
  auto restore = bench.state;
  bench.put_connector(5, {-0.3F, 0.5F}, 120, 52);
  EXPECT_EQ(parent_after_shortcuts(), 2);
  bench.state = restore;
  bench.move(5, {-0.25F, 0.35F});
  EXPECT_EQ(parent_after_shortcuts(), 5);
}

// Whatever a robot hears, a shortcut never takes a parent that is behind it: no cycle can close.
RC_GTEST_PROP(Convoy, ShortcutsKeepTheOrderOfTheTree, ()) {
  ConvoyBench bench = grown<Convoy>();
  const auto below = [](int n) { return *rc::gen::inRange(0, n); };
  bench.state.role = below(2) == 0 ? Role::connector : Role::worker;
  bench.state.is_worker = bench.state.role == Role::worker;
  bench.state.parent = 2;
  bench.state.committed = true;
  bench.state.label = static_cast<std::uint16_t>(50 + below(200));
  bench.state.seqno = static_cast<std::uint16_t>(40 + below(20));
  const int count = 2 + below(8);
  for (int k = 0; k < count; ++k) {
    auto& m = bench.put(static_cast<RobotId>(2 + k),
                        {static_cast<float>(below(360) - 180) * 0.005F, static_cast<float>(below(360) - 180) * 0.005F});
    m.role = static_cast<Role>(below(4));
    m.parent = below(3) == 0 ? nobody : static_cast<RobotId>(1 + below(count + 2));
    m.label = static_cast<std::uint16_t>(below(300));
    m.seqno = static_cast<std::uint16_t>(40 + below(20));
    m.depth = static_cast<std::uint16_t>(below(5));
    m.tree_hops = static_cast<std::uint8_t>(below(3));
    m.child_count = static_cast<std::uint8_t>(below(3));
    m.committed = true;
  }
  for (int t = 0; t < 4; ++t) {
    if (t == 1 && below(2) == 0) bench.silence(2);
    auto robot = bench.tick();
    const auto before = bench.state;
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
