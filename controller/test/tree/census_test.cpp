// SPDX-License-Identifier: MIT
// Algorithms 1 and 2 of the paper on settled random trees of real controllers: counts and centroid
// against the truth that only the test knows.
#include "tree/census.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

#include "banyan/controller/core/trig.hpp"
#include "bench.hpp"
#include "over_the_wire.hpp"
#include "tree/tick.hpp"
#include "tree/tree_index.hpp"

namespace banyan {
namespace {

using W = BasicVec2<double>;

// Robots with random positions and headings that are frozen into a random tree; node 0 is the root.
struct Tree {
  std::vector<W> position, heading;
  std::vector<int> parent, depth;
  std::vector<TreeState> states;
  std::vector<TreeMessage> messages;
  ConvoyParams params = convoy_defaults();

  explicit Tree(int size) {
    const auto draw = [](double limit) { return limit * (*rc::gen::inRange(-10'000, 10'001)) / 10'000.0; };
    for (int i = 0; i < size; ++i) {
      parent.push_back(i == 0 ? -1 : *rc::gen::inRange(std::max(0, i - 6), i));
      depth.push_back(i == 0 ? 1 : depth[static_cast<std::size_t>(parent.back())] + 1);
      position.push_back(i == 0 ? W{draw(25), draw(25)}
                                : position[static_cast<std::size_t>(parent.back())] + W{draw(0.6), draw(0.6)} +
                                      W{0.005, 0.01});
      heading.push_back(unit_vector(draw(3.14)));
      TreeState s = initial_tree_state(static_cast<RobotId>(i), false, i == 0);
      s.is_worker = i > 0 && i % 7 == 0;
      s.role = i == 0 ? Role::root : s.is_worker ? Role::worker : Role::connector;
      s.epoch = 1;
      s.phase = Phase::grow_tree;
      s.root = {1, 0};
      s.parent = i == 0 ? nobody : static_cast<RobotId>(parent.back());
      s.depth = static_cast<std::uint16_t>(depth.back());
      states.push_back(s);
    }
    messages.resize(states.size());
  }

  // Every robot hears its tree neighbours over the wire and takes the census.
  void tick() {
    std::vector<TreeMessage> next = messages;
    for (std::size_t i = 0; i < states.size(); ++i) {
      std::vector<TreeMessage> packets;
      std::vector<Vec2> from;
      for (std::size_t j = 0; j < states.size(); ++j) {
        const bool neighbors = parent[i] == static_cast<int>(j) || parent[j] == static_cast<int>(i);
        if (!neighbors || messages[j].id == nobody) continue;
        packets.push_back(*over_the_wire(messages[j]));
        from.push_back(seen(i, j));
      }
      std::vector<Heard> heard;
      for (std::size_t k = 0; k < packets.size(); ++k) heard.push_back({&packets[k], from[k]});
      TreeState& s = states[i];
      const Inputs<Heard> inputs(heard, {}, test_platform);
      Workspace space(inputs);
      TreeRobot robot(params, s, inputs, space);
      file_heard(robot);
      forget_silent(
          robot, [](int) { return false; }, [](int, int) {});
      index_neighbors(robot);
      take_census(robot, params.arrival_distance);
      next[i] = message(i);
    }
    messages = next;
  }

  [[nodiscard]] Vec2 seen(std::size_t i, std::size_t j) const {
    const W d = rotate_back(heading[i], position[j] - position[i]);
    return {static_cast<float>(d.x), static_cast<float>(d.y)};
  }

  [[nodiscard]] TreeMessage message(std::size_t i) const {
    const TreeState& s = states[i];
    TreeMessage m;
    m.id = s.id;
    m.role = s.role;
    m.phase = s.phase;
    m.epoch = s.epoch;
    m.root = s.root;
    m.parent = s.parent;
    m.depth = s.depth;
    m.subtree = s.subtree;
    m.subtree_workers = s.subtree_workers;
    m.count = s.count;
    if (parent[i] >= 0) {
      // The edge frame, written out: x from the sender to its parent.
      const Vec2 e = unit(seen(i, static_cast<std::size_t>(parent[i])));
      m.q_x = dot(s.q, e);
      m.q_y = cross(e, s.q);
    }
    return m;
  }
};

RC_GTEST_PROP(Census, SumsAlgorithm2AndTheTruthAgreeOnSettledTrees, ()) {
  const int size = *rc::gen::inRange(1, 60);
  Tree tree(size);
  for (int t = 0; t <= 2 * size + 2; ++t) tree.tick();
  for (int i = 0; i < size; ++i) {
    int descendants = 0, workers = 0;
    for (int j = 0; j < size; ++j) {
      int k = j;
      while (k >= 0 && k != i) k = tree.parent[static_cast<std::size_t>(k)];
      if (k != i) continue;
      descendants += j != i ? 1 : 0;
      workers += tree.states[static_cast<std::size_t>(j)].is_worker ? 1 : 0;
    }
    const TreeState& s = tree.states[static_cast<std::size_t>(i)];
    RC_ASSERT(s.subtree == descendants + 1);
    RC_ASSERT(s.subtree_workers == workers);
    RC_ASSERT(s.count == tree.depth[static_cast<std::size_t>(i)] + descendants);  // c_i = d_i + descendants
  }
}

RC_GTEST_PROP(Census, Algorithm1FindsTheCentroidInTheRootsFrame, ()) {
  const int size = *rc::gen::inRange(1, 60);
  Tree tree(size);
  for (int t = 0; t <= 2 * size + 2; ++t) tree.tick();
  W sum{};
  for (const W p : tree.position) sum += p;
  const W expected = rotate_back(tree.heading[0], sum / static_cast<double>(size) - tree.position[0]);
  RC_ASSERT(std::fabs(static_cast<double>(tree.states[0].q.x) - expected.x) < 5e-4);
  RC_ASSERT(std::fabs(static_cast<double>(tree.states[0].q.y) - expected.y) < 5e-4);
}

TEST(Census, TheSpecsChainOfThree) {
  // Robots at 0, 1 and 2, the first is root: q2 = 1, q1 = 3, centroid 1.
  const Vec2 q2 = algorithm1_contribution({}, 0, {-1, 0});
  EXPECT_EQ(q2, (Vec2{1, 0}));
  const Vec2 q1 = algorithm1_contribution(q2, 1, {-1, 0});
  EXPECT_EQ(q1, (Vec2{3, 0}));
  EXPECT_EQ(q1 / 3.0F, (Vec2{1, 0}));
}

TEST(Census, AWorkerThatHasNotBeenToldWhereToHasNotArrived) {
  ConvoyBench bench = grown();
  bench.orders.sent = true;
  bench.step();
  EXPECT_TRUE(bench.state.is_worker);
  EXPECT_GT(bench.state.want, bench.params.arrival_distance);
  EXPECT_EQ(bench.state.pull, Vec2{}) << "nowhere to go yet";
}

TEST(Census, Algorithm2HasThreeCasesThatAreOne) {
  EXPECT_EQ(algorithm2_count(0, 0, 4), 4U);
  EXPECT_EQ(algorithm2_count(1, 9, 4), 9U);
  // Children of depth 5 with 2 and 0 descendants: c = 7 + 5; own: 4 + 4 descendants.
  EXPECT_EQ(algorithm2_count(2, 12, 4), 8U);
}

}  // namespace
}  // namespace banyan
