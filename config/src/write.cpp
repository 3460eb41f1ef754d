// SPDX-License-Identifier: MIT
// The complete configuration as JSON and as TOML. The ids of runs in a study are computed from the JSON: with another
// order or form of the same values, every finished run would count as a new one.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "banyan/config/config.hpp"

namespace banyan::config {
namespace {

using Json = nlohmann::ordered_json;

struct ToJson {
  Json operator()(std::monostate) const { return {}; }
  Json operator()(world::Vec2 p) const { return Json::array({p.x, p.y}); }
  Json operator()(const std::vector<world::Vec2>& list) const {
    Json items = Json::array();
    for (const world::Vec2 p : list) items.push_back((*this)(p));
    return items;
  }
  Json operator()(const world::NamePairs& pairs) const {
    Json items = Json::array();
    for (const auto& [a, b] : pairs) items.push_back(Json::array({a, b}));
    return items;
  }
  template <class Plain> Json operator()(const Plain& value) const { return value; }
};

// The keys of one section that have an effect.
template <class Owner>
void add_section(Json& table, std::string_view section, std::span<const world::Key<Owner>> keys, const Owner& owner) {
  for (const auto& key : keys) {
    if (key.section() != section) continue;
    const world::Value value = effective(key, keys, owner);
    if (value.index() != 0) table[std::string(key.name())] = std::visit(ToJson{}, value);
  }
}

// The place of a section in the tree: root["swarm"]["start"].
Json& place_of_section(Json& root, std::string_view path) {
  Json* at = &root;
  while (!path.empty()) {
    const auto dot = std::min(path.find('.'), path.size());
    at = &(*at)[std::string(path.substr(0, dot))];
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  return *at;
}

// Tables of a list, or keys with a value.
std::size_t size_of(const Configuration& configuration, const world::Section& section) {
  if (section.repeated) {
    std::size_t size = 0;
    world::each_list(configuration.scenario, [&](std::string_view path, const auto&, const auto& list) {
      if (path == section.path) size = list.size();
    });
    return size;
  }
  Json table = Json::object();
  each_part(configuration, [&](const auto& keys, const auto& owner) { add_section(table, section.path, keys, owner); });
  return table.size();
}

Json to_json(const Configuration& configuration) {
  Json root = Json::object();
  for (const auto& section : sections()) {
    if (section.left_out && size_of(configuration, section) == 0) continue;
    Json& place = place_of_section(root, section.path);
    if (section.repeated) {
      place = Json::array();
      world::each_list(configuration.scenario, [&](std::string_view path, const auto& keys, const auto& list) {
        if (path != section.path) return;
        for (const auto& item : list) {
          place.push_back(Json::object());
          add_section(place.back(), path, keys, item);
        }
      });
      continue;
    }
    if (place.is_null()) place = Json::object();
    each_part(configuration,
              [&](const auto& keys, const auto& owner) { add_section(place, section.path, keys, owner); });
    if (section.path == "mission.parameters")
      for (const auto& [key, value] : configuration.scenario.mission.parameters) place[key] = value;
  }
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

std::string config_json(const Configuration& configuration, int indent) {
  return to_json(configuration).dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string config_toml(const Configuration& configuration) {
  std::string out;
  write_toml(to_json(configuration), "", out);
  return out;
}

}  // namespace banyan::config
