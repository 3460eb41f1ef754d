// SPDX-License-Identifier: MIT
// Two networks meet, each with a root.
#include "healing/healing.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <vector>

#include "watch.hpp"

namespace banyan {
namespace {

TEST(Election, ARootThatHearsOfALaterEpochOpensItsOwn) {
  ConvoyBench bench = grown<Convoy>();
  bench.state.root = {3, bench.state.id};
  auto& m = bench.put(20, {0.5F, 0.0F});
  m.root = {2, 77};
  m.epoch = 6;
  m.phase = Phase::grow_tree;
  bench.step();
  EXPECT_EQ(bench.state.epoch, 7);
  EXPECT_EQ(bench.state.phase, Phase::start_tree);
}

TEST(Election, TheLesserOfTwoRootsSteps) {
  ConvoyBench bench = grown<Convoy>();
  bench.state.root = {3, bench.state.id};
  bench.state.role = Role::root;
  bench.put(20, {0.5F, 0.0F}).root = {3, 77};
  bench.step();
  EXPECT_NE(bench.state.role, Role::root);
  EXPECT_EQ(bench.state.root, (RootToken{3, 77}));
}

TEST(RootSelection, TheLargerFragmentKeepsItsRoot) {
  ConvoyBench bench = handing_over();
  bench.state.phase = Phase::grow_tree;
  bench.state.root_size = 20;
  bench.say(5).root = {7, 30};
  bench.say(5).root_size = 19;
  bench.step();
  EXPECT_EQ(bench.state.root, (RootToken{8, 1}));
  EXPECT_EQ(bench.state.epoch, 2) << "all have to hear of it";
  bench.say(5).root = {9, 30};
  bench.say(5).root_size = 20;
  bench.step();
  EXPECT_EQ(bench.state.root, (RootToken{9, 30})) << "not smaller";
}

TEST(RootSelection, NobodyContestsItsOwnHandOver) {
  ConvoyBench bench = handing_over();
  bench.state.root_size = 20;
  EXPECT_EQ(bench.step().message.root_size, 20);
  bench.say(5).root = {2, 5};
  bench.say(5).root_size = 3;
  bench.step();
  EXPECT_EQ(bench.state.root, (RootToken{2, 5}));
  // The heir, whose acceptance was never heard, inherits the size and so yields to the old root.
  ConvoyBench heir = grown();
  heir.state.phase = Phase::select_root;
  auto& m = heir.put(9, {-0.5F, 0});
  m.root = {4, 9};
  m.root_size = 20;
  m.new_root = 1;
  heir.step();
  ASSERT_EQ(heir.state.root, (RootToken{5, 1}));
  EXPECT_EQ(heir.state.root_size, 20);
  m.root = {6, 9};
  m.new_root = nobody;
  heir.step();
  EXPECT_EQ(heir.state.root, (RootToken{6, 9}));
}

// Robots that hear each other, a tick late.
struct Network {
  ConvoyParams params = convoy_defaults();
  std::vector<ConvoyState> states;
  std::vector<Vec2> places;
  std::vector<ConvoyMessage> said;
  void add(RobotId id, Vec2 place, RootToken root) {
    states.push_back(initial_convoy_state(id, false, root.id == id));
    if (root.id == id) states.back().root = root;
    places.push_back(place);
    said.emplace_back();
  }
  void steps(int ticks) {
    for (int tick = 0; tick < ticks; ++tick) {
      std::vector<ConvoyMessage> next = said;
      for (std::size_t k = 0; k < states.size(); ++k) {
        std::vector<Heard> heard;
        for (std::size_t j = 0; j < states.size(); ++j)
          if (j != k && said[j].id != nobody && distance(places[j], places[k]) < 1.0F)
            heard.push_back({&said[j], places[j] - places[k]});
        next[k] = convoy_step(params, states[k], {heard, {}, test_platform}).message;
      }
      said = next;
    }
  }
  [[nodiscard]] std::vector<RobotId> roots() const {
    std::vector<RobotId> list;
    for (const ConvoyState& s : states)
      if (s.root.id == s.id) list.push_back(s.id);
    return list;
  }
};

RC_GTEST_PROP(Fragments, OfTwoRootsThatMeetTheOneOfTheLargerFragmentStays, ()) {
  const int left = *rc::gen::inRange(2, 12);
  const int right = left + *rc::gen::inRange(1, 10);
  const bool swap = *rc::gen::arbitrary<bool>();
  const auto sequence = [] { return *rc::gen::inRange<std::uint16_t>(1, 9); };
  Network network;
  const int counts[] = {swap ? right : left, swap ? left : right};
  RobotId id = 1;
  RobotId larger = nobody;
  for (int side = 0; side < 2; ++side) {
    const auto root = static_cast<RobotId>(id + *rc::gen::inRange(0, counts[side]));
    const RootToken token{sequence(), root};
    if (counts[side] == right) larger = root;
    for (int k = 0; k < counts[side]; ++k) {
      const float away = 0.75F + 0.4F * static_cast<float>(k);
      network.add(id++, {side == 0 ? -away : away, 0.05F * static_cast<float>(k % 3)}, token);
    }
  }
  network.steps(120);
  RC_ASSERT(network.roots().size() == 2U);
  for (Vec2& place : network.places) place.x += place.x < 0.0F ? 0.5F : -0.5F;
  network.steps(50);
  for (int k = 0; k < 100; ++k) {
    network.steps(1);
    RC_ASSERT(network.roots() == std::vector<RobotId>{larger});
  }
}

}  // namespace
}  // namespace banyan
