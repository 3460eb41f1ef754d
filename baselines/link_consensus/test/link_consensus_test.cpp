// SPDX-License-Identifier: MIT
// Link consensus: whatever is given up, the links that both ends keep join all robots, counted from outside.
#include "banyan/baselines/link_consensus/link_consensus.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "net.hpp"
#include "wild_senses.hpp"

namespace banyan::baselines::link_consensus {
namespace {

using Robots_ = Net<Robots>;

bool keep_each_other(const Robots_& net, std::size_t i, std::size_t j) {
  return net.states[i].links.keeps(static_cast<RobotId>(j)) && net.states[j].links.keeps(static_cast<RobotId>(i));
}

std::size_t kept_links(const Robots_& net) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < net.at.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) count += keep_each_other(net, i, j) ? 1 : 0;
  return count;
}

std::size_t kept_parts(const Robots_& net) {
  Components parts(net.at.size());
  for (std::size_t i = 0; i < net.at.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (keep_each_other(net, i, j)) parts.join(i, j);
  return parts.count();
}

Params eager() {  // to give up whatever can be
  Params p;
  p.add_distance = 0.05F;
  p.nominate_distance = 0.055F;
  return p;
}

struct Case {
  std::size_t robots;
  double side;
  double loss;
};

class Agreement : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(All, Agreement,
                         testing::Values(Case{8, 1.5, 0.0}, Case{20, 2.0, 0.0}, Case{20, 2.5, 0.3},
                                         Case{40, 3.0, 0.1}));

// All who want to be rid of all links: what is left at the end is a spanning tree, and on the way there the kept links
// never fall into parts.
TEST_P(Agreement, GivesUpEveryLinkButThoseOfATreeAndNeverTheLastPath) {
  const auto [robots, side, loss] = GetParam();
  std::size_t spare_links = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Draw draw(seed);
    Robots_ net(Params{}, connected_places(robots, side, 0.575, draw), seed);
    for (int t = 0; t < 20; ++t) net.tick();
    ASSERT_EQ(kept_parts(net), 1U) << seed;
    const std::size_t first = kept_links(net);
    spare_links += first - (robots - 1);
    net.params = eager();
    net.loss = loss;
    net.params.liveness_rounds = 30.0F;  // nobody falls silent by bad luck: that would not be an agreement
    for (int t = 0; t < 6000 && kept_links(net) > robots - 1; ++t) {
      net.tick();
      ASSERT_EQ(kept_parts(net), 1U) << "seed " << seed << ", tick " << t;
    }
    EXPECT_EQ(kept_links(net), robots - 1) << "seed " << seed << ", from " << first;
  }
  EXPECT_GT(spare_links, 0U);
}

// What makes two agreements at a time safe: the path of the first holds until its lease is over.
TEST(LinkConsensus, WhoVouchesForABidVouchesForNoOtherBeforeItsLeaseIsOver) {
  Robots_ net(Params{}, {{0, 0}, {0.5F, 0}, {1, 0}}, 1);
  for (int t = 0; t < 10; ++t) net.tick();
  State& middle = net.states[1];
  const auto hears = [&](Bid from_0, Bid from_2) {
    net.said[0].bid = from_0;
    net.said[2].bid = from_2;
    std::vector<Heard> heard{{net.said.data(), {-0.5F, 0}}, {&net.said[2], {0.5F, 0}}};
    return step(net.params, middle, {heard, {}, test_platform}).message.bid;
  };
  EXPECT_EQ(hears({0, 7, 160, 1, 5, 20}, {}), (Bid{0, 7, 160, 1, 4, 19}));
  for (int t = 18; t > 0; --t)
    EXPECT_EQ(hears({}, {2, 8, 180, 1, 5, 99}), (Bid{0, 7, 160, 1, 4, static_cast<std::uint8_t>(t)}));
  EXPECT_EQ(hears({0, 7, 160, 1, 5, 20}, {}), Bid{}) << "nor for the same bid again";
  EXPECT_EQ(hears({}, {2, 8, 180, 1, 5, 99}), (Bid{2, 8, 180, 1, 4, 98}));
}

