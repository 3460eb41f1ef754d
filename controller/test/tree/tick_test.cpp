// SPDX-License-Identifier: MIT
// The beginning of a tick: packets are carried to where their senders are now, strangers are told from
// nobody, orders are followed.
#include "tree/tick.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <tuple>

#include "bench.hpp"
#include "numbers.hpp"

namespace banyan {
namespace {

using W = BasicVec2<double>;

// A robot that drives and turns evenly in the world, from the origin, its heading along x.
struct Path {
  W speed;
  double turn_rad_s;
  double elapsed_s;

  [[nodiscard]] W at(double t) const { return speed * t; }
  [[nodiscard]] W heading(double t) const { return {std::cos(turn_rad_s * t), std::sin(turn_rad_s * t)}; }
  // A place in the world as the robot sees it then.
  [[nodiscard]] Vec2 seen(W place, double t) const {
    const W d = rotate_back(heading(t), place - at(t));
    return {static_cast<float>(d.x), static_cast<float>(d.y)};
  }
  [[nodiscard]] Odometry odometry() const {
    const W moved = at(elapsed_s);
    return {static_cast<float>(moved.x), static_cast<float>(moved.y), static_cast<float>(turn_rad_s * elapsed_s)};
  }
};

Vec2 carried(const Path& path, Vec2 measured, float age_s, float elapsed_s) {
  TreeMessage message;
  message.id = 5;
  std::array heard{Heard{&message, measured, age_s}};
  const Inputs<Heard> inputs(heard, {.odometry = path.odometry(), .elapsed_s = elapsed_s}, test_platform);
  return inputs.heard()[0].position;
}

Path random_path() {
  return {{static_cast<double>(number(-0.15F, 0.15F)), static_cast<double>(number(-0.15F, 0.15F))},
          static_cast<double>(number(-4.0F, 4.0F)),
          static_cast<double>(number(0.1F, 0.6F))};
}

RC_GTEST_PROP(HeardAge, APacketIsCarriedByTheOdometrySince, ()) {
  const Path path = random_path();
  const W sender{static_cast<double>(number(-1, 1)), static_cast<double>(number(-1, 1))};
  const double age_s = path.elapsed_s * static_cast<double>(number(0.0F, 1.0F));
  const Vec2 now = carried(path, path.seen(sender, path.elapsed_s - age_s), static_cast<float>(age_s),
                           static_cast<float>(path.elapsed_s));
  RC_ASSERT(distance(now, path.seen(sender, path.elapsed_s)) < 1e-4F);
}

TEST(HeardAge, WithoutAgeItIsAsOfNow) {
  const Path path{{0.2, 0.0}, 1.0, 0.1};
  EXPECT_EQ(carried(path, {0.5F, 0.25F}, 0.0F, 0.1F), (Vec2{0.5F, 0.25F}));
}

TEST(HeardAge, OlderThanTheLastStepItCountsAsOfThen) {
  const Path path{{0.2, 0.1}, 1.0, 0.1};
  const Vec2 then = path.seen({1.0, 0.5}, 0.0);
  EXPECT_LT(distance(carried(path, then, 0.5F, 0.1F), path.seen({1.0, 0.5}, 0.1)), 1e-5F);
}

TEST(HeardAge, AnUntimedStepLastsOneTick) {
  const Path path{{0.2, 0.1}, 1.0, 0.1};
  const Vec2 measured = path.seen({1.0, 0.5}, 0.05);
  EXPECT_LT(distance(carried(path, measured, 0.05F, 0.0F), path.seen({1.0, 0.5}, 0.1)), 1e-5F);
}

// Through the whole step, into the table.
TEST(HeardAge, TheTableHasWhatWasCarried) {
  for_each_kind([]<class Kind>() {
    const Path path{{0.2, 0.0}, 2.0, 0.1};
    typename Kind::Message message;
    message.id = 5;
    auto state = Kind::initial(1, false, false);
    std::array heard{typename Kind::Heard{&message, path.seen({1.0, 0.5}, 0.05), 0.05F}};
    const auto params = Kind::defaults();
    Kind::step(params, state, {heard, {.odometry = path.odometry(), .elapsed_s = 0.1F}, test_platform});
    ASSERT_EQ(state.neighbors.size(), 1);
    EXPECT_LT(distance(state.neighbors.position(0), path.seen({1.0, 0.5}, 0.1)), 1e-5F);
  });
}

TEST(Table, NeitherItselfNorNobodyIsANeighbor) {
  ConvoyBench bench;
  bench.put(1, {0.5F, 0});
  bench.put(nobody, {0.5F, 0});
  EXPECT_EQ(bench.tick().table().size(), 0);
  bench.put(2, {0.5F, 0});
  EXPECT_EQ(bench.tick().table().size(), 1);
}

TEST(Table, LongerStepsAgeItFaster) {
  ConvoyBench bench;
  bench.params.largest_loss = 0.0F;  // else it would count as lost packets
  bench.put(2, {0.2F, 0});
  bench.step();
  bench.state.turn = 100;  // no longer the first seconds of a thin start
  const auto silent_step = [&] {
    std::ignore = convoy_step(bench.params, bench.state, {{}, {.elapsed_s = 0.5F}, test_platform});
  };
  silent_step();
  ASSERT_EQ(bench.state.neighbors.size(), 1);
  EXPECT_EQ(bench.state.neighbors.age(0), 5);
  silent_step();
  EXPECT_EQ(bench.state.neighbors.size(), 0) << "10 ticks: longer than I";
}

TEST(Report, SaysWhatAnObserverMayKnow) {
  TreeState s = initial_tree_state(4, true, false);
  s.parent = 7;
  s.epoch = 3;
  s.tally.repairs = 2;
  const Report report = tree_report(s);
  EXPECT_EQ(report.role, Role::worker);
  EXPECT_EQ(report.parent, 7);
  EXPECT_EQ(report.serves, 4);
  EXPECT_EQ(report.epoch, 3);
  EXPECT_EQ(report.label, -1.0F) << "unknown";
  EXPECT_EQ(report.tally.repairs, 2U);
  s.label = 128;
  EXPECT_EQ(tree_report(s).label, 0.5F);
}

}  // namespace
}  // namespace banyan
