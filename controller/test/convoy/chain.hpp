// SPDX-License-Identifier: MIT
// A robot within a chain of convoy, for the tests of its rules.
#pragma once

#include <gtest/gtest.h>

#include "bench.hpp"
#include "convoy/shortcut.hpp"
#include "convoy/towing.hpp"

namespace banyan {

// A connector (id 1) of the chain 9 (root) - 2 - 1 - 3 (worker with 2 C to go).
class ConvoyChain : public ::testing::Test {
 protected:
  ConvoyChain() {
    bench.state.role = Role::connector;
    bench.state.parent = 2;
    bench.state.committed = true;
    bench.state.label = 200;
    bench.state.seqno = 50;
    auto& parent = bench.put(2, {-0.5F, 0.0F});
    parent.role = Role::connector;
    parent.parent = 9;
    parent.label = 100;
    parent.seqno = 51;
    parent.depth = 2;
    parent.committed = true;
    parent.child_count = 1;
    auto& child = bench.put(3, {0.8F, 0.0F});
    child.role = Role::worker;
    child.parent = 1;
    child.label = 300;
    child.seqno = 49;
    child.depth = 4;
    child.want = 512;
    child.committed = true;
  }
  ConvoyMessage& put_root(Vec2 position) {
    auto& root = bench.put(9, position);
    root.role = Role::root;
    root.label = 0;
    root.seqno = 53;
    root.depth = 1;
    root.committed = true;
    return root;
  }
  Vec2 motion() { return towed_motion(bench.tick()); }
  RobotId parent_after_shortcuts() {
    auto robot = bench.tick();
    take_shortcuts(robot);
    return bench.state.parent;
  }
  ConvoyBench bench = grown<Convoy>();
};

}  // namespace banyan
