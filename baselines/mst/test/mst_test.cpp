// SPDX-License-Identifier: MIT
// MST preservation: what the robots agree on is the minimum spanning tree that Kruskal's algorithm finds in the true
// graph, and on the way from one tree to the next nobody is left alone.
#include "banyan/baselines/mst/mst.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "net.hpp"
#include "wild_senses.hpp"

namespace banyan::baselines::mst {
namespace {

using Swarm_ = Net<Robots>;
using Pairs = std::set<std::pair<std::size_t, std::size_t>>;

// Of all links that may be in a tree: those that leave room to move. Lengths are compared in C/2000.
Pairs kruskal(const Swarm_& net) {
  struct Link {
    int steps;
    std::size_t i, j;
  };
  std::vector<Link> links;
  for (std::size_t i = 0; i < net.at.size(); ++i)
    for (std::size_t j = i + 1; j < net.at.size(); ++j)
      if (const float d = distance(net.at[i], net.at[j]); net.hears(i, j) && d < 0.97F * net.params.longest_link)
        links.push_back({static_cast<int>(std::lround(d * 2000.0F)), i, j});
  std::sort(links.begin(), links.end(),
            [](const Link& a, const Link& b) { return std::tie(a.steps, a.i, a.j) < std::tie(b.steps, b.i, b.j); });
  Components parts(net.at.size());
  Pairs tree;
  for (const Link& link : links)
    if (parts.join(link.i, link.j)) tree.insert({link.i, link.j});
  return tree;
}

// An edge counts if both ends keep it; one that a single end keeps is a fault where the test says so.
Pairs kept(const Swarm_& net, bool by_both = true) {
  Pairs pairs;
  for (std::size_t i = 0; i < net.at.size(); ++i)
    for (const RobotId end : net.states[i].tree)
      if (!by_both || net.states[end].tree.has(static_cast<RobotId>(i))) pairs.insert(std::minmax<std::size_t>(i, end));
  return pairs;
}

double length_of(const Swarm_& net, const Pairs& pairs) {
  double sum = 0.0;
  for (const auto& [i, j] : pairs) sum += static_cast<double>(distance(net.at[i], net.at[j]));
  return sum;
}

// By what both ends report that they keep: while trees are switched, edges of either.
std::size_t held_parts(const Swarm_& net) {
  Components parts(net.at.size());
  for (std::size_t i = 0; i < net.at.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (keeps(report(net.states[i]), static_cast<RobotId>(j)) &&
          keeps(report(net.states[j]), static_cast<RobotId>(i)))
        parts.join(i, j);
  return parts.count();
}

bool all_done(const Swarm_& net) {
  return std::all_of(net.states.begin(), net.states.end(), [&](const State& s) {
    return s.done && s.tree_epoch == net.states[0].tree_epoch && s.tree_epoch > 0;
  });
}

struct Case {
  std::size_t robots;
  double side;
  double loss;
  bool occluded;
};
class Tree : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(All, Tree,
                         testing::Values(Case{2, 1.0, 0.0, false}, Case{10, 2.0, 0.0, false}, Case{30, 3.0, 0.0, false},
                                         Case{30, 1.5, 0.3, false}, Case{60, 5.0, 0.0, false},
                                         Case{40, 3.0, 0.2, true}));

// Robots within C/40 of the straight line between two others hide them from each other.
void hide_behind_bodies(Swarm_& net) {
  net.hidden = [&net](std::size_t i, std::size_t j) {
    const Vec2 way = net.at[j] - net.at[i];
    const float d = norm(way);
    for (std::size_t k = 0; k < net.at.size(); ++k) {
      if (k == i || k == j) continue;
      const Vec2 to = net.at[k] - net.at[i];
      const float along = dot(to, way) / d;
      if (along > 0.0F && along < d && std::fabs(cross(to, way)) / d < 0.025F) return true;
    }
    return false;
  };
}

TEST_P(Tree, IsThatOfKruskalOverTheTrueGraph) {
  const auto [robots, side, loss, occluded] = GetParam();
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Draw draw(seed);
    Swarm_ net(Params{}, connected_places(robots, side, 0.7, draw), seed);
    net.params.liveness_rounds = 30.0F;
    if (occluded) hide_behind_bodies(net);
    net.loss = loss;
    for (int t = 0; t < 1000 && !all_done(net); ++t) net.tick();
    ASSERT_TRUE(all_done(net)) << seed;
    const Pairs tree = kruskal(net);
    EXPECT_EQ(kept(net), tree) << "seed " << seed << ": " << length_of(net, kept(net)) << " C instead of "
                               << length_of(net, tree);
    EXPECT_EQ(kept(net, false), tree) << seed;
    for (int t = 0; t < 40; ++t) net.tick();
    for (const State& s : net.states) EXPECT_EQ(s.old.size(), 0U) << "nothing is held longer than needed";
    // One root, and each parent is the other end of an edge, nearer to it.
    std::size_t tops = 0;
    for (const State& s : net.states) {
      tops += s.parent == nobody ? 1 : 0;
      EXPECT_EQ(s.root, 0) << "nobody is a worker: the smallest id";
      if (s.parent != nobody) { EXPECT_TRUE(s.tree.has(s.parent)); }
    }
    EXPECT_EQ(tops, 1U);
  }
}

// Robots drift as far as their edges let them; trees follow one another, and at every tick the edges that both ends
// keep join all robots.
TEST(Mst, OneTreeFollowsTheOtherWithoutAGap) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    constexpr std::size_t n = 24;
    Draw draw(seed);
    Swarm_ net(Params{}, connected_places(n, 1.5, 0.55, draw), seed);
    std::vector<Vec2> course(n);
    for (int t = 0; t < 100; ++t) net.tick();
    ASSERT_TRUE(all_done(net));
    const Serial first = net.states[0].tree_epoch;
    for (int t = 0; t < 1500; ++t) {
      std::vector<Vec2> ways(n);
      for (std::size_t i = 0; i < n; ++i) {
        if (t % 50 == 0) course[i] = unit_vector(static_cast<float>(draw(-3.1, 3.1))) * 0.005F;
        ways[i] = course[i];
        const State& s = net.states[i];
        for (std::size_t j = 0; j < n; ++j) {
          const auto id = static_cast<RobotId>(j);
          const bool holds = s.tree.has(id) || s.old.has(id) || s.branches.has(id) ||
                             std::any_of(s.candidates.begin(), s.candidates.begin() + s.candidate_count,
                                         [&](const Candidate& c) { return c.to == id && c.narrow && !s.done; });
          if (holds && distance(net.at[i] + ways[i], net.at[j]) > std::max(0.9F, distance(net.at[i], net.at[j])))
            ways[i] = {};
        }
      }
      net.tick(ways);
      ASSERT_EQ(held_parts(net), 1U) << "seed " << seed << ", tick " << t;
    }
    EXPECT_GT(net.states[0].tree_epoch, first + 3) << seed;
  }
}

