// SPDX-License-Identifier: MIT
// Places that robots tell of each other, against places that a test made up.
#include "banyan/hosts/udp/chart.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace banyan::udp {
namespace {

using Point = BasicVec2<double>;

struct Truth {
  std::vector<Point> at;
  std::vector<double> heading;
};

Vec2 in_body(const Truth& truth, std::size_t of, Point p) {
  const Point d = p - truth.at[of];
  const double c = std::cos(truth.heading[of]), s = std::sin(truth.heading[of]);
  return {static_cast<float>(c * d.x + s * d.y), static_cast<float>(c * d.y - s * d.x)};
}

// What robot i measures of those within `reach`; its odometry began where it stood then, another one each.
Account told(const Truth& truth, const Truth& start, std::size_t i, double reach) {
  Account account;
  const Vec2 moved = in_body(start, i, truth.at[i]);
  account.odometry = {moved, static_cast<float>(std::remainder(truth.heading[i] - start.heading[i], 2.0 * M_PI))};
  for (std::size_t j = 0; j < truth.at.size(); ++j)
    if (j != i && norm(truth.at[j] - truth.at[i]) < reach)
      account.seen.push_back({static_cast<RobotId>(j), in_body(truth, i, truth.at[j])});
  return account;
}

Truth line_of(std::size_t count) {
  std::mt19937 random(3);  // NOLINT(cert-msc32-c,cert-msc51-cpp): the same cases every time
  std::uniform_real_distribution<double> any(-3.0, 3.0);
  Truth truth;
  for (std::size_t i = 0; i < count; ++i) {
    truth.at.push_back({0.8 * static_cast<double>(i) + 0.1 * any(random), 0.1 * any(random)});
    truth.heading.push_back(any(random));
  }
  return truth;
}

void drive(Truth& truth, double step) {
  for (std::size_t i = 0; i < truth.at.size(); ++i) {
    truth.heading[i] += 0.3 * step * (static_cast<double>(i % 3) - 1.0);
    truth.at[i] = truth.at[i] + Point{step * std::cos(truth.heading[i]), step * std::sin(truth.heading[i])};
  }
}

// Distances and the angles at which headings stand to each other are the same in every frame.
void expect_charted(const Chart& chart, const Truth& truth, double within = 1e-4) {
  const auto poses = chart.poses();
  for (std::size_t i = 0; i < truth.at.size(); ++i) {
    ASSERT_TRUE(poses[i]) << i;
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_NEAR(norm(poses[i]->position - poses[j]->position), norm(truth.at[i] - truth.at[j]), within)
          << i << " " << j;
      EXPECT_NEAR(std::remainder(poses[i]->heading_rad - poses[j]->heading_rad - truth.heading[i] + truth.heading[j],
                                 2.0 * M_PI),
                  0.0, within);
    }
  }
}

TEST(Chart, PlacesAllAlongPairsThatMeasureEachOther) {
  const Truth start = line_of(9);
  Truth truth = start;
  Chart chart(9);
  for (int tick = 0; tick < 50; ++tick) {
    for (std::size_t i = 0; i < 9; ++i) chart.take(i, told(truth, start, i, 1.5));
    chart.update();
    expect_charted(chart, truth);
    drive(truth, 0.02);
  }
  EXPECT_NEAR(chart.poses()[0]->position.x, static_cast<double>(told(truth, start, 0, 1.5).odometry.position.x),
              0.03);  // the anchor's frame
}

TEST(Chart, KnowsNothingOfWhoIsMeasuredByNobodyOrFromOneSideOnly) {
  const Truth truth = line_of(3);
  Chart chart(3);
  EXPECT_EQ(chart.missing().size(), 3U);
  chart.take(0, told(truth, truth, 0, 1.5));
  chart.update();
  EXPECT_EQ(chart.missing(), (std::vector<std::size_t>{1, 2}));
  Account blind = told(truth, truth, 1, 1.5);
  blind.seen.clear();
  chart.take(1, blind);
  chart.update();
  EXPECT_EQ(chart.missing(), (std::vector<std::size_t>{1, 2}));
  EXPECT_FALSE(chart.target_of(0));
}

TEST(Chart, GoesOnByOdometryWhereTheChainIsBrokenAndWithoutItsAnchor) {
  const Truth start = line_of(5);
  Truth truth = start;
  Chart chart(5);
  for (int tick = 0; tick < 60; ++tick) {
    for (std::size_t i = tick < 30 ? 0 : 1; i < 5; ++i) {  // robot 0, the anchor, falls silent
      Account account = told(truth, start, i, 1.5);
      if (tick > 10)
        std::erase_if(account.seen, [&](const Sighting& s) { return (i == 4) != (s.robot == 4); });  // 4 is alone
      chart.take(i, account);
    }
    chart.update();
    if (tick < 30) expect_charted(chart, truth, 1e-3);
    const auto poses = chart.poses();
    for (std::size_t i = 1; i < 5; ++i)
      for (std::size_t j = 1; j < i; ++j)
        EXPECT_NEAR(norm(poses[i]->position - poses[j]->position), norm(truth.at[i] - truth.at[j]), 1e-3)
            << i << " " << j;
    drive(truth, 0.02);
  }
}

TEST(Chart, TargetsAreWhereTheirWorkersSay) {
  const Truth truth = line_of(4);
  Chart chart(4);
  const Point target{1.0, 2.0};
  for (std::size_t i = 0; i < 4; ++i) {
    Account account = told(truth, truth, i, 1.5);
    if (i > 1) account.target = in_body(truth, i, target);
    chart.take(i, account);
  }
  chart.update();
  EXPECT_FALSE(chart.target_of(0));
  ASSERT_TRUE(chart.target_of(2) && chart.target_of(3));
  EXPECT_NEAR(norm(*chart.target_of(2) - *chart.target_of(3)), 0.0, 1e-4);
  EXPECT_NEAR(norm(*chart.target_of(2) - chart.poses()[0]->position), norm(target - truth.at[0]), 1e-4);
}

}  // namespace
}  // namespace banyan::udp
