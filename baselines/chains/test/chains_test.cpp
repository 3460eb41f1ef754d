// SPDX-License-Identifier: MIT
// Chains from a base: the spacing laws as equations, the number of relays, and how a chain closes up.
#include "banyan/baselines/chains/chains.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "net.hpp"
#include "wild_senses.hpp"

namespace banyan::baselines::chains {
namespace {

using Swarm_ = Net<Robots>;

// A robot that turns on the spot would not show the direction in which it wants to go.
Params holonomic() {
  Params p;
  p.drive = Drive::holonomic;
  return p;
}

// Robot 1 in a chain of worker 9, on the x axis: its parent, the base 0, behind it, its child 2 before it.
class OnAxis {
 public:
  OnAxis(const Params& params, bool worker) : params_(params), state_(Robots::initial(1, worker, false)) {
    base_.id = base_.root = 0;
    child_ = {.id = 2, .worker = 9, .whole = true, .above = {1, 0, nobody, nobody}};
    child_.below[0] = 9;
    child_.root = 0;
  }
  Motion step(float parent, float child, int links_of_child, float beyond_child, float target) {
    std::vector<Heard> heard{{&base_, {-parent, 0.0F}}};
    child_.links = static_cast<std::uint8_t>(links_of_child);
    child_.beyond = static_cast<std::uint16_t>(std::lround(beyond_child * per_range));
    child_.asks = state_.is_free() ? 1 : nobody;
    Senses senses;
    if (state_.is_worker() || state_.assignment.sent) senses.orders = {true, Vec2{target, 0.0F}};
    else heard.push_back({&child_, {child, 0.0F}});
    return Robots::step(params_, state_, {heard, senses, test_platform}).motion;
  }
  [[nodiscard]] const State& state() const { return state_; }

