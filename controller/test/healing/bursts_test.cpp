// SPDX-License-Identifier: MIT
// Where packets get lost many in a row: nobody moves out of what holds the network.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "bench.hpp"
#include "healing/healing.hpp"
#include "healing/link_guard.hpp"
#include "tree/motion.hpp"

namespace banyan {
namespace {

// One end of an edge: it wants to go somewhere at full speed, and goes where its guard lets it.
struct End {
  ConvoyBench bench;
  Vec2 place;
  Vec2 wish{};
  bool hears = true;
  int left = 0;  // ticks until that changes

  End(RobotId id, Vec2 at) : bench(id), place(at) {
    bench.state.epoch = 1;
    bench.state.phase = Phase::grow_tree;
    bench.state.root = {1, 9};
    bench.state.role = Role::connector;
  }
  Vec2 step(const End& other) {
    bench.state.burst_ticks = 100;
    if (hears) bench.move(other.bench.state.id, other.place - place);
    const auto said = bench.say(other.bench.state.id);
    if (!hears) bench.silence(other.bench.state.id);
    auto robot = bench.tick({moved.x, moved.y, 0.0F});
    bench.put(other.bench.state.id, other.place - place) = said;
    Guard guard;
    guard_edges(robot, true, guard);
    return moved = allowed(wish, guard, robot.params) * robot.params.way_in_a_round();
  }
  Vec2 moved{};
};

constexpr float step = 0.01F;  // what a robot drives in two ticks: silences of two ticks count for nothing

// A parent and its child, each of which hears the other now and then and wants to go anywhere.
struct Pair {
  End parent{1, {}}, child;
  std::minstd_rand random;

