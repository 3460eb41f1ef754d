// SPDX-License-Identifier: MIT
// Who has no parent has a hold, by the order of the tree, and both ends keep the link.
#include "healing/hold.hpp"
#include "healing/link_guard.hpp"

#include <gtest/gtest.h>

#include <random>

#include "bench.hpp"
#include "healing/healing.hpp"
#include "tree/motion.hpp"

namespace banyan {
namespace {

// A spare of the grown tree with a label; 2 is a robot of the tree, 3 a spare that has 2 as its hold.
struct Follower {
  ConvoyBench bench = grown<Convoy>();
  Follower() {
    bench.state.role = Role::spare;
    bench.state.label = 300;
    bench.state.seqno = 10;
    bench.put_connector(2, {0.6F, 0.0F}, 100, 11);
    auto& spare = bench.put(3, {0.2F, 0.0F});
    spare.grant = 2;
    spare.tree_hops = 1;
    spare.label = 200;
    spare.seqno = 11;
  }
  RobotId hold() {
    auto robot = bench.tick();
    find_hold(robot);
    return bench.state.hold;
  }
  // Fastest motion that the links allow in a direction, v_max.
  float allowed(Vec2 direction, bool lets_go = false) {
    auto robot = bench.tick();
    estimate_loss(robot);
    find_hold(robot);
    Guard guard;
    guard_links(robot, lets_go, guard);
    return dot(guard.apply(direction * robot.params.speed_gain), direction);
  }
};

TEST(Hold, IsOfTheTreeAndItSaysSo) {
  Follower f;
  EXPECT_EQ(f.hold(), 2) << "farther than the spare, but of the tree";
  EXPECT_EQ(f.bench.step().message.grant, 2);
  f.bench.move(2, {0.9F, 0.0F});
  EXPECT_EQ(f.hold(), 3) << "a spare rather than a link that is strained";
  f.bench.silence(3);
  EXPECT_EQ(f.hold(), 3) << "still alive";
  f.bench.steps(2 * whole(f.bench.params.liveness_rounds));
  EXPECT_EQ(f.bench.state.hold, 2) << "the strained link is better than none";
}

// It might leave without knowing of me.
TEST(Hold, IsRatherOneThatHasNotPassedMeOver) {
  Follower f;
  EXPECT_EQ(f.hold(), 2);
  const auto pass_over = [&](RobotId id) {  // that is called 1, and comes before 7
    f.bench.say(id).count = 9;
    f.bench.step();
    f.bench.say(id).count = 7;
  };
  pass_over(2);
  EXPECT_EQ(f.hold(), 3) << "once is enough where there is another";
  pass_over(3);
  EXPECT_EQ(f.hold(), 2) << "better than none";
}

// A robot that turned to another whenever it came a little nearer would get nowhere.
TEST(Hold, IsKeptWhileNoOtherIsClearlyBetter) {
  for (const RobotId held : {RobotId{3}, RobotId{4}}) {
    Follower f;
    f.bench.silence(2);
    f.bench.put(4, {0.15F, 0.0F}) = f.bench.say(3);
    f.bench.say(4).id = 4;
    f.bench.state.hold = held;
    EXPECT_EQ(f.hold(), held) << "both are spares of the same hops";
    f.bench.say(4).tree_hops = 0;
    EXPECT_EQ(f.hold(), 4) << "of the tree";
  }
}

// As hold.cpp describes it: each term outweighs all that follow.
double hold_cost(double range, int hops, bool another) {
  if (range > 0.95) return 8192 + 1024 * range + (another ? 10 : 0) + hops / 255.0;
  return (hops == 255 ? 4096 : 0) + (range > 0.85 ? 2048 : 0) + 4 * hops + (another ? 2 : 0) + range;
}

// A branch whose root is lost may hang on me in a while, however near it is.
// The search passes over those whose hops alone cost more than the best so far.
TEST(Hold, IsTheBestOfAllInWhateverOrderTheyAreHeard) {
  std::mt19937 random(7);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same cases every time
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  for (int world = 0; world < 300; ++world) {
    ConvoyBench bench = grown<Convoy>();
    bench.state.role = Role::spare;
    bench.state.label = 300;
    bench.state.seqno = 10;
    const int robots = 2 + below(30);
    bench.state.hold = static_cast<RobotId>(2 + below(2 * robots));
    RobotId best = nobody;
    double least = 1e9;
    for (int k = 0; k < robots; ++k) {
      const auto id = static_cast<RobotId>(2 + k);
      const float range = 0.025F + 0.000975F * static_cast<float>(below(1000));
      auto& m = bench.put(id, {range, 0.0F});
      const bool ahead = below(3) > 0;
      m.role = below(4) == 0 ? Role::connector : Role::spare;
      m.parent = m.role == Role::connector ? RobotId{999} : nobody;
      m.grant = 999;
      m.depth = static_cast<std::uint16_t>(m.role == Role::connector ? below(2) : 0);
      m.tree_hops = static_cast<std::uint8_t>(below(5) == 0 ? unreachable : below(9));
      m.label = 200;
      m.seqno = ahead ? 11 : 9;
      if (!ahead) continue;
      const int hops = m.role == Role::spare ? m.tree_hops : m.depth == 0 ? unreachable : -1;
      const double cost = hold_cost(static_cast<double>(range), hops, hops >= 0 && id != bench.state.hold);
      if (cost >= least) continue;
      best = id;
      least = cost;
    }
    auto robot = bench.tick();
    find_hold(robot);
    ASSERT_EQ(bench.state.hold, best) << "world " << world << " of " << robots;
  }
}

TEST(Hold, IsNotOfALostBranchAsLongAsThereIsAnother) {
  Follower f;
  f.bench.move(2, {0.9F, 0.0F});
  f.bench.say(3).tree_hops = unreachable;
  EXPECT_EQ(f.hold(), 2) << "rather the strained link";
  f.bench.say(2).depth = invalid_depth;
  EXPECT_EQ(f.hold(), 3) << "both are lost";
}

// By the labels of the new epoch a robot may be ahead that hangs on me by the old tree.
TEST(Hold, OfTheLastEpochStaysWhileOthersHangOnMeByIt) {
  for (const Phase phase : {Phase::start_tree, Phase::select_parent, Phase::grow_tree}) {
    for (const bool child : {false, true}) {
      Follower f;
      f.bench.state.phase = phase;
      f.bench.state.hold = 3;
      if (child) f.bench.put(4, {0.0F, 0.5F}).old_parent = 1;
      EXPECT_EQ(f.hold(), child && phase < Phase::grow_tree ? 3 : 2);
    }
  }
}

TEST(Hold, IsAheadInTheOrder) {
  Follower f;
  f.bench.say(2).seqno = 9;
  f.bench.say(3).seqno = 9;
  EXPECT_EQ(f.hold(), nobody) << "both may hang on me";
  f.bench.say(3).seqno = 10;
  EXPECT_EQ(f.hold(), 3) << "as fresh, and nearer to the root";
  f.bench.say(3).label = 400;
  EXPECT_EQ(f.hold(), nobody);
}

TEST(Hold, IsNobodyWhoIsTiedToNobody) {
  Follower f;
  f.bench.say(2).parent = nobody;
  f.bench.say(3).grant = nobody;
  EXPECT_EQ(f.hold(), nobody);
  f.bench.say(2).role = Role::root;
  EXPECT_EQ(f.hold(), 2);
}

// The one of the tree that it would like best is behind: it waits for it, and has the other meanwhile.
TEST(Hold, KeepsUpOnlyWithTheOneItWouldLikeBest) {
  Follower f;
  f.bench.say(2).seqno = 8;
  f.bench.say(3).seqno = 12;
  EXPECT_EQ(f.hold(), 3);
  EXPECT_EQ(f.bench.state.seqno, 10);
  f.bench.say(2).seqno = 12;
  EXPECT_EQ(f.hold(), 2);
  EXPECT_EQ(f.bench.state.seqno, 12);
}

// One that is no nearer to the tree than I am may hang on me: it would never get ahead.
TEST(Hold, WaitsForNobodyWhoIsFartherFromTheTree) {
  for (const int my_hops : {1, 2}) {
    Follower f;
    f.bench.move(2, {0.9F, 0.0F});
    f.bench.say(2).seqno = 12;
    f.bench.say(3).seqno = 8;
    f.bench.state.tree_hops = static_cast<std::uint8_t>(my_hops);
    EXPECT_EQ(f.hold(), 2) << "3 is behind";
    EXPECT_EQ(f.bench.state.seqno, my_hops > 1 ? 10 : 12) << "it is 3 that it would like best, if 3 could get ahead";
  }
}

TEST(Hold, OfTheLastEpochWillDoUntilTheFloodComesBy) {
  Follower f;
  EXPECT_EQ(f.hold(), 2);
  f.bench.state.epoch = 2;
  f.bench.state.label = unknown_label;
  EXPECT_EQ(f.hold(), 2);
  f.bench.state.label = 300;
  EXPECT_EQ(f.hold(), nobody) << "2 has not been labelled yet";
}

TEST(Hold, IsNotLeftBehindAndDoesNotLeave) {
  Follower f;
  f.bench.silence(3);
  f.bench.move(2, {0.94F, 0.0F});
  f.bench.steps(20);
  EXPECT_EQ(f.bench.state.hold, 2);
  EXPECT_NEAR(f.allowed({-1.0F, 0.0F}), 0.1F, 5e-4F) << "(0.95 C - d) / 2 times the guard's rate of 20";
  EXPECT_NEAR(f.allowed({1.0F, 0.0F}), 1.0F, 5e-4F);
  f.bench.silence(2);
  auto& other = f.bench.put(5, {0.94F, 0.0F});
  other.grant = f.bench.state.id;
  EXPECT_NEAR(f.allowed({-1.0F, 0.0F}, true), 0.1F, 5e-4F) << "who has me as its hold is not left, even on a retreat";
}

// It may only not be heard, and have driven away since.
TEST(Hold, WhoFallsSilentIsNotLeftAtOnceWherePacketsGetLost) {
  const auto allowed_after = [](int ticks, std::uint8_t usual_silence, Vec2 way = {0.0F, 1.0F}) {
    Follower f;
    f.bench.state.turn = 200;  // no thin start
    f.bench.put(5, way * 0.85F).grant = f.bench.state.id;
    f.bench.steps(3);
    f.bench.silence(5);
    for (int k = 0; k < ticks; ++k) {
      f.bench.state.usual_silence = usual_silence;
      f.bench.step();
    }
    f.bench.state.usual_silence = usual_silence;
    return f.allowed(-way);
  };
  EXPECT_NEAR(allowed_after(1, 32), 1.0F, 5e-4F) << "0.1 C is left: full speed";
  EXPECT_NEAR(allowed_after(4, 32), 1.0F, 5e-4F) << "I allows for that";
  EXPECT_NEAR(allowed_after(6, 32), 0.5F, 5e-4F) << "it may be 0.05 C farther";
  EXPECT_LE(allowed_after(40, 32), 0.0F) << "0.3 C farther";
  EXPECT_NEAR(allowed_after(70, 32), 1.0F, 5e-4F) << "after twice the usual silence it is gone";
  EXPECT_NEAR(allowed_after(7, 0), 1.0F, 5e-4F) << "where nothing gets lost, after I";
  EXPECT_NEAR(allowed_after(40, 32, {1.0F, 0.0F}), 1.0F, 5e-4F) << "robots 2 and 3 may hide it";
}

// A worker that waits for the first tree is drawn back the more, the farther its hold is: a hand's breadth does not
// turn it about.
TEST(Hold, DrawsAWorkerBackLittleByLittle) {
  Follower f;
  f.bench.state.turn = 100;  // no longer the first seconds of a thin start
  f.bench.silence(3);
  f.bench.params.drive = Drive::holonomic;
  f.bench.state.phase = f.bench.say(2).phase = Phase::start_tree;
  f.bench.send({0.0F, 2.5F});
  const auto heads_for = [&](float away) {
    f.bench.move(2, {away, 0.0F});
    const Motion v = f.bench.step().motion;
    EXPECT_EQ(f.bench.state.hold, 2);
    return unit(Vec2{v.forward, v.sideways});
  };
  EXPECT_GT(heads_for(0.6F).y, 0.99F) << "near it goes to its target";
  EXPECT_GT(heads_for(0.925F).x, 0.99F) << "far it goes back";
  const float recruitment = f.bench.params.recruitment_distance;
  EXPECT_GT(dot(heads_for(recruitment - 0.005F), heads_for(recruitment + 0.005F)), 0.9F);
}

TEST(Hold, NobodyLeavesWhoHasNone) {
  Follower f;
  f.bench.silence(2);
  f.bench.move(3, {0.94F, 0.0F});
  f.bench.say(3).grant = nobody;
  EXPECT_NEAR(f.allowed({-1.0F, 0.0F}), 0.1F, 5e-4F);
  f.bench.put(2, {0.25F, 0.0F}).parent = 9;
  f.bench.state.role = Role::worker;
  f.bench.state.parent = 2;
  EXPECT_NEAR(f.allowed({-1.0F, 0.0F}), 0.1F, 5e-4F) << "nor a robot of the tree";
  f.bench.say(3).grant = 77;
  EXPECT_NEAR(f.allowed({-1.0F, 0.0F}), 1.0F, 5e-4F) << "it is somebody else's";
}

// In the first tick nobody is heard: a worker may turn, but not go.
TEST(Hold, BeforeAnybodyIsHeardNobodyDrives) {
  ConvoyBench convoy;
  convoy.state = Convoy::initial(1, true, false);
  convoy.send({0.0F, 2.5F});
  EXPECT_NEAR(convoy.step().motion.forward, 0.0F, 5e-3F);
  EXPECT_GT(convoy.step().motion.turn, 5.0F);
}

}  // namespace
}  // namespace banyan
