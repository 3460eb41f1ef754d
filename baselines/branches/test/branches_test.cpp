// SPDX-License-Identifier: MIT
// Branch repositioning: which change a robot chooses, by brute force; that changes leave a tree, whatever is lost on
// the way; and the motion as equations.
#include "banyan/baselines/branches/branches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "net.hpp"
#include "wild_senses.hpp"

namespace banyan::baselines::branches {
namespace {

using Swarm_ = Net<Robots>;
using Edge = std::pair<std::size_t, std::size_t>;

// A robot that turns on the spot would not show the direction in which it wants to go.
Params holonomic() {
  Params p;
  p.drive = Drive::holonomic;
  return p;
}

std::vector<RobotId> links_of(const Message& m) {
  std::vector<RobotId> links;
  for (const RobotId id : m.links)
    if (id != nobody) links.push_back(id);
  return links;
}

// Robot `id` and those around it that are linked with it; it is the root unless `parent` is one of them.
struct Hub {
  Params params = holonomic();
  RobotId id = 0;
  std::vector<Message> others{};
  std::vector<Vec2> at{};
  State state{};

  void add(RobotId other, bool leader, Vec2 place) {
    Message m;
    m.id = other;
    m.leader = leader;
    m.connector = !leader;
    m.links[0] = id;
    if (m.connector) m.links[1] = static_cast<RobotId>(100 + other);
    m.joined_age = unknown_age;
    m.root = 0;
    others.push_back(m);
    at.push_back(place);
  }
  Output<Message> step() {
    std::vector<Heard> heard;
    heard.reserve(others.size());
    for (std::size_t i = 0; i < others.size(); ++i) heard.push_back({&others[i], at[i]});
    return Robots::step(params, state, {heard, {}, test_platform});
  }
  // What it says once it has let them all in.
  Output<Message> settled() {
    state = Robots::initial(id, false, id == 0);
    Output<Message> output = step();
    for (Message& m : others) {
      m.joined_age = 1;
      m.parent = id;
    }
    return id == 0 ? step() : output;
  }
};

// Every pair of links: the end that leaves is a leader or has the larger id, and saves the most.
std::pair<RobotId, RobotId> best_change(const Hub& hub) {
  std::pair<RobotId, RobotId> best{nobody, nobody};
  if (hub.others.size() <= 2) return best;
  double most = 0.0;
  for (std::size_t a = 0; a < hub.others.size(); ++a)
    for (std::size_t b = 0; b < hub.others.size(); ++b) {
      if (a == b || hub.others[b].links[1] == nobody) continue;  // not to a leader, nor to a leaf
      if (hub.others[a].connector && hub.others[a].id < hub.others[b].id) continue;
      const auto to_hub = std::hypot(static_cast<double>(hub.at[a].x), static_cast<double>(hub.at[a].y));
      const double saved = to_hub - static_cast<double>(distance(hub.at[a], hub.at[b]));
      if (saved <= most) continue;
      most = saved;
      best = {hub.others[a].id, hub.others[b].id};
    }
  return best;
}

TEST(Branches, TheChangeThatSavesMostIsOfferedAndNoneIfNoneSaves) {
  Draw draw(1);
  std::size_t offers = 0, none = 0;
  for (int n = 0; n < 3000; ++n) {
    Hub hub;
    const auto count = static_cast<RobotId>(draw(2.0, 8.0));
    for (RobotId i = 1; i <= count; ++i) {
      const bool leader = draw() < 0.3;
      // A leader so near that it leaves nobody behind.
      const auto d = static_cast<float>(draw(0.2, leader ? 0.6 : 0.9));
      hub.add(i, leader, unit_vector(static_cast<float>(draw(-3.14, 3.14))) * d);
      if (draw() < 0.1) hub.others.back().links[1] = nobody;
    }
    const Message m = hub.settled().message;
    ASSERT_EQ(links_of(m).size(), hub.others.size());
    const auto expected = best_change(hub);
    EXPECT_EQ(std::pair(m.leaves, m.joins), expected);
    EXPECT_EQ(m.stage, expected.first == nobody ? no_change : offered);
    ++(expected.first == nobody ? none : offers);
  }
  EXPECT_GT(offers, 500U);
  EXPECT_GT(none, 500U);
}

TEST(Branches, ALeaderThatIsFarLeavesTheNearestOfItsTeamThatIsFarEnough) {
  Draw draw(2);
  std::size_t offers = 0;
  for (int n = 0; n < 2000; ++n) {
    Hub hub;
    const auto leader_at = static_cast<float>(draw(0.45, 0.9));
    hub.add(1, true, {leader_at, 0.0F});
    hub.add(2, false, {-0.5F, 0.0F});
    RobotId expected = nobody;
    double nearest = 1e9;
    hub.settled();
    for (RobotId i = 3; i < 8; ++i) {
      const Vec2 place = unit_vector(static_cast<float>(draw(-1.0, 1.0))) * static_cast<float>(draw(0.25, 0.95));
      hub.add(i, false, place);
      Message& m = hub.others.back();
      m.connector = false;
      m.links = no_ids();
      m.team = draw() < 0.7 ? 1 : 9;
      m.team_age = 1;
      const auto d = static_cast<double>(norm(place));
      if (m.team != 1 || leader_at <= 0.625F || d < 0.625 || d > 0.9375) continue;
      if (distance(place, hub.at[0]) > leader_at || d >= nearest) continue;
      expected = i;
      nearest = d;
    }
    hub.state.change = {};
    const Message m = hub.step().message;
    EXPECT_EQ(m.stage, expected == nobody ? no_change : offered);
    EXPECT_EQ(m.joins, expected);
    EXPECT_EQ(m.leaves, expected == nobody ? nobody : 1);
    offers += expected == nobody ? 0 : 1;
  }
  EXPECT_GT(offers, 300U);
}

// A connector between the root and a leader, in a row.
TEST(Branches, TheLastConnectorLeavesWhenTheOneBeforeIsNearTheLeader) {
  for (const float d : {0.5F, 0.56F, 0.565F, 0.62F}) {
    Swarm_ net(Params{}, {{0.0F, 0.0F}, {0.3F, 0.0F}, {0.95F, 0.0F}, {1.6F, 0.0F}}, 1);
    net.states[3].assignment.sent = true;
    net.orders[3] = {true, Vec2{}};
    for (int t = 0; t < 100; ++t) net.tick();
    ASSERT_EQ(report(net.states[1]).parent, 0) << "called";
    ASSERT_EQ(report(net.states[2]).parent, 1);
    ASSERT_EQ(report(net.states[3]).parent, 2);
    net.at[3] = net.at[1] + Vec2{d, 0.0F};
    for (int t = 0; t < 60; ++t) net.tick();
    EXPECT_EQ(net.states[2].connector, d > 0.5625F) << d;
    EXPECT_EQ(report(net.states[3]).parent, d > 0.5625F ? 2 : 1) << d;
  }
}

// Of what is reported, for robots that are in the network.
class Reported {
 public:
  explicit Reported(const Swarm_& net) : parts_(net.at.size()) {
    for (std::size_t i = 0; i < net.at.size(); ++i) {
      const Report r = report(net.states[i]);
      if (r.role == Role::spare) continue;
      std::vector<RobotId> ends(r.kept.begin(), r.kept.end());
      ends.push_back(r.parent);
      for (const RobotId end : ends) {
        if (end == nobody || end >= net.at.size()) continue;
        parts_.join(i, end);
        if (net.states[end].links.has(static_cast<RobotId>(i)))
          edges_.insert({std::min<std::size_t>(i, end), std::max<std::size_t>(i, end)});
      }
    }
  }
  bool joins(std::size_t a, std::size_t b) { return parts_.find(a) == parts_.find(b); }
  // That both ends name.
  [[nodiscard]] const std::set<Edge>& edges() const { return edges_; }