// A lease lasts as long for a robot whose steps are no whole ticks.
TEST(LinkConsensus, ALeaseRunsOutByTheClockWhateverAStepLasts) {
  for (const float every : {0.3F, 1.0F, 1.4F, 1.6F, 2.5F}) {
    Robots_ net(Params{}, {{0, 0}, {0.5F, 0}, {1, 0}}, 1);
    for (int t = 0; t < 10; ++t) net.tick();
    State& middle = net.states[1];
    const auto hears = [&](Bid from_0) {
      net.said[0].bid = from_0;
      std::vector<Heard> heard{{net.said.data(), {-0.5F, 0}}, {&net.said[2], {0.5F, 0}}};
      Senses senses;
      senses.elapsed_s = every * test_platform.tick_s;
      return step(net.params, middle, {heard, senses, test_platform}).message.bid;
    };
    ASSERT_EQ(hears({0, 7, 160, 1, 5, 200}).lease_ticks, 199);
    const int steps = static_cast<int>(std::lround(140.0F / every));
    for (int t = 0; t < steps; ++t) hears({});
    EXPECT_NEAR(middle.bid.lease_ticks, 199 - 140, 2) << "after " << steps << " steps of " << every << " ticks";
  }
}

TEST(LinkConsensus, ABidGoesNoFartherThanItsReachAndNotOverItsOwnLink) {
  Robots_ net(Params{}, {{0, 0}, {0.5F, 0}, {1, 0}}, 1);
  for (int t = 0; t < 10; ++t) net.tick();
  const auto answers = [&](Bid bid) {
    State middle = net.states[1];
    net.said[0].bid = bid;
    std::vector<Heard> heard{{net.said.data(), {-0.5F, 0}}, {&net.said[2], {0.5F, 0}}};
    return step(net.params, middle, {heard, {}, test_platform}).message;
  };
  EXPECT_EQ(answers({0, 7, 160, 1, 1, 20}).bid.owner, 0);
  EXPECT_EQ(answers({0, 7, 160, 1, 0, 20}).bid.owner, nobody);
  EXPECT_EQ(answers({0, 1, 160, 1, 5, 20}).bid.owner, nobody) << "heard from its owner alone: no detour";
  EXPECT_TRUE(answers({2, 1, 160, 1, 5, 20}).agrees) << "robot 2's, come by robot 0";
}

// Robots drift about, as a test pulls them: no agreement cuts what the radio would still join.
TEST(LinkConsensus, KeepsRobotsTogetherThatWanderWithinTheirLinks) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Draw draw(seed);
    Robots_ net(Params{}, connected_places(24, 1.5, 0.55, draw), seed);
    std::vector<Vec2> course(24);
    std::size_t given_up = 0, links = 0;
    for (int t = 0; t < 900; ++t) {
      std::vector<Vec2> ways(24);
      for (std::size_t i = 0; i < 24; ++i) {
        if (t % 40 == 0) course[i] = unit_vector(static_cast<float>(draw(-3.1, 3.1))) * 0.006F;
        ways[i] = course[i];
        for (std::size_t j = 0; j < 24; ++j)  // nobody outruns a link
          if (net.states[i].links.find(static_cast<RobotId>(j)) >= 0 && distance(net.at[i] + ways[i], net.at[j]) > 0.9F)
            ways[i] = {};
      }
      net.tick(ways);
      given_up += kept_links(net) < links ? links - kept_links(net) : 0;
      links = kept_links(net);
      if (t > 10) { ASSERT_EQ(kept_parts(net), 1U) << "seed " << seed << ", tick " << t; }
    }
    EXPECT_GT(given_up, 5U) << seed;
  }
}

TEST(LinkConsensus, ATriangleGivesUpItsLongestLinkWithinASecond) {
  Robots_ net(Params{}, {{0, 0}, {0.5F, 0.025F}, {0.59F, 0.5F}}, 1);
  net.at[2] = {0.25F, 0.45F};
  for (int t = 0; t < 10; ++t) net.tick();
  const std::size_t before = kept_links(net);
  EXPECT_GE(before, 2U);
  net.at[1] = {0.8F, 0.0F};  // 0-1 is 0.8 C long now, longer than nominate_distance
  net.at[2] = {0.4F, 0.15F};
  for (int t = 0; t < 10; ++t) net.tick();
  EXPECT_FALSE(keep_each_other(net, 0, 1));
  EXPECT_TRUE(keep_each_other(net, 0, 2) && keep_each_other(net, 1, 2));
}

