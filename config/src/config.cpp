// SPDX-License-Identifier: MIT
// From a file to a Configuration, step by step: the tree, what changes it, its keys, what does not fit
// together.
#include "banyan/config/config.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "banyan/world/faults.hpp"
#include "maps.hpp"
#include "scenario_reader.hpp"

namespace banyan::config {
namespace {

// faults() of what could be read. Parts that could not be read must not cause further complaints:
// obstacles and events are made harmless, and when the parameters contradict each other the rest
// is looked at without them.
std::vector<world::Fault> semantic_faults(world::Scenario scenario, const ScenarioReader& reader) {
  for (std::size_t i = 0; i < scenario.obstacles.size(); ++i) {
    if (reader.faulty("obstacles[" + std::to_string(i) + "]")) scenario.obstacles[i] = world::Disc{{-9e3, -9e3}, 1e-3};
  }
  for (std::size_t i = 0; i < scenario.events.size(); ++i) {
    if (reader.faulty("events[" + std::to_string(i) + "]"))
      scenario.events[i] = world::Event{.action = world::SetLoss{}};
  }
  auto list = world::faults(scenario);
  const auto about_parameters = [](const world::Fault& f) {
    return !f.warning && f.key.starts_with("mission.parameters");
  };
  if (std::any_of(list.begin(), list.end(), about_parameters)) {
    scenario.mission.parameters.clear();
    std::set<std::pair<std::string, std::string>> known;
    for (const auto& fault : list) known.emplace(fault.key, fault.text);
    for (auto& more : world::faults(scenario))
      if (known.emplace(more.key, more.text).second) list.push_back(std::move(more));
  }
  return list;
}

void add_semantic_problems(const Configuration& configuration, const ScenarioReader& reader,
                           std::vector<Problem>& problems) {
  const bool broken = !problems.empty();
  for (const auto& fault : semantic_faults(configuration.scenario, reader)) {
    // Defaults stand in for what could not be read, so warnings would be meaningless.
    if (reader.faulty(fault.key) || (broken && fault.warning)) continue;
    problems.push_back({reader.place_of(fault), fault.key, fault.text, fault.warning});
  }
}

}  // namespace

std::size_t Loaded::errors() const noexcept {
  return static_cast<std::size_t>(
      std::count_if(problems.begin(), problems.end(), [](const Problem& p) { return !p.warning; }));
}

Loaded configure(Node root, const std::string& path, const AlgorithmList& algorithms, std::vector<Problem> problems) {
  Loaded loaded{{}, std::move(problems)};
  root.place.line = 0;
  put_maps(root, loaded.problems);
  ScenarioReader reader(loaded.problems, algorithms);
  loaded.configuration = reader.read(root);
  if (loaded.configuration.scenario.name.empty()) loaded.configuration.scenario.name = name_from(path, "scenario");
  add_semantic_problems(loaded.configuration, reader, loaded.problems);
  std::stable_sort(loaded.problems.begin(), loaded.problems.end(), [](const Problem& a, const Problem& b) {
    return a.place.from_file() != b.place.from_file() ? a.place.from_file() : a.place.line < b.place.line;
  });
  return loaded;
}

Node parse_scenario(const std::string& path, std::string_view text) {
  Node root = parse_document(path, text);
  const Node* format = root.find("format");
  if (format && format->string() && format->string()->starts_with("banyan.")) {
    const Node* version = root.find("format_version");
    const auto* number = version ? std::get_if<std::int64_t>(&version->value) : nullptr;
    if (!number || *number != 1)
      throw DocumentError(
          {format->place, "format_version", "must be 1: run it with the version of banyan that wrote it"});
    if (const Node* config = root.find("config"); config && config->table()) return *config;
  }
  return root;
}

Loaded parse_configuration(const std::string& path, std::string_view text, const AlgorithmList& algorithms,
                           const std::vector<Override>& overrides) {
  try {
    Node root = parse_scenario(path, text);
    std::vector<Problem> problems;
    for (const auto& change : overrides)
      for (auto& problem : apply(root, change)) problems.push_back(std::move(problem));
    return configure(std::move(root), path, algorithms, std::move(problems));
  } catch (const DocumentError& e) { return {{}, {e.problem}}; }
}

Loaded load_configuration(const std::string& path, const AlgorithmList& algorithms,
                          const std::vector<Override>& overrides) {
  try {
    return parse_configuration(path, read_text_file(path), algorithms, overrides);
  } catch (const DocumentError& e) { return {{}, {e.problem}}; }
}

Loaded with_event(const Configuration& current, double now_s, Node event) {
  const Place place = event.place;
  event.table()->push_back({"time_s", Node{now_s, place}});
  Node root = parse_document("intervention", config_json(current));
  if (root.find("events") == nullptr) root.table()->push_back({"events", Node{Node::Array{}, place}});
  root.find("events")->array()->push_back(std::move(event));
  return configure(std::move(root), current.scenario.name, *current.scenario.algorithms);
}

}  // namespace banyan::config