 private:
  Components parts_;
  std::set<Edge> edges_;
};

// Robots that all hear one another and are moved about, with distances by which connectors come and go all the time.
struct Crowd {
  static constexpr std::size_t leaders = 4;
  Swarm_ net;
  std::vector<Vec2> way;

  static Params small() {
    Params p;
    p.separation = 0.15F;
    p.joining = 0.125F;
    p.spacing = 0.2F;
    return p;
  }
  static std::vector<Vec2> places(std::uint64_t seed) {
    Draw draw(seed);
    std::vector<Vec2> at;
    for (std::size_t i = 0; i < 18; ++i)
      at.push_back({static_cast<float>(draw(-0.3, 0.3)), static_cast<float>(draw(-0.3, 0.3))});
    return at;
  }
  explicit Crowd(std::uint64_t seed) : net(small(), places(seed), seed), way(net.at.size()) {
    for (std::size_t i = 0; i < leaders; ++i) {
      net.orders[i + 1] = {true, Vec2{0.5F, 0.0F}};
      net.states[i + 1].assignment.sent = true;
    }
  }
  void tick(bool move) {
    for (std::size_t i = 0; i < way.size(); ++i) {
      if (net.ticks % 20 == 0)
        way[i] = Vec2{static_cast<float>(net.draw(-0.35, 0.35)), static_cast<float>(net.draw(-0.35, 0.35))} - net.at[i];
      if (!move) way[i] = {};
    }
    std::vector<Vec2> ways(way.size());
    for (std::size_t i = 0; i < way.size(); ++i) ways[i] = way[i] * 0.05F;
    net.tick(ways);
  }
  // The root and all leaders.
  static bool is_joined(Reported& reported) {
    for (std::size_t i = 1; i <= leaders; ++i)
      if (!reported.joins(0, i)) return false;
    return true;
  }
  [[nodiscard]] std::size_t nodes() const {
    return static_cast<std::size_t>(
        std::count_if(net.states.begin(), net.states.end(), [](const State& s) { return !s.is_follower(); }));
  }
};

TEST(Branches, WhatIsReportedStaysInOnePieceWhileBranchesMove) {
  std::size_t changes = 0;
  for (std::uint64_t seed = 0; seed < (long_search() ? 400U : 40U); ++seed) {
    Crowd crowd(seed);
    crowd.net.loss = 0.15 * static_cast<double>(seed % 3);
    crowd.net.latency = 1 + seed / 3 % 3;
    if (crowd.net.latency == 3) crowd.net.params.change_rounds *= 2.0F;
    int t = 0;
    for (Reported r(crowd.net); t < 200 && !Crowd::is_joined(r); ++t) {
      crowd.tick(false);
      r = Reported(crowd.net);
    }
    ASSERT_LT(t, 200) << seed;
    for (int k = 0; k < 40; ++k) crowd.tick(false);
    std::vector<Stage> before(crowd.net.at.size(), no_change);
    for (t = 0; t < 600; ++t) {
      crowd.tick(true);
      Reported r(crowd.net);
      ASSERT_TRUE(Crowd::is_joined(r)) << seed << ", tick " << t;
      for (std::size_t i = 0; i < before.size(); ++i) {
        const Stage now = crowd.net.states[i].change.stage;
        changes += now == made && before[i] != made ? 1 : 0;
        before[i] = now;
      }
    }
    // At rest: a tree, and no change would shorten it.
    for (t = 0; t < 400; ++t) crowd.tick(false);
    Reported r(crowd.net);
    EXPECT_EQ(r.edges().size(), crowd.nodes() - 1) << seed;
  }
  EXPECT_GT(changes, 1000U);
}

TEST(Branches, AtRestNoChangeIsLeftThatWouldShorten) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Crowd crowd(seed);
    for (int t = 0; t < 200; ++t) crowd.tick(t < 100);
    for (int t = 0; t < 500; ++t) crowd.tick(false);
    const auto d = [&](std::size_t a, std::size_t b) { return distance(crowd.net.at[a], crowd.net.at[b]); };
    for (const State& hub : crowd.net.states) {
      if (hub.is_follower() || hub.links.size() <= 2) continue;
      for (std::size_t i = 0; i < hub.links.size(); ++i)
        for (std::size_t j = 0; j < hub.links.size(); ++j) {
          const std::size_t a = hub.links[i].to, b = hub.links[j].to;
          const State& joined = crowd.net.states[b];
          if (a == b || !joined.connector || joined.links.full() || (joined.links.size() < 2 && !joined.is_root()))
            continue;
          if (a < b && !crowd.net.states[a].is_leader()) continue;
          EXPECT_GE(d(a, b), d(a, hub.id) - 5e-5F) << seed << ": " << a << " from " << hub.id << " to " << b;
        }
    }
  }
}

