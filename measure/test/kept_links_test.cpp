// SPDX-License-Identifier: MIT
// Links that robots without a tree promise to keep: each counts once, whoever tells of it, and is broken as an edge is.
#include <gtest/gtest.h>

#include <vector>

#include "banyan/controller/core/output.hpp"
#include "banyan/controller/core/swarm_of.hpp"
#include "banyan/measure/observer.hpp"
#include "banyan/world/world.hpp"

namespace banyan::measure {
namespace {

struct Hello {
  static constexpr std::uint8_t blocks = 0;
  RobotId id = nobody;
};
template <class Visitor, class M> constexpr void visit_fields(Visitor& visit, M& m) noexcept {
  visit.robot("id", "of the sender", m.id);
}

// Robots that stand and keep what the test says: robot i links[i], with parent parents[i].
struct Promise {
  RobotId parent = nobody;
  std::vector<RobotId> links;
};
// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): an algorithm has no other way to a test
std::vector<Promise> promises;

struct Standing {
  using Params = Machine;
  using Message = Hello;
  struct State {
    RobotId id;
  };
  struct Heard {
    const Hello* message;
    banyan::Vec2 position;
    float age_s;
  };
  static State initial(RobotId id, bool, bool) { return {id}; }
  static Output<Hello> step(const Params&, State& self, const Inputs<Heard>&) { return {{self.id}, {}}; }
  static Report report(const State& self) {
    Report r;
    r.role = self.id == 0 ? Role::root : Role::connector;
    if (self.id >= promises.size()) return r;
    r.parent = promises[self.id].parent;
    std::copy(promises[self.id].links.begin(), promises[self.id].links.end(), r.kept.begin());
    return r;
  }
  static void add_to(Digest& digest, const State& self) { digest.add(self.id); }
};

class StandingAlgorithm final : public Algorithm {
  std::string_view name() const noexcept override { return "standing"; }
  std::string_view summary() const noexcept override { return "stands"; }
  std::vector<const ParameterInfo*> parameters() const override { return {}; }
  std::vector<float> values(const Setup&) const override { return {}; }
  std::string fault(const Setup&) const override { return {}; }
  std::unique_ptr<Swarm> make(const Setup& setup, std::span<const Member> members) const override {
    return std::make_unique<SwarmOf<Standing>>(machine_of(setup.platform), setup.platform, members, setup.history);
  }
};

// 0, 1, 2 in a row 0.95 m apart, 3 near enough to 2 alone.
struct Row {
  StandingAlgorithm algorithm;
  world::World world{scenario(), algorithm};
  Observer observer{world};

  static world::Scenario scenario() {
    world::Scenario s;
    s.swarm.start.layout = world::Layout::list;
    s.swarm.start.positions = {{0, 0}, {0.95, 0}, {1.9, 0}, {3.8, 0}};
    s.swarm.robots = 4;
    s.swarm.root = 0;
    s.targets = std::vector<world::Vec2>{{9, 0}};
    s.radio.line_of_sight = true;
    return s;
  }
  const Tick& step() {
    world.step();
    return observer.observe(world);
  }
};

TEST(KeptLinks, CountOnceWhicheverEndTells) {
  promises = {{nobody, {1}}, {nobody, {0, 2}}, {nobody, {}}};
  Row both;
  EXPECT_EQ(both.step().edges, 2U) << "0-1 is told by both, 1-2 by one";
  EXPECT_NEAR(both.observer.result(both.world).network_length_m, 1.9, 1e-9);
  promises = {{nobody, {}}, {nobody, {}}, {nobody, {1}}};
  Row one;
  EXPECT_EQ(one.step().edges, 1U) << "the end with the larger id alone";
}

TEST(KeptLinks, AnEdgeToAParentIsNotCountedAgain) {
  promises = {{nobody, {1}}, {0, {0, 2}}, {1, {1}}};
  Row r;
  EXPECT_EQ(r.step().edges, 2U);
  EXPECT_NEAR(r.observer.result(r.world).network_length_m, 1.9, 1e-9);
}

TEST(KeptLinks, BreakAsEdgesDo) {
  promises = {{nobody, {1, 2}}, {nobody, {0}}, {nobody, {0}}, {nobody, {1}}};
  Row r;
  Tick tick = r.step();
  EXPECT_EQ(tick.edges, 3U);
  EXPECT_EQ(tick.broken_by_distance, 1U) << "1-3";
  EXPECT_EQ(tick.broken_by_occlusion, 1U) << "0-2, behind 1";
  r.world.intervene({.action = world::Die{1}});
  tick = r.step();
  EXPECT_EQ(tick.edges, 3U);
  EXPECT_EQ(tick.broken_by_death, 2U) << "0-1 and 1-3, told by the living";
}

}  // namespace
}  // namespace banyan::measure
