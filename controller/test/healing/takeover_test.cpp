// SPDX-License-Identifier: MIT
// A target whose worker fell silent gets another.
#include "healing/healing.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "watch.hpp"

namespace banyan {
namespace {

int takeover_ticks(const ConvoyBench& bench, float away) {
  const auto& p = bench.params;
  return 2 * whole(p.liveness_rounds) + whole(p.succession_after_rounds + p.succession_spread_rounds * away);
}

TEST(Takeover, ASpareTakesOverTheTargetOfAWorkerThatFellSilent) {
  Watch watch;
  watch.hear_root(2);
  const Vec2 target{1.0F, 0.5F};
  for (std::uint16_t beat = 10; beat < 15; ++beat) {
    watch.tell_of_target(20, {0.5F, 0.0F}, target, 50, beat);
    watch.hear_root(1);
  }
  auto& state = watch.bench.state;
  watch.hear_root(takeover_ticks(watch.bench, norm(target)) - 1);
  EXPECT_EQ(state.tally.replacements, 0U);
  watch.hear_root(3);
  EXPECT_EQ(state.tally.replacements, 1U);
  EXPECT_TRUE(state.is_worker);
  EXPECT_EQ(state.serves, 50);
  EXPECT_GT(state.want, 0.75F);  // it knows where to go without being told from outside
}

TEST(Takeover, ATargetThatWasPutOffIsTakenOnceTheRootHasItTriedAgain) {
  Watch watch;
  watch.hear_root(2);
  const Vec2 target{1.0F, 0.5F};
  watch.tell_of_target(20, {0.5F, 0.0F}, target, 50, 10);
  watch.hear_root(1);
  auto& news = watch.bench.say(20);
  news.task_holder = nobody;
  news.task_silent = true;
  news.task_beat = 70;
  watch.hear_root(2 * takeover_ticks(watch.bench, norm(target)));
  const auto& task = watch.bench.state.tasks[0];
  EXPECT_TRUE(is_put_off(task));
  EXPECT_EQ(task.times_put_off, 1) << "once, however often it is told";
  EXPECT_FALSE(watch.bench.state.is_worker);
  news.task_holder = root_id;
  news.task_silent = false;
  news.task_beat = 130;
  watch.hear_root(2 * takeover_ticks(watch.bench, norm(target)));
  EXPECT_TRUE(watch.bench.state.is_worker);
  EXPECT_EQ(watch.bench.state.serves, 50);
}

// In a long line news of a far worker comes in bunches.
TEST(Takeover, WhereNewsIsRareSilenceSaysLess) {
  constexpr int gap = 200;
  Watch watch;
  watch.hear_root(2);
  const Vec2 target{1.0F, 0.5F};
  const int patience = takeover_ticks(watch.bench, norm(target));
  watch.bench.params.succession_after_rounds = 10000.0F;
  std::uint16_t beat = 10;
  for (int k = 0; k < 3; ++k) {
    watch.tell_of_target(20, {0.5F, 0.0F}, target, 50, beat = static_cast<std::uint16_t>(beat + gap));
    watch.hear_root(gap);
  }
  watch.bench.params.succession_after_rounds = Convoy::defaults().succession_after_rounds;
  watch.tell_of_target(20, {0.5F, 0.0F}, target, 50, static_cast<std::uint16_t>(beat + gap));
  watch.hear_root(3 * gap / 2);
  ASSERT_GT(3 * gap / 2, 2 * patience);
  EXPECT_EQ(watch.bench.state.tally.replacements, 0U);
  watch.hear_root(gap);
  EXPECT_EQ(watch.bench.state.tally.replacements, 1U);
}

// News from another branch goes in to the root, 0.9 C, and 13 C out to here, by steps of 0.7 C, and of three targets in
// turn.
TEST(Takeover, FarFromTheRootASpareWaitsForNewsThatComesTheLongWay) {
  Watch watch;
  watch.bench.state.label = 13 * 256;
  watch.hear_root(2);
  for (const RobotId serves : {RobotId{50}, RobotId{51}, RobotId{52}}) {
    watch.tell_of_target(20, {0.5F, 0.0F}, {1.0F, 0.5F}, serves, 10);
    watch.hear_root(2);
  }
  ASSERT_EQ(watch.bench.state.task_count, 3);
  watch.hear_root(takeover_ticks(watch.bench, norm(Vec2{1.0F, 0.5F})) + 59 - 10);
  EXPECT_EQ(watch.bench.state.tally.replacements, 0U);
  watch.hear_root(10);
  EXPECT_EQ(watch.bench.state.tally.replacements, 1U);
}

TEST(Takeover, OfASilentWorkersTargetTheMeanIsRemembered) {
  Watch watch;
  watch.hear_root(2);
  const float patience = watch.bench.params.succession_after_rounds;
  watch.bench.params.succession_after_rounds = 10000.0F;
  watch.tell_of_target(20, {0.5F, 0.0F}, {1.0F, 0.0F}, 50, 10);
  watch.hear_root(2);
  EXPECT_NEAR(watch.bench.state.tasks[0].target.x, 1.0F, 0.005F) << "the worker alive, as it is told";
  watch.hear_root(whole(patience) + 40);
  watch.tell_of_target(20, {0.5F, 0.0F}, {1.5F, 0.0F}, 50, 10);
  watch.hear_root(1);
  EXPECT_GT(watch.bench.state.tasks[0].target.x, 1.025F);
  EXPECT_LT(watch.bench.state.tasks[0].target.x, 1.25F);
}

// With noisy bearings what a robot says of a far target is wrong by tenths of C. While the worker lives the mean
// counts, too.
TEST(Takeover, WhereMeasurementsAreNoisyOnlyWhoIsNearTheTargetHelpsToRememberIt) {
  const auto remembered = [](Vec2 sender) {
    Watch watch;
    watch.bench.params.succession_after_rounds = 10000.0F;
    const auto hear_shaken_root = [&](int ticks) {
      for (int k = 0; k < ticks; ++k) {
        watch.bench.move(root_id, {k % 2 == 0 ? 0.4F : 0.25F, 0.0F});
        watch.hear_root(1);
      }
    };
    hear_shaken_root(20);
    EXPECT_TRUE(watch.bench.state.neighbors.filter().has_seen_noise());
    watch.tell_of_target(20, sender, {1.0F, 0.0F}, 50, 10);
    hear_shaken_root(2);
    EXPECT_NEAR(watch.bench.state.tasks[0].target.x, 1.0F, 0.005F);
    watch.tell_of_target(20, sender, {1.25F, 0.0F}, 50, 11);
    hear_shaken_root(1);
    const float mean_x = watch.bench.state.tasks[0].target.x;
    EXPECT_NEAR(mean_x, 1.05F, 0.005F) << "the worker is alive";
    watch.bench.silence(20);
    hear_shaken_root(60);
    watch.tell_of_target(20, sender, {1.5F, 0.0F}, 50, 11);
    hear_shaken_root(20);
    return watch.bench.state.tasks[0].target.x - mean_x;
  };
  EXPECT_GT(remembered({0.5F, 0.0F}), 0.25F);
  EXPECT_NEAR(remembered({-0.75F, 0.0F}), 0.0F, 0.005F);
}

TEST(Takeover, AWorkerIsBelievedAgainAfterMoreThanHalfTheRangeOfSilence) {
  for (const int silence : {serial_half_range - 10, serial_half_range + 10}) {
    Watch watch;
    watch.hear_root(2);
    watch.bench.params.succession_after_rounds = 1000000.0F;
    watch.tell_of_target(20, {0.5F, 0.0F}, {1.0F, 0.0F}, 50, 10);
    watch.hear_root(2);
    Task& task = watch.bench.state.tasks[0];
    ASSERT_EQ(task.beat, 10);
    task.age_ticks = static_cast<std::uint16_t>(silence);
    task.silent = true;
    watch.bench.say(20).task_beat = 10 + 40000;
    watch.hear_root(1);
    EXPECT_EQ(task.age_ticks == 0, silence > serial_half_range);
  }
}

TEST(Takeover, WhoBeatsIsNotReplaced) {
  Watch watch;
  watch.hear_root(2);
  for (std::uint16_t beat = 10; beat < 150; ++beat) {
    watch.tell_of_target(20, {0.5F, 0.0F}, {1.0F, 0.5F}, 50, beat);
    watch.hear_root(1);
  }
  EXPECT_EQ(watch.bench.state.tally.replacements, 0U);
}

TEST(Takeover, ATargetThatWasGivenUpHasNoSuccessor) {
  Watch watch;
  watch.hear_root(2);
  watch.tell_of_target(20, {0.5F, 0.0F}, {1.0F, 0.5F}, 50, 10);
  watch.hear_root(3);
  watch.bench.say(20).task_holder = nobody;
  watch.bench.say(20).task_beat = 80;
  watch.hear_root(120);
  EXPECT_EQ(watch.bench.state.tally.replacements, 0U);
}

TEST(Takeover, AWorkerRelievedFromOutsideSaysSo) {
  ConvoyBench bench = grown<Convoy>();
  bench.state = initial_convoy_state(1, true, false);
  bench.send({1.0F, 0.0F});
  bench.put(20, {0.5F, 0.0F});
  bench.steps(3);
  bench.call_back();
  const auto m = bench.step().message;
  EXPECT_EQ(m.task_serves, 1);
  EXPECT_EQ(m.task_holder, nobody);
}

// Wheels slip, bodies are pushed: a successor's idea of where its target is follows what those around it remember.
TEST(Takeover, ASuccessorListensToThoseWhoRememberThePlace) {
  Watch watch;
  auto& state = watch.bench.state;
  state.is_worker = true;
  state.role = Role::worker;
  state.serves = 50;
  state.task_count = 1;
  state.tasks[0] = {50, state.id, 100, 0, {1.5F, 0.0F}};
  watch.tell_of_target(20, {0.5F, 0.0F}, {1.5F, 0.15F}, 50, 90);
  watch.bench.say(20).task_holder = state.id;
  watch.hear_root(30);
  EXPECT_NEAR(state.tasks[0].target.y, 0.15F, 0.01F);
  EXPECT_TRUE(state.is_worker);
}

// Robots on batteries hand their targets over again and again: copies of copies would drift.
TEST(Takeover, WhereTargetsArePassedOnTheHolderAndTheWorkerFirstSentThereKnowBest) {
  constexpr RobotId first = 50, holder = 30;
  const auto believed = [](bool passed_on, bool mine, RobotId teller) {
    Watch watch;
    watch.bench.put(teller, {0.5F, 0.0F}).task_serves = nobody;
    watch.hear_root(2);
    ConvoyState& state = watch.bench.state;
    state.task_count = 1;
    state.tasks[0] = {first, mine ? state.id : holder, 100, 0, {1.0F, 0.0F}};
    if (mine) state.is_worker = true, state.role = Role::worker, state.serves = first;
    watch.tell_of_target(teller, {0.5F, 0.0F}, {1.5F, 0.0F}, first, 100);
    watch.bench.say(teller).task_holder = state.tasks[0].holder;
    auto robot = watch.bench.tick();
    robot.passes_targets_on = passed_on;
    watch_tasks(robot);
    return state.tasks[0].target.x;
  };
  for (const RobotId teller : {first, holder}) EXPECT_NEAR(believed(true, false, teller), 1.5F, 0.01F) << teller;
  for (const RobotId teller : {first, holder, RobotId{20}})
    EXPECT_NEAR(believed(false, false, teller), 1.1F, 0.01F) << teller;
  EXPECT_NEAR(believed(true, false, 20), 1.1F, 0.01F) << "it only remembers";
  EXPECT_NEAR(believed(true, true, first), 1.1F, 0.01F);
  EXPECT_NEAR(believed(true, true, 20), 1.0F, 0.01F) << "no better than I";
  EXPECT_NEAR(believed(false, true, 20), 1.1F, 0.01F);
}

// Of two rivals the one at the target stays, whatever their ids and whoever was sent there.
TEST(Takeover, WhoIsAtTheTargetStays) {
  for (const RobotId serves : {RobotId{1}, RobotId{2}, RobotId{50}})
    for (const bool me_there : {false, true}) {
      Watch watch;
      auto& state = watch.bench.state;
      state.is_worker = true;
      state.role = Role::worker;
      state.serves = serves;
      state.task_count = 1;
      state.tasks[0] = {serves, state.id, 100, 0, {me_there ? 0.025F : 3.75F, 0.0F}};
      auto& rival = watch.bench.put(2, {0.5F, 0.0F});
      rival.task_serves = serves;
      rival.task_holder = 2;
      rival.task_beat = 100;
      rival.task_reached = !me_there;
      watch.hear_root(2);
      EXPECT_EQ(state.is_worker, me_there) << "first worker " << serves;
    }
}

// Two successors with equal counts, each hearing what the other said a tick ago.
RC_GTEST_PROP(Takeover, OfTwoRivalsOneStays, ()) {
  const RobotId serves = *rc::gen::element<RobotId>(1, 2, 50);
  std::array<ConvoyBench, 2> pair{grown<Convoy>(), grown<Convoy>()};
  for (int i : {0, 1}) {
    ConvoyState& s = pair[i].state;
    s.id = static_cast<RobotId>(i + 1);
    s.is_worker = true;
    s.role = Role::worker;
    s.serves = serves;
    s.task_count = 1;
    s.tasks[0] = {serves, s.id, static_cast<std::uint16_t>(65530 + *rc::gen::inRange(0, 20)), 0, {1.5F, 0.0F}};
  }
  std::array<ConvoyMessage, 2> said{pair[0].step().message, pair[1].step().message};
  for (int tick = 0; tick < 60; ++tick) {
    std::array<ConvoyMessage, 2> next;
    for (int i : {0, 1}) {
      pair[i].put(static_cast<RobotId>(2 - i), {0.5F, 0.0F}) = said[1 - i];
      next[i] = pair[i].step().message;
    }
    said = next;
  }
  const bool second_first = serves == 2;
  RC_ASSERT(pair[0].state.is_worker == !second_first);
  RC_ASSERT(pair[1].state.is_worker == second_first);
}

}  // namespace
}  // namespace banyan
