// SPDX-License-Identifier: MIT
// Cohesive control: what a robot finds out is compared with what is so, in places where somebody who sees all of them
// can tell.
#include "banyan/baselines/cohesion/cohesion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "../src/rooms.hpp"
#include "net.hpp"
#include "no_links.hpp"
#include "wild_senses.hpp"

namespace banyan::baselines::cohesion {
namespace {

using Swarm_ = Net<Robots>;
constexpr double half_turn = 3.14159265358979323846;

// Rings of a hexagon of robots, from its middle. They are so far apart that nobody hears the next but one in its row.
constexpr float apart = 0.525F;
struct Cell {
  int ring;
  bool is_corner;
};
Cell cell_of(Vec2 place) {
  const Vec2 p = place / apart;
  const int row = static_cast<int>(std::lround(p.y / 0.8660254F)),
            column = static_cast<int>(std::lround(p.x - 0.5F * static_cast<float>(row)));
  const int third = row + column;
  return {std::max({std::abs(row), std::abs(column), std::abs(third)}), row == 0 || column == 0 || third == 0};
}
std::vector<Vec2> hexagon(int first_ring, int last_ring, double jitter, Draw& draw) {
  std::vector<Vec2> places;
  for (int row = -last_ring; row <= last_ring; ++row)
    for (int column = -last_ring; column <= last_ring; ++column) {
      const Vec2 p{static_cast<float>(column) + 0.5F * static_cast<float>(row), 0.8660254F * static_cast<float>(row)};
      const int ring = cell_of(p * apart).ring;
      if (ring < first_ring || ring > last_ring) continue;
      const auto x = static_cast<float>(draw(-jitter, jitter));
      places.push_back(p * apart + Vec2{x, static_cast<float>(draw(-jitter, jitter))});
    }
  return places;
}

int open_sectors(const Message& m) {
  return static_cast<int>(
      std::count_if(m.sectors.begin(), m.sectors.end(), [](const SaidSector& s) { return s.is_open(); }));
}
double mean_of(const SaidSector& s) {
  const double r = s.right_mean.sectors, l = s.left_mean.sectors;
  return (r * static_cast<double>(s.right_mean.rad()) + l * static_cast<double>(s.left_mean.rad())) / (r + l);
}

TEST(Cohesion, KnowsHowNeighboursAreTurned) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Draw draw(seed);
    Swarm_ net(Params{}, connected_places(30, 2.0, 0.6, draw), seed);
    for (int t = 0; t < 4; ++t) net.tick();
    std::size_t known = 0, all = 0;
    for (std::size_t i = 0; i < net.at.size(); ++i) {
      const Surroundings around(net.params, net.states[i]);
      for (int k = 0; k < around.size; ++k) {
        ++all;
        if (around.frame(k) == Vec2{}) continue;
        ++known;
        const Vec2 truth = rotate_back(net.facing[i], net.facing[net.states[i].neighbors.id(k)]);
        EXPECT_LT(distance(around.frame(k), truth), 0.005F) << seed << ": " << i;
      }
    }
    EXPECT_GT(known * 100, all * 95) << seed;
  }
}

struct Rings {
  int first, last;
};
class Hexagon : public testing::TestWithParam<Rings> {};
INSTANTIATE_TEST_SUITE_P(All, Hexagon,
                         testing::Values(Rings{0, 2}, Rings{0, 4}, Rings{1, 4}, Rings{2, 5}, Rings{3, 6}, Rings{4, 7}));

