// SPDX-License-Identifier: MIT
// Where robots forget, only those in charge of a worker doubt that it lives, and whoever knows better answers.
#include "healing/healing.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <random>
#include <span>
#include <vector>

#include "network.hpp"
#include "watch.hpp"

namespace banyan {
namespace {

constexpr RobotId worker_id = 50;
constexpr int very_long = 400;

// A spare of a swarm with more targets than robots remember.
struct ForgetfulWatch : Watch {
  ForgetfulWatch() {
    hear_root(2);
    bench.state.forgets = true;
  }
  ConvoyMessage& worker(Vec2 at, RobotId parent) {
    auto& m = bench.put(worker_id, at);
    m.role = Role::worker;
    m.serves = worker_id;
    m.parent = parent;
    tell_of_target(worker_id, at, {1.5F, 0.0F}, worker_id, 10);
    m.task_below = true;
    return m;
  }
  // The worker is not in sight, but below this child of mine.
  void child_above_worker(RobotId id) {
    auto& m = bench.put(id, {0.5F, 0.0F});
    m.role = Role::connector;
    m.parent = 1;
    tell_of_target(id, {0.5F, 0.0F}, {1.5F, 0.0F}, worker_id, 10);
    m.task_below = true;
  }
  void hear_worker(int ticks) {
    for (int k = 0; k < ticks; ++k) {
      ++bench.say(worker_id).task_beat;
      hear_root(1);
    }
  }
  const Task& task() { return *find_task(bench.state, worker_id); }
};

// Until those in charge doubt that a silent worker lives.
int doubt_ticks(const Watch& watch) { return whole(watch.bench.params.liveness_rounds) + 25 + 1; }

TEST(Doubt, SilenceAloneIsNoDeathWhereRobotsForget) {
  for (const bool forgets : {false, true}) {
    Watch watch;
    watch.hear_root(2);
    watch.bench.state.forgets = forgets;
    watch.tell_of_target(20, {0.5F, 0.0F}, {1.0F, 0.5F}, worker_id, 10);
    watch.hear_root(very_long);
    EXPECT_EQ(watch.bench.state.tally.replacements, forgets ? 0U : 1U);
  }
}

TEST(Doubt, WhoForgetsIsHeardByAll) {
  Watch watch;
  watch.hear_root(2);
  EXPECT_FALSE(watch.bench.step().message.forgets);
  watch.bench.say(root_id).forgets = true;
  watch.hear_root(1);
  watch.bench.say(root_id).forgets = false;
  EXPECT_TRUE(watch.bench.step().message.forgets);
}

TEST(Doubt, AParentMissesItsChild) {
  ForgetfulWatch watch;
  watch.worker({0.95F, 0.0F}, 1);
  watch.hear_worker(5);
  EXPECT_EQ(watch.task().via, worker_id);
  EXPECT_FALSE(watch.task().silent);
  watch.bench.silence(worker_id);
  watch.hear_root(doubt_ticks(watch));
  EXPECT_TRUE(watch.task().silent);
  bool said = false;
  for (int k = 0; k < 2; ++k) {
    const auto m = watch.bench.step().message;
    said = said || (m.task_serves == worker_id && m.task_silent && m.told == root_id);
  }
  EXPECT_TRUE(said);
}

TEST(Doubt, AWitnessMissesAWorkerWhoseParentIsSilentToo) {
  for (const bool parent_lives : {false, true}) {
    ForgetfulWatch watch;
    watch.bench.put(30, {0.0F, 0.5F});
    watch.worker({0.5F, 0.0F}, 30);
    watch.hear_worker(5);
    watch.bench.silence(worker_id);
    if (!parent_lives) watch.bench.silence(30);
    watch.hear_root(very_long);
    EXPECT_EQ(watch.task().silent, !parent_lives && watch.bench.state.tally.replacements == 0);
    EXPECT_EQ(watch.bench.state.tally.replacements, parent_lives ? 0U : 1U);
  }
}

TEST(Doubt, WhoDrivesOutOfRangeIsNotMissed) {
  ForgetfulWatch watch;
  watch.worker({0.95F, 0.0F}, 30);
  watch.hear_worker(5);
  watch.bench.silence(worker_id);
  watch.hear_root(very_long);
  EXPECT_FALSE(watch.task().silent);
}

TEST(Doubt, AnAncestorMissesAWorkerBelowTheChildThatFellSilent) {
  ForgetfulWatch watch;
  watch.child_above_worker(20);
  watch.hear_root(5);
  EXPECT_EQ(watch.task().via, 20);
  watch.bench.silence(20);
  watch.hear_root(doubt_ticks(watch));
  EXPECT_TRUE(watch.task().silent);
}

TEST(Doubt, WhoDoubtsWaitsForAnAnswerEvenIfItsNewsIsOld) {
  ForgetfulWatch watch;
  watch.child_above_worker(20);
  watch.hear_root(outdated_ticks - 20);
  watch.bench.silence(20);
  const auto& p = watch.bench.params;
  watch.hear_root(whole(p.liveness_rounds) + whole(p.succession_after_rounds));
  EXPECT_TRUE(watch.task().silent);
  EXPECT_EQ(watch.bench.state.tally.replacements, 0U);
}

// However old the news by it is: those torn off have time to find another parent, and to be heard of.
TEST(Doubt, TheClockStartsWithTheSilenceOfTheChild) {
  ForgetfulWatch watch;
  watch.child_above_worker(20);
  watch.hear_root(outdated_ticks - 20);
  watch.bench.silence(20);
  watch.hear_root(doubt_ticks(watch) - 5);
  EXPECT_FALSE(watch.task().silent);
  watch.hear_root(10);
  EXPECT_TRUE(watch.task().silent);
}

TEST(Doubt, AChildThatHangsElsewhereIsInTheChargeOfOthers) {
  ForgetfulWatch watch;
  watch.bench.put(30, {0.0F, 0.5F});
  auto& worker = watch.worker({0.5F, 0.0F}, 1);
  watch.hear_worker(5);
  worker.parent = 30;
  watch.hear_worker(2);
  EXPECT_EQ(watch.task().via, nobody);
  watch.bench.silence(worker_id);
  watch.hear_root(very_long);
  EXPECT_FALSE(watch.task().silent);
}

// It may no longer speak of the worker: a spare speaks of none.
TEST(Doubt, AChildThatNamesAnotherParentTakesItsWorkersAlong) {
  struct Case {
    Role role;
    RobotId parent;
    bool doubts;
  };
  for (const Case c :
       {Case{Role::connector, 30, false}, Case{Role::spare, nobody, false}, Case{Role::connector, nobody, true}}) {
    ForgetfulWatch watch;
    watch.child_above_worker(20);
    watch.hear_root(5);
    auto& child = watch.bench.say(20);
    child.task_serves = nobody;
    child.role = c.role;
    child.parent = c.parent;
    watch.hear_root(2);
    EXPECT_EQ(watch.task().via, c.doubts ? 20 : nobody);
    watch.bench.silence(20);
    watch.hear_root(doubt_ticks(watch) + 5);
    EXPECT_EQ(watch.task().silent, c.doubts);
  }
}

// The clock of a doubt starts with the doubt, however old what the robot knew before.
TEST(Doubt, ThereIsTimeForAnAnswer) {
  ForgetfulWatch watch;
  watch.tell_of_target(20, {0.5F, 0.0F}, {1.0F, 0.0F}, worker_id, 10);
  watch.hear_root(very_long);
  watch.bench.say(20).task_silent = true;
  const auto& p = watch.bench.params;
  const int patience = whole(p.liveness_rounds) + whole(p.succession_after_rounds + p.succession_spread_rounds * 1.0F);
  watch.hear_root(patience - 1);
  EXPECT_EQ(watch.bench.state.tally.replacements, 0U);
  watch.hear_root(4);
  EXPECT_EQ(watch.bench.state.tally.replacements, 1U);
}

// Question and answer take turns with all others that are under way.
TEST(Doubt, WhereManyAskAnAnswerTakesLonger) {
  constexpr float away = 2.0F;
  const auto patience_ticks = [](int questions) {
    ForgetfulWatch watch;
    for (int k = 0; k < questions; ++k) {
      const auto id = static_cast<RobotId>(20 + k);
      // The others are far away, so that nobody here takes them over first.
      watch.tell_of_target(id, {0.5F, 0.005F * static_cast<float>(k)}, {k == 0 ? away : 30.0F, 0.0F},
                           static_cast<RobotId>(worker_id + k), 10);
      watch.hear_root(2);
      watch.bench.say(id).task_silent = true;
    }
    int ticks = 2 * (questions - 1);  // since the first
    while (watch.bench.state.tally.replacements == 0 && ticks < very_long) watch.hear_root(1), ++ticks;
    return ticks;
  };
  const int alone = patience_ticks(1);
  EXPECT_EQ(patience_ticks(2), alone) << "the spread allows for two";
  EXPECT_NEAR(patience_ticks(6), alone + 6 * 2 * 4 - 20, 1);
}

TEST(Doubt, ALaterSignOfLifeEndsItAndIsPassedOn) {
  ForgetfulWatch watch;
  watch.tell_of_target(20, {0.5F, 0.0F}, {1.0F, 0.0F}, worker_id, 10);
  watch.bench.say(20).task_silent = true;
  watch.hear_root(10);
  ASSERT_TRUE(watch.task().silent);
  watch.bench.put(21, {0.0F, 0.5F});
  watch.bench.say(21).task_serves = worker_id;
  watch.bench.say(21).task_holder = worker_id;
  watch.bench.say(21).task_beat = 30;
  watch.bench.silence(20);
  watch.hear_root(1);
  EXPECT_FALSE(watch.task().silent);
  watch.bench.silence(21);
  bool said = false;
  for (int k = 0; k < 2; ++k) {
    const auto m = watch.bench.step().message;
    said = said || (m.task_serves == worker_id && !m.task_silent && m.task_beat == 30);
  }
  EXPECT_TRUE(said);
  watch.hear_root(very_long);
  EXPECT_EQ(watch.bench.state.tally.replacements, 0U);
}

// Its last count was on another way when it fell silent: who knows it joins the doubt instead of ending it.
TEST(Doubt, TheLastCountOfADeadWorkerIsNoSignOfLife) {
  for (const int later : {1, 30}) {
    ForgetfulWatch watch;
    watch.tell_of_target(20, {0.5F, 0.0F}, {1.0F, 0.0F}, worker_id, 10);
    watch.bench.say(20).task_silent = true;
    watch.hear_root(5);
    ASSERT_TRUE(watch.task().silent);
    auto& answers = watch.bench.put(21, {0.0F, 0.5F});
    answers.task_serves = answers.task_holder = worker_id;
    answers.task_beat = static_cast<std::uint16_t>(10 + later);
    watch.hear_root(1);
    EXPECT_EQ(watch.task().silent, later == 1) << later;
    watch.bench.silence(20);
    watch.bench.silence(21);
    watch.hear_root(very_long);
    EXPECT_EQ(watch.bench.state.tally.replacements, later == 1 ? 1U : 0U) << later;
  }
}

// The same, of the robot that knows the last count and hears the doubt.
TEST(Doubt, WhoKnowsButTheLastCountJoins) {
  for (const int later : {1, 30}) {
    ForgetfulWatch watch;
    watch.worker({0.5F, 0.0F}, 30);
    watch.bench.put(30, {0.0F, 0.5F});
    watch.hear_worker(5);
    const std::uint16_t last = watch.bench.say(worker_id).task_beat;
    watch.bench.silence(worker_id);
    auto& doubter = watch.bench.put(20, {0.0F, -0.5F});
    doubter.task_serves = doubter.task_holder = worker_id;
    doubter.task_beat = static_cast<std::uint16_t>(last - later);
    doubter.task_silent = true;
    watch.hear_root(1);
    EXPECT_EQ(watch.task().silent, later == 1) << later;
  }
}

// Others may have heard it a little longer than the robot in charge of it, and would answer that.
TEST(Doubt, AsksForACountOfNow) {
  ForgetfulWatch watch;
  watch.worker({0.95F, 0.0F}, 1);
  watch.hear_worker(5);
  const int last = watch.bench.say(worker_id).task_beat;
  watch.bench.silence(worker_id);
  watch.hear_root(doubt_ticks(watch));
  ASSERT_TRUE(watch.task().silent);
  const int half = 25 / 2;
  EXPECT_NEAR(watch.task().beat - last, half, 1);
}

// Only one neighbour at a time is told where a target is: the question does not wait for that, but the successor does.
TEST(Doubt, AQuestionIsPassedOnByThoseWhoDoNotKnowWhere) {
  ForgetfulWatch watch;
  watch.tell_of_target(20, {0.5F, 0.0F}, {1.0F, 0.0F}, worker_id, 10);
  ConvoyMessage& doubter = watch.bench.say(20);
  doubter.told = nobody;
  watch.hear_root(1);
  EXPECT_EQ(find_task(watch.bench.state, worker_id), nullptr) << "no question yet";
  doubter.task_silent = true;
  bool said = false;
  for (int k = 0; k < 4; ++k) {
    const auto m = watch.bench.step().message;
    said = said || (m.task_serves == worker_id && m.task_silent && m.task_beat == 10 && m.told == nobody);
  }
  EXPECT_TRUE(said);
  watch.hear_root(very_long);
  EXPECT_EQ(watch.bench.state.tally.replacements, 0U) << "where to?";
  watch.tell_of_target(20, {0.5F, 0.0F}, {1.0F, 0.0F}, worker_id, 10);
  watch.bench.say(20).task_silent = true;
  watch.hear_root(2);
  EXPECT_NEAR(norm(watch.task().target), 1.0F, 0.025F);
  EXPECT_EQ(watch.bench.state.tally.replacements, 1U);
}

TEST(Doubt, WhoKnowsOfALaterSignOfLifeAnswers) {
  ForgetfulWatch watch;
  watch.worker({0.5F, 0.0F}, 30);
  watch.bench.put(30, {0.0F, 0.5F});
  watch.hear_worker(5);
  watch.bench.silence(worker_id);
  auto& doubter = watch.bench.put(20, {0.0F, -0.5F});
  doubter.task_serves = doubter.task_holder = worker_id;
  doubter.task_beat = 5;
  doubter.task_silent = true;
  watch.hear_root(1);
  EXPECT_FALSE(watch.task().silent);
  bool said = false;
  for (int k = 0; k < 2; ++k) {
    const auto m = watch.bench.step().message;
    said = said || (m.task_serves == worker_id && m.task_beat == 15 && !m.task_silent);
  }
  EXPECT_TRUE(said);
}

// ---- Whole networks: random places, random loss, many more targets than anybody remembers ----

struct Places {
  std::vector<Vec2> robots;
  std::vector<Vec2> targets;
};

// Each robot within reach of one before it, in another direction, so that all are connected and none in one place;
// `workers` of them are sent out. `number(low, high)`: a random one below `high`.
template <class Number> Places random_places(int others, int workers, Number number) {
  const auto thousandths = [&](int low, int high) { return static_cast<float>(number(low, high)) * 1e-3F; };
  Places places{{{0.0F, 0.0F}}, {}};
  for (int i = 1; i < others + workers; ++i) {
    const Vec2 near = places.robots[static_cast<std::size_t>(number(0, i))];
    places.robots.push_back(near +
                            unit_vector(2.4F * static_cast<float>(i) + thousandths(-500, 500)) * thousandths(200, 750));
  }
  for (int k = 0; k < workers; ++k)
    places.targets.push_back(unit_vector(thousandths(-3141, 3142)) * (0.5F * static_cast<float>(number(2, 20))));
  return places;
}

template <class Number> Network random_network(Number number) {
  const int workers = number(task_capacity + 1, 3 * task_capacity);
  const Places places = random_places(10, workers, number);
  const float loss = static_cast<float>(number(0, 4)) * 0.1F;
  return {places.robots, places.targets, loss, static_cast<std::uint64_t>(number(1, 1'000'000))};
}

// The last robot was put near another, and nobody near it: its death parts no network.
RC_GTEST_PROP(Doubt, NoLivingWorkerIsReplaced, ()) {
  Network network = random_network([](int low, int high) { return *rc::gen::inRange(low, high); });
  network.steps(200);
  RC_ASSERT(network.states.front().forgets);
  RC_ASSERT(network.replacements() == 0U);
  const std::size_t dead = network.states.size() - 1;
  network.kill(dead);
  network.steps(300);
  // Two that are far apart may both have taken over; it takes the one a while to hear of the other.
  for (int k = 0; k < 12 && network.holders(static_cast<RobotId>(dead)) > 1; ++k) network.steps(100);
  RC_ASSERT(network.holders(static_cast<RobotId>(dead)) <= 1);
  for (std::size_t i = network.first_worker(); i < dead; ++i)
    RC_ASSERT(network.states[i].is_worker && network.states[i].serves == i);
}

// Not in all: where nobody in charge of it remembers a worker, nobody misses it (docs/limits.md).
TEST(Doubt, ADeadWorkerIsReplacedInNearlyAllNetworks) {
  std::mt19937 random(1);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same networks each time
  const auto number = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low));
  };
  constexpr int networks = 100;
  int with_spare = 0;
  int replaced = 0;
  for (int k = 0; k < networks; ++k) {
    Network network = random_network(number);
    network.steps(200);
    const std::size_t dead = network.states.size() - 1;
    network.kill(dead);
    network.steps(300);
    const bool held = network.holders(static_cast<RobotId>(dead)) == 1;
    const auto living = std::span(network.states).first(dead);
    const bool spare =
        std::any_of(living.begin(), living.end(), [](const ConvoyState& s) { return s.role == Role::spare; });
    with_spare += static_cast<int>(held || spare);
    replaced += static_cast<int>(held);
  }
  EXPECT_GE(with_spare, networks / 2);
  EXPECT_GE(replaced, with_spare * 9 / 10);  // 85 of 86
}

}  // namespace
}  // namespace banyan
