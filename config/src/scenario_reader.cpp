// SPDX-License-Identifier: MIT
#include "scenario_reader.hpp"

#include <algorithm>
#include <cmath>

#include "banyan/controller/core/algorithm.hpp"
#include "banyan/world/names.hpp"

namespace banyan::config {

using world::Key;
using world::Type;
using world::Value;
using world::Vec2;

namespace {

std::string join(std::string_view section, std::string_view name) {
  return section.empty() ? std::string(name) : std::string(section) + "." + std::string(name);
}
// "start.layout" for "swarm.start.layout" in "swarm".
std::string_view within(std::string_view section, std::string_view path) {
  return section.empty() ? path : path.substr(section.size() + 1);
}
std::string in_quotes(std::string_view name) { return "\"" + std::string(name) + "\""; }

bool is_selector(std::string_view path) {
  const auto all = sections();
  return std::any_of(all.begin(), all.end(),
                     [&](const world::Section& s) { return !s.selector.empty() && join(s.path, s.selector) == path; });
}

// The section or key of that name in `section`; null if there is none. A quoted name with a dot is no path.
const world::Section* section_in(std::string_view section, const std::string& name) {
  return name.find('.') == std::string::npos ? find_section(join(section, name)) : nullptr;
}
template <class Owner>
const Key<Owner>* key_in(std::string_view section, const std::string& name, std::span<const Key<Owner>> keys) {
  return name.find('.') == std::string::npos ? find_key(keys, join(section, name)) : nullptr;
}

const Node* find_path(const Node& root, std::string_view path) {
  const Node* at = &root;
  while (at && !path.empty()) {
    const auto dot = std::min(path.find('.'), path.size());
    at = at->find(path.substr(0, dot));
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  return at;
}

// Every name allowed in a file, as (section, name): candidates for a misspelt one.
std::vector<std::pair<std::string, std::string>> known_names(const AlgorithmList& algorithms) {
  std::vector<std::pair<std::string, std::string>> names;
  const auto add = [&](const auto& keys) {
    for (const auto& key : keys) names.emplace_back(key.section(), key.name());
  };
  add(world::scenario_keys());
  add(output_keys());
  add(world::obstacle_keys());
  add(world::event_keys());
  add(world::station_keys());
  for (const auto& section : sections()) {
    if (section.path.empty()) continue;
    const auto dot = section.path.rfind('.');
    const bool nested = dot != std::string_view::npos;
    names.emplace_back(nested ? section.path.substr(0, dot) : "", nested ? section.path.substr(dot + 1) : section.path);
  }
  for (const auto& info : algorithms.parameters()) names.emplace_back("mission.parameters", info.key);
  return names;
}

// Keys that stand at the top of another kind of file, and what that is.
struct Foreign {
  std::string_view key, means;
};
constexpr Foreign foreign_keys[] = {
    {"worlds", "a file for tuning, which banyan tune reads"}, {"bounds", "a file for tuning, which banyan tune reads"},
    {"scenario", "a study, which banyan study reads"},        {"axes", "a study, which banyan study reads"},
    {"parts", "a study, which banyan study reads"},
};

// Keys that were, and what is written in their place.
constexpr Foreign removed_keys[] = {
    {"mission.scale", "radio.range_m scales the lengths of every algorithm: set that, and leave this out"},
};

}  // namespace

// ---- What was written where ----

void ScenarioReader::report(const Place& place, const std::string& key, std::string text) {
  faulty_.insert(key);
  problems_.push_back({place, key, std::move(text)});
}

Place ScenarioReader::place_of(std::string key) const {
  while (true) {
    if (const auto found = places_.find(key); found != places_.end()) return found->second;
    const auto cut = key.find_last_of(".[");
    key.resize(cut == std::string::npos ? 0 : cut);
  }
}

Place ScenarioReader::place_of(const world::Fault& fault) const {
  std::vector<std::string> keys{fault.key};
  keys.insert(keys.end(), fault.with.begin(), fault.with.end());
  std::optional<Place> first;
  for (const std::string& key : keys) {
    const auto found = places_.find(key);
    if (found == places_.end()) continue;
    if (!found->second.from_file()) return found->second;
    if (!first) first = found->second;
  }
  return first ? *first : place_of(fault.key);
}

bool ScenarioReader::faulty(const std::string& key) const {
  const auto at = faulty_.lower_bound(key);
  return at != faulty_.end() && at->starts_with(key);
}

// ---- Sections and keys ----

Configuration ScenarioReader::read(const Node& root) {
  Configuration configuration;
  configuration.scenario = world::plain_scenario(algorithms_);
  places_.emplace("", root.place);
  if (is_another_file(root)) return configuration;
  const Part part{root, "", ""};
  Choices choices;
  each_part(configuration, [&](const auto& keys, auto& owner) { read_selectors(part, keys, owner, choices); });
  read_section(part, choices, configuration);
  if (root.find("targets")) return configuration;
  // Stations and visits are missions, too.
  if (root.find("stations") || root.find("visits")) configuration.scenario.targets = std::vector<Vec2>{};
  else report(root.place, "targets", "the section [targets] is missing: it says where to go");
  return configuration;
}

// Then nothing else need be said of it. A scenario has targets.
bool ScenarioReader::is_another_file(const Node& root) {
  if (root.find("targets")) return false;
  const auto found = std::find_if(std::begin(foreign_keys), std::end(foreign_keys),
                                  [&](const Foreign& foreign) { return root.find(foreign.key) != nullptr; });
  if (found == std::end(foreign_keys)) return false;
  const std::string key(found->key);
  report(root.find(key)->place, key, "no scenario has this key: this is " + std::string(found->means));
  return true;
}

void ScenarioReader::read_section(const Part& part, const Choices& choices, Configuration& configuration) {
  if (part.section == "output") read_keys(part, output_keys(), choices, configuration.output);
  else read_keys(part, world::scenario_keys(), choices, configuration.scenario);
  for (const auto& [name, child] : *part.node.table()) {
    const world::Section* inner = section_in(part.section, name);
    if (!inner) continue;
    const std::string path(inner->path);
    places_.emplace(path, child.place);
    if (inner->repeated) {
      world::each_list(configuration.scenario,
                       [&, &node = child](std::string_view list_path, const auto& keys, auto& list) {
                         if (list_path == path) read_list(node, list_path, keys, list);
                       });
    } else if (!child.table()) {
      report(child.place, path, "is a section, [" + path + "], not " + child.describe());
    } else if (path == "mission.parameters") {
      read_parameters(child, configuration.scenario.mission);
    } else {
      read_section({child, path, inner->path}, choices, configuration);
    }
  }
}

template <class Owner>
void ScenarioReader::read_list(const Node& node, std::string_view path, std::span<const Key<Owner>> keys,
                               std::vector<Owner>& list) {
  const std::string shown(path);
  if (!node.array()) {
    report(node.place, shown, "is a list of tables, [[" + shown + "]] once for each, not " + node.describe());
    return;
  }
  for (std::size_t i = 0; i < node.array()->size(); ++i) {
    const Node& item = (*node.array())[i];
    const Part part{item, shown + "[" + std::to_string(i) + "]", path};
    places_.emplace(part.shown, item.place);
    Owner& owner = list.emplace_back();
    if (!item.table()) {
      report(item.place, part.shown, "must be a table, not " + item.describe());
      continue;
    }
    Choices choices;
    read_selectors(part, keys, owner, choices);
    read_keys(part, keys, choices, owner);
  }
}

// Before all other keys, since these depend on them.
template <class Owner>
void ScenarioReader::read_selectors(const Part& part, std::span<const Key<Owner>> keys, Owner& owner,
                                    Choices& choices) {
  for (const auto& key : keys) {
    if (!is_selector(key.path)) continue;
    const auto name = within(part.section, key.path);
    Choice choice;
    if (const Node* given = find_path(part.node, name)) {
      const Value value = read_value(*given, join(part.shown, name), key, owner);
      choice.known = value.index() != 0;
      choice.overridden = !given->place.from_file();
      if (choice.known) set(key, owner, value);
    } else {
      choice.known = !key.terms.required;
    }
    choice.name = std::get<std::string>(get(key, owner));
    choices.emplace(key.path, std::move(choice));
  }
}

template <class Owner>
void ScenarioReader::read_keys(const Part& part, std::span<const Key<Owner>> keys, const Choices& choices,
                               Owner& owner) {
  for (const auto& member : *part.node.table()) {
    if (!section_in(part.section, member.name)) read_key(part, member, keys, choices, owner);
  }
  require(part, keys, choices, owner);
}

template <class Owner>
void ScenarioReader::read_key(const Part& part, const Node::Member& member, std::span<const Key<Owner>> keys,
                              const Choices& choices, Owner& owner) {
  const auto& [name, node] = member;
  const auto* key = key_in(part.section, name, keys);
  if (!key) return report_unknown(node.place, part, name);
  if (is_selector(key->path)) return;  // read already
  const std::string selector = selector_of(*key);
  const bool applies = key->access.applies(owner);
  if (!applies && choices.find(selector)->second.known) {
    const Choice& choice = choices.find(selector)->second;
    // `--set targets.layout=ring` over a file with a list means: without the list.
    if (choice.overridden && node.place.from_file()) return;
    report(node.place, join(part.shown, name),
           "has no meaning with " + std::string(within(part.section, selector)) + " = " + in_quotes(choice.name) +
               ", only with " + world::alternatives(applies_with(*key, keys)));
    return;
  }
  const bool counts = applies && !excluded(part, node, *key, keys);
  const Value value = read_value(node, join(part.shown, name), *key, owner);
  if (value.index() != 0 && counts) set(*key, owner, value);
}

// Of two keys that exclude each other, an option overrides the file; otherwise having both is a problem.
template <class Owner>
bool ScenarioReader::excluded(const Part& part, const Node& node, const Key<Owner>& key,
                              std::span<const Key<Owner>> keys) {
  for (const auto& other : keys) {
    if (other.section() != key.section()) continue;
    const bool names_it = key.terms.not_beside == other.name();
    if (!names_it && other.terms.not_beside != key.name()) continue;
    const Node* rival = part.node.find(other.name());
    if (!rival) continue;
    const bool same_source = rival->place.from_file() == node.place.from_file();
    if (same_source && names_it) {
      const bool first = &key < &other;
      report(node.place, join(part.shown, key.name()),
             "give " + std::string(first ? key.name() : other.name()) + " or " +
                 std::string(first ? other.name() : key.name()) + ", not both");
      return true;
    }
    return !same_source && node.place.from_file();
  }
  return false;
}

template <class Owner>
void ScenarioReader::require(const Part& part, std::span<const Key<Owner>> keys, const Choices& choices,
                             const Owner& owner) {
  for (const auto& key : keys) {
    if (!key.terms.required || key.section() != part.section || part.node.find(key.name())) continue;
    std::string text = "is missing";
    if (const auto choice = choices.find(selector_of(key)); choice != choices.end() && !is_selector(key.path)) {
      if (!choice->second.known || !key.access.applies(owner)) continue;
      if (!applies_with(key, keys).empty())
        text += "; " + std::string(within(part.section, choice->first)) + " = " + in_quotes(choice->second.name) +
                " needs it";
    }
    report(part.node.place, join(part.shown, key.name()), std::move(text));
  }
}

void ScenarioReader::report_unknown(const Place& place, const Part& part, const std::string& name) {
  for (const Foreign& removed : removed_keys)
    if (removed.key == join(part.shown, name))
      return report(place, std::string(removed.key), "there is no such key any more: " + std::string(removed.means));
  const auto known = known_names(algorithms_);
  std::vector<std::string_view> here, elsewhere;
  std::vector<std::string> elsewhere_paths;
  for (const auto& [section, key] : known) {
    if (section == part.section) {
      here.push_back(key);
    } else {
      elsewhere.push_back(key);
      elsewhere_paths.push_back(join(section, key));
    }
  }
  const auto path_of = [&](std::string_view word) {
    return elsewhere_paths[static_cast<std::size_t>(std::find(elsewhere.begin(), elsewhere.end(), word) -
                                                    elsewhere.begin())];
  };
  // The same name in another section is a better guess than a similar one in this section.
  std::string meant;
  if (std::find(elsewhere.begin(), elsewhere.end(), name) != elsewhere.end()) meant = path_of(name);
  else if (const auto near = nearest(name, here); !near.empty()) meant = join(part.shown, near);
  else if (const auto far = nearest(name, elsewhere); !far.empty()) meant = path_of(far);
  std::string text = "there is no such key";
  if (!meant.empty()) text += "; did you mean " + meant + "?";
  std::string list;
  for (const auto key : here) list += (list.empty() ? "" : ", ") + std::string(key);
  const bool repeated = find_section(part.section)->repeated;
  const std::string section(part.section);
  const std::string header = repeated ? "[[" + section + "]]" : "[" + section + "]";
  text += section.empty() ? " (at the top: " : " (" + header + " has ";
  report(place, join(part.shown, name), text + list + ")");
}

void ScenarioReader::read_parameters(const Node& node, world::Mission& mission) {
  const Part part{node, "mission.parameters", "mission.parameters"};
  const auto table = algorithms_.parameters();
  for (const auto& [name, child] : *node.table()) {
    const std::string shown = join(part.shown, name);
    places_.emplace(shown, child.place);
    const auto info = std::find_if(table.begin(), table.end(), [&key = name](const auto& p) { return p.key == key; });
    if (info == table.end()) {
      report_unknown(child.place, part, name);
      continue;
    }
    const Value value = read_number(child, shown, {widened(info->minimum), widened(info->maximum)}, info->unit);
    if (const double* number = std::get_if<double>(&value)) mission.parameters.emplace_back(name, *number);
  }
  // In the controller's order, so that equal configurations have equal texts.
  const auto rank = [&](const auto& p) {
    return std::find_if(table.begin(), table.end(), [&](const auto& info) { return info.key == p.first; });
  };
  std::sort(mission.parameters.begin(), mission.parameters.end(),
            [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
}

// ---- Values ----

template <class Owner>
Value ScenarioReader::read_value(const Node& node, const std::string& path, const Key<Owner>& key, const Owner& owner) {
  places_.emplace(path, node.place);
  switch (key.access.type) {
    case Type::truth:
      if (const auto* truth = std::get_if<bool>(&node.value)) return *truth;
      report(node.place, path, "must be true or false, not " + node.describe());
      return {};
    case Type::whole: return read_whole(node, path, key.range, key.unit);
    case Type::number: return read_number(node, path, key.range, key.unit);
    case Type::name: return read_name(node, path, key.access.names(owner));
    case Type::point: return read_point(node, path, key.range, key.unit);
    case Type::points: return read_points(node, path, key.range, key.unit);
    case Type::numbers: return read_numbers(node, path, key.range, key.unit);
    case Type::pairs: return read_pairs(node, path);
    case Type::text: break;
  }
  const auto* text = node.string();
  if (!text) report(node.place, path, "must be text in quotes, not " + node.describe());
  else if (key.path == "name" && !good_name(*text))
    report(node.place, path, "is " + in_quotes(*text) + "; allowed: " + std::string(name_rule));
  else if (const auto fault = key.terms.text_fault == nullptr ? std::nullopt : key.terms.text_fault(*text))
    report(node.place, path, *fault);
  else return *text;
  return {};
}

Value ScenarioReader::read_number(const Node& node, const std::string& path, const Range& range,
                                  std::string_view unit) {
  double number = 0.0;
  if (const auto* real = std::get_if<double>(&node.value)) number = *real;
  else if (const auto* whole = std::get_if<std::int64_t>(&node.value)) number = static_cast<double>(*whole);
  else {
    report(node.place, path, "must be a number (" + range_text(range, unit) + "), not " + node.describe());
    return {};
  }
  if (const auto fault = world::range_fault(number, range, unit)) {
    report(node.place, path, *fault);
    return {};
  }
  return number;
}

Value ScenarioReader::read_whole(const Node& node, const std::string& path, const Range& range, std::string_view unit) {
  const auto* whole = std::get_if<std::int64_t>(&node.value);
  const auto* real = std::get_if<double>(&node.value);
  if (!whole && !(real && std::abs(*real) >= 0x1p63)) {
    report(node.place, path, "must be a whole number (" + range_text(range, unit) + "), not " + node.describe());
    return {};
  }
  const auto fault = whole ? world::whole_range_fault(*whole, range, unit) : world::range_fault(*real, range, unit);
  if (fault) {
    report(node.place, path, *fault);
    return {};
  }
  return *whole;
}

Value ScenarioReader::read_name(const Node& node, const std::string& path, world::Names names) {
  const auto* text = node.string();
  if (!text) report(node.place, path, "must be " + world::alternatives(names) + ", not " + node.describe());
  else if (const auto fault = world::name_fault(*text, names)) report(node.place, path, *fault);
  else return *text;
  return {};
}

Value ScenarioReader::read_point(const Node& node, const std::string& path, const Range& range, std::string_view unit) {
  if (!node.array() || node.array()->size() != 2) {
    report(node.place, path, "must be two numbers [x, y] in " + std::string(unit) + ", not " + node.describe());
    return {};
  }
  const Value x = read_number((*node.array())[0], path + "[0]", range, unit);
  const Value y = read_number((*node.array())[1], path + "[1]", range, unit);
  if (x.index() == 0 || y.index() == 0) return {};
  return Vec2{std::get<double>(x), std::get<double>(y)};
}

// In lists zero stands in for wrong values, so that the rest can be checked.
Value ScenarioReader::read_points(const Node& node, const std::string& path, const Range& range,
                                  std::string_view unit) {
  if (!node.array()) {
    report(node.place, path,
           "must be a list of points [[x, y], ...] in " + std::string(unit) + ", not " + node.describe());
    return {};
  }
  std::vector<Vec2> list(node.array()->size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string shown = path + "[" + std::to_string(i) + "]";
    places_.emplace(shown, (*node.array())[i].place);
    const Value point = read_point((*node.array())[i], shown, range, unit);
    if (point.index() != 0) list[i] = std::get<Vec2>(point);
  }
  return list;
}

Value ScenarioReader::read_numbers(const Node& node, const std::string& path, const Range& range,
                                   std::string_view unit) {
  if (!node.array()) {
    report(node.place, path, "must be a list of numbers in " + std::string(unit) + ", not " + node.describe());
    return {};
  }
  std::vector<double> list(node.array()->size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Value number = read_number((*node.array())[i], path + "[" + std::to_string(i) + "]", range, unit);
    if (number.index() != 0) list[i] = std::get<double>(number);
  }
  return list;
}

Value ScenarioReader::read_pairs(const Node& node, const std::string& path) {
  const auto fault = [&](const Node& at, const std::string& shown) {
    report(at.place, shown, "must be a list of pairs of names [[\"a\", \"b\"], ...], not " + at.describe());
  };
  if (!node.array()) return fault(node, path), Value();
  world::NamePairs pairs;
  for (std::size_t i = 0; i < node.array()->size(); ++i) {
    const Node& item = (*node.array())[i];
    const std::string shown = path + "[" + std::to_string(i) + "]";
    places_.emplace(shown, item.place);
    const auto* two = item.array();
    if (two == nullptr || two->size() != 2 || !(*two)[0].string() || !(*two)[1].string()) fault(item, shown);
    else pairs.emplace_back(*(*two)[0].string(), *(*two)[1].string());
  }
  return pairs;
}

}  // namespace banyan::config