// The outer angles of a closed line of n robots are half a turn and 2 pi / n on average, those of a hole as much less.
TEST_P(Hexagon, ItsBoundariesAreKnownAndWhichIsTheOuter) {
  const auto [first, last] = GetParam();
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    Draw draw(seed);
    Swarm_ net(Params{}, hexagon(first, last, 0.02, draw), seed);
    for (int t = 0; t < 150; ++t) net.tick();
    for (std::size_t i = 0; i < net.at.size(); ++i) {
      const auto [ring, is_corner] = cell_of(net.at[i]);
      // Where one robot is missing those around it hear one another, and across the corners of a hole so do others.
      const bool outside = ring == last, inside = first > 1 && ring == first && !is_corner;
      EXPECT_EQ(open_sectors(net.said[i]) > 0, outside || inside)
          << "seed " << seed << ", robot " << i << ", ring " << ring;
      if (open_sectors(net.said[i]) == 0) continue;
      const double truth =
          outside ? half_turn * (1.0 + 2.0 / (6.0 * ring)) : half_turn * (1.0 - 2.0 / (6.0 * (ring - 1)));
      EXPECT_NEAR(mean_of(net.said[i].sectors[0]), truth, 0.05)
          << "seed " << seed << ", robot " << i << ", ring " << ring;
      EXPECT_EQ(net.said[i].depth == 0, std::fabs(truth - half_turn) < half_turn / 8.0) << "only a large one counts";
    }
  }
}

// A ring of robots in single file: each is on the outer boundary and on the hole's, and takes neither for the other.
TEST(Cohesion, EachSideOfARingHasAMeanOfItsOwn) {
  constexpr int n = 20;
  std::vector<Vec2> places;
  places.reserve(n);
  for (int k = 0; k < n; ++k) places.push_back(unit_vector(2.0F * pi<float> * static_cast<float>(k) / n) * 1.68F);
  Swarm_ net(Params{}, places, 1);
  for (int t = 0; t < 150; ++t) net.tick();
  for (const Message& m : net.said) {
    ASSERT_EQ(open_sectors(m), 2);
    EXPECT_NEAR(mean_of(m.sectors[0]), half_turn * (1.0 + 2.0 / n), 0.01);
    EXPECT_NEAR(mean_of(m.sectors[1]), half_turn * (1.0 - 2.0 / n), 0.01);
    EXPECT_EQ(m.depth, 0);
  }
}

// Whoever believes that it is surrounded is: in every direction there is a triangle that it makes with two robots in
// reach of it and of one another.
TEST(Cohesion, WhoSeesNoGapIsSurrounded) {
  std::size_t surrounded = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Draw draw(seed);
    Swarm_ net(Params{}, connected_places(50, 3.5, 0.7, draw), seed);
    for (int t = 0; t < 6; ++t) net.tick();
    const auto links = [&](std::size_t i, std::size_t j) { return distance(net.at[i], net.at[j]) < 1.0F; };
    const auto covers = [&](std::size_t i, double direction) {
      for (std::size_t a = 0; a < net.at.size(); ++a)
        for (std::size_t b = 0; b < net.at.size(); ++b) {
          if (a == i || b == i || a == b || !links(i, a) || !links(i, b) || !links(a, b)) continue;
          const auto bearing = [&](std::size_t j) {
            return std::remainder(std::atan2(net.at[j].y - net.at[i].y, net.at[j].x - net.at[i].x) - direction,
                                  2.0 * half_turn);
          };
          const double right = bearing(a), left = bearing(b);
          if (right <= 0.0 && left >= 0.0 && left - right <= half_turn + 1e-5) return true;
        }
      return false;
    };
    for (std::size_t i = 0; i < net.at.size(); ++i) {
      if (net.said[i].candidate) continue;
      ++surrounded;
      for (int d = 0; d < 90; ++d)
        EXPECT_TRUE(covers(i, 2.0 * half_turn * d / 90.0)) << "seed " << seed << ", robot " << i;
    }
  }
  EXPECT_GT(surrounded, 50U) << "the test says nothing";
}

