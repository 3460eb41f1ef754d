// SPDX-License-Identifier: MIT
// Alg. 1 against a brute-force centroid and Alg. 2 against recursion, on random trees of robots that take whole steps
// and talk over the wire.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "banyan/controller/core/trig.hpp"
#include "bench.hpp"
#include "over_the_wire.hpp"

namespace banyan::paper {
namespace {

using W = BasicVec2<double>;  // C

// Robots that stand still with random headings, frozen into a random tree; node 0 is the root.
struct PaperTree {
  std::vector<W> position, heading;
  std::vector<std::size_t> parent;
  std::vector<State> states;
  std::vector<Message> messages;
  Params params = outwards_column();

  explicit PaperTree(int size) : messages(static_cast<std::size_t>(size)) {
    const auto draw = [](double limit) { return limit * (*rc::gen::inRange(-10'000, 10'001)) / 10'000.0; };
    params.reconfiguration_drives = 200.0F;
    for (int i = 0; i < size; ++i) {
      parent.push_back(i == 0 ? 0 : static_cast<std::size_t>(*rc::gen::inRange(std::max(0, i - 6), i)));
      position.push_back(i == 0 ? W{draw(25), draw(25)}
                                : position[parent.back()] + W{draw(0.6), draw(0.6)} + W{0.005, 0.01});
      heading.push_back(unit_vector(draw(3.14)));
      State s = initial(static_cast<RobotId>(i), false, i == 0);
      s.role = i == 0 ? Role::root : Role::connector;
      s.epoch = 1;
      s.phase = Phase::grow_tree;
      s.root = {1, 0};
      s.label = static_cast<std::uint16_t>(i);
      if (i > 0) s.parent = static_cast<RobotId>(parent.back());
      s.committed = true;
      states.push_back(s);
    }
    // Leaves are workers, and a few others: a connector without a child would leave.
    for (std::size_t i = 1; i < states.size(); ++i)
      states[i].is_worker = i % 7 == 0 || std::find(parent.begin() + 1, parent.end(), i) == parent.end();
  }
  // Every robot hears its tree neighbours alone.
  void tick() {
    std::vector<Message> next = messages;
    for (std::size_t i = 0; i < states.size(); ++i) {
      std::vector<Message> packets;
      std::vector<Heard> heard;
      for (std::size_t j = 0; j < states.size(); ++j)
        if (j != i && (parent[i] == j || parent[j] == i) && messages[j].id != nobody)
          packets.push_back(*over_the_wire(messages[j]));
      for (const Message& m : packets) {
        const W d = rotate_back(heading[i], position[m.id] - position[i]) * double{test_platform.communication_range_m};
        heard.push_back({&m, {static_cast<float>(d.x), static_cast<float>(d.y)}});
      }
      Senses senses;
      senses.orders.sent = states[i].is_worker;
      next[i] =
          step(paper::outwards, paper::literal, params, states[i], Inputs<Heard>(heard, senses, test_platform)).message;
    }
    messages = next;
  }
  void settle() {
    for (std::size_t t = 0; t <= 2 * states.size() + 2; ++t) tick();
  }
  [[nodiscard]] int depth(std::size_t i) const { return i == 0 ? 1 : depth(parent[i]) + 1; }
  [[nodiscard]] bool is_below(std::size_t j, std::size_t i) const {
    return j != 0 && (parent[j] == i || is_below(parent[j], i));
  }
};

RC_GTEST_PROP(PaperCensus, Algorithm2CountsTheDescendants, ()) {
  const int size = *rc::gen::inRange(1, 40);
  PaperTree tree(size);
  tree.settle();
  for (std::size_t i = 0; i < tree.states.size(); ++i) {
    int descendants = 0, workers = tree.states[i].is_worker ? 1 : 0;
    for (std::size_t j = 0; j < tree.states.size(); ++j) {
      if (!tree.is_below(j, i)) continue;
      ++descendants;
      workers += tree.states[j].is_worker ? 1 : 0;
    }
    const Message& m = tree.messages[i];
    RC_ASSERT(m.depth == tree.depth(i));
    RC_ASSERT(m.count == tree.depth(i) + descendants);  // c_i = d_i + descendants
    RC_ASSERT(m.subtree == descendants + 1);
    RC_ASSERT(m.subtree_workers == workers);
  }
}

RC_GTEST_PROP(PaperCensus, Algorithm1FindsTheCentroidInTheRootsFrame, ()) {
  const int size = *rc::gen::inRange(1, 40);
  PaperTree tree(size);
  tree.settle();
  W sum{};
  for (const W p : tree.position) sum += p;
  const W expected = rotate_back(tree.heading[0], sum / static_cast<double>(size) - tree.position[0]);
  RC_ASSERT(std::fabs(static_cast<double>(tree.states[0].q.x) - expected.x) < 5e-4);
  RC_ASSERT(std::fabs(static_cast<double>(tree.states[0].q.y) - expected.y) < 5e-4);
}

// "each connector applies it in turn": the mean of what its children that are no spares send.
TEST(PaperCensus, PassesTheMeanOfThePullsUp) {
  BenchOf<Outwards> bench = grown<Outwards>();
  bench.state.parent = 9;
  bench.put(9, {0, 0.5F}).depth = 1;
  auto& a = bench.put_child(5, {-0.5F, 0}, Role::worker);
  a.pull_x = 8192;  // 0.5 along the edge to me: to the right
  a.want = 300;
  auto& b = bench.put_child(6, {0, -0.5F}, Role::connector);
  b.pull_x = 4096;  // 0.25 upwards
  b.want = 500;
  bench.put_child(7, {0.3F, 0}, Role::spare).pull_x = 16384;
  const auto m = bench.step().message;
  EXPECT_EQ(m.want, 500);
  // Along the edge to 9, which is upwards, and to the left of it.
  EXPECT_NEAR(m.pull_x, 0.125 * 16384, 2);
  EXPECT_NEAR(m.pull_y, -0.25 * 16384, 2);
}

TEST(PaperCensus, AWorkersPullIsTauAndFadesOnArrival) {
  BenchOf<Inwards> bench = grown<Inwards>();
  bench.state.parent = 9;
  bench.put(9, {0.5F, 0});
  for (const auto& [way, share] : {std::pair{2.0F, 1.0F}, {0.2F, 1.0F}, {0.05F, 0.5F}}) {
    bench.send({way, 0});
    EXPECT_NEAR(bench.step().message.pull_x, 0.2539F * share * 16384, 2) << way;
  }
  EXPECT_EQ(bench.step().message.want, 0) << "within the tolerance";
  bench.orders.target.reset();
  bench.state.target_known = false;
  EXPECT_GT(bench.step().message.want, 0) << "not told where to: it has not arrived";
}

}  // namespace
}  // namespace banyan::paper
