// SPDX-License-Identifier: MIT
// Nothing in the controller sees truth: in a world that is shifted and rotated as a whole, every
// robot senses and does the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "banyan/world/bodies.hpp"
#include "banyan/world/placement.hpp"
#include "worlds.hpp"

namespace banyan::world {
namespace {

constexpr double tolerance = 1e-3;  // rounding grows along a run
constexpr double angle_rad = 1.234;
constexpr Vec2 shift{12.3, -4.5};

Vec2 elsewhere(Vec2 p) { return rotate(unit_vector(angle_rad), p) + shift; }

// The same start and targets as a list, as they are or moved.
Scenario fixed(const Scenario& s, bool moved) {
  const Poses poses = place(s);
  Scenario list = s;
  list.swarm.start.layout = Layout::list;
  list.swarm.start.positions.clear();
  for (std::size_t i = 0; i < poses.position.size(); ++i) {
    const double heading = angle_of(poses.heading[i]);
    list.swarm.start.positions.push_back(moved ? elsewhere(poses.position[i]) : poses.position[i]);
    list.swarm.start.headings_rad.push_back(moved ? std::remainder(heading + angle_rad, 2 * pi<double>) : heading);
  }
  std::vector<Vec2> targets = target_positions(s);
  if (moved) std::transform(targets.begin(), targets.end(), targets.begin(), elsewhere);
  list.targets = targets;
  list.swarm.robots = poses.position.size();
  list.mission.time_limit_s = 600;
  return list;
}

Vec2 seen(const World& world, std::size_t i, Vec2 p) {
  return rotate_back(world.headings()[i], p - world.positions()[i]);
}

const paper::Message& message_of(const World& world, std::size_t i) {
  return world.algorithm().name() == "outwards"
             ? swarm_as<PaperSwarm<paper::outwards, paper::corrected>>(world.swarm()).message(i)
             : swarm_as<PaperSwarm<paper::inwards, paper::corrected>>(world.swarm()).message(i);
}

void expect_near(Vec2 a, Vec2 b, const char* what) {
  ASSERT_NEAR(a.x, b.x, tolerance) << what;
  ASSERT_NEAR(a.y, b.y, tolerance) << what;
}

// All that a robot gets from the world, and what it makes of it.
void expect_same(const World& here, const World& there, const std::vector<Vec2>& last_here,
                 const std::vector<Vec2>& last_there, std::size_t i) {
  const auto links = here.links(i);
  const auto other_links = there.links(i);
  ASSERT_TRUE(std::equal(links.begin(), links.end(), other_links.begin(), other_links.end())) << "hears others";
  for (const std::uint32_t j : links)
    expect_near(seen(here, i, here.positions()[j]), seen(there, i, there.positions()[j]), "neighbour");
  for (std::size_t t = 0; t < here.targets().size(); ++t) {
    ASSERT_EQ(here.targets()[t].worker, there.targets()[t].worker);
    if (here.targets()[t].worker == i)
      expect_near(seen(here, i, here.targets()[t].position), seen(there, i, there.targets()[t].position), "target");
  }
  // Its motion since the last tick, and hence its commands and its odometry.
  expect_near(seen(here, i, last_here[i]), seen(there, i, last_there[i]), "motion");

  const paper::Message& a = message_of(here, i);
  paper::Message b = message_of(there, i);
  ASSERT_NEAR(a.q.x, b.q.x, tolerance);
  ASSERT_NEAR(a.q.y, b.q.y, tolerance);
  ASSERT_NEAR(a.pull_x, b.pull_x, tolerance * 16384);
  ASSERT_NEAR(a.pull_y, b.pull_y, tolerance * 16384);
  // Rounded on the wire: the last digit may differ.
  ASSERT_NEAR(a.centroid_x.value(), b.centroid_x.value(), 1.0F / per_range);
  ASSERT_NEAR(a.centroid_y.value(), b.centroid_y.value(), 1.0F / per_range);
  ASSERT_NEAR(a.want, b.want, 1);
  b.q = a.q;
  b.pull_x = a.pull_x;
  b.pull_y = a.pull_y;
  b.centroid_x = a.centroid_x;
  b.centroid_y = a.centroid_y;
  b.want = a.want;
  ASSERT_EQ(a, b) << "says something else";
  ASSERT_EQ(here.reports()[i].role, there.reports()[i].role);
  ASSERT_EQ(here.reports()[i].spare_state, there.reports()[i].spare_state);
}

class Truth : public testing::TestWithParam<const char*> {};

TEST_P(Truth, IsSeenByNobody) {
  for (const std::size_t robots : {20U, 30U, 40U}) {
    Scenario s = ring(GetParam(), robots, 3, 4.0, robots);
    s.radio.line_of_sight = true;
    s.swarm.root = robots - 1;
    World here(fixed(s, false));
    World there(fixed(s, true));
    std::vector<Vec2> last_here, last_there;
    for (int t = 0; t < 200; ++t) {
      last_here.assign(here.positions().begin(), here.positions().end());
      last_there.assign(there.positions().begin(), there.positions().end());
      here.step();
      there.step();
      for (std::size_t i = 0; i < robots; ++i) {
        SCOPED_TRACE("robot " + std::to_string(i) + " of " + std::to_string(robots) + ", tick " + std::to_string(t));
        ASSERT_NO_FATAL_FAILURE(expect_same(here, there, last_here, last_there, i));
      }
    }
    EXPECT_GT(distance(here.positions()[here.targets()[0].worker], last_here[0]), 0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(Algorithms, Truth, testing::Values("outwards", "inwards"),
                         [](const auto& algorithm) { return std::string(algorithm.param); });

}  // namespace
}  // namespace banyan::world
