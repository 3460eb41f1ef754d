// SPDX-License-Identifier: MIT
// Metres and decisions of robots that do what the test says, and of a real run counted anew.
#include "banyan/measure/effort.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "banyan/controller/core/output.hpp"
#include "banyan/controller/core/swarm_of.hpp"
#include "banyan/measure/observer.hpp"
#include "plain_scenario.hpp"

namespace banyan::measure {
namespace {

using world::Vec2;
using world::World;

namespace script {  // the message's fields are found by its namespace; others in this program have their own

struct Nod {
  static constexpr std::uint8_t blocks = 0;
  RobotId id = nobody;
};
template <class Visitor, class M> constexpr void visit_fields(Visitor& visit, M& m) noexcept {
  visit.robot("id", "of the sender", m.id);
}

// What robots report after their n-th step. Robot 0 stands, 1 drives straight on at 0.1 m/s, 2 turns on the spot,
// 3 drives there and back: two steps on, two steps back.
struct Scripted {
  using Params = Machine;
  using Message = Nod;
  struct State {
    RobotId id;
    int steps;
  };
  struct Heard {
    const Nod* message;
    banyan::Vec2 position;
    float age_s;
  };
  static State initial(RobotId id, bool, bool) { return {id, 0}; }
  static Output<Nod> step(const Params&, State& self, const Inputs<Heard>&) {
    ++self.steps;
    const float speed = self.id == 1 ? 0.5F : self.id == 3 ? (self.steps % 4 < 2 ? 0.5F : -0.5F) : 0.0F;
    return {{self.id}, {speed, 0.0F, self.id == 2 ? 10.0F : 0.0F}};
  }
  static Report report(const State& self) {
    Report r;
    r.role = self.id == 0 ? Role::root : Role::spare;
    if (self.id == 1 && self.steps >= 2) r.parent = 0;                       // in step 2
    if (self.id == 2 && self.steps >= 3) r.parent = self.steps < 6 ? 0 : 1;  // in steps 3 and 6,
    if (self.id == 2 && self.steps >= 3) r.role = Role::connector;           // at once with the parent in 3
    if (self.id == 2) r.old_parent = static_cast<RobotId>(self.steps);       // does not count
    if (self.id == 3 && self.steps >= 4) r.serves = 3;                       // in step 4
    if (self.id == 3 && self.steps >= 5) r.role = Role::worker;              // in step 5
    return r;
  }
  static void add_to(Digest& digest, const State& self) { digest.add(self.id); }
};

class ScriptedAlgorithm final : public Algorithm {
  std::string_view name() const noexcept override { return "scripted"; }
  std::string_view summary() const noexcept override { return "does what the test says"; }
  std::vector<const ParameterInfo*> parameters() const override { return {}; }
  std::vector<float> values(const Setup&) const override { return {}; }
  std::string fault(const Setup&) const override { return {}; }
  std::unique_ptr<Swarm> make(const Setup& setup, std::span<const Member> members) const override {
    return std::make_unique<SwarmOf<Scripted>>(machine_of(setup.platform), setup.platform, members, setup.history);
  }
};

}  // namespace script

const script::ScriptedAlgorithm scripted;

world::Scenario apart() {
  world::Scenario s;
  s.swarm.start.layout = world::Layout::list;
  s.swarm.start.positions = {{0, 0}, {0, 1}, {0, 2}, {0, 3}};
  s.swarm.start.headings_rad = {0, 0, 0, 0};
  s.swarm.robots = 4;
  s.swarm.root = 0;
  s.targets = std::vector<Vec2>{{9, 0}};
  return s;
}

// The commands of a step become motion in the next tick.
TEST(Effort, CountsTheMetresThatRobotsDrive) {
  World world(apart(), scripted);
  Effort effort(world);
  const double metres[] = {0.0, 0.02, 0.04, 0.06, 0.08, 0.10};  // robots 1 and 3, which moves as much
  for (const double expected : metres) {
    world.step();
    effort.observe(world);
    EXPECT_NEAR(effort.driven_m(), expected, 1e-6) << world.tick();
  }
  EXPECT_NEAR(distance(world.positions()[3], Vec2{0.0, 3.0}), 0.01, 1e-6) << "there and back";
}

TEST(Effort, CountsADecisionWhereRoleParentOrTargetChanges) {
  World world(apart(), scripted);
  Effort effort(world);
  const std::uint64_t expected[] = {0, 1, 2, 3, 4, 5, 5, 5};
  for (const std::uint64_t decisions : expected) {
    world.step();
    effort.observe(world);
    EXPECT_EQ(effort.decisions(), decisions) << world.tick();
  }
}

// Robots 1 and 3 die after two ticks of motion each, robot 3 before its decisions.
TEST(Effort, TheDeadNeitherDriveNorDecide) {
  world::Scenario s = apart();
  s.events = {{.time_s = 0.3, .action = world::Die{1}}, {.time_s = 0.3, .action = world::Die{3}}};
  World world(s, scripted);
  Observer observer(world);
  for (int t = 0; t < 10; ++t) {
    world.step();
    observer.observe(world);
  }
  const measure::Run run = observer.result(world);
  EXPECT_NEAR(run.driven_m, 0.04 / 4, 1e-6) << "two robots 0.02 m each, of four";
  EXPECT_EQ(run.decisions, 3U) << "that of robot 1 and two of robot 2";
  EXPECT_EQ(run.messages, 4U * 2 + 2U * 7) << "in tick n what was written in n - 1";
}

TEST(Effort, NothingHasHappenedBeforeTheFirstTick) {
  World world(apart(), scripted);
  const measure::Run run = Observer(world).result(world);
  EXPECT_EQ(run.driven_m, 0.0);
  EXPECT_EQ(run.decisions, 0U);
  EXPECT_EQ(run.messages, 0U);
}

// The same from the whole history of a real run.
TEST(Effort, AgreesWithTheHistoryOfARun) {
  for (const char* algorithm : {"convoy", "inwards", "chains"}) {
    world::Scenario s = world::plain_scenario();
    s.mission.algorithm = algorithm;
    s.swarm.robots = 24;
    s.targets = world::RingTargets{3, 3.0};
    World world(s);
    Observer observer(world);
    std::vector<std::vector<Vec2>> positions(24);
    std::vector<std::vector<std::string>> choices(24);
    const auto note = [&] {
      for (std::size_t i = 0; i < 24; ++i) {
        const Report& r = world.reports()[i];
        positions[i].push_back(world.positions()[i]);
        choices[i].push_back(std::to_string(static_cast<int>(r.role)) + " " + std::to_string(r.parent) + " " +
                             std::to_string(r.serves));
      }
    };
    note();
    while (!observer.finished()) {
      world.step();
      observer.observe(world);
      note();
    }
    double driven_m = 0.0;
    std::uint64_t decisions = 0;
    for (std::size_t i = 0; i < 24; ++i)
      for (std::size_t k = 1; k < positions[i].size(); ++k) {
        driven_m += std::hypot(positions[i][k].x - positions[i][k - 1].x, positions[i][k].y - positions[i][k - 1].y);
        decisions += choices[i][k] != choices[i][k - 1] ? 1 : 0;
      }
    const measure::Run run = observer.result(world);
    EXPECT_NEAR(run.driven_m, driven_m / 24, 1e-9) << algorithm;
    EXPECT_EQ(run.decisions, decisions) << algorithm;
    EXPECT_GT(run.decisions, 10U) << algorithm;
    EXPECT_GT(run.driven_m, 0.1) << algorithm;
    EXPECT_EQ(run.messages, world.packets_sent());
  }
}

}  // namespace
}  // namespace banyan::measure