TEST(Branches, AChangeThatOneEndDoesNotHearIsUndone) {
  Crowd crowd(3);
  crowd.net.hidden = [&](std::size_t i, std::size_t j) { return i + j == 21 && i > 4 && j > 4; };
  for (int t = 0; t < 800; ++t) {
    crowd.tick(true);
    if (t < 100) continue;
    Reported r(crowd.net);
    ASSERT_TRUE(Crowd::is_joined(r)) << t;
    for (const State& s : crowd.net.states) {
      EXPECT_LE(s.change.ticks, 8U + 4U + 20U) << s.id << ", tick " << t << ": stage " << int{s.change.stage};
      for (std::size_t i = 0; i < s.links.size(); ++i)
        EXPECT_FALSE(s.id > 4 && s.links[i].to > 4 && s.id + s.links[i].to == 21 && s.links[i].unanswered_ticks > 9);
    }
  }
}

// The middle may die at any moment of a change.
TEST(Branches, WhoeverDiesTheOthersAreJoinedAgain) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Crowd crowd(seed);
    for (std::uint64_t t = 0; t < 150 + seed; ++t) crowd.tick(true);
    std::vector<std::size_t> busy;
    for (const State& s : crowd.net.states)
      if (s.connector && !s.is_root() && (busy.empty() || s.change.stage != no_change)) busy.push_back(s.id);
    if (busy.empty()) continue;
    const std::size_t dead = busy.back();
    crowd.net.hidden = [dead](std::size_t i, std::size_t j) { return i == dead || j == dead; };
    for (int t = 0; t < 80; ++t) crowd.tick(false);
    Reported r(crowd.net);
    EXPECT_TRUE(Crowd::is_joined(r)) << seed;
    for (std::size_t i = 0; i < crowd.net.states.size(); ++i)
      if (i != dead) { EXPECT_FALSE(crowd.net.states[i].links.has(static_cast<RobotId>(dead))) << seed << ' ' << i; }
  }
}

