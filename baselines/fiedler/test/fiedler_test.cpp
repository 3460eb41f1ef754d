// SPDX-License-Identifier: MIT
// Fiedler control: what robots estimate is what Eigen's solver finds in the true graph, and they move up its gradient.
#include "banyan/baselines/fiedler/fiedler.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "../src/exponential.hpp"
#include "net.hpp"
#include "no_links.hpp"
#include "wild_senses.hpp"

namespace banyan::baselines::fiedler {
namespace {

using Swarm_ = Net<Robots>;

struct Truth {
  double lambda_2, lambda_3;
  Eigen::VectorXd vector;  // of length 1
};

// Of the weighted Laplacian, in doubles and with the C library's exponential.
Truth truth(const Swarm_& net) {
  const auto n = static_cast<Eigen::Index>(net.at.size());
  Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto d =
          static_cast<double>(distance(net.at[static_cast<std::size_t>(i)], net.at[static_cast<std::size_t>(j)]));
      const bool linked = net.hears(static_cast<std::size_t>(i), static_cast<std::size_t>(j)) &&
                          d < static_cast<double>(net.params.longest_link);
      if (!linked) continue;
      const double a = std::exp(-d * d / (2.0 * std::pow(static_cast<double>(net.params.weight_width), 2)));
      laplacian(i, j) = -a;
      laplacian(i, i) += a;
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(laplacian);
  return {solver.eigenvalues()[1], n > 2 ? solver.eigenvalues()[2] : std::numeric_limits<double>::infinity(),
          solver.eigenvectors().col(1)};
}

// The largest relative error of any robot's estimate.
double error(const Swarm_& net, double lambda_2) {
  double worst = 0.0;
  for (const State& s : net.states) worst = std::max(worst, std::fabs(static_cast<double>(s.lambda) / lambda_2 - 1.0));
  return worst;
}

Eigen::VectorXd estimated(const Swarm_& net) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(net.states.size()));
  for (std::size_t i = 0; i < net.states.size(); ++i)
    v[static_cast<Eigen::Index>(i)] = static_cast<double>(net.states[i].component);
  v.array() -= v.mean();
  return v.normalized();
}

TEST(Fiedler, ExponentialIsThatOfTheLibrary) {
  for (int k = 0; k < 80000; ++k) {
    const float x = static_cast<float>(k) * 0.001F;
    EXPECT_NEAR(static_cast<double>(exp_minus(x)) / std::exp(-static_cast<double>(x)), 1.0, 2e-6) << x;
  }
  EXPECT_EQ(exp_minus(0.0F), 1.0F);
  EXPECT_EQ(exp_minus(1e9F), 0.0F);
  EXPECT_EQ(exp_minus(std::numeric_limits<float>::infinity()), 0.0F);
}

struct Case {
  std::size_t robots;
  double side;
  int ticks;  // by then all robots are within 10 %, and stay there
};
class Static : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(All, Static,
                         testing::Values(Case{2, 1.0, 30}, Case{3, 1.0, 200}, Case{5, 1.0, 200}, Case{10, 1.5, 300},
                                         Case{20, 1.5, 300}, Case{30, 3.0, 1000}, Case{40, 2.0, 600},
                                         Case{60, 3.0, 1500}));

TEST_P(Static, TheEstimateComesToTheTruth) {
  const auto [robots, side, ticks] = GetParam();
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Draw draw(seed);
    Swarm_ net(Params{}, connected_places(robots, side, 0.6, draw), seed);
    const Truth t = truth(net);
    for (int tick = 0; tick < ticks; ++tick) net.tick();
    for (int tick = 0; tick < ticks; ++tick) {
      net.tick();
      ASSERT_LT(error(net, t.lambda_2), 0.1) << "seed " << seed << ", tick " << ticks + tick;
    }
    EXPECT_LT(error(net, t.lambda_2), 0.05) << seed;
    if (t.lambda_3 < 1.3 * t.lambda_2)
      continue;  // of nearly equal eigenvalues any mixture of vectors takes long to fade
    const Eigen::VectorXd v = estimated(net);
    const double sign = v.dot(t.vector) < 0.0 ? -1.0 : 1.0;
    EXPECT_GT(sign * v.dot(t.vector), 0.99) << seed;
    for (Eigen::Index i = 0; i < v.size(); ++i)
      if (std::fabs(t.vector[i]) > 0.3 * t.vector.cwiseAbs().maxCoeff()) {
        EXPECT_GT(sign * v[i] * t.vector[i], 0.0) << "seed " << seed << ", robot " << i;
      }
  }
}

