// SPDX-License-Identifier: MIT
// A worker that gets no nearer to its target leaves it to others.
#include "healing/healing.hpp"

#include <gtest/gtest.h>

#include "watch.hpp"

namespace banyan {
namespace {

constexpr RobotId sent_worker = 1;
constexpr int a_drive = 100;  // ticks

// A worker beside the root, sent to a target; what it knows of its own motion is that it does not move.
struct Worker : Watch {
  explicit Worker(Vec2 target, Vec2 root = {0.25F, 0.0F}) : Watch(root) {
    bench.state = initial_convoy_state(sent_worker, true, false);
    bench.params.give_up_after_drives = 1.0F;
    bench.send(target);
    hear_root(20);
    EXPECT_TRUE(bench.state.is_worker);
  }
  [[nodiscard]] bool serves() const { return bench.state.is_worker; }
  // At every one of these ticks: who gives up tries again after a while.
  [[nodiscard]] bool serves_for(int ticks) {
    bool always = serves();
    for (int tick = 0; tick < ticks; ++tick) {
      hear_root(1);
      always = always && serves();
    }
    return always;
  }
};

TEST(Progress, AWorkerThatDrivesInVainGivesUp) {
  Worker worker({1.5F, 0.0F});
  worker.hear_root(a_drive - 30);
  ASSERT_GT(worker.bench.step().motion.forward, 0.25F);
  EXPECT_TRUE(worker.serves());
  worker.hear_root(60);
  EXPECT_FALSE(worker.serves());
  EXPECT_EQ(find_task(worker.bench.state, sent_worker)->holder, sent_worker) << "not given up: silent";
  EXPECT_GT(find_task(worker.bench.state, sent_worker)->age_ticks, 0);
}

TEST(Progress, OneThatGetsOnDoesNot) {
  Worker worker({1.5F, 0.0F});
  for (int tick = 0; tick < 400; ++tick) {
    worker.bench.send({1.5F - 0.00125F * static_cast<float>(tick), 0.0F});
    worker.hear_root(1);
  }
  EXPECT_TRUE(worker.serves());
}

TEST(Progress, NorOneThatWaitsForOthers) {
  Worker worker({1.5F, 0.0F}, {-0.9F, 0.0F});
  worker.bench.move(root_id, {-0.95F, 0.0F});  // its edge is as long as it may be
  EXPECT_TRUE(worker.serves_for(600));
}

// ... nor one that is pulled back as often as it gets on.
TEST(Progress, ToAndFroIsNoDrive) {
  Worker worker({1.5F, 0.0F});
  for (int k = 0; k < 40; ++k) {
    worker.bench.move(root_id, {k % 2 == 0 ? -0.995F : 0.25F, 0.0F});
    ASSERT_TRUE(worker.serves_for(k % 2 == 0 ? 60 : 20));
  }
}

// A worker that moves as the test says: `forward` in each of the ticks.
struct Driven : Worker {
  float left = 1.5F;
  using Worker::Worker;
  void drive(int ticks, float forward, bool root_beats = true) {
    for (int k = 0; k < ticks; ++k) {
      bench.send({left -= forward, 0.0F});
      if (root_beats) bench.say(root_id).heartbeat = count++;
      bench.step({forward, 0.0F, 0.0F});
    }
  }
};

// ... nor one that has been led away, as far as it may drive in vain, and comes back.
TEST(Progress, TheWayItWasLedAwayItMayDriveAgain) {
  Driven worker({1.5F, 0.0F});
  worker.bench.move(root_id, {-0.995F, 0.0F});  // too far: it follows
  worker.drive(2 * a_drive, -0.01F);
  worker.bench.move(root_id, {0.25F, 0.0F});
  worker.drive(2 * a_drive, 0.009F);
  EXPECT_TRUE(worker.serves());
}

// ... or has gone by itself, because it heard of no root.
TEST(Progress, AfterARetreatTheWayBeginsAnew) {
  Driven worker({1.5F, 0.0F});
  worker.drive(a_drive - 70, 0.0F);
  worker.drive(a_drive, -0.01F, false);
  worker.drive(a_drive / 2, 0.009F);
  EXPECT_TRUE(worker.serves());
}

TEST(Progress, NorOneThatIsThere) {
  Worker worker({0.025F, 0.0F});
  EXPECT_TRUE(worker.serves_for(600));
}

TEST(Progress, InSightOfObstaclesItLooksForAWayForLong) {
  Worker worker({1.5F, 0.0F});
  worker.bench.obstacles = {{-0.125F, 0.0F}};
  worker.hear_root(14 * a_drive);
  EXPECT_TRUE(worker.serves());
  worker.hear_root(5 * a_drive);
  EXPECT_FALSE(worker.serves());
}

// A long corridor: walls in sight all the time, and it gets on.
TEST(Progress, AlongWallsItMayDriveForever) {
  Worker worker({9.75F, 0.0F});
  worker.bench.obstacles = {{-0.125F, 0.0F}};
  constexpr float a_tick = 0.00375F;
  for (int tick = 1; tick <= 25 * a_drive; ++tick) {
    worker.bench.send({9.75F - a_tick * static_cast<float>(tick), 0.0F});
    worker.hear_root(1, {.forward_m = a_tick});
    ASSERT_TRUE(worker.serves()) << tick;
  }
}

TEST(Progress, AndBehindATargetThatDrivesAway) {
  Worker worker({1.5F, 0.0F});
  for (int tick = 0; tick < 14 * a_drive; ++tick) {
    worker.bench.send({1.5F + 0.0025F * static_cast<float>(tick), 0.0F});
    worker.hear_root(1);
  }
  EXPECT_TRUE(worker.serves());
}

TEST(Progress, ATargetThatIsMovedIsANewWay) {
  Worker worker({1.5F, 0.0F});
  for (int leap = 0; leap < 5; ++leap) {
    worker.hear_root(a_drive - 30);
    worker.bench.send({1.5F + 0.25F * static_cast<float>(leap % 2), 0.5F});
  }
  EXPECT_TRUE(worker.serves());
}

// It has waited in vain for a spare, has gone home and sets out anew: the way out again is not in vain.
TEST(Progress, WhoHasRetreatedHasAllTheWayBeforeIt) {
  Worker worker({1.5F, 0.0F});
  worker.hear_root(20);
  float left = 1.5F;
  const auto drive = [&](bool retreats, float to) {
    const float step = to > left ? 0.01F : -0.01F;
    while ((to - left) * step > 0.0F) {
      left += step;
      worker.bench.send({left, 0.0F});
      ConvoyRobot robot = worker.bench.tick({-step, 0.0F, 0.0F});
      watch_progress(robot, retreats, {step > 0.0F ? -1.0F : 1.0F, 0.0F});
    }
  };
  drive(true, 4.0F);
  drive(false, 1.75F);
  EXPECT_TRUE(worker.serves());
}

TEST(Progress, WhoGaveUpTriesAgainAfterAllOthers) {
  Worker worker({1.5F, 0.0F});
  worker.hear_root(a_drive + 20);
  ASSERT_FALSE(worker.serves());
  const auto& p = worker.bench.params;
  const int others =
      2 * whole(p.liveness_rounds) + whole(p.succession_after_rounds + p.succession_spread_rounds * 1.5F);
  worker.hear_root(others + 300);
  EXPECT_FALSE(worker.serves());
  worker.hear_root(150);
  EXPECT_TRUE(worker.serves());
}

TEST(Progress, WhereRobotsForgetTheTargetIsInDoubtAtOnce) {
  Worker worker({1.5F, 0.0F});
  worker.bench.state.forgets = true;
  worker.hear_root(a_drive + 20);
  ASSERT_FALSE(worker.serves());
  bool said = false;
  for (int k = 0; k < 4; ++k) {
    const auto m = worker.bench.step().message;
    said = said || (m.task_serves == sent_worker && m.task_silent);
  }
  EXPECT_TRUE(said);
}

TEST(Progress, ATargetGivenUpInVainCanStillBeWithdrawn) {
  Worker worker({1.5F, 0.0F});
  worker.hear_root(a_drive + 20);
  ASSERT_FALSE(worker.serves());
  worker.bench.call_back();
  worker.hear_root(1);
  EXPECT_EQ(find_task(worker.bench.state, sent_worker)->holder, nobody);
}

// It stays where it is, and knows better than anybody where the target is that it was sent to.
TEST(Progress, WhoWasSentStillKnowsThePlace) {
  Worker worker({1.5F, 0.0F});
  worker.hear_root(a_drive + 20);
  ASSERT_FALSE(worker.serves());
  worker.bench.send({1.0F, 1.0F});
  worker.hear_root(2);
  EXPECT_NEAR(find_task(worker.bench.state, sent_worker)->target.y, 1.0F, 0.005F);
}

}  // namespace
}  // namespace banyan
