// SPDX-License-Identifier: MIT
#include "banyan/config/config.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "banyan/controller/core/algorithm.hpp"
#include "banyan/controller/core/trig.hpp"

namespace banyan::config {
namespace {

using world::Vec2;

constexpr double radians_per_degree = pi<double> / 180.0;

bool is_angle(std::string_view unit) noexcept { return unit == "deg"; }

std::string join(const std::string& section, std::string_view name) {
  return section.empty() ? std::string(name) : section + "." + std::string(name);
}

std::string in_quotes(std::string_view name) { return "\"" + std::string(name) + "\""; }

// "a, b or c", each quoted.
std::string alternatives(std::span<const std::string_view> names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += in_quotes(names[i]);
  }
  return text;
}

std::string alternatives(std::string_view when) {
  std::vector<std::string_view> names;
  while (!when.empty()) {
    const auto end = std::min(when.find(' '), when.size());
    names.push_back(when.substr(0, end));
    when.remove_prefix(std::min(end + 1, when.size()));
  }
  return alternatives(names);
}

// ------------------------------------------------------------------------------------- reading --

class Reader {
 public:
  explicit Reader(std::vector<Problem>& problems) : problems_(problems) {}

  Form read(const Node& root) {
    read_section(root, "", form_);
    if (!root.find("targets")) report(root.place, "targets", "the section [targets] is missing: it says where to go");
    settle_robot_number(root);
    return std::move(form_);
  }

  // The place of a key, or of the nearest section around it. Units do not matter: "targets.positions[3]".
  [[nodiscard]] Place place_of(std::string key, std::string& known_as) const {
    while (true) {
      if (const auto found = places_.find(bare(key)); found != places_.end()) {
        known_as = found->second.first;
        return found->second.second;
      }
      const auto cut = key.find_last_of(".[");
      if (cut == std::string::npos) return places_.at("").second;
      key.resize(cut);
    }
  }
  // Whether a problem was already reported about the key or a part of it.
  [[nodiscard]] bool faulty(const std::string& key) const {
    const auto prefix = bare(key);
    const auto at = faulty_.lower_bound(prefix);
    return at != faulty_.end() && at->starts_with(prefix);
  }

 private:
  void report(const Place& place, const std::string& key, std::string text) {
    faulty_.insert(bare(key));
    problems_.push_back({place, key, std::move(text)});
  }

  // Keys without units, so that "targets.phase_rad" finds "targets.phase_deg".
  static std::string bare(const std::string& key) {
    const auto dot = key.find_last_of('.');
    const auto bracket = key.find('[', dot == std::string::npos ? 0 : dot);
    const std::string index = bracket == std::string::npos ? "" : key.substr(bracket);
    std::string name = key.substr(0, bracket);
    for (const std::string_view unit : {"_m", "_s", "_deg", "_rad"}) {
      if (name.ends_with(unit) && !name.ends_with("_m_s")) {
        name.resize(name.size() - unit.size());
        break;
      }
    }
    return name + index;
  }

  void remember(const std::string& key, const Place& place) { places_.emplace(bare(key), std::pair{key, place}); }

  static const Section* find_section(std::string_view path) {
    for (const auto& section : sections()) {
      if (section.path == path) return &section;
    }
    return nullptr;
  }

  // Reads the table `node` of section `section`, written as `path` ("events[2]"), into `owner`.
  template <class Owner>
  void read_keys(const Node& node, const std::string& path, std::string_view section, std::span<const Key<Owner>> keys,
                 Owner& owner) {
    remember(path, node.place);
    const auto choice = read_selector(node, path, section, keys, owner);
    for (const auto& [name, child] : *node.table()) {
      if (find_section(join(path, name))) continue;
      read_key(child, path, name, section, keys, choice, owner);
    }
    for (const auto& key : keys) {
      if (!key.required || key.section != section || node.find(key.name)) continue;
      const bool is_selector = key.name == find_section(section)->selector;
      if (!is_selector && (!choice.known || !(key.when.empty() || applies(key.when, choice.name)))) continue;
      report(node.place, join(path, key.name),
             "is missing" +
                 (key.when.empty() ? std::string() : "; " + choice.key + " = " + in_quotes(choice.name) + " needs it"));
    }
  }

