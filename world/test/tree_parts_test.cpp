// SPDX-License-Identifier: MIT
#include "banyan/world/tree_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "banyan/world/random.hpp"

namespace banyan::world {
namespace {

struct Net {
  std::vector<std::uint8_t> alive;
  std::vector<Report> reports;
  std::vector<std::vector<std::uint32_t>> links;

  explicit Net(std::vector<Role> roles) : alive(roles.size(), 1), reports(roles.size()), links(roles.size()) {
    for (std::size_t i = 0; i < roles.size(); ++i) reports[i].role = roles[i];
  }
  Net& link(std::uint32_t i, std::uint32_t j) {
    links[i].push_back(j);
    links[j].push_back(i);
    return *this;
  }
  [[nodiscard]] std::uint32_t parts() const {
    TreeParts counter(alive.size());
    return counter.count(
        alive, reports, [this](std::size_t i) -> const auto& { return links[i]; });
  }
};

TEST(TreeParts, ASpareIsNeitherMissedNorAWay) {
  EXPECT_EQ(Net({Role::root, Role::connector, Role::worker}).link(0, 1).link(1, 2).parts(), 1U);
  EXPECT_EQ(Net({Role::root, Role::spare, Role::worker}).link(0, 1).link(1, 2).parts(), 2U);
  EXPECT_EQ(Net({Role::root, Role::worker, Role::spare}).link(0, 1).parts(), 1U);
  EXPECT_EQ(Net({Role::root, Role::worker, Role::connector}).link(0, 1).parts(), 2U);
}

TEST(TreeParts, WithoutALivingRootThereIsNoTree) {
  Net net({Role::root, Role::worker});
  EXPECT_EQ(net.parts(), 2U);
  net.alive[0] = 0;
  EXPECT_EQ(net.parts(), 0U);
}

// Against repeated union of sets, over random nets in which some are dead.
TEST(TreeParts, IsWhatMergingSetsGives) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const auto draw = [&](std::uint64_t a, std::uint64_t b) { return bits(seed, {}, a, b); };
    const std::size_t n = 2 + draw(0, 0) % 20;
    std::vector<Role> roles;
    for (std::size_t i = 0; i < n; ++i) roles.push_back(static_cast<Role>(draw(1, i) % 4));
    Net net(roles);
    std::vector<std::set<std::uint32_t>> sets;
    const auto of_tree = [&](std::uint32_t i) { return net.alive[i] != 0 && net.reports[i].role != Role::spare; };
    for (std::uint32_t i = 0; i < n; ++i) {
      net.alive[i] = draw(2, i) % 8 != 0 ? 1 : 0;
      if (of_tree(i)) sets.push_back({i});
    }
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t j = 0; j < i; ++j) {
        if (net.alive[i] == 0 || net.alive[j] == 0 || draw(100 + i, j) % n > 1) continue;
        net.link(i, j);
        const auto with = [&](std::uint32_t k) {
          return std::find_if(sets.begin(), sets.end(), [k](const auto& set) { return set.contains(k); });
        };
        if (!of_tree(i) || !of_tree(j) || with(i) == with(j)) continue;
        with(i)->merge(*with(j));
        std::erase_if(sets, [](const auto& set) { return set.empty(); });
      }
    bool root = false;
    for (const auto& set : sets)
      for (const std::uint32_t i : set) root = root || net.reports[i].role == Role::root;
    EXPECT_EQ(net.parts(), root ? sets.size() : 0U) << seed;
  }
}

}  // namespace
}  // namespace banyan::world