 private:
  Params params_;
  State state_;
  Message base_, child_;
};

// What the guard leaves of a speed away from a parent at distance d: (MAX - d) / 2 times its rate.
float guarded(const Params& p, float d) { return std::min(p.speed_gain, 0.5F * (p.longest_link - d) * p.guard_rate); }

TEST(Chains, AWorkerGoesOnWhileItsParentIsSafeAndBackWhereItIsCritical) {
  const Params p = holonomic();
  for (int cm = 30; cm < 140; ++cm) {
    const float d = 0.005F * static_cast<float>(cm);
    OnAxis worker(p, true);
    worker.step(0.25F, 0.0F, 0, 0.0F, 2.5F);
    const float v = worker.step(d, 0.0F, 0, 0.0F, 2.5F).forward;
    const float expected = d < 0.56F ? guarded(p, d) : d < 0.64F ? 0.0F : -p.speed_gain;
    EXPECT_NEAR(v, expected, 5e-4F) << d;
  }
}

TEST(Chains, ARelayGoesOnUntilItIsSoManySafeDistancesBeforeTheTargetAsLinksFromTheWorker) {
  const Params p = holonomic();
  for (const float d : {0.2F, 0.45F, 0.5575F, 0.5625F, 0.6375F, 0.6425F, 0.675F})
    for (int links = 0; links < 3; ++links)
      for (const float child : {0.25F, 0.45F, 0.55F, 0.6F})
        for (const float beyond : {0.0F, 77.0F / per_range, 141.0F / per_range, 166.0F / per_range, 1.25F}) {
          OnAxis relay(p, false);
          for (int t = 0; t < 2; ++t) relay.step(0.2F, child, links, beyond, 0.0F);
          ASSERT_EQ(relay.state().chains[0].parent, 0);
          const float v = relay.step(d, child, links, beyond, 0.0F).forward;
          const float missing = child + beyond - static_cast<float>(links + 1) * 0.56F;
          if (d >= 0.64F) {
            EXPECT_NEAR(v, -guarded(p, child), 5e-4F) << d;
          } else if (d >= 0.56F || missing < 0.0025F) {
            EXPECT_EQ(v, 0.0F) << d << ' ' << missing;
          } else {
            const float wanted = p.speed_gain * std::min(1.0F, missing / 0.1F);
            EXPECT_NEAR(v, std::min(guarded(p, d), wanted), 5e-4F) << d;
          }
        }
}

TEST(Chains, TheBaseStaysWhereItIs) {
  Swarm_ net(holonomic(), {{0.0F, 0.0F}, {0.05F, 0.0F}, {0.95F, 0.0F}}, 1);
  for (int t = 0; t < 20; ++t) net.tick();
  Message near = net.said[1];
  std::vector<Heard> heard{{&near, {0.025F, 0.0F}}};
  const std::array obstacles{Vec2{0.05F, 0.0F}};
  Senses senses;
  senses.obstacles = obstacles;
  const Motion v = Robots::step(net.params, net.states[0], {heard, senses, test_platform}).motion;
  EXPECT_TRUE(v.forward == 0.0F && v.sideways == 0.0F && v.turn == 0.0F);
  EXPECT_NE(Robots::step(net.params, net.states[1], {heard, senses, test_platform}).motion.forward, 0.0F)
      << "another would move";
}

// Robot 0 is the base, 1 a worker that stands `at`, with its target `target` from the base; the rest is free.
Swarm_ mission(Params params, std::vector<Vec2> free, Vec2 at, float target, std::uint64_t seed) {
  std::vector<Vec2> places{{0.0F, 0.0F}, at};
  places.insert(places.end(), free.begin(), free.end());
  Swarm_ net(params, places, seed);
  net.orders[1] = {true, rotate_back(net.facing[1], Vec2{target, 0.0F} - at)};
  return net;
}
std::vector<Vec2> row(int count, float first, float apart) {
  std::vector<Vec2> places;
  places.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) places.push_back({first + static_cast<float>(i) * apart, 0.025F});
  return places;
}

// From the worker to the base by parents; empty if that does not lead there.
std::vector<std::size_t> relays_of(const Swarm_& net, std::size_t chain = 0) {
  std::vector<std::size_t> relays;
  for (RobotId at = net.states[1].chains[chain].parent; at != 0; at = net.states[at].chains[0].parent) {
    if (at == nobody || relays.size() > net.at.size()) return {};
    relays.push_back(at);
  }
  return relays;
}

// The authors' program: ceil(path / SAFE) links, so one relay less.
TEST(Chains, AsManyRelaysJoinAsThePathHasSafeDistances) {
  for (int cm = 120; cm < 900; cm += 17) {
    const float target = 0.005F * static_cast<float>(cm);
    Swarm_ net = mission(Params{}, row(10, 0.05F, 0.04F), {0.475F, 0.0F}, target, 3);
    for (int t = 0; t < 120; ++t) net.tick();
    EXPECT_EQ(relays_of(net).size(), static_cast<std::size_t>(std::ceil(cm / 112.0)) - 1) << target;
  }
}

TEST(Chains, TwoChainsHaveNoRobotInCommon) {
  Params p;
  p.chains_per_target = 2.0F;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Swarm_ net = mission(p, row(10, 0.05F, 0.04F), {0.475F, 0.0F}, 1.5F, seed);
    net.loss = 0.3 * static_cast<double>(seed % 2);
    for (int t = 0; t < 300; ++t) net.tick();
    std::set<std::size_t> all;
    for (const std::size_t chain : {0U, 1U})
      for (const std::size_t relay : relays_of(net, chain)) EXPECT_TRUE(all.insert(relay).second) << relay;
    EXPECT_EQ(all.size(), 4U) << seed;
    const Report r = report(net.states[1]);
    EXPECT_EQ(r.parent, net.states[1].chains[0].parent);
    EXPECT_EQ(r.kept[0], net.states[1].chains[1].parent);
  }
}