TEST(Mst, ALongEdgeTriggersANewTreeAndNothingElseDoes) {
  Swarm_ net(Params{}, {{0, 0}, {0.5F, 0}, {1, 0}, {0.55F, 0.5F}}, 1);
  for (int t = 0; t < 60; ++t) net.tick();
  ASSERT_TRUE(all_done(net));
  const Serial first = net.states[0].tree_epoch;
  for (int t = 0; t < 300; ++t) net.tick();
  EXPECT_EQ(net.states[0].tree_epoch, first);
  net.at[2] = {0.95F, 0.8F};  // 1-2 is longer than the trigger, 3-2 shorter
  for (int t = 0; t < 60; ++t) net.tick();
  EXPECT_EQ(net.states[0].tree_epoch, first + 1);
  EXPECT_EQ(kept(net), kruskal(net));
  EXPECT_TRUE(net.states[2].tree.has(3));
}

TEST(Mst, AWorkerIsNeverRootAndADeadRootIsReplaced) {
  Swarm_ net(Params{}, {{0, 0}, {0.5F, 0}, {0.85F, 0.05F}, {1.5F, 0}}, 1);
  for (int t = 0; t < 80; ++t) net.tick();
  for (const State& s : net.states) EXPECT_EQ(s.root, 0);
  net.orders[0] = {true, Vec2{0.0F, 0.0F}};
  for (int t = 0; t < 200; ++t) net.tick();
  for (const State& s : net.states) EXPECT_EQ(s.root, 1) << "0 is a worker now";
  net.hidden = [](std::size_t i, std::size_t j) { return i == 1 || j == 1; };  // 0 and 2 are in range of each other
  for (int t = 0; t < 200; ++t) net.tick();
  for (const std::size_t i : {0U, 2U, 3U}) EXPECT_EQ(net.states[i].root, 2);
}

