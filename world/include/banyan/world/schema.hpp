// SPDX-License-Identifier: MIT
// Every key of a scenario, once: where its value is kept, what it may be, what it means. Reading,
// messages, `--set`, completion, the dump into outputs and docs/scenario-keys.md (all in config/) and
// the checks of single values (faults.hpp) follow from these tables. Keys of [mission.parameters] come
// from the tables of the algorithms.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/world/key.hpp"
#include "banyan/world/scenario.hpp"

namespace banyan::world {

struct Section {
  std::string_view path;  // "swarm.start"
  std::string_view meaning;
  std::string_view selector = "";  // name of the key that decides which of the others apply
  bool repeated = false;           // a list of tables, one for each
  bool left_out = false;           // where it is empty: stored runs are known by what was written without it
};

[[nodiscard]] std::span<const Section> scenario_sections() noexcept;  // in the order of a file
[[nodiscard]] std::span<const Key<Scenario>> scenario_keys() noexcept;
[[nodiscard]] std::span<const Key<Obstacle>> obstacle_keys() noexcept;  // "obstacles.kind", ...
[[nodiscard]] std::span<const Key<Event>> event_keys() noexcept;        // "events.kind", ...
[[nodiscard]] std::span<const Key<Station>> station_keys() noexcept;    // "stations.name", ...

// visit("obstacles", obstacle_keys(), scenario.obstacles), and the same for stations and events.
template <class AnyScenario, class Visit> void each_list(AnyScenario& scenario, const Visit& visit) {
  visit(std::string_view("obstacles"), obstacle_keys(), scenario.obstacles);
  visit(std::string_view("stations"), station_keys(), scenario.stations);
  visit(std::string_view("events"), event_keys(), scenario.events);
}

// The path of the key that decides whether `key` applies; "" if it always does.
template <class Owner> [[nodiscard]] std::string selector_of(const Key<Owner>& key) {
  if (!key.terms.selector.empty()) return std::string(key.terms.selector);
  for (const Section& section : scenario_sections())
    if (section.path == key.section() && !section.selector.empty())
      return std::string(section.path) + "." + std::string(section.selector);
  return {};
}

// The names of the selector with which `key` applies; none if it always does.
template <class Owner>
[[nodiscard]] std::vector<std::string_view> applies_with(const Key<Owner>& key, std::span<const Key<Owner>> keys) {
  const Key<Owner>* selector = find_key(keys, selector_of(key));
  std::vector<std::string_view> names;
  if (selector == nullptr) return names;
  const Names all = selector->access.names(Owner{});
  for (const std::string_view name : all) {
    Owner owner{};
    set(*selector, owner, std::string(name));
    if (key.access.applies(owner)) names.push_back(name);
  }
  if (names.size() == all.size()) names.clear();
  return names;
}

// The value that counts: none where the key it excludes is given.
template <class Owner>
[[nodiscard]] Value effective(const Key<Owner>& key, std::span<const Key<Owner>> keys, const Owner& owner) {
  if (!key.terms.not_beside.empty()) {
    const Key<Owner>* other = find_key(keys, std::string(key.section()) + "." + std::string(key.terms.not_beside));
    if (get(*other, owner).index() != 0) return {};
  }
  return get(key, owner);
}

}  // namespace banyan::world
