// SPDX-License-Identifier: MIT
#include "banyan/hosts/argos/settings.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "banyan/world/decimal.hpp"
#include "banyan/world/names.hpp"
#include "banyan/world/schema.hpp"

namespace banyan::argos {
namespace {

// Attributes that are keys of scenarios, without their section.
constexpr std::string_view scenario_paths[] = {
    "mission.algorithm",       "mission.reading",        "mission.target_tolerance_m",
    "mission.link_redundancy", "radio.range_m",          "radio.line_of_sight",
    "robot.wheel_limit_m_s",   "robot.wheel_distance_m", "robot.radius_m"};
constexpr std::string_view own_names[] = {"role", "target_m", "light_intensity_m"};
constexpr std::string_view parts[] = {"spare", "worker", "root"};

const world::Key<world::Scenario>& key_at(std::string_view path) {
  return *world::find_key(world::scenario_keys(), path);
}

std::optional<double> number_of(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0') return std::nullopt;
  return value;
}

class AttributeReader {
 public:
  AttributeReader(const AlgorithmList& list, double tick_s) : scenario_(world::plain_scenario(list)) {
    scenario_.tick_s = tick_s;
  }

  Settings read(std::span<const Attribute> attributes) {
    choose_algorithm(attributes);
    for (const Attribute& attribute : attributes) read(attribute);
    if (faults_.empty()) finish();
    if (!faults_.empty()) throw SettingsError("<params>: " + faults_);
    return settings_;
  }

 private:
  void fail(std::string_view name, const std::string& text) {
    faults_ += (faults_.empty() ? "" : "; ") + std::string(name) + " " + text;
  }

  // First, since it says which parameters there are.
  void choose_algorithm(std::span<const Attribute> attributes) {
    for (const Attribute& attribute : attributes)
      if (attribute.name == "algorithm") scenario_.mission.algorithm = attribute.value;
    settings_.algorithm = scenario_.algorithms->find(scenario_.mission.algorithm);
    if (settings_.algorithm != nullptr) {
      parameters_ = settings_.algorithm->parameters();
      return;
    }
    fail("algorithm", *world::name_fault(scenario_.mission.algorithm, scenario_.algorithms->names()));
  }

  void read(const Attribute& attribute) {
    if (std::find(std::begin(own_names), std::end(own_names), attribute.name) != std::end(own_names))
      return read_own(attribute);
    for (const std::string_view path : scenario_paths)
      if (key_at(path).name() == attribute.name) return read_key(path, attribute);
    for (const ParameterInfo* info : parameters_)
      if (info->key == attribute.name) return read_parameter(*info, attribute);
    unknown(attribute.name);
  }

  void unknown(const std::string& name) {
    std::vector<std::string_view> known(std::begin(own_names), std::end(own_names));
    for (const std::string_view path : scenario_paths) known.push_back(key_at(path).name());
    for (const ParameterInfo* info : parameters_) known.push_back(info->key);
    const std::string_view near = world::nearest_name(name, known);
    fail(name, "is unknown to the algorithm " + scenario_.mission.algorithm +
                   (near.empty() ? "" : "; did you mean " + std::string(near) + "?"));
  }

  void read_own(const Attribute& attribute) {
    if (attribute.name == "role") {
      if (const auto fault = world::name_fault(attribute.value, parts)) return fail("role", *fault);
      settings_.part =
          static_cast<StartRole>(std::find(std::begin(parts), std::end(parts), attribute.value) - std::begin(parts));
    } else if (attribute.name == "target_m") {
      const std::size_t comma = std::min(attribute.value.find(','), attribute.value.size());
      const auto x = number_of(attribute.value.substr(0, comma));
      const auto y = comma < attribute.value.size() ? number_of(attribute.value.substr(comma + 1)) : std::nullopt;
      if (!x || !y) return fail("target_m", "must be X,Y in m, not " + world::the_text(attribute.value));
      settings_.target = {*x, *y};
    } else if (const auto value = number(attribute, {0.0, 1000.0, true}, "m")) {
      settings_.light_intensity_m = *value;
    }
  }