TEST(Mst, TwoNetworksThatMeetBecomeOne) {
  Swarm_ net(Params{}, {{0, 0}, {0.5F, 0}, {1, 0}, {1.5F, 0}}, 1);
  net.hidden = [](std::size_t i, std::size_t j) { return (i < 2) != (j < 2); };
  for (int t = 0; t < 120; ++t) net.tick();
  EXPECT_EQ(held_parts(net), 2U);
  net.hidden = [](std::size_t, std::size_t) { return false; };
  for (int t = 0; t < 200; ++t) net.tick();
  EXPECT_EQ(held_parts(net), 1U);
  EXPECT_EQ(kept(net), kruskal(net));
}

// Links that one end alone says it keeps.
std::size_t one_sided(const Swarm_& net) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < net.at.size(); ++i)
    for (const RobotId end : report(net.states[i]).kept)
      count += end != nobody && !keeps(report(net.states[end]), static_cast<RobotId>(i)) ? 1 : 0;
  return count;
}

// One has built many more trees than the other: robot 3 stays too far from 2 for a while, which asks for trees.
TEST(Mst, NetworksThatHaveBuiltDifferentNumbersOfTreesMeetAsQuickly) {
  for (const int long_for : {0, 200, 2000}) {
    Swarm_ net(Params{}, {{0, 0}, {0.5F, 0}, {1, 0}, {1.85F, 0}}, 1);
    net.hidden = [](std::size_t i, std::size_t j) { return (i < 2) != (j < 2); };
    for (int t = 0; t < 100 + long_for; ++t) net.tick();
    net.at[3].x = 1.5F;
    for (int t = 0; t < 100; ++t) net.tick();
    ASSERT_EQ(held_parts(net), 2U);
    const int apart = ahead_by(net.states[2].tree_epoch, net.states[0].tree_epoch);
    EXPECT_GE(apart, long_for / 100);
    net.hidden = [](std::size_t, std::size_t) { return false; };
    for (int t = 0; t < 50; ++t) net.tick();
    EXPECT_EQ(held_parts(net), 1U) << apart << " trees apart";
    EXPECT_EQ(kept(net), kruskal(net)) << apart;
    for (int t = 0; t < 100; ++t) {
      net.tick();
      ASSERT_EQ(one_sided(net), 0U) << apart << " trees apart, tick " << t;
    }
  }
}

// Networks come within range of one another in the midst of whatever they are doing.
TEST(Mst, NetworksThatMeetAtAnyMomentBecomeOneTree) {
  const int cases = long_search() ? 2000 : 40;
  for (int k = 0; k < cases; ++k) {
    const int moment = k % 40;
    Swarm_ net(Params{},
               {{0, 0}, {0.5F, 0}, {1, 0}, {1.5F, 0}, {2, 0}, {2.5F, 0}, {3.0F, 0.05F}, {3.5F, 0}, {4.0F, 0.1F}},
               static_cast<std::uint64_t>(k));
    net.loss = 0.2 * (moment % 2);
    net.params.liveness_rounds = 30.0F;
    net.hidden = [](std::size_t i, std::size_t j) { return i / 3 != j / 3; };
    for (std::size_t i = 3; i < 9; ++i) net.states[i].epoch = net.states[i].next = static_cast<Serial>(7 * (i / 3));
    for (std::size_t i = 3; i < 9; ++i) net.states[i].next = static_cast<Serial>(net.states[i].next + 1);
    for (int t = 0; t < 10 + moment; ++t) net.tick();
    net.hidden = [](std::size_t, std::size_t) { return false; };
    for (int t = 0; t < 160; ++t) net.tick();
    EXPECT_EQ(kept(net), kruskal(net)) << "met at tick " << 10 + moment;
    EXPECT_EQ(kept(net, false), kruskal(net)) << "met at tick " << 10 + moment;
  }
}

