// SPDX-License-Identifier: MIT
// The keys of a configuration: those of a scenario (world/schema.hpp) and those of [output], which say
// what is kept of a run and follow from record/'s table of formats; and their reference, for completion and documents.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/record/output_formats.hpp"
#include "banyan/world/schema.hpp"

namespace banyan::config {

using world::Range;
using world::range_text;

// What a file and the command line together stand for.
struct Configuration {
  world::Scenario scenario;
  record::OutputSettings output;
};

[[nodiscard]] std::span<const world::Key<record::OutputSettings>> output_keys() noexcept;

// In the order of a file, those that are lists of tables included.
[[nodiscard]] std::span<const world::Section> sections() noexcept;
// Null if there is none.
[[nodiscard]] const world::Section* find_section(std::string_view path) noexcept;

// visit(keys, owner) for all keys that stand once in a file: those of the scenario, then of [output].
template <class AnyConfiguration, class Visit> void each_part(AnyConfiguration& configuration, const Visit& visit) {
  visit(world::scenario_keys(), configuration.scenario);
  visit(output_keys(), configuration.output);
}

// One row of the reference of keys.
struct KeyRow {
  std::string path, type, allowed, fallback, meaning;
  std::string selector, when;  // the key that decides whether it applies, and its names with which it does
  std::vector<std::string> choices;
};
// All that a file may have, in its order: "events.loss" stands for events[0].loss, events[1].loss, ...
[[nodiscard]] std::vector<KeyRow> key_rows(const AlgorithmList& algorithms);
[[nodiscard]] std::string key_reference_markdown(const AlgorithmList& algorithms);

}  // namespace banyan::config
