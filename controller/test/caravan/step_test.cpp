// SPDX-License-Identifier: MIT
// One step as a whole: small, without heap, sound for whatever is heard and sensed. That scales do not matter is shown
// for all algorithms in algorithms/test/scaling_test.cpp.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "allocations.hpp"
#include "garbage.hpp"
#include "over_the_wire.hpp"
#include "tiny_world.hpp"

namespace banyan::caravan {
namespace {

TEST(CaravanStep, FitsARobotAndItsRadio) {
  EXPECT_LE(wire_size<Message>(), 57U) << "what a Crazyflie's packet carries safely";
  EXPECT_LE(sizeof(State), 6000U);
}

// One that stands stands in the way of a worker: both know afterwards where they are.
TEST(CaravanStep, NobodyPushes) {
  TinyWorld world({{0, 0}, {0.2F, 0}, {0.5F, 0}}, {1});
  world.hold(2);
  world.send(1, {0.8F, 0});
  for (int t = 0; t < 300; ++t) {
    world.step();
    ASSERT_GE(world.between(1, 2), 2.0F * world.params.body_radius) << t;
  }
}

// What a robot may hear, sane or not, as long as it passes the wire.
Message babble(Dice& dice, std::size_t robots) {
  const auto word = [&](std::size_t below) { return static_cast<std::uint16_t>(dice.below(below)); };
  const auto byte = [&] { return static_cast<std::uint8_t>(dice.below(256)); };
  const auto anybody = [&] { return dice.comes_up(0.3F) ? nobody : word(robots); };
  Message m;
  m.role = static_cast<Role>(dice.below(4));
  for (bool* flag : {&m.pinned, &m.leaving, &m.token.reached, &m.token.charging}) *flag = dice.comes_up(0.5F);
  for (RobotId* id : {&m.parent, &m.other, &m.call.source, &m.token.holder, &m.token.told}) *id = anybody();
  m.id = word(robots);
  m.root = {word(3), anybody()};
  m.beat = word(65536);
  for (std::uint16_t* length : {&m.label, &m.want}) *length = word(65536);
  m.hops = byte(), m.children = byte(), m.call.count = byte(), m.call.hops = byte();
  m.token.name = dice.comes_up(0.2F) ? root_name : anybody();
  m.token.beat = word(65536);
  m.token.x.bits = static_cast<std::int16_t>(word(65536)), m.token.y.bits = static_cast<std::int16_t>(word(65536));
  return m;
}

bool is_sound(const Output<Message>& output) {
  constexpr float limit = 1.0F + 1e-5F;
  const Vec2 v{output.motion.forward, output.motion.sideways};
  return norm(v) <= limit && std::isfinite(output.motion.turn) && over_the_wire(output.message) == output.message;
}

bool is_behind(const Statement& a, const Statement& b) {
  return a.root == b.root ? is_newer(b.beat, a.beat) : is_newer(b.root, a.root);
}

// Thousands of steps on nonsense, from more robots than the table holds.
TEST(CaravanStep, StandsNonsenseWithoutTheHeap) {
  Dice dice(7);
  Params params;
  static_cast<Machine&>(params) = machine_of(on_wheels_to_all_sides);
  std::vector<Message> messages(140);
  std::vector<Heard> packets(140);
  State state;
  bool sent = false;
  long taken = 0;
  int unsound = 0, steps_back = 0;
  for (int t = 0; t < 2000; ++t) {
    if (t % 50 == 0) state = initial(1, sent = dice.comes_up(0.5F), dice.comes_up(0.2F));
    const std::size_t count = dice.below(messages.size());
    for (std::size_t k = 0; k < count; ++k) {
      messages[k] = babble(dice, 200);
      packets[k] = {&messages[k], dice.on_disc(1.0F)};
    }
    const std::array obstacles{dice.on_disc(0.15F)};
    const Vec2 way = dice.on_disc(0.01F);
    const Senses senses{.odometry = {way.x, way.y, dice.between(-0.3F, 0.3F)},
                        .orders = {.sent = sent, .target = sent ? std::optional(dice.on_disc(4.5F)) : std::nullopt},
                        .obstacles = std::span(obstacles).first(dice.below(2)),
                        .charge = Charge{dice.share(), dice.comes_up(0.5F)}};
    const Statement before = state;
    const long start = test::allocations;
    const auto output = caravan::step(params, state, {std::span(packets).first(count), senses, on_wheels_to_all_sides});
    taken += test::allocations - start;
    unsound += is_sound(output) ? 0 : 1;
    steps_back += is_behind(output.message, before) ? 1 : 0;
  }
  EXPECT_EQ(taken, 0);
  EXPECT_EQ(unsound, 0);
  EXPECT_EQ(steps_back, 0);
  const long before = test::allocations;
  { const std::vector<int> some(100, 1); }
  EXPECT_GT(test::allocations, before) << "the counter counts";
}

// A worker of a grown tree, with a root that is heard all the time.
struct Sensing {
  Params params;
  State state = initial(1, true, false);
  Message root;
  std::vector<Vec2> obstacles;
  Senses senses;
  Vec2 position;
  float age_s = 0.0F;

  Sensing() {
    static_cast<Machine&>(params) = machine_of(on_wheels_to_all_sides);
    root.id = 9;
    root.role = Role::root;
    root.root = {1, 9};
    make_sane();
  }
  void make_sane() {
    position = {-0.75F, 0.0F};
    age_s = 0.0F;
    obstacles = {{0.25F, 0.25F}};
    senses = {};
    senses.orders = {.sent = true, .target = Vec2{1.5F, 0.25F}};
  }
  Output<Message> step() {
    root.beat = advanced(root.beat);
    Heard heard{&root, position, age_s};
    senses.obstacles = obstacles;
    return caravan::step(params, state, {{&heard, 1}, senses, on_wheels_to_all_sides});
  }
};

RC_GTEST_PROP(CaravanStep, WhateverSensorsSayVelocityAndMessageAreSound, ()) {
  Sensing robot;
  for (int t = 0; t < 3; ++t) robot.step();
  for (int t = 0; t < 10; ++t) {
    robot.position = {garbage(), garbage()};
    robot.age_s = garbage();
    robot.obstacles.clear();
    for (int left = *rc::gen::inRange(0, 4); left > 0; --left) robot.obstacles.push_back({garbage(), garbage()});
    robot.senses.odometry = {garbage(), garbage(), garbage()};
    robot.senses.orders.sent = *rc::gen::arbitrary<bool>();
    robot.senses.orders.target = Vec2{garbage(), garbage()};
    robot.senses.charge = Charge{garbage(), false};
    robot.senses.elapsed_s = *rc::gen::element(nan_m, infinite_m, -infinite_m, 3e38F, -3e38F, 0.0F, 0.2F);
    RC_ASSERT(is_sound(robot.step()));
  }
  // And it is a worker again as soon as they work.
  robot.make_sane();
  robot.senses.orders.sent = false;
  RC_ASSERT(is_sound(robot.step()));
  robot.make_sane();
  Output<Message> output;
  for (int t = 0; t < 3; ++t) RC_ASSERT(is_sound(output = robot.step()));
  RC_ASSERT(output.message.role == Role::worker);
  RC_ASSERT(std::abs(static_cast<int>(output.message.want) - 389) <= 1);
}

}  // namespace
}  // namespace banyan::caravan
