// SPDX-License-Identifier: MIT
// From a scenario file and options to a Configuration, and back. Strict: whatever is unknown, of
// the wrong type or out of range is a problem with its place, and all problems come at once.
#pragma once

#include <string>
#include <vector>

#include "banyan/config/document.hpp"
#include "banyan/config/keys.hpp"
#include "banyan/config/override.hpp"

namespace banyan::config {

struct Loaded {
  Configuration configuration;    // complete only if ok()
  std::vector<Problem> problems;  // in the order of the file, then of the options
  [[nodiscard]] std::size_t errors() const noexcept;
  [[nodiscard]] bool ok() const noexcept { return errors() == 0; }
};

// Reads `path` (TOML, JSON, or the run.json of an earlier run; "-" is standard input), applies the
// overrides, then checks keys, types and ranges and what world::faults() finds. Never throws for
// bad input. Without a key `name` the scenario is named after its file. `algorithms` is what mission.algorithm
// chooses from; it must outlive the scenario.
[[nodiscard]] Loaded load_configuration(const std::string& path, const AlgorithmList& algorithms,
                                        const std::vector<Override>& overrides = {});
// The same for text that is already in memory.
[[nodiscard]] Loaded parse_configuration(const std::string& path, std::string_view text,
                                         const AlgorithmList& algorithms, const std::vector<Override>& overrides = {});

// The steps in between, for who changes the tree himself: the tree of a scenario file (of the
// configuration in a run.json); throws DocumentError. And from a tree to a Configuration, with
// `problems` found before; `path` names the scenario if it has no name.
[[nodiscard]] Node parse_scenario(const std::string& path, std::string_view text);
[[nodiscard]] Loaded configure(Node root, const std::string& path, const AlgorithmList& algorithms,
                               std::vector<Problem> problems = {});

// The configuration with one more event, a table without time_s, that happens at `now_s`: for who intervenes in a
// running world.
[[nodiscard]] Loaded with_event(const Configuration& current, double now_s, Node event);

// The complete effective configuration. Read back, it gives the same scenario, bit for bit.
[[nodiscard]] std::string config_json(const Configuration& configuration, int indent = -1);
[[nodiscard]] std::string config_toml(const Configuration& configuration);

}  // namespace banyan::config