// Two ends that measure different lengths may choose edges in a circle, which is none of a tree. It takes a while
// longer, but no second construction.
TEST(Mst, EndsThatDisagreeAboutLengthsFindATreeAllTheSame) {
  constexpr std::uint64_t seeds = 40;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    Draw draw(seed);
    Swarm_ net(Params{}, connected_places(24, 1.5, 0.6, draw), seed);
    net.noise_m = 0.05;
    net.params.build_rounds = 600.0F;
    for (int t = 0; t < 500 && !all_done(net); ++t) net.tick();
    ASSERT_TRUE(all_done(net)) << seed;
    EXPECT_EQ(net.states[0].tree_epoch, 1) << seed;
    EXPECT_EQ(kept(net).size(), 23U) << seed;
    EXPECT_EQ(kept(net, false).size(), 23U) << seed;
    EXPECT_EQ(held_parts(net), 1U) << seed;
  }
}

// Whoever follows the parents comes to the robot that is said to be root, over edges of the tree.
TEST(Mst, ParentsLeadToTheRoot) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Draw draw(seed);
    Swarm_ net(Params{}, connected_places(20, 2.0, 0.65, draw), seed);
    for (std::size_t i = 0; i < seed % 5; ++i) net.orders[i] = {true, Vec2{0.05F, 0.0F}};
    for (int t = 0; t < 300; ++t) net.tick();
    ASSERT_TRUE(all_done(net)) << seed;
    for (std::size_t i = 0; i < net.states.size(); ++i) {
      const Report mine = report(net.states[i]);
      EXPECT_EQ(mine.root, seed % 5) << "the smallest that is no worker";
      std::size_t at = i;
      for (std::size_t hop = 0; hop < net.states.size() && report(net.states[at]).parent != nobody; ++hop) {
        const RobotId up = report(net.states[at]).parent;
        ASSERT_TRUE(net.states[at].tree.has(up) && net.states[up].tree.has(static_cast<RobotId>(at)))
            << at << " to " << up;
        at = up;
      }
      EXPECT_EQ(at, mine.root) << "from " << i << ", seed " << seed;
    }
  }
}

// Nothing but the hub hears anybody: a tree of all would need more edges than a robot can keep. Nobody promises
// what the other end has no room for.
TEST(Mst, WhoHasNoRoomForAnotherEdgeIsNotPromisedOne) {
  for (const std::size_t rays : {12U, 13U, 20U}) {
    std::vector<Vec2> places{{0, 0}};
    for (std::size_t i = 0; i < rays; ++i)
      places.push_back(unit_vector(6.28F * static_cast<float>(i) / static_cast<float>(rays)) *
                       (0.5F + 0.005F * static_cast<float>(i)));
    Swarm_ net(Params{}, places, 1);
    net.hidden = [](std::size_t i, std::size_t j) { return i != 0 && j != 0; };
    for (int t = 0; t < 300; ++t) net.tick();
    const Serial epoch = net.states[0].epoch;
    for (int t = 0; t < 300; ++t) {
      net.tick();
      ASSERT_EQ(one_sided(net), 0U) << rays << " rays, tick " << t;
    }
    EXPECT_EQ(net.states[0].epoch, epoch) << "and there is no end of trying";
    EXPECT_EQ(kept(net).size(), 12U);
  }
}

// At any C that a scenario may have.
TEST(Mst, LengthsKeepTheirOrderWhateverTheRange) {
  for (const float range_m : {0.05F, 2.0F, 60.0F, 100.0F}) {
    const float r = 0.01F * range_m;
    // 0-1 is the longest side of a triangle of which none is shorter than 0.8 C.
    Swarm_ net(Params{}, {{0, 0}, {90.0F * r, 0}, {45.0F * r, 68.0F * r}}, 1);
    net.platform.communication_range_m = range_m;
    for (int t = 0; t < 80; ++t) net.tick();
    EXPECT_EQ(kept(net), (Pairs{{0, 2}, {1, 2}})) << range_m;
  }
}

TEST(Mst, NothingSensedMakesAVelocityInfinite) {
  Swarm_ net(Params{}, {{0, 0}, {0.5F, 0}, {0.5F, 0.5F}}, 1);
  for (int t = 0; t < 60; ++t) net.tick();
  Message wild = net.said[1];
  wild.branches.fill(0);
  wild.epoch = wild.next = static_cast<Serial>(wild.epoch + 1);
  wild.level = 255;
  wild.best = wild.choice = {0, 0, 0};
  wild.decided = wild.ready = true;
  expect_finite_motion<Robots>(net, wild, 5, [](const State&, Message& m, int t) { m.up = static_cast<RobotId>(t); });
}

}  // namespace
}  // namespace banyan::baselines::mst
