// SPDX-License-Identifier: MIT
// The roles that follow from the tree.
#include "tree/tree_index.hpp"

#include <gtest/gtest.h>

#include "bench.hpp"

namespace banyan {
namespace {

TEST(Role, FollowsFromTheTree) {
  ConvoyBench bench = grown();
  bench.step();
  EXPECT_EQ(bench.state.role, Role::spare);
  auto& child = bench.put(7, {0.5F, 0});
  child.parent = 1;
  bench.step();
  EXPECT_EQ(bench.state.role, Role::spare) << "a spare child makes no connector";
  child.role = Role::worker;
  bench.step();
  EXPECT_EQ(bench.state.role, Role::connector);
  child.parent = 9;
  child.old_parent = 1;
  bench.step();
  EXPECT_EQ(bench.state.role, Role::connector) << "an old child counts";
  child.old_parent = nobody;
  bench.steps(whole(bench.params.connector_rounds));
  EXPECT_EQ(bench.state.role, Role::connector);
  bench.step();
  EXPECT_EQ(bench.state.role, Role::spare);
  bench.state.root = {9, 1};
  EXPECT_EQ(bench.step().message.role, Role::root);
}

}  // namespace
}  // namespace banyan