TEST(LinkConsensus, NewLinksAreThoseOfTheRelativeNeighborhoodGraph) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Draw draw(seed);
    Robots_ net(Params{}, connected_places(25, 2.0, 0.55, draw), seed);
    for (int t = 0; t < 6; ++t) net.tick();
    for (std::size_t i = 0; i < 25; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const float d = distance(net.at[i], net.at[j]);
        bool relative = d < net.params.add_distance;
        for (std::size_t k = 0; k < 25; ++k)
          if (k != i && k != j && std::max(distance(net.at[i], net.at[k]), distance(net.at[j], net.at[k])) < d - 5e-5F)
            relative = false;
        EXPECT_EQ(keep_each_other(net, i, j), relative) << seed << ": " << i << "-" << j;
      }
  }
}

TEST(LinkConsensus, WhoIsCutOffIsLetInAgain) {
  Robots_ net(Params{}, {{0, 0}, {0.5F, 0}, {1, 0}, {1.5F, 0}}, 1);
  net.hidden = [](std::size_t i, std::size_t j) { return (i == 3) != (j == 3); };
  for (int t = 0; t < 40; ++t) net.tick();
  EXPECT_EQ(kept_parts(net), 2U);
  net.hidden = [](std::size_t, std::size_t) { return false; };
  net.at[3] = {1.85F, 0.0F};  // too far for a new link between robots that are not cut off
  for (int t = 0; t < 40; ++t) net.tick();
  EXPECT_EQ(kept_parts(net), 1U);
  EXPECT_EQ(net.states[3].root, 0);
}

// Of the living the one with the smallest id, by everybody's belief.
TEST(LinkConsensus, ASilentRootIsReplaced) {
  Robots_ net(Params{}, {{2.5F, 2.5F}, {0, 0}, {0.5F, 0}, {1, 0}, {1.5F, 0}}, 1);
  net.at[0] = {0.25F, 0.4F};
  for (int t = 0; t < 30; ++t) net.tick();
  for (const State& s : net.states) EXPECT_EQ(s.root, 0);
  net.hidden = [](std::size_t i, std::size_t j) { return i == 0 || j == 0; };
  for (int t = 0; t < 200; ++t) net.tick();
  for (std::size_t i = 1; i < 5; ++i) {
    EXPECT_EQ(net.states[i].root, 1) << i;
    EXPECT_EQ(Robots::report(net.states[i]).parent, i == 1 ? nobody : i - 1) << i;
  }
}

// Silent for so long as the parameter says, and no longer.
TEST(LinkConsensus, ASilentRootIsReplacedAfterItsSilence) {
  for (const float silence : {30.0F, 100.0F}) {
    Robots_ net(Params{}, {{0.25F, 0.4F}, {0, 0}, {0.5F, 0}, {1, 0}, {1.5F, 0}}, 1);
    net.params.root_silence_rounds = silence;
    for (int t = 0; t < 30; ++t) net.tick();
    net.hidden = [](std::size_t i, std::size_t j) { return i == 0 || j == 0; };
    const int silent = whole(silence);
    for (int t = 0; t < silent; ++t) {
      net.tick();
      for (std::size_t i = 1; i < 5; ++i) EXPECT_EQ(net.states[i].root, 0) << "tick " << t;
    }
    for (int t = 0; t < 20; ++t) net.tick();
    std::uint32_t elections = 0;
    for (std::size_t i = 1; i < 5; ++i) {
      EXPECT_EQ(net.states[i].root, 1) << i << ", after " << silence << " rounds and 20 ticks";
      elections += net.states[i].tally.elections;
    }
    EXPECT_EQ(elections, 1U) << "by the robot with the smallest id and by nobody else";
  }
}

// A silence of more rounds than half of what a count goes round in, 32,768.
TEST(LinkConsensus, TheLongestSilenceEnds) {
  Robots_ net(Params{}, {{0.25F, 0.4F}, {0, 0}, {0.5F, 0}}, 1);
  net.params.root_silence_rounds = 60000.0F;
  for (int t = 0; t < 30; ++t) net.tick();
  net.hidden = [](std::size_t i, std::size_t j) { return i == 0 || j == 0; };
  for (int t = 0; t < 60000; ++t) net.tick();
  EXPECT_EQ(net.states[2].root, 0);
  for (int t = 0; t < 300; ++t) net.tick();
  EXPECT_EQ(net.states[1].root, 1);
  EXPECT_EQ(net.states[2].root, 1);
}