// The figure in the authors' source (class ThicknessDetermination): 12 rows of 9 robots. Here they stand on arcs
// around a far point, so that no diagonal is a hop.
TEST(Cohesion, ThicknessIsThatOfTheAuthorsFigure) {
  constexpr int rows = 12, columns = 9;
  constexpr const char* depth[rows] = {"000000000", "011111110", "012222210", "012333210", "012343210", "012343210",
                                       "012343210", "012343210", "012333210", "012222210", "011111110", "000000000"};
  constexpr const char* thickness[rows] = {"111141111", "111444111", "114444411", "144444441",
                                           "444444444", "444444444", "444444444", "444444444",
                                           "144444441", "114444411", "111444111", "111141111"};
  std::vector<Vec2> places;
  constexpr int middle = columns / 2;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      places.push_back(unit_vector(0.0101F * static_cast<float>(c - middle)) * (50.0F + 0.51F * static_cast<float>(r)));
  Swarm_ net(Params{}, places, 1);
  for (int t = 0; t < 400; ++t) net.tick();
  const auto figure = [&](int r, int c) {
    return r < 0 || r >= rows || c < 0 || c >= columns ? 0 : thickness[r][c] - '0';
  };
  int same = 0;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const Message& m =
          net.said[static_cast<std::size_t>(columns) * static_cast<std::size_t>(r) + static_cast<std::size_t>(c)];
      EXPECT_EQ(m.depth, depth[r][c] - '0') << r << ", " << c;
      same += m.thickness == figure(r, c) ? 1 : 0;
      if (m.thickness == figure(r, c)) continue;
      // Their program, as we do, lets the number go one hop farther than they have drawn it.
      EXPECT_EQ(m.thickness, 4) << r << ", " << c;
      EXPECT_EQ(std::max({figure(r - 1, c), figure(r + 1, c), figure(r, c - 1), figure(r, c + 1)}), 4)
          << r << ", " << c;
    }
  EXPECT_EQ(same, 92) << "of 108, says the page";
}

// Olfati-Saber (2006), written down once more in doubles and with the library's functions.
TEST(Cohesion, TwoNeighboursRestHalfALinkApart) {
  const double c = 3.0 / std::sqrt(160.0);
  const auto sigma_norm = [](double d) { return std::sqrt(1.0 + d * d) - 1.0; };
  const auto force = [&](double d) {
    const double z = sigma_norm(d) / sigma_norm(1.2), h = 0.05 / 1.2;
    const double bump = z < h ? 1.0 : z < 1.0 ? 0.5 * (1.0 + std::cos(half_turn * (z - h) / (1.0 - h))) : 0.0;
    const double s = sigma_norm(d) - sigma_norm(0.6) + c;
    return bump * 0.5 * (13.0 * s / std::sqrt(1.0 + s * s) - 3.0) * d / std::sqrt(1.0 + d * d);
  };
  for (int k = 1; k <= 40; ++k) {
    const float d = 0.025F * static_cast<float>(k);
    Swarm_ net(Params{}, {{0, 0}, {d, 0}}, 1);
    net.tick();
    const double truth = force(static_cast<double>(d / net.params.longest_link) * 1.2);
    const Robot robot{net.params, net.states[0]};
    if (d >= 1.0F) continue;
    EXPECT_NEAR(static_cast<double>(norm(lattice_force(robot, {}))), std::fabs(truth), 1e-4) << d;
    EXPECT_EQ(dot(lattice_force(robot, {}), robot.around.place(0)) > 0.0F, truth > 0.0) << d;
  }
  EXPECT_NEAR(force(0.6), 0.0, 1e-9);
}

