// SPDX-License-Identifier: MIT
// The sets of neighbours are those of what neighbours said last, whoever comes, goes, falls silent or is displaced.
#include "banyan/controller/tree/table.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <random>
#include <vector>

#include "bench.hpp"
#include "visited.hpp"

namespace banyan {
namespace {

std::vector<int> those(const TreeTable& table, const std::function<bool(const TreeStanding&)>& belong) {
  std::vector<int> list;
  for (int k = 0; k < table.size(); ++k)
    if (belong(table.message(k))) list.push_back(k);
  return list;
}

// The same by looking at all.
RobotId next_alive(const TreeTable& table, RobotId id) {
  std::vector<RobotId> alive;
  for (int k = 0; k < table.size(); ++k)
    if (table.alive(k)) alive.push_back(table.id(k));
  if (alive.empty()) return nobody;
  std::sort(alive.begin(), alive.end());
  const auto at = std::upper_bound(alive.begin(), alive.end(), id);
  return at == alive.end() || id == nobody ? alive.front() : *at;
}

RC_GTEST_PROP(TreeTable, ItsSetsAreThoseOfWhatNeighboursSaid, ()) {
  std::minstd_rand random(*rc::gen::inRange(1U, 1000000U));
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  ConvoyBench bench = grown();
  const int robots = *rc::gen::element(3, 20, 40, 130);  // of 130 not all find room
  for (int tick = 0; tick < 60; ++tick) {
    for (int id = 2; id < robots; ++id) {
      if (below(8) != 0) continue;
      const auto n = static_cast<RobotId>(id);
      bench.silence(n);
      if (below(3) == 0) continue;
      auto& m = bench.put(n, {0.005F * static_cast<float>(below(190)), 0.15F});
      const auto anyone = [&] { return std::array<RobotId, 3>{nobody, 1, 77}[static_cast<std::size_t>(below(3))]; };
      m.role = static_cast<Role>(below(4));
      m.tree_hops = static_cast<std::uint8_t>(below(3));
      m.parent = anyone();
      m.old_parent = anyone();
      m.grant = anyone();
      m.count = anyone();  // whom it names as heard
    }
    const auto robot = bench.tick();
    const TreeTable& table = robot.table();
    RC_ASSERT(visited(table.all()) == those(table, [](const TreeStanding&) { return true; }));
    RC_ASSERT(visited(table.members) == those(table, [](const TreeStanding& m) { return m.role != Role::spare; }));
    int least = unreachable;
    for (int k = 0; k < table.size(); ++k) least = std::min<int>(least, table.message(k).tree_hops);
    RC_ASSERT(table.least_hops == least);
    RC_ASSERT(visited(table.nearest) == those(table, [&](const TreeStanding& m) { return m.tree_hops == least; }));
    RC_ASSERT(visited(table.below) ==
              those(table, [](const TreeStanding& m) { return m.parent == 1 || m.old_parent == 1; }));
    RC_ASSERT(visited(table.untied) ==
              those(table, [](const TreeStanding& m) { return is_untied(m) || hold_of(m) == 1; }));
    std::vector<int> deaf;
    for (int k = 0; k < table.size(); ++k)
      if (robot.is_deaf(k)) deaf.push_back(k);
    RC_ASSERT(visited(table.deaf) == deaf);
    const auto id = below(8) == 0 ? nobody : static_cast<RobotId>(below(robots));
    RC_ASSERT(table.next_heard(id, robot.liveness_ticks()) == next_alive(table, id));
  }
}

}  // namespace
}  // namespace banyan
