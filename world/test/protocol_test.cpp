// SPDX-License-Identifier: MIT
// What must hold at every tick of every run, watched over random worlds: no cycle of parents, one
// root, gossip that only grows, edges that the guard keeps. BANYAN_LONG=1 watches many more.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

#include "worlds.hpp"

namespace banyan::world {
namespace {

struct Conditions {
  std::string algorithm;
  std::string reading;
  double loss;
  bool line_of_sight;
};

std::string title(const testing::TestParamInfo<Conditions>& info) {
  const Conditions& c = info.param;
  return c.algorithm + "_" + c.reading + (c.loss > 0.0 ? "_lossy" : "") + (c.line_of_sight ? "_occluded" : "");
}

void PrintTo(const Conditions& c, std::ostream* out) {
  *out << c.algorithm << ", " << c.reading << ", loss " << c.loss << (c.line_of_sight ? ", occluded" : "");
}

std::vector<Conditions> all_conditions() {
  std::vector<Conditions> all;
  for (const char* algorithm : {"outwards", "inwards"})
    for (const char* reading : {"corrected", "literal"})
      for (const double loss : {0.0, 0.3})
        for (const bool line_of_sight : {false, true}) all.push_back({algorithm, reading, loss, line_of_sight});
  for (const double loss : {0.0, 0.3})
    for (const bool line_of_sight : {false, true}) all.push_back({"convoy", "corrected", loss, line_of_sight});
  return all;
}

Scenario random_scenario(const Conditions& c, std::uint64_t seed) {
  const auto draw = [&](std::uint64_t k) { return to_uniform(bits(seed, Purpose::targets, 1000, k)); };
  const std::size_t targets = 2 + static_cast<std::size_t>(3 * draw(0));
  const double radius_m = 2.0 + 5.0 * draw(1);
  const auto robots =
      static_cast<std::size_t>((1.2 + 2.5 * draw(2)) * static_cast<double>(targets) * radius_m / 1.54) + targets + 1;
  Scenario s = ring(c.algorithm, robots, targets, radius_m, seed);
  s.mission.reading = c.reading;
  s.radio.loss = c.loss;
  s.radio.line_of_sight = c.line_of_sight;
  // Every other world rebuilds its tree all the time.
  if (seed % 2 == 0) s.mission.parameters = {{"reconfiguration_drives", 0.1 + 9.0 * draw(3)}};
  return s;
}

// What a robot remembers, whatever its algorithm.
struct Memory {
  RobotId id;
  bool is_worker;
  Role role;
  Serial epoch;
  Phase phase;
  Serial seqno;
  std::uint16_t label;
  RobotId parent;
  RootToken root;
  RobotId new_root;
};

std::vector<Memory> memories(const World& world) {
  return inside(world.swarm(), [&](const auto& swarm) {
    std::vector<Memory> list;
    for (std::size_t i = 0; i < world.size(); ++i) {
      const auto& s = swarm.state(i);
      list.push_back({s.id,
                      s.is_worker,
                      s.role,
                      s.epoch,
                      s.phase,
                      s.seqno,
                      s.label,
                      s.parent,
                      {s.root.sequence, s.root.id},
                      s.new_root});
    }
    return list;
  });
}

std::string chain(const std::vector<Memory>& robots, std::size_t i) {
  std::string text;
  for (int hop = 0; hop < 8 && i < robots.size(); ++hop) {
    const Memory& s = robots[i];
    text += std::to_string(i) + " [epoch " + std::to_string(s.epoch) + " seqno " + std::to_string(s.seqno) + " label " +
            std::to_string(s.label) + "] -> ";
    i = s.parent;
  }
  return text;
}

class Protocol : public testing::TestWithParam<Conditions> {
 protected:
  // Calls check(world) after every tick of many random worlds.
  template <class Check> static void watch(Check check, std::uint64_t few = 8, int ticks = 700) {
    const std::uint64_t seeds = long_search() ? 40 * few : few;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      World world(random_scenario(GetParam(), seed));
      for (int t = 0; t < ticks && !HasFatalFailure(); ++t) {
        world.step();
        SCOPED_TRACE("seed " + std::to_string(seed) + ", tick " + std::to_string(world.tick()));
        check(world);
      }
      if (HasFatalFailure()) return;
    }
  }
};

// The triples (epoch, seqno, label) strictly rise along parents, so no chain of parents can close.
TEST_P(Protocol, ParentsNeverFormACycleAndAreAheadOfTheirChildren) {
  watch([](const World& world) {
    const std::size_t n = world.size();
    const std::vector<Memory> robots = memories(world);
    for (std::size_t i = 0; i < n; ++i) {
      const Memory& child = robots[i];
      if (child.parent == nobody) continue;
      ASSERT_LT(child.parent, n);
      const Memory& parent = robots[child.parent];
      if (GetParam().algorithm != "convoy") {  // there workers relay
        ASSERT_FALSE(parent.is_worker) << chain(robots, i);
      }
      ASSERT_GE(parent.epoch, child.epoch) << chain(robots, i);
      const bool ahead = parent.seqno > child.seqno || (parent.seqno == child.seqno && parent.label < child.label);
      ASSERT_TRUE(parent.epoch > child.epoch || ahead) << chain(robots, i);
      std::size_t top = i;
      std::size_t hops = 0;
      while (world.reports()[top].parent != nobody && hops <= n) top = world.reports()[top].parent, ++hops;
      ASSERT_LE(hops, n) << "cycle: " << chain(robots, i);
    }
  });
}

TEST_P(Protocol, GossipOnlyGrows) {
  std::vector<Memory> before;
  watch(
      [&](const World& world) {
        const std::vector<Memory> states = memories(world);
        if (world.tick() == 1) before = states;
        for (std::size_t i = 0; i < states.size(); ++i) {
          const Memory& now = states[i];
          ASSERT_GE(now.epoch, before[i].epoch) << i;
          if (now.epoch == before[i].epoch) {
            ASSERT_GE(now.phase, before[i].phase) << i;
            ASSERT_GE(now.seqno, before[i].seqno) << i;
            // Within an epoch nobody falls back behind what it has sent.
            ASSERT_TRUE(now.seqno > before[i].seqno || now.label <= before[i].label) << i;
          }
          ASSERT_FALSE(newer(before[i].root, now.root)) << i;
        }
        before = states;
      },
      4);
}

// During a hand-over the old root still believes in itself until it hears its heir; losses and
// occlusion make that longer, and a refused token makes a third. A root whose heir has fallen out of
// its range in that tick cannot know better, and does not count.
TEST_P(Protocol, ThereIsOneRootExceptDuringAHandOver) {
  const bool calm = GetParam().loss == 0.0 && !GetParam().line_of_sight;
  int several = 0;
  watch([&](const World& world) {
    if (world.tick() == 1) several = 0;
    const std::vector<Memory> states = memories(world);
    const auto has_lost_heir = [&](const Memory& s) {
      const auto links = world.links(s.id);
      return s.new_root != nobody && std::find(links.begin(), links.end(), s.new_root) == links.end();
    };
    const auto believers =
        std::count_if(states.begin(), states.end(), [](const Memory& s) { return s.role == Role::root; });
    const auto roots = std::count_if(states.begin(), states.end(),
                                     [&](const Memory& s) { return s.role == Role::root && !has_lost_heir(s); });
    ASSERT_GE(believers, 1);
    ASSERT_LE(calm ? roots : believers, calm ? 2 : 5);
    several = believers > 1 ? several + 1 : 0;
    ASSERT_LE(several, calm ? 5 : 25) << "ticks with several roots in a row";
    // Nobody believes in a root that does not exist, and the newest token's owner is root.
    for (const Memory& s : states) ASSERT_LT(s.root.id == nobody ? RobotId{0} : s.root.id, states.size());
  });
}

TEST_P(Protocol, MessagesNameRobotsThatExist) {
  watch(
      [](const World& world) {
        const auto n = static_cast<RobotId>(world.size());
        for (std::size_t i = 0; i < n; ++i) {
          inside(world.swarm(), [&](const auto& swarm) {
            const auto& m = swarm.message(i);
            ASSERT_EQ(m.id, i);
            // All whom it names as their part in the tree.
            std::vector<RobotId> named{m.parent,  m.old_parent, m.flood_parent, m.grant,
                                       m.request, m.new_root,   m.root.id};
            if constexpr (requires { m.warned; }) named.insert(named.end(), {m.warned, m.inserted_child});
            for (const RobotId id : named) ASSERT_TRUE(id == nobody || (id < n && (id != i || m.root.id == i))) << i;
            ASSERT_NE(m.parent, m.id);
            ASSERT_NE(m.old_parent, m.id);
            ASSERT_EQ(m.role == Role::root, m.root.id == i) << i;
            const auto wire = decode_fields<std::decay_t<decltype(m)>>(said(world, i));
            ASSERT_TRUE(wire && *wire == m) << i;
          });
        }
      },
      2);
}

// With both ends limiting their motion, no edge of the corrected reading outgrows delta; an edge
// that had to be taken beyond it (a flood parent, an orphan's) gets no longer than it was, but for
// the tick in which the parent does not know of it yet.
class Guarded : public Protocol {};

TEST_P(Guarded, TheGuardBoundsEveryEdgeOfTheTree) {
  constexpr double unaware_m = 0.02;  // v_max x tick
  constexpr double slack_m = 0.002;   // bodies push each other; single precision
  std::vector<RobotId> parents;
  std::vector<double> taken_at_m;
  watch(
      [&](const World& world) {
        if (world.tick() == 1) {
          parents.assign(world.size(), nobody);
          taken_at_m.assign(world.size(), 0.0);
        }
        const double delta_m = world.scenario().radio.range_m * inside(world.swarm(), [](const auto& swarm) {
                                 return static_cast<double>(swarm.params().ideal_distance);
                               });
        for (std::size_t i = 0; i < world.size(); ++i) {
          const Report& s = world.reports()[i];
          const bool taken = s.parent != parents[i];
          parents[i] = s.parent;
          if (s.parent == nobody || s.role == Role::spare) continue;
          const double d = distance(world.positions()[i], world.positions()[s.parent]);
          if (taken) taken_at_m[i] = d;
          ASSERT_LE(d, std::max(delta_m, taken_at_m[i] + unaware_m) + slack_m) << i << " -> " << s.parent;
        }
      },
      12);
}

INSTANTIATE_TEST_SUITE_P(Runs, Protocol, testing::ValuesIn(all_conditions()), title);
// With losses or occlusion an end may not know how long its edge is, and literal has no guard.
INSTANTIATE_TEST_SUITE_P(Runs, Guarded,
                         testing::Values(Conditions{"outwards", "corrected", 0.0, false},
                                         Conditions{"inwards", "corrected", 0.0, false}),
                         title);

}  // namespace
}  // namespace banyan::world
