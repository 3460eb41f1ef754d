// SPDX-License-Identifier: MIT
// The root counts; whoever is near to where it fell silent becomes root.
#include "healing/healing.hpp"

#include <gtest/gtest.h>

#include "watch.hpp"

namespace banyan {
namespace {

TEST(Heartbeat, OnlyALargerCountIsASignOfLife) {
  Watch watch;
  watch.hear_root(5);
  EXPECT_EQ(watch.bench.state.silence_ticks, 0);
  watch.bench.steps(7);  // the same count again and again
  EXPECT_EQ(watch.bench.state.silence_ticks, 7);
  watch.bench.say(root_id).heartbeat = static_cast<std::uint16_t>(watch.count - 3);
  watch.bench.step();
  EXPECT_EQ(watch.bench.state.silence_ticks, 8);
  watch.hear_root(1);
  EXPECT_EQ(watch.bench.state.silence_ticks, 0);
}

TEST(Heartbeat, CountsGoRound) {
  Watch watch;
  watch.count = 65530;
  watch.hear_root(20);
  EXPECT_EQ(watch.bench.state.silence_ticks, 0);
  EXPECT_EQ(watch.bench.state.heartbeat, static_cast<std::uint16_t>(watch.count - 1));
}

// Its count has gone half round meanwhile, and is behind the one I know.
TEST(Heartbeat, IsBelievedAgainAfterMoreThanHalfTheRangeOfSilence) {
  for (const int silence : {serial_half_range - 10, serial_half_range + 10}) {
    Watch watch;
    watch.hear_root(5);
    watch.bench.params.claim_radius = 0.01F;  // or it would take the root's place
    watch.bench.silence(root_id);
    watch.bench.steps(silence);
    watch.count = static_cast<std::uint16_t>(watch.count + 40000);
    watch.bench.put(root_id, {0.25F, 0.0F}).root = {1, root_id};
    watch.hear_root(1);
    EXPECT_EQ(watch.bench.state.silence_ticks == 0, silence > serial_half_range);
  }
}

TEST(Heartbeat, TheRootItselfBeats) {
  ConvoyBench bench;
  bench.state = initial_convoy_state(1, false, true);
  const std::uint16_t before = bench.step().message.heartbeat;
  EXPECT_EQ(bench.step().message.heartbeat, before + 1);
  EXPECT_EQ(bench.state.silence_ticks, 1) << "nobody hears it";
  bench.put(5, {0.5F, 0.0F});
  EXPECT_EQ(bench.step().message.heartbeat, before + 2);
  EXPECT_EQ(bench.state.silence_ticks, 0);
}

int claim_ticks(const ConvoyBench& bench, float away) {
  const auto& p = bench.params;
  return 2 * whole(p.liveness_rounds) + whole(p.claim_after_rounds + p.claim_spread_rounds * away);
}

TEST(Election, WhoIsNearClaimsAfterItsTurnAndOpensAnEpoch) {
  Watch watch;
  watch.hear_root(200);
  watch.bench.silence(root_id);
  auto& state = watch.bench.state;
  watch.bench.steps(claim_ticks(watch.bench, 0.25F));
  EXPECT_EQ(state.tally.elections, 0U);
  watch.bench.step();
  EXPECT_EQ(state.tally.elections, 1U);
  EXPECT_EQ(state.root, (RootToken{2, state.id}));
  EXPECT_EQ(state.role, Role::root);
  EXPECT_EQ(state.epoch, 2);
  EXPECT_EQ(state.phase, Phase::start_tree);
}

// Two that may claim hear each other: so two fragments never keep a root each at one place.
TEST(Election, TheCircleOfClaimantsIsSmallerThanTheRange) {
  const ConvoyParams p = convoy_defaults();
  EXPECT_LT(2.0F * p.claim_radius, 1.0F);
}

TEST(Election, NeitherTheFarNorWorkersNorWhoDoesNotHealClaim) {
  for (const int who : {0, 1, 2}) {
    Watch watch(who == 0 ? Vec2{0.75F, 0.0F} : Vec2{0.15F, 0.0F});
    if (who == 2) watch.bench.params.healing = 0.0F;
    watch.hear_root(3);
    if (who == 1) watch.bench.send({0.5F, 0.0F});
    if (who == 0) watch.bench.state.root_at = {0.75F, 0.0F};
    watch.bench.silence(root_id);
    watch.bench.steps(30);
    EXPECT_EQ(watch.bench.state.tally.elections, 0U) << who;
  }
}

// Around the robot, not counting those that a test puts there.
void put_crowd(ConvoyBench& bench) {
  for (int n = 0; n < 4; ++n) {
    const RobotId id = static_cast<RobotId>(11 + n);
    bench.put(id, {0.2F, 0.1F * static_cast<float>(n)}).role = Role::spare;
    bench.say(id).root = bench.state.root;
  }
}

// It died before it could speak. Of those that hear each other the one with the smallest id claims; workers do not
// count.
TEST(Election, OfThoseWhoNeverHeardOfARootTheFirstClaims) {
  for (const RobotId other : {RobotId{0}, RobotId{5}})
    for (const bool worker : {false, true}) {
      ConvoyBench bench;
      bench.state = initial_convoy_state(1, false, false);
      put_crowd(bench);
      bench.put(other, {0.5F, 0.0F}).role = worker ? Role::worker : Role::spare;
      bench.say(other).root = bench.state.root;
      bench.steps(200);
      EXPECT_EQ(bench.state.tally.elections, 0U);
      bench.step();
      EXPECT_EQ(bench.state.tally.elections, other < 1 && !worker ? 0U : 1U);
    }
}

// Among few neighbours the first token has one way or two, and where packets get lost each burst holds it up; part of a
// thin start may have to be fetched before it hears of the root.
TEST(Election, AmongFewNeighborsTheFirstRootIsAwaitedThreeTimesAsLong) {
  const auto ticks_until_elected = [](bool crowd, std::uint8_t at_start) {
    ConvoyBench bench;
    bench.state = initial_convoy_state(1, false, false);
    bench.put(5, {0.25F, 0.0F}).role = Role::spare;
    bench.say(5).root = bench.state.root;
    if (crowd) put_crowd(bench);
    int ticks = 0;
    for (; ticks < 1000 && bench.state.tally.elections == 0; ++ticks) {
      bench.state.neighbors_at_start = at_start;
      bench.state.usual_silence = 32;
      bench.step();
    }
    return ticks;
  };
  EXPECT_EQ(ticks_until_elected(true, 0), 201);
  EXPECT_EQ(ticks_until_elected(false, 0), 601) << "as in a line whose bodies hide all others";
  EXPECT_EQ(ticks_until_elected(true, 2), 601) << "the start was thin";
}

TEST(Election, WhoHearsNobodyNeedsNoRoot) {
  ConvoyBench bench;
  bench.state = initial_convoy_state(1, false, false);
  bench.steps(500);
  EXPECT_EQ(bench.state.tally.elections, 0U);
}

}  // namespace
}  // namespace banyan