// Hops to a leader are those of a search over all robots, and everybody learns how it moves.
TEST(Cohesion, LeadersAreKnownByTheirHopsAndTheirMotion) {
  std::size_t as_near = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Draw draw(seed);
    Swarm_ net(Params{}, connected_places(25, 3.0, 0.6, draw), seed);
    for (const std::size_t leader : {std::size_t{3}, std::size_t{11}}) {
      net.orders[leader] = {true, Vec2{4.5F, 0.0F}};
      std::vector<int> hops(net.at.size(), -1);
      hops[leader] = 0;
      for (int h = 0; h < 25; ++h)
        for (std::size_t i = 0; i < net.at.size(); ++i)
          for (std::size_t j = 0; j < net.at.size(); ++j)
            if (hops[i] == h && net.hears(j, i) && hops[j] < 0) hops[j] = h + 1;
      const Vec2 way{0.006F, -0.0025F};  // a tick, of all robots: nobody's neighbours change
      for (int t = 0; t < 60; ++t) net.tick(std::vector<Vec2>(net.at.size(), way));
      for (std::size_t i = 0; i < net.at.size(); ++i) {
        const auto& said = net.said[i].leaders;
        const auto it = std::find_if(said.begin(), said.end(), [&](const SaidLeader& l) { return l.id == leader; });
        ASSERT_NE(it, said.end()) << i;
        EXPECT_GE(it->hops, hops[i]) << i;
        EXPECT_LE(it->hops, hops[i] + 1) << i << ": one more where it cannot tell how a neighbour is turned";
        as_near += it->hops == hops[i] ? 1U : 0U;
        const Vec2 velocity = rotate(net.facing[i], it->velocity.in_frame());
        EXPECT_LT(distance(velocity, way / (net.params.way_in_a_round() * net.params.speed_gain)),
                  0.02F * static_cast<float>(1 + hops[i]))
            << i;
      }
    }
  }
  EXPECT_GT(as_near, 190U) << "of 200";
}

TEST(Cohesion, ALeaderWithFewNeighboursCallsAndTheCallFades) {
  Swarm_ net(Params{}, {{0, 0}, {0.75F, 0}, {1.5F, 0}, {2.25F, 0}}, 1);
  net.orders[0] = {true, Vec2{-2.5F, 0.0F}};
  for (int t = 0; t < 20; ++t) net.tick();
  double expected = 2.0;  // one neighbour where three are enough
  for (const Message& m : net.said) {
    EXPECT_NEAR(m.help / static_cast<double>(per_help), expected, 0.05);
    expected *= 0.8;
  }
  net.orders[0] = {};
  for (int t = 0; t < 60; ++t) net.tick();
  for (const Message& m : net.said) EXPECT_EQ(m.help, 0) << "an echo goes on for ever";
}

TEST(Cohesion, OneRobotIsRootAndAnotherFollowsItsSilence) {
  Swarm_ net(Params{}, {{0, 0}, {0.5F, 0}, {1, 0}, {1.5F, 0}}, 1);
  for (int t = 0; t < 10; ++t) net.tick();
  EXPECT_EQ(net.states[3].root, 0);
  net.hidden = [](std::size_t i, std::size_t j) { return i == 0 || j == 0; };
  for (int t = 0; t < 200; ++t) net.tick();
  EXPECT_EQ(report(net.states[1]).role, Role::root);
  EXPECT_EQ(net.states[3].root, 1);
}

TEST(Cohesion, PromisesNoLink) { expect_no_links<Robots>(Swarm_(Params{}, {{0, 0}, {0.5F, 0}, {1, 0}}, 1)); }

TEST(Cohesion, NothingSensedMakesAVelocityInfinite) {
  Swarm_ net(Params{}, {{0, 0}, {0.5F, 0}, {0.5F, 0.5F}}, 1);
  for (int t = 0; t < 60; ++t) net.tick();
  Message wild = net.said[1];
  for (SaidSector& s : wild.sectors) s = {{0, 65535}, {2, 0}, {65535, 255}, {0, 1}};
  for (SaidLeader& leader : wild.leaders) leader = {7, 255, {-128, 127}};
  wild.density = wild.help = wild.thickness = 255;
  expect_finite_motion<Robots>(net, wild, 50, [](const State& s, Message& m, int t) {
    EXPECT_TRUE(std::isfinite(s.lasting_thickness));
    m.depth = m.thickness = m.hops = static_cast<std::uint8_t>(5 * t);
    for (SaidLeader& leader : m.leaders) leader.hops = static_cast<std::uint8_t>(t);
  });
}

}  // namespace
}  // namespace banyan::baselines::cohesion