  // The value of a section's selector ("layout"), which decides what other keys mean.
  struct Choice {
    std::string key, name;
    bool known = true;        // false: the selector itself is wrong or missing
    bool overridden = false;  // by an option
  };
  template <class Owner>
  Choice read_selector(const Node& node, const std::string& path, std::string_view section,
                       std::span<const Key<Owner>> keys, Owner& owner) {
    Choice choice;
    const auto selector = find_section(section)->selector;
    if (selector.empty()) return choice;
    choice.key = selector;
    for (const auto& key : keys) {
      if (key.section != section || key.name != selector) continue;
      if (const Node* given = node.find(selector)) {
        const auto before = problems_.size();
        read_value(*given, join(path, selector), key, owner);
        choice.known = problems_.size() == before;
        choice.overridden = !given->place.from_file();
      } else if (key.required) {
        choice.known = false;
      }
      const auto& access = std::get<ChoiceAccess<Owner>>(key.access);
      choice.name = access.names()[access.get(owner)];
    }
    return choice;
  }

  template <class Owner>
  void read_key(const Node& child, const std::string& path, const std::string& name, std::string_view section,
                std::span<const Key<Owner>> keys, const Choice& choice, Owner& owner) {
    const std::string full = join(path, name);
    for (const auto& key : keys) {
      if (key.section != section || key.name != name) continue;
      if (!choice.key.empty() && name == choice.key) return;  // read already
      if (choice.known && !key.when.empty() && !applies(key.when, choice.name)) {
        // `--set targets.layout=ring` over a file with a list means: without the list.
        if (choice.overridden && child.place.from_file()) return;
        report(child.place, full,
               "has no meaning with " + choice.key + " = " + in_quotes(choice.name) + ", only with " +
                   alternatives(key.when));
        return;
      }
      remember(full, child.place);
      read_value(child, full, key, owner);
      return;
    }
    report_unknown(child.place, path, name, section);
  }

  void report_unknown(const Place& place, const std::string& path, const std::string& name, std::string_view section) {
    std::vector<std::string_view> here, elsewhere;
    std::vector<std::string> elsewhere_paths;
    auto collect = [&](std::string_view of, std::string_view key) {
      if (of == section)
        here.push_back(key);
      else {
        elsewhere.push_back(key);
        elsewhere_paths.push_back(join(std::string(of), key));
      }
    };
    for (const auto& key : scenario_keys()) collect(key.section, key.name);
    for (const auto& key : obstacle_keys()) collect(key.section, key.name);
    for (const auto& key : event_keys()) collect(key.section, key.name);
    for (const auto& s : sections()) {
      const auto dot = s.path.rfind('.');
      if (s.path.empty()) continue;
      collect(dot == std::string_view::npos ? "" : s.path.substr(0, dot), s.path.substr(dot + 1));
    }
    for (const auto& info : parameter_table()) {
      if (platform_key(info.key).empty()) collect("mission.parameters", info.key);
    }

    // The same name in another section beats a similar one in this section.
    std::string meant;
    const auto exact = std::find(elsewhere.begin(), elsewhere.end(), name);
    if (exact != elsewhere.end())
      meant = elsewhere_paths[static_cast<std::size_t>(exact - elsewhere.begin())];
    else if (const auto near = nearest(name, here); !near.empty())
      meant = join(path, near);
    else if (const auto far = nearest(name, elsewhere); !far.empty()) {
      meant = elsewhere_paths[static_cast<std::size_t>(std::find(elsewhere.begin(), elsewhere.end(), far) -
                                                       elsewhere.begin())];
    }
    std::string text = "there is no such key";
    if (!meant.empty()) text += "; did you mean " + meant + "?";
    std::string list;
    for (const auto known : here) list += (list.empty() ? "" : ", ") + std::string(known);
    const bool repeated = section == "obstacles" || section == "events";
    const std::string header = repeated ? "[[" + std::string(section) + "]]" : "[" + std::string(section) + "]";
    text += section.empty() ? " (at the top: " : " (" + header + " has ";
    report(place, join(path, name), text + list + ")");
  }

