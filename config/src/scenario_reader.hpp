// SPDX-License-Identifier: MIT
// From a tree to a Configuration by the tables of keys: names, types and single values. How they fit
// together is for world::faults().
#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "banyan/config/document.hpp"
#include "banyan/config/keys.hpp"
#include "banyan/world/faults.hpp"

namespace banyan::config {

class ScenarioReader {
 public:
  ScenarioReader(std::vector<Problem>& problems, const AlgorithmList& algorithms)
      : problems_(problems), algorithms_(algorithms) {}

  [[nodiscard]] Configuration read(const Node& root);
  // Where a key was written, or else the nearest section around it.
  [[nodiscard]] Place place_of(std::string key) const;
  // Of the keys that it is about, where the one stands that a command line option sets; else the first that is written.
  [[nodiscard]] Place place_of(const world::Fault& fault) const;
  // Whether a problem was already reported about the key or a part of it.
  [[nodiscard]] bool faulty(const std::string& key) const;

 private:
  // A table of the file: a section, or an entry of a list of tables.
  struct Part {
    const Node& node;
    std::string shown;         // as users write it: "swarm.start", "events[2]"
    std::string_view section;  // as the tables of keys have it: "swarm.start", "events"
  };
  // The value of a selector ("layout", "kind"), on which the meaning of other keys depends.
  struct Choice {
    std::string name;
    bool known = true;        // false: the selector itself is wrong or missing
    bool overridden = false;  // by an option
  };
  using Choices = std::map<std::string, Choice, std::less<>>;  // by the selector's path

  void report(const Place& place, const std::string& key, std::string text);
  void report_unknown(const Place& place, const Part& part, const std::string& name);

  template <class Owner>
  void read_selectors(const Part& part, std::span<const world::Key<Owner>> keys, Owner& owner, Choices& choices);
  template <class Owner>
  void read_keys(const Part& part, std::span<const world::Key<Owner>> keys, const Choices& choices, Owner& owner);
  template <class Owner>
  void read_key(const Part& part, const Node::Member& member, std::span<const world::Key<Owner>> keys,
                const Choices& choices, Owner& owner);
  template <class Owner>
  void require(const Part& part, std::span<const world::Key<Owner>> keys, const Choices& choices, const Owner& owner);
  template <class Owner>
  bool excluded(const Part& part, const Node& node, const world::Key<Owner>& key,
                std::span<const world::Key<Owner>> keys);

  bool is_another_file(const Node& root);
  void read_section(const Part& part, const Choices& choices, Configuration& configuration);
  template <class Owner>
  void read_list(const Node& node, std::string_view path, std::span<const world::Key<Owner>> keys,
                 std::vector<Owner>& list);
  void read_parameters(const Node& node, world::Mission& mission);

  // A value of the key's type and range; none, and a problem, if it is not.
  template <class Owner>
  world::Value read_value(const Node& node, const std::string& path, const world::Key<Owner>& key, const Owner& owner);
  world::Value read_number(const Node& node, const std::string& path, const Range& range, std::string_view unit);
  world::Value read_whole(const Node& node, const std::string& path, const Range& range, std::string_view unit);
  world::Value read_name(const Node& node, const std::string& path, world::Names names);
  world::Value read_point(const Node& node, const std::string& path, const Range& range, std::string_view unit);
  world::Value read_points(const Node& node, const std::string& path, const Range& range, std::string_view unit);
  world::Value read_pairs(const Node& node, const std::string& path);
  world::Value read_numbers(const Node& node, const std::string& path, const Range& range, std::string_view unit);

  std::vector<Problem>& problems_;
  const AlgorithmList& algorithms_;
  std::map<std::string, Place> places_;  // by key
  std::set<std::string> faulty_;         // keys
};

}  // namespace banyan::config