// However long the root was away: its count has gone round the half of its numbers, and looks older than when it left.
TEST(LinkConsensus, ALostRootThatComesBackIsFollowedAgain) {
  for (const int away : {200, 32000, 40000, 66000}) {
    Robots_ net(Params{}, {{0, 0}, {0.5F, 0}, {1, 0}, {1.5F, 0}}, 1);
    for (int t = 0; t < 30; ++t) net.tick();
    net.hidden = [](std::size_t i, std::size_t j) { return i == 0 || j == 0; };
    for (int t = 0; t < away; ++t) net.tick();
    for (std::size_t i = 1; i < 4; ++i) ASSERT_EQ(net.states[i].root, 1);
    net.hidden = [](std::size_t, std::size_t) { return false; };
    for (int t = 0; t < 40; ++t) net.tick();
    for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(net.states[i].root, 0) << "after " << away << " ticks";
    EXPECT_EQ(kept_parts(net), 1U);
  }
}

// What is counted is that a robot was cut off and is not any more.
TEST(LinkConsensus, ARepairIsALinkThatWasTakenUp) {
  Robots_ let_in(Params{}, {{0, 0}, {0.5F, 0}, {1, 0}, {1.5F, 0}}, 1);
  let_in.hidden = [](std::size_t i, std::size_t j) { return (i == 3) != (j == 3); };
  for (int t = 0; t < 40; ++t) let_in.tick();
  let_in.hidden = [](std::size_t, std::size_t) { return false; };
  let_in.at[3] = {1.85F, 0.0F};
  for (int t = 0; t < 40; ++t) let_in.tick();
  EXPECT_EQ(let_in.states[3].tally.repairs, 1U);

  // The only robot that it hears has all the links that a robot can have.
  std::vector<Vec2> places{{0, 0}};
  for (int i = 0; i < 12; ++i) places.push_back(unit_vector(0.5F * static_cast<float>(i)) * 0.5F);
  places.push_back({0.75F, 0.15F});
  Robots_ refused(Params{}, places, 1);
  refused.hidden = [](std::size_t i, std::size_t j) { return i != 0 && j != 0; };
  for (int t = 0; t < 300; ++t) refused.tick();
  EXPECT_EQ(refused.states[0].links.size(), 12);
  EXPECT_EQ(refused.states[13].tally.repairs, 0U);
}

// Each half a C from the next.
std::vector<Vec2> circle(std::size_t robots) {
  std::vector<Vec2> places;
  const float angle = 6.2831853F / static_cast<float>(robots);
  for (std::size_t i = 0; i < robots; ++i)
    places.push_back(unit_vector(angle * static_cast<float>(i)) * (0.5F / angle));
  return places;
}

// Bids that go round a circle come back in time, whatever a step lasts.
TEST(LinkConsensus, LongStepsGiveUpLinksToo) {
  for (const double every : {1.0, 3.0, 4.0, 8.0, 15.0}) {
    Robots_ net(Params{}, circle(7), 1);
    net.params.liveness_rounds = 100.0F;
    net.params.root_silence_rounds = 600.0F;
    net.period.assign(net.at.size(), every);
    for (int t = 0; t < 60.0 * every; ++t) net.tick();
    ASSERT_GE(kept_links(net), 7U) << every;
    net.params.add_distance = 0.05F;
    net.params.nominate_distance = 0.055F;
    for (int t = 0; t < 300.0 * every; ++t) net.tick();
    EXPECT_EQ(kept_links(net), 6U) << "steps of " << every << " ticks";
  }
}