  void read_section(const Node& node, const std::string& path, Form& form) {
    read_keys<Form>(node, path, path, scenario_keys(), form);
    for (const auto& [name, child] : *node.table()) {
      const std::string inner = join(path, name);
      if (!find_section(inner)) continue;
      if (inner == "obstacles")
        read_list(child, inner, obstacle_keys(), form.obstacles);
      else if (inner == "events")
        read_list(child, inner, event_keys(), form.events);
      else if (!child.table())
        report(child.place, inner, "is a section, [" + inner + "], not " + child.describe());
      else if (inner == "mission.parameters")
        read_parameters(child);
      else
        read_section(child, inner, form);
    }
  }

  template <class Owner>
  void read_list(const Node& node, const std::string& path, std::span<const Key<Owner>> keys,
                 std::vector<Owner>& list) {
    remember(path, node.place);
    if (!node.array()) {
      report(node.place, path, "is a list of tables, [[" + path + "]] once for each, not " + node.describe());
      return;
    }
    for (std::size_t i = 0; i < node.array()->size(); ++i) {
      const Node& item = (*node.array())[i];
      const std::string name = path + "[" + std::to_string(i) + "]";
      list.emplace_back();
      if (item.table())
        read_keys<Owner>(item, name, path, keys, list.back());
      else
        report(item.place, name, "must be a table, not " + item.describe());
    }
  }