// A robot hears some of those that are next but one, so a chain of robots near each other closes up where it stands.
TEST(Chains, WhoDiesIsPassedOverWithinBoundedTime) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Swarm_ net = mission(Params{}, row(6, 0.15F, 0.125F), {0.95F, 0.0F}, 3.0F, seed);
    net.loss = 0.2 * static_cast<double>(seed % 2);
    for (int t = 0; t < 300; ++t) net.tick();
    std::vector<std::size_t> relays = relays_of(net);
    ASSERT_GE(relays.size(), 3U) << seed;
    const std::size_t dead = relays[seed % relays.size()];
    net.hidden = [dead](std::size_t i, std::size_t j) { return i == dead || j == dead; };
    // Forty ticks until it counts as silent; then news of the next parent takes some.
    for (int t = 0; t < 40 + 12; ++t) net.tick();
    relays = relays_of(net);
    EXPECT_FALSE(relays.empty()) << seed;
    EXPECT_EQ(std::count(relays.begin(), relays.end(), dead), 0) << seed;
    std::size_t below = 1;
    for (const std::size_t relay : relays) {
      EXPECT_EQ(net.states[relay].child, below) << seed;
      EXPECT_TRUE(net.states[relay].whole) << seed;
      below = relay;
    }
  }
}

// The far end of what a robot lists is as far as it can skip.
TEST(Chains, ListsNameTheNextFourRobotsEachWay) {
  Swarm_ net = mission(Params{}, row(6, 0.15F, 0.125F), {0.95F, 0.0F}, 4.0F, 1);
  for (int t = 0; t < 200; ++t) net.tick();
  std::vector<std::size_t> way{1};
  for (const std::size_t relay : relays_of(net)) way.push_back(relay);
  way.push_back(0);
  ASSERT_EQ(way.size(), 8U);
  for (std::size_t i = 1; i + 1 < way.size(); ++i)
    for (std::size_t n = 0; n < listed; ++n) {
      const State& s = net.states[way[i]];
      EXPECT_EQ(s.chains[0].above[n], i + n + 1 < way.size() ? way[i + n + 1] : nobody) << i << ' ' << n;
      EXPECT_EQ(s.below[n], i > n ? way[i - n - 1] : nobody) << i << ' ' << n;
    }
}

TEST(Chains, WhoDoesNotAnswerIsNotAskedAgainForAWhile) {
  Swarm_ net = mission(Params{}, {{0.45F, 0.05F}, {0.25F, 0.0F}}, {0.5F, 0.0F}, 1.0F, 1);
  net.hidden = [](std::size_t i, std::size_t j) { return i == 2 && j == 1; };  // 2 does not hear the worker
  for (int t = 0; t < 10; ++t) net.tick();
  EXPECT_EQ(net.states[1].chains[0].asked, 2) << "the nearest";
  int t = 10;
  for (; t < 100 && net.states[1].chains[0].parent != 3; ++t) net.tick();
  EXPECT_EQ(net.states[1].chains[0].parent, 3);
  EXPECT_GT(t, 20);
  EXPECT_LT(t, 40);
}

TEST(Chains, WhoIsOfNoMoreUseIsFreeAgain) {
  Swarm_ net = mission(Params{}, row(6, 0.15F, 0.125F), {0.95F, 0.0F}, 3.0F, 1);
  for (int t = 0; t < 200; ++t) net.tick();
  ASSERT_GE(relays_of(net).size(), 4U);
  net.orders[1] = {};
  for (int t = 0; t < 400; ++t) net.tick();
  for (const State& s : net.states) EXPECT_TRUE(s.is_free()) << s.id;
}

TEST(Chains, NothingSensedMakesAVelocityInfinite) {
  Swarm_ net = mission(Params{}, row(3, 0.15F, 0.1F), {0.5F, 0.0F}, 2.0F, 1);
  for (int t = 0; t < 60; ++t) net.tick();
  Message wild = net.said[3];
  wild.above.fill(0);
  wild.below.fill(3);
  wild.links = 255;
  wild.chain = 255;
  wild.beyond = wild.path = 65535;
  for (const RobotId worker : {RobotId{1}, RobotId{3}}) {
    wild.worker = worker;
    expect_finite_motion<Robots>(net, wild, 60, [](const State&, Message& m, int t) {
      m.asks = t % 2 == 0 ? 0 : nobody;
      m.root = t % 3 == 0 ? nobody : 7;
    });
  }
}

}  // namespace
}  // namespace banyan::baselines::chains