struct Pull {
  double x = 0.0, y = 0.0;
  void add(Vec2 v, double weight) { x += weight * static_cast<double>(v.x), y += weight * static_cast<double>(v.y); }
  [[nodiscard]] double length() const { return std::hypot(x, y); }
};
Pull limited(Pull p) {
  const double s = p.length() > 1.0 ? 1.0 / p.length() : 1.0;
  return {p.x * s, p.y * s};
}
Pull sum_of(Pull a, Pull b, double weight) { return {a.x + weight * b.x, a.y + weight * b.y}; }

// (5) with lengths in C
double repulsion(double q) { return 1.5625 / q * std::pow(0.1875 / q, 4.0); }

void expect_motion(const Motion& v, Pull u, double rest, const Params& p) {
  if (std::abs(u.length() - rest) < 1e-3) return;
  if (u.length() < rest) u = {};
  u = limited(u);
  const auto k = static_cast<double>(p.speed_gain);
  EXPECT_NEAR(static_cast<double>(v.forward), k * u.x, 5e-4);
  EXPECT_NEAR(static_cast<double>(v.sideways), k * u.y, 5e-4);
}

TEST(Branches, AFollowerMovesByItsEquation) {
  Draw draw(7);
  for (int n = 0; n < 1000; ++n) {
    Hub hub;
    hub.id = 5;
    const auto place = [&] {
      return unit_vector(static_cast<float>(draw(-3.14, 3.14))) * static_cast<float>(draw(0.13, 0.95));
    };
    hub.add(1, true, place());
    hub.add(2, false, place());
    hub.add(3, false, place());
    for (Message& m : hub.others) m.links = no_ids();
    hub.others[2].connector = false;
    hub.state = Robots::initial(5, false, false);
    const Motion v = hub.step().motion;
    Pull push, pull;
    for (const Vec2 at : hub.at) push.add(unit(at), -repulsion(static_cast<double>(norm(at))) / 3.0);
    pull.add(hub.at[0], 1.0 / 0.1);
    expect_motion(v, sum_of({1.5 * limited(pull).x, 1.5 * limited(pull).y}, limited(push), 2.0), 0.125, hub.params);
  }
}