  void read_parameters(const Node& node) {
    remember("mission.parameters", node.place);
    auto& parameters = form_.configuration.scenario.mission.parameters;
    for (const auto& [name, child] : *node.table()) {
      const auto full = join("mission.parameters", name);
      remember(full, child.place);
      const auto table = parameter_table();
      const auto info = std::find_if(table.begin(), table.end(), [&key = name](const auto& p) { return p.key == key; });
      if (info == table.end()) {
        report_unknown(child.place, "mission.parameters", name, "mission.parameters");
      } else if (const auto owner = platform_key(name); !owner.empty()) {
        report(child.place, full, "follows from the key " + std::string(owner) + ": set that instead");
      } else {
        double value = 0.0;
        if (read_number(child, full, {widened(info->minimum), widened(info->maximum)}, info->unit, value))
          parameters.emplace_back(name, value);
      }
    }
    // In the controller's order, so that equal configurations have equal texts.
    auto rank = [](const auto& p) {
      const auto table = parameter_table();
      return std::find_if(table.begin(), table.end(), [&](const auto& info) { return info.key == p.first; }) -
             table.begin();
    };
    std::sort(parameters.begin(), parameters.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  }

  // `robots` and `redundancy` exclude each other, but an option beats what the file says.
  void settle_robot_number(const Node& root) {
    auto& swarm = form_.configuration.scenario.swarm;
    const Node* section = root.find("swarm");
    const Node* robots = section ? section->find("robots") : nullptr;
    const Node* redundancy = section ? section->find("redundancy") : nullptr;
    const bool listed = swarm.start.layout == world::Layout::list;
    if (redundancy && listed && !faulty("swarm.start.layout")) {
      report(redundancy->place, "swarm.redundancy",
             "has no meaning with start.layout = \"list\": the list says how many");
      return;
    }
    if (!robots || !redundancy) return;
    if (robots->place.from_file() == redundancy->place.from_file()) {
      report(redundancy->place, "swarm.redundancy", "give robots or redundancy, not both");
    } else if (robots->place.from_file()) {
      swarm.robots = 0;
    } else {
      swarm.redundancy = world::SwarmModel{}.redundancy;
    }
  }

  // --------------------------------------------------------------------------------- values --

  template <class Owner>
  void read_value(const Node& node, const std::string& path, const Key<Owner>& key, Owner& owner) {
    remember(path, node.place);
    std::visit([&](const auto& access) { read_as(node, path, key, access, owner); }, key.access);
  }

  bool read_number(const Node& node, const std::string& path, const Range& range, std::string_view unit,
                   double& value) {
    double number = 0.0;
    if (const auto* real = std::get_if<double>(&node.value))
      number = *real;
    else if (const auto* whole = std::get_if<std::int64_t>(&node.value))
      number = static_cast<double>(*whole);
    else {
      report(node.place, path, "must be a number (" + range_text(range, unit) + "), not " + node.describe());
      return false;
    }
    const bool inside = (range.above ? number > range.minimum : number >= range.minimum) && number <= range.maximum;
    if (!std::isfinite(number) || !inside) {  // nan compares false
      report(node.place, path, "is " + number_text(number) + "; allowed: " + range_text(range, unit));
      return false;
    }
    value = number;
    return true;
  }

  bool read_whole(const Node& node, const std::string& path, const Range& range, std::string_view unit,
                  std::int64_t& value) {
    const auto* whole = std::get_if<std::int64_t>(&node.value);
    if (!whole) {
      const bool too_large =
          std::holds_alternative<double>(node.value) && std::abs(std::get<double>(node.value)) >= 0x1p63;
      if (too_large)
        report(node.place, path,
               "is " + number_text(std::get<double>(node.value)) + "; allowed: " + range_text(range, unit));
      else
        report(node.place, path, "must be a whole number (" + range_text(range, unit) + "), not " + node.describe());
      return false;
    }
    const auto number = static_cast<double>(*whole);
    if (number < range.minimum || number > range.maximum) {
      report(node.place, path, "is " + std::to_string(*whole) + "; allowed: " + range_text(range, unit));
      return false;
    }
    value = *whole;
    return true;
  }

  bool read_point(const Node& node, const std::string& path, const Range& range, std::string_view unit, Vec2& value) {
    if (!node.array() || node.array()->size() != 2) {
      report(node.place, path, "must be two numbers [x, y] in " + std::string(unit) + ", not " + node.describe());
      return false;
    }
    Vec2 point;
    const bool x = read_number((*node.array())[0], path + "[0]", range, unit, point.x);
    const bool y = read_number((*node.array())[1], path + "[1]", range, unit, point.y);
    if (x && y) value = point;
    return x && y;
  }

  template <class Owner>
  void read_as(const Node& node, const std::string& path, const Key<Owner>&, bool& (*access)(Owner&), Owner& owner) {
    if (const auto* truth = std::get_if<bool>(&node.value))
      access(owner) = *truth;
    else
      report(node.place, path, "must be true or false, not " + node.describe());
  }
  template <class Owner>
  void read_as(const Node& node, const std::string& path, const Key<Owner>& key, double& (*access)(Owner&),
               Owner& owner) {
    double value = 0.0;
    if (read_number(node, path, key.range, key.unit, value)) {
      access(owner) = is_angle(key.unit) ? value * radians_per_degree : value;
    }
  }
  template <class Owner, class Whole>
  requires std::is_integral_v<Whole>
  void read_as(const Node& node, const std::string& path, const Key<Owner>& key, Whole& (*access)(Owner&),
               Owner& owner) {
    std::int64_t value = 0;
    if (read_whole(node, path, key.range, key.unit, value)) access(owner) = static_cast<Whole>(value);
  }
  template <class Owner>
  void read_as(const Node& node, const std::string& path, const Key<Owner>& key, const SeedAccess<Owner>& access,
               Owner& owner) {
    read_as(node, path, key, access.member, owner);
  }
  template <class Owner>
  void read_as(const Node& node, const std::string& path, const Key<Owner>& key,
               std::optional<std::size_t>& (*access)(Owner&), Owner& owner) {
    std::int64_t value = 0;
    if (read_whole(node, path, key.range, key.unit, value)) access(owner) = static_cast<std::size_t>(value);
  }
  template <class Owner>
  void read_as(const Node& node, const std::string& path, const Key<Owner>& key,
               std::optional<double>& (*access)(Owner&), Owner& owner) {
    double value = 0.0;
    if (read_number(node, path, key.range, key.unit, value)) access(owner) = value;
  }
  template <class Owner>
  void read_as(const Node& node, const std::string& path, const Key<Owner>& key, std::string& (*access)(Owner&),
               Owner& owner) {
    // A bare number or truth value after `--set name=` is meant as text.
    const auto* text = node.string();
    if (!text) {
      report(node.place, path, "must be text in quotes, not " + node.describe());
    } else if (key.name == "name" && !good_name(*text)) {
      report(node.place, path, "is " + in_quotes(*text) + "; allowed: " + std::string(name_rule));
    } else {
      access(owner) = *text;
    }
  }
  template <class Owner>
  void read_as(const Node& node, const std::string& path, const Key<Owner>& key, Vec2& (*access)(Owner&),
               Owner& owner) {
    read_point(node, path, key.range, key.unit, access(owner));
  }
  template <class Owner>
  void read_as(const Node& node, const std::string& path, const Key<Owner>& key, std::vector<Vec2>& (*access)(Owner&),
               Owner& owner) {
    if (!node.array()) {
      report(node.place, path,
             "must be a list of points [[x, y], ...] in " + std::string(key.unit) + ", not " + node.describe());
      return;
    }
    auto& list = access(owner);
    list.assign(node.array()->size(), Vec2{});
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string item = path + "[" + std::to_string(i) + "]";
      remember(item, (*node.array())[i].place);
      read_point((*node.array())[i], item, key.range, key.unit, list[i]);
    }
  }
  template <class Owner>
  void read_as(const Node& node, const std::string& path, const Key<Owner>& key, std::vector<double>& (*access)(Owner&),
               Owner& owner) {
    if (!node.array()) {
      report(node.place, path, "must be a list of numbers in " + std::string(key.unit) + ", not " + node.describe());
      return;
    }
    auto& list = access(owner);
    list.assign(node.array()->size(), 0.0);
    for (std::size_t i = 0; i < list.size(); ++i) {
      double value = 0.0;
      if (read_number((*node.array())[i], path + "[" + std::to_string(i) + "]", key.range, key.unit, value)) {
        list[i] = is_angle(key.unit) ? value * radians_per_degree : value;
      }
    }
  }
  template <class Owner>
  void read_as(const Node& node, const std::string& path, const Key<Owner>&, const ChoiceAccess<Owner>& access,
               Owner& owner) {
    const auto names = access.names();
    const auto* text = node.string();
    const auto found = text ? std::find(names.begin(), names.end(), *text) : names.end();
    if (found != names.end()) {
      access.set(owner, static_cast<std::size_t>(found - names.begin()));
      return;
    }
    std::string message = "must be " + alternatives(names) + ", not " + node.describe();
    if (text) {
      if (const auto near = nearest(*text, {names.begin(), names.end()}); !near.empty()) {
        message += "; did you mean " + in_quotes(near) + "?";
      }
    }
    report(node.place, path, message);
  }

