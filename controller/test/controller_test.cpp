// SPDX-License-Identifier: MIT
// One step as a whole: pure, without heap, safe for whatever arrives; parameters and policies.
#include "banyan/controller/controller.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "banyan/controller/policies.hpp"
#include "bench.hpp"
#include "heap_counter.hpp"

namespace banyan {
namespace {

using test::allocations;

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
  float meters(float limit) { return limit * (static_cast<float>(next() % 20001) * 1e-4F - 1.0F); }
};

// What a robot may hear, sane or not, as long as decode() lets it pass.
Message babble(Noise& noise, std::uint32_t robots) {
  const auto anybody = [&] { return noise.next() % 3 == 0 ? nobody : noise.word(robots); };
  Message m;
  m.id = noise.word(robots);
  m.role = static_cast<Role>(noise.word(4));
  m.phase = static_cast<Phase>(noise.word(5));
  m.need = static_cast<Need>(noise.word(3));
  m.flood_done = noise.word(2) != 0;
  m.committed = noise.word(2) != 0;
  m.epoch = noise.word(4);
  m.root = {noise.word(3), noise.word(robots)};
  m.label_cm = noise.next() % 4 == 0 ? unknown_label : noise.word(65535);
  m.pulse = noise.word(100);
  m.depth = noise.word(8);
  m.tree_hops = static_cast<std::uint8_t>(noise.word(256));
  m.call_hops = static_cast<std::uint8_t>(noise.word(256));
  for (RobotId* id : {&m.parent, &m.old_parent, &m.flood_parent, &m.grant, &m.request, &m.inserted_child, &m.warned, &m.new_root}) *id = anybody();
  m.flood_robots = noise.word(65535);
  m.subtree = noise.word(65535);
  m.count = noise.word(65535);
  m.q = {noise.meters(1e9F), noise.meters(1e9F)};
  m.pull_x = static_cast<std::int16_t>(noise.word(65535));
  m.want_cm = noise.word(65535);
  return m;
}

// Thousands of steps on nonsense: nothing from the heap, wheels within their limits, a message that
// others accept, and never a step back.
TEST(Controller, StandsNonsenseWithoutTheHeap) {
  constexpr std::size_t packets = 140;  // more than the table holds
  std::array<Message, packets> messages;
  std::array<Heard, packets> heard;
  Noise noise;
  long taken = 0;
  int bad_wheels = 0, bad_messages = 0, steps_back = 0;
  for (const Policy* policy : policies()) {
    for (const Reading reading : {Reading::literal, Reading::corrected}) {
      const Params params = policy->defaults(reading);
      State state = initial_state(1, true, false);
      for (int t = 0; t < 2000; ++t) {
        const std::size_t count = noise.next() % packets;
        for (std::size_t k = 0; k < count; ++k) {
          messages[k] = babble(noise, 200);
          heard[k] = {&messages[k], {noise.meters(2.0F), noise.meters(2.0F)}};
        }
        if (t % 50 == 0) state = initial_state(1, noise.word(2) != 0, noise.word(5) == 0);
        const Vec2 target{noise.meters(9.0F), noise.meters(9.0F)};
        const State before = state;
        const long start = allocations;
        const Output output = step(params, *policy, state, {heard.data(), count}, {noise.meters(0.02F), 0, noise.meters(0.3F)},
                                   state.is_worker ? &target : nullptr);
        taken += allocations - start;
        const float half = 0.5F * output.velocity.turn_rad_s * params.wheel_distance_m;
        const float limit = params.wheel_limit_m_s + 1e-5F;
        bad_wheels += std::fabs(output.velocity.forward_m_s - half) <= limit && std::fabs(output.velocity.forward_m_s + half) <= limit ? 0 : 1;
        const auto back = decode(encode(output.message));
        bad_messages += back && *back == output.message ? 0 : 1;
        steps_back += state.epoch < before.epoch || (state.epoch == before.epoch && state.phase < before.phase) || newer(before.root, state.root) ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(taken, 0);
  EXPECT_EQ(bad_wheels, 0);
  EXPECT_EQ(bad_messages, 0);
  EXPECT_EQ(steps_back, 0);
  const long before = allocations;
  { const std::string long_text(100, 'x'); }
  EXPECT_GT(allocations, before) << "the counter counts";
}

TEST(Controller, IsAPureFunctionOfItsArguments) {
  Noise noise;
  State a = initial_state(1, false, false);
  State b = a;
  const Params params = outwards().defaults(Reading::corrected);
  for (int t = 0; t < 300; ++t) {
    std::array<Message, 20> messages;
    std::array<Heard, 20> heard;
    for (std::size_t k = 0; k < messages.size(); ++k) {
      messages[k] = babble(noise, 30);
      heard[k] = {&messages[k], {noise.meters(2.0F), noise.meters(2.0F)}};
    }
    const Output x = step(params, outwards(), a, heard, {0.01F, 0, 0.1F}, nullptr);
    const Output y = step(params, outwards(), b, heard, {0.01F, 0, 0.1F}, nullptr);
    ASSERT_EQ(x.message, y.message);
    ASSERT_EQ(x.velocity.forward_m_s, y.velocity.forward_m_s);
    ASSERT_EQ(x.velocity.turn_rad_s, y.velocity.turn_rad_s);
    ASSERT_EQ(hash(a), hash(b));
  }
}

TEST(Controller, TheHashSeesEveryChange) {
  State s = initial_state(1, false, false);
  std::set<std::uint64_t> seen{hash(s)};
  const auto changed = [&](auto& field, auto value) {
    const auto before = field;
    field = value;
    EXPECT_TRUE(seen.insert(hash(s)).second);
    field = before;
  };
  changed(s.epoch, std::uint16_t{3});
  changed(s.phase, Phase::grow_tree);
  changed(s.pulse, std::uint16_t{3});
  changed(s.label_cm, std::uint16_t{3});
  changed(s.parent, RobotId{3});
  changed(s.old_parent, RobotId{3});
  changed(s.q, Vec2{1, 0});
  changed(s.centroid, Vec2{1, 0});
  changed(s.request, RobotId{3});
  changed(s.grant, RobotId{3});
  EXPECT_EQ(seen.count(hash(s)), 1U);
}

TEST(Controller, MembersThatAreHeardLetALoneRobotBegin) {
  Bench bench;
  EXPECT_EQ(bench.steps(20).message.phase, Phase::init) << "nothing heard, nothing begun";
  bench.put(9, {1.0F, 0});
  bench.say(9).epoch = 1;
  bench.say(9).phase = Phase::start_tree;
  EXPECT_EQ(bench.step().message.phase, Phase::start_tree);
}

TEST(Params, DefaultsAreTableI) {
  const Params out = outwards().defaults(Reading::corrected);
  EXPECT_FLOAT_EQ(out.ideal_distance_m, 1.90F);
  EXPECT_FLOAT_EQ(out.target_gain, 0.49F);
  EXPECT_FLOAT_EQ(out.reconfiguration_period_s, 38.8F);
  EXPECT_FLOAT_EQ(out.liveness_period_s, 1.2F);
  const Params in = inwards().defaults(Reading::literal);
  EXPECT_FLOAT_EQ(in.ideal_distance_m, 1.540841F);
  EXPECT_FLOAT_EQ(in.target_gain, 0.2539F);
  EXPECT_EQ(in.reading, Reading::literal);
  EXPECT_FLOAT_EQ(in.parent_range_m(), 2.0F) << "literal: parents up to C";
  EXPECT_FLOAT_EQ(out.parent_range_m(), 1.88F);
  for (const Policy* policy : policies()) EXPECT_EQ(fault(policy->defaults(Reading::corrected)), "");
}

TEST(Params, EveryOneIsCheckedAgainstItsRange) {
  for (const ParameterInfo& info : parameter_table()) {
    for (const float bad : {info.minimum - 1.0F, info.maximum * 2.0F, std::numeric_limits<float>::quiet_NaN()}) {
      Params p;
      p.*info.member = bad;
      EXPECT_NE(fault(p), "") << info.key << " = " << bad;
    }
    const Params defaults;
    EXPECT_GE(defaults.*info.member, info.minimum) << info.key;
    EXPECT_LE(defaults.*info.member, info.maximum) << info.key;
  }
}

TEST(Params, TheOrderOfDistancesIsChecked) {
  const auto faulty = [](float Params::*member, float value) {
    Params p;
    p.*member = value;
    return !fault(p).empty();
  };
  EXPECT_TRUE(faulty(&Params::avoidance_range_m, 1.33F));
  EXPECT_TRUE(faulty(&Params::recruitment_distance_m, 1.40F));
  EXPECT_TRUE(faulty(&Params::safe_range_m, 1.95F));
  EXPECT_TRUE(faulty(&Params::ideal_distance_m, 2.01F));
  EXPECT_FALSE(faulty(&Params::ideal_distance_m, 2.0F)) << "an edge without margin, but possible";
}

TEST(Policies, AreFoundByName) {
  for (const Policy* policy : policies()) {
    EXPECT_EQ(find_policy(policy->name()), policy);
    EXPECT_FALSE(policy->summary().empty());
  }
  EXPECT_EQ(find_policy("sideways"), nullptr);
}

}  // namespace
}  // namespace banyan