// Clocks that run apart, steps that do not fit into ticks, packets that take long or get lost: the kept links never
// fall into parts while everybody wants to be rid of them.
TEST(LinkConsensus, NoClockAndNoDelayMakesAnAgreementCutTheNetwork) {
  const std::uint64_t seeds = long_search() ? 400 : 12;
  std::size_t given_up = 0, spare = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    Draw draw(seed);
    Robots_ net(eager(), seed % 3 == 0 ? circle(12 + seed % 7) : connected_places(14, 1.5, 0.575, draw), seed);
    for (std::size_t i = 0; i < net.at.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        if (distance(net.at[i], net.at[j]) > 0.75F || net.states[i].links.full() || net.states[j].links.full())
          continue;
        net.states[i].links.offer(static_cast<RobotId>(j), false);
        net.states[j].links.offer(static_cast<RobotId>(i), false);
      }
    net.params.liveness_rounds = 150.0F;
    net.params.root_silence_rounds = 6000.0F;
    net.states[0].root = nobody;  // no links are spared because they are somebody's way to a root: all are proposed
    net.states[0].way = not_rooted;
    for (int t = 0; t < 2; ++t) net.tick();
    ASSERT_EQ(kept_parts(net), 1U) << seed;
    const std::size_t first = kept_links(net);
    net.loss = 0.1 * static_cast<double>(seed % 5);
    net.latency = 1 + seed / 3 % 3;
    const double slowest = seed % 4 == 0 ? 1.0 : seed % 4 == 1 ? 1.3 : 7.0;
    for (std::size_t i = 0; i < net.at.size(); ++i) {
      net.period.push_back(draw(1.0, slowest));
      net.stepped[i] = static_cast<double>(net.ticks);
    }
    for (int t = 0; t < 2500; ++t) {
      net.tick();
      ASSERT_EQ(kept_parts(net), 1U) << "seed " << seed << ", tick " << t;
    }
    given_up += first - kept_links(net);
    spare += first - (net.at.size() - 1);
  }
  EXPECT_GT(spare, 10 * seeds);
  EXPECT_GT(3 * given_up, spare) << given_up << " of " << spare;
}

// ---- Motion ----

Vec2 velocity_of(Robots_& net, std::size_t i, std::optional<Vec2> target) {
  std::vector<Heard> heard;
  for (std::size_t j = 0; j < net.at.size(); ++j)
    if (net.hears(i, j)) heard.push_back({&net.said[j], net.at[j] - net.at[i]});
  Senses senses;
  senses.orders = {target.has_value(), target};
  net.params.drive = Drive::holonomic;
  State s = net.states[i];
  const Motion v = step(net.params, s, {heard, senses, test_platform}).motion;
  return {v.forward, v.sideways};
}

TEST(LinkConsensus, AKeptLinkIsNotOutgrown) {
  for (const float d : {0.85F, 0.925F, 0.95F}) {
    Robots_ net(Params{}, {{0, 0}, {0.5F, 0}}, 1);
    for (Vec2& f : net.facing) f = {1, 0};
    for (int t = 0; t < 10; ++t) net.tick();
    ASSERT_TRUE(keep_each_other(net, 0, 1));
    net.at[1] = {d, 0};
    const Vec2 v = velocity_of(net, 0, Vec2{-2.5F, 0});
    EXPECT_GE(v.x, -0.5F * (0.95F - d) * net.params.guard_rate - 5e-5F) << d;
    EXPECT_LE(std::fabs(v.x), 1.0F + 5e-6F);
  }
}

// (2): no force where phi is least, apart from there outwards if nearer, inwards if farther.
TEST(LinkConsensus, ALinkRestsAtItsLeastPotential) {
  const float rest = 0.95F / std::sqrt(2.0F);
  for (const float off : {-0.15F, 0.0F, 0.15F}) {
    Robots_ net(Params{}, {{0, 0}, {0.5F, 0}}, 1);
    for (Vec2& f : net.facing) f = {1, 0};
    for (int t = 0; t < 10; ++t) net.tick();
    net.at[1] = {rest + off, 0};
    const float v = velocity_of(net, 0, std::nullopt).x;
    if (off == 0.0F) EXPECT_EQ(v, 0.0F);
    else EXPECT_GT(v * off, 0.0F) << off;
  }
}

TEST(LinkConsensus, NothingSensedMakesAVelocityInfinite) {
  Robots_ net(Params{}, {{0, 0}, {0.5F, 0}, {0.5F, 0.5F}}, 1);
  for (int t = 0; t < 10; ++t) net.tick();
  Message wild = net.said[1];
  wild.links.fill(0);
  wild.bid = {1, 0, 0xFFFF, 7, 255, 255};
  wild.way = 0xFFFE;
  expect_finite_motion<Robots>(net, wild, 3);
}

}  // namespace
}  // namespace banyan::baselines::link_consensus
