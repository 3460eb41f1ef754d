// SPDX-License-Identifier: MIT
// What a robot that heals makes of its orders: sent, called back, given up, resigned, taken over.
#include "healing/tick.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "watch.hpp"

namespace banyan {
namespace {

RobotId serves(const ConvoyBench& bench) { return healing_report(bench.state).serves; }

TEST(Orders, WhoIsSentServesItsTarget) {
  ConvoyBench bench = grown<Convoy>();
  EXPECT_EQ(serves(bench), nobody);
  bench.send({1.5F, 2.0F});
  const auto m = bench.step().message;
  EXPECT_EQ(m.role, Role::worker);
  EXPECT_EQ(m.serves, 1);
  EXPECT_EQ(m.want, 640);
  EXPECT_EQ(serves(bench), 1);
}

TEST(Orders, WhoIsCalledBackIsNoWorkerAnyMore) {
  ConvoyBench bench = grown<Convoy>();
  bench.send({1.5F, 2.0F});
  bench.steps(3);
  bench.call_back();
  const auto m = bench.step().message;
  EXPECT_NE(m.role, Role::worker);
  EXPECT_EQ(m.serves, nobody);
  EXPECT_EQ(m.want, 0);
  EXPECT_EQ(serves(bench), nobody);
}

TEST(Orders, ATargetIsCarriedAlongWhileItIsNotSensed) {
  ConvoyBench bench = grown<Convoy>();
  bench.send({1.5F, 2.0F});
  bench.step();
  bench.orders.target.reset();
  for (int k = 0; k < 10; ++k) bench.step({.forward_m = 0.05F});
  EXPECT_EQ(bench.step().message.want, static_cast<int>(256.0 * std::hypot(1.0, 2.0) + 0.5));
  const auto m = bench.step({.turn_rad = 1.5F}).message;
  EXPECT_EQ(m.want, static_cast<int>(256.0 * std::hypot(1.0, 2.0) + 0.5)) << "a turn leads no nearer";
  bench.call_back();
  bench.step();
  bench.orders.sent = true;
  bench.step();
  EXPECT_FALSE(bench.state.target_known) << "another target, perhaps";
}

TEST(Orders, ATargetThatIsGivenUpHasNoWorkerUntilSomebodyIsSentAgain) {
  ConvoyBench bench = grown<Convoy>();
  bench.send({1.5F, 2.0F});
  bench.steps(3);
  bench.orders = {.sent = false, .target = std::nullopt, .given_up = 1};
  const auto m = bench.step().message;
  EXPECT_EQ(serves(bench), nobody);
  EXPECT_EQ(m.task_serves, 1);
  EXPECT_EQ(m.task_holder, nobody) << "and everybody is told";
  bench.orders = {};
  bench.steps(3);
  bench.send({0.0F, 1.0F});
  EXPECT_EQ(bench.step().message.want, 256);
  EXPECT_EQ(serves(bench), 1);
}

TEST(Orders, ATargetThatEndsWhileItIsPutOffIsNotTriedAgain) {
  ConvoyBench bench = grown<Convoy>();
  bench.send({1.5F, 2.0F});
  bench.steps(3);
  bench.state.is_worker = false;
  bench.state.serves = nobody;
  put_off(bench.tick(), bench.state.tasks[0]);
  bench.steps(3);
  ASSERT_TRUE(is_put_off(bench.state.tasks[0]));
  const Serial before = bench.state.tasks[0].beat;
  bench.call_back();
  const auto m = bench.step().message;
  EXPECT_EQ(m.task_holder, nobody);
  EXPECT_FALSE(m.task_silent);
  EXPECT_TRUE(is_newer(m.task_beat, before)) << "and everybody is told";
}

TEST(Orders, WhoIsSentElsewhereInTheSameTickGoesOnWithTheNewTarget) {
  ConvoyBench bench = grown<Convoy>();
  bench.send({1.5F, 2.0F});
  bench.steps(3);
  bench.send({0.0F, 1.0F});
  bench.orders.given_up = 1;
  EXPECT_EQ(bench.step().message.want, 256);
  EXPECT_EQ(serves(bench), 1);
}

// Robot 50 was sent first, and is back.
TEST(Orders, WhoHasResignedStaysSoUntilItIsCalledBackAndSentAgain) {
  Watch watch;
  ConvoyBench& bench = watch.bench;
  bench.send({1.5F, 0.0F});
  watch.hear_root(3);
  auto& rival = bench.put(50, {0.5F, 0.25F});
  rival.task_serves = 1;
  rival.task_holder = 0;  // smaller than mine, but not the first: I stay
  rival.task_beat = 100;
  watch.hear_root(2);
  EXPECT_EQ(serves(bench), 1);
  bench.state.serves = 50;  // as a successor I yield to the worker first sent there
  bench.state.tasks[0].serves = 50;
  rival.task_serves = 50;
  rival.task_holder = 50;
  rival.task_beat = static_cast<Serial>(bench.state.tasks[0].beat + 5);
  watch.hear_root(2);
  EXPECT_EQ(serves(bench), nobody);
  watch.hear_root(20);
  EXPECT_EQ(serves(bench), nobody) << "still sent, but that is no news";
  bench.call_back();
  watch.hear_root(1);
  bench.send({0.0F, 1.0F});
  watch.hear_root(1);
  EXPECT_EQ(serves(bench), 1);
}

// A successor of worker 50 that nobody has sent anywhere.
struct Successor : Watch {
  Successor() {
    hear_root(2);
    for (std::uint16_t beat = 10; beat < 15; ++beat) {
      tell_of_target(20, {0.5F, 0.0F}, {1.0F, 0.5F}, 50, beat);
      hear_root(1);
    }
    hear_root(120);
  }
};

TEST(Orders, ATakenOverTargetIsServedWithoutAnyOrder) {
  Successor successor;
  ASSERT_EQ(serves(successor.bench), 50);
  successor.hear_root(20);
  EXPECT_EQ(serves(successor.bench), 50);
}

TEST(Orders, ASuccessorStopsWhenItsTargetIsGivenUp) {
  Successor successor;
  successor.bench.orders.given_up = 49;
  successor.hear_root(1);
  EXPECT_EQ(serves(successor.bench), 50) << "another's";
  successor.bench.orders.given_up = 50;
  successor.hear_root(1);
  EXPECT_EQ(serves(successor.bench), nobody);
  successor.bench.orders = {};
  successor.hear_root(150);
  EXPECT_EQ(serves(successor.bench), nobody) << "nor does it take it over again";
}

TEST(Orders, ASuccessorThatIsSentItselfServesItsOwn) {
  Successor successor;
  successor.bench.send({-1.0F, 0.0F});
  successor.hear_root(1);
  EXPECT_EQ(serves(successor.bench), 1);
  EXPECT_NEAR(successor.bench.state.want, 1.0F, 0.005F);
}

// ---- News: packets that say what the robot did not know ----

template <class Kind> int news_of(const std::function<void(typename BenchOf<Kind>::Message&)>& say) {
  BenchOf<Kind> bench(1);
  bench.state.epoch = 3;
  bench.state.phase = Phase::grow_tree;
  bench.state.root = bench.state.heart = {5, 9};
  bench.state.heartbeat = 100;
  auto& message = bench.put(2, {0.5F, 0});
  message.heartbeat = 100;
  bench.put(3, {0, 0.5F}).heartbeat = 99;
  say(message);
  const auto robot = bench.tick();
  int count = 0;
  for (const Heard& h : robot.news) {
    EXPECT_EQ(h.message->id, message.id);
    ++count;
  }
  return count;
}

template <class Kind> void expect_news() {
  using Message = typename BenchOf<Kind>::Message;
  EXPECT_EQ(news_of<Kind>([](Message&) {}), 0);
  EXPECT_EQ(news_of<Kind>([](Message& m) { m.root = {6, 8}; }), 1);
  EXPECT_EQ(news_of<Kind>([](Message& m) { m.root = {4, 9}; }), 1);
  EXPECT_EQ(news_of<Kind>([](Message& m) { m.epoch = 4; }), 1);
  EXPECT_EQ(news_of<Kind>([](Message& m) { m.phase = Phase::select_root; }), 1);
  EXPECT_EQ(news_of<Kind>([](Message& m) { m.new_root = 1; }), 1);
  EXPECT_EQ(news_of<Kind>([](Message& m) { m.new_root = 4; }), 0);
  EXPECT_EQ(news_of<Kind>([](Message& m) { m.heartbeat = 101; }), 1);
  EXPECT_EQ(news_of<Kind>([](Message& m) { m.told = 1; }), 1);
  EXPECT_EQ(news_of<Kind>([](Message& m) { m.told = 3; }), 0);
  EXPECT_EQ(news_of<Kind>([](Message& m) { m.id = 9; }), 1);  // the root itself
}

TEST(News, IsWhatTheRobotDidNotKnow) { expect_news<Convoy>(); }

}  // namespace
}  // namespace banyan