  Pair(float start, unsigned seed) : child(2, {start, 0.0F}), random(seed) {
    parent.bench.put_child(2, child.place, Role::connector);
    child.bench.put_connector(1, -child.place, 100, 1);
    child.bench.state.parent = 1;
  }
  int below(int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); }
  // Silences of up to 19 s.
  void tick(int now) {
    for (End* end : {&parent, &child}) {
      if (end->left-- <= 0) {
        end->hears = !end->hears || now == 0;
        end->left = end->hears ? below(30) : below(190);
      }
      if (below(10) == 0)
        end->wish = unit(Vec2{static_cast<float>(below(201) - 100), static_cast<float>(below(200)) - 99.5F});
    }
    const Vec2 of_parent = parent.step(child);
    const Vec2 of_child = child.step(parent);
    parent.place += of_parent;
    child.place += of_child;
  }
};

// While neither hears the other, both could go round the place where the other was, in opposite directions. What each
// can see to is that it stays as near to that place as it was, or as an edge may be long.
RC_GTEST_PROP(Bursts, WhoHearsNothingGoesNoFartherFromWhereItHeardTheOther, ()) {
  Pair pair(0.005F * static_cast<float>(*rc::gen::inRange(20, 189)), *rc::gen::inRange(1U, 1000000U));
  std::array<Vec2, 2> there{pair.child.place, pair.parent.place};
  std::array<float, 2> longest{};
  for (int now = 0; now < 300; ++now) {
    const std::array<Vec2, 2> before{pair.child.place, pair.parent.place};
    const std::array<const End*, 2> ends{&pair.parent, &pair.child};
    pair.tick(now);
    for (std::size_t e = 0; e < 2; ++e) {
      if (ends[e]->hears) {
        there[e] = before[e];
        longest[e] = std::max(distance(ends[e]->place, there[e]), ends[e]->bench.params.ideal_distance);
      } else {
        RC_ASSERT(distance(ends[e]->place, there[e]) <= longest[e] + step);
      }
    }
  }
}

// The burst that a robot notes when a neighbour comes back after so many ticks.
int noted_after(int ticks, Vec2 at, bool line_of_sight, int neighbors_at_start = 0, int usual_ticks = 0,
                bool forgets = false) {
  ConvoyBench bench = grown<Convoy>();
  bench.params.line_of_sight = line_of_sight;
  bench.state.neighbors_at_start = static_cast<std::uint8_t>(neighbors_at_start);
  bench.state.usual_silence = static_cast<std::uint8_t>(usual_ticks);
  bench.state.forgets = forgets;
  bench.put(20, at);
  bench.steps(5);
  const auto said = bench.say(20);
  bench.silence(20);
  bench.steps(ticks);
  bench.put(20, at) = said;
  bench.step();
  return bench.state.burst_ticks;
}

TEST(Bursts, ASilenceBeyondWhatChanceExplainsIsOne) {
  EXPECT_EQ(noted_after(8, {0.5F, 0.0F}, false), 0) << "less than 2 I";
  EXPECT_NEAR(noted_after(30, {0.5F, 0.0F}, false), 30, 2);
  EXPECT_EQ(noted_after(30, {0.975F, 0.0F}, false), 0) << "it may have been out of range";
  EXPECT_EQ(noted_after(30, {0.5F, 0.0F}, true), 0) << "something may have hidden it";
  EXPECT_EQ(noted_after(120, {0.5F, 0.0F}, false), 0) << "too long ago to be watched";
}

// A thin start has few bodies, and what hides a robot seldom hides it for long.
TEST(Bursts, WithLineOfSightTheFirstIsNotedInAThinStartOrAfterLongSilences) {
  EXPECT_NEAR(noted_after(30, {0.5F, 0.0F}, true, 2), 30, 2);
  EXPECT_EQ(noted_after(8, {0.5F, 0.0F}, true, 2), 0) << "less than 2 I";
  EXPECT_EQ(noted_after(30, {0.5F, 0.0F}, true, 0, 40), 0);
  EXPECT_NEAR(noted_after(30, {0.5F, 0.0F}, true, 0, 80), 30, 2) << "long silences are usual";
  EXPECT_EQ(noted_after(30, {0.5F, 0.0F}, true, 0, 80, true), 0) << "but with so many targets bodies make them";
  EXPECT_NEAR(noted_after(30, {0.5F, 0.0F}, true, 2, 0, true), 30, 2);
}

TEST(Bursts, WithLineOfSightOneThatOthersKnowOfMakesARobotWatch) {
  ConvoyBench bench = grown<Convoy>();
  bench.params.line_of_sight = true;
  bench.put(20, {0.5F, 0.0F});
  set_burst(bench.put(21, {-0.5F, 0.0F}), 20);
  bench.steps(5);
  EXPECT_NEAR(bench.state.burst_ticks, 20, 1) << "told by another";
  const auto said = bench.say(20);
  bench.silence(20);
  bench.steps(60);
  bench.put(20, {0.5F, 0.0F}) = said;
  bench.step();
  EXPECT_NEAR(bench.state.burst_ticks, 60, 2);
}

// However many packets get lost: silences by chance are none.
TEST(Bursts, LostPacketsAloneMakeNone) {
  std::minstd_rand random(1);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same cases every time
  for (const unsigned lost_percent : {15U, 30U, 60U, 90U}) {
    ConvoyBench bench = grown<Convoy>();
    bench.params.line_of_sight = false;
    for (int tick = 0; tick < 3000; ++tick) {
      for (RobotId id = 20; id < 26; ++id) {
        bench.silence(id);
        if (random() % 100 >= lost_percent) bench.put(id, {0.025F * static_cast<float>(id), 0.25F});
      }
      bench.step();
      ASSERT_EQ(bench.state.burst_ticks, 0) << lost_percent << " % lost, tick " << tick;
    }
  }
}

TEST(Bursts, ThatAreKnownMakePatientAndArePassedOn) {
  ConvoyBench bench = grown<Convoy>();
  bench.params.line_of_sight = false;
  bench.put_child(20, {0.5F, 0.0F}, Role::connector);
  set_burst(bench.put_connector(21, {0.0F, 0.5F}, 100, 1), 40);
  bench.state.role = Role::connector;
  bench.state.parent = 21;
  bench.steps(3);
  EXPECT_EQ(burst_of(bench.step().message), 40);
  bench.silence(20);
  bench.put_connector(22, {0.25F, 0.5F}, 100, 1);
  bench.steps(3);
  bench.silence(22);
  bench.steps(60);
  const auto robot = bench.tick();
  EXPECT_EQ(robot.children.size, 1) << "it is still there";
  EXPECT_EQ(robot.table().find(22), -1) << "who matters to nobody is forgotten after I";
}

// Far away, the signal may have faded; near by, whoever is silent will be heard again.
TEST(Bursts, WhoHearsNothingOfAFarNeighbourComesNearer) {
  for (const float range : {0.925F, 0.75F}) {
    ConvoyBench bench = grown<Convoy>();
    bench.params.line_of_sight = false;
    bench.put_child(20, {range, 0.0F}, Role::connector);
    bench.state.role = Role::connector;
    bench.steps(3);
    bench.state.burst_ticks = 40;
    bench.silence(20);
    bench.steps(10);
    const auto robot = bench.tick();
    Guard guard;
    guard_edges(robot, false, guard);
    EXPECT_EQ(guard.apply({}).x > 0.0F, range > 0.9F) << range;
  }
}

// Who hears it need not be heard by it: for a new edge both have to know.
TEST(Bursts, OnlyWhoHasHeardMeOfLateIsSure) {
  ConvoyBench bench = grown<Convoy>();
  bench.params.line_of_sight = false;
  bench.put(20, {0.5F, 0.0F});
  bench.steps(3);
  const auto sure = [&](int deaf_ticks, int burst_ticks) {
    bench.state.burst_ticks = static_cast<std::uint8_t>(burst_ticks);
    auto robot = bench.tick();
    const int k = robot.table().find(20);
    bench.state.neighbors.set_deaf(k, deaf_ticks);
    return robot.is_sure(k);
  };
  EXPECT_TRUE(sure(0, 40));
  EXPECT_FALSE(sure(1, 40));
  EXPECT_TRUE(sure(1, 0)) << "without bursts once may be chance";
}

}  // namespace
}  // namespace banyan
