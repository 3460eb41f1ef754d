// SPDX-License-Identifier: MIT
// Any number of threads gives the same world to the last bit, in a forked process too.
#include "banyan/world/threads.hpp"
#include "banyan/world/bodies.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <memory>
#include <vector>

#include "worlds.hpp"

namespace banyan::world {
namespace {

TEST(Executor, CoversEveryItemOnce) {
  for (const int threads : {1, 2, 3, 4, 7}) {
    Executor executor(threads);
    EXPECT_EQ(executor.threads(), threads);
    for (const std::size_t n : {0U, 1U, 2U, 5U, 1000U}) {
      std::vector<int> done(n, 0);
      std::vector<int> workers(n, -1);
      executor.parallel_for(n, [&](std::size_t begin, std::size_t end, int worker) {
        for (std::size_t i = begin; i < end; ++i) {
          ++done[i];
          workers[i] = worker;
        }
      });
      for (std::size_t i = 0; i < n; ++i) {
        ASSERT_EQ(done[i], 1);
        ASSERT_TRUE(workers[i] >= 0 && workers[i] < threads);
      }
    }
  }
}

TEST(Executor, RunsThousandsOfShortJobs) {
  Executor executor(3);
  std::vector<std::uint64_t> sums(3, 0);
  for (int job = 0; job < 5000; ++job)
    executor.parallel_for(3, [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t i = begin; i < end; ++i) ++sums[i];
    });
  EXPECT_EQ(sums, (std::vector<std::uint64_t>{5000, 5000, 5000}));
}

TEST(Executor, HasAtLeastOneThread) {
  Executor executor(-3);
  EXPECT_EQ(executor.threads(), 1);
  EXPECT_EQ(Executor(0).threads(), 1);
}

std::vector<Scenario> scenarios() {
  std::vector<Scenario> all;
  for (const char* algorithm : {"outwards", "inwards"}) {
    all.push_back(ring(algorithm, 24, 3, 4.0, 11));
    Scenario hard = hostile(algorithm, 30, 12);
    hard.radio.latency_ticks = 3;
    hard.radio.slots = 12;
    hard.events.push_back({.time_s = 5.0, .action = Die{7}});
    hard.events.push_back({.time_s = 6.0, .action = AddTarget{{1.0, 3.0}}});
    hard.obstacles = {Disc{{2.0, 0.4}, 0.3}, Box{{-2.0, 1.0}, {0.4, 0.6}, 0.5}, Wall{{0.0, -2.0}, {1.0, -2.0}}};
    hard.targets = std::vector<Vec2>{{3.5, 1.5}, {-3.0, -1.0}, {0.5, 3.5}};
    all.push_back(hard);
    Scenario literal = hostile(algorithm, 150, 13);  // beyond the all-pairs limit of the radio
    literal.mission.reading = "literal";
    all.push_back(literal);
  }
  Scenario free_motion = ring("outwards", 20, 3, 4.0, 14);
  free_motion.robot.body = BodyModel::linear;
  all.push_back(free_motion);
  Scenario rigid = hostile("inwards", 20, 15);
  rigid.robot.body = BodyModel::box2d;
  if (has_box2d()) all.push_back(rigid);
  return all;
}

TEST(Threads, NeverChangeTheHash) {
  for (const Scenario& s : scenarios()) {
    std::vector<std::uint64_t> expected;
    for (const int threads : {1, 1, 2, 3, 4}) {
      World world(s);
      Executor executor(threads);
      std::vector<std::uint64_t> hashes;
      const int ticks = *s.swarm.robots > 100 ? 120 : 300;
      for (int t = 1; t <= ticks; ++t) {
        world.step(executor);
        if (t % 20 == 0) hashes.push_back(world.hash());
      }
      hashes.push_back(world.packets_received());
      if (expected.empty()) expected = hashes;
      EXPECT_EQ(hashes, expected) << threads << " threads, " << s.mission.algorithm << ", " << *s.swarm.robots
                                  << " robots";
    }
  }
}

TEST(Threads, MayChangeDuringARun) {
  const Scenario s = hostile("outwards", 30, 3);
  World steady(s);
  World changing(s);
  Executor executors[] = {Executor(1), Executor(4), Executor(2)};
  for (std::size_t t = 0; t < 120; ++t) {
    steady.step();
    changing.step(executors[t % 3]);
  }
  EXPECT_EQ(steady.hash(), changing.hash());
}

#ifndef __SANITIZE_THREAD__  // it forbids threads in a forked process

// How a child ends that does this and no more: 0 if it returns true, and by a signal if it takes ten seconds.
template <class F> int in_a_child(F&& does) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::alarm(10);
    ::_exit(does() ? 0 : 1);
  }
  int status = -1;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  return status;
}

TEST(Threads, AForkedProcessHasItsOwn) {
  World world(hostile("outwards", 30, 3));
  World alone(world);
  auto executor = std::make_unique<Executor>(3);
  world.step(*executor);
  alone.step();
  const auto goes_on = [&] {
    for (int t = 0; t < 20; ++t) {
      world.step(*executor);
      alone.step();
    }
    return world.hash() == alone.hash();
  };
  EXPECT_EQ(in_a_child(goes_on), 0);
  EXPECT_EQ(in_a_child([&] { return goes_on() && in_a_child(goes_on) == 0; }), 0) << "a child's child";
  EXPECT_TRUE(goes_on()) << "the parent's are as they were";
}

TEST(Threads, AForkedProcessCanEndWithoutThem) {
  auto executor = std::make_unique<Executor>(3);
  for (const bool used : {false, true}) {
    if (used) executor->parallel_for(3, [](std::size_t, std::size_t, int) {});
    EXPECT_EQ(in_a_child([&] {
                executor.reset();
                return true;
              }),
              0);
  }
}

#endif

}  // namespace
}  // namespace banyan::world