  std::vector<Problem>& problems_;
  Form form_;
  std::map<std::string, std::pair<std::string, Place>> places_;  // bare key -> key as written, place
  std::set<std::string> faulty_;                                 // bare keys
};

// world/ names fields as the struct does; a user knows them by the keys of the file.
std::string in_file_terms(std::string text) {
  constexpr std::pair<std::string_view, std::string_view> renamed[] = {
      {"swarm.start.positions", "swarm.start.positions_m"},
      {"targets.positions", "targets.positions_m"},
      {"headings_rad", "headings_deg"},
      {"phase_rad", "phase_deg"},
      {"angle_rad", "angle_deg"},
      {"bearing_noise_rad", "bearing_noise_deg"},
      {"swarm.start.center", "swarm.start.center_m"},
      {"targets.center", "targets.center_m"}};
  for (const auto& [from, to] : renamed) {
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
      if (text.compare(at + from.size(), 2, "_m") != 0 || !to.ends_with("_m")) text.replace(at, from.size(), to);
    }
  }
  return text;
}

// faults() of what could be read. Parts that could not be read must not cause further complaints:
// obstacles and events are made harmless, and when the parameters contradict each other the rest
// is looked at without them.
std::vector<world::Fault> semantic_faults(world::Scenario scenario, const Reader& reader) {
  for (std::size_t i = 0; i < scenario.obstacles.size(); ++i) {
    if (reader.faulty("obstacles[" + std::to_string(i) + "]")) scenario.obstacles[i] = world::Disc{{-9e3, -9e3}, 1e-3};
  }
  for (std::size_t i = 0; i < scenario.events.size(); ++i) {
    if (reader.faulty("events[" + std::to_string(i) + "]"))
      scenario.events[i] = world::Event{0.0, world::Event::Kind::set_loss, 0, 0.0, {}};
  }
  auto list = world::faults(scenario);
  const auto about_parameters = [](const world::Fault& f) {
    return !f.warning && f.key.starts_with("mission.parameters");
  };
  if (std::any_of(list.begin(), list.end(), about_parameters)) {
    scenario.mission.parameters.clear();
    for (auto& more : world::faults(scenario)) {
      const auto same = [&](const world::Fault& f) { return f.key == more.key && f.text == more.text; };
      if (std::none_of(list.begin(), list.end(), same)) list.push_back(std::move(more));
    }
  }
  return list;
}

