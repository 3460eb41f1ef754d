// SPDX-License-Identifier: MIT
// The table of keys: each is there once, each has a member of its own.
#include "banyan/world/schema.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "banyan/world/decimal.hpp"
#include "plain_scenario.hpp"

namespace banyan::world {
namespace {

// With the algorithms that a scenario may name.
template <class Owner> Owner blank() {
  if constexpr (std::is_same_v<Owner, Scenario>) return plain_scenario();
  else return {};
}

// A value that a key may have, another for each k.
template <class Owner> Value sample(const Key<Owner>& key, std::size_t k) {
  const double low = std::isfinite(key.range.minimum) ? key.range.minimum : -100.0;
  const double high = std::isfinite(key.range.maximum) ? std::min(key.range.maximum, low + 1000.0) : 100.0;
  const double x = low + (high - low) * static_cast<double>(k + 1) / 100.0;
  switch (key.access.type) {
    case Type::truth: return k % 2 == 0;
    case Type::whole: return static_cast<std::int64_t>(low) + static_cast<std::int64_t>(k % 50) + 1;
    case Type::number: return x;
    case Type::name: return std::string(key.access.names(blank<Owner>())[k % key.access.names(blank<Owner>()).size()]);
    case Type::text: return key.terms.text_fault == nullptr ? "text " + std::to_string(k) : std::to_string(k + 3) + "#";
    case Type::point: return Vec2{x, -x};
    case Type::points: return std::vector<Vec2>{{x, 1.0}, {x, 2.0}};
    case Type::pairs: return NamePairs{{"a", "b"}};
    case Type::numbers: return std::vector<double>{x, 2.0};
  }
  return {};
}

// Where a value is written nobody else's is: all keys that apply together keep what they were given.
template <class Owner> void expect_own_members(std::span<const Key<Owner>> keys, Owner owner) {
  std::map<std::string_view, Value> given;
  std::set<std::string> selectors;
  for (const Key<Owner>& key : keys) selectors.insert(selector_of(key));
  for (std::size_t k = 0; k < keys.size(); ++k) {
    if (selectors.contains(std::string(keys[k].path)) || !keys[k].access.applies(owner)) continue;
    given[keys[k].path] = sample(keys[k], k);
    set(keys[k], owner, given[keys[k].path]);
  }
  for (const Key<Owner>& key : keys) {
    if (!given.contains(key.path)) continue;
    if (!key.is_angle()) {
      EXPECT_EQ(get(key, owner), given[key.path]) << key.path;
    } else if (key.access.type == Type::number) {
      EXPECT_NEAR(std::get<double>(get(key, owner)), std::get<double>(given[key.path]), 1e-9) << key.path;
    }
  }
}

// Every alternative of the selectors, those of different sections side by side.
template <class Owner> void expect_own_members_in_all_alternatives(std::span<const Key<Owner>> keys) {
  for (std::size_t alternative = 0; alternative < 12; ++alternative) {
    Owner owner{};
    for (const Key<Owner>& key : keys) {
      const Key<Owner>* selector = find_key(keys, selector_of(key));
      if (selector == nullptr) continue;
      const Names names = selector->access.names(blank<Owner>());
      set(*selector, owner, std::string(names[alternative % names.size()]));
    }
    expect_own_members(keys, owner);
  }
}

TEST(Schema, NoTwoKeysShareAMember) {
  expect_own_members_in_all_alternatives(scenario_keys());
  expect_own_members_in_all_alternatives(obstacle_keys());
  expect_own_members_in_all_alternatives(event_keys());
}

template <class Owner> void expect_in_order(std::span<const Key<Owner>> keys, std::set<std::string_view>& paths) {
  std::set<std::string_view> sections;
  for (const Section& section : scenario_sections()) sections.insert(section.path);
  for (const Key<Owner>& key : keys) {
    EXPECT_TRUE(paths.insert(key.path).second) << key.path;
    EXPECT_TRUE(sections.contains(key.section())) << key.path;
    EXPECT_FALSE(key.meaning.empty()) << key.path;
    const std::string selector = selector_of(key);
    EXPECT_TRUE(selector.empty() || find_key(keys, selector) != nullptr) << key.path;
    const std::string other = std::string(key.section()) + "." + std::string(key.terms.not_beside);
    EXPECT_TRUE(key.terms.not_beside.empty() || find_key(keys, other) != nullptr) << key.path;
    EXPECT_TRUE(!key.terms.required || key.terms.otherwise.empty()) << key.path;
  }
}

TEST(Schema, EveryKeyIsThereOnceAndWhatItNamesExists) {
  std::set<std::string_view> paths;
  expect_in_order(scenario_keys(), paths);
  expect_in_order(obstacle_keys(), paths);
  expect_in_order(event_keys(), paths);
}

TEST(Schema, TellsWithWhichAlternativesAKeyApplies) {
  const auto with = [](std::string_view path) { return applies_with(*find_key(event_keys(), path), event_keys()); };
  using Words = std::vector<std::string_view>;
  EXPECT_EQ(with("events.robot"), (Words{"die", "freeze", "join"}));
  EXPECT_EQ(with("events.position_m"), (Words{"move_target", "add_target", "move_obstacle", "add_obstacle", "join"}));
  EXPECT_EQ(with("events.time_s"), Words{});
  const auto keys = scenario_keys();
  const Words all_but_list{"hexagonal", "grid", "line", "ring", "cross", "bridge", "random"};
  EXPECT_EQ(applies_with(*find_key(keys, "swarm.start.pitch_m"), keys), all_but_list);
  EXPECT_EQ(applies_with(*find_key(keys, "swarm.redundancy"), keys), all_but_list);
  EXPECT_EQ(applies_with(*find_key(keys, "swarm.start.link_share"), keys), (Words{"bridge", "random"}));
  EXPECT_EQ(applies_with(*find_key(keys, "targets.count"), keys), (Words{"ring", "random"}));
}

TEST(Schema, OfTwoKeysThatExcludeEachOtherOneCounts) {
  Scenario scenario;
  const auto keys = scenario_keys();
  const auto& redundancy = *find_key(keys, "swarm.redundancy");
  EXPECT_EQ(effective(redundancy, keys, scenario), Value(2.0));
  scenario.swarm.robots = 12;
  EXPECT_EQ(effective(redundancy, keys, scenario).index(), 0U);
  EXPECT_EQ(effective(*find_key(keys, "swarm.robots"), keys, scenario), Value(std::int64_t{12}));
}

}  // namespace
}  // namespace banyan::world