TEST(Branches, AConnectorMovesByItsEquation) {
  Draw draw(8);
  for (int n = 0; n < 1000; ++n) {
    Hub hub;
    hub.params.guard_rate = 100.0F;
    const auto count = static_cast<RobotId>(draw(1.0, 5.0));
    for (RobotId i = 1; i <= count; ++i)
      hub.add(i, draw() < 0.4,
              unit_vector(static_cast<float>(draw(-3.14, 3.14))) * static_cast<float>(draw(0.13, 0.875)));
    const Motion v = hub.settled().motion;
    Pull links, team, push;
    double farthest = 0.0, leaders = 0.0, connectors = 0.0;
    for (const Message& m : hub.others) (m.leader ? leaders : connectors) += 1.0;
    for (std::size_t i = 0; i < hub.others.size(); ++i) {
      const double q = static_cast<double>(norm(hub.at[i]));
      links.add(hub.at[i], 1.0 / 0.1 * (q > 0.75 ? 0.25 / (1.0 - q) : 1.0) / static_cast<double>(count));
      if (hub.others[i].leader) {
        team.add(hub.at[i], 1.0 / 0.1 / leaders);
      } else {
        push.add(unit(hub.at[i]), -repulsion(q) / connectors);
        farthest = std::max(farthest, q);
      }
    }
    const double weight = count > 2 ? 0.0 : std::clamp((0.875 - farthest) / 0.125, 0.0, 1.0);
    expect_motion(v, sum_of(sum_of(links, team, weight), limited(push), 1.2), 0.1875, hub.params);
  }
}

// Leader 1 has more followers than its way needs, leader 2 lacks some.
TEST(Branches, ALeaderSendsOneFollowerAtATimeToTheTeamThatLacksMost) {
  std::vector<Vec2> places{{0.0F, 0.0F}, {0.25F, 0.0F}, {-0.25F, 0.0F}};
  for (int i = 0; i < 6; ++i) places.push_back({0.3F + 0.05F * static_cast<float>(i), 0.1F});
  Swarm_ net(Params{}, places, 1);
  net.orders[1] = {true, Vec2{0.05F, 0.0F}};
  net.orders[2] = {true, Vec2{2.0F, 0.0F}};
  for (std::size_t i : {1U, 2U}) net.states[i].assignment.sent = true;
  const auto team_of = [&](RobotId leader) {
    return std::count_if(net.states.begin(), net.states.end(),
                         [&](const State& s) { return s.is_follower() && s.team == leader; });
  };
  for (int t = 0; t < 20; ++t) net.tick();
  EXPECT_EQ(team_of(1), 6);
  std::ptrdiff_t last = 0;
  for (int t = 20; t < 200; ++t) {
    net.tick();
    EXPECT_LE(team_of(2), last + 1) << t;
    EXPECT_LE(team_of(2), 1 + t / 30) << "every 30 rounds";
    last = team_of(2);
  }
  EXPECT_EQ(last, 2) << "2.25 C take three links of 0.75 C";
}

TEST(Branches, NothingSensedMakesAVelocityInfinite) {
  Crowd crowd(1);
  for (int t = 0; t < 60; ++t) crowd.tick(true);
  Message wild = crowd.net.said[1];
  wild.links.fill(0);
  wild.needed = 255;
  expect_finite_motion<Robots>(crowd.net, wild, 60, [](const State&, Message& m, int t) {
    m.stage = static_cast<std::uint8_t>(t % 7);
    m.leaves = static_cast<RobotId>(t % 3);
    m.joins = static_cast<RobotId>(t % 2 == 0 ? 0 : 77);
    m.held_by = static_cast<RobotId>(t % 5 == 0 ? 0 : 3);
    m.calls = 0;
    m.leader = t % 4 == 0;
  });
}

}  // namespace
}  // namespace banyan::baselines::branches