void add_semantic_problems(const Configuration& configuration, const Reader& reader, std::vector<Problem>& problems) {
  const bool broken = !problems.empty();
  for (const auto& fault : semantic_faults(configuration.scenario, reader)) {
    // Defaults stand in for what could not be read, so doubts are worth nothing then.
    if (reader.faulty(fault.key) || (broken && fault.warning)) continue;
    std::string known_as;
    const Place place = reader.place_of(fault.key, known_as);
    problems.push_back({place, in_file_terms(fault.key), in_file_terms(fault.text), fault.warning});
  }
}

// ------------------------------------------------------------------------------------- writing --

using Json = nlohmann::ordered_json;

// The angle in degrees that a reader turns into exactly this angle in rad.
double exact_degrees(double rad) {
  const double about = rad / radians_per_degree;
  // The shortest decimal near it first: 90, not 90.00000000000001.
  for (int digits = 1; digits <= 17; ++digits) {
    std::array<char, 40> text;
    std::snprintf(text.data(), text.size(), "%.*g", digits, about);
    const double candidate = std::strtod(text.data(), nullptr);
    if (candidate * radians_per_degree == rad) return candidate;
  }
  for (double low = about, high = about, i = 0; i < 4; ++i) {
    low = std::nextafter(low, -1e9);
    high = std::nextafter(high, 1e9);
    if (low * radians_per_degree == rad) return low;
    if (high * radians_per_degree == rad) return high;
  }
  return about;
}

Json point_json(Vec2 p) { return Json::array({p.x, p.y}); }

template <class Owner> struct ToJson {
  const Key<Owner>& key;
  Owner& owner;
  // Null: there is nothing to write.
  Json operator()(bool& (*access)(Owner&)) const { return access(owner); }
  Json operator()(double& (*access)(Owner&)) const { return angle(access(owner)); }
  Json operator()(int& (*access)(Owner&)) const { return access(owner); }
  Json operator()(std::uint32_t& (*access)(Owner&)) const { return access(owner); }
  Json operator()(std::size_t& (*access)(Owner&)) const { return access(owner); }
  Json operator()(std::optional<std::size_t>& (*access)(Owner&)) const {
    return access(owner) ? Json(*access(owner)) : Json();
  }
  Json operator()(std::optional<double>& (*access)(Owner&)) const {
    return access(owner) ? Json(*access(owner)) : Json();
  }
  Json operator()(std::string& (*access)(Owner&)) const { return access(owner); }
  Json operator()(Vec2& (*access)(Owner&)) const { return point_json(access(owner)); }
  Json operator()(std::vector<Vec2>& (*access)(Owner&)) const {
    Json list = Json::array();
    for (const Vec2 p : access(owner)) list.push_back(point_json(p));
    return list;
  }
  Json operator()(std::vector<double>& (*access)(Owner&)) const {
    Json list = Json::array();
    for (const double v : access(owner)) list.push_back(angle(v));
    return list.empty() ? Json() : list;
  }
  Json operator()(const SeedAccess<Owner>& access) const { return access.member(owner); }
  Json operator()(const ChoiceAccess<Owner>& access) const { return access.names()[access.get(owner)]; }
  double angle(double v) const { return is_angle(key.unit) ? exact_degrees(v) : v; }
};

// The keys of one section that have a meaning.
template <class Owner>
Json section_json(std::string_view section, std::string_view selector, std::span<const Key<Owner>> keys, Owner& owner) {
  Json table = Json::object();
  std::string choice;
  for (const auto& key : keys) {
    if (key.section == section && key.name == selector) choice = std::visit(ToJson<Owner>{key, owner}, key.access);
  }
  for (const auto& key : keys) {
    if (key.section != section || (!key.when.empty() && !applies(key.when, choice))) continue;
    Json value = std::visit(ToJson<Owner>{key, owner}, key.access);
    if (!value.is_null()) table[std::string(key.name)] = std::move(value);
  }
  return table;
}

