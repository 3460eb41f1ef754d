// SPDX-License-Identifier: MIT
// Emergencies, avoidance, and the control law against the paper's equations.
#include "tree/motion.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench.hpp"
#include "numbers.hpp"

namespace banyan {
namespace {

TEST(Avoidance, IsFiniteOnTheSameSpot) {
  for (const float d : {0.0F, 1e-30F, 1e-23F, 1e-19F, 1e-10F, 1e-6F, 1.1e-6F, 1e-5F}) {
    ConvoyBench bench = grown();
    bench.put(5, {0.0F, d});
    bench.obstacles = {{d, 0.0F}};
    const Vec2 u = avoidance(bench.tick());
    EXPECT_TRUE(std::isfinite(u.x) && std::isfinite(u.y)) << d;
  }
}

// ---- The whole law ----

template <class Kind> class MovingOf : public testing::Test {
 protected:
  BenchOf<Kind> bench = grown<Kind>();
  void become_worker(Vec2 parent) {
    bench.params.drive = Drive::holonomic;
    if constexpr (requires { bench.state.turn; })
      bench.state.turn = 100;  // no longer the first seconds of a thin start
    bench.state.role = Role::worker;
    bench.state.parent = 9;
    auto& m = bench.put(9, parent);
    m.role = Role::root;
    m.depth = 1;
    m.label = 0;
    bench.state.label = 200;
    bench.state.depth = 2;
  }
};
using Moving = MovingOf<Convoy>;

TEST_F(Moving, BeyondDeltaARobotHurriesToItsParent) {
  become_worker({0, 0.975F});
  bench.send({0, -2.5F});
  const Motion v = bench.step().motion;
  EXPECT_NEAR(v.sideways, 1.0F, 5e-5F);
  EXPECT_NEAR(v.forward, 0.0F, 5e-5F);
}

TEST_F(Moving, TheTargetsPullFadesOnArrival) {
  become_worker({-0.65F, 0});
  bench.send({0.05F, 0});
  bench.step();
  EXPECT_NEAR(norm(bench.state.pull), bench.params.target_gain * 0.5F, 1e-4F) << "half-way into the arrival distance";
}

TEST_F(Moving, ASilentParentIsSoughtWhereItMustBe) {
  become_worker({0, 0.5F});
  bench.send({0, -2.5F});
  bench.step();
  bench.silence(9);
  const auto output = bench.steps(20);
  EXPECT_NEAR(output.motion.sideways, 1.0F, 5e-4F);
  EXPECT_TRUE(output.message.parent_silent);
}

}  // namespace
}  // namespace banyan