TEST(Fiedler, MovesUpTheGradientOfLambda2) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Draw draw(seed);
    Swarm_ net(Params{}, connected_places(12, 1.5, 0.6, draw), seed);
    const Truth t = truth(net);
    if (t.lambda_3 < 1.3 * t.lambda_2) continue;
    for (int tick = 0; tick < 1500; ++tick) net.tick();
    double worst = 0.0, largest = 0.0;
    for (std::size_t i = 0; i < net.at.size(); ++i) {
      constexpr float h = 5e-3F;
      const auto slope = [&](Vec2 way) {
        Swarm_ moved = net;
        moved.at[i] = net.at[i] + way;
        const double ahead = truth(moved).lambda_2;
        moved.at[i] = net.at[i] - way;
        return (ahead - truth(moved).lambda_2) / (2.0 * static_cast<double>(h));
      };
      const auto n = static_cast<double>(net.at.size());
      const double x = n * slope({h, 0.0F}), y = n * slope({0.0F, h});
      const Vec2 g = rotate(net.facing[i], connectivity_gradient(net.params, net.states[i]));
      // Only as long as no link comes or goes with the robot.
      bool at_the_limit = false;
      for (std::size_t j = 0; j < net.at.size(); ++j)
        at_the_limit = at_the_limit || std::fabs(distance(net.at[i], net.at[j]) - net.params.longest_link) < 2.0F * h;
      largest = std::max(largest, std::hypot(x, y));
      if (!at_the_limit)
        worst = std::max(worst, std::hypot(x - static_cast<double>(g.x), y - static_cast<double>(g.y)));
    }
    EXPECT_GT(largest, 0.01);
    EXPECT_LT(worst, 0.02 * largest) << seed;
  }
}

// Averages forget: who is gone leaves nothing behind, who comes is counted.
TEST(Fiedler, TheEstimateFollowsRobotsThatDieAndCome) {
  Draw draw(3);
  Swarm_ net(Params{}, connected_places(16, 1.5, 0.6, draw), 3);
  const auto is_gone = [](std::size_t i) { return i >= 8; };
  const auto without = [&](std::size_t i, std::size_t j) { return is_gone(i) != is_gone(j); };
  const Truth all = truth(net);
  Swarm_ fewer(Params{}, {net.at.begin(), net.at.begin() + 8}, 3);
  ASSERT_EQ(fewer.radio_parts(), 1U);
  const Truth rest = truth(fewer);
  ASSERT_GT(std::fabs(all.lambda_2 / rest.lambda_2 - 1.0), 0.2) << "the test says nothing";
  const auto error_of_first = [&](double lambda_2) {
    double worst = 0.0;
    for (std::size_t i = 0; i < 8; ++i)
      worst = std::max(worst, std::fabs(static_cast<double>(net.states[i].lambda) / lambda_2 - 1.0));
    return worst;
  };
  for (int t = 0; t < 600; ++t) net.tick();
  EXPECT_LT(error_of_first(all.lambda_2), 0.05);
  net.hidden = without;
  for (int t = 0; t < 600; ++t) net.tick();
  EXPECT_LT(error_of_first(rest.lambda_2), 0.05) << "each part has a lambda_2 of its own, and no part knows of another";
  net.hidden = [](std::size_t, std::size_t) { return false; };
  for (int t = 0; t < 600; ++t) net.tick();
  EXPECT_LT(error_of_first(all.lambda_2), 0.05);
}

TEST(Fiedler, LostPacketsCostLittle) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Draw draw(seed);
    Swarm_ net(Params{}, connected_places(20, 1.5, 0.6, draw), seed);
    net.params.liveness_rounds = 30.0F;
    net.loss = 0.3;
    const Truth t = truth(net);
    for (int tick = 0; tick < 600; ++tick) net.tick();
    double worst = 0.0;
    for (int tick = 0; tick < 600; ++tick) {
      net.tick();
      worst = std::max(worst, error(net, t.lambda_2));
    }
    EXPECT_LT(worst, 0.25) << seed;
  }
}

TEST(Fiedler, OneRobotIsRootAndAnotherFollowsItsSilence) {
  Swarm_ net(Params{}, {{0, 0}, {0.5F, 0}, {1, 0}, {1.5F, 0}}, 1);
  const auto roots = [&](std::size_t from) {
    std::vector<std::size_t> found;
    for (std::size_t i = from; i < net.at.size(); ++i)
      if (report(net.states[i]).role == Role::root) found.push_back(i);
    return found;
  };
  for (int t = 0; t < 10; ++t) net.tick();
  EXPECT_EQ(roots(0), std::vector<std::size_t>{0});
  EXPECT_EQ(net.states[3].root, 0);
  net.orders[1].sent = true;
  net.hidden = [](std::size_t i, std::size_t j) { return i == 0 || j == 0; };
  for (int t = 0; t < 200; ++t) net.tick();
  EXPECT_EQ(roots(1), std::vector<std::size_t>{2}) << "a worker is no root";
  net.hidden = [](std::size_t, std::size_t) { return false; };
  for (int t = 0; t < 10; ++t) net.tick();
  EXPECT_EQ(roots(0), std::vector<std::size_t>{0});
}

TEST(Fiedler, PromisesNoLink) { expect_no_links<Robots>(Swarm_(Params{}, {{0, 0}, {0.5F, 0}, {1, 0}}, 1)); }

TEST(Fiedler, NothingSensedMakesAVelocityInfinite) {
  Swarm_ net(Params{}, {{0, 0}, {0.5F, 0}, {0.5F, 0.5F}}, 1);
  for (int t = 0; t < 60; ++t) net.tick();
  Message wild = net.said[1];
  wild.component = -largest_real;
  wild.mean = wild.square = wild.product = {largest_real, -largest_real};
  wild.largest_degree = 0;
  expect_finite_motion<Robots>(net, wild, 50, [](const State& s, Message&, int) {
    EXPECT_LE(std::fabs(s.component), largest_real);
    EXPECT_LE(std::fabs(s.product.value), largest_real);
  });
}

}  // namespace
}  // namespace banyan::baselines::fiedler