template <class Owner>
Json list_json(const Section& section, std::span<const Key<Owner>> keys, std::vector<Owner>& list) {
  Json items = Json::array();
  for (auto& item : list) items.push_back(section_json(section.path, section.selector, keys, item));
  return items;
}

Json to_json(const Configuration& configuration) {
  Form form = to_form(configuration);
  Json root = Json::object();
  for (const auto& section : sections()) {
    if (section.path == "obstacles") {
      root["obstacles"] = list_json(section, obstacle_keys(), form.obstacles);
    } else if (section.path == "events") {
      root["events"] = list_json(section, event_keys(), form.events);
    } else if (section.path == "mission.parameters") {
      Json& table = root["mission"]["parameters"] = Json::object();
      for (const auto& [key, value] : configuration.scenario.mission.parameters) table[key] = value;
    } else {
      Json table = section_json<Form>(section.path, section.selector, scenario_keys(), form);
      if (section.path.empty())
        root = std::move(table);
      else if (section.path == "swarm.start")
        root["swarm"]["start"] = std::move(table);
      else
        root[std::string(section.path)] = std::move(table);
    }
  }
  // How many robots: said once.
  const auto& swarm = configuration.scenario.swarm;
  if (swarm.robots == 0) root["swarm"].erase("robots");
  if (swarm.robots != 0 || swarm.start.layout == world::Layout::list) root["swarm"].erase("redundancy");
  return root;
}

std::string toml_value(const Json& value) {
  if (value.is_string()) {
    // A JSON string is a TOML string but for DEL.
    std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    for (auto at = text.find('\x7f'); at != std::string::npos; at = text.find('\x7f', at))
      text.replace(at, 1, "\\u007F");
    return text;
  }
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void write_toml(const Json& table, const std::string& path, std::string& out) {
  for (const auto& [key, value] : table.items()) {
    const bool tables = value.is_array() && !value.empty() && value.front().is_object();
    if (!value.is_object() && !tables && !(value.is_array() && value.empty() && path.empty())) {
      out += key + " = " + toml_value(value) + "\n";
    }
  }
  for (const auto& [key, value] : table.items()) {
    const std::string inner = path.empty() ? key : path + "." + key;
    if (value.is_object() && !value.empty()) {
      const auto is_value = [](const Json& v) { return !v.is_object(); };
      if (std::any_of(value.begin(), value.end(), is_value)) out += "\n[" + inner + "]\n";
      write_toml(value, inner, out);
    } else if (value.is_array() && !value.empty() && value.front().is_object()) {
      for (const auto& item : value) {
        out += "\n[[" + inner + "]]\n";
        write_toml(item, inner, out);
      }
    }
  }
}

}  // namespace

std::size_t Loaded::errors() const noexcept {
  return static_cast<std::size_t>(
      std::count_if(problems.begin(), problems.end(), [](const Problem& p) { return !p.warning; }));
}

Loaded configure(Node root, const std::string& path, std::vector<Problem> problems) {
  Loaded loaded{{}, std::move(problems)};
  root.place.line = 0;
  Reader reader(loaded.problems);
  loaded.configuration = to_configuration(reader.read(root));
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
    if (const Node* config = root.find("config"); config && config->table()) return *config;
  }
  return root;
}

Loaded parse_configuration(const std::string& path, std::string_view text, const std::vector<Override>& overrides) {
  try {
    Node root = parse_scenario(path, text);
    std::vector<Problem> problems;
    for (const auto& o : overrides) {
      if (!o.file.empty()) {
        overlay(root, as_option(parse_document(o.file, read_text_file(o.file))));
        continue;
      }
      for (auto& problem : apply_override(root, o.assignment, o.origin)) problems.push_back(std::move(problem));
    }
    return configure(std::move(root), path, std::move(problems));
  } catch (const DocumentError& e) { return {{}, {e.problem}}; }
}

Loaded load_configuration(const std::string& path, const std::vector<Override>& overrides) {
  try {
    return parse_configuration(path, read_text_file(path), overrides);
  } catch (const DocumentError& e) { return {{}, {e.problem}}; }
}

std::string config_json(const Configuration& configuration, int indent) {
  return to_json(configuration).dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string config_toml(const Configuration& configuration) {
  std::string out;
  write_toml(to_json(configuration), "", out);
  return out;
}

}  // namespace banyan::config