  std::optional<double> number(const Attribute& attribute, const world::Range& range, std::string_view unit) {
    const auto value = number_of(attribute.value);
    if (!value) {
      fail(attribute.name, "must be a number, not " + world::the_text(attribute.value));
      return std::nullopt;
    }
    if (const auto fault = world::range_fault(*value, range, unit)) {
      fail(attribute.name, *fault);
      return std::nullopt;
    }
    return value;
  }

  void read_key(std::string_view path, const Attribute& attribute) {
    const auto& key = key_at(path);
    settings_.assignments.push_back(std::string(path) + "=" + attribute.value);
    if (path == "mission.algorithm") return;
    if (path == "robot.wheel_distance_m") settings_.knows_wheels = true;
    if (key.access.type == world::Type::number) {
      if (const auto value = number(attribute, key.range, key.unit)) world::set(key, scenario_, *value);
    } else if (key.access.type == world::Type::whole) {
      const auto value = number(attribute, key.range, key.unit);
      if (value && *value != std::floor(*value))
        return fail(attribute.name, "must be a whole number, not " + world::the_text(attribute.value));
      if (value) world::set(key, scenario_, static_cast<std::int64_t>(*value));
    } else if (key.access.type == world::Type::truth) {
      if (attribute.value != "true" && attribute.value != "false")
        return fail(attribute.name, "must be true or false, not " + world::the_text(attribute.value));
      world::set(key, scenario_, attribute.value == "true");
    } else {
      if (const auto fault = world::name_fault(attribute.value, key.access.names(scenario_));
          fault && !key.access.names(scenario_).empty())
        return fail(attribute.name, *fault);
      world::set(key, scenario_, attribute.value);
    }
  }

  void read_parameter(const ParameterInfo& info, const Attribute& attribute) {
    const world::Range range{world::widened(info.minimum), world::widened(info.maximum)};
    if (const auto value = number(attribute, range, info.unit))
      scenario_.mission.parameters.emplace_back(attribute.name, *value);
    settings_.assignments.push_back("mission.parameters." + attribute.name + "=" + attribute.value);
  }

  // Values that depend on each other.
  void finish() {
    settings_.setup = world::setup_of(scenario_);
    settings_.setup.history = 1;
    if (const std::string text = settings_.algorithm->fault(settings_.setup); !text.empty())
      fail("", "together: " + text);
    if (settings_.setup.link_redundancy > 1 && !settings_.algorithm->knows_redundancy())
      fail("link_redundancy", "is above 1, but " + scenario_.mission.algorithm + " keeps one path");
  }

  world::Scenario scenario_;
  Settings settings_;
  std::vector<const ParameterInfo*> parameters_;
  std::string faults_;
};

std::string text_of(const world::Value& value) {
  if (const auto* truth = std::get_if<bool>(&value)) return *truth ? "true" : "false";
  if (const auto* number = std::get_if<double>(&value)) return world::number_text(*number);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
  return std::get<std::string>(value);
}

}  // namespace

Settings read_settings(std::span<const Attribute> attributes, const AlgorithmList& list, double tick_s) {
  return AttributeReader(list, tick_s).read(attributes);
}

// ARGoS' controller does not know the robot's radius: what follows from it is written out.
std::vector<Attribute> attributes_of(const world::Scenario& scenario) {
  world::Scenario told = scenario;
  told.mission.target_tolerance_m = world::target_tolerance_m(scenario);
  told.robot.wheel_distance_m = world::wheel_distance_m(scenario);
  std::vector<Attribute> attributes;
  for (const std::string_view path : scenario_paths)
    attributes.push_back({std::string(key_at(path).name()), text_of(world::get(key_at(path), told))});
  const auto own = world::algorithm_of(scenario).parameters();
  for (const auto& [key, value] : scenario.mission.parameters)
    if (std::any_of(own.begin(), own.end(), [&, &key = key](const ParameterInfo* info) { return info->key == key; }))
      attributes.push_back({key, world::number_text(value)});
  return attributes;
}

}  // namespace banyan::argos
