// SPDX-License-Identifier: MIT
// One step as a whole, of every algorithm: pure, without heap, safe for whatever is heard and sensed.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "bench.hpp"
#include "garbage.hpp"
#include "heap_counter.hpp"
#include "over_the_wire.hpp"

namespace banyan {
namespace {

using test::allocations;

// ---- Nonsense over the radio ----

// A small generator of its own: the test of allocations must not allocate.
struct Noise {
  std::uint64_t state = 88172645463325252ULL;
  std::uint32_t next() {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return static_cast<std::uint32_t>(state >> 16);
  }
  std::uint16_t word(std::uint32_t below) { return static_cast<std::uint16_t>(next() % below); }
  std::int16_t signed_word() { return static_cast<std::int16_t>(word(65536)); }
  float length(float limit) { return limit * (static_cast<float>(next() % 20001) * 1e-4F - 1.0F); }
};

// What a robot may hear, sane or not, as long as it passes the wire.
template <class M> void babble_of_the_tree(Noise& noise, std::uint32_t robots, M& m) {
  const auto anybody = [&] { return noise.next() % 3 == 0 ? nobody : noise.word(robots); };
  m.id = noise.word(robots);
  m.role = static_cast<Role>(noise.word(4));
  m.phase = static_cast<Phase>(noise.word(5));
  m.need = static_cast<Need>(noise.word(3));
  m.flood_done = noise.word(2) != 0;
  m.committed = noise.word(2) != 0;
  m.epoch = noise.word(4);
  m.root = {noise.word(3), noise.word(robots)};
  m.label = noise.next() % 4 == 0 ? unknown_label : noise.word(65535);
  m.seqno = noise.word(100);
  m.depth = noise.word(8);
  m.tree_hops = static_cast<std::uint8_t>(noise.word(256));
  m.call_hops = static_cast<std::uint8_t>(noise.word(256));
  for (RobotId* id : {&m.parent, &m.old_parent, &m.flood_parent, &m.grant, &m.request, &m.new_root}) *id = anybody();
  m.flood_robots = noise.word(65535);
  m.subtree = noise.word(65535);
  m.count = noise.word(65535);
  for (std::int16_t* v : {&m.pull_x, &m.pull_y}) *v = noise.signed_word();
  for (Coordinate* v : {&m.centroid_x, &m.centroid_y}) v->bits = noise.signed_word();
  m.want = noise.word(65535);
}
void babble(Noise& noise, std::uint32_t robots, paper::Message& m) {
  babble_of_the_tree(noise, robots, m);
  m.hold = noise.word(robots);
  m.q = {noise.length(1e9F), noise.length(1e9F)};
}
void babble(Noise& noise, std::uint32_t robots, HealingMessage& m) {
  babble_of_the_tree(noise, robots, m);
  m.inserted_child = noise.word(robots);
  for (float* v : {&m.q_x, &m.q_y}) *v = noise.length(1e9F);
  for (RobotId* id : {&m.serves, &m.told, &m.task_serves, &m.task_holder}) *id = noise.word(robots);
  m.root_told = noise.word(2) != 0;
  m.root_size = noise.word(20);
  m.heartbeat = noise.word(65535);
  m.task_beat = noise.word(65535);
  for (Coordinate* v : {&m.root_x, &m.root_y, &m.task_x, &m.task_y}) v->bits = noise.signed_word();
}
void babble(Noise& noise, std::uint32_t robots, ConvoyMessage& m) {
  babble(noise, robots, static_cast<HealingMessage&>(m));
  for (RobotId* id : {&m.warned, &m.above, &m.below, &m.task_host}) *id = noise.word(robots);
  m.child_count = static_cast<std::uint8_t>(noise.word(256));
  m.pinned = noise.word(2) != 0;
  for (Coordinate* v : {&m.hinge_x, &m.hinge_y}) v->bits = noise.signed_word();
}

// What packets do: their messages live as long as this.
template <class Kind, std::size_t capacity> struct Crowd {
  using Heard = typename Kind::Heard;
  std::array<typename Kind::Message, capacity> messages;
  std::array<Heard, capacity> heard;
  std::span<Heard> speak(Noise& noise, std::size_t count, std::uint32_t robots) {
    for (std::size_t k = 0; k < count; ++k) {
      messages[k] = {};
      babble(noise, robots, messages[k]);
      heard[k] = {&messages[k], {noise.length(1.0F), noise.length(1.0F)}};
    }
    return std::span(heard).first(count);
  }
};

bool within_limits(const Motion& motion) {
  const Velocity v = velocity_of(motion, test_platform);
  const WheelSpeeds wheels = wheel_speeds(v, test_platform.wheel_distance_m);
  const float limit = test_platform.wheel_limit_m_s + 5e-6F;
  return std::fabs(wheels.left_m_s) <= limit && std::fabs(wheels.right_m_s) <= limit &&
         v.sideways_m_s == 0.0F;  // false for NaN too
}

// Thousands of steps on nonsense: nothing from the heap, wheels within their limits, a message that
// others accept, and never a step back.
TEST(Step, StandsNonsenseWithoutTheHeap) {
  Noise noise;
  long taken = 0;
  int bad_wheels = 0, bad_messages = 0, steps_back = 0;
  for_each_kind([&]<class Kind>() {
    Crowd<Kind, 140> crowd;  // more than the table holds
    const auto params = Kind::defaults();
    auto state = Kind::initial(1, true, false);
    bool sent = true;
    for (int t = 0; t < 2000; ++t) {
      const auto heard = crowd.speak(noise, noise.next() % crowd.heard.size(), 200);
      if (t % 50 == 0) {
        sent = noise.word(2) != 0;
        state = Kind::initial(1, sent, noise.word(5) == 0);
      }
      const Vec2 target{noise.length(4.5F), noise.length(4.5F)};
      const std::array obstacles{Vec2{noise.length(0.15F), noise.length(0.15F)}};
      const Senses senses{.odometry = {noise.length(0.01F), 0, noise.length(0.3F)},
                          .orders = {sent, sent ? std::optional(target) : std::nullopt},
                          .obstacles = std::span(obstacles).first(noise.word(2))};
      const auto before = state;
      const long start = allocations;
      const auto output = Kind::step(params, state, {heard, senses, test_platform});
      taken += allocations - start;
      bad_wheels += within_limits(output.motion) ? 0 : 1;
      bad_messages += over_the_wire(output.message) == output.message ? 0 : 1;
      steps_back += state.epoch < before.epoch || (state.epoch == before.epoch && state.phase < before.phase) ||
                            newer(before.root, state.root)
                        ? 1
                        : 0;
    }
  });
  EXPECT_EQ(taken, 0);
  EXPECT_EQ(bad_wheels, 0);
  EXPECT_EQ(bad_messages, 0);
  EXPECT_EQ(steps_back, 0);
  const long before = allocations;
  { const std::string long_text(100, 'x'); }
  EXPECT_GT(allocations, before) << "the counter counts";
}

template <class State> std::uint64_t hash(const State& state) {
  Digest digest;
  add_to(digest, state);
  return digest.value();
}

TEST(Step, IsAPureFunctionOfItsArguments) {
  for_each_kind([]<class Kind>() {
    Noise noise;
    Crowd<Kind, 20> crowd;
    auto a = Kind::initial(1, false, false);
    auto b = a;
    const auto params = Kind::defaults();
    const Senses senses{.odometry = {0.005F, 0, 0.1F}};
    for (int t = 0; t < 300; ++t) {
      const auto heard = crowd.speak(noise, 20, 30);
      auto again = crowd.heard;  // a step may work on what it is given
      const auto x = Kind::step(params, a, {heard, senses, test_platform});
      const auto y = Kind::step(params, b, {again, senses, test_platform});
      ASSERT_EQ(x.message, y.message);
      ASSERT_EQ(x.motion.forward, y.motion.forward);
      ASSERT_EQ(x.motion.turn, y.motion.turn);
      ASSERT_EQ(hash(a), hash(b));
    }
  });
}

TEST(Step, TheHashSeesEveryChange) {
  ConvoyState s = initial_convoy_state(1, false, false);
  std::set<std::uint64_t> seen{hash(s)};
  const auto changed = [&](auto& field, auto value) {
    const auto before = field;
    field = value;
    EXPECT_TRUE(seen.insert(hash(s)).second);
    field = before;
  };
  changed(s.epoch, std::uint16_t{3});
  changed(s.phase, Phase::grow_tree);
  changed(s.seqno, std::uint16_t{3});
  changed(s.label, std::uint16_t{3});
  changed(s.parent, RobotId{3});
  changed(s.old_parent, RobotId{3});
  changed(s.q, Vec2{0.5F, 0});
  changed(s.centroid, Vec2{0.5F, 0});
  changed(s.request, RobotId{3});
  changed(s.grant, RobotId{3});
  changed(s.serves, RobotId{3});
  changed(s.news_gap, std::uint16_t{3});
  changed(s.root_at, Vec2{0.5F, 0});
  changed(s.detour.contact, Vec2{0.5F, 0});
  changed(s.task_count, std::uint8_t{1});
  changed(s.lead_to, RobotId{3});
  changed(s.shed, RobotId{3});
  changed(s.short_want, std::uint16_t{3});
  changed(s.plan_steps, std::uint8_t{3});
  changed(s.called_ticks, std::uint8_t{3});
  changed(s.detour.again, true);
  changed(s.corners.pinned, true);
  changed(s.corners.landmarks.size, std::uint8_t{1});
  changed(s.corners.bodies.size, std::uint8_t{1});
  EXPECT_EQ(seen.count(hash(s)), 1U);
  s.was_sent = true;  // a bit
  EXPECT_TRUE(seen.insert(hash(s)).second);
}

TEST(Step, MembersThatAreHeardLetALoneRobotBegin) {
  ConvoyBench bench;
  EXPECT_EQ(bench.steps(20).message.phase, Phase::init) << "nothing heard, nothing begun";
  bench.put(9, {0.5F, 0});
  bench.say(9).epoch = 1;
  bench.say(9).phase = Phase::start_tree;
  EXPECT_EQ(bench.step().message.phase, Phase::start_tree);
}

// ---- Nonsense from the sensors ----

// All that can be wrong in one tick.
struct Readings {
  Vec2 position;       // of the root
  float age_s = 0.0F;  // of that position
  std::vector<Vec2> obstacles;
  Senses senses;
};

// A member of a grown tree whose root, behind it, is heard every tick and counts; sent to a target.
template <class Kind> struct Sensing {
  static constexpr RobotId root_id = 9;
  typename Kind::Params params = Kind::defaults();
  typename Kind::State state = Kind::initial(1, true, false);
  typename Kind::Message root;
  int tick = 0;

  Sensing() {
    root.id = root_id;
    root.role = Role::root;
    root.root = state.root = {1, root_id};
    root.epoch = state.epoch = 1;
    root.phase = state.phase = Phase::grow_tree;
    root.label = 0;
    root.depth = 1;
    root.committed = true;
    root.tree_hops = 0;
    state.label = 192;
    state.parent = root_id;
    state.committed = true;
  }
  // What sensors that work say.
  [[nodiscard]] static Readings sane() {
    Readings r{.position = {-0.75F, 0.0F}, .obstacles = {{0.25F, 0.25F}}, .senses = {}};
    r.senses.orders = {true, Vec2{1.5F, 0.25F}};
    return r;
  }
  Output<typename Kind::Message> step(Readings& r) {
    if constexpr (requires { root.heartbeat; }) {
      root.heartbeat = static_cast<Serial>(100 + tick++);
      root.told = 1;
    }
    typename Kind::Heard heard{&root, r.position, r.age_s};
    r.senses.obstacles = r.obstacles;
    return Kind::step(params, state, {{&heard, 1}, r.senses, test_platform});
  }
  Output<typename Kind::Message> steps(int count) {
    Output<typename Kind::Message> output;
    Readings r = sane();
    for (int k = 0; k < count; ++k) output = step(r);
    return output;
  }
};

template <class Message> bool is_sound(const Output<Message>& output) {
  return within_limits(output.motion) && over_the_wire(output.message) == output.message;
}

RC_GTEST_PROP(Sensors, WhateverTheySayVelocityAndMessageAreSound, ()) {
  for_each_kind([]<class Kind>() {
    Sensing<Kind> robot;
    robot.steps(3);
    for (int t = 0; t < 10; ++t) {
      Readings r{.position = {garbage(), garbage()}, .age_s = garbage(), .obstacles = {}, .senses = {}};
      const int count = *rc::gen::inRange(0, 5);
      for (int k = 0; k < count; ++k) r.obstacles.push_back({garbage(), garbage()});
      r.senses.odometry = {garbage(), garbage(), garbage()};
      r.senses.orders = {*rc::gen::arbitrary<bool>(), Vec2{garbage(), garbage()}};
      r.senses.elapsed_s = garbage();
      RC_ASSERT(is_sound(robot.step(r)));
    }
    RC_ASSERT(is_sound(robot.steps(3)));
    RC_ASSERT(std::isfinite(Kind::report(robot.state).want));
  });
}

// One reading of one sensor that is no number, or far too large.
enum class Bad { position, age, odometry, turn, target, obstacle, elapsed };
constexpr std::array all_bad{Bad::position, Bad::age,      Bad::odometry, Bad::turn,
                             Bad::target,   Bad::obstacle, Bad::elapsed};

Readings spoilt(Readings r, Bad bad, float value) {
  switch (bad) {
    case Bad::position: r.position = {value, 0.0F}; break;
    case Bad::age: r.age_s = value; break;
    case Bad::odometry: r.senses.odometry.forward_m = value; break;
    case Bad::turn: r.senses.odometry.turn_rad = value; break;
    case Bad::target: r.senses.orders.target = Vec2{value, 0.0F}; break;
    case Bad::obstacle: r.obstacles.push_back({value, 0.0F}); break;
    case Bad::elapsed: r.senses.elapsed_s = value; break;
  }
  return r;
}

template <class Visit> void for_each_bad_reading(Visit visit) {
  for (const Bad bad : all_bad)
    for (const float value : {nan_m, infinite_m, -infinite_m, 3e38F, -3e38F}) {
      SCOPED_TRACE(testing::Message() << "reading " << static_cast<int>(bad) << ", " << value);
      visit(bad, value);
    }
}

TEST(Sensors, OneBadReadingMakesNoSecondRoot) {
  for_each_kind([]<class Kind>() {
    for_each_bad_reading([](Bad bad, float value) {
      Sensing<Kind> robot;
      robot.state.is_worker = false;
      const auto step = [&](bool spoil) {  // no worker: those never become root
        Readings r = spoil ? spoilt(Sensing<Kind>::sane(), bad, value) : Sensing<Kind>::sane();
        r.senses.orders.sent = false;
        return robot.step(r);
      };
      if constexpr (requires { robot.state.was_sent; }) robot.state.was_sent = false;
      for (int t = 0; t < 20; ++t) step(false);
      EXPECT_TRUE(is_sound(step(true)));
      for (int t = 0; t < 60; ++t) step(false);
      EXPECT_EQ(robot.state.root.sequence, 1);
      EXPECT_EQ(robot.state.root.id, Sensing<Kind>::root_id);
      EXPECT_EQ(robot.state.tally.elections, 0U);
    });
  });
}

TEST(Sensors, OneBadReadingReportsNoArrivalAndTurnsNobodyRound) {
  for_each_kind([]<class Kind>() {
    for_each_bad_reading([](Bad bad, float value) {
      Sensing<Kind> robot;
      const auto before = robot.steps(5);
      EXPECT_NEAR(before.message.want, 389, 1);
      Readings r = spoilt(Sensing<Kind>::sane(), bad, value);
      const auto spoilt = robot.step(r);
      EXPECT_NEAR(spoilt.message.want, 389, 1);
      EXPECT_TRUE(is_sound(spoilt));
      if (bad == Bad::target) {
        EXPECT_EQ(spoilt.motion.forward, before.motion.forward);
        EXPECT_EQ(spoilt.motion.turn, before.motion.turn);
      }
      EXPECT_NEAR(robot.steps(1).message.want, 389, 1);
    });
  });
}

TEST(Sensors, BadReadingsAreCounted) {
  for_each_kind([]<class Kind>() {
    for (const Bad bad : all_bad) {
      Sensing<Kind> robot;
      Readings r = spoilt(Sensing<Kind>::sane(), bad, nan_m);
      robot.step(r);
      robot.step(r);
      EXPECT_EQ(Kind::report(robot.state).tally.rejected, 2U) << static_cast<int>(bad);
    }
  });
}

}  // namespace
}  // namespace banyan
